"""The tutorial about errors: converge.py with the scene of the first tutorial."""

import csv
import re
import unittest

from lammps_case import ROOT, run
from tutorial_case import follow

SCENE = ROOT / "examples" / "shear-cell"


LEFT_OUT = "#", "variable", "fix             out", "thermo", "timestep", "run"


def plain(script):
    """Lines of a script without comments, variables and what only writes files."""
    return [" ".join(line.split()) for line in script.splitlines()
            if line.strip() and not line.startswith(LEFT_OUT)]


class Tutorial(unittest.TestCase):
    def test_is_the_scene_of_the_first_tutorial(self):
        script = (SCENE / "in.converge").read_text(encoding="utf-8")
        for name, value in re.findall(r"^variable +(\w+) +index (\S+)$", script, re.MULTILINE):
            script = script.replace(f"${{{name}}}", value)
        self.assertNotIn("${", script)
        self.assertEqual(plain(script), plain((SCENE / "in.tutorial").read_text(encoding="utf-8")))

    def test_follows_the_page(self):
        folder, _ = follow("tutorial_error", "shear-cell", tolerance=0.05, timed=True,
                           free=("cheapest", "not run", "most"))
        self.assertGreater((folder / "error" / "converge.png").stat().st_size, 5000)
        with open(folder / "error" / "converge.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        # a much finer run is within all error bounds
        script = (SCENE / "in.converge").read_text(encoding="utf-8")
        fine = {"dx": 0.333333, "shape": "rbc_2562", "templates": ROOT / "potentials"}
        lines = "".join(f"variable {name} index {value}\n" for name, value in fine.items())
        known = run(lines + script.replace("thermo          20", "thermo_style custom step time "
                                           "c_cell[1][7]"), timeout=500).thermo["c_cell[1][7]"][-1]
        for row in rows:
            self.assertLess(abs(float(row["value"]) - known), float(row["error_below"]))


if __name__ == "__main__":
    unittest.main()
