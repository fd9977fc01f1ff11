"""The tutorial about a vessel from a file: a cell through a throat, at the flow rate asked for."""

import math
import unittest

import numpy as np
from scene_case import polyhedron
from tutorial_case import follow

MEAN, LENGTH, VOLUME = 5.0e-4, 48, 4224.37     # of the vessel's inside, as its file has it
WIDE, NARROW = 12, 5


class Tutorial(unittest.TestCase):
    def test_follows_the_page(self):
        folder, results = follow("tutorial_vessel", "throat", tolerance=0.02)
        self.assertGreater((folder / "cell.png").stat().st_size, 10000)
        table = results[1].thermo
        rate = MEAN * VOLUME / LENGTH * 1e3
        np.testing.assert_allclose(table["v_rate"], rate, rtol=0.01)
        np.testing.assert_allclose(table["v_volume"], polyhedron("rbc_162")[1], rtol=5e-4)
        # on the axis a cell is faster than the mean, and slower than plasma alone would be
        along, speed = table["v_along"], table["v_speed"]
        for diameter, first, last in ((WIDE, 9, 12), (NARROW, 24, 25)):
            mean = rate / (math.pi / 4 * diameter**2)
            inside = (along > first) & (along < last)
            self.assertTrue(inside.any())
            self.assertTrue(np.all((speed[inside] > mean) & (speed[inside] < 2 * mean)))
        # it takes more pressure to get in
        self.assertGreater(table["v_drive"].max(), 1.2 * table["v_drive"][0])
        self.assertGreater(along[-1], 37)


if __name__ == "__main__":
    unittest.main()
