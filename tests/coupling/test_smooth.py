"""fix rbc/membrane smooth: what the tractions of membranes vary within the grid's cells is taken
out."""

import unittest

import numpy as np

from lammps_case import (POTENTIALS, SHEAR, attempt, in_parallel, make_template, push,
                         read_template, run, scene)

RATE, DIAMETER, ASPECT = 1e-3, 2.4, 1 / 3
COUNT = len(read_template(POTENTIALS / "rbc_162.mol")[0])


def turning(tilt, smooth):
    """Strain rate over which a stiff spheroid turns whose axis is `tilt` degrees from the gradient:
    its angles and rates at six fluid cells a diameter."""
    speed = RATE * 6
    result = run(scene(
        box="region box block 0 12 0 10 0 12", molecule="molecule body ../body.mol",
        cells=f"rbc/create body single 6.03 5.06 6.09 rotate {tilt} 0 1 0",
        neighbor="neighbor 0.4 bin",
        membrane=f"fix mem all rbc/membrane body skalak 1.0 10 bending 4.0e-2 smooth {smooth}",
        fluid=f"fix flow all rbc/fluid dx 0.4 viscosity 1.5 density 1.025 wall zlo {-speed} 0 0 "
              f"wall zhi {speed} 0 0",
        ib="fix ib all rbc/ib flow integrator rkc auto", compute="compute c all rbc/cell",
        thermo="thermo_style custom step c_c[1][14] c_c[1][16]", every="thermo 2",
        timestep="timestep 50", run="run 16"))
    angle = np.unwrap(2 * np.arctan2(result.thermo["c_c[1][14]"], result.thermo["c_c[1][16]"])) / 2
    strain = result.thermo["Step"] * 50 * RATE
    settled = strain > 0.2
    return angle[settled], abs(np.gradient(angle, strain))[settled]


def jeffery(angle):
    """Rate of turning of the axis over the shear rate."""
    return (ASPECT**2 * np.cos(angle)**2 + np.sin(angle)**2) / (1 + ASPECT**2)


class StiffSpheroid(unittest.TestCase):
    def test_turns_as_jeffery_says(self):
        # the polyhedron is thicker, and a little smaller, than the spheroid: 0.345
        make_template("spheroid", "--diameter", DIAMETER, "--axis-ratio", ASPECT, "--frequency", 3,
                      "--output", "body.mol")
        cases = [(0, "yes"), (90, "yes"), (0, "no")]
        for (tilt, smooth), (angle, rate) in zip(cases, in_parallel(turning, cases)):
            off = np.mean(rate - jeffery(angle))
            print(f"\nsmooth {smooth}, axis {tilt} degrees from the gradient: rate "
                  f"{rate.mean():.4f}, Jeffery {off:+.4f}")
            if smooth == "yes":
                self.assertLess(abs(off), 0.004)
            else:
                self.assertGreater(abs(off), 0.02)


def velocities(forces, smooth="yes", ranks=1, ib=""):
    """Of all vertices of a cell whose membrane exerts no forces."""
    before, files = push(forces)
    dump = ("dump atoms all custom 1 atoms.dump id x y z vx vy vz\n"
            "dump_modify atoms sort id format float %.17g")
    result = run(scene(boundary="boundary p p p",
                       membrane="fix mem all rbc/membrane rbc neo-hookean 1e-30 volume no"
                       f" smooth {smooth}", before=before,
                       fluid="fix flow all rbc/fluid dx 1 viscosity 1.5 density 1.025", thermo="",
                       ib="fix ib all rbc/ib flow integrator midpoint" + ib,
                       timestep="timestep 1e-3", dump=dump), ranks, files=files)
    return result.dump()("vx", "vy", "vz")


def random_forces(seed):
    return np.random.default_rng(seed).normal(size=(COUNT, 3))


class Mobility(unittest.TestCase):
    def test_is_symmetric_and_positive(self):
        f, g = random_forces(2), random_forces(3)
        by_f, by_g = in_parallel(velocities, [(f,), (g,)])
        scale = abs(f * by_f).sum()
        self.assertLess(abs((g * by_f).sum() - (f * by_g).sum()) / scale, 1e-12)
        self.assertGreater((f * by_f).sum(), 0.001 * scale)

    def test_is_the_same_on_any_ranks(self):
        forces = random_forces(4)
        one, *others = in_parallel(velocities, [(forces, "yes", ranks) for ranks in (1, 2, 3, 4)])
        for other in others:
            self.assertLess(abs(other - one).max() / abs(one).max(), 1e-11)

    def test_rough_forces_move_less_and_smooth_ones_the_same(self):
        x, triangles = read_template(POTENTIALS / "rbc_162.mol")
        areas = np.zeros(COUNT)
        for corner in triangles:
            area = np.linalg.norm(
                np.cross(x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]])) / 2
            areas[corner] += area / 3
        smooth = areas[:, None] * np.column_stack([1 + 0.2 * x[:, 2], -0.3 * x[:, 0],
                                                   0.1 * x[:, 1]])
        rough = random_forces(5)
        for forces, low, high in ((smooth, 0, 0.03), (rough, 0.3, 1)):
            yes, no = in_parallel(velocities, [(forces, "yes"), (forces, "no")])
            change = np.linalg.norm(yes - no) / np.linalg.norm(no)
            print(f"\nvelocities change by {change:.4f}")
            self.assertGreater(change, low)
            self.assertLess(change, high)


class Interior(unittest.TestCase):
    def test_is_the_limit_of_hardly_viscous_membranes(self):
        # both solve for the velocities, one with tractions in each of its iterations and one
        # without
        forces = random_forces(6)
        alone, viscous = in_parallel(velocities,
                                     [(forces, f"yes interior 7.5 {more}", ranks, " tol 1e-9")
                                      for more, ranks in (("", 1), ("viscosity 1e-9", 2))])
        self.assertLess(abs(viscous - alone).max() / abs(alone).max(), 1e-6)


class OtherAtoms(unittest.TestCase):
    def test_may_have_a_rank_for_themselves(self):
        results = in_parallel(
            lambda atoms, ranks: run(scene(
                boundary="boundary p p p", processors="processors * 1 1",
                box="region box block 0 24 0 12 0 12",
                create_box="create_box 2 box angle/types 1", cells="rbc/create rbc single 6 6 6",
                before=atoms + "mass * 1.0\ngroup cell type 1",
                membrane=SHEAR["membrane"].replace("mem all", "mem cell") + " smooth yes",
                fluid="fix flow all rbc/fluid dx 1 viscosity 1.5 density 1.025",
                ib="fix ib cell rbc/ib flow integrator midpoint",
                run="run 2"), ranks),
            [("", 1), ("create_atoms 2 single 18 6 6\n", 2)])
        self.assertEqual([result.thermo["Step"][-1] for result in results], [2, 2])


class Errors(unittest.TestCase):
    def test_points_have_no_tractions(self):
        smooth = SHEAR["membrane"] + " smooth yes"
        message = ("Fix rbc/membrane smooth yes needs fix rbc/ib ib with sheets yes and scheme "
                   "elastic")
        self.assertIn(message, attempt(scene(membrane=smooth, ib=SHEAR["ib"] + " sheets no")).error)
        self.assertIn("Expected boolean parameter instead of 'maybe'",
                      attempt(scene(membrane=SHEAR["membrane"] + " smooth maybe")).error)

    def test_without_a_fluid(self):
        alone = run(scene(membrane=SHEAR["membrane"] + " smooth yes", ib=None, fluid=None,
                          thermo=None))
        self.assertIn("Fix rbc/membrane mem smooth yes has no effect: there is no fix rbc/ib",
                      alone.printed)

    def test_all_vertices_must_move(self):
        smooth = SHEAR["membrane"].replace("volume yes", "volume no smooth yes")
        part = "group some id 1:100\nfix ib some rbc/ib flow integrator midpoint\n"
        held = "group others subtract all some\nfix wall others rbc/wall flow"
        for ib in (part, part + held):
            self.assertIn("Fix rbc/ib ib does not move all atoms of fix rbc/membrane mem, which "
                          "smooths tractions", attempt(scene(membrane=smooth, ib=ib)).error)
