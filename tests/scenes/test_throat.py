"""Cells in a short vessel with a throat and in a straight one: flow rates against closed forms,
cells stay in and are counted."""

import sys
import unittest

import numpy as np

from lammps_case import ROOT, in_parallel, run
from scene_case import example_script, run_example, shortened

sys.path.insert(0, str(ROOT / "scripts"))
from rbc.tables import read_table  # noqa: E402

SMALL = dict(length=4, width=2, hematocrit=0.15, dx=0.8, gradient=1e5, rate=150, step=0.02,
             error=5e-3, duration=0.012, every=1, scripts=ROOT / "scripts")
DIAMETER, VISCOSITY = 8, 1.4965
CELL = 92.836    # um^3 of rbc_642


def throat_radius(x, throat):
    """As scripts/make_vessel.py makes it: straight for a fifteenth, tapers of two fifteenths on
    both sides."""
    length, wide, narrow = (SMALL["length"] * DIAMETER, SMALL["width"] * DIAMETER / 2,
                            throat * DIAMETER / 2)
    along = np.clip((np.abs(x - length / 2) - length / 30) / (2 * length / 15), 0, 1)
    return narrow + (wide - narrow) * (1 - np.cos(np.pi * along)) / 2


def plasma_velocity(throat):
    """Mean velocity (um/s) in all of the vessel, and its volume, were the flow that of Poiseuille
    in every section."""
    length = SMALL["length"] * DIAMETER
    x = (np.arange(4000) + 0.5) * length / 4000
    radius = throat_radius(x, throat)
    volume = np.pi * (radius**2).mean() * length
    pressure = SMALL["gradient"] * 1e-9    # kPa/um
    return np.pi * pressure / (8 * VISCOSITY * (radius**-4).mean()) * length / volume * 1e6, volume


class Throat(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.throats = 2, 1.2    # diameters of a cell; the first is the straight tube
        cls.results = in_parallel(lambda throat, ranks: run_example("throat", ranks, throat=throat,
                                                                    **SMALL),
                                  list(zip(cls.throats, (1, 2))))
        cls.tables = [read_table(result.path("blocks.dat")) for result in cls.results]

    def test_flow_rate(self):
        # at first cells are free of stress, and the flow is that of plasma
        straight, throat = (table["v_u"][0] / plasma_velocity(width)[0]
                            for table, width in zip(self.tables, self.throats))
        print(f"\nvelocity over that of Poiseuille's law: straight {straight:.4f}, throat "
              f"{throat:.4f}")
        self.assertLess(abs(straight - 1), 0.01)
        # the throat resists more than the sum of its sections, as flow has to turn
        self.assertLess(throat, 1)
        self.assertGreater(throat, 0.75)

    def test_cells_are_counted_and_kept(self):
        for result, table, width in zip(self.results, self.tables, self.throats):
            cells = sum(table[f"v_block{n}"] for n in range(3))
            self.assertEqual(set(cells),
                             {round(SMALL["hematocrit"] * plasma_velocity(width)[1] / CELL)})
            thermo = result.thermo
            self.assertLess(thermo["c_r"].max(), 1)
            self.assertLess(thermo["v_spread"].max(), 1e-3)
            # cells are carried with the flow, on the whole
            gone = (table["v_passed"][-1] - table["v_passed"][0]) * SMALL["length"] * DIAMETER
            carried = (np.trapezoid(table["v_u"], table["v_seconds"])
                       if hasattr(np, "trapezoid") else np.trapz(
                table["v_u"], table["v_seconds"]))
            print(f"\ncells went {gone:.2f} um, the fluid {carried:.2f} um")
            self.assertGreater(gone, 0.7 * carried)
            self.assertLess(gone, 2 * carried)

    def test_same_on_all_tasks(self):
        # packed cells, in contact with each other and the wall, in a mesh's inside; adaptive
        # timesteps
        steps = 20
        script = shortened(example_script("throat", **{**SMALL, "throat": 1.2, "hematocrit": 0.3}),
                           "cells", steps, steps)
        dumps = [run(script, ranks, timeout=500).dump() for ranks in (1, 2, 4)]
        alone = dumps[0].positions()
        moved = np.linalg.norm(alone - dumps[0].positions(0), axis=1).max() / DIAMETER
        self.assertGreater(moved, 0.05)
        for dump in dumps[1:]:
            apart = np.linalg.norm(dump.positions() - alone, axis=1).max() / DIAMETER
            print(f"\nmoved by up to {moved:.3g} diameters, {apart:.2g} diameters from 1 task")
            self.assertLess(apart, 1e-10)


if __name__ == "__main__":
    unittest.main()
