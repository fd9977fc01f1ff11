"""rbc/create: where cells come to lie, and how they are numbered."""

import unittest

import numpy as np

from lammps_case import POTENTIALS, dump_line, read_template, run, scene

COLUMNS = "id mol type x y z xu yu zu"
CAPSULE = f"molecule capsule {POTENTIALS}/capsule_162.mol"
BOX = np.array([30.0, 24.0, 20.0])


def created(cells, ranks=1, **changes):
    lines = dict(box="region box block 0 30 0 24 0 20", cells=cells, membrane=None, fluid=None, ib=None, thermo=None,
                 dump=dump_line(1, columns=COLUMNS))
    lines.update(changes)
    return run(scene(**lines), ranks)


def volume(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 6


def mean_edge(points, triangles):
    edges = {tuple(sorted((t[i], t[(i + 1) % 3]))) for t in triangles for i in range(3)}
    return np.mean([np.linalg.norm(points[i] - points[j]) for i, j in edges])


def rotation(degrees, axis):
    a, n = np.radians(degrees), np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    return np.eye(3) + np.sin(a) * cross + (1 - np.cos(a)) * cross @ cross


def least_distance(positions, molecules, periodic=(True, True, False)):
    """Between vertices of different cells."""
    least = np.inf
    for cell in np.unique(molecules)[:-1]:
        own, others = positions[molecules == cell], positions[molecules > cell]
        apart = own[:, None] - others[None]
        for d in range(3):
            if periodic[d]:
                apart[..., d] -= BOX[d] * np.round(apart[..., d] / BOX[d])
        least = min(least, np.linalg.norm(apart, axis=2).min())
    return least


POINTS, TRIANGLES = read_template(POTENTIALS / "rbc_162.mol")


class Single(unittest.TestCase):
    def test_is_the_template_moved(self):
        for centre in ((15, 12, 10), (1, 23.5, 10), (29.999, 0, 2)):
            for ranks in (1, 4):
                with self.subTest(centre, ranks=ranks):
                    dump = created(f"rbc/create rbc single {' '.join(map(str, centre))}", ranks).dump()
                    np.testing.assert_array_equal(dump("id"), np.arange(1, 163))
                    np.testing.assert_array_equal(dump("mol", "type"), 1)
                    np.testing.assert_allclose(dump.positions(), np.array(centre) + POINTS, atol=4e-15)
                    wrapped = dump("x", "y", "z")
                    self.assertTrue(((wrapped >= 0) & (wrapped < BOX)).all())

    def test_is_turned_about_its_centre(self):
        for degrees, axis in ((90, (1, 0, 0)), (-33, (1, 2, 3)), (400, (0, 0, -0.5))):
            with self.subTest(degrees, axis=axis):
                dump = created(f"rbc/create rbc single 15 12 10 rotate {degrees} {' '.join(map(str, axis))}").dump()
                expected = np.array([15, 12, 10]) + POINTS @ rotation(degrees, axis).T
                np.testing.assert_allclose(dump.positions(), expected, atol=2e-14)

    def test_numbering_goes_on(self):
        cells = "\n".join([CAPSULE, f"molecule big {POTENTIALS}/rbc_362.mol", "rbc/create rbc single 5 5 5",
                           "rbc/create big single 15 5 15 type 2", "rbc/create capsule single 25 20 15 type 3"])
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                dump = created(cells, ranks, create_box="create_box 3 box angle/types 1").dump()
                np.testing.assert_array_equal(dump("id"), np.arange(1, 162 + 362 + 162 + 1))
                expected = np.repeat([1, 2, 3], [162, 362, 162])
                np.testing.assert_array_equal(dump("mol"), expected)
                np.testing.assert_array_equal(dump("type"), expected)
                capsule, _ = read_template(POTENTIALS / "capsule_162.mol")
                np.testing.assert_allclose(dump.positions()[-162:], capsule + [25, 20, 15], atol=2e-14)

    def test_numbering_goes_on_after_other_atoms(self):
        dump = created("mass 1 1\ncreate_atoms 1 single 1 1 1\nset group all mol 7\n"
                       "rbc/create rbc single 15 12 10").dump()
        np.testing.assert_array_equal(dump("id"), np.arange(1, 164))
        np.testing.assert_array_equal(dump("mol"), [7] + [8] * 162)

    def test_mass_is_set_once(self):
        dump = created("mass 1 3.5\nrbc/create rbc single 15 12 10", dump=dump_line(1, columns="id mass")).dump()
        np.testing.assert_array_equal(dump("mass"), 3.5)


class Random(unittest.TestCase):
    def check_cells(self, dump, number, overlap, periodic=(True, True, False)):
        self.assertEqual(len(dump("id")), number * 162)
        np.testing.assert_array_equal(dump("mol"), np.repeat(np.arange(1, number + 1), 162))
        x = dump.positions().reshape(number, 162, 3)
        for cell in x:    # rigid copies of the template, right-handed
            self.assertAlmostEqual(volume(cell - cell.mean(axis=0), TRIANGLES), volume(POINTS, TRIANGLES), delta=1e-9)
            np.testing.assert_allclose(np.linalg.norm(cell - cell[0], axis=1),
                                       np.linalg.norm(POINTS - POINTS[0], axis=1),
                                       atol=1e-12)
        self.assertGreaterEqual(least_distance(dump.positions(), dump("mol"), periodic), overlap)
        for d in range(3):
            if not periodic[d]:
                self.assertGreaterEqual(dump.positions()[:, d].min(), overlap / 2)
                self.assertLessEqual(dump.positions()[:, d].max(), BOX[d] - overlap / 2)

    def test_number_is_the_same_on_any_ranks(self):
        dumps = [created("rbc/create rbc number 14 seed 4711", ranks).dump() for ranks in (1, 4)]
        self.check_cells(dumps[0], 14, mean_edge(POINTS, TRIANGLES))
        np.testing.assert_array_equal(dumps[0].positions(), dumps[1].positions())
        np.testing.assert_array_equal(dumps[0]("mol"), dumps[1]("mol"))

    def test_hematocrit(self):
        for hematocrit in (0.1, 0.2):
            number = round(hematocrit * BOX.prod() / volume(POINTS, TRIANGLES))
            for periodic, boundary in (((True, True, False), "p p f"), ((True,) * 3, "p p p")):
                with self.subTest(hematocrit, boundary=boundary):
                    dump = created(f"rbc/create rbc hematocrit {hematocrit} seed 1 overlap 0.3 attempts 100000",
                                   boundary=f"boundary {boundary}").dump()
                    self.check_cells(dump, number, 0.3, periodic)

    def test_seeds_differ(self):
        a, b = (created(f"rbc/create rbc number 2 seed {seed}").dump().positions() for seed in (1, 2))
        self.assertGreater(abs(a - b).max(), 1)

    def test_directions_are_random(self):
        # the mean of n n^T over directions n of the axis of the disc is 1/3
        dump = created("rbc/create rbc number 300 seed 3 overlap 0.01 attempts 1000",
                       box="region box block 0 300 0 300 0 300").dump()
        x = dump.positions().reshape(300, 162, 3)
        x = x - x.mean(axis=1, keepdims=True)
        axes = np.array([np.linalg.eigh(cell.T @ cell)[1][:, 0] for cell in x])
        self.assertLess(abs(axes.T @ axes / 300 - np.eye(3) / 3).max(), 0.08)

    def test_region(self):
        for region, inside, size in (
                ("block 10 25 2 20 1 19", lambda x: ((x >= (10, 2, 1)) & (x <= (25, 20, 19))).all(), 15 * 18 * 18),
                ("cylinder z 15 12 9 0 20", lambda x: (np.hypot(x[:, 0] - 15, x[:, 1] - 12) <= 9).all(),
                 np.pi * 81 * 20)):
            with self.subTest(region):
                dump = created(f"region part {region}\nrbc/create rbc hematocrit 0.15 seed 5 region part overlap 0.2 "
                               "attempts 100000").dump()
                number = len(dump("id")) // 162
                self.assertAlmostEqual(number, 0.15 * size / volume(POINTS, TRIANGLES), delta=0.6)
                self.check_cells(dump, number, 0.2)
                self.assertTrue(inside(dump.positions()))

    def test_a_small_region_of_a_large_box_is_found(self):
        dump = created("region part block 500 510 500 510 5 15\nrbc/create rbc number 1 seed 5 region part",
                       box="region box block 0 1000 0 1000 0 20").dump()
        x = dump.positions()
        self.assertTrue(((x >= (500, 500, 5)) & (x <= (510, 510, 15))).all())

    def test_second_call_keeps_clear_of_the_first(self):
        cells = (f"{CAPSULE}\nrbc/create rbc number 8 seed 8\n"
                 "rbc/create capsule number 12 seed 9 type 2 overlap 0.4 attempts 10000")
        types = "create_box 2 box angle/types 1"
        dumps = [created(cells, ranks, create_box=types).dump() for ranks in (1, 4)]
        np.testing.assert_array_equal(dumps[0].positions(), dumps[1].positions())
        dump = dumps[0]
        np.testing.assert_array_equal(dump("id"), np.arange(1, 20 * 162 + 1))
        np.testing.assert_array_equal(dump("mol"), np.repeat(np.arange(1, 21), 162))
        np.testing.assert_array_equal(dump("type"), np.repeat([1, 2], [8 * 162, 12 * 162]))
        self.assertGreaterEqual(least_distance(dump.positions(), dump("mol")), 0.4)


class TwoKinds(unittest.TestCase):
    def test_two_membranes_with_different_templates(self):
        # the second template has the longer edges: it decides how far ghosts must reach
        cells = f"{CAPSULE}\nmolecule fine {POTENTIALS}/rbc_642.mol\n" \
                "rbc/create fine single 8 12 10 rotate 50 1 0 0\nrbc/create rbc single 20 12 10 rotate 20 0 1 0 type 2"
        script = scene(
            box="region box block 0 30 0 24 0 20", create_box="create_box 2 box angle/types 1", cells=cells,
            before="group a type 1\ngroup b type 2",
            membrane="fix mem a rbc/membrane fine mooney-rivlin 0.257 0.0257 0.01 bending 2e-4\n"
                     "fix mem2 b rbc/membrane rbc skalak 0.005 1 bending 2e-4",
            compute="compute cell all rbc/cell",
            thermo="thermo_style custom step f_mem f_mem2 f_flow[11] "
                   "c_cell[1][1] c_cell[2][1] c_cell[1][6] c_cell[2][6]",
            dump=dump_line(20), run="run 20")
        results = [run(script, ranks) for ranks in (1, 2, 4)]
        reference = results[0].dump().positions()
        for result in results:
            self.assertLess(abs(result.dump().positions() - reference).max(), 1e-10)
            self.assertEqual(result.thermo["c_cell[1][1]"][0], 1)
            self.assertEqual(result.thermo["c_cell[2][1]"][0], 2)
            self.assertLess(result.thermo["f_flow[11]"].max(), 1e-12)
            for column in ("c_cell[1][6]", "c_cell[2][6]"):
                np.testing.assert_allclose(result.thermo[column], result.thermo[column][0], rtol=1e-4)


if __name__ == "__main__":
    unittest.main()
