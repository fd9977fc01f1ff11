"""The fluid's grid among what LAMMPS does to its box and its MPI tasks: subdomains without a row of
cells, too little memory, a box, a boundary or a skin that the grid does not go with."""

import os
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

from error_case import BadInput
from lammps_case import SHEAR, attempt, dump_line, in_parallel, run, scene

# Beads that push on the fluid, each with a force of its own.
BEADS = {
    "units": "units micro",
    "boundary": "boundary p p p",
    "processors": "",
    "box": "region box block 0 8 0 8 0 8",
    "create_box": "create_box 1 box\nmass 1 1",
    "atoms": "\n".join("create_atoms 1 single {:.6f} {:.6f} {:.6f}".format(*x)
                       for x in np.random.default_rng(3).uniform([0, 0, 0.5], [8, 8, 7.5],
                                                                 (50, 3))),
    "balance": "",
    "force": "variable fx atom sin(x+z)\nvariable fz atom cos(y)\n"
             "fix push all addforce v_fx 0 v_fz",
    "fluid": "fix flow all rbc/fluid dx 2.0 viscosity 1 density 1",
    "ib": "fix ib all rbc/ib flow kernel peskin4", "neighbor": "neighbor 1.0 bin",
    "thermo": "thermo_style custom step f_flow[10]\nthermo_modify format float %.17g",
    "dump": dump_line(2, columns="id xu yu zu vx vy vz") +
            "\ndump grid all grid 4 grid.dump f_flow:grid:velocity[*] f_flow:grid:pressure"
            "\ndump_modify grid format float %.17g",
    "timestep": "timestep 1",
    "run": "run 4"}

WALLS = {"boundary": "boundary p p p",
         "box": "region box block 0 24 0 24 0 24", "create_box": "create_box 1 box",
         "atoms": "region ball sphere 12.1 12.2 12.3 7.4\n"
                  "rbc/surface ball type 1 spacing 2.4 mass 1.0", "force": None, "neighbor": None,
         "timestep": None,
         "fluid": "fix flow all rbc/fluid grid 6 6 6 viscosity 1.2 density 1.0 mean 0.001 0 0",
         "ib": "fix ball all rbc/wall flow tol 1e-10",
         "thermo": "thermo_style custom step f_ball[1]\nthermo_modify format float %.17g",
         "dump": None, "run": "run 0"}

PLATES = {"boundary": "boundary p p f"}
PLATES["fluid"] = BEADS["fluid"] + " wall zlo 0 0 0 wall zhi 0.1 0 0"


class ThinSubdomains(unittest.TestCase):
    """What MPI tasks compute does not depend on how many there are, some without a centre of a
    cell."""

    def agree(self, ranks, changes, **by_ranks):
        one, many = in_parallel(run, [(scene(BEADS, **changes), 1),
                                      (scene(BEADS, **{**changes, **by_ranks}), ranks)])
        for name in ("v", "x"):
            columns = [c for c in one.dump().columns if c.startswith(name)]
            a, b = one.dump()(*columns), many.dump()(*columns)
            self.assertGreater(np.ptp(a), 0)
            np.testing.assert_allclose(b, a, rtol=0, atol=1e-11 * np.abs(a).max())
        for a, b in zip(one.dump("grid.dump").frames, many.dump("grid.dump").frames):
            # ranks write their cells one after the other
            a, b = np.sort(a, axis=0), np.sort(b, axis=0)
            np.testing.assert_allclose(b, a, rtol=0, atol=1e-11 * np.abs(a).max())

    def test_more_tasks_than_rows_in_z(self):
        self.agree(5, {}, processors="processors 1 1 5")

    def test_more_tasks_than_rows_in_x(self):
        self.agree(5, {}, processors="processors 5 1 1")

    def test_between_plates(self):
        self.agree(6, PLATES, processors="processors 1 1 6")

    def test_with_inertia(self):
        self.agree(5, {**PLATES, "fluid": PLATES["fluid"] + " inertia convective"},
                   processors="processors 1 1 5")

    def test_sheets(self):
        self.agree(5, {"ib": BEADS["ib"] + " sheets yes"}, processors="processors 1 5 1")

    def test_markers_with_mass(self):
        self.agree(5, {"fluid": BEADS["fluid"] + " inertia unsteady",
                       "ib": BEADS["ib"] + " scheme direct tol 1e-12"},
                   processors="processors 1 1 5")

    def test_balance_makes_slabs_thinner_than_a_row(self):
        self.agree(4, {}, processors="processors 1 1 4", balance="balance 1.0 z 0.40 0.45 0.49")
        self.agree(4, {}, processors="processors 1 1 4", balance="balance 1.0 z 0.40 0.45 0.49",
                   fluid=BEADS["fluid"] + "\nbalance 1.0 z 0.01 0.02 0.03\n"
                                          "balance 1.0 z 0.96 0.97 0.98")

    def test_walls(self):
        drags = in_parallel(
            lambda ranks: run(scene(BEADS, **WALLS, processors=f"processors 1 1 {ranks}"),
                              ranks).thermo["f_ball[1]"],
            [(ranks,) for ranks in (1, 8, 12)])
        self.assertGreater(drags[0], 0)
        np.testing.assert_allclose(drags, [drags[0]] * 3, rtol=1e-8)


class Sizes(unittest.TestCase):
    def test_grid_made_finer_is_told(self):
        """22 is 2 times 11: the next number without prime factors above 7 is 24; 21 is one."""
        box = dict(box="region box block 0 21 0 22 0 22", fluid=BEADS["fluid"].replace("2.0", "1"))
        self.assertIn("for fast Fourier transforms the grid is made a little finer than dx 1 asks "
                      f"for: 21 x 24 x 24 cells, spacing 1 {22 / 24:.6g} {22 / 24:.6g}\n",
                      run(scene(BEADS, **box, run="run 0")).printed)
        self.assertNotIn("Fourier", run(scene(BEADS, run="run 0")).printed)


class TooLittleMemory(unittest.TestCase):
    """A task without memory ends the run of all with an error that says so."""

    def attempt(self, script, ranks, poor, limit):
        wrapper = Path.cwd() / f"poor{poor}"
        wrapper.write_text("#!/bin/sh\n"
                           f"[ ${{OMPI_COMM_WORLD_RANK:-{poor}}} = {poor} ] && ulimit -v {limit}\n"
                           f"exec {os.environ['LMP_RBC']} \"$@\"\n")
        wrapper.chmod(0o755)
        with mock.patch.dict(os.environ, LMP_RBC=str(wrapper)):
            result = attempt(script, ranks, timeout=60)
        self.assertNotEqual(result.code, 0)
        self.assertNotIn("signal", result.printed.lower())
        return result

    def test_grid(self):
        fine = SHEAR["fluid"].replace("dx 1.0", "dx 0.06")
        for ranks, poor in (1, 0), (2, 1):
            result = self.attempt(scene(fluid=fine), ranks, poor, 600000)
            self.assertRegex(result.error, "Fix rbc/fluid flow: not enough memory for a grid of "
                                           "200 x 200 x 200 fluid "
                             rf"cells with \d+ ghost layers on 1 of {ranks} MPI task")


class ChangedAfterwards(BadInput):
    def test_messages(self):
        self.check({
            "boundary": (dict(last="change_box all boundary p p p"),
                         ["Fix rbc/fluid flow", "z was fixed", "is periodic now"]),
            "boundary that shrinks": (dict(last="change_box all boundary p p s"),
                                      ["rbc/fluid", "periodic or fixed"]),
            "boundary in x": (dict(last="change_box all boundary f p f"),
                              ["rbc/fluid", "periodic", "x and y"]),
            "box": (dict(last="change_box all z final 0 14"),
                    ["Fix rbc/fluid flow", "box has changed"]),
            "scaled": (dict(last="change_box all x scale 1.1 remap"),
                       ["Fix rbc/fluid flow", "box has changed"]),
            "triclinic": (dict(last="change_box all triclinic", membrane=None, thermo=None),
                          ["rbc/fluid", "orthogonal"]),
            "deform": (dict(last="fix shape all deform 1 x scale 1.1"),
                       ["rbc/fluid", "changing simulation box"]),
            "barostat": (dict(last="fix press all press/berendsen x 1 1 1000"),
                         ["rbc/fluid", "changing simulation box"]),
            "skin": (dict(neighbor="neighbor 12.5 bin"),
                     ["Fix rbc/fluid flow", "skin of 12.5", "6.25 ghost layers",
                      "12 fluid cells in x", "<= 12"]),
            "skin between runs": (dict(last="run 0\nneighbor 13 bin"),
                                  ["Fix rbc/fluid flow", "skin of 13"])})

    def test_averages_while_the_grid_moves(self):
        average = "fix mean all ave/grid 1 2 2 12 12 12 f_flow:grid:velocity[1]\n"
        self.check({
            "fix balance": (dict(processors="processors 2 1 1",
                                 last=average + "fix even all balance 5 1.0 shift xyz 10 1.0"),
                            ["Fix rbc/fluid flow", "fix ave/grid mean", "balance"]),
            "balance": (dict(processors="processors 2 1 1",
                             last=average + "run 0\nbalance 1.0 x 0.3"),
                        ["Fix rbc/fluid flow", "fix ave/grid mean", "balance"])}, ranks=2)


if __name__ == "__main__":
    unittest.main()
