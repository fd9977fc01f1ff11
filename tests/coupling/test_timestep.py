"""A timestep that is not above zero is an error, but for the velocities of a configuration."""

import unittest

import numpy as np

from error_case import BadInput
from lammps_case import dump_line, run, scene

IB = "fix ib all rbc/ib flow integrator "


class Timestep(BadInput):
    def test_errors(self):
        midpoint, adaptive = IB + "midpoint", IB + "rkc auto adapt 1e-2 200"
        self.check({f"{dt} {run_line} {ib}": (dict(timestep=f"timestep {dt}", run=run_line, ib=ib),
                                              ["rbc/fluid flow", f"timestep {dt} must be > 0",
                                               "run 0"])
                    for dt, run_line, ib in ((-100, "run 3", midpoint), (-100, "run 0", midpoint),
                                             (0, "run 1", midpoint),
                                             (-1, "run 1", adaptive), (-1, "run 1", None))})

    def test_zero_for_the_velocities_of_a_configuration(self):
        for changes in (dict(), dict(ib=IB + "euler"), dict(ib=IB + "rkc auto adapt 1e-2 200")):
            zero, short = (
                run(scene(**{**dict(ib=IB + "midpoint", timestep=f"timestep {dt}",
                                    dump=dump_line(1, columns="id vx vy vz")),
                             **changes})).dump()("vx", "vy", "vz")
                for dt in (0, 1e-3))
            self.assertTrue(np.isfinite(zero).all())
            self.assertGreater(abs(zero).max(), 1e-4)
            np.testing.assert_allclose(zero, short, rtol=0, atol=1e-10 * abs(short).max())

    def test_one_that_was_not_given_is_warned_of(self):
        """With adapt it is only the first."""
        adaptive = IB + "rkc auto adapt 1e-2 200"
        for timestep, ib, warned in ((None, IB + "midpoint", True), (None, adaptive, False),
                                     ("timestep 2", IB + "midpoint", False)):
            printed = run(scene(timestep=timestep, ib=ib, run="run 1\nrun 1")).printed
            self.assertEqual(printed.count("WARNING: Fix rbc/ib ib: no timestep was given, so it "
                                           "is LAMMPS's own for units micro, 2; "), 2 * warned)


if __name__ == "__main__":
    unittest.main()
