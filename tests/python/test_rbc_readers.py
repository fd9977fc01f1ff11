"""The package rbc reads surfaces, grids and logs, and measures shapes known in closed form."""
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rbc
from vtk_files import cuboid, sphere, write_grid, write_surfaces


def turned(angle):
    """Rotation about y that takes x towards z, by an angle in degrees."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.array([(c, 0, -s), (0, 1, 0), (s, 0, c)])


class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)


class Package(unittest.TestCase):
    def test_all_that_it_names_is_there(self):
        self.assertGreater(len(rbc.__all__), 25)
        for name in rbc.__all__:
            self.assertIsNotNone(getattr(rbc, name), name)
        with self.assertRaisesRegex(AttributeError, "no read_all"):
            rbc.read_all


class Shapes(unittest.TestCase):
    def test_of_a_cuboid(self):
        # the moments of a cuboid along its sides are side^2/12
        sides = np.array([5.0, 1.0, 2.0])
        for angle in (30, -70):
            rotation, centre = turned(angle), np.array([7.0, -3.0, 100.0])
            shape = rbc.shape_of(*cuboid(sides, centre, rotation))
            np.testing.assert_allclose(shape.centre, centre, rtol=1e-14)
            np.testing.assert_allclose(shape.volume, 10, rtol=1e-13)
            np.testing.assert_allclose(shape.area, 34, rtol=1e-13)
            semi_axes = np.sqrt(5 / 12) * np.array([5, 2, 1])
            np.testing.assert_allclose(shape.semi_axes, semi_axes, rtol=1e-12)
            self.assertAlmostEqual(shape.deformation, 4 / 6, delta=1e-12)
            self.assertAlmostEqual(shape.inclination, angle, delta=1e-10)
            expected = rotation.T[[0, 2, 1]]
            np.testing.assert_allclose(np.abs(np.sum(shape.axes * expected, axis=1)), 1, rtol=1e-12)
            for axis in shape.axes:
                self.assertGreater(axis[np.flatnonzero(np.abs(axis) > 1e-12)[0]], 0)

    def test_tilt_is_that_of_the_plane_of_a_disc(self):
        # whichever way its long axis lies within it
        for sides in ((5, 4, 1), (4, 5, 1)):
            for angle in (30, -70):
                shape = rbc.shape_of(*cuboid(np.array(sides), np.zeros(3), turned(angle)))
                self.assertAlmostEqual(shape.tilt, angle, delta=1e-10)

    def test_of_a_sphere(self):
        # its reduced volume is 1, and a finer mesh is nearer to it, at second order
        errors = [1 - rbc.shape_of(*sphere(2, resolution=n)).reduced_volume for n in (20, 40, 80)]
        self.assertTrue(0 < errors[2] < 1e-3, errors)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(np.log2(coarse / fine), 2, delta=0.1)


class Means(unittest.TestCase):
    def test_of_what_is_no_series(self):
        for times, values, part, message in (
                ([0, 1, 1], [1, 2, 3], 0.5, "as many values as times, which rise"),
                ([0, 1], [1, 2, 3], 0.5, "as many values as times, which rise"),
                (range(12), range(12), 0.0, "a part of 0 is not above 0 and up to 1"),
                (range(12), range(12), 0.5, "has 6 lines of output, a mean .* needs 10 or more")):
            with self.assertRaisesRegex(rbc.InputError, message):
                rbc.mean_with_error(times, values, part)

    def test_of_a_wave_over_whole_periods(self):
        times = np.linspace(0, 20 * np.pi, 4001)
        mean, error = rbc.mean_with_error(times, 3 + np.sin(times), 0.8)
        self.assertAlmostEqual(mean, 3, delta=1e-6)
        self.assertTrue(0 < error < 1)


class Elongation(unittest.TestCase):
    @staticmethod
    def cells(semi_axes, turns):
        """Of ellipsoids that are turned, a step each, as compute rbc/cell has them."""
        columns = {name: [] for name in rbc.CELL_COLUMNS}
        for turn in turns:
            for d, long, short in zip("xyz", turn[0], turn[2]):
                columns[f"long_{d}"].append([long])
                columns[f"short_{d}"].append([short])
            for name, value in zip(("long", "middle", "short"), semi_axes):
                columns[name].append([value])
        return rbc.Cells(np.arange(len(turns)),
                         {name: np.array(values) for name, values in columns.items() if values})

    def test_of_an_ellipsoid_in_the_plane_of_shear(self):
        # it reaches sqrt(a^2 cos^2 + c^2 sin^2) along the flow, and b along the vorticity
        a, b, c = 4.0, 3.0, 1.0
        angles = np.array([0.0, 30, 60, 90, -45])
        found = rbc.elongation_index(self.cells((a, b, c), [turned(angle) for angle in angles]))
        length = np.hypot(a * np.cos(np.radians(angles)), c * np.sin(np.radians(angles)))
        np.testing.assert_allclose(found[:, 0], (length - b) / (length + b), rtol=1e-13)
        self.assertAlmostEqual(found[0, 0], 1 / 7)
        self.assertAlmostEqual(found[3, 0], -1 / 2)

    def test_of_any_ellipsoid_is_that_of_its_shadow(self):
        """The shadow of many points of it, seen along z, and with the flow along z along y."""
        semi_axes, random = np.array([4.0, 2.5, 1.0]), np.random.default_rng(2)
        points = random.standard_normal((400_000, 3))
        points *= semi_axes / np.linalg.norm(points, axis=1)[:, None]
        turn = turned(40) @ np.array([(0.8, 0.6, 0), (-0.6, 0.8, 0), (0, 0, 1)]) @ turned(25)
        lengths = np.ptp(points @ turn, axis=0)
        cells = self.cells(semi_axes, [turn])
        for flow, vorticity in ("xy", "zx"):
            length, width = (lengths["xyz".index(d)] for d in (flow, vorticity))
            self.assertAlmostEqual(rbc.elongation_index(cells, flow, vorticity)[0, 0],
                                   (length - width) / (length + width), delta=1e-3)

    def test_of_one_direction(self):
        with self.assertRaisesRegex(rbc.InputError, "must be two of x, y and z, not x and x"):
            rbc.elongation_index(self.cells((3, 2, 1), [turned(0)]), "x", "x")


class Surfaces(Folder):
    def test_cells_of_a_file(self):
        meshes = {7: cuboid((1, 2, 3), (9, 9, 9)), 2: sphere(1, (4, 0, 0), 8), 5: cuboid((2, 2, 2))}
        count = sum(len(vertices) for vertices, _ in meshes.values())
        write_surfaces(self.folder / "cells.8.vtp", meshes, 3.5, tension=np.arange(count))
        read = rbc.read_surfaces(self.folder / "cells.8.vtp")
        self.assertEqual(read.time, 3.5)
        self.assertEqual(read.data["tension"].tolist(), list(range(count)))
        cells = read.cells()
        self.assertEqual(list(cells), [2, 5, 7])
        for name, (vertices, triangles) in cells.items():
            np.testing.assert_allclose(vertices, meshes[name][0], rtol=1e-6)
            np.testing.assert_array_equal(triangles, meshes[name][1])
        shapes = rbc.shapes_of(self.folder / "cells.8.vtp")
        self.assertAlmostEqual(shapes[5].volume, 8, delta=1e-5)
        self.assertAlmostEqual(shapes[7].volume, 6, delta=1e-5)

    def test_cells_whose_vertices_alternate(self):
        vertices, triangles = cuboid((1, 1, 1))
        molecules = np.tile([3, 1], 8)
        surfaces = rbc.Surfaces(np.repeat(vertices, 2, axis=0) + 10.0 * (molecules == 1)[:, None],
                                np.concatenate([2 * triangles, 2 * triangles + 1]),
                                {"molecule": molecules}, 0)
        cells = surfaces.cells()
        for name, shift in ((1, 10), (3, 0)):
            np.testing.assert_allclose(cells[name][0], vertices + shift)
            self.assertAlmostEqual(rbc.shape_of(*cells[name]).volume, 1, delta=1e-12)

    def test_some_cells_of_a_file(self):
        meshes = {name: cuboid((name, 1, 1), (10 * name, 0, 0)) for name in (1, 2, 3)}
        write_surfaces(self.folder / "cells.0.vtp", meshes)
        rbc.write_cells(self.folder / "cells.0.vtp", self.folder / "some.vtp", [1, 3])
        volumes = {name: shape.volume
                   for name, shape in rbc.shapes_of(self.folder / "some.vtp").items()}
        self.assertEqual(list(volumes), [1, 3])
        np.testing.assert_allclose(list(volumes.values()), [1, 3], rtol=1e-6)

    def test_files_that_are_none(self):
        with self.assertRaises(FileNotFoundError):
            rbc.read_surfaces(self.folder / "missing.vtp")
        write_surfaces(self.folder / "empty.vtp", {1: (np.zeros((3, 3)), np.zeros((0, 3), int))})
        with self.assertRaisesRegex(rbc.InputError, "holds no surface"):
            rbc.read_surfaces(self.folder / "empty.vtp")

    def test_series(self):
        names = [f"out/cells.{step}.vtp" for step in (100, 0, 20)]
        self.assertEqual([step for step, _ in rbc.series(names)], [0, 20, 100])
        with self.assertRaisesRegex(rbc.InputError, "does not end in a step"):
            rbc.series(["cells.vtp"])


class Grids(Folder):
    EDGES = np.linspace(0, 4, 3), np.linspace(-3, 3, 4), np.linspace(10, 11, 5)

    def field(self):
        """(x, 10 y, 100 z) at the centres of the cells."""
        centres = [(edges[1:] + edges[:-1]) / 2 for edges in self.EDGES]
        return np.stack(np.meshgrid(*centres, indexing="ij"), axis=-1) * (1, 10, 100)

    def test_vtr(self):
        write_grid(self.folder / "u.30.vtr", self.EDGES, "Vector", self.field())
        write_grid(self.folder / "p.30.vtr", self.EDGES, "Scalar", self.field()[..., 1])
        grid = rbc.read_grid(self.folder / "u.30.vtr")
        self.assertEqual(grid.step, 30)
        for found, edges in zip(grid.edges, self.EDGES):
            np.testing.assert_allclose(found, edges, rtol=1e-6)
        np.testing.assert_allclose(grid.vector(), self.field(), rtol=1e-6)
        grid = rbc.read_grid(self.folder / "p.30.vtr")
        np.testing.assert_allclose(grid.data["Scalar"], self.field()[..., 1], rtol=1e-6)
        with self.assertRaisesRegex(rbc.InputError, "no one vector among the fields Scalar"):
            grid.vector()

    def write_dump(self, frames, cut=0):
        names = " ".join(f"f_flow:grid:velocity[{n}]" for n in (1, 2, 3))
        bounds = "".join(f"{edges[0]} {edges[-1]}\n" for edges in self.EDGES)
        text = ""
        for step, field in frames.items():
            rows = np.swapaxes(field, 0, 2).reshape(-1, 3)
            text += (f"ITEM: TIMESTEP\n{step}\nITEM: BOX BOUNDS pp pp ff\n{bounds}"
                     "ITEM: DIMENSION\n3\nITEM: GRID SIZE nx ny nz\n2 3 4\n"
                     f"ITEM: GRID CELLS {names}\n")
            text += "".join(" ".join(map(str, row.tolist())) + "\n" for row in rows)
        path = self.folder / "flow.grid"
        path.write_text(text[:len(text) - cut])
        return path

    def test_text_dump(self):
        grids = rbc.read_grids(self.write_dump({0: 0 * self.field(), 50: self.field()}))
        self.assertEqual([grid.step for grid in grids], [0, 50])
        for grid, factor in zip(grids, (0, 1)):
            np.testing.assert_allclose(grid.vector(), factor * self.field(), rtol=1e-14)
            np.testing.assert_allclose(grid.edges[2], self.EDGES[2])
        np.testing.assert_allclose(rbc.read_grid(self.folder / "flow.grid").vector(), self.field())

    def test_files_that_are_none(self):
        with self.assertRaisesRegex(rbc.InputError, "step 50 is cut off"):
            rbc.read_grid(self.write_dump({0: self.field(), 50: self.field()}, cut=30))
        (self.folder / "x.grid").write_text("no grid")
        with self.assertRaisesRegex(rbc.InputError, "neither a .vtr file nor a text dump"):
            rbc.read_grid(self.folder / "x.grid")


class Logs(Folder):
    TEXT = ("LAMMPS (4 Feb 2025)\nStep Temp\n 0 1.5\n 10 2.5\nLoop time of 1\n"
            "Step c_a[1][2]\n 10 -1\nWARNING: a line of words\n 20 -2e-3\nLoop time of 1\n")

    def test_runs(self):
        (self.folder / "log").write_text(self.TEXT)
        first, second = rbc.read_log(self.folder / "log")
        self.assertEqual({name: column.tolist() for name, column in first.items()},
                         {"Step": [0, 10], "Temp": [1.5, 2.5]})
        self.assertEqual(second["c_a[1][2]"].tolist(), [-1, -2e-3])

    def test_one_without_output(self):
        (self.folder / "log").write_text("LAMMPS (4 Feb 2025)\n")
        with self.assertRaisesRegex(rbc.InputError, "holds no thermo output"):
            rbc.read_log(self.folder / "log")


class CellTables(Folder):
    def write(self, header):
        path = self.folder / "cell.dat"
        path.write_text(f"# fix\n# TimeStep Number-of-rows\n# Row {header}\n0 2\n1 4 0.5\n"
                        "2 9 0.25\n10 2\n1 4 0.75\n2 9 nan\n")
        return path

    def test_columns_have_names(self):
        cells = rbc.read_cell_table(self.write("c_cell[1] c_cell[7]"))
        self.assertEqual(cells.steps.tolist(), [0, 10])
        self.assertEqual(cells.molecules.tolist(), [4, 9])
        np.testing.assert_array_equal(cells["deformation"], [[0.5, 0.25], [0.75, np.nan]])

    def test_tables_of_others(self):
        for header in ("c_cell[1] c_cell[20]", "c_cell[1] v_x", "c_a[1] c_b[2]"):
            with self.assertRaisesRegex(rbc.InputError, "is not of (one )?compute rbc/cell"):
                rbc.read_cell_table(self.write(header))

    def test_array_of_a_program(self):
        array = np.arange(38.0).reshape(2, 19)
        cells = rbc.cells_of_array(20, array)
        array[:] = 0    # LAMMPS uses its memory again
        self.assertEqual(cells["deformation"].tolist(), [[6, 25]])
        self.assertEqual(cells.vectors("vx", "vy", "vz")[0, 1].tolist(), [35, 36, 37])
        with self.assertRaisesRegex(rbc.InputError, "this array 3"):
            rbc.cells_of_array(0, np.zeros((1, 3)))


if __name__ == "__main__":
    unittest.main()
