"""The tutorial about cells of a file in a tube: flow rate, profile, hematocrits, restart."""

import math
import re
import unittest

import numpy as np
import rbc
from scene_case import polyhedron
from tutorial_case import follow

CELLS, RADIUS, LENGTH, FLOW = 20, 10, 32, 250    # um, um^3/ms


class Tutorial(unittest.TestCase):
    def test_follows_the_page(self):
        folder, (whole, profile, later) = follow("tutorial_pipe", "fahraeus", tolerance=0.02)
        self.assertNotIn("WARNING", whole.printed)
        table, volume = whole.thermo, polyhedron("rbc_162")[1]
        np.testing.assert_allclose(table["v_rate"], FLOW, rtol=5e-3)
        np.testing.assert_allclose(table["v_tube"], CELLS * volume / (math.pi * RADIUS**2 * LENGTH),
                                   rtol=1e-3)
        # the volume of cells that passes a section, by how far their centres came in 20 steps
        steps = table["Step"]
        first, last = (rbc.shapes_of(folder / f"cells.{step}.vtp") for step in (180, 200))
        moved = [(last[cell].centre[0] - first[cell].centre[0]) % LENGTH for cell in first]
        passed = volume * sum(moved) / LENGTH / (FLOW * (table["v_ms"][-1] - table["v_ms"][-2]))
        self.assertAlmostEqual(passed / table["v_discharge"][steps >= 180].mean(), 1, delta=0.02)
        # rings of the profile carry the flow rate; cells make it blunt
        rows = np.array([re.findall(r"[\d.]+", line) for line in profile.printed.splitlines()],
                        dtype=float)
        area = 2 * math.pi * rows[:, 0]
        self.assertAlmostEqual((area * rows[:, 1]).sum() / FLOW, 1, delta=0.02)
        self.assertLess(rows[0, 1], 0.9 * rows[0, 2])
        for step in (120, 200):
            for name in ("v_drive", "v_discharge"):
                self.assertEqual(later.thermo[name][later.thermo["Step"] == step],
                                 table[name][steps == step])


if __name__ == "__main__":
    unittest.main()
