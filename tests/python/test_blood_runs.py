"""Histories of runs in pieces, of which some may not have begun."""
import tempfile
import unittest
from pathlib import Path

import blood_runs

HEAD = "LAMMPS\nPer MPI rank memory allocation\n"
ROWS = "   Step   v_sheared    f_ib[8]\n"


class Histories(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def test_begin_with_the_first_row(self):
        self.assertFalse(blood_runs.has_begun(self.folder))
        self.write("log.lammps", HEAD)
        self.assertFalse(blood_runs.has_begun(self.folder))
        self.write("log.lammps", HEAD + ROWS + "0 0 0\n")
        self.assertTrue(blood_runs.has_begun(self.folder))

    def test_of_pieces_follow_each_other(self):
        self.write("log.lammps", HEAD + ROWS + "0 0 0\n5 0.1 7\nLoop time of 1\n")
        self.write("log.lammps.2", HEAD + ROWS + "5 0.1 0\n10 0.2 3\nLoop time of 1\n")
        self.write("log.lammps.3", HEAD)
        history = blood_runs.history(self.folder)
        self.assertEqual(list(history["Step"]), [0, 5, 10])
        self.assertEqual(list(history["f_ib[8]"]), [0, 7, 10])
