"""A small part of the suspension, without adhesion and with it."""

import re
import unittest

import numpy as np

from lammps_case import in_parallel
from scene_case import polyhedron, run_example

SMALL = dict(cells=12, gap=12, strain=0.4, every=1, frames=1000)
HEMATOCRIT = 0.45
WORKS = 0, 2.0e-4


class Suspension(unittest.TestCase):
    def test_viscosity_hematocrit_and_adhesion(self):
        results = in_parallel(lambda work: run_example("suspension", **SMALL, sigma=work),
                              [(work,) for work in WORKS])
        for work, result in zip(WORKS, results):
            with self.subTest(work):
                table = result.thermo
                self.assertAlmostEqual(table["v_sheared"][-1], SMALL["strain"], delta=0.03)
                corner = re.search(r"box = \(0 0 0\) to \((.*)\)", result.printed)[1]
                box = np.prod([float(edge) for edge in corner.split()])
                filled = SMALL["cells"] * polyhedron("rbc_162")[1] / box
                self.assertAlmostEqual(filled, HEMATOCRIT, delta=5e-5)
                np.testing.assert_allclose(table["v_filled"], filled, rtol=2e-4)
                self.assertIn(f"work per area {work:g}", result.printed)
                # more than cells far apart, Einstein's 1 + 2.5 phi, once they are under way;
                # the viscosity measured of such blood is below 10 times that of plasma
                late = table["v_relative"][len(table["v_relative"]) // 2:]
                self.assertGreater(late.min(), 1 + 2.5 * HEMATOCRIT)
                self.assertLess(late.max(), 10)


if __name__ == "__main__":
    unittest.main()
