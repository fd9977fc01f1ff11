"""A closed tube between two ports: Poiseuille's law, and better on a finer grid."""

import unittest

from scene_case import run_example, study_of


class Ports(unittest.TestCase):
    def test_flow_in_the_tube(self):
        study = study_of("ports")
        errors = []
        for dx in (1.6, 0.8):
            result = run_example("ports", dx=dx)
            profile, gradient, entered, halfway = study.measure(
                study.Grid(result.path("flow.grid")), dx, study.LENGTH)
            print(f"\ndx {dx}: profile {profile:.2%}, gradient {gradient:+.2%}, flow "
                  f"{entered:+.2%} {halfway:+.2%}")
            errors.append((profile, abs(gradient), abs(halfway)))
            last = result.thermo
            self.assertLess(last["f_flow[11]"][0], 1e-13)
            # a port counts with a part of its length
            pressure = last["f_in[2]"][0] / study.GRADIENT
            self.assertGreater(pressure, study.LENGTH - 1.25 * study.DIAMETER)
            self.assertLess(pressure, study.LENGTH - study.DIAMETER)
        self.assertLess(abs(halfway - entered), 1e-4)    # what passes the wall on the finer grid
        for coarse, fine in zip(*errors):
            self.assertLess(fine, coarse / 2)
            self.assertLess(fine, 0.01)


if __name__ == "__main__":
    unittest.main()
