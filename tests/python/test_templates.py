#!/usr/bin/python3
"""Templates, materials and table readers: /usr/bin/python3 -m unittest discover tests/python"""
import contextlib
import io
import math
import re
import shlex
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
POTENTIALS = ROOT / "potentials"
sys.path[:0] = [str(POTENTIALS), str(ROOT / "scripts")]
sys.dont_write_bytecode = True

import make_template  # noqa: E402
import shapes  # noqa: E402
import surface_mesh  # noqa: E402
from rbc.commands import plot  # noqa: E402
from rbc.errors import InputError  # noqa: E402
from rbc.shapes import angle_to_flow  # noqa: E402
from rbc.shear_plot import reference_series  # noqa: E402
from rbc.tables import read_ave_time, read_csv, read_table  # noqa: E402

GEODESIC = [f"{shape}_{size}.mol" for shape in ("rbc", "capsule") for size in (162, 362, 642, 2562)]
SHIPPED = GEODESIC + ["rbc_642_spheroid95.mol", "rbc_162_spheroid98.mol", "rbc_642_spheroid98.mol",
                      "platelet_42.mol", "white_362.mol", "white_362_relaxed.mol"]


def make(*words):
    """What the script prints on both streams."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
        make_template.main(list(map(str, words)))
    return output.getvalue()


def read_molecule(path):
    """Coordinates and triangles (from 0) of a molecule file, by a reader of its own."""
    sections, name = {}, None
    for line in Path(path).read_text().splitlines()[1:]:
        words = line.split()
        if words and words[0].isalpha():
            name = words[0]
            sections[name] = []
        elif words and name:
            sections[name].append([float(word) for word in words])
    points, angles = np.array(sections["Coords"]), np.array(sections["Angles"])
    assert (points[:, 0] == np.arange(1, len(points) + 1)).all()
    assert (angles[:, 0] == np.arange(1, len(angles) + 1)).all() and (angles[:, 1] == 1).all()
    assert np.array(sections["Types"])[:, 1].tolist() == [1] * len(points)
    return points[:, 1:], angles[:, 2:].astype(int) - 1


def disc_area_and_volume(radius):
    """Area and volume of equation 1's disc by Simpson's rule in phi, r = R sin(phi)."""
    a0, a1, a2 = 0.207, 2.002, -1.122
    phi = np.linspace(0, math.pi / 2, 20001)
    r = np.sin(phi)
    y = 0.5 * np.cos(phi) * (a0 + a1 * r**2 + a2 * r**4)
    dr, dy = np.cos(phi), np.gradient(y, phi, edge_order=2)
    weight = np.full(len(phi), 2.0)
    weight[1::2], weight[[0, -1]] = 4, 1
    weight *= (phi[1] - phi[0]) / 3
    area = 2 * (weight * 2 * math.pi * r * np.hypot(dr, dy)).sum()
    volume = 2 * (weight * 2 * math.pi * r * y * dr).sum()
    return area * radius**2, volume * radius**3


def area_and_volume(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    return np.linalg.norm(normal, axis=1).sum() / 2, (a * normal).sum() / 6


class Template(unittest.TestCase):
    def assert_closed_and_outward(self, points, triangles):
        edges = Counter((int(t[i]), int(t[i - 2])) for t in triangles for i in range(3))
        self.assertEqual(set(edges.values()), {1})
        self.assertTrue(all((b, a) in edges for a, b in edges))
        self.assertEqual(len(points) - len(edges) // 2 + len(triangles), 2)
        self.assertEqual(sorted(set(triangles.ravel())), list(range(len(points))))
        self.assertGreater(area_and_volume(points, triangles)[1], 0)

    def test_any_frequency_gives_a_closed_outward_surface(self):
        for shape in ("sphere", "disc"):
            for f in (1, 2, 3, 5, 7, 8, 12, 13, 32):
                with self.subTest(shape=shape, frequency=f):
                    points, triangles = make_template.template(shape, f, 1.7)
                    self.assertEqual(len(points), 10 * f * f + 2)
                    self.assertEqual(len(triangles), 20 * f * f)
                    self.assert_closed_and_outward(points, triangles)
                    self.assertLess(np.abs(points.mean(axis=0)).max(), 1e-13)
                    valence = np.bincount(triangles.ravel())
                    self.assertEqual(np.count_nonzero(valence == 5), 12)
                    self.assertEqual(np.count_nonzero(valence == 6), len(points) - 12)

    def test_vertices_lie_on_the_smooth_surface(self):
        sphere, _ = make_template.template("sphere", 7, 2.0)
        np.testing.assert_allclose(np.linalg.norm(sphere, axis=1), 2, rtol=1e-15)
        disc, _ = make_template.template("disc", 7, 3.91)
        square = (disc[:, :2]**2).sum(axis=1) / 3.91**2
        height = 0.5 * 3.91 * np.sqrt(np.maximum(1 - square, 0)) * (
            0.207 + 2.002 * square - 1.122 * square**2)
        # Next to the rim the slope is infinite: round-off in r shows as its square root.
        np.testing.assert_allclose(np.abs(disc[:, 2]), height, atol=1e-6)

    def test_disc_is_symmetric(self):
        points, _ = make_template.template("disc", 6, 3.91)
        rounded = {tuple(p) for p in np.round(points, 10) + 0.0}
        for mirror in np.eye(3):
            mirrored = np.round(points * (1 - 2 * mirror), 10) + 0.0
            self.assertEqual(rounded, {tuple(p) for p in mirrored})

    def test_area_and_volume_converge_at_second_order(self):
        smooth = {"sphere": (4 * math.pi, 4 / 3 * math.pi), "disc": disc_area_and_volume(1)}
        for shape, exact in smooth.items():
            errors = np.array([1 - np.array(area_and_volume(*make_template.template(shape, f, 1)))
                               / exact for f in (8, 16, 32)])
            self.assertTrue((errors > 0).all() and (errors[-1] < 1e-3).all())
            orders = np.log2(errors[:-1] / errors[1:])
            self.assertLess(np.abs(orders - 2).max(), 0.05, (shape, orders))
            np.testing.assert_allclose(make_template.exact(shape, 1), exact, rtol=1e-7)

    def test_match_volume_scales_to_the_smooth_volume(self):
        plain, _ = make_template.template("disc", 4, 3.91)
        points, triangles = make_template.template("disc", 4, 3.91, match_volume=True)
        self.assertAlmostEqual(area_and_volume(points, triangles)[1],
                               disc_area_and_volume(3.91)[1], places=5)
        ratio = points[np.abs(plain) > 0.1] / plain[np.abs(plain) > 0.1]
        np.testing.assert_allclose(ratio, ratio[0], rtol=1e-13)

    def test_match_volume_goes_with_all_shapes(self):
        ellipsoid = math.pi / 6
        for words, volume in (("sphere --radius 2", ellipsoid * 64),
                              ("disc --diameter 7.82", disc_area_and_volume(3.91)[1]),
                              ("spheroid --axis-ratio 0.4 --diameter 3", ellipsoid * 0.4 * 27),
                              ("spheroid --reduced-volume 1 --diameter 3", ellipsoid * 27),
                              ("sickle --length 15 --width 4 --thickness 3",
                               ellipsoid * 15 * 4 * 3)):
            with self.subTest(words), tempfile.TemporaryDirectory() as folder:
                file = Path(folder, "s.mol")
                make(*words.split(), "-f", 3, "--match-volume", "-o", file)
                found = area_and_volume(*read_molecule(file))[1]
                self.assertAlmostEqual(found / volume, 1, delta=1e-7)

    def test_triangles_are_well_shaped(self):
        for shape, angle, area_ratio in (("sphere", 53, 1.21), ("disc", 42, 1.55)):
            for f in (4, 6, 8, 16):
                found = surface_mesh.measure(*make_template.template(shape, f, 1))
                self.assertGreater(found["angle"][0], angle)
                self.assertLess(found["area_ratio"], area_ratio)

    def test_consecutive_vertices_are_close(self):
        for shape in ("sphere", "disc"):
            points, triangles = make_template.template(shape, 16, 1)
            step = np.linalg.norm(np.diff(points, axis=0), axis=1).mean()
            self.assertLess(step, 1.5 * surface_mesh.measure(points, triangles)["edge"][1])

    def test_checker_refuses_bad_meshes(self):
        points, triangles = make_template.template("sphere", 2, 1)
        flipped = triangles.copy()
        flipped[5] = flipped[5, ::-1]
        for bad in (triangles[:, ::-1], triangles[1:], flipped):
            with self.assertRaises(ValueError):
                surface_mesh.check(points, bad)
        with self.assertRaises(ValueError):
            surface_mesh.check(np.vstack([points, points + 3]),
                               np.vstack([triangles, triangles + len(points)]))

    def test_bad_arguments_are_refused(self):
        for words in ("sphere -f 0", "sphere -f 2 --radius 0", "disc -f 2 --diameter nan",
                      "cube -f 2", "disc", "spheroid -f 2 --axis-ratio 1",
                      "spheroid --axis-ratio 1 --area 1",
                      "spheroid -f 2 --area 1 --reduced-volume 1.01",
                      "sickle -f 2 --length 4 --width 4 --bend 180",
                      "spheroid -f 2 --reduced-volume 1 --like rbc_162.mol",
                      "mesh", "mesh a.stl --area 1 --scale 2",
                      "spheroid -f 2 --axis-ratio 2 --prolate --area 1",
                      "spheroid -f 2 --axis-ratio 2 --area 1 --match-volume"):
            with self.subTest(words), contextlib.redirect_stderr(io.StringIO()):
                with self.assertRaises(SystemExit):
                    make_template.main(words.split())


class Spheroid(unittest.TestCase):
    def test_size_is_that_of_its_profile(self):
        for ratio in (0.2, 0.6521, 1, 1.8, 5):
            with self.subTest(ratio):
                t = np.linspace(0, math.pi, 200001)
                r, z = np.sin(t), ratio * np.cos(t)
                area = (math.pi * (r[1:] + r[:-1]) * np.hypot(np.diff(r), np.diff(z))).sum()
                volume = -(math.pi / 3 * (r[1:]**2 + r[1:] * r[:-1] + r[:-1]**2) * np.diff(z)).sum()
                np.testing.assert_allclose(shapes.spheroid_size(ratio, 3), (9 * area, 27 * volume),
                                           rtol=1e-8)

    def test_reduced_volume(self):
        for reduced in (0.3, 0.65, 0.95, 0.997, 1):
            for prolate in (False, True):
                ratio = shapes.axis_ratio_of(reduced, prolate)
                self.assertEqual(ratio > 1, prolate and reduced < 1)
                area, volume = shapes.spheroid_size(ratio)
                self.assertAlmostEqual(36 * math.pi * volume**2 / area**3, reduced**2, places=9)

    def test_mesh_lies_on_it_and_has_the_area(self):
        for form in ("--axis-ratio 0.4", "--axis-ratio 2.5", "--reduced-volume 0.9",
                     "--reduced-volume 0.9 --prolate"):
            with self.subTest(form), tempfile.TemporaryDirectory() as folder:
                file = Path(folder, "s.mol")
                make("spheroid", *form.split(), "--area", 55, "-f", 6, "-o", file)
                points, triangles = read_molecule(file)
                area, volume = area_and_volume(points, triangles)
                self.assertAlmostEqual(area, 55, delta=1e-9)
                radius, half = np.abs(points[:, :2]).max(), np.abs(points[:, 2]).max()
                level = (points[:, :2]**2).sum(axis=1) / radius**2 + (points[:, 2] / half)**2
                self.assertLess(np.abs(level - 1).max(), 1e-12)
                smooth = shapes.spheroid_size(half / radius, radius)
                self.assertLess(abs(area / smooth[0] - 1), 0.03)
                self.assertEqual(half > radius, "prolate" in form or "2.5" in form)

    def test_like_a_template(self):
        for like in ("rbc_642.mol", "rbc_162.mol", "capsule_362.mol"):
            for reduced in (0.9, 1):
                with self.subTest(like, reduced=reduced), tempfile.TemporaryDirectory() as folder:
                    file = Path(folder, "s.mol")
                    make("spheroid", "--reduced-volume", reduced, "--like", POTENTIALS / like, "-o",
                         file)
                    points, triangles = read_molecule(file)
                    cell, same = read_molecule(POTENTIALS / like)
                    np.testing.assert_array_equal(triangles, same)
                    self.assertAlmostEqual(area_and_volume(points, triangles)[0] /
                                           area_and_volume(cell, same)[0], 1, delta=1e-11)
                    found = 36 * math.pi * area_and_volume(points, triangles)[1]**2 / (
                        area_and_volume(points, triangles)[0]**3)
                    self.assertLess(abs(math.sqrt(found) - reduced), 0.02)
                    # the same azimuth and side, and nearly the same area of each triangle
                    azimuths = [np.arctan2(x[:, 1], x[:, 0]) for x in (points, cell)]
                    np.testing.assert_allclose(*azimuths, atol=1e-12)
                    self.assertTrue((np.sign(points[:, 2]) == np.sign(cell[:, 2])).all())
                    ratio = [np.linalg.norm(np.cross(x[same[:, 1]] - x[same[:, 0]],
                                                     x[same[:, 2]] - x[same[:, 0]]),
                                            axis=1) for x in (points, cell)]
                    self.assertLess(np.abs(ratio[0] / ratio[1] - 1).max(),
                                    0.012 * 642 / len(points))

    def test_like_another_mesh_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "rbc_642_spheroid95.mol: is not a disc or sphere"):
            make("spheroid", "--reduced-volume", 0.9, "--like",
                 POTENTIALS / "rbc_642_spheroid95.mol")

    def test_numbers_in_the_title(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "s.mol")
            make("spheroid", "--reduced-volume", 0.9, "--like", POTENTIALS / "rbc_162.mol", "-o",
                 file, "--citation", "Someone, Journal, 1, 2 (2003)")
            lines = file.read_text().splitlines()
            self.assertTrue(lines[0].endswith("CITATION: Someone, Journal, 1, 2 (2003)"))
            self.assertEqual(lines[1],
                             "# make_template.py spheroid --reduced-volume 0.9 --like rbc_162.mol")


class Sickle(unittest.TestCase):
    def test_volume_of_the_straight_ellipsoid_at_second_order(self):
        errors = []
        for f in (8, 16, 32):
            points, triangles = shapes.geodesic(f)
            points = shapes.sickle(points, 15, 4, 3, math.radians(90))
            surface_mesh.check(points, triangles)
            errors.append(1 - area_and_volume(points, triangles)[1] / (math.pi / 6 * 15 * 4 * 3))
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        self.assertLess(np.abs(orders - 2).max(), 0.05, orders)

    def test_it_is_bent(self):
        points = shapes.sickle(shapes.geodesic(8)[0], 15, 4, 3, math.radians(90))
        radius = 15 / math.radians(90)
        from_axis = np.hypot(points[:, 0], points[:, 1] - radius)
        self.assertAlmostEqual(from_axis.min(), radius - 2, delta=0.02)
        self.assertAlmostEqual(from_axis.max(), radius + 2, delta=0.02)
        self.assertAlmostEqual(np.abs(points[:, 2]).max(), 1.5, delta=0.02)
        self.assertAlmostEqual(np.degrees(np.arctan2(points[:, 0], radius - points[:, 1])).max(),
                               45, delta=0.1)


class Shipped(unittest.TestCase):
    def test_readme_commands_reproduce_the_files(self):
        readme = (POTENTIALS / "README.md").read_text(encoding="utf-8")
        commands = re.findall(r"^\./make_template\.py (.*)$", readme, re.MULTILINE)
        made = []
        with tempfile.TemporaryDirectory() as folder:
            for command in commands:
                *words, name = shlex.split(command)
                words = [str(POTENTIALS / word) if word in SHIPPED else word for word in words]
                make(*words, Path(folder, name))
                self.assertEqual(Path(folder, name).read_bytes(), (POTENTIALS / name).read_bytes(),
                                 f"{name} differs from what the README's command makes")
                made.append(name)
        self.assertEqual(sorted(made), sorted(path.name for path in POTENTIALS.glob("*.mol")))
        self.assertEqual(sorted(made), sorted(SHIPPED))

    def test_readme_makes_other_cells(self):
        readme = (POTENTIALS / "README.md").read_text(encoding="utf-8")
        commands = re.findall(r"^potentials/make_template\.py (.*)$", readme, re.MULTILINE)
        rows = re.findall(r"^\| ([^|]*) \| ([\d.]+) x ([\d.]+) x ([\d.]+) \| ([\d.]+) \| "
                          r"([\d.]+) \|", readme, re.MULTILINE)
        with tempfile.TemporaryDirectory() as folder:
            made = []
            for command in commands:
                words = [str(Path(folder, word)) if re.search(r"\.(mol|stl)$", word) else word
                         for word in shlex.split(command)]
                make(*words)
                if words[-1].endswith(".mol"):
                    made.append(words[-1])
            self.assertEqual(len(made), len(rows))
            for file, (name, *numbers) in zip(made, rows):
                with self.subTest(name):
                    points, triangles = read_molecule(file)
                    found = [*np.ptp(points, axis=0), *area_and_volume(points, triangles)]
                    np.testing.assert_allclose(found, np.array(numbers, float), rtol=2.5e-3)
                    self.assertEqual(len(points), int(re.search(r"_(\d+)\.mol$", file).group(1)))

    def test_files_hold_the_meshes(self):
        for name in GEODESIC:
            with self.subTest(name):
                points, triangles = read_molecule(POTENTIALS / name)
                self.assertEqual(len(points), int(re.search(r"\d+", name).group()))
                shape, radius = ("disc", 3.91) if name.startswith("rbc") else ("sphere", 1)
                made, made_triangles = make_template.template(
                    shape, math.isqrt(len(points) // 10), radius)
                np.testing.assert_allclose(points, made, atol=1e-15 * 8)
                np.testing.assert_array_equal(triangles, made_triangles)

    def test_headers_follow_lammps(self):
        for path in sorted(POTENTIALS.glob("*.m*")):
            if path.suffix in (".mol", ".material"):
                first = path.read_text().splitlines()[0]
                self.assertRegex(first, r"^# DATE: \d{4}-\d\d-\d\d UNITS: micro "
                                        r"CONTRIBUTOR: \S.* CITATION: \S.*\(\d{4}\)$")

    def test_material_sets(self):
        values = {path.name: dict(re.findall(r"^variable\s+(\w+)\s+equal\s+(\S+)",
                                             path.read_text(), re.MULTILINE))
                  for path in POTENTIALS.glob("*.material")}
        kilopascal = {"healthy.material": 1e-3, "paper-table2.material": 1}
        for name, factor in kilopascal.items():
            dyn_per_cm2 = 0.1 * 1e-3  # kPa
            self.assertAlmostEqual(float(values[name]["C1"]), 2.57e6 * dyn_per_cm2 * factor)
            self.assertAlmostEqual(float(values[name]["C2"]), 2.57e5 * dyn_per_cm2 * factor)
            self.assertAlmostEqual(float(values[name]["viscosity"]), 1.46e-6 * 1025 * 1e3)
            self.assertAlmostEqual(float(values[name]["density"]), 1025e-18 * 1e15)
            self.assertAlmostEqual(float(values[name]["kappa"]), 2e-19 * 1e15)


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name, "file")

    def write(self, text):
        self.path.write_text(text)
        return self.path

    HEADER = "# Time-averaged data for fix out\n# TimeStep Number-of-rows\n"

    def test_blocks(self):
        history = read_ave_time(self.write(
            self.HEADER + "# Row c_cell[1] c_cell[7] c_cell[11] c_cell[12] c_cell[13]\n"
            "0 2\n1 1 0 1 0 0\n2 5 0.5 0 0 -1e-3\n"
            "100 2\n1 1 0.25 0 1 0\n2 5 nan 0 0 1\n"))
        self.assertEqual(history.steps.tolist(), [0, 100])
        self.assertEqual(history.data.shape, (2, 2, 5))
        self.assertEqual(history.names[1], "c_cell[7]")
        self.assertEqual(history.column(7)[:, 0].tolist(), [0, 0.25])
        self.assertTrue(np.isnan(history.column(7)[1, 1]))
        self.assertEqual(history.columns(11, 13)[0, 1].tolist(), [0, 0, -1e-3])
        with self.assertRaisesRegex(InputError, "column 6 is not in the file"):
            history.column(6)

    def test_unfinished_block_and_repeated_header(self):
        header = self.HEADER + "# Row c_cell[1] c_cell[2]\n"
        block = "{} 1\n1 1 {}\n"
        history = read_ave_time(self.write(
            header + block.format(0, 3) + header + block.format(10, 4) + "20 1\n1 1 0.12"))
        self.assertEqual(history.steps.tolist(), [0, 10])
        self.assertEqual(history.column(2).tolist(), [[3], [4]])

    def test_no_header(self):
        history = read_ave_time(self.write("0 1\n1 7 8 9\n"))
        self.assertEqual(history.column(3).tolist(), [[9]])

    def test_bad_files(self):
        for text in ("", self.HEADER, "0 2\n1 5\n2 6\n10 3\n1 5\n2 6\n3 7\n", "0 1.5\n1 2\n"):
            with self.subTest(text), self.assertRaises(ValueError):
                read_ave_time(self.write(text))

    def test_table(self):
        table = read_table(self.write("# Fix print output\n#time D\n0 1\n2 3\n"))
        self.assertEqual(list(table), ["time", "D"])
        self.assertEqual(table["D"].tolist(), [1, 3])

    def test_csv_keeps_commas_in_parentheses(self):
        rows = read_csv(self.write("# note\nCa,source,D\n0.1,Huet2022(Basilisk,high res),0.3\n"
                                   "0.2,Pozrikidis1995,\n"))
        self.assertEqual(rows[0], {"Ca": "0.1", "source": "Huet2022(Basilisk,high res)",
                                   "D": "0.3"})
        self.assertEqual(rows[1]["D"], "")


class Plot(unittest.TestCase):
    def test_angle_range(self):
        axis = np.array([[1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1], [1, 5, 1], [-1, 0, 1]])
        np.testing.assert_allclose(angle_to_flow(axis), [0, 0, 90, 90, 45, -45])

    def test_reference_series(self):
        path = ROOT / "examples/reference/02b_capsule_shear_NH_transient_D.csv"
        series = {label: (x, y) for label, x, y in
                  reference_series(path, ["Ca_E=0.1"], "D")}
        self.assertEqual(len(series), 5)
        self.assertEqual(series["Pozrikidis1995"][1].tolist(), [0.11479, 0.2015, 0.3106, 0.36092])

    def test_picture_from_cells(self):
        rows = [" ".join(map(str, [1, 1, 0.1 * i] + [1, 0, 1] + [-1, 0, 1])) for i in range(4)]
        columns = [1, 7, 11, 12, 13, 14, 15, 16]
        with tempfile.TemporaryDirectory() as folder:
            cells, picture = Path(folder, "cell.dat"), Path(folder, "D.png")
            cells.write_text("# Row " + " ".join(f"c_c[{i}]" for i in columns) + "\n"
                             + "".join(f"{100 * i} 1\n{row}\n" for i, row in enumerate(rows)))
            plot.main(["--cells", str(cells), "--timestep", "2", "--shear-rate", "1e-3",
                             "-o", str(picture)])
            self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")


if __name__ == "__main__":
    unittest.main()
