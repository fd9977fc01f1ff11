"""Pictures of spheres and of linear flows have the pixels that geometry gives them."""
import tempfile
import unittest
from pathlib import Path

import numpy as np
from matplotlib.image import imread
from rbc import InputError, Look, render
from rbc.actors import COOL, round_limits
from rbc.rendering import title_of
from vtk_files import cuboid, sphere, write_grid, write_surfaces

SIDE = 10.0
BOX = (0, SIDE) * 3
FRONT = Look(box=BOX, view=(0, 0), parallel=True, size=(400, 400), occlusion=False)
PIXELS = 400 / (1.06 * SIDE)    # per length: a margin of 6 % around the box


def red(image):
    """Where the cells are."""
    return (image[..., 0] > 0.3) & (image[..., 1] < 0.6 * image[..., 0])


class Pictures(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def picture(self, mesh, look, **data):
        write_surfaces(self.folder / "cells.0.vtp", {1: mesh}, **data)
        render(self.folder / "cells.0.vtp", self.folder / "cells.png", look)
        return imread(self.folder / "cells.png")[..., :3]

    def test_a_sphere_has_its_place_and_its_size(self):
        for centre, radius in (((3, 5, 7), 2), ((6, 1, 4), 1)):
            rows, columns = np.nonzero(red(self.picture(sphere(radius, centre), FRONT)))
            self.assertAlmostEqual(np.sqrt(len(rows) / np.pi) / PIXELS, radius, delta=0.03)
            # x to the right, z up
            self.assertAlmostEqual((columns.mean() - 199.5) / PIXELS + 5, centre[0], delta=0.05)
            self.assertAlmostEqual((199.5 - rows.mean()) / PIXELS + 5, centre[2], delta=0.05)

    def test_two_pictures_in_one_process_are_equal(self):
        first, second = (self.picture(sphere(2, (3, 5, 7)), FRONT) for _ in range(2))
        np.testing.assert_array_equal(first, second)

    def test_the_slice_of_a_flow_has_the_colors_of_its_speed(self):
        edges = (np.linspace(0, SIDE, 5),) * 2 + (np.linspace(0, SIDE, 41),)
        heights = (edges[2][1:] + edges[2][:-1]) / 2
        velocity = np.zeros((4, 4, 40, 3))
        velocity[..., 0] = -heights    # the speed is the height
        write_grid(self.folder / "u.0.vtr", edges, "Vector", velocity)
        look = FRONT._replace(flow=self.folder / "u.0.vtr", flow_range=(0, SIDE), size=(465, 400))
        image = self.picture(sphere(0.5, (9, 5, 5)), look)
        for height in (1, 4, 8):
            row = round(199.5 - (height - 5) * PIXELS)
            expected = [np.interp(height / SIDE, np.linspace(0, 1, len(COOL)), channel)
                        for channel in zip(*COOL)]
            np.testing.assert_allclose(image[row, 150], expected, atol=0.02)
        # a cell behind the slice is not seen, one before it is
        for place, seen in ((8, False), (2, True)):
            self.assertEqual(red(self.picture(sphere(1, (5, place, 5)), look)).any(), seen)
        with self.assertRaisesRegex(InputError, "a slice at 11 is outside the grid, 0 to 10"):
            render(self.folder / "cells.0.vtp", self.folder / "x.png", look._replace(slice_at=11))

    def wall(self, mesh):
        """STL file of a mesh."""
        vertices, triangles = mesh
        facets = "".join(
            "facet normal 0 0 0\nouter loop\n"
            + "".join("vertex {:g} {:g} {:g}\n".format(*vertices[n]) for n in triangle)
            + "endloop\nendfacet\n" for triangle in triangles)
        path = self.folder / "wall.stl"
        path.write_text(f"solid x\n{facets}endsolid x\n")
        return path

    def test_walls_are_behind_the_cells_inside(self):
        vertices, triangles = cuboid((6, 6, 6), (5, 5, 5))
        cell = sphere(2, (5, 5, 5))
        without = self.picture(cell, FRONT)
        for handed in (triangles, triangles[:, ::-1]):
            image = self.picture(cell, FRONT._replace(walls=[self.wall((vertices, handed))]))
            np.testing.assert_array_equal(image[150:250, 150:250], without[150:250, 150:250])
            self.assertGreater(abs(image[200, 290] - without[200, 290]).max(), 0.1)

    def test_walls_are_where_the_region_puts_them(self):
        cell = sphere(0.3, (1, 5, 1))
        look = FRONT._replace(walls=[self.wall(cuboid((1, 1, 1)))], wall_scale=4,
                              wall_shift=(6, 5, 7))
        changed = np.abs(self.picture(cell, look) - self.picture(cell, FRONT)).max(axis=2) > 0.02
        rows, columns = np.nonzero(changed)
        for place, middle in ((columns, 6), (399 - rows, 7)):
            ends = (np.array([place.min(), place.max()]) - 199.5) / PIXELS + 5
            np.testing.assert_allclose(ends, (middle - 2, middle + 2), atol=0.1)

    def test_limits_are_round(self):
        for low, high, expected in ((0, 0.000704, (0, 0.0008)), (0, 1, (0, 1)), (0, 0.4, (0, 0.4)),
                                    (-3.3, 5.1, (-6, 6)), (0.12, 0.13, (0.12, 0.13)),
                                    (0, 0, (0, 1)), (99, 101, (99, 101))):
            np.testing.assert_allclose(round_limits(low, high), expected, rtol=1e-12, atol=1e-15)

    def test_titles_of_color_bars_have_units_of_micro(self):
        self.assertEqual(title_of("velocity", Look().unit), "velocity\n(\u00b5m/\u00b5s = m/s)")
        self.assertEqual(title_of("velocity", "radii"), "velocity")
        self.assertEqual(title_of("growth", Look().unit), "growth")

    def test_data_that_is_not_there(self):
        with self.assertRaisesRegex(InputError, "no point data 'speed' in the file; there are: m"):
            self.picture(sphere(1), FRONT._replace(color="speed"))


if __name__ == "__main__":
    unittest.main()
