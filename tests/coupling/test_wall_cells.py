"""fix rbc/wall through LAMMPS: a tube of atoms with cells in it, its solves, tasks."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, dump_line
from wall_case import tube, walls

BOX, RADIUS = (20, 24, 24), 8.0
MEMBRANE = ("fix mem cells rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
            "volume yes")
IB = "fix ib cells rbc/ib flow integrator midpoint"
CELLS = dict(groups=f"group w type 2\nmolecule rbc {POTENTIALS}/rbc_162.mol\n"
             "rbc/create rbc single 6 12 12 rotate 30 0 1 0\n"
             "rbc/create rbc single 14 12 12.5 rotate 80 0 1 0\ngroup cells type 1",
             before=MEMBRANE, ib=IB, drive="body 1e-5 0 0", timestep="timestep 400",
             dump=dump_line(10, columns="id mol xu yu zu vx vy vz"))


def tube_with_cells(spacing=1.2, **changes):
    return walls(BOX, tube(BOX, RADIUS, spacing), **{**CELLS, **changes})


class Case(unittest.TestCase):
    def check_same(self, results, *columns):
        """Velocities of the cells, and columns, are those of the first of the results."""
        first, *others = results
        one = first.dump()("vx", "vy", "vz")
        for result in others:
            for column in columns:
                np.testing.assert_allclose(result.thermo[column], first.thermo[column], rtol=1e-6)
            np.testing.assert_allclose(result.dump()("vx", "vy", "vz"), one,
                                       atol=1e-6 * abs(one).max())

    def check_few_solves(self, result):
        self.assertLess(result.thermo["f_w[9]"][-1], 4)
        self.assertLess(result.thermo["f_w[7]"].max(), 1e-3)


class Tube(Case):
    def test_the_wall_bears_what_drives_the_flow(self):
        result = walls(BOX, tube(BOX, RADIUS), drive="body 1e-5 2e-6 0", run="run 3")
        volume = np.prod(BOX)
        self.assertAlmostEqual(result.thermo["f_w[1]"][-1] / (1e-5 * volume), 1, delta=1e-9)
        self.assertAlmostEqual(result.thermo["f_w[2]"][-1] / (2e-6 * volume), 1, delta=1e-9)
        self.assertLess(result.thermo["f_w[7]"][-1], 1e-3)
        self.assertGreater(result.thermo["f_flow[7]"][-1], 0)
        # nothing changes
        self.assertEqual(result.thermo["f_flow[12]"][-1], result.thermo["f_flow[12]"][0])

    def test_changing_drive_costs_few_solves(self):
        result = walls(BOX, tube(BOX, RADIUS), drive="body v_g 0 0",
                       before="variable g equal 1e-5*(1+step)", run="run 10")
        np.testing.assert_array_less(np.diff(result.thermo["f_flow[12]"]), 3)
        np.testing.assert_allclose(result.thermo["f_flow[7]"] / result.thermo["f_flow[7]"][0],
                                   np.arange(1, 12), rtol=2e-3)

    def test_solves_with_cells(self):
        for integrator in ("euler", "midpoint", "ab2", "rkc 5", "rkc auto"):
            with self.subTest(integrator):
                # ab2 is stable for half
                timestep = "timestep 200" if integrator == "ab2" else CELLS["timestep"]
                result = tube_with_cells(ib=f"{IB} integrator {integrator}", timestep=timestep,
                                         run="run 20")
                self.check_few_solves(result)
                table = re.search(r"step cost.*?Total", result.printed, re.DOTALL).group(0)
                self.assertIn("\nWalls ", table)

    def test_solves_with_four_times_the_atoms(self):
        once, four = (tube_with_cells(spacing, run="run 20").thermo["f_w[9]"][-1]
                      for spacing in (1.2, 0.6))
        self.assertLess(four, 1.3 * once)

    def test_same_on_all_tasks(self):
        self.check_same([tube_with_cells(wall="tol 1e-9 maxiter 200", run="run 10", ranks=ranks)
                         for ranks in (1, 2, 4)], "f_w[1]", "f_flow[7]", "f_flow[10]")

    def test_balancing_keeps_the_forces(self):
        plain = tube_with_cells(wall="tol 1e-8 maxiter 200", run="run 12", ranks=2)
        moved = tube_with_cells(wall="tol 1e-8 maxiter 200", run="run 12", ranks=2,
                                ib=IB + "\nfix bal all balance 4 1.0 shift x 10 1.0")
        np.testing.assert_allclose(moved.thermo["f_flow[7]"], plain.thermo["f_flow[7]"], rtol=1e-6)
        self.assertLess(moved.thermo["f_w[9]"][-1], plain.thermo["f_w[9]"][-1] + 20)

    def test_viscous_membranes(self):
        tight, result = (tube_with_cells(before=MEMBRANE + " viscosity 0.3", run="run 5",
                                         wall=f"tol {tol} maxiter 200", ib=IB + " tol 1e-5")
                         for tol in (1e-8, 1e-4))
        for case in (tight, result):
            self.assertNotIn("maxiter", case.printed)
        u = tight.dump()("vx", "vy", "vz", frame=0)
        np.testing.assert_allclose(result.dump()("vx", "vy", "vz", frame=0), u,
                                   atol=1e-3 * abs(u).max())


class Sheets(Case):
    """Atoms of the wall on its surface."""

    def test_same_on_all_tasks(self):
        self.check_same([tube_with_cells(run="run 5", ranks=ranks,
                                         wall="sheets yes tol 1e-9 maxiter 300")
                         for ranks in (1, 2, 4)], "f_flow[7]")

    def test_solves_with_cells(self):
        self.check_few_solves(tube_with_cells(run="run 20", wall="sheets yes"))


if __name__ == "__main__":
    unittest.main()
