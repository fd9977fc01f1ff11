"""The tutorial about Python: its scripts and commands do what the page says."""

import os
import re
import shlex
import subprocess
import unittest
from pathlib import Path

import numpy as np
import rbc
from lammps_case import POTENTIALS, ROOT, run
from scene_case import polyhedron

EXAMPLE = ROOT / "examples" / "python"
PAGE = (ROOT / "doc" / "tutorial_python.rst").read_text(encoding="utf-8")


def python(folder, *words):
    done = subprocess.run(["/usr/bin/python3", *words], text=True, check=False, timeout=200,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=folder,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "scripts")})
    if done.returncode:
        raise AssertionError(done.stdout)
    return done.stdout


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        script = (EXAMPLE / "in.files").read_text(encoding="utf-8")
        cls.folder = run(f"variable templates index {POTENTIALS}\n{script}", timeout=200).folder
        (cls.folder / "log.case").rename(cls.folder / "log.lammps")

    def test_look_prints_what_the_page_has(self):
        printed = python(self.folder, EXAMPLE / "look.py").splitlines()
        self.assertEqual(len(printed), 7)
        number = re.compile(r"-?\d+\.\d+(?:e-?\d+)?")
        for line in printed:
            # other processors round differently: numbers may differ, texts and whole numbers not
            pattern = number.sub("@", re.escape(line).replace(r"\.", ".").replace(r"\-", "-"))
            self.assertRegex(PAGE, pattern.replace("@", number.pattern))
        print("\n" + "\n".join(printed))
        for name in ("cells.png", "flow.png", "deformation.png"):
            self.assertGreater((self.folder / name).stat().st_size, 10000)

    def test_what_it_finds_is_so(self):
        shapes = rbc.shapes_of(self.folder / "cells.200.vtp")
        volume = polyhedron("rbc_162")[1]
        for shape in shapes.values():
            self.assertAlmostEqual(shape.volume / volume, 1, delta=3e-3)
        # plasma next to the plate is sheared by the traction over its viscosity
        grid, log = rbc.read_grid(self.folder / "velocity.0.vtr"), rbc.read_log(
            self.folder / "log.lammps")[-1]
        profile = grid.vector()[..., 0].mean(axis=(0, 1))
        slip = profile[0] + 8.0e-4 - log["f_flow[1]"][0] / 1.5 * grid.centres[2][0]
        self.assertLess(abs(slip), 1e-3 * 8.0e-4)

    def test_functions_of_the_table_are_there(self):
        table = PAGE.split("What there is")[1].split("Where things are")[0]
        first = re.findall(r"^   \* - (\*.*?)\n     - ", table, re.MULTILINE | re.DOTALL)
        names = [name for cell in first for name in re.findall(r"\*(\w+)\*", cell)]
        functions = {name for name in rbc.__all__ if name[0].islower()}
        self.assertEqual(set(names), functions - {"read_csv", "series", "cells_of_array"})

    def test_commands(self):
        commands = re.findall("^   rbc (.*)", PAGE.replace("\\\n", ""), re.MULTILINE)
        self.assertEqual(len(commands), 6)
        for command in commands:
            words = [word for text in shlex.split(command)
                     for word in ([path.name for path in self.folder.glob(text)]
                                  if "*" in text else [text])]
            python(self.folder, "-m", "rbc", *words)
            output = self.folder / words[words.index("-o") + 1]
            self.assertGreater(output.stat().st_size, 500)
        self.assertEqual(len(list(Path(self.folder).glob("*.csv"))), 3)
        table = np.genfromtxt(self.folder / "cell.csv", delimiter=",", names=True)
        self.assertEqual(len(table), 12 * 21)
        self.assertEqual(table["time"][-1], 40000)


if __name__ == "__main__":
    unittest.main()
