"""Readers of the package rbc say what is wrong with a file, which reader it is for, and what it has
of what was asked for."""
import inspect
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rbc
from vtk_files import cuboid, write_grid, write_surfaces

TEXTS = {
    "log": "LAMMPS (4 Feb 2025)\nStep Temp\n 0 1.5\nLoop time of 1\n",
    "vector": "# Time-averaged data for fix a\n# TimeStep Number-of-rows\n# Row c_c[1] c_c[7]\n"
              "0 2\n1 4 0.5\n2 9 0.25\n300 2\n1 4 0.75\n2 9 0\n",
    "scalar": "# Time-averaged data for fix a\n# TimeStep v_strain v_relative\n0 0 3\n5 0.1 2.5\n",
    "print": "# time D\n0 0.5\n1 0.6\n",
    "dump": "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n"
            "0 1\nITEM: ATOMS id xu yu zu\n1 0 0 0\n",
    "grid": "ITEM: TIMESTEP\n7\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
            "ITEM: GRID SIZE nx ny nz\n1 1 1\nITEM: GRID CELLS v\n1\n",
    "words": "some words\nand more of them\n", "empty": "", "csv": "a,b\n1,2\n"}
READS = {"read_log": {"log"}, "read_ave_time": {"vector", "scalar"}, "read_cell_table": {"vector"},
         "read_table": {"scalar", "print"}, "read_dump": {"dump"}, "read_grids": {"grid", "vtr"},
         "read_grid": {"grid", "vtr"}, "read_surfaces": {"vtp"}, "read_cells": {"vtp"},
         "shapes_of": {"vtp"}}


class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        for name, text in TEXTS.items():
            (self.folder / name).write_text(text)
        write_surfaces(self.folder / "vtp", {1: cuboid((1, 1, 1))})
        (self.folder / "vtp").rename(self.folder / "x.vtp")
        write_grid(self.folder / "x.vtr", (np.arange(3.0),) * 3, "v", np.zeros((2, 2, 2, 3)))

    def path(self, kind):
        return self.folder / (f"x.{kind}" if kind in ("vtp", "vtr") else kind)


class Files(Folder):
    def test_each_reader_reads_its_own_and_refuses_all_others(self):
        for reader, own in READS.items():
            for kind in (*TEXTS, "vtp", "vtr"):
                with self.subTest(f"{reader} {kind}"):
                    if kind in own:
                        getattr(rbc, reader)(self.path(kind))
                    else:
                        with self.assertRaises(rbc.InputError) as problem:
                            getattr(rbc, reader)(self.path(kind))
                        self.assertIn(str(self.path(kind)), str(problem.exception))

    def test_the_right_reader_is_named(self):
        for reader, kind, message in (
                ("read_cell_table", "log", "log is a log: use read_log"),
                ("read_table", "vector", "of mode vector: use read_cell_table or read_ave_time"),
                ("read_cell_table", "scalar", "is a file of mode scalar: use read_table"),
                ("read_log", "dump", "is a dump of atoms: use read_dump"),
                ("read_dump", "grid", "is a dump of a grid: use read_grids"),
                ("read_surfaces", "vtr", "is a file of a grid: use read_grid"),
                ("read_grids", "vtp", "is a file of surfaces: use read_surfaces"),
                ("read_ave_time", "print", "read_table reads tables with a line of names")):
            with self.subTest(reader), self.assertRaisesRegex(rbc.InputError, message):
                getattr(rbc, reader)(self.path(kind))

    def test_files_that_are_not_there(self):
        for reader in (*READS, "read_csv"):
            with self.subTest(reader), self.assertRaises(FileNotFoundError):
                getattr(rbc, reader)(self.folder / "nothere")

    def test_files_that_are_cut_off(self):
        for reader, kind in (("read_table", "scalar"), ("read_dump", "dump")):
            (self.folder / "cut").write_text(TEXTS[kind].rstrip().rpartition("\n")[0] + "\n5")
            with self.subTest(reader), self.assertRaises(rbc.InputError):
                getattr(rbc, reader)(self.folder / "cut")
        (self.folder / "cut").write_text(TEXTS["dump"].replace(" zu", " z"))
        with self.assertRaisesRegex(rbc.InputError, "has no column zu; it has id xu yu z"):
            rbc.read_dump(self.folder / "cut")

    def test_mode_scalar(self):
        table = rbc.read_ave_time(self.folder / "scalar")
        self.assertEqual(table["v_relative"].tolist(), [3, 2.5])


class Names(Folder):
    def test_what_there_is_instead_of_a_column(self):
        for found, there in ((rbc.read_table(self.folder / "print"), "time, D"),
                             (rbc.read_log(self.folder / "log")[0], "Step, Temp"),
                             (rbc.read_cell_table(self.folder / "vector"), "molecule, deformation"),
                             (rbc.read_csv(self.folder / "csv")[0], "a, b"),
                             (rbc.read_surfaces(self.path("vtp")).data, "molecule"),
                             (rbc.read_grid(self.path("vtr")).data, "v")):
            with self.assertRaisesRegex(rbc.InputError, f"there is no E; there are .*{there}"):
                found["E"]
        with self.assertRaisesRegex(rbc.InputError, r"column 3 is not in .* c_c\[1\] c_c\[7\]"):
            rbc.read_ave_time(self.folder / "vector").column(3)


class Overviews(Folder):
    def test_are_two_lines(self):
        self.assertEqual(repr(rbc.read_cell_table(self.folder / "vector")),
                         "2 steps 0 to 300, 2 cells\ncolumns molecule deformation")
        self.assertEqual(repr(rbc.read_ave_time(self.folder / "vector")),
                         "2 steps 0 to 300, 2 rows\ncolumns c_c[1] c_c[7]")
        one = rbc.cells_of_array(5, np.zeros((1, len(rbc.CELL_COLUMNS))))
        self.assertTrue(repr(one).startswith("step 5, 1 cell\ncolumns molecule x y z "))

    def test_time(self):
        cells = rbc.read_cell_table(self.folder / "vector", timestep=0.5)
        self.assertEqual(cells.time.tolist(), [0, 150])
        with self.assertRaisesRegex(rbc.InputError, r"read_cell_table\(path, timestep=...\)"):
            rbc.read_cell_table(self.folder / "vector").time


class Readers(unittest.TestCase):
    def test_are_all_here(self):
        named = {name for name in rbc.__all__ if name.startswith("read_")
                 and inspect.isfunction(getattr(rbc, name))}
        self.assertEqual(named - {"read_csv"}, set(READS) - {"shapes_of"})


if __name__ == "__main__":
    unittest.main()
