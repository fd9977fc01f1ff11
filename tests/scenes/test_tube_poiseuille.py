"""A few cells in a wide tube: they move and turn as the flow around them does."""

import unittest

import numpy as np

from scene_case import run_example, study_of

STUDY = study_of("tube-poiseuille")


class TubePoiseuille(unittest.TestCase):
    def test_sparse_cells_follow_the_flow(self):
        result = run_example("tube-poiseuille", length=9.6, hematocrit=0.05, duration=40000,
                             frames=1000)
        cells = STUDY.Cells(result.folder)
        self.assertLess(abs(cells.volume / cells.volume[0] - 1).max(), 1e-4)
        self.assertGreater(cells.gap.min(), 0)
        self.assertLess(abs(result.thermo["v_mean"] / STUDY.SPEED - 1).max(), 0.01)
        r, rate = cells.r.mean(axis=0), 4 * STUDY.SPEED * cells.r.mean(axis=0) / STUDY.RADIUS**2
        # Faxen: a disc of radius a lags behind the flow at its centre by a^2/6 times its Laplacian,
        # 8 U / R^2
        flow = 2 * STUDY.SPEED * (1 - (r / STUDY.RADIUS)**2)
        lag = STUDY.DISC**2 / 24 * 8 * STUDY.SPEED / STUDY.RADIUS**2
        velocity = cells.velocity[1:].mean(axis=0)
        print(f"\nr {r}, velocity over that of the flow {velocity / flow}, lag over Faxen's "
              f"{(flow - velocity) / lag}")
        self.assertTrue((velocity < flow).all() and (velocity > 0).all())
        free = r < STUDY.RADIUS - 2.5       # a wall nearer than that holds a cell back further
        self.assertTrue(free.any() and (abs((flow - velocity)[free] / lag - 1) < 0.5).all())
        # Jeffery: a disc turns with the vorticity, at a rate between 0 and the shear rate
        turning = np.radians(cells.turned[-1] - cells.turned[0]) / (
            1e3 * (cells.time[-1] - cells.time[0]))
        print(f"turning over shear rate {turning / rate}")
        self.assertTrue((turning[r > 3] < 0.02 * rate[r > 3]).all()
                        and (turning > -rate)[r > 3].all())

    def test_a_more_viscous_inside_takes_more_pressure(self):
        """At step 0 the membrane has no forces. Of two flows at the same rate that with the larger
        viscosity somewhere dissipates more, and less than with that viscosity everywhere."""
        relative = [run_example("tube-poiseuille", length=9.6, hematocrit=0.05, duration=1, every=1,
                                inside=inside).thermo["v_relative"][0]
                    for inside in (0, 1.4965, 7.4825)]
        print(f"\nviscosity at step 0 {relative}")
        self.assertLess(abs(relative[1] / relative[0] - 1), 1e-6)
        self.assertTrue(1.001 * relative[0] < relative[2] < 5 * relative[0])


class Angles(unittest.TestCase):
    def test_a_turning_axis_without_sense(self):
        turned = np.linspace(0, 5, 200)
        outward = np.tile((0.6, 0.8), (200, 1, 1))
        axes = np.stack([np.sin(turned), 0.6 * np.cos(turned), 0.8 * np.cos(turned)],
                        axis=-1)[:, None]
        axes[np.random.default_rng(1).random(200) < 0.5] *= -1
        found = STUDY.in_plane_angle(STUDY.with_sense(axes), outward)[:, 0]
        np.testing.assert_allclose(np.radians(found - found[0]), turned, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
