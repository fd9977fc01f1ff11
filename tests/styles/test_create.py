"""rbc/create: where cells come to lie, and how they are numbered."""

import re
import unittest
from pathlib import Path

import numpy as np

from lammps_case import POTENTIALS, attempt, dump_line, make_template, read_template, run, scene
from rbc.surface_distances import least_gap

COLUMNS = "id mol type x y z xu yu zu"
CAPSULE = f"molecule capsule {POTENTIALS}/capsule_162.mol"
BOX = np.array([30.0, 24.0, 20.0])


def created(cells, ranks=1, **changes):
    lines = dict(box="region box block 0 30 0 24 0 20", cells=cells, membrane=None, fluid=None,
                 ib=None, thermo=None, dump=dump_line(1, columns=COLUMNS))
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


def order(axes):
    """Largest eigenvalue of the mean of (3 n n - 1) / 2: 0 for isotropic directions, 1 for one
    direction."""
    return abs(np.linalg.eigvalsh(1.5 * axes.T @ axes / len(axes) - 0.5 * np.eye(3))).max()


def order_of_isotropic(count, share, samples=2000):
    """Quantile for independent isotropic directions."""
    directions = np.random.default_rng(1).normal(size=(samples, count, 3))
    directions /= np.linalg.norm(directions, axis=2, keepdims=True)
    return np.quantile([order(axes) for axes in directions], share)


POINTS, TRIANGLES = read_template(POTENTIALS / "rbc_162.mol")


class Single(unittest.TestCase):
    def test_is_the_template_moved(self):
        for centre in ((15, 12, 10), (1, 23.5, 10), (29.999, 0, 2)):
            for ranks in (1, 4):
                with self.subTest(centre, ranks=ranks):
                    dump = created(f"rbc/create rbc single {' '.join(map(str, centre))}",
                                   ranks).dump()
                    np.testing.assert_array_equal(dump("id"), np.arange(1, 163))
                    np.testing.assert_array_equal(dump("mol", "type"), 1)
                    np.testing.assert_allclose(dump.positions(), np.array(centre) + POINTS,
                                               atol=4e-15)
                    wrapped = dump("x", "y", "z")
                    self.assertTrue(((wrapped >= 0) & (wrapped < BOX)).all())

    def test_is_turned_about_its_centre(self):
        for degrees, axis in ((90, (1, 0, 0)), (-33, (1, 2, 3)), (400, (0, 0, -0.5))):
            with self.subTest(degrees, axis=axis):
                dump = created(f"rbc/create rbc single 15 12 10 rotate {degrees} "
                               f"{' '.join(map(str, axis))}").dump()
                expected = np.array([15, 12, 10]) + POINTS @ rotation(degrees, axis).T
                np.testing.assert_allclose(dump.positions(), expected, atol=2e-14)

    def test_numbering_goes_on(self):
        cells = "\n".join(
            [CAPSULE, f"molecule big {POTENTIALS}/rbc_362.mol", "rbc/create rbc single 5 5 5",
             "rbc/create big single 15 5 15 type 2", "rbc/create capsule single 25 20 15 type 3"])
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                dump = created(cells, ranks, create_box="create_box 3 box angle/types 1").dump()
                np.testing.assert_array_equal(dump("id"), np.arange(1, 162 + 362 + 162 + 1))
                expected = np.repeat([1, 2, 3], [162, 362, 162])
                np.testing.assert_array_equal(dump("mol"), expected)
                np.testing.assert_array_equal(dump("type"), expected)
                capsule, _ = read_template(POTENTIALS / "capsule_162.mol")
                np.testing.assert_allclose(dump.positions()[-162:], capsule + [25, 20, 15],
                                           atol=2e-14)

    def test_numbering_goes_on_after_other_atoms(self):
        dump = created("mass 1 1\ncreate_atoms 1 single 1 1 1\nset group all mol 7\n"
                       "rbc/create rbc single 15 12 10").dump()
        np.testing.assert_array_equal(dump("id"), np.arange(1, 164))
        np.testing.assert_array_equal(dump("mol"), [7] + [8] * 162)

    def test_mass_is_set_once(self):
        dump = created("mass 1 3.5\nrbc/create rbc single 15 12 10",
                       dump=dump_line(1, columns="id mass")).dump()
        np.testing.assert_array_equal(dump("mass"), 3.5)


class FromFile(unittest.TestCase):
    def test_is_one_command_for_each_line(self):
        places = ["5 6 7.5", "15 12 10 40 1 -2 0.5", "25 23.9 10 90 0 1 0"]
        singly = created("\n".join("rbc/create rbc single " +
                                   " rotate ".join([" ".join(place.split()[:3]),
                                                    *filter(None, [" ".join(place.split()[3:])])])
                                   for place in places)).dump()
        lines = ["# x y z theta nx ny nz", places[0], "", places[1] + "   # tilted", places[2]]
        for ranks in (1, 2):
            script = scene(box="region box block 0 30 0 24 0 20",
                           cells="rbc/create rbc file cells.txt", membrane=None, fluid=None,
                           ib=None, thermo=None, dump=dump_line(1, columns=COLUMNS))
            result = run(script, ranks, files={"cells.txt": "\n".join(lines) + "\n"})
            for column in COLUMNS.split():
                np.testing.assert_array_equal(result.dump()(column), singly(column),
                                              err_msg=f"{column}, {ranks} ranks")
            self.assertIn("Created 3 cells of 162 vertices", result.printed)


class FromHemoCell(unittest.TestCase):
    def test_turns_about_x_then_y_then_z(self):
        """Where a vertex (x, y, z) of a template goes, found by hand: HemoCell's cells lie with
        their axis along y, and then quarter turns about axes of space follow each other."""
        x, y, z = POINTS.T
        turned = {"0 0 0": (x, -z, y), "90 0 0": (x, -y, -z), "0 90 0": (y, -z, -x),
                  "0 0 90": (z, x, y), "90 90 0": (-z, -y, -x), "90 0 90": (y, x, -z),
                  "0 90 90": (z, y, -x), "90 90 90": (y, -z, -x), "-90 0 0": (x, y, z),
                  "-90 180 -90": (y, x, -z)}
        lines = [str(len(turned))]
        for n, angles in enumerate(turned):
            lines.append(f"{5 + 12 * n} {6 + n} {7 - 0.5 * n} {angles}")
        expected = np.concatenate([np.transpose(points) + (5 + 12 * n, 6 + n, 7 - 0.5 * n)
                                   for n, points in enumerate(turned.values())])
        for ranks in (1, 2):
            result = run(scene(box="region box block 0 130 0 24 0 20", membrane=None, fluid=None,
                               boundary="boundary p p p", cells="rbc/create rbc hemocell RBC.pos",
                               ib=None, thermo=None, dump=dump_line(1, columns=COLUMNS)), ranks,
                         files={"RBC.pos": "\n".join(lines) + "\n"})
            np.testing.assert_allclose(result.dump().positions(), expected, atol=1e-13)
            self.assertIn(f"Created {len(turned)} cells of 162 vertices", result.printed)

    def test_any_angles(self):
        """R = Rz(rz) Ry(ry) Rx(rx), as the tool packCells writes its ellipsoids: from the matrix
        atan2(R21, R22), -asin(R20), atan2(R10, R00) give back what the file says."""
        angles = np.array([33.0, -58.0, 171.0])
        dump = run(scene(box="region box block 0 30 0 24 0 20", membrane=None, fluid=None,
                         cells="rbc/create rbc hemocell RBC.pos", ib=None, thermo=None,
                         dump=dump_line(1, columns=COLUMNS)),
                   files={"RBC.pos": "1\n15 12 10 33 -58 171\n"}).dump()
        along_y = POINTS @ rotation(90, (1, 0, 0)).T
        R = np.linalg.lstsq(along_y, dump.positions() - (15, 12, 10), rcond=None)[0].T
        found = (np.arctan2(R[2, 1], R[2, 2]), -np.arcsin(R[2, 0]), np.arctan2(R[1, 0], R[0, 0]))
        np.testing.assert_allclose(np.degrees(found), angles, atol=1e-10)


class TypeLabels(unittest.TestCase):
    def test_name_types_as_in_create_atoms(self):
        labels = "labelmap atom 1 soft 2 wall 3 stiff\nmass soft 1.0\n"
        cells = ("rbc/create rbc number 4 seed 5 type {} mix rbc 0.5 {}\n"
                 "region tube cylinder x 12 10 9 INF INF\n"
                 "rbc/surface tube type {} spacing 3")
        for ranks in (1, 2):
            dumps = [created(labels + cells.format(*types), ranks,
                             create_box="create_box 3 box angle/types 1").dump()
                     for types in (("soft", "stiff", "wall"), (1, 3, 2))]
            for type, least in ((1, 2 * 162), (2, 1), (3, 2 * 162)):
                self.assertGreaterEqual((dumps[0]("type") == type).sum(), least)
            np.testing.assert_array_equal(dumps[0].frames[0], dumps[1].frames[0])


class Random(unittest.TestCase):
    def check_cells(self, dump, number, overlap, periodic=(True, True, False), box=BOX):
        self.assertEqual(len(dump("id")), number * 162)
        np.testing.assert_array_equal(dump("mol"), np.repeat(np.arange(1, number + 1), 162))
        x = dump.positions().reshape(number, 162, 3)
        for cell in x:    # rigid copies of the template, right-handed
            self.assertAlmostEqual(volume(cell - cell.mean(axis=0), TRIANGLES),
                                   volume(POINTS, TRIANGLES), delta=1e-9)
            np.testing.assert_allclose(np.linalg.norm(cell - cell[0], axis=1),
                                       np.linalg.norm(POINTS - POINTS[0], axis=1),
                                       atol=1e-12)
        self.assertGreaterEqual(
            least_gap([(cell, TRIANGLES) for cell in x], box, periodic, 2 * overlap), overlap)
        for d in range(3):
            if not periodic[d]:
                self.assertGreaterEqual(dump.positions()[:, d].min(), overlap / 2)
                self.assertLessEqual(dump.positions()[:, d].max(), box[d] - overlap / 2)

    def axes(self, dump):
        x = dump.positions().reshape(-1, 162, 3)
        x = x - x.mean(axis=1, keepdims=True)
        return np.array([np.linalg.eigh(cell.T @ cell)[1][:, 0] for cell in x])

    def test_number_is_the_same_on_any_ranks(self):
        cells = "rbc/create rbc number 40 seed 4711"
        dumps = [created(cells, ranks).dump() for ranks in (1, 2, 4)]
        self.check_cells(dumps[0], 40, mean_edge(POINTS, TRIANGLES) / 10)
        for dump in dumps[1:]:
            np.testing.assert_array_equal(dump.positions(), dumps[0].positions())
            np.testing.assert_array_equal(dump("mol"), dumps[0]("mol"))

    def test_hematocrit(self):
        for hematocrit, overlap in ((0.2, 0.5), (0.45, 0.1)):
            number = round(hematocrit * BOX.prod() / volume(POINTS, TRIANGLES))
            for periodic, boundary in (((True, True, False), "p p f"), ((True,) * 3, "p p p")):
                with self.subTest(hematocrit, boundary=boundary):
                    dump = created(f"rbc/create rbc hematocrit {hematocrit} seed 1 overlap "
                                   f"{overlap}", 2, boundary=f"boundary {boundary}").dump()
                    self.check_cells(dump, number, overlap, periodic)

    def test_half_of_a_box_is_cells_in_any_direction(self):
        box = np.array([28.0, 26.0, 25.0])
        dump = created("rbc/create rbc hematocrit 0.5 seed 2", 2, boundary="boundary p p p",
                       box="region box block 0 28 0 26 0 25").dump()
        number = round(0.5 * box.prod() / volume(POINTS, TRIANGLES))
        self.check_cells(dump, number, mean_edge(POINTS, TRIANGLES) / 10, (True,) * 3, box)
        self.assertLess(order(self.axes(dump)), order_of_isotropic(number, 0.999))

    def test_seeds_differ(self):
        a, b = (created(f"rbc/create rbc number 2 seed {seed}").dump().positions()
                for seed in (1, 2))
        self.assertGreater(abs(a - b).max(), 1)

    def test_directions_are_random(self):
        dump = created("rbc/create rbc number 300 seed 3 overlap 0.01",
                       box="region box block 0 300 0 300 0 300").dump()
        self.assertLess(order(self.axes(dump)), order_of_isotropic(300, 0.999))

    def test_the_only_layer_between_near_plates_lies_flat(self):
        dump = created("rbc/create rbc number 4 seed 3",
                       box="region box block 0 30 0 24 0 2.8").dump()
        self.check_cells(dump, 4, mean_edge(POINTS, TRIANGLES) / 10, box=np.array([30, 24, 2.8]))
        self.assertGreater(abs(self.axes(dump)[:, 2]).min(), 0.99)

    def test_region(self):
        vessel = "\n".join([
            "region in cylinder x 12 10 9.5 0 10", "region out cylinder x 12 10 9.5 20 30",
            "region narrows cone x 12 10 9.5 6.5 10 15", "region widens cone x 12 10 6.5 9.5 15 20",
            "region throat union 2 narrows widens"])
        for region, hematocrit, inside, size in (
                ("block 10 25 2 20 1 19", 0.3,
                 lambda x: ((x >= (10, 2, 1)) & (x <= (25, 20, 19))).all(),
                 15 * 18 * 18),
                ("cylinder z 15 12 9 0 20", 0.3,
                 lambda x: (np.hypot(x[:, 0] - 15, x[:, 1] - 12) <= 9).all(),
                 np.pi * 81 * 20),
                ("sphere 15 12 10 8 side out", 0.15,
                 lambda x: (np.linalg.norm((x - (15, 12, 10) + BOX / 2) % BOX - BOX / 2, axis=1) >=
                            8).all(),
                 BOX.prod() - 4 / 3 * np.pi * 512),
                # a vessel with a throat
                ("union 3 in out throat", 0.3,
                 lambda x: (np.hypot(x[:, 1] - 12, x[:, 2] - 10) <= 9.5 -
                            3 * (1 - abs(x[:, 0] % 30 - 15) / 5).clip(0)
                            + 1e-9).all(),
                 np.pi * (9.5**2 * 20 + (9.5**2 + 6.5**2 + 9.5 * 6.5) / 3 * 10))):
            with self.subTest(region):
                dump = created(f"{vessel}\nregion part {region}\n"
                               f"rbc/create rbc hematocrit {hematocrit} seed 5 region part", 2,
                               boundary="boundary p p p").dump()
                number = len(dump("id")) // 162
                self.assertAlmostEqual(number, hematocrit * size / volume(POINTS, TRIANGLES),
                                       delta=0.7)
                self.check_cells(dump, number, mean_edge(POINTS, TRIANGLES) / 10, (True,) * 3)
                self.assertTrue(inside(dump.positions()))

    def test_faces_on_periodic_sides_are_none(self):
        """A dense packing in a region that fills the box along its periodic directions: it reaches
        through them as one that ends at INF, and its cells keep off the other faces alone."""
        for inf, ends, directions in (("block INF INF INF INF 2 18", "block 0 30 0 24 2 18", 2),
                                      ("cylinder x 12 10 9.5 INF INF", "cylinder x 12 10 9.5 0 30",
                                       1)):
            with self.subTest(ends):
                dumps = [created(f"region part {region}\nrbc/create rbc hematocrit 0.36 seed 5 "
                                 "region part", boundary="boundary p p p").dump()
                         for region in (inf, ends)]
                number = len(dumps[1]("id")) // 162
                self.assertEqual(number, len(dumps[0]("id")) // 162)
                self.check_cells(dumps[1], number, mean_edge(POINTS, TRIANGLES) / 10, (True,) * 3)
                x = dumps[1].positions()
                for d, side in list(enumerate(BOX))[:directions]:
                    wrapped = np.sort(x[:, d] % side)
                    gaps = np.diff(np.append(wrapped, wrapped[0] + side))
                    self.assertLess(gaps[-1], mean_edge(POINTS, TRIANGLES) / 10)
                if directions == 2:
                    self.assertTrue(((x[:, 2] >= 2) & (x[:, 2] <= 18)).all())
                else:
                    self.assertTrue((np.hypot(x[:, 1] - 12, x[:, 2] - 10) <= 9.5).all())

    def test_a_failure_names_what_was_reached(self):
        """Faces a little before periodic sides are walls, at which dense packings get stuck."""
        side = "0.01 17.99"
        failed = attempt(scene(
            boundary="boundary p p f", box="region box block 0 18 0 18 0 19",
            cells=f"region off block {side} {side} 0.5 18.5\n"
                  "rbc/create rbc hematocrit 0.475 seed 1 region off attempts 1000"))
        number, part, whole, reached = re.search(
            r"could not pack (\d+) cells, (\S+) of region off and (\S+) of the box, without "
            r"overlap in 1000 attempts; the densest reached is (\S+) of region off",
            failed.error).groups()
        cells = int(number) * volume(POINTS, TRIANGLES)
        self.assertAlmostEqual(float(part), cells / (17.98**2 * 18), delta=1e-4)
        self.assertAlmostEqual(float(whole), cells / (18**2 * 19), delta=1e-4)
        self.assertTrue(0.2 < float(reached) < float(part), failed.error)

    def test_cells_that_are_there_take_room(self):
        failed = attempt(scene(cells="rbc/create rbc single 6 6 6\n"
                                     "rbc/create rbc hematocrit 0.7 seed 1 attempts 100"))
        self.assertIn("without overlap in 100 attempts beside the 162 atoms that are there already "
                      "(a restart file has cells, too); the densest", failed.error)

    def test_a_small_region_of_a_large_box_is_found(self):
        dump = created("region part block 500 510 500 510 5 15\n"
                       "rbc/create rbc number 1 seed 5 region part",
                       box="region box block 0 1000 0 1000 0 20").dump()
        x = dump.positions()
        self.assertTrue(((x >= (500, 500, 5)) & (x <= (510, 510, 15))).all())

    def test_keeps_clear_of_atoms_that_exist(self):
        cells = (f"mass * 1\n{CAPSULE}\nrbc/create capsule number 6 seed 8 type 2\n"
                 "create_atoms 1 single 15 12 10\nset type 1 mol 7\n"
                 "rbc/create rbc number 30 seed 9 overlap 0.4")
        types = "create_box 2 box angle/types 1"
        dumps = [created(cells, ranks, create_box=types).dump() for ranks in (1, 4)]
        np.testing.assert_array_equal(dumps[0].positions(), dumps[1].positions())
        dump = dumps[0]
        np.testing.assert_array_equal(dump("mol"),
                                      np.repeat(np.arange(1, 38), [162] * 6 + [1] + [162] * 30))
        dots = 1e-9 * np.eye(3)
        atoms = [(x + dots, np.array([[0, 1, 2]])) for x in dump.positions()[:6 * 162 + 1]]
        cells = [(x, TRIANGLES) for x in dump.positions()[6 * 162 + 1:].reshape(30, 162, 3)]
        for atom in atoms[::20] + atoms[-1:]:
            self.assertGreaterEqual(least_gap([atom, *cells], BOX, (True, True, False), 1),
                                    0.4 - 1e-8)

    def test_velocity_is_random_for_each_cell(self):
        cells = "rbc/create rbc number 40 seed 4 velocity 0.002"
        velocity = [
            created(cells, ranks, dump=dump_line(1, columns="id vx vy vz")).dump()("vx", "vy", "vz")
            for ranks in (1, 2)]
        np.testing.assert_array_equal(*velocity)
        of_cells = velocity[0].reshape(40, 162, 3)
        np.testing.assert_array_equal(of_cells - of_cells[:, :1], 0)
        values = np.sort(of_cells[:, 0].ravel()) / 0.004 + 0.5
        distance = abs(values - (np.arange(120) + 0.5) / 120).max()
        self.assertLess(distance, 1.95 / np.sqrt(120))    # Kolmogorov and Smirnov: uniform, 0.1 %


class Mixed(unittest.TestCase):
    TYPES = {"create_box": "create_box 3 box angle/types 1"}

    def test_stiff_cells_and_platelets(self):
        make_template("spheroid", "--axis-ratio", "0.3333333", "--diameter", "2.4", "--frequency",
                      "3", "--output", "platelet.mol")
        platelet, their_triangles = read_template("platelet.mol")
        cells = (f"molecule platelet {Path.cwd()}/platelet.mol\n"
                 "rbc/create rbc hematocrit 0.35 seed 6 overlap 0.1 "
                 "mix rbc 0.25 2 mix platelet 0.3 3")
        dumps = [created(cells, ranks, **self.TYPES).dump() for ranks in (1, 2, 4)]
        for dump in dumps[1:]:
            np.testing.assert_array_equal(dump.positions(), dumps[0].positions())
        dump = dumps[0]
        kinds = [dump("type")[dump("mol") == m][0] for m in range(1, int(dump("mol").max()) + 1)]
        self.assertEqual(kinds, sorted(kinds))
        number = len(kinds)
        mean_volume = 0.7 * volume(POINTS, TRIANGLES) + 0.3 * volume(platelet, their_triangles)
        self.assertEqual(number, round(0.35 * BOX.prod() / mean_volume))
        for kind, fraction in ((1, 0.45), (2, 0.25), (3, 0.3)):
            self.assertAlmostEqual(kinds.count(kind), fraction * number, delta=1)
        surfaces = [(dump.positions()[dump("mol") == m + 1],
                     their_triangles if kind == 3 else TRIANGLES)
                    for m, kind in enumerate(kinds)]
        self.assertGreaterEqual(least_gap(surfaces, BOX, (True, True, False), 0.2), 0.1)

    def test_whole_numbers_add_up(self):
        dump = created("rbc/create rbc number 3 seed 6 mix rbc 0.3333 2 mix rbc 0.3333 3",
                       **self.TYPES).dump()
        np.testing.assert_array_equal(dump("type"), np.repeat([1, 2, 3], 162))


class TwoKinds(unittest.TestCase):
    def test_two_membranes_with_different_templates(self):
        # the second template has the longer edges: it decides how far ghosts must reach
        cells = (f"{CAPSULE}\nmolecule fine {POTENTIALS}/rbc_642.mol\n"
                 "rbc/create fine single 8 12 10 rotate 50 1 0 0\n"
                 "rbc/create rbc single 20 12 10 rotate 20 0 1 0 type 2")
        script = scene(
            box="region box block 0 30 0 24 0 20", create_box="create_box 2 box angle/types 1",
            cells=cells, before="group a type 1\ngroup b type 2",
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
                np.testing.assert_allclose(result.thermo[column], result.thermo[column][0],
                                           rtol=1e-4)


if __name__ == "__main__":
    unittest.main()
