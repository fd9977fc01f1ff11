"""Surfaces of vessels: what they enclose, and that they go on through the ends of the box."""
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import numpy as np

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "make_vessel.py"


def attempt(*words):
    return subprocess.run([sys.executable, SCRIPT, *map(str, words)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


def make(*words):
    """Corners of the triangles."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "vessel.stl"
        done = attempt(*words, path)
        if done.returncode:
            raise AssertionError(done.stdout)
        bytes_ = path.read_bytes()
    record = np.frombuffer(bytes_[84:], dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)),
                                               ("attribute", "<u2")])
    assert len(record) == np.frombuffer(bytes_[80:84], "<u4")[0]
    return record["corners"].astype(float)


def area_and_volume(corners):
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    return np.linalg.norm(area, axis=1).sum(), (area * corners.mean(axis=1))[:, 1:].sum() / 2


class Vessel(unittest.TestCase):
    def check_surface(self, corners, length):
        """Closed but for the ends, oriented alike, with the same ends."""
        corners = np.round(corners, 4) + 0.0
        edges = Counter((tuple(t[i]), tuple(t[(i + 1) % 3])) for t in corners for i in range(3)
                        if tuple(t[i]) != tuple(t[(i + 1) % 3]))
        ends = {0.0: set(), length: set()}
        for (a, b), count in edges.items():
            if edges[b, a] == count:
                continue
            self.assertEqual(count, 1)
            self.assertEqual(a[0], b[0])
            ends[a[0]].add(tuple(sorted((a[1:], b[1:]))))
        self.assertGreater(len(ends[0.0]), 8)
        self.assertEqual(ends[0.0], ends[length])

    def test_tube(self):
        for edge, tolerance in ((2.0, 1.1e-2), (1.0, 2.7e-3)):    # second order
            corners = make("tube", "--length", 45, "--diameter", 22.5, "--edge", edge)
            self.check_surface(corners, 45.0)
            area, volume = area_and_volume(corners)
            self.assertAlmostEqual(area / (np.pi * 22.5 * 45), 1, delta=tolerance / 2)
            self.assertAlmostEqual(volume / (np.pi * 11.25**2 * 45), 1, delta=tolerance)

    def test_lids_close_it(self):
        for shape in ("tube", "throat", "bifurcation"):
            corners = np.round(
                make(shape, "--length", 60, "--diameter", 16, "--edge", 1.6, "--closed"), 4) + 0.0
            edges = Counter((tuple(t[i]), tuple(t[(i + 1) % 3])) for t in corners for i in range(3)
                            if tuple(t[i]) != tuple(t[(i + 1) % 3]))
            self.assertTrue(all(edges[b, a] == count for (a, b), count in edges.items()))
            area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
            # the same by each direction, outward normals
            volumes = (area * corners.mean(axis=1)).sum(axis=0)
            np.testing.assert_allclose(volumes, area_and_volume(corners)[1], rtol=1e-5)
            lids = area[np.ptp(corners[:, :, 0], axis=1) == 0]
            self.assertAlmostEqual(np.linalg.norm(lids, axis=1).sum() / (2 * np.pi * 64), 1,
                                   delta=0.03)

    def test_throat_is_figure_6(self):
        corners = make("throat", "--unit", 8, "--edge", 0.8)
        self.check_surface(corners, 120.0)
        x, r = corners.reshape(-1, 3)[:, 0], np.hypot(*corners.reshape(-1, 3)[:, 1:].T)
        np.testing.assert_allclose(r[(x < 40) | (x > 80)], 12, atol=1e-5)
        np.testing.assert_allclose(r[(x > 56) & (x < 64)], 6, atol=1e-5)
        np.testing.assert_allclose(r[abs(x - 48) < 0.4], 9, atol=0.3)
        # of a cosine between R and Q over a length T: pi T (R^2 + 2/3 R Q + Q^2) 3/8
        volume = np.pi * (12**2 * 80 + 6**2 * 8 + 2 * 16 * (12**2 + 2 / 3 * 12 * 6 + 6**2) * 3 / 8)
        self.assertAlmostEqual(area_and_volume(corners)[1] / volume, 1, delta=3e-3)

    def test_bifurcation(self):
        corners = make("bifurcation", "--length", 120, "--diameter", 20, "--distance", 24)
        self.check_surface(corners, 120.0)
        points = corners.reshape(-1, 3)
        ends = points[points[:, 0] == 0]
        np.testing.assert_allclose(np.hypot(ends[:, 1], ends[:, 2]), 10, atol=0.03)
        daughter = 20 * 2**(-1 / 3)
        middle = points[abs(points[:, 0] - 60) < 4]
        off = np.hypot(abs(middle[:, 1]) - 12, middle[:, 2])
        np.testing.assert_allclose(off, daughter / 2, atol=0.05)

    def test_a_long_bifurcation_is_as_wide_as_a_short_one(self):
        radii = []
        for length in (60, 1200):
            corners = make("bifurcation", "--length", length, "--diameter", 10, "--edge", 1.25)
            x, *off = corners.reshape(-1, 3).T
            radii.append(np.hypot(*off)[x < 0.09 * length])
        # chords of the grid are within a circle
        np.testing.assert_allclose(radii[1].mean(), radii[0].mean(), rtol=2e-3)
        self.assertGreater(radii[1].min(), radii[0].min() - 0.01)

    def test_bad_sizes(self):
        for words, message in ((("tube", "--diameter", -1, "x.stl"), "--diameter -1.0 must be > 0"),
                               (("tube", "--length", "inf", "x.stl"),
                                "--length inf must be > 0 and finite"),
                               (("tube", "--length", "nan", "x.stl"),
                                "--length nan must be > 0 and finite"),
                               (("throat", "--throat-diameter", 4, "x.stl"),
                                "--throat-diameter 4 must not be above the --diameter 3"),
                               (("tube", "--throat-diameter", 2, "x.stl"),
                                "--throat-diameter is for the shape throat, not tube"),
                               (("tube", "--edge", 1e-6, "x.stl"),
                                "--edge 1e-06 makes about 3e+14 triangles"),
                               (("throat", "--taper", 9, "x.stl"),
                                "throat and tapers are 19 long, the vessel 15"),
                               (("bifurcation", "--distance", 2, "x.stl"),
                                "--distance 2 leaves the daughters")):
            done = attempt(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stdout)

    def test_a_throat_may_be_as_wide_as_the_tube(self):
        corners = make("throat", "--throat-diameter", 3)
        np.testing.assert_allclose(np.hypot(*corners.reshape(-1, 3)[:, 1:].T), 1.5, rtol=1e-6)

    def test_output_that_cannot_be_written(self):
        for path, message in (("/nothere/x.stl", "No such file or directory"),
                              ("/", "Is a directory")):
            done = attempt("tube", path)
            self.assertEqual((done.returncode, done.stdout),
                             (1, f"make_vessel.py: {path}: {message}\n"))


if __name__ == "__main__":
    unittest.main()
