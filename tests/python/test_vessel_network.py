"""Surfaces of networks of tubes: closed, with the loops of the network, and of the right size."""
import math
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SCRIPT, EXAMPLE = ROOT / "scripts" / "make_vessel.py", ROOT / "examples" / "network"
LOOP_NODES = "node,x,y,z\nin,0,0,0\na,30,0,0\nleft,50,20,0\nright,50,-20,0\nb,70,0,0\nout,100,0,0\n"
LOOP_SEGMENTS = "from,to,radius\nin,a,5\na,left,4\na,right,4\nleft,b,4\nright,b,4\nb,out,5\n"


def run(*words, folder=None):
    return subprocess.run([sys.executable, SCRIPT, *map(str, words)], cwd=folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


def attempt(nodes, segments, *words):
    """What the script says, its return code, and the corners of the triangles it wrote."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("nodes.csv", nodes), ("segments.csv", segments)):
            (Path(folder) / name).write_text(text, encoding="utf-8")
        done = run("network", "--nodes", "nodes.csv", "--segments", "segments.csv", "net.stl",
                   *words, folder=folder)
        path = Path(folder) / "net.stl"
        bytes_ = path.read_bytes() if path.exists() else bytes(84)
    kind = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
    record = np.frombuffer(bytes_[84:], dtype=kind)
    return done.stdout, done.returncode, record["corners"].astype(float)


def make(nodes, segments, edge):
    printed, code, corners = attempt(nodes, segments, "--edge", edge)
    if code:
        raise AssertionError(printed)
    return corners


def area_and_volume(corners):
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    return np.linalg.norm(area, axis=1).sum(), (area * corners.mean(axis=1)).sum() / 3


def from_axis(points, start, end):
    start, way = np.array(start, dtype=float), np.subtract(end, start)
    along = np.clip((points - start) @ way / (way @ way), 0, 1)
    return np.linalg.norm(points - start - along[:, None] * way, axis=1)


class Networks(unittest.TestCase):
    def check_closed(self, corners, handles):
        """Each edge once in each sense; its number of handles by Euler's formula."""
        names = [tuple(point) for point in corners.reshape(-1, 3)]
        triangles = [names[n:n + 3] for n in range(0, len(names), 3)]
        edges = Counter((t[i], t[(i + 1) % 3]) for t in triangles for i in range(3))
        self.assertEqual(max(edges.values()), 1)
        self.assertTrue(all((b, a) in edges for a, b in edges))
        self.assertEqual(len(set(names)) - len(edges) // 2 + len(triangles), 2 - 2 * handles)

    def check_shapes(self, corners, edge):
        """No triangle is flat, or much larger than was asked for."""
        sides = corners - np.roll(corners, 1, axis=1)
        lengths = np.linalg.norm(sides, axis=2)
        self.assertLess(lengths.max(), 2 * edge)
        products = (sides * np.roll(sides, -1, axis=1)).sum(axis=2)
        cosines = -products / (lengths * np.roll(lengths, -1, axis=1))
        self.assertGreater(np.degrees(np.arccos(cosines.max())), 15)

    def test_a_tube_with_round_ends(self):
        radius = 4
        for end in ((30, 0, 0), (20, 13, 7)):
            nodes = "name,node,x,y,z\nthe start,a,0,0,0\nthe end,b,{},{},{}\n".format(*end)
            length = math.hypot(*end)
            exact = (2 * math.pi * radius * length + 4 * math.pi * radius**2,
                     math.pi * radius**2 * length + 4 / 3 * math.pi * radius**3)
            errors = []
            for edge in (1.0, 0.5):
                corners = make(nodes, f"radius, from, to\n{radius}, a, b\n", edge)
                self.check_closed(corners, 0)
                self.check_shapes(corners, edge)
                from_it = from_axis(corners.reshape(-1, 3), (0, 0, 0), end)
                np.testing.assert_allclose(from_it, radius, rtol=1e-6)
                errors.append(np.array(area_and_volume(corners)) / exact - 1)
            print(f"\nend {end}: errors of area and volume {errors[0]}, {errors[1]}")
            self.assertLess(np.abs(errors[1]).max(), 3e-3)
            order = np.log2(errors[0] / errors[1])
            self.assertTrue(np.all((order > 1.8) & (order < 2.4)), order)

    def test_a_loop_has_one_handle(self):
        radii = {tuple(row.split(",")[:2]): float(row.split(",")[2])
                 for row in LOOP_SEGMENTS.splitlines()[1:]}
        places = {row.split(",")[0]: [float(word) for word in row.split(",")[1:]]
                  for row in LOOP_NODES.splitlines()[1:]}
        for edge in (1.0, 0.5):    # with 1 the tops of oblique tubes enclose single points
            corners = make(LOOP_NODES, LOOP_SEGMENTS, edge)
            self.check_closed(corners, 1)
            self.check_shapes(corners, edge)
            points = corners.reshape(-1, 3)
            beyond = np.min([from_axis(points, places[a], places[b]) - radius
                             for (a, b), radius in radii.items()], axis=0)
            self.assertGreater(beyond.min(), -1e-4)
            self.assertLess(beyond.max(), 4 / 8)    # in sharp edges, which are rounded
            self.assertGreater(beyond.max(), 4 / 100)
    
            away = np.all([np.linalg.norm(points - place, axis=1) > 10
                           for place in places.values()], axis=0)
            np.testing.assert_allclose(beyond[away], 0, atol=1e-4)

    def test_a_surface_through_points_of_the_grid(self):
        """The example's, at 1.2: tubes of radius 6 touch points of the grid."""
        nodes, segments = ((EXAMPLE / name).read_text(encoding="utf-8")
                           for name in ("nodes.csv", "segments.csv"))
        corners = make(nodes, segments, 1.2)
        self.check_closed(corners, 20 - 16 + 1)
        self.check_shapes(corners, 1.2)

    def test_tubes_in_a_row_are_one(self):
        corners = make("node,x,y,z\n1,0,0,0\n2,10,5,0\n3,20,10,0\n",
                       "from,to,radius\n1,2,3\n3,2,3\n", 0.75)
        np.testing.assert_allclose(from_axis(corners.reshape(-1, 3), (0, 0, 0), (20, 10, 0)), 3,
                                   rtol=1e-3)

    def test_tubes_that_are_apart(self):
        """Two pieces; the edge is a tenth of the least radius unless told otherwise."""
        printed, code, corners = attempt("node,x,y,z\n1,0,0,0\n2,9,0,0\n3,0,0,9\n4,9,0,9\n",
                                         "from,to,radius\n1,2,2\n3,4,1\n")
        self.assertEqual(code, 0, printed)
        self.check_closed(corners, -1)
        self.check_shapes(corners, 0.1)
        volume = math.pi * (4 + 1) * 9 + 4 / 3 * math.pi * (8 + 1)
        self.assertAlmostEqual(area_and_volume(corners)[1] / volume, 1, delta=3e-3)

    def test_what_is_wrong_is_said(self):
        two = "node,x,y,z\na,0,0,0\nb,9,0,0\n"
        for nodes, segments, message in (
                ("node,x,y\na,0,0\n", "", "nodes.csv: its first line must name the columns "
                 "node, x, y, z; it has no z"),
                ("node,x,y,z\n", "", "nodes.csv has no rows"),
                (two + "a,1,1,1\n", "", "nodes.csv, line 4: there is a node a already"),
                (two + "c,1,one,1\n", "", "nodes.csv, line 4: 'one' is not a number"),
                (two + "c,1,nan,1\n", "", "nodes.csv, line 4: 'nan' is not a number"),
                (two + "c,1\n", "", "nodes.csv, line 4: '' is not a number"),
                (two, "from,to\na,b\n", "segments.csv: its first line must name the columns "
                 "from, to, radius; it has no radius"),
                (two, "from,to,radius\na,c,1\n", "segments.csv, line 2: nodes.csv has no node c"),
                (two, "from,to,radius\na,b,0\n", "segments.csv, line 2: the radius 0 must be > 0"),
                (two, "from,to,radius\na,a,1\na,b,1\n", "between a and a has no length"),
                (two, "from,to,radius\na,b,1\nb,a,1\n", "there are two segments between b and a"),
                (two + "c,1,1,1\n", "from,to,radius\na,b,1\n", "no segment has the node c"),
                (two + "c,4,3,0\nd,4,9,0\n", "from,to,radius\na,b,2\nc,d,2\n",
                 "tubes touch that have no node in common")):
            with self.subTest(message):
                printed, code, _ = attempt(nodes, segments)
                self.assertEqual(code, 1, printed)
                self.assertIn(message, printed)
                self.assertNotIn("Traceback", printed)

    def test_options_that_do_not_fit(self):
        for words, message in (
                (("--diameter", 3), "--diameter is not for the shape network"),
                (("--closed",), "--closed is not for the shape network"),
                (("--edge", -1), "--edge -1.0 must be > 0"),
                (("--edge", 1e-3), "--edge 0.001 makes about"),
                (("--edge", 0.04), "cells in the box around the network, more than 5e+07")):
            printed, code, _ = attempt(LOOP_NODES, LOOP_SEGMENTS, *words)
            self.assertEqual(code, 2, printed)
            self.assertIn(message, printed)
        for words, message in (
                (("network", "x.stl"), "the shape network needs --nodes and --segments"),
                (("tube", "x.stl", "--nodes", "x.csv"), "--nodes is for the shape network, not")):
            done = run(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stdout)


if __name__ == "__main__":
    unittest.main()
