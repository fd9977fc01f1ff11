"""What fix rbc/wall refuses, and the walls that it warns of."""

import os
import re
import unittest
from unittest.mock import patch

import numpy as np

from wall_case import BASE, plane, tube, walls


class Spacing(unittest.TestCase):
    """Of the atoms, on lattices that go on through the periodic sides."""
    BOX = (24, 24, 24)

    def warnings(self, across, along, ranks=1, grid="dx 1.0", steps="run 0", wall="", most="2.25"):
        atoms = [(x, y, 12.0) for x in np.arange(0.3, 24, across)
                 for y in np.arange(0.2, 24, along)]
        printed = walls(self.BOX, atoms, ranks=ranks, run=steps, wall=wall,
                        fluid=BASE["fluid"].replace("dx 1.0", grid)).printed
        return re.findall(rf"WARNING: Fix rbc/wall w: (\d+) of (\d+) atoms are more than {most} "
                          r"spacings of the fluid's grid from those beside them \((\S+) in the "
                          r"mean of all\)", printed)

    def test_a_coarse_wall_is_a_warning_on_any_tasks(self):
        for ranks in (1, 2, 4):
            self.assertEqual(self.warnings(3, 3, ranks), [("64", "64", "3")])

    def test_lines_of_close_atoms_are_no_surface(self):
        self.assertEqual(self.warnings(4, 0.5), [("288", "288", "4")])

    def test_counts_in_cells_of_the_grid(self):
        self.assertEqual(self.warnings(3, 6, grid="grid 24 12 24"), [("32", "32", "3")])
        self.assertEqual(self.warnings(1.5, 3, grid="grid 24 12 24"), [])

    def test_a_wall_as_advised_is_none(self):
        for spacing in (1, 1.5, 2):
            self.assertEqual(self.warnings(spacing, spacing), [])

    def test_sheets_must_be_closer(self):
        for spacing, atoms in ((1.5, None), (2, "144")):
            self.assertEqual(self.warnings(spacing, spacing, wall="sheets yes", most="1.75"),
                             [(atoms, atoms, "2")] if atoms else [])

    def test_comes_once(self):
        self.assertEqual(len(self.warnings(3, 3, steps="run 1\nrun 1")), 1)


class Iterations(unittest.TestCase):
    """Of a flow that does not change there are none after the start of a run."""

    def warnings(self, wall, steps):
        box = (8, 8, 8)
        printed = walls(box, tube(box, 3), drive="body 1e-5 0 0", wall=wall, run=steps).printed
        return re.findall(r"WARNING: Fix rbc/wall w reached its maxiter of 2 at the start of the "
                          r"run, with a slip of (\S+)", printed)

    def test_too_few_of_them_at_the_start_of_a_run(self):
        for steps in ("run 0", "run 3"):
            slip, = self.warnings("tol 1e-9 maxiter 2", steps)
            self.assertGreater(float(slip), 1e-9)
            self.assertEqual(self.warnings("tol 1e-9 maxiter 200", steps), [])


class WithoutFluid(unittest.TestCase):
    def test_a_wall_whose_fluid_was_deleted_has_no_numbers(self):
        box = (8, 8, 8)
        ask = "print 'wall $(f_w[1]) $(f_w[7]) $(f_w[9])'"
        with patch.dict(os.environ, MALLOC_PERTURB_="165"):    # what is freed is filled with it
            printed = walls(box, tube(box, 3), drive="body 1e-5 0 0",
                            run=f"run 0\n{ask}\nunfix flow\n{ask}\ninfo memory").printed
        before, after = re.findall(r"^wall (\S+) (\S+) (\S+)$", printed, re.MULTILINE)
        self.assertGreater(float(before[0]), 0)
        self.assertEqual(after, ("0", "0", "0"))


class Errors(unittest.TestCase):
    BOX = (8, 8, 8)

    def check(self, message, **changes):
        surfaces = changes.pop("surfaces", [plane(self.BOX, 4.0)])
        result = walls(self.BOX, *surfaces, tries=True, **changes)
        self.assertTrue(result.code, message)
        self.assertIn(message, result.error)

    def test_arguments(self):
        self.check("Unknown fix rbc/wall keyword slip; allowed: velocity, kernel, sheets, tol, "
                   "maxiter", wall="slip 1")
        self.check("Unknown fix rbc/wall kernel hat; allowed: peskin4, roma3", wall="kernel hat")
        self.check("Expected boolean parameter instead of 'maybe'", wall="sheets maybe")
        self.check("Fix rbc/wall tol value 2 must be between 0 and 1", wall="tol 2")
        self.check("Fix rbc/wall maxiter value 0 must be > 0", wall="maxiter 0")
        self.check("Illegal fix rbc/wall velocity command: missing argument", wall="velocity 1 0")
        self.check("Variable nothing for fix rbc/wall does not exist",
                   wall="velocity v_nothing 0 0")
        self.check("Fix rbc/wall w: there is no fix rbc/fluid with ID water",
                   wall="\nunfix w\nfix w w rbc/wall water")

    def test_groups(self):
        self.check("Fix rbc/wall w: its group has no atoms", groups="group w type 1")
        self.check("Fix rbc/wall v and Fix rbc/wall w have atoms in common",
                   wall="\nfix v all rbc/wall flow kernel peskin4")
        for words in ("tol 1e-4", "kernel peskin4 sheets yes"):
            self.check("Fix rbc/wall v: kernel, sheets, tol and maxiter must be those of Fix "
                       "rbc/wall w", surfaces=[plane(self.BOX, 2.0), plane(self.BOX, 6.0)],
                       groups="group w type 2\ngroup v type 3",
                       wall=f"\nfix v v rbc/wall flow {words}")
        self.check("Fix rbc/ib ib would move atoms of fix rbc/wall w: their groups must have no "
                   "atoms in common", ib="fix ib all rbc/ib flow")

    def test_inertia(self):
        self.check("Fix rbc/wall w needs fix rbc/fluid flow inertia none", drive="inertia unsteady")

    def test_a_response_measured_through_walls_that_leak(self):
        self.check("Fix rbc/fluid flow: how its vessel responds to a flow cannot be measured, as "
                   "Fix rbc/wall w reached its maxiter of 1 with a slip of ",
                   surfaces=[tube(self.BOX, 3.0)], drive="inside tube mean x 1e-3",
                   before="region tube cylinder x 4 4 3 INF INF", wall="tol 1e-6 maxiter 1")

    def test_mean_force_without_walls(self):
        self.check("Fix rbc/fluid mean force needs inertia unsteady or convective, or a fix "
                   "rbc/wall", drive="mean force", wall="\nunfix w",
                   thermo="thermo_style custom step")


if __name__ == "__main__":
    unittest.main()
