"""converge.py with a scene of known order: a capsule in shear flow, moved by the midpoint rule."""

import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from lammps_case import ENVIRONMENT, ROOT

SCENE = ROOT / "examples" / "capsule-shear" / "in.capsule-shear"
TUTORIAL = ROOT / "examples" / "shear-cell" / "in.converge"
COARSE = "dx=0.333333", "shape=capsule_162", "length=4", "gap=4", "strain=1.6", "every=0.16"


def converge(folder, *words):
    return compare(folder, SCENE, "--set", *COARSE, *words)


def compare(folder, script, *words):
    command = [sys.executable, ROOT / "scripts" / "converge.py", script, "--measure",
               "c_cell[1][7]", "--lmp", os.environ["LMP_RBC"], "-o", folder, *words]
    done = subprocess.run(command, text=True, check=False, timeout=300, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env={**ENVIRONMENT, **os.environ})
    with open(Path(folder) / "converge.csv", encoding="utf-8") as file:
        return done, {row["timestep"]: row for row in csv.DictReader(file)}


class Midpoint(unittest.TestCase):
    def check(self, take):
        """Second order, and the error of each timestep is covered and not overdone: against a
        timestep an eighth of the finest."""
        with tempfile.TemporaryDirectory() as folder:
            done, rows = converge(folder, "--vary", "timestep=0.16,0.08,0.04", "--take", take)
            _, exact = converge(folder, "--vary", "timestep=0.01,0.005", "--take", take)
        print(done.stdout)
        self.assertEqual(done.returncode, 0)
        order = float(re.search(r"^timestep: order ([\d.]+)", done.stdout, re.MULTILINE)[1])
        self.assertLess(abs(order - 2), 0.4)
        return rows, float(exact["0.005"]["value"])

    def test_value_at_the_end(self):
        rows, exact = self.check("last")
        for row in rows.values():
            error = abs(float(row["value"]) - exact)
            self.assertTrue(error < float(row["error_below"]) < 4 * error + 1e-5, (row, error))

    def test_series(self):
        rows, _ = self.check("series")
        errors = [float(row["from_limit"]) for row in rows.values()]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertGreater(errors[0], 8 * errors[2])

    def test_series_of_a_script_that_hardly_prints(self):
        """The coarsest has a line at the start and one at the end, 10 % off in between."""
        script = TUTORIAL.read_text(encoding="utf-8")
        self.assertIn("thermo          20\ntimestep        ${timestep}\nrun ", script)
        words = TUTORIAL, "--take", "series", "--set", "dx=1", "shape=rbc_162"
        with tempfile.TemporaryDirectory() as folder:
            done, rows = compare(folder, *words, "--vary", "timestep=1000,500,250")
            _, finer = compare(folder, *words, "--vary", "timestep=1000,62.5", "--order",
                               "timestep=2")
        print(done.stdout)
        self.assertNotIn("WARNING", done.stdout)
        row, error = rows["1000"], float(finer["1000"]["from_limit"])
        self.assertTrue(error < float(row["error_below"]) < 3 * error, (row, error))
        self.assertLess(float(row["error_below"]), 0.001 * float(row["scale"]))


if __name__ == "__main__":
    unittest.main()
