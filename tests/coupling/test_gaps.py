"""fix rbc/ib gaps: surfaces nearer than the grid's cells slide as the fluid between them lets
them."""

import unittest

import numpy as np

from lammps_case import (POTENTIALS, SHEAR, attempt, dump_line, in_parallel, push, read_template,
                         run, scene)

DX, VISCOSITY = 1.0, 1.5
SEEN = "pair_style rbc/jkr 0.5\npair_coeff * * none"
VERTICES, TRIANGLES = read_template(POTENTIALS / "rbc_162.mol")
COUNT = len(VERTICES)
CENTRES = np.array([[6.1, 6.2, 4.4], [6.4, 6.0, 7.15]])    # the rims are 0.2 to 0.4 apart


def weights(r):
    """Kernel roma3 at a distance."""
    r = abs(r)
    inner, outer = np.sqrt(np.maximum(0, 1 - 3 * r**2)), np.sqrt(np.maximum(0, 1 - 3 * (1 - r)**2))
    return np.where(r <= 0.5, (1 + inner) / 3, np.where(r <= 1.5, (5 - 3 * r - outer) / 6, 0))


def missing_slide(gaps):
    """In cells: what two sheets of opposite unit tractions slide too little, in the mean over all
    directions, as the theory page has it."""
    second, fourth = 0.30, 0.2065
    k, r = (np.arange(2500) + 0.5) * 0.01, (np.arange(3000) + 0.5) * 1e-3 - 1.5
    transform = np.cos(np.outer(k, r)) @ weights(r) * 1e-3
    total = np.zeros_like(k)
    for share, count in ((2 / 7, 1), (16 / 35, 2), (9 / 35, 3)):    # directions 100, 110, 111
        along = k / np.sqrt(count)
        kernel = np.interp(along, k, transform)**(2 * count)
        differences = 4 * count * np.sin(along / 2)**2
        total += share * kernel * (1 / differences + second + fourth * differences)
    return gaps - 2 / np.pi * 0.01 * ((1 - np.cos(np.outer(gaps, k))) @ total)


def range_and_missing(gaps):
    places = np.arange(1, 40) / 16
    end = places[np.argmax(missing_slide(places) < 0.03 * places)]
    rest = missing_slide(np.array([end]))[0]
    return end, np.where(gaps < end, np.maximum(0, missing_slide(gaps) - (gaps / end)**2 * rest), 0)


def closest_points(points, corners):
    """Weights of the corners at the point of triangles (triangle, corner, coordinate) closest to
    each point, which triangle that is, and where."""
    best = np.full(len(points), np.inf)
    triangle, shares = np.zeros(len(points), int), np.zeros((len(points), 3))
    for t, (a, b, c) in enumerate(corners):
        tried = [np.linalg.lstsq(np.array([b - a, c - a]).T, (points - a).T, rcond=None)[0].T]
        tried = [np.column_stack([1 - tried[0].sum(axis=1), tried[0]])]
        for first, second in ((0, 1), (1, 2), (2, 0)):
            start, edge = corners[t][first], corners[t][second] - corners[t][first]
            along = np.clip((points - start) @ edge / (edge @ edge), 0, 1)
            share = np.zeros((len(points), 3))
            share[:, first], share[:, second] = 1 - along, along
            tried.append(share)
        for share in tried:
            distance = np.linalg.norm(points - share @ corners[t], axis=1)
            better = (share.min(axis=1) > -1e-12) & (distance < best)
            best[better], triangle[better], shares[better] = distance[better], t, share[better]
    return triangle, shares


def mixed_areas():
    """Each vertex' share of the area, cut at circumcentres, or at the middle of the longest edge of
    obtuse triangles."""
    areas = np.zeros(COUNT)
    for corner in TRIANGLES:
        x = VERTICES[corner]
        area = np.linalg.norm(np.cross(x[1] - x[0], x[2] - x[0])) / 2
        dots = [np.dot(x[(c + 1) % 3] - x[c], x[(c + 2) % 3] - x[c]) for c in range(3)]
        for c in range(3):
            p, q = (c + 1) % 3, (c + 2) % 3
            if min(dots) < 0:
                share = area / (2 if dots[c] < 0 else 4)
            else:
                share = ((np.sum((x[p] - x[c])**2) * dots[q] + np.sum((x[q] - x[c])**2) * dots[p]) /
                         (16 * area))
            areas[corner[c]] += share
    return areas


def velocities(forces, gaps="yes", ranks=1, newton="newton on", kernel="roma3", pair=SEEN,
               plates=False, shift=0.0):
    """Of all vertices of two stacked cells whose membranes exert no forces."""
    cells = "\n".join(f"rbc/create rbc single {x} {y} {z + shift}" for x, y, z in CENTRES)
    before, files = push(forces)
    boundary, walls = ("p p f", " wall zlo 0 0 0 wall zhi 0 0 0") if plates else ("p p p", "")
    result = run(scene(newton=newton, boundary=f"boundary {boundary}", cells=cells,
                       membrane="fix mem all rbc/membrane rbc neo-hookean 1e-30 volume no",
                       before=f"{pair}\n{before}",
                       fluid=f"fix flow all rbc/fluid dx {DX} viscosity {VISCOSITY} density 1.025" +
                       walls,
                       ib=f"fix ib all rbc/ib flow kernel {kernel} integrator midpoint gaps {gaps}",
                       thermo="",
                       timestep="timestep 1e-3", dump=dump_line(1, columns="id xu yu zu vx vy vz")),
                 ranks, files=files)
    return result.dump()("vx", "vy", "vz")


def random_forces(seed):
    return np.random.default_rng(seed).normal(size=(2 * COUNT, 3))


class BetweenCells(unittest.TestCase):
    def test_the_velocities_added_are_those_of_the_theory(self):
        forces = random_forces(1)
        with_gaps, without = in_parallel(velocities, [(forces, "yes"), (forces, "no")])
        areas = np.tile(mixed_areas(), 2)
        x = np.concatenate([VERTICES + centre for centre in CENTRES])
        tractions, added = forces / areas[:, None], np.zeros_like(forces)
        for mine, other in ((0, COUNT), (COUNT, 0)):
            own = np.arange(mine, mine + COUNT)
            triangle, shares = closest_points(x[own], x[TRIANGLES + other])
            corners = TRIANGLES[triangle] + other
            apart = x[own] - np.einsum("ik,ikd->id", shares, x[corners])
            distance = np.linalg.norm(apart, axis=1)
            normal = apart / distance[:, None]
            difference = tractions[own] - np.einsum("ik,ikd->id", shares, tractions[corners])
            along = difference - np.einsum("id,id->i", difference, normal)[:, None] * normal
            _, missing = range_and_missing(distance / DX)
            slip = (areas[own] * missing * DX / (8 * VISCOSITY))[:, None] * along
            self.assertGreater((missing > 0).sum(), 30)
            np.add.at(added, own, slip)
            for c in range(3):
                np.add.at(added, corners[:, c], -shares[:, c, None] * slip)
        added /= areas[:, None]
        off = abs(with_gaps - without - added).max() / abs(added).max()
        print(f"\nvelocities added to two cells differ from the theory's by {off:.2g}")
        self.assertLess(off, 0.01)    # the table is linear between gaps 1/16 cell apart

    def test_mobility_is_symmetric_and_positive(self):
        for kernel in ("roma3", "peskin4"):
            with self.subTest(kernel):
                f, g = random_forces(2), random_forces(3)
                by_f, by_g, plain = in_parallel(
                    velocities, [(f, "yes", 1, "", kernel), (g, "yes", 1, "", kernel),
                                 (f, "no", 1, "", kernel)])
                scale = abs(f * by_f).sum()
                self.assertLess(abs((g * by_f).sum() - (f * by_g).sum()) / scale, 1e-12)
                self.assertGreater((f * (by_f - plain)).sum(), 0.001 * scale)

    def test_ranks_and_newton(self):
        forces = random_forces(4)
        layouts = [(1, "newton on"), (2, "newton on"), (4, "newton off"), (3, "newton on")]
        one, *others = in_parallel(lambda ranks, newton: velocities(forces, "yes", ranks, newton),
                                   layouts)
        for layout, other in zip(layouts[1:], others):
            self.assertLess(abs(other - one).max() / abs(one).max(), 1e-12, layout)

    def test_nothing_that_could_be_seen(self):
        asked = dict(boundary="boundary p p p",
                     fluid="fix flow all rbc/fluid dx 1 viscosity 1 density 1",
                     ib=SHEAR["ib"] + " gaps yes")
        self.assertIn("gaps yes has no effect: there is no pair_style rbc/jkr",
                      run(scene(**asked)).printed)
        points = attempt(scene(**asked, membrane=None, thermo=None))
        self.assertIn("Fix rbc/ib ib gaps yes needs a fix rbc/membrane", points.error)

    def test_pair_style_that_is_not_computed(self):
        forces = random_forces(8)
        idle, plain = in_parallel(lambda gaps, lines: velocities(forces, gaps, pair=SEEN + lines),
                                  [("yes", "\npair_modify compute no"), ("no", "")])
        self.assertLess(abs(idle - plain).max() / abs(plain).max(), 1e-14)

    def test_a_cell_sees_itself_by_any_style_of_hybrid(self):
        # by the inside: the faces of its middle are 0.8 apart
        forces = random_forces(9)
        styles = ("rbc/jkr 1.5 self yes", "rbc/jkr 1.5")
        pairs = [f"pair_style hybrid/overlay {' '.join(order)}\npair_coeff * * rbc/jkr 1 none\n"
                 "pair_coeff * * rbc/jkr 2 none"
                 for order in (styles, styles[::-1], styles[1:] * 2)]
        first, second, neither = in_parallel(lambda pair: velocities(forces, pair=pair),
                                             [(pair,) for pair in pairs])
        self.assertLess(abs(second - first).max() / abs(first).max(), 1e-14)
        self.assertGreater(abs(neither - first).max() / abs(first).max(), 1e-3)

    def test_fixes_in_the_wrong_order(self):
        # pair styles are initialised before fixes, and ask fix rbc/ib how far it sees
        result = attempt(scene(before=SEEN, membrane=None, fluid=None,
                               ib="\n".join(SHEAR[line] for line in ("ib", "membrane", "fluid"))))
        self.assertIn("Fix rbc/ib ib must be defined after fix rbc/membrane mem", result.error)

    def test_without_the_pair_style_cells_are_not_seen(self):
        forces = random_forces(5)
        pair = "pair_style zero 3\npair_coeff * *"
        blind, plain = in_parallel(lambda gaps, lines: velocities(forces, gaps, pair=lines),
                                   [("yes", ""), ("no", pair)])
        self.assertLess(abs(blind - plain).max() / abs(plain).max(), 1e-14)


def missing_at_plate(gap):
    """In cells: what a sheet of unit traction beside a plate moves too little. Points of the grid
    are half a cell from the plate and one apart; beyond it the flow is its odd reflection."""
    second, fourth = 0.30, 0.2065
    z = np.arange(12) + 0.5
    force = weights(gap - z) - weights(gap + z)
    neighbors = np.concatenate([[-force[0]], force[:-1]]) + np.concatenate([force[1:], [0]])
    velocity = np.minimum.outer(z, z) @ force + second * force - fourth * (neighbors - 2 * force)
    return gap - force @ velocity


class BesidePlates(unittest.TestCase):
    def test_vertices_near_a_plate_move_further_along_it(self):
        # the lower cell's rim is 0.15 to 0.3 cells from the plate
        forces, shift = random_forces(6), 0.2 - (CENTRES[0, 2] + VERTICES[:, 2].min())
        more, less = in_parallel(lambda gaps: velocities(forces, gaps, pair="", plates=True,
                                                         shift=shift), [("yes",), ("no",)])
        added = more - less
        heights = np.concatenate([VERTICES + centre for centre in CENTRES])[:, 2] + shift
        near = heights < 0.5
        self.assertGreater(near.sum(), 10)
        areas = np.tile(mixed_areas(), 2)[:, None]
        mobility = added[near, :2] / (forces / areas)[near, :2] * VISCOSITY
        self.assertGreater(mobility.min(), 0)
        np.testing.assert_allclose(mobility[:, 0], mobility[:, 1], rtol=1e-6)
        expected = np.array([missing_at_plate(height) for height in heights[near] / DX]) * DX
        # that of the range, 3 % of it, is taken off
        np.testing.assert_allclose(mobility[:, 0], expected, atol=0.006)
        self.assertEqual(abs(added[:, 2]).max(), 0)
        self.assertEqual(abs(added[heights > 1]).max(), 0)
        print(f"\nnear a plate: what is added is at most {mobility.max():.3f} um times traction "
              "over viscosity")


if __name__ == "__main__":
    unittest.main()
