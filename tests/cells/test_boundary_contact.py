"""Plates and walls that repel cells (pair_style rbc/jkr plates, walls), against closed forms for
each vertex and against the gradient of their energy; lengths in spacings of the fluid's grid."""

import unittest

import numpy as np

from contact_case import (ADHESIVE, COMPUTES, K, NUMERICAL, R, REPULSIVE, SIGMA, THERMO, contact,
                          force_of_equation_7)
from lammps_case import POTENTIALS, attempt, dump_line, in_parallel, read_template, run, scene

LAWS = {"adhesive": ADHESIVE, "repulsive": REPULSIVE}
HEIGHT = 2.75    # of the gap between plates; both are nearer than R to a cell that lies flat
FLUID = ("fix flow all rbc/fluid dx 0.25 viscosity 1.5 density 1.025 wall zlo 0 0 0 wall zhi "
         "0.001 0 0")
FLAT = (f"rbc/create rbc single 6 6 {HEIGHT / 2} rotate 30 0 0 1\n"
        "displace_atoms all random 0.05 0.05 0.05 11")
A0 = np.cbrt(6 * np.pi * SIGMA * R**2 / K)
REST = R - A0**2 / R / 3    # gap of adhered surfaces
TIP_AREA = {"adhesive": (3 + 2 * 6**(-4 / 3)) / 5 * np.pi * A0**2, "repulsive": np.pi * R**2}


def force(law, gap):
    """Of a tip on a plate, which it does not stick to."""
    h = R - np.asarray(gap, dtype=float)
    if law == "repulsive":
        return K * np.maximum(h, 0)**1.5 / np.sqrt(R) * R
    return np.where(h > R - REST, force_of_equation_7(np.maximum(h, R - REST)), 0)


def energy(law, gap):
    """Integral of the force from where it begins."""
    begin = R if law == "repulsive" else REST
    s = np.linspace(gap, begin, 4001) if gap < begin else np.array([begin, begin])
    f = force(law, s)
    return ((f[1:] + f[:-1]) / 2 * np.diff(s)).sum()


def areas():
    """The part of the surface at rest that is nearest to each vertex; all angles are acute."""
    x, triangles = read_template(POTENTIALS / "rbc_162.mol")
    area = np.zeros(len(x))
    for a, b, c in np.transpose([np.roll(triangles, n, axis=1) for n in range(3)], (0, 2, 1)):
        one, other = x[a] - x[c], x[b] - x[c]    # the edge a b, seen from c
        cotangent = (one * other).sum(axis=1) / np.linalg.norm(np.cross(one, other), axis=1)
        share = cotangent * ((one - other)**2).sum(axis=1) / 8
        np.add.at(area, a, share)
        np.add.at(area, b, share)
    return area


def pair(keywords, cutoff=0.5):
    return f"pair_style rbc/jkr {cutoff} {keywords}"


def plates(law="adhesive", coeff=None, **changes):
    """A cell between plates that it touches."""
    return contact(coeff or LAWS[law], **{**dict(
        pair=pair("plates yes"), boundary="boundary p p f",
        box=f"region box block 0 12 0 12 0 {HEIGHT}", cells=FLAT, fluid=FLUID), **changes})


def vessel(law="adhesive", region="region vessel sphere 6 6 6 4.05 units box",
           cell="rbc/create rbc single 6 6 6 rotate 40 1 0.2 0\n"
                "displace_atoms all random 0.08 0.08 0.08 11",
           **changes):
    """A cell that touches a wall."""
    return contact(LAWS[law],
                   **{**dict(pair=pair("walls vessel"), cells=f"{region}\n{cell}"), **changes})


class Plates(unittest.TestCase):
    def expected(self, law, x):
        """Forces, energy and virial along z of the contact with both plates."""
        area = areas() / TIP_AREA[law]
        below, above = x[:, 2], HEIGHT - x[:, 2]
        pushed = area * force(law, below), area * force(law, above)
        stored = sum(a * (energy(law, lower) + energy(law, upper))
                     for a, lower, upper in zip(area, below, above))
        return pushed[0] - pushed[1], stored, (pushed[0] * below + pushed[1] * above).sum()

    def test_closed_form(self):
        for law in LAWS:
            with self.subTest(law):
                result = run(plates(law))
                dump = result.dump()
                along, stored, virial = self.expected(law, dump.positions())
                f = dump.forces()
                self.assertGreater((along > 0).sum(), 20)
                self.assertGreater((along < 0).sum(), 20)
                self.assertLess(abs(f[:, :2]).max(), 1e-20)
                np.testing.assert_allclose(f[:, 2], along, atol=1e-6 * abs(along).max(), rtol=0)
                np.testing.assert_allclose(result.thermo["c_pe"], stored, rtol=1e-6)
                np.testing.assert_allclose(result.thermo["c_press[3]"] * 12 * 12 * HEIGHT, virial,
                                           rtol=1e-5)
                self.assertEqual(result.thermo["c_contact[1]"], 0)    # nothing sticks
                self.assertIn("type 1: repelled by plates from a gap of "
                              f"{R if law == 'repulsive' else REST:.6g} on",
                              result.printed)

    def test_minus_the_gradient_of_the_energy(self):
        for law, ranks in (("adhesive", 1), ("repulsive", 2)):
            with self.subTest(law):
                dump = run(plates(law, compute=COMPUTES + "\nfix numerical all numdiff 1 1e-5",
                                  dump=dump_line(1, columns="id fx fy fz " + " ".join(NUMERICAL))),
                           ranks).dump()
                f = dump.forces()
                self.assertGreater((abs(f[:, 2]) > 0).sum(), 50)
                np.testing.assert_allclose(dump(*NUMERICAL), f, atol=1e-6 * abs(f).max(), rtol=0)

    def test_pressure_is_the_derivative_by_height(self):
        """Of a box that is stretched along z with all that is in it."""
        def at(stretch):
            high = HEIGHT * stretch
            return run(plates(last=f"change_box all z final 0 {high!r} remap units box\n{FLUID}",
                              fluid=None, dump=None)).thermo
        step = 1e-4
        low, middle, high = (at(1 + n * step) for n in (-1, 0, 1))
        slope = (high["c_pe"] - low["c_pe"]) / (2 * step)
        np.testing.assert_allclose(middle["c_press[3]"] * 12 * 12 * HEIGHT, -slope, rtol=1e-4)

    def test_ranks_newton_and_shares(self):
        reference = run(plates())
        f = reference.dump().forces()
        for ranks, newton, move in ((2, "newton off", "0 0 0"), (4, "newton on", "6 5 0"),
                                    (8, "newton on", "0 6 0"),
                                    (1, "newton on", "-30 17 0")):
            with self.subTest(ranks=ranks, newton=newton, move=move):
                result = run(plates(newton=newton, last=f"displace_atoms all move {move}"), ranks)
                np.testing.assert_allclose(result.dump().forces(), f, atol=1e-12 * abs(f).max(),
                                           rtol=0)
                thermo = result.thermo
                np.testing.assert_allclose(thermo["c_pe"], reference.thermo["c_pe"], rtol=1e-12)
                np.testing.assert_allclose(thermo["c_sums[1]"], thermo["c_pe"], rtol=1e-12)
                np.testing.assert_allclose(-thermo["c_sums[4]"] / (12 * 12 * HEIGHT),
                                           thermo["c_press[3]"], rtol=1e-12)

    def test_cells_and_plates_add_up(self):
        create, move = FLAT.splitlines()
        cells = f"{create}\n{create.replace('single 6 6', 'single 6 13.9')}\n{move}"
        box = f"region box block 0 12 0 24 0 {HEIGHT}"
        result = run(plates(cells=cells, box=box))
        without = run(plates(cells=cells, box=box, pair=pair("plates no"))).dump().forces()
        self.assertGreater(abs(without).max(), 1e-6)
        added = (result.dump().forces() - without)[:162]
        along = self.expected("adhesive", result.dump().positions()[:162])[0]
        np.testing.assert_allclose(added[:, 2], along, atol=1e-6 * abs(along).max(), rtol=0)
        np.testing.assert_allclose(added[:, :2], 0, atol=1e-12 * abs(along).max())

    def test_types(self):
        """The law of a type with itself counts, and an overlaid style has its own."""
        two = dict(create_box="create_box 2 box angle/types 1",
                   cells=FLAT + "\nset type 1 type 2\nmass * 1")
        one = run(plates()).dump().forces()
        coeff = f"pair_coeff 1 * none\npair_coeff 2 2 adhesive {K} {SIGMA} {R}"
        cases = {
            "second type": (coeff, pair("plates yes"), 1),
            "overlaid": ("pair_coeff * * zero\npair_coeff 1 * rbc/jkr none\n"
                         f"pair_coeff 2 2 rbc/jkr adhesive {K} {SIGMA} {R}",
                         "pair_style hybrid/overlay rbc/jkr 0.5 plates yes zero 1.0", 1),
            "twice": ("pair_coeff * * rbc/jkr 1 none\npair_coeff * * rbc/jkr 2 none\n"
                      f"pair_coeff 2 2 rbc/jkr 1 adhesive {K} {SIGMA} {R}\n"
                      f"pair_coeff 2 2 rbc/jkr 2 adhesive {K} {SIGMA} {R}",
                      "pair_style hybrid/overlay rbc/jkr 0.5 plates yes rbc/jkr 0.5 plates yes", 2)}
        for name, (lines, style, times) in cases.items():
            with self.subTest(name):
                compute = (COMPUTES.replace("pair rbc/jkr", "pair rbc/jkr 1")
                           if name == "twice" else COMPUTES)
                f = run(plates(coeff=lines, pair=style, compute=compute, **two)).dump().forces()
                np.testing.assert_allclose(f, times * one, atol=1e-13 * abs(one).max(), rtol=0)


class Walls(unittest.TestCase):
    def radial(self, result, law, center, axes, radius, outward):
        """Compares with the law of each vertex' distance from a sphere or a cylinder."""
        dump = result.dump()
        arm = (dump.positions() - center) * axes
        r = np.linalg.norm(arm, axis=1)
        gap = (r - radius) * outward
        size = areas() / TIP_AREA[law] * force(law, gap)
        expected = outward * (size / r)[:, None] * arm
        np.testing.assert_allclose(dump.forces(), expected, atol=1e-6 * abs(expected).max(), rtol=0)
        stored = sum(a * energy(law, d) for a, d in zip(areas() / TIP_AREA[law], gap))
        np.testing.assert_allclose(result.thermo["c_pe"], stored, rtol=1e-6)
        return gap

    def test_closed_form(self):
        for law in LAWS:
            for name, region, axes in (("sphere", "sphere 6 6 6 4.05", (1, 1, 1)),
                                       ("cylinder", "cylinder z 6 6 3.95 INF INF", (1, 1, 0))):
                with self.subTest(law, region=name):
                    radius = float(region.split()[-1 if name == "sphere" else 4])
                    result = run(vessel(law, f"region vessel {region} units box"))
                    gap = self.radial(result, law, (6, 6, 6), np.array(axes), radius, -1)
                    self.assertGreater((gap < R).sum(), 10)
                    self.assertIn("type 1: repelled by walls vessel from a gap", result.printed)

    def test_beyond_the_wall(self):
        gap = self.radial(run(vessel(region="region vessel sphere 6 6 6 3.9 units box")),
                          "adhesive", (6, 6, 6), np.ones(3), 3.9, -1)
        self.assertLess(gap.min(), -0.02)

    def test_an_obstacle(self):
        region = "region vessel sphere 6 6 4 2 side out units box"
        result = run(vessel(region=region, cell="rbc/create rbc single 6 6 6.5"))
        gap = self.radial(result, "adhesive", (6, 6, 4), np.ones(3), 2, 1)
        self.assertLess(gap.min(), REST)

    def test_any_ranks_and_across_a_periodic_face(self):
        region = "region vessel cylinder z 6 6 3.95 INF INF units box"
        reference = run(vessel(region=region))
        f = reference.dump().forces()
        for ranks, newton, move in ((2, "newton on", "0 0 0"), (4, "newton off", "0 0 6"),
                                    (1, "newton on", "0 0 -31")):
            with self.subTest(ranks=ranks, newton=newton, move=move):
                result = run(vessel(region=region, newton=newton,
                                    last=f"displace_atoms all move {move}"), ranks)
                np.testing.assert_allclose(result.dump().forces(), f, atol=1e-12 * abs(f).max(),
                                           rtol=0)
                np.testing.assert_allclose(result.thermo["c_pe"], reference.thermo["c_pe"],
                                           rtol=1e-12)

    def test_minus_the_gradient_of_the_energy(self):
        regions = {
            "box": "region vessel block 2.2 9.8 INF INF 3.1 8.9 units box",
            "bore through a slab": "region bore cylinder z 6 6 3.8 INF INF units box\n"
                                   "region slab block INF INF INF INF 3.1 8.9 units box\n"
                                   "region vessel intersect 2 bore slab",
            "moving": "variable shift equal 0.1\n"
                      "region vessel sphere 6 6 6 4.0 units box move v_shift NULL NULL"}
        for name, region in regions.items():
            with self.subTest(name):
                dump = run(vessel(
                    region=region, compute=COMPUTES + "\nfix numerical all numdiff 1 1e-5",
                    dump=dump_line(1, columns="id fx fy fz " + " ".join(NUMERICAL))), 2).dump()
                f = dump.forces()
                self.assertGreater((abs(f).max(axis=1) > 0).sum(), 5)
                np.testing.assert_allclose(dump(*NUMERICAL), f, atol=1e-6 * abs(f).max(), rtol=0)

    def test_far_beyond_the_wall(self):
        for ranks in (1, 2):
            result = attempt(vessel(region="region vessel sphere 6 6 6 3.5 units box"), ranks)
            for words in ("rbc/jkr walls", "is not inside region vessel", "molecule ID 1",
                          "at step 0"):
                self.assertIn(words, result.error, result.printed)


class Moving(unittest.TestCase):
    """Cells and fluid: what is listed between reneighborings is enough, within steps too."""

    PRESSED = 0.1    # force on the cell, nN

    def pressed(self, keywords, ranks=1, steps=700, **changes):
        return attempt(scene(**{**dict(
            boundary="boundary p p f", box="region box block 0 12 0 12 0 6",
            cells="rbc/create rbc single 6 6 1.8",
            before=f"{pair(keywords, 0.8)}\npair_coeff * * repulsive 0.5 0.8",
            neighbor="neighbor 0.3 bin",
            membrane="fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                     "area 1.0 0.05",
            fluid=FLUID.replace("dx 0.25", "dx 0.8").replace("density", "inertia none density"),
            ib="fix ib all rbc/ib flow integrator rkc auto\n"
               f"fix press all addforce 0 0 {-self.PRESSED / 162!r}",
            thermo="thermo_style custom step f_mem evdwl c_low c_force", dump=dump_line(steps),
            compute="compute low all reduce min z\ncompute force all reduce sum fz",
            timestep="timestep 300", run=f"run {steps}"), **changes}), ranks)

    def test_a_cell_pressed_against_a_plate(self):
        held, free = in_parallel(self.pressed, [("plates yes",), ("plates no",)])
        self.assertEqual(held.code, 0, held.printed)
        lowest, force = held.thermo["c_low"], held.thermo["c_force"]
        print(f"\nlowest vertex {lowest[-1]:.3f} um above the plate that repels, "
              f"{free.thermo['c_low'][-1]:.3f} um above the other; net force "
              f"{force[-1] / self.PRESSED:.2g} of what presses the cell")
        self.assertGreater(lowest.min(), 0.5)
        self.assertLess(lowest[-1], 0.8)
        self.assertLess(free.thermo["c_low"][-1], lowest[-1] - 0.2)
        self.assertLess(abs(force[-1]), 0.15 * self.PRESSED)    # the plate bears the rest

    def test_any_ranks(self):
        x = self.pressed("plates yes", steps=40).dump().positions()
        for ranks in (2, 4):
            moved = self.pressed("plates yes", ranks, steps=40).dump().positions()
            np.testing.assert_allclose(moved, x, atol=1e-9, rtol=0)


class Spacings(unittest.TestCase):
    """The fluid's grid has a spacing of 0.25: a quarter of a number is exact."""

    MOVING = dict(run="run 10", last="fix move all nve\nmass 1 1\ntimestep 0.05",
                  dump=dump_line(10))

    def both(self, law, words="plates yes", **changes):
        """The same in units of length and in spacings; RADIUS stands for R in either."""
        return [run(plates(coeff=LAWS[law].replace(f" {R}", f" {factor * R!r}"),
                           pair=pair(f"{words} units {units}", 0.5 * factor),
                           **{name: line.replace("RADIUS", repr(factor * R))
                              for name, line in changes.items()}))
                for units, factor in (("box", 1), ("dx", 4))]

    def test_as_in_units_of_length(self):
        for law, words in (("adhesive", "plates yes"), ("repulsive", "plates yes"),
                           ("adhesive", "self yes plates yes")):
            with self.subTest(law, words=words):
                box, spacings = self.both(law, words, **self.MOVING)
                self.assertGreater(abs(box.dump().positions() - box.dump().positions(0)).max(),
                                   1e-6)
                np.testing.assert_array_equal(spacings.dump().positions(), box.dump().positions())
                np.testing.assert_array_equal(spacings.dump().forces(), box.dump().forces())
                self.assertIn("cutoff and R are in spacings of the fluid's grid, 0.25",
                              spacings.printed)

    def test_fix_adapt(self):
        vary = "\nvariable R equal RADIUS*(1-step/40)\nfix vary all adapt 1 pair rbc/jkr R * * v_R"
        box, spacings = self.both("repulsive",
                                  **{**self.MOVING, "last": self.MOVING["last"] + vary})
        np.testing.assert_array_equal(spacings.dump().positions(), box.dump().positions())
        fixed = run(plates("repulsive", **self.MOVING)).dump().positions()
        self.assertGreater(abs(box.dump().positions() - fixed).max(), 1e-6)

    def test_restart(self):
        """Settings are in the file, the fluid and the region are not."""
        region = "region vessel cylinder z 6 6 3.95 INF INF units box"
        later = dict.fromkeys(("units", "boundary", "box", "create_box", "cells", "before"))
        moving = dict(self.MOVING, cells=f"{region}\n{FLAT}",
                      coeff=f"pair_coeff * * adhesive {K} {SIGMA} {4 * R}",
                      pair=pair("self yes units dx plates yes walls vessel", 2))
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                whole = run(plates(**{**moving, "run": "run 5\nwrite_restart r\nrun 5"}), ranks)
                after = run(plates(**{**moving, **later, "run": "run 5", "pair": "", "coeff": " ",
                                      "style": f"read_restart {whole.path('r')}\n{region}"}), ranks)
                self.assertIn("repelled by plates, walls vessel", after.printed)
                np.testing.assert_array_equal(after.dump().positions(), whole.dump().positions())


if __name__ == "__main__":
    unittest.main()
