"""A red cell in a viscous medium, on a coarse mesh: its membrane runs around a shape that holds its angle."""

import unittest

from scene_case import run_example, study_of

STUDY = study_of("tank-treading")


class TankTreading(unittest.TestCase):
    def test_membrane_goes_around(self):
        result = run_example("tank-treading", shape="rbc_162", dx=1, rate=131.59, strain=30, step=0.1)
        frequency, angle, angle_range = STUDY.motion(result.folder, 0.1, start=15)
        print(f"\n{frequency:.4f} revolutions per strain, inclination {angle:.1f}, range {angle_range:.1f} degrees")
        # a rigid body would go around 1/(4 pi) = 0.08 times at most and turn its angle by 180 degrees and more
        self.assertLess(angle_range, 90)
        self.assertTrue(0 < angle < 45)
        self.assertTrue(0.015 < frequency < 1 / (4 * 3.14159))
        self.assertLess(abs(result.thermo["c_cell[1][6]"][-1] / result.thermo["c_cell[1][6]"][0] - 1), 1e-3)


if __name__ == "__main__":
    unittest.main()
