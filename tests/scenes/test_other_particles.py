"""Beads beside cells, by the script of doc/other_particles.rst: which begin inside of cells."""

import re
import textwrap
import unittest

import numpy as np
import rbc
from lammps_case import ROOT, run

SIDES = np.array([16, 16, 0])    # of the box where it is periodic


def script():
    page = (ROOT / "doc" / "other_particles.rst").read_text(encoding="utf-8")
    block = re.search(r"^\.\. code-block:: LAMMPS\n\n((?:   .*\n|\n)+)", page, re.MULTILINE)
    return textwrap.dedent(block.group(1))


def turns(points, vertices, triangles):
    """How often a surface goes around each point: 1 inside and 0 outside, by its solid angle."""
    a, b, c = (vertices[triangles][None, :, k] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    volume = np.einsum("ijk,ijk->ij", a, np.cross(b, c))
    cosine = (la * lb * lc + np.einsum("ijk,ijk->ij", a, b) * lc
              + np.einsum("ijk,ijk->ij", b, c) * la + np.einsum("ijk,ijk->ij", c, a) * lb)
    return np.arctan2(volume, cosine).sum(axis=1) / (2 * np.pi)


def inside(folder, step):
    """Numbers of beads, and of those inside of cells, images of the box included."""
    points = np.loadtxt(folder / f"beads.{step}.dump", skiprows=9)[:, 1:]
    found = np.zeros(len(points), dtype=bool)
    for vertices, triangles in rbc.read_surfaces(folder / f"cells.{step}.vtp").cells().values():
        for x in (-1, 0, 1):
            for y in (-1, 0, 1):
                found |= turns(points + SIDES * (x, y, 0), vertices, triangles) > 0.5
    return len(points), found.sum()


class Beads(unittest.TestCase):
    def test_none_is_in_a_cell_and_none_gets_in(self):
        result = run(script(), timeout=300)
        for step in (0, 100):
            self.assertEqual(inside(result.folder, step), (60, 0))
        self.assertNotIn("WARNING", result.printed)

    def test_those_in_cells_are_deleted(self):
        many = script().replace("off overlap 1.5 maxtry 1000", "off")
        many = many.replace("random 60", "random 300").replace("run ", "run 0 #")
        count, within = inside(run(many).folder, 0)
        # as many as the cells have of the volume, within four standard deviations
        part = 8 * 89.3 / (16 * 16 * 13)
        self.assertAlmostEqual(within / count, part, delta=4 * (part * (1 - part) / count)**0.5)
        deleted = many.replace("fix           out", "delete_atoms overlap 1.5 beads cells\nfix out")
        count, within = inside(run(deleted).folder, 0)
        self.assertEqual(within, 0)
        self.assertGreater(count, 50)


if __name__ == "__main__":
    unittest.main()
