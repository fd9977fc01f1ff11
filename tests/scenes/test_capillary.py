"""A red cell with a viscous inside in a channel, a short run; the flow of the empty channel."""

import sys
import unittest

import numpy as np

from lammps_case import ROOT, in_parallel
from scene_case import run_example, study_of

sys.path.insert(0, str(ROOT / "scripts"))
from rbc.tables import read_ave_time, read_table  # noqa: E402

STUDY = study_of("capillary")


class Capillary(unittest.TestCase):
    def test_the_empty_channel_flows_as_the_series_says(self):
        spacings = np.array([12 / 18, 12 / 24])
        drives = [run_example("capillary", cells=0, speed=1, dx=dx).thermo["v_drive"][-1]
                  for dx in spacings]
        errors = np.array(drives) / STUDY.duct_drive(1e-3) - 1
        coarse, fine = spacings**2
        limit = (coarse * errors[1] - fine * errors[0]) / (coarse - fine)
        print(f"\nforce density of the empty channel: {1e2 * errors} % off, extrapolated "
              f"{1e2 * limit:.3f} %")
        self.assertLess(abs(errors[0]), 0.015)
        self.assertLess(abs(limit), 1e-3)

    def test_mirrored_starts(self):
        signs = 1, -1
        results = in_parallel(
            lambda sign, ranks: run_example("capillary", ranks, speed=2, offset=sign * 1.5,
                                            tilt=sign * 50, travel=0.6, every=4),
            list(zip(signs, (1, 2))))
        paths = [read_table(result.path("channel.dat")) for result in results]
        for name, sign in (("v_y", -1), ("v_z", 1), ("v_u", 1)):
            difference = abs(paths[0][name] - sign * paths[1][name]).max()
            print(f"\n{name}: {difference:.2e} apart where mirrored")
            # the atoms of the walls are not mirrored
            self.assertLess(difference, 5e-3 if name != "v_u" else 2e-5)
        for path, result in zip(paths, results):
            self.assertGreater(abs(np.ptp(path["v_y"])), 1e-2)
            self.assertLess(abs(path["v_mean"][1:] / 2e-3 - 1).max(), 0.01)
            volume = read_ave_time(result.path("cell.dat")).column(6)[:, 0]
            self.assertLess(abs(volume / volume[0] - 1).max(), 1e-4)
            # what disturbs the flow dissipates: more force than plasma alone takes; no cell
            # overtakes the plasma on the axis
            self.assertGreater(path["v_drive"].min(), STUDY.duct_drive(2e-3))
            self.assertTrue(2e-3 < path["v_u"].min() < path["v_u"].max() < 2 * 2.1e-3)


class Measures(unittest.TestCase):
    def test_force_density_of_a_square_duct(self):
        self.assertAlmostEqual(1e-3 / (STUDY.duct_drive(1e-3, 10, 10, 1.2) * 100 / 1.2),
                               0.035144254, delta=1e-8)


if __name__ == "__main__":
    unittest.main()
