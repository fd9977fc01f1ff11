"""compute rbc/aggregate against a brute-force count from the dumped vertices, on 1, 2 and 4
ranks."""

import sys
import unittest

import numpy as np

from lammps_case import POTENTIALS, ROOT, dump_line, in_parallel, read_template, run, scene

sys.path.insert(0, str(ROOT / "scripts"))
from rbc.tables import read_ave_time, read_table  # noqa: E402

SHAPE = "rbc_162"
GAP = 0.3
THERMO = "thermo_style custom step " + " ".join(f"c_agg[{n}]" for n in range(1, 6))
DUMP = dump_line(1, columns="id mol xu yu zu c_agg")


def aggregate_scene(arguments=GAP, group="all", **changes):
    """Cells without flow in a periodic box of 24."""
    lines = dict(box="region box block 0 24 0 24 0 24", boundary="boundary p p p", fluid=None,
                 ib=None, neighbor="neighbor 1.0 bin\ncomm_modify cutoff 4",
                 compute=f"compute agg {group} rbc/aggregate {arguments}", thermo=THERMO, dump=DUMP)
    lines.update(changes)
    return scene(**lines)


def distances(points, triangles):
    """Distance of each point to the nearest of the triangles [triangle, corner, 3], by the region
    of each triangle's plane in which the point's foot lies: the face, or else the nearest of its
    three edges."""
    a, b, c = triangles.transpose(1, 0, 2)
    p = points[:, None]
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    height = np.einsum("ptd,td->pt", p - a, normal)
    inside = np.ones(height.shape, dtype=bool)
    nearest = np.full(height.shape, np.inf)
    for u, v in ((a, b), (b, c), (c, a)):
        edge = v - u
        inside &= np.einsum("ptd,td->pt", p - u, np.cross(normal, edge)) >= 0
        along = np.clip(np.einsum("ptd,td->pt", p - u, edge) / (edge**2).sum(axis=1), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(p - u - along[..., None] * edge, axis=2))
    return np.where(inside, np.abs(height), nearest).min(axis=1)


def vertex_areas(points, triangles):
    """A third of the triangles around each."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return np.bincount(triangles.ravel(), np.repeat(area / 3, 3), minlength=len(points))


def touched_shares(cells, gap, box, periodic=(1, 1, 1)):
    """Share of cell i's area within the gap of cell j, [i, j], over the images of j; whether any
    vertex of it is. Cells are (points that stick together, triangles)."""
    images = np.stack(
        np.meshgrid(*[(-1, 0, 1) if side else (0,) for side in periodic], indexing="ij"), -1)
    shares, touched = np.zeros((2, len(cells), len(cells)))
    for i, (points, triangles) in enumerate(cells):
        areas = vertex_areas(points, triangles)
        for j, (other, corners) in enumerate(cells):
            if i == j:
                continue
            other = other - box * np.round((other.mean(0) - points.mean(0)) / box) * periodic
            near = np.zeros(len(points), dtype=bool)
            for shift in images.reshape(-1, 3) * box:
                low, high = (other + shift).min(0) - gap, (other + shift).max(0) + gap
                close = ((points > low) & (points < high)).all(axis=1)
                if close.any():
                    near[close] |= distances(points[close], (other + shift)[corners]) < gap
            shares[i, j] = areas[near].sum() / areas.sum()
            touched[i, j] = near.any()
    return shares, touched.astype(bool)


def aggregates(touching):
    """Smallest cell that each is connected to, by passing it on along the pairs."""
    label = np.arange(len(touching))
    for _ in range(len(touching)):
        label = np.array(
            [min(label[touching[i]].min(initial=label[i]), label[i]) for i in range(len(label))])
    return label


def statistics(label):
    """As the vector and the array of the compute."""
    sizes = np.unique(label, return_counts=True)[1]
    vector = [len(sizes), sizes.mean(), np.median(sizes), sizes.max(),
              (sizes == 1).sum() / len(label)]
    rows = int(np.log2(len(label)) + 1e-9) + 1
    counts = np.histogram(sizes, 2.0**np.arange(rows + 1))[0]
    return vector, np.column_stack([2.0**np.arange(rows), counts, counts / len(sizes)])


def labels(result, frame=-1):
    """Aggregate ID of each cell, which all its vertices must have."""
    molecules, ids = result.dump()("mol", "c_agg", frame=frame).T
    found = np.array([np.unique(ids[molecules == molecule]) for molecule in np.unique(molecules)])
    return found[:, 0]


def vector(result, at=-1):
    return [result.thermo[f"c_agg[{n}]"][at] for n in range(1, 6)]


def cells_of(result, shapes, frame=-1):
    """(points, triangles) of each cell; the names of the templates in order of molecule ID."""
    templates = {name: read_template(POTENTIALS / f"{name}.mol") for name in set(shapes)}
    sizes = [len(templates[name][0]) for name in shapes]
    points = np.split(result.dump().positions(frame), np.cumsum(sizes)[:-1])
    return [(x, templates[name][1]) for x, name in zip(points, shapes)]


def histogram(path):
    """Counts in the bins of a file of fix ave/histo with one block."""
    lines = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    return np.array([line[2] for line in lines[1:]], dtype=float)


class Case(unittest.TestCase):
    def assert_brute_force(self, result, gap, box, periodic, shapes, share=0.0, frame=-1):
        shares, touched = touched_shares(cells_of(result, shapes, frame), gap, np.asarray(box),
                                         np.array(periodic))
        label = aggregates(np.maximum(shares, shares.T) >= share if share else touched | touched.T)
        np.testing.assert_array_equal(labels(result, frame), label + 1)
        np.testing.assert_allclose(vector(result, frame), statistics(label)[0], rtol=1e-14)
        return label


class RandomSuspension(Case):
    """Cells as they were placed, many of them across the sides of the box."""

    def check(self, arguments, gap, periodic=(1, 1, 1), share=0.0):
        boundary = " ".join("fp"[side] for side in periodic)
        results = in_parallel(
            lambda ranks: run(aggregate_scene(
                arguments, cells="rbc/create rbc number 40 seed 4711 overlap 0.2 attempts 20000",
                boundary=f"boundary {boundary}"), ranks), [(ranks,) for ranks in (1, 2, 4)])
        label = self.assert_brute_force(results[0], gap, 3 * [24.0], periodic, 40 * ["rbc_162"],
                                        share)
        for ranks, result in zip((2, 4), results[1:]):
            with self.subTest(arguments, ranks=ranks):
                np.testing.assert_array_equal(labels(result), label + 1)
                self.assertEqual(vector(result), vector(results[0]))
        return len(np.unique(label))

    def test_any_vertex(self):
        sizes = [self.check(gap, gap) for gap in (0.22, 0.25, 0.3)]
        self.assertGreater(sizes[0], sizes[1])    # each gap joins some that the one before did not
        self.assertGreater(sizes[1], sizes[2])

    def test_between_walls(self):
        self.check(0.24, 0.24, (1, 1, 0))

    def test_share_of_the_area(self):
        loose = self.check("0.8 area 0.02", 0.8, share=0.02)
        tight = self.check("0.8 area 0.1", 0.8, share=0.1)
        self.assertGreater(tight, loose)


class Moving(Case):
    def test_cells_that_fly_through_each_other(self):
        # and through the sides of the box, from rank to rank
        self.fly()

    def test_what_a_pair_style_has_found(self):
        # the pair style sees further; the forces are far too weak to matter
        self.fly(before="pair_style rbc/jkr 0.6\npair_coeff 1 1 repulsive 1.0e-12 0.5",
                 neighbor="neighbor 1.0 bin\ncomm_modify cutoff 6")

    def fly(self, **changes):
        random = np.random.default_rng(2)
        cells = 12
        velocities = random.normal(size=(cells, 3))
        flight = "\n".join("group cell molecule {0}\nvelocity cell set {1} {2} {3}\n"
                           "group cell delete".format(n, *v)
                           for n, v in enumerate(velocities, 1))
        for ranks in (1, 2, 4):
            with self.subTest(ranks=ranks):
                result = run(aggregate_scene(
                    f"{GAP} area 0.01",
                    cells=f"rbc/create rbc number {cells} seed 3 overlap 1.0 attempts 20000",
                    last=flight + "\nfix fly all nve\nneigh_modify delay 0 every 1 check yes",
                    timestep="timestep 0.2",
                    box="region box block 0 20 0 18 0 16", run="run 60", every="thermo 10",
                    dump=dump_line(10, columns="id mol xu yu zu c_agg"), **changes), ranks)
                found = [self.assert_brute_force(result, GAP, (20, 18, 16), (1, 1, 1),
                                                 cells * ["rbc_162"], 0.01, frame)
                         for frame in range(7)]
                self.assertGreater(len({tuple(label) for label in found}), 3)
                moved = result.dump().positions(-1) - result.dump().positions(0)
                np.testing.assert_allclose(moved, np.repeat(12 * velocities, 162, axis=0),
                                           atol=1e-3)


SPHERES = dict(molecule=f"molecule rbc {POTENTIALS}/capsule_362.mol",
               membrane="fix mem all rbc/membrane rbc neo-hookean 0.005")


def row_of_spheres(gaps, templates="rbc"):
    """Lines that place spheres along x with these gaps, the last to the first through the side of
    the box; its length."""
    points, _ = read_template(POTENTIALS / "capsule_362.mol")
    width = np.ptp(points[:, 0])    # a vertex on either side
    places = np.concatenate([[0.2], 0.2 + np.cumsum(width + np.asarray(gaps[:-1]))])
    length = len(gaps) * width + sum(gaps)
    return "\n".join(f"rbc/create rbc single {float(x)!r} 5 5" for x in places), float(length)


class Chains(Case):
    near, far = 0.15, 0.6

    def chain(self, sizes, closed=True, **changes):
        """Aggregates of these sizes one after the other."""
        gaps = np.concatenate([[self.near] * (size - 1) + [self.far] for size in sizes])
        cells, length = row_of_spheres(gaps)
        return {**SPHERES, "cells": cells, "box": f"region box block 0 {length!r} 0 10 0 10",
                **changes}

    def check_sizes(self, result, label):
        np.testing.assert_array_equal(labels(result), label)
        np.testing.assert_allclose(vector(result), statistics(label)[0], rtol=1e-14)

    def test_of_known_sizes(self):
        for sizes in ([1, 2, 3, 4], [8], [1]):
            label = np.repeat(np.cumsum([1, *sizes[:-1]]), sizes)
            for ranks in (1, 2, 4):
                with self.subTest(sizes, ranks=ranks):
                    self.check_sizes(run(aggregate_scene(GAP, **self.chain(sizes)), ranks), label)

    def test_across_the_side(self):
        # the first and the last join where the side is periodic
        cells, length = row_of_spheres([self.near, self.far, self.near, self.near])
        for boundary, label in (("p p p", [1, 1, 1, 1]), ("f p p", [1, 1, 3, 3])):
            for ranks in (1, 2, 4):
                with self.subTest(boundary, ranks=ranks):
                    box = f"region box block {-5 if 'f' in boundary else 0} {length!r} 0 10 0 10"
                    self.check_sizes(run(
                        aggregate_scene(GAP, **{**SPHERES, "cells": cells, "box": box,
                                                "boundary": f"boundary {boundary}"}), ranks), label)

    def test_cells_outside_the_group_join_nothing(self):
        # three in a row, of which the middle one has a vertex outside the group
        lines = self.chain([3, 1], before="group one id 500\ngroup most subtract all one")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(aggregate_scene(GAP, "most", **lines), ranks)
                np.testing.assert_array_equal(labels(result), [1, 0, 3, 4])
                np.testing.assert_array_equal(vector(result), [3, 1, 1, 1, 1])

    def test_cells_of_two_templates(self):
        # a small sphere between two cells
        lines = dict(
            box="region box block 0 20 0 20 0 20", create_box="create_box 2 box angle/types 1",
            cells=f"molecule small {POTENTIALS}/capsule_162.mol scale 0.4\n"
                  "rbc/create rbc single 4 10 10\n"
                  "rbc/create small single 9.5 10 10 type 2\nrbc/create rbc single 15 10 10",
            before="group discs type 1\ngroup balls type 2",
            membrane="fix mem discs rbc/membrane rbc neo-hookean 0.005\n"
                     "fix ball balls rbc/membrane small neo-hookean 0.005")
        for gap in (0.3, 0.5, 1.0):
            results = in_parallel(lambda ranks, gap=gap: run(aggregate_scene(gap, **lines), ranks),
                                  [(ranks,) for ranks in (1, 2, 4)])
            for result in results:
                self.assert_brute_force(result, gap, 3 * [20.0], (1, 1, 1),
                                        ["rbc_162", "capsule_162", "rbc_162"])

    def test_more_cells_and_fewer(self):
        lines = self.chain([2, 1], run="run 0\nrbc/create rbc single 4 5 15\nrun 0\n"
                                       "group first molecule 1\n"
                                       "delete_atoms group first compress no\nrun 0", dump="")
        lines["box"] = lines["box"].replace("0 10 0 10", "0 10 0 20")
        result = run(aggregate_scene(GAP, **lines), 2)
        np.testing.assert_array_equal(result.thermo["c_agg[1]"], [2, 3, 3])
        np.testing.assert_allclose(result.thermo["c_agg[5]"], [1 / 3, 1 / 2, 1])


class AreaShare(Case):
    def test_of_a_sphere_near_another(self):
        # within g of a sphere of radius R at distance d lies the cap with (R + g)^2 >= R^2 + d^2 -
        # 2 R d cos: a share of (1 - cos) / 2, found to within a ring of vertices
        points, _ = read_template(POTENTIALS / "capsule_642.mol")
        radius = np.linalg.norm(points, axis=1).mean()
        distance = 2 * radius + 0.2
        ring = 1.5 * np.sqrt(4 * np.pi / len(points))
        for gap, ranks in ((0.6, 1), (1.0, 2), (1.5, 4)):
            angle = np.arccos(
                (distance**2 + radius**2 - (radius + gap)**2) / (2 * distance * radius))
            least, most = ((1 - np.cos(angle + d)) / 2 for d in (-ring / 2, ring / 2))
            self.assertLess(most / least, 2.5)
            for share, expected in ((least, 1), (most, 2)):
                with self.subTest(gap=gap, ranks=ranks, expected=expected):
                    result = run(aggregate_scene(
                        f"{gap} area {share}",
                        molecule=f"molecule rbc {POTENTIALS}/capsule_642.mol",
                        membrane=SPHERES["membrane"], box="region box block 0 24 0 24 0 12",
                        dump="", cells="rbc/create rbc single 6 12 6\n"
                                       f"rbc/create rbc single {6 + distance} 12 6"), ranks)
                    self.assertEqual(result.thermo["c_agg[1]"][0], expected)

    def test_one_of_the_two_is_enough(self):
        # a small sphere near a large one: the share of the small one counts
        lines = dict(box="region box block 0 24 0 12 0 12",
                     create_box="create_box 2 box angle/types 1", dump="",
                     cells=f"molecule small {POTENTIALS}/capsule_642.mol scale 0.3\n"
                           f"molecule large {POTENTIALS}/capsule_642.mol\n"
                           "rbc/create large single 6 6 6\n"
                           "rbc/create small single {} 6 6 type 2",
                     before="group large type 1\ngroup small type 2",
                     membrane="fix mem large rbc/membrane large neo-hookean 0.005\n"
                              "fix ball small rbc/membrane small neo-hookean 0.005")
        radius = np.linalg.norm(read_template(POTENTIALS / "capsule_642.mol")[0], axis=1).mean()
        radii = [radius, 0.3 * radius]
        gap, distance = 0.2, sum(radii) + 0.1
        lines["cells"] = lines["cells"].format(6 + distance)
        shares = []
        for own, other in (radii, radii[::-1]):
            cosine = (distance**2 + own**2 - (other + gap)**2) / (2 * distance * own)
            shares.append((1 - cosine) / 2)
        self.assertGreater(shares[1], 3 * shares[0])
        for share, expected in ((0.7 * shares[1], 1), (1.4 * shares[1], 2)):
            result = run(aggregate_scene(f"{gap} area {share}", **lines), 2)
            self.assertEqual(result.thermo["c_agg[1]"][0], expected)


class Outputs(Case):
    def test_what_lammps_does_with_it(self):
        # single cells 1 to 3, pairs from 4 on, one aggregate of five from 8 on
        sizes = [1, 1, 1, 2, 2, 5]
        label = np.repeat(np.cumsum([1, *sizes[:-1]]), sizes)
        lines = Chains().chain(sizes, thermo=THERMO +
                               " c_agg[3][1] c_agg[3][2] c_agg[3][3] v_median c_highest")
        lines["compute"] = f"""compute agg all rbc/aggregate {GAP}
variable    median equal c_agg[3]+1
variable    id atom c_agg
compute     highest all reduce max v_id
compute     molecule all chunk/atom molecule compress yes
compute     member all reduce/chunk molecule max c_agg
fix         sizes all ave/time 1 1 1 c_agg[*] file sizes.dat
fix         classes all ave/time 1 1 1 c_agg[*] mode vector file classes.dat
fix         members all ave/time 1 1 1 c_member mode vector file member.dat
fix         ids all ave/histo 1 1 1 0.5 12.5 12 c_agg mode vector kind peratom file ids.dat ave one
fix         shares all ave/histo 1 1 1 0 1 4 c_agg[3] mode vector kind global &
            file shares.dat ave one
fix         out all rbc/vtk 1 cells.*.vtp aggregate agg"""
        for ranks in (1, 2, 4):
            with self.subTest(ranks=ranks):
                result = run(aggregate_scene(GAP, **lines), ranks)
                numbers, classes = statistics(label)
                np.testing.assert_allclose(vector(result), numbers, rtol=1e-14)
                np.testing.assert_allclose([result.thermo[f"c_agg[3][{n}]"][0] for n in (1, 2, 3)],
                                           classes[2])
                self.assertEqual(result.thermo["v_median"][0], np.median(sizes) + 1)
                self.assertEqual(result.thermo["c_highest"][0], 8)
                table = read_table(result.path("sizes.dat"))
                np.testing.assert_allclose([table[f"c_agg[{n}]"][0] for n in range(1, 6)], numbers,
                                           rtol=1e-5)
                np.testing.assert_allclose(read_ave_time(result.path("classes.dat")).data[0],
                                           classes, rtol=1e-5)
                np.testing.assert_array_equal(
                    read_ave_time(result.path("member.dat")).data[0, :, 0], label)
                np.testing.assert_array_equal(histogram(result.path("ids.dat")),
                                              362 * np.bincount(label, minlength=13)[1:])
                np.testing.assert_array_equal(histogram(result.path("shares.dat")),
                                              np.histogram(classes[:, 2], 4, (0, 1))[0])

    def test_rerun_finds_the_same_in_a_dump(self):
        again = "undump atoms\nrerun atoms.dump dump x y z ix iy iz"
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(aggregate_scene(
                    GAP, cells="rbc/create rbc number 10 seed 3 overlap 0.2 attempts 20000",
                    timestep="timestep 0.5",
                    last="group first molecule 1:3\nvelocity first set 0.5 0 0\nfix fly all nve",
                    every="thermo 5",
                    dump=dump_line(5, columns="id type x y z ix iy iz"),
                    run="run 40\n" + again), ranks)
                first, second = result.tables()
                self.assertGreater(len(set(first["c_agg[1]"])), 1)
                for name, values in first.items():
                    np.testing.assert_array_equal(second[name], values)


if __name__ == "__main__":
    unittest.main()
