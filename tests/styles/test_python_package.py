"""The package rbc reads what a run wrote, and measures surfaces as compute rbc/cell does."""

import unittest

import numpy as np
import rbc
from lammps_case import run, scene

COUETTE = 0.0012    # speed of the upper plate, 12 um above the lower one
OUTPUT = """
compute cell all rbc/cell
fix out all ave/time 5 1 5 c_cell[*] mode vector format " %.15g" file cell.dat
fix surfaces all rbc/vtk 5 cells.*.vtp
fix parts all rbc/vtk 5 parts.*.pvtp
dump velocity all grid/vtk 5 u.*.vtr f_flow:grid:velocity[1] f_flow:grid:velocity[2] &
     f_flow:grid:velocity[3]
dump text all grid 5 flow.grid f_flow:grid:velocity[*]
dump_modify text sort id format float %.15g
"""


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = run(scene(cells="rbc/create rbc number 3 seed 7 overlap 0.5",
                               box="region box block 0 10 0 14 0 12", last=OUTPUT, run="run 10"),
                         4)

    def path(self, name):
        return self.result.path(name)

    def test_shapes_are_those_of_compute_rbc_cell(self):
        cells = rbc.read_cell_table(self.path("cell.dat"))
        self.assertEqual(cells.steps.tolist(), [0, 5, 10])
        self.assertEqual(cells.molecules.tolist(), [1, 2, 3])
        for frame, step in enumerate(cells.steps):
            shapes = rbc.shapes_of(self.path(f"cells.{step}.vtp"))
            self.assertEqual(list(shapes), [1, 2, 3])
            for row, shape in enumerate(shapes.values()):
                for name, value in (("area", shape.area), ("volume", shape.volume),
                                    ("deformation", shape.deformation)):
                    self.assertAlmostEqual(value / cells[name][frame, row], 1, delta=1e-6)
                semi_axes = cells.vectors("long", "middle", "short")[frame, row]
                np.testing.assert_allclose(shape.semi_axes, semi_axes, rtol=1e-6)
                axis = cells.vectors("short_x", "short_y", "short_z")[frame, row]
                np.testing.assert_allclose(shape.axes[2], axis, atol=1e-5)
                # the surface is shifted into the box
                apart = shape.centre - cells.vectors("x", "y", "z")[frame, row]
                np.testing.assert_allclose(apart / (10, 14, 12), np.round(apart / (10, 14, 12)),
                                           atol=1e-6)
            self.assertEqual(rbc.read_surfaces(self.path(f"cells.{step}.vtp")).time, 200 * step)

    def test_files_of_several_tasks_are_read_as_one(self):
        whole, parts = (rbc.read_surfaces(self.path(name)).cells()
                        for name in ("cells.10.vtp", "parts.10.pvtp"))
        self.assertGreater(len(list(self.path("parts.10_0.vtp").parent.glob("parts.10_*.vtp"))), 1)
        self.assertEqual(list(whole), list(parts))
        for molecule, (vertices, triangles) in whole.items():
            np.testing.assert_array_equal(parts[molecule][0], vertices)
            np.testing.assert_array_equal(parts[molecule][1], triangles)

    def test_both_kinds_of_grids_are_equal(self):
        texts = rbc.read_grids(self.path("flow.grid"))
        self.assertEqual([grid.step for grid in texts], [0, 5, 10])
        for text in texts:
            vtr = rbc.read_grid(self.path(f"u.{text.step}.vtr"))    # has six digits
            for sides in zip(text.edges, vtr.edges):
                np.testing.assert_allclose(*sides, rtol=1e-5)
            np.testing.assert_allclose(text.vector(), vtr.vector(), rtol=1e-5, atol=1e-16)

    def test_a_flow_between_plates(self):
        grid = rbc.read_grid(self.path("u.0.vtr"))    # the cells have no forces yet
        expected = np.broadcast_to(COUETTE * grid.centres[2] / 12, grid.vector().shape[:3])
        np.testing.assert_allclose(grid.vector()[..., 0], expected, rtol=1e-5)

    def test_the_log(self):
        last = rbc.read_log(self.path("log.case"))[-1]
        for name, column in self.result.thermo.items():
            np.testing.assert_array_equal(last[name], column)


if __name__ == "__main__":
    unittest.main()
