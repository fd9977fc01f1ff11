"""Cells in periodic boxes: image flags may be missing or wrong at the start of a run, and count
within it."""

import unittest

import numpy as np

from lammps_case import POTENTIALS, SHEAR, attempt, dump_line, read_template, run, scene

POINTS, TRIANGLES = read_template(POTENTIALS / "rbc_162.mol")
A, B, C = POINTS[TRIANGLES].transpose(1, 0, 2)
AREA = np.linalg.norm(np.cross(B - A, C - A), axis=1).sum() / 2
VOLUME = (A * np.cross(B, C)).sum() / 6
ROW = "thermo_style custom step f_mem " + " ".join(f"c_cell[1][{column}]"
                                                   for column in (2, 3, 4, 5, 6))
AT_REST = dict(boundary="boundary p p p", compute="compute cell all rbc/cell", fluid=None, ib=None,
               thermo=ROW)
CARRIED = dict(boundary="boundary p p p", compute="compute cell all rbc/cell", thermo=ROW,
               fluid="fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 mean 0.01 -0.005 0",
               ib="fix ib all rbc/ib flow integrator euler", timestep="timestep 80",
               every="thermo 1", run="run 20", dump=dump_line(20))


class ImageFlags(unittest.TestCase):
    def at_rest(self, result):
        np.testing.assert_allclose(result.thermo["c_cell[1][5]"], AREA, rtol=1e-11)
        np.testing.assert_allclose(result.thermo["c_cell[1][6]"], VOLUME, rtol=1e-11)
        self.assertLess(abs(result.thermo["f_mem"]).max(), 1e-14)

    def test_cells_beyond_the_last_flag(self):
        # LAMMPS counts boxes from -512 to 511; a uniform flow carries the cell across the last
        # sides
        names = {"x": 2, "y": 3, "area": 5, "volume": 6}
        last = "".join(f"variable {name} equal c_cell[1][{column}]\n"
                       for name, column in names.items())
        values = " ".join(f"v_{name}" for name in names)
        last += f"fix out all ave/time 1 1 1 {values} file out.txt format ' %.17g'\n"
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                result = run(scene(**CARRIED, last=last + "set group all image 511 -512 0"), ranks)
                _, x, y, area, volume = np.loadtxt(result.path("out.txt")).T
                np.testing.assert_allclose(area, AREA, rtol=1e-11)
                np.testing.assert_allclose(volume, VOLUME, rtol=1e-11)
                for where, speed, sign in ((x, 0.01, -1), (y, -0.005, 1)):
                    jumps = (np.diff(where) - 80 * speed) / (1024 * 12)
                    np.testing.assert_allclose(jumps, np.rint(jumps), atol=1e-12)
                    self.assertEqual(np.rint(jumps).sum(), sign)
                self.assertEqual(result.printed.count("jumped by 1024 lengths of the box"), 1,
                                 result.printed)
                self.assertNotIn("jumped", run(scene(**CARRIED, last=last), ranks).printed)

    def test_forces_do_not_depend_on_flags(self):
        # flags of each vertex at random
        lines = dict(AT_REST, cells="rbc/create rbc single 0.3 11 6 rotate 30 1 0 0",
                     dump=dump_line(1))
        stretched = "change_box all x scale 1.2 remap\n"
        flags = "variable f atom ceil(1000*random(0,1,7))-500\nset group all image v_f v_f v_f\n"
        reference = run(scene(**lines, last=stretched)).dump().forces()
        largest = abs(reference).max()
        self.assertGreater(largest, 1e-4)
        for ranks in (1, 2, 4):
            with self.subTest(ranks=ranks):
                result = run(scene(**lines, last=stretched + flags), ranks)
                np.testing.assert_allclose(result.dump().forces(), reference, atol=1e-11 * largest)
                self.assertNotIn("as long as in its template", result.printed)

    def test_data_file_without_flags(self):
        made = run(scene(**AT_REST, cells="rbc/create rbc single 3.8 11.5 6",
                         last="write_data cell.data"))
        lines = made.path("cell.data").read_text().splitlines()
        start = next(n for n, line in enumerate(lines) if line.startswith("Atoms"))
        rows = [" ".join(line.split()[:6]) if n > start and len(line.split()) == 9 else line
                for n, line in enumerate(lines)]
        self.assertNotEqual(rows, lines)
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                result = run(
                    scene(**dict(AT_REST, box=None, create_box="read_data bare.data", cells=None)),
                    ranks, files={"bare.data": "\n".join(rows) + "\n"})
                self.at_rest(result)

    def test_reset_atoms_image(self):
        # without bonds every atom is a fragment of its own
        result = run(scene(**dict(CARRIED, cells="rbc/create rbc single 0.2 6 11.8"),
                           last="reset_atoms image all"), 2)
        self.assertAlmostEqual(np.ptp(result.dump()("xu")), np.ptp(POINTS[:, 0]), places=9)
        self.at_rest(result)

    def test_cell_wider_than_half_of_the_box(self):
        # every rank has parts of the cell that are not joined to each other there
        for where in ((4, 4, 2), (0.1, 7.9, 4.9)):
            for grid in ((1, 1, 1), (4, 1, 1), (2, 2, 2)):
                with self.subTest(where, grid=grid):
                    result = run(scene(**dict(AT_REST, box="region box block 0 8.7 0 8.7 0 8.7",
                                              processors="processors " + " ".join(map(str, grid)),
                                              cells="rbc/create rbc single " +
                                              " ".join(map(str, where)))),
                                 int(np.prod(grid)))
                    self.at_rest(result)

    def test_torn_by_change_box(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(scene(**dict(AT_REST, cells="rbc/create rbc single 0.3 6 6"),
                                   last="change_box all x final 0 14"), ranks)
                found = [line for line in result.printed.splitlines()
                         if "times as long as in its template" in line]
                self.assertEqual(len(found), 1, result.printed)
                for word in ("rbc/membrane mem", "molecule ID 1", "change_box", "WARNING"):
                    self.assertIn(word, found[0])

    def test_cell_drawn_out_beyond_half_of_the_box(self):
        # a shear keeps the volume; edges are then up to a box long, and image flags know it from
        # run to run
        shear = ("comm_modify cutoff 24\ndisplace_atoms all ramp x 0 60 z 3 9 units box\nrun 0\n"
                 "run 0")
        slope = 60 / 6
        sheared = POINTS + np.outer(POINTS[:, 2] * slope, [1, 0, 0])
        edges = np.linalg.norm(sheared[TRIANGLES] - sheared[np.roll(TRIANGLES, 1, axis=1)], axis=2)
        self.assertGreater(edges.max(), 9)
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(scene(**dict(AT_REST, neighbor="neighbor 0 bin",
                                          cells="rbc/create rbc single 6 6 6"),
                                   last=shear), ranks)
                np.testing.assert_allclose(result.thermo["c_cell[1][6]"][-1], VOLUME, rtol=1e-10)
                self.assertNotIn("set anew", result.printed)
                self.assertIn("times as long as in its template", result.printed)


if __name__ == "__main__":
    unittest.main()
