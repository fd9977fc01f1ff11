"""Blood in a narrow tube, a short run: flow rate, volumes, cells ahead of the plasma; the study's
fits and measures."""

import unittest

import numpy as np

from lammps_case import ROOT
from scene_case import run_example, study_of

STUDY = study_of("fahraeus")


def reference(name):
    lines = [line for line in (ROOT / "examples" / "reference" / name).read_text().splitlines()
             if line[0] != "#"]
    return lines[0].split(","), np.array([line.split(",") for line in lines[1:]], dtype=float)


class Fahraeus(unittest.TestCase):
    def test_plasma_flows_as_poiseuille_says(self):
        for diameter, dx in ((20, 0.6), (10, 0.5)):
            result = run_example("fahraeus", hematocrit=0, diameter=diameter, dx=dx)
            # the wall lies 0.05 um off, see README
            self.assertLess(abs(result.thermo["v_relative"][-1] - 1), 0.02)
            # the slip that walls allow
            self.assertLess(abs(result.thermo["v_mean"][-1] / (diameter * STUDY.RATE) - 1), 1e-3)

    def test_a_cell_in_a_tube_little_wider_runs_ahead_of_plasma(self):
        turns = 2.4    # until it has turned along the axis; at first it is aslant and near the wall
        result = run_example("fahraeus", diameter=9, length=9.6, hematocrit=0.16, turns=turns,
                             every=10, frames=100)
        plasma = run_example("fahraeus", diameter=9, length=9.6,
                             hematocrit=0).thermo["v_relative"][-1]
        case, row = STUDY.measure(result.folder, plasma, diameter=9, length=9.6)
        self.assertEqual(row["cells"], 1)
        self.assertGreater(row["turns"], 0.9 * turns)
        self.assertLess(row["volume"], 1e-4)
        self.assertGreater(row["least_gap"], 0)
        history = STUDY.read_history(result.folder / "tube.dat")
        held = history["v_mean"] / (9 * STUDY.RATE) - 1
        self.assertLess(abs(held[0]), 1e-3)
        self.assertLess(abs(held).max(), 0.02)
        # a cell that fills the tube keeps off the wall only, where the fluid is slow; none is
        # faster than plasma on the axis
        print(f"\ntube over discharge hematocrit {row['ratio_last']:.3f}, viscosity "
              f"{row['viscosity_last']:.3f}")
        self.assertTrue(0.5 < row["ratio_last"] < 1)
        # what disturbs the flow dissipates: never less than plasma alone
        self.assertGreater(case["viscosity"][1:].min(), 1)

    def test_a_more_viscous_inside_takes_more_pressure(self):
        """At step 0 the membrane has no forces. Of two flows at the same rate that with the larger
        viscosity somewhere dissipates more, and less than with that viscosity everywhere."""
        relative = [run_example("fahraeus", diameter=9, length=9.6, hematocrit=0.16, turns=0.01,
                                every=1, inside=inside).thermo["v_relative"][0]
                    for inside in (0, 1.4965, 7.4825)]
        print(f"\nviscosity at step 0 {relative}")
        self.assertLess(abs(relative[1] / relative[0] - 1), 1e-6)
        self.assertTrue(1.001 * relative[0] < relative[2] < 5 * relative[0])


class Measures(unittest.TestCase):
    def test_fits_are_those_of_the_tables(self):
        names, table = reference("07a_pries1992_viscosity_and_fahraeus.csv")
        for percent in (20, 30, 45, 60):
            fit = STUDY.pries_viscosity(table[:, 0], percent / 100)
            np.testing.assert_allclose(fit, table[:, names.index(f"mu_rel_Hd0.{percent}")],
                                       rtol=1e-4)
        names, table = reference("07b_tube_hematocrit_input_cases.csv")
        for diameter, tube, discharge, _, viscosity in table:
            self.assertAlmostEqual(STUDY.pries_discharge(diameter, tube), discharge, delta=1e-4)
            self.assertAlmostEqual(STUDY.pries_viscosity(diameter, discharge), viscosity,
                                   delta=1e-3)

    def test_layer_around_a_cylinder_of_points(self):
        angle, x = np.meshgrid(np.linspace(0, 2 * np.pi, 720, endpoint=False),
                               np.arange(0.05, 10, 0.1))
        points = np.stack([x, 14 + 8 * np.cos(angle), 14 + 8 * np.sin(angle)],
                          axis=-1).reshape(-1, 3)
        self.assertAlmostEqual(STUDY.cell_free_layer(points, 14, 20, 10), 2, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
