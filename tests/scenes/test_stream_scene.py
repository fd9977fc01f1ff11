"""Cells that enter a tube and leave it: the account of them, and what study.py makes of it."""

import unittest

import numpy as np

from scene_case import polyhedron, run_example, study_of


class Stream(unittest.TestCase):
    def test_first_steps(self):
        self.check(study_of("stream").STREAM, 0.3 * 0.8, 2, transits=0.12)

    def test_first_steps_of_40_percent(self):
        """There is a gap between the cells that are there and the first copies."""
        self.check(study_of("stream").DENSE, 0.3, 4, transits=0.09, dense=1)

    def check(self, scene, way, most_owed, **variables):
        study = study_of("stream")
        result = run_example("stream", every=1, frames=1000, **variables)
        rows = study.read(result.path("stream.dat"), scene)
        transits, entered, left, inside, owed = rows[:, :5].T
        self.assertAlmostEqual(study.VOLUME / polyhedron("rbc_162")[1], 1, delta=1e-4)
        steps = np.arange(1, len(rows) + 1)
        np.testing.assert_allclose(transits, steps * way / scene.length, rtol=1e-4)
        # nothing is lost by counting
        wanted = scene.hematocrit * transits * scene.tube / study.VOLUME
        np.testing.assert_allclose(entered + owed, wanted, atol=1e-3)
        self.assertLess(abs(owed).max(), most_owed)
        self.assertGreaterEqual(entered[-1], 5)
        self.assertGreaterEqual(left[-1], 1)
        self.assertEqual(len(set(inside - entered + left)), 1)
        entering, leaving = study.discharge(rows, transits[0], transits[-1], scene)
        passed = (transits[-1] - transits[0]) * scene.tube
        self.assertAlmostEqual(entering * passed / study.VOLUME, entered[-1] - entered[0])
        self.assertAlmostEqual(leaving * passed / study.VOLUME, left[-1] - left[0])


if __name__ == "__main__":
    unittest.main()
