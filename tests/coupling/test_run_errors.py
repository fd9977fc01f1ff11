"""What stops a run: the message says the step, the cell and its position."""

import unittest

import numpy as np

from error_case import DuringARun
from lammps_case import POTENTIALS, SHEAR, attempt, read_template, scene


def through_its_neighbours():
    """One vertex moves across the opposite edge of a triangle."""
    corners, triangles = read_template(POTENTIALS / "rbc_162.mol")
    i, j, k = triangles[0]
    move = 1.3 * ((corners[j] + corners[k]) / 2 - corners[i])
    return f"group one id {i + 1}\ndisplace_atoms one move {move[0]} {move[1]} {move[2]}"


class Stops(DuringARun):
    def test_timestep_too_large(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, _, where = self.check(["rbc/ib ib", "CFL above 1", "timestep", "molecule ID 1",
                                          "atom ID"],
                                         ranks, earliest=0, timestep="timestep 20000", dumped=False)
                self.assertTrue(((where > -1) & (where < 13)).all())

    def test_speed_above_a_cell_per_step_later(self):
        self.check(["rbc/ib ib", "CFL above 1", "molecule ID 1"], earliest=15, latest=25,
                   fluid="variable U equal 0.0012*(1+0.25*step)\n" +
                   SHEAR["fluid"].replace("0.0012", "v_U"))

    def test_convective_flow_too_fast(self):
        # the plate speeds up to a cell a step in step 9
        for regime, ranks in (("convective", 2), ("convective scheme projection", 1)):
            with self.subTest(regime, ranks=ranks):
                _, _, where = self.check(
                    ["rbc/fluid flow", "CFL above 1", "inertia convective"], ranks, 8, 10,
                    fluid="variable U equal 0.0006*(1+step)\n" + SHEAR["fluid"].replace(
                        "0.0012", "v_U").replace("none", regime))
                self.assertEqual(where[2], 11.5)

    def test_a_force_that_is_not_a_number(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["rbc/", "not a number", "molecule ID 1"], ranks, earliest=6, latest=7,
                           before="variable big equal ternary(step>5,1e200,0)\n"
                                  "variable f equal v_big*v_big\nfix bad all addforce v_f 0 0")

    def test_a_position_that_is_not_a_number(self):
        result = attempt(
            scene(last="variable bad atom 0.0/0.0\nvariable bad atom (1e200*id)*(1e200*id)*0\n"
                  "set atom 5 x v_bad", run="run 10"))
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertRegex(result.error.lower(), "not a number|non-numeric|numeric|nan")

    def test_inverted_triangle(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["rbc/membrane mem", "triangle", "inverted", "molecule ID 1"], ranks,
                           earliest=0, dumped=False, last=through_its_neighbours(), run="run 10",
                           cells="rbc/create rbc single 6 6 6")

    def test_cell_turned_inside_out(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, _, where = self.check(
                    ["rbc/membrane mem", "inside out", "molecule ID 1"], ranks, earliest=0,
                    last="variable x atom 12-x\nset group all x v_x", dumped=False)
                np.testing.assert_allclose(where, 6, atol=0.5)

    def test_vertex_pushed_through_a_plate(self):
        # a cell that swells back to its volume right above the plate
        corners, _ = read_template(POTENTIALS / "rbc_162.mol")
        shrink = 0.98
        bottom = 0.01 - shrink * corners[:, 2].min()
        last = (f"variable x atom 6+{shrink}*(x-6)\nvariable y atom 6+{shrink}*(y-6)\n"
                f"variable z atom {bottom}+{shrink}*(z-2)\nset group all x v_x y v_y z v_z")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, _, where = self.check(
                    ["rbc/ib ib", "through a plate", "atom ID", "molecule ID 1"], ranks, latest=10,
                    last=last, cells="rbc/create rbc single 6 6 2",
                    membrane="fix mem all rbc/membrane rbc neo-hookean 1e-5 volume yes")
                self.assertLess(where[2], 0)

    def test_two_vertices_at_one_place(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, triangles = read_template(POTENTIALS / "rbc_162.mol")
                i, j, _ = triangles[0] + 1
                there = " ".join(f"{d} $({d}[{j}]:%.17g)" for d in "xyz")
                self.check(["rbc/membrane mem", "triangle", "inverted", "molecule ID 1"], ranks,
                           earliest=0, dumped=False, run="run 10", last=f"set atom {i} {there}")

    def test_reneighboring_too_rare(self):
        # the plate carries the cell away from where its rank looks for it
        self.check(
            ["rbc/ib ib", "left the fluid", "neigh_modify", "molecule ID 1"], earliest=5, latest=80,
            fluid=SHEAR["fluid"].replace("zlo 0 0 0", "zlo 0.004 0 0").replace("0.0012", "0.004"),
            neighbor="neighbor 1.0 bin\nneigh_modify delay 1000 every 1000")

    def test_molecule_IDs_changed_within_a_run(self):
        result = attempt(scene(last="run 5\nset atom 9 mol 4", run="run 100 pre no"))
        self.assertNotEqual(result.code, 0, result.printed)
        for word in ["rbc/membrane mem", "atom 9", "molecule 4", "not there at the start"]:
            self.assertIn(word.lower(), result.error.lower())

    def test_vertex_displaced_through_a_plate(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["rbc/membrane mem", "lost 1 of 162 vertices", "molecule ID 1"], ranks,
                           earliest=0, dumped=False,
                           last="group one id 7\ndisplace_atoms one move 0 0 8")


if __name__ == "__main__":
    unittest.main()
