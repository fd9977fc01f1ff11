"""The paper's largest scene with a few cells, in pieces: its tables, its parts, what counts as
touching."""

import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from lammps_case import ENVIRONMENT, ROOT
from scene_case import polyhedron, study_of

STUDY = study_of("blood-49152")
import blood_pictures  # noqa: E402
import blood_runs  # noqa: E402
from rbc.tables import read_ave_time  # noqa: E402
from rbc.surfaces import read_cell_ids, read_surfaces  # noqa: E402

EXAMPLE = ROOT / "examples" / "blood-49152"
CELLS = 12
SMALL = f"--cells {CELLS} --gap 12 --strain 2 --frames 20 --only 100".split()
REACH, SHARE = "500", "5"        # nm and % that in.suspension counts with


def script(name, *words):
    """Its output; needs no display, as pictures have one of their own."""
    return subprocess.run([sys.executable, EXAMPLE / name, *map(str, words)], text=True, check=True,
                          env={**os.environ, **ENVIRONMENT}, stdout=subprocess.PIPE).stdout


def rows(path):
    with open(path, encoding="utf-8") as table:
        return {row.pop("case"): {name: float(value) for name, value in row.items()}
                for row in csv.DictReader(table)}


class Small(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = Path(cls.scratch.name)
        cls.lmp = os.environ["LMP_RBC"]
        cls.printed = script("study.py", "--output", cls.folder, "--lmp", cls.lmp, "--piece", 1,
                             *SMALL)
        cls.run_folder = cls.folder / "100"

    def test_blood_as_asked_for(self):
        blood = rows(self.folder / "blood.csv")["100"]
        self.assertEqual(blood["cells"], CELLS)
        self.assertAlmostEqual(blood["strain"], 2, delta=0.3)    # lines of five steps
        box = np.prod(blood_runs.box(self.run_folder))
        filled = CELLS * polyhedron("rbc_162")[1] / box
        self.assertAlmostEqual(blood["hematocrit"], filled, delta=1e-4 * filled)
        self.assertEqual(blood["lost"] + blood["cut"], 0)
        self.assertLess(blood["volume"], 5e-4)    # steps are as long as an error of 0.02 um allows
        self.assertGreater(blood["viscosity"], 1 + 2.5 * filled)
        self.assertLess(blood["viscosity"], 10)
        self.assertGreater(blood["least_gap"], 0.05)    # cells repel each other from 0.4 um on

    def test_costs_are_all_of_the_time(self):
        cost = rows(self.folder / "cost.csv")["100"]
        parts = [cost[part] for part in (*STUDY.PAPER_COST, "other")]
        self.assertAlmostEqual(sum(parts), 100, delta=0.1)
        self.assertGreater(min(parts), 0)
        logs = [log.read_text() for log in blood_runs.logs(self.run_folder)]
        steps = sum(int(re.search(r"procs for (\d+) steps", log)[1]) for log in logs)
        self.assertEqual(cost["steps"], steps)
        seconds = cost["core_s_per_step"] * steps
        milliseconds = blood_runs.history(self.run_folder)["Time"][-1] * 1e-3
        self.assertAlmostEqual(cost["core_s_per_cell_and_ms"] / (seconds / CELLS / milliseconds), 1,
                               delta=2e-3)
        self.assertGreater(cost["kB_per_vertex"], 1)

    def test_pieces_are_one_run(self):
        strain = blood_runs.history(self.run_folder)["v_sheared"]
        self.assertTrue((np.diff(strain) > 0).all())
        steps = read_ave_time(self.run_folder / "classes.dat").steps
        self.assertTrue((np.diff(steps) > 0).all())
        self.assertEqual(len(re.findall("finished", self.printed)), 1)
        self.assertIn("100 /s: strain", self.printed)

    def test_paths_of_six_cells(self):
        cells = read_ave_time(self.run_folder / "cell.dat")
        self.assertEqual(cells.data.shape[1:], (6, 19))
        np.testing.assert_array_equal(cells.column(1)[0], STUDY.sampled(CELLS))
        times, heights = STUDY.paths(self.run_folder)
        self.assertAlmostEqual(times[-1] * 100, 2, delta=0.3)    # five steps between two points
        self.assertTrue(((heights > 0) & (heights < 12)).all())

    def test_pictures_are_there_and_cut_outs_hold_whole_cells(self):
        for name in ("blood-49152.png", "cells.png"):
            self.assertGreater((self.folder / name).stat().st_size, 10000)
        outside = blood_pictures.seen_from_outside(self.run_folder, self.folder / "seen.vtp")
        self.assertEqual(len(read_cell_ids(outside).molecules), CELLS)
        part = blood_pictures.cut_out(self.run_folder, self.folder / "part.vtp")
        self.assertEqual(len(read_surfaces(part).triangles),
                         320 * len(read_cell_ids(part).molecules))

    def test_touching_counts_as_the_run_did(self):
        script("touching.py", "--output", self.folder / "touching", "--lmp", self.lmp, "--run",
               self.run_folder, "--from", 0)
        table = rows(self.folder / "touching" / "touching.csv")
        classes = read_ave_time(self.run_folder / "classes.dat")
        last = {int(step): block for step, block in zip(classes.steps, classes.data)}
        written = [step for step, _ in blood_pictures.surfaces(self.run_folder)]
        counts = np.mean([last[step] for step in written], axis=0)
        same = table[f"{REACH} {SHARE}"]
        self.assertAlmostEqual(same["singles"], counts[0, 1] / CELLS, delta=1e-3)
        self.assertAlmostEqual(same["of_2_to_3"], counts[1, 1] / counts[1:, 1].sum(), delta=1e-3)
        for share in ("1", "2", "5", "10"):
            largest = [table[f"{reach} {share}"]["largest"] for reach in (300, 400, 500, 600, 700)]
            self.assertEqual(largest, sorted(largest))    # the farther one looks the more touch


class Pieces(unittest.TestCase):
    """A program that writes as much of a log as a piece does, and may be killed in between."""

    LOG = "echo Step >$log; echo {step} >>$log; echo {end} >>$log; echo {step} >>a.dat"

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def piece(self, step, end):
        program = self.folder / "lmp"
        log = "while [ \"$1\" != -log ]; do shift; done; log=$2; "
        program.write_text(f"#!/bin/sh\n{log}{self.LOG.format(step=step, end=end)}\n")
        program.chmod(0o755)
        blood_runs.run_piece(SimpleNamespace(lmp=program, ranks=1), self.folder / "run", {})
        return [path.name for path in blood_runs.logs(self.folder / "run")]

    def test_one_that_was_killed_is_taken_again(self):
        cut_short = f"{blood_runs.LIMIT}, {blood_runs.ENDED}"
        self.assertEqual(self.piece(1, "killed"), ["log.lammps"])
        self.assertEqual(self.piece(1, cut_short), ["log.lammps"])
        self.assertFalse(blood_runs.is_finished(self.folder / "run"))
        self.assertEqual(self.piece(2, "killed"), ["log.lammps", "log.lammps.2"])
        self.assertEqual(self.piece(3, cut_short), ["log.lammps", "log.lammps.2"])
        self.assertEqual(self.piece(4, blood_runs.ENDED)[-1], "log.lammps.3")
        self.assertTrue(blood_runs.is_finished(self.folder / "run"))
        self.assertEqual((self.folder / "run" / "a.dat").read_text().split(), ["1", "3", "4"])

    def test_are_in_order_of_their_numbers(self):
        for n in range(1, 12):
            names = self.piece(n, f"{blood_runs.LIMIT}, {blood_runs.ENDED}")
        self.assertEqual(names[1:], [f"log.lammps.{n}" for n in range(2, 12)])


class Paper(unittest.TestCase):
    def test_table_1(self):
        """Its parts are all of the time, and ours are in one of them each."""
        self.assertAlmostEqual(sum(share for share, _ in STUDY.PAPER_COST.values()), 100)
        names = [name for _, parts in STUDY.PAPER_COST.values() for name in parts]
        self.assertEqual(len(names), len(set(names)))

    def test_turns_of_a_sine(self):
        """However many points of it are written."""
        for points in (101, 1001):
            strains = np.linspace(0, 30, points)
            paths = np.sin(2 * np.pi * strains[:, None] / [10, 6])
            self.assertEqual(STUDY.turns(strains, paths), 6 + 10)


if __name__ == "__main__":
    unittest.main()
