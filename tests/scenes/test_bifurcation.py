"""Cells in a vessel that parts: the mean velocity asked for, and about the pressure of
Poiseuille."""

import unittest

import numpy as np

from lammps_case import ROOT
from scene_case import polyhedron, run_example

MEAN, VISCOSITY, LENGTH, RADIUS = 2.0e-4, 1.4965, 60, 8


class Bifurcation(unittest.TestCase):
    def test_flow_and_cells(self):
        result = run_example("bifurcation", 2, steps=10, scripts=ROOT / "scripts")
        self.assertNotIn("WARNING", result.printed)
        table = result.thermo
        self.assertLess(abs(table["f_flow[13]"] / MEAN - 1).max(), 0.01)
        rate = table["f_flow[16]"]
        volume = rate * LENGTH / table["f_flow[13]"]
        # in the stem the gradient is that of Poiseuille's law, in the two branches of Murray's
        # diameter 2^(1/3) times it
        driven = table["f_flow[19]"][0] / (8 * VISCOSITY * rate[0] / (np.pi * RADIUS**4))
        print(f"\ngradient over that in a straight tube {driven:.4f}")
        self.assertGreater(driven, 0.95)
        self.assertLess(driven, 1.1 * 2**(1 / 3))
        # cells that are deformed take more; they stay whole
        self.assertTrue(np.all(np.diff(table["f_flow[19]"]) > 0))
        cell = polyhedron("rbc_162")[1]
        count = round(0.2 * volume[0] / cell)
        np.testing.assert_allclose(table["v_now"], count * cell / volume, rtol=1e-3)


if __name__ == "__main__":
    unittest.main()
