"""A cell in sheared plasma whose inside is more viscous than the plasma: bounds of the stress, and
a cell so viscous that it keeps its shape."""

import unittest

import numpy as np

from lammps_case import in_parallel
from scene_case import polyhedron, run_example, study_of

STUDY = study_of("shear-cell")
SMALL = dict(shape="rbc_162", dx=0.8)
PLASMA = 1.4965                         # of healthy.material
FILLED = polyhedron("rbc_162")[1] / 24**3


class Inside(unittest.TestCase):
    def test_stress_is_within_the_bounds_of_two_liquids(self):
        """At step 0 the membrane has no forces. The stress is then that of two liquids, between the
        bounds of Reuss and Voigt for any shape: the viscosity's harmonic and its plain mean."""
        for ratio in (1, 5, 20):
            result = run_example("shear-cell", **SMALL, strain=0.05, inside=ratio * PLASMA)
            stress = result.thermo["f_flow[1]"][0] / (PLASMA * 100e-6)
            least, most = 1 / (1 - FILLED * (1 - 1 / ratio)), 1 + FILLED * (ratio - 1)
            print(f"\nratio {ratio}: {least:.5f} <= {stress:.5f} <= {most:.5f}")
            self.assertTrue(least - 1e-6 <= stress <= most + 1e-6)

    def test_a_cell_of_the_medium_is_the_same_and_one_far_more_viscous_keeps_its_shape(self):
        def measure(inside):
            return STUDY.measure(run_example("shear-cell", **SMALL, strain=2, inside=inside).folder)

        insides = [(ratio * PLASMA,) for ratio in (0, 1, 500)]
        without, same, viscous = in_parallel(measure, insides)
        for name, value in without.items():
            if name != "volume":
                np.testing.assert_allclose(same[name], value, rtol=1e-4, err_msg=name)
        drawn = [row["largest_D"] - row["least_D"] for row in (without, viscous)]
        apart = [abs(row["membrane"] - row["shape"]) for row in (without, viscous)]
        print(f"\nD changes by {drawn}, shape and membrane differ by {apart}")
        self.assertLess(drawn[1], 0.01 * drawn[0])
        self.assertLess(apart[1], 0.2 * apart[0])


if __name__ == "__main__":
    unittest.main()
