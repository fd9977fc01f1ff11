"""A small part of the suspension, without adhesion and with it."""

import re
import sys
import unittest

import numpy as np

from lammps_case import ROOT, in_parallel
from scene_case import polyhedron, run_example

SMALL = dict(cells=12, gap=12, strain=0.4, every=1, frames=1000)
sys.path[:0] = [str(ROOT / "examples" / "suspension"), str(ROOT / "scripts")]
import rates  # noqa: E402

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


class Measurements(unittest.TestCase):
    def test_chien_in_plasma_and_without_aggregation(self):
        """Both thin; aggregates make blood more viscous below 3 /s only (Chien 1970)."""
        plasma, albumin = rates.chien("plasma"), rates.chien("albumin")
        for points in (plasma, albumin):
            self.assertEqual(points.shape, (2, 15))
            self.assertTrue((np.diff(points[0]) > 0).all() and (np.diff(points[1]) < 0).all())
        self.assertTrue((plasma[1] > albumin[1])[plasma[0] < 3].all())
        self.assertTrue((plasma[1] < albumin[1])[plasma[0] > 5].all())

    def test_the_fit_has_its_limits(self):
        for rate, viscosity in ((0, 56), (1e12, 3.45)):
            self.assertAlmostEqual(rates.cho_kensey(rate) * rates.PLASMA, viscosity, delta=1e-3)

    def test_wells_and_merrill_between_their_own_hematocrits(self):
        self.assertTrue(np.allclose(rates.wells_merrill(33, 33, 57)[1] * rates.PLASMA,
                                    [6.9063, 5.6254, 3.6918, 3.0634]))
        self.assertTrue(np.allclose(rates.wells_merrill(57, 33, 57)[1] * rates.PLASMA,
                                    [16.912, 12.489, 8.5498, 7.8006]))

    def test_means_over_shares_of_the_strain(self):
        sheared = np.linspace(0, 5.01, 502)
        table = {"v_sheared": sheared, "v_relative": 3 + sheared}
        self.assertAlmostEqual(rates.settled(table, 5), 3 + (3.01 + 5.01) / 2, delta=1e-9)
        self.assertAlmostEqual(rates.mean_viscosity(table, 5, 0.4, 0.6), 3 + 2.505, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
