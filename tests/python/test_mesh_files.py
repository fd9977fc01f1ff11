"""Templates from surfaces in files, and back: make_template.py mesh and --surface."""
import math
import struct
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from test_templates import POTENTIALS, area_and_volume, make, read_molecule

# relative precision of what a format holds
SINGLE = {".stl": 1e-6, ".ply": 1e-6, ".off": 1e-14, ".vtp": 1e-14}
OCTAHEDRON = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5),
              (0, 3, 5)]
CORNERS = [(1., 0, 0), (-1., 0, 0), (0, 1., 0), (0, -1., 0), (0, 0, 1.), (0, 0, -1.)]


def off(corners, polygons):
    lines = ["OFF", "# made by a test", f"{len(corners)} {len(polygons)} 0"]
    lines += [" ".join(map(str, corner)) for corner in corners]
    lines += [" ".join(map(str, (len(polygon), *polygon))) for polygon in polygons]
    return "\n".join(lines) + "\n"


def ascii_stl(corners, triangles):
    lines = ["solid test"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {:.9g} {:.9g} {:.9g}".format(*corners[v]) for v in triangle]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid test"]) + "\n"


def binary_stl(corners, triangles):
    rows = [struct.pack("<12fH", 0, 0, 0, *(c for v in triangle for c in corners[v]), 0)
            for triangle in triangles]
    return b"binary".ljust(80) + struct.pack("<I", len(rows)) + b"".join(rows)


def ascii_ply(corners, polygons):
    lines = ["ply", "format ascii 1.0", f"element vertex {len(corners)}",
             *(f"property float {axis}" for axis in "xyz"), f"element face {len(polygons)}",
             "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, corner)) for corner in corners]
    lines += [" ".join(map(str, (len(polygon), *polygon))) for polygon in polygons]
    return "\n".join(lines) + "\n"


def torus(n=8, m=6):
    corners, quadrilaterals = [], []
    for i in range(n):
        for j in range(m):
            a, b = 2 * math.pi * i / n, 2 * math.pi * j / m
            corners.append(((3 + math.cos(b)) * math.cos(a), (3 + math.cos(b)) * math.sin(a),
                            math.sin(b)))
            p, q = (i + 1) % n, (j + 1) % m
            quadrilaterals.append((i * m + j, p * m + j, p * m + q, i * m + q))
    return corners, quadrilaterals


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def mesh(self, path, *words):
        made = self.folder / "made.mol"
        self.printed = make("mesh", path, *words, "--output", made)
        return read_molecule(made)


class RoundTrip(Files):
    def assert_same_surface(self, found, expected, precision):
        (points, triangles), (others, other_triangles) = found, expected
        self.assertEqual(points.shape, others.shape)
        distance = np.linalg.norm(points[:, None] - others, axis=2)
        twin = distance.argmin(axis=1)
        self.assertLess(distance.min(axis=1).max(), precision * np.abs(others).max() * 4)
        self.assertEqual(sorted(twin), list(range(len(others))))
        def cyclic(corners):
            return sorted(tuple(np.roll(t, -t.argmin())) for t in corners)
        self.assertEqual(cyclic(twin[triangles]), cyclic(other_triangles))

    def test_every_format(self):
        for name in ("rbc_162.mol", "capsule_362.mol"):
            expected = read_molecule(POTENTIALS / name)
            for kind, precision in SINGLE.items():
                with self.subTest(name, kind=kind):
                    surface = self.folder / ("surface" + kind)
                    make("mesh", POTENTIALS / name, "--surface", surface)
                    self.assert_same_surface(self.mesh(surface), expected, precision)
                    self.assertNotIn("turned", self.printed)

    def test_a_template_is_its_own_template(self):
        for name in ("rbc_642.mol", "capsule_162.mol", "rbc_642_spheroid95.mol"):
            self.assert_same_surface(self.mesh(POTENTIALS / name), read_molecule(POTENTIALS / name),
                                     1e-14)

    def test_written_surfaces_as_VTK_reads_them(self):
        area, volume = area_and_volume(*read_molecule(POTENTIALS / "rbc_162.mol"))
        for kind, reader in ((".stl", vtkSTLReader), (".ply", vtkPLYReader),
                             (".vtp", vtkXMLPolyDataReader)):
            with self.subTest(kind):
                path = self.folder / ("disc" + kind)
                make("disc", "--frequency", 4, "--surface", path)
                source, mass = reader(), vtkMassProperties()
                source.SetFileName(str(path))
                mass.SetInputConnection(source.GetOutputPort())
                mass.Update()
                self.assertAlmostEqual(mass.GetSurfaceArea() / area, 1, delta=1e-6)
                self.assertAlmostEqual(mass.GetVolume() / volume, 1, delta=1e-6)

    def test_files_of_others(self):
        shape = np.array(CORNERS) + [50, -7, 3]
        for name, content in (
                ("a.stl", ascii_stl(shape, OCTAHEDRON)), ("b.stl", binary_stl(shape, OCTAHEDRON)),
                ("c.ply", ascii_ply(shape, OCTAHEDRON)), ("d.off", off(shape, OCTAHEDRON)),
                ("f.stl", "\ufeff\n" + ascii_stl(shape, OCTAHEDRON).upper()),
                ("g.off", "\ufeff" + off(shape, OCTAHEDRON)),
                ("E.OFF", off(shape, OCTAHEDRON).replace("OFF\n# made by a test\n", "OFF "))):
            with self.subTest(name):
                points, triangles = self.mesh(self.write(name, content))
                self.assert_same_surface((points, triangles),
                                         (np.array(CORNERS), np.array(OCTAHEDRON)), 1e-5)
                self.assertAlmostEqual(area_and_volume(points, triangles)[1], 4 / 3, delta=1e-5)


class Changes(Files):
    CUBE = [(x, y, z) for x in (0., 1.) for y in (0., 1.) for z in (0., 1.)]
    SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]

    def test_polygons_are_cut(self):
        for name, content in (("cube.off", off(self.CUBE, self.SIDES)),
                              ("cube.ply", ascii_ply(self.CUBE, self.SIDES))):
            points, triangles = self.mesh(self.write(name, content))
            self.assertEqual((len(points), len(triangles)), (8, 12))
            np.testing.assert_allclose(area_and_volume(points, triangles), (6, 1), rtol=1e-12)

    def test_centre_of_volume(self):
        # a pyramid: its centroid is a quarter of the height above the base
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.3, 0.6, 2)]
        sides = [(3, 2, 1, 0), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
        points, _ = self.mesh(self.write("p.off", off(corners, sides)))
        self.assertAlmostEqual(points[:, 2].min(), -0.5, delta=1e-12)
        np.testing.assert_allclose(points[points[:, 2].argmax()],
                                   np.array([0.3, 0.6, 2]) -
                                   (0.75 * np.array([0.5, 0.5, 0]) + [0.075, 0.15, 0.5]),
                                   atol=1e-12)

    def test_inward_is_turned(self):
        inward = [triangle[::-1] for triangle in OCTAHEDRON]
        _, volume = area_and_volume(*self.mesh(self.write("in.off", off(CORNERS, inward))))
        self.assertAlmostEqual(volume, 4 / 3)
        self.assertIn("in.off: the triangles pointed inward; they were turned outward",
                      self.printed)

    def test_scales(self):
        path = self.write("cube.off", off(self.CUBE, self.SIDES))
        for words, side in (("--scale 3", 3), ("--area 54", 3), ("--volume 8", 2), ("--size 5", 5)):
            with self.subTest(words):
                np.testing.assert_allclose(area_and_volume(*self.mesh(path, *words.split())),
                                           (6 * side**2, side**3),
                                           rtol=1e-12)

    def test_title_names_the_source_without_its_folder_and_no_one_else(self):
        def comments():
            lines = (self.folder / "made.mol").read_text().splitlines()
            return [line for line in lines if line.startswith("#")]
        self.mesh(self.write("cube.off", off(self.CUBE, self.SIDES)), "--volume", 8)
        self.assertEqual(comments(), ["# make_template.py mesh cube.off --volume 8"])
        self.mesh(self.folder / "cube.off", "--citation", "Someone, Journal, 1, 2 (2003)")
        self.assertEqual(comments(), ["# CITATION: Someone, Journal, 1, 2 (2003)",
                                      "# make_template.py mesh cube.off"])

    def test_unused_points_are_dropped(self):
        points, _ = self.mesh(self.write("o.off", off(CORNERS + [(9, 9, 9)], OCTAHEDRON)))
        self.assertEqual(len(points), 6)


class BadMeshes(Files):
    def refused(self, name, content, *words):
        with self.assertRaises(SystemExit) as stopped:
            self.mesh(self.write(name, content))
        for word in (name, *words):
            self.assertIn(word, str(stopped.exception))

    def test_topology(self):
        far = [(x + 5, y, z) for x, y, z in CORNERS]
        apart = OCTAHEDRON + [tuple(v + 6 for v in triangle) for triangle in OCTAHEDRON]
        around = [tuple(v if v > 3 else v + 6 for v in triangle) for triangle in OCTAHEDRON]
        bigger = [(2 * x, 2 * y, 0.) for x, y, _ in CORNERS[:4]]
        for name, mesh, words in (
                ("open", (CORNERS, OCTAHEDRON[:-1]),
                 ["not closed", "3 edges", "one triangle only"]),
                ("turned", (CORNERS, [OCTAHEDRON[0][::-1]] + OCTAHEDRON[1:]),
                 ["not consistently oriented", "3 edges"]),
                ("fin", (CORNERS + [(2., 2., 0)], OCTAHEDRON + [(0, 2, 6)]),
                 ["not manifold", "1 edges"]),
                ("pieces", (CORNERS + far, apart), ["2 pieces"]),
                ("torus", torus(), ["1 handles", "sphere topologically"]),
                ("pinched", (CORNERS + bigger, OCTAHEDRON + around),
                 ["touches itself at 2 vertices"])):
            with self.subTest(name):
                self.refused(name + ".off", off(*mesh), *words)

    def test_degenerate_triangles(self):
        # a vertex on an edge, joined to it by a triangle of no area; and the same vertex at the
        # edge's end
        corners = CORNERS + [(0.5, 0.5, 0)]
        split = [(0, 2, 4), *OCTAHEDRON[1:4], (6, 0, 5), (2, 6, 5), (0, 6, 2), *OCTAHEDRON[5:]]
        self.refused("edge.off", off(corners, split), "1 triangles have no area")
        for kind, write in (("stl", ascii_stl), ("off", off)):
            self.refused("corner." + kind, write(CORNERS + [(1, 0, 0)], split),
                         "corners at one place")

    def test_files(self):
        good = off(CORNERS, OCTAHEDRON)
        short = (POTENTIALS / "capsule_162.mol").read_text().replace(" 162\n", " 163\n")
        for name, content, words in (
                ("a.obj", good, ["unknown format .obj", ".stl, .ply, .off, .vtp"]),
                ("a.off", good.replace("OFF", "COFF"), ["does not begin with OFF"]),
                ("b.off", "\n".join(good.splitlines()[:-1]),
                 ["ends before its 6 vertices and 8 faces"]),
                ("c.off", good.replace("3 0 2 4", "3 0 2 7"), ["vertex that does not exist"]),
                ("d.off", good.replace("-1.0 0 0", "-1.0 nan 0"), ["not a number"]),
                ("e.off", off(CORNERS, []), ["no polygons"]),
                ("e2.off", "OFF", ["no numbers of vertices and faces"]),
                ("f2.mol", short, ["atom that does not exist"]),
                ("f.mol", "# nothing\n\n6 atoms\n", ["not a molecule file with Coords and Angles"]),
                ("g.vtp", "nothing", ["no polygons"]), ("h.stl", "nothing", ["no polygons"])):
            with self.subTest(name):
                self.refused(name, content, *words)
        with self.assertRaisesRegex(SystemExit, "missing.stl: no such file"):
            self.mesh(self.folder / "missing.stl")
        with self.assertRaisesRegex(SystemExit, "unknown format"):
            make("sphere", "-f", 2, "--surface", self.folder / "sphere.obj")


if __name__ == "__main__":
    unittest.main()
