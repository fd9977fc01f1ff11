"""Insides that are hardly or very viscous, cells that touch, that are thin, or that lie across all
sides of the box."""

import unittest

import numpy as np

from lammps_case import (POTENTIALS, Failed, dump_line, make_template, push, read_template, run,
                         scene)
from test_contrast import AREA, COUNT, NORMAL, VISCOSITY, rotated, velocities
from test_extremes import change_of_shape, cut_edges, volume

CAPSULE = POTENTIALS / "capsule_642.mol"


def sheared(contrast, strain, template=CAPSULE, cells="rbc/create rbc single 4 4 4", modulus=0.1,
            integrator="midpoint", dx=0.25, before=""):
    """A run of cells about 1 in radius in shear of rate 1 around (4, 4, 4)."""
    dt = 0.04
    steps = round(strain / dt)
    return run(scene(
        box="region box block 0 8 0 8 0 8", molecule=f"molecule rbc {template}", cells=cells,
        neighbor="neighbor 0.3 bin",
        membrane=f"fix mem all rbc/membrane rbc neo-hookean {modulus} volume yes interior "
                 f"{contrast}",
        fluid=f"fix flow all rbc/fluid dx {dx} viscosity 1 wall zlo -4 0 0 wall zhi 4 0 0",
        before=before,
        ib=f"fix ib all rbc/ib flow integrator {integrator} tol 1e-4", timestep=f"timestep {dt}",
        dump=dump_line(steps), run=f"run {steps}"))


def shear(*arguments, **options):
    """Positions [vertex, 3] at the start and the end."""
    dump = sheared(*arguments, **options).dump()
    return dump.positions(0), dump.positions()


class Rigid(unittest.TestCase):
    def test_how_a_cell_turns_does_not_depend_on_its_inside(self):
        spin = np.cross([0.3, -0.5, 0.8], rotated(NORMAL))
        forces = spin * AREA[:, None]
        alike, _ = velocities(forces, ib="", dx=0.25)
        for contrast in (1e-3, 5, 100, 1e4):
            moves, result = velocities(forces, f"interior {contrast * VISCOSITY}", dx=0.25)
            off = np.sum(moves * spin) / np.sum(alike * spin) - 1
            iterations = result.thermo["f_ib[11]"][-1]
            print(f"\ninside {contrast:g} times as viscous: turns {off:+.3%}, {iterations:g} "
                  "iterations")
            self.assertLess(abs(off), 1e-3)
            self.assertLess(iterations, 15)

    def test_spheroid_turns_as_jeffery_says(self):
        # Jeffery, Proc R Soc Lond A 102, 161 (1922), from the symmetry axis along the gradient on
        ratio, strain = 0.5, 1
        make_template("spheroid", "--axis-ratio", ratio, "--diameter", 2, "--frequency", 8,
                      "--output", "lentil.mol")
        _, triangles = read_template("lentil.mol")
        start, end = shear(1e4, strain, "../lentil.mol", dx=0.125)
        axis = np.linalg.eigh(np.cov((end - end.mean(axis=0)).T))[1][:, 0]
        turned = np.arctan(axis[0] / axis[2])
        exact = np.arctan(ratio * np.tan(strain / (ratio + 1 / ratio)))
        print(f"\nturns by {np.degrees(turned):.2f} degrees, Jeffery {np.degrees(exact):.2f}")
        self.assertAlmostEqual(turned / exact, 1, delta=0.01)
        self.assertLess(change_of_shape(start, end), 5e-4)    # strain over the ratio of viscosities
        self.assertAlmostEqual(volume(end, triangles) / volume(start, triangles), 1, delta=3e-5)


class Thin(unittest.TestCase):
    """A spheroid of 1.6 spacings, and of 1 in the middle of its triangles."""

    def cells(self):
        make_template("spheroid", "--axis-ratio", 0.2, "--diameter", 2, "--frequency", 6,
                      "--output", "lentil.mol")
        return dict(template="../lentil.mol", cells="rbc/create rbc single 4 4 4 rotate 60 0 1 0")

    def test_turns_as_on_a_finer_grid(self):
        coarse, fine = (shear(5, 1, dx=dx, **self.cells())[1] for dx in (0.25, 0.125))
        self.assertLess(np.sqrt(((coarse - fine)**2).sum(axis=1).mean()), 0.04)

    def test_says_what_to_do(self):
        self.assertRegex(
            sheared(1e4, 0.08, **self.cells()).printed,
            "mem are 1.05 fluid spacings thick, and below 2 an "
            "inside that is 1e[+]04 times as viscous as the fluid is not resolved: use dx 0.131")
        with self.assertRaises(Failed) as stopped:    # other things of such a cell go wrong, too
            shear(10, 2, **{**self.cells(), "integrator": "euler"}, dx=0.5)
        self.assertRegex(stopped.exception.result.error, "molecule ID 1 .*two fluid cells thick")


class Touching(unittest.TestCase):
    def test_pair_stays_symmetric_and_apart(self):
        # shear presses them against each other; it looks the same after half a turn about y
        _, triangles = read_template(CAPSULE)
        away = 1.02 * np.array([-1, 0, 1]) / np.sqrt(2)    # a gap of 0.16 dx
        cells = "\n".join(f"rbc/create rbc single {x} {y} {z} rotate {turn} 0 1 0"
                          for (x, y, z), turn in ((4 + away, 0), (4 - away, 180)))
        for contrast in (5, 100):
            start, end = shear(contrast, 1, cells=cells, modulus=1, integrator="rkc auto",
                               before="pair_style rbc/jkr 0.4\npair_coeff * * repulsive 20 0.25")
            one, other = end[:COUNT], end[COUNT:]
            apart = abs(one - 4 + (other - 4) * [1, -1, 1]).max()
            print(f"\ninside {contrast} times as viscous: {apart:.2g} radii from symmetric")
            self.assertLess(apart, 2e-3)
            self.assertEqual(cut_edges(end, np.concatenate([triangles, triangles + COUNT])), 0)
            self.assertAlmostEqual(volume(one, triangles) / volume(start[:COUNT], triangles), 1,
                                   delta=1e-4)


class AcrossAllSides(unittest.TestCase):
    def test_is_the_same_as_in_the_middle(self):
        before, files = push(np.random.default_rng(2).normal(size=(COUNT, 3)) * 0.01)

        def moved(x, y, z, ranks=1):
            return run(scene(
                boundary="boundary p p p", box="region box block 0 6 0 6 0 6",
                molecule=f"molecule rbc {CAPSULE}",
                cells=f"rbc/create rbc single {x} {y} {z}", neighbor="neighbor 0.3 bin",
                before=before,
                membrane="fix mem all rbc/membrane rbc neo-hookean 1 volume yes interior 7.5",
                fluid=f"fix flow all rbc/fluid dx 0.25 viscosity {VISCOSITY}",
                timestep="timestep 0.05",
                ib="fix ib all rbc/ib flow integrator midpoint tol 1e-10", dump=dump_line(5),
                run="run 5"), ranks, files=files).dump()

        middle = moved(3.02, 2.95, 3.01).positions()
        for ranks in (1, 2):
            corner = moved(0.02, 5.95, 6.01, ranks)
            shift = np.array([-3, 3, 3]) + 6 * np.round(
                (corner.positions(0)[0] - middle[0] - [-3, 3, 3]) / 6)
            self.assertLess(abs(corner.positions() - middle - shift).max(), 1e-9)


if __name__ == "__main__":
    unittest.main()
