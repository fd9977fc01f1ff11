"""compute rbc/cell against the template's own geometry."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, attempt, dump_line, read_template, run, scene
from test_create import rotation


def geometry(points, triangles):
    """Area, volume, centre and semi-axes of the ellipsoid with the same second moments."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    parts = (a * np.cross(b, c)).sum(axis=1) / 6
    volume = parts.sum()
    centre = (parts[:, None] * (a + b + c)).sum(axis=0) / 4 / volume
    # a quadratic integrates over a tetrahedron with its four corners and its centroid
    second = np.einsum("t,tcd->cd", parts,
                       sum(np.einsum("tc,td->tcd", x, x) for x in (a, b, c)) / 20 +
                       16 / 20 * np.einsum("tc,td->tcd", (a + b + c) / 4, (a + b + c) / 4)) / volume
    values, vectors = np.linalg.eigh(second - np.outer(centre, centre))
    return area, volume, centre, np.sqrt(5 * values[::-1]), vectors[:, ::-1]


ROW = "c_cell[{0}][{1}]"


def cell_scene(rows=1, group="all", **changes):
    lines = dict(compute=f"compute cell {group} rbc/cell",
                 thermo="thermo_style custom step " + " ".join(
                     ROW.format(row + 1, column) for row in range(rows) for column in range(1, 20)))
    lines.update(changes)
    return scene(**lines)


def rows_of(result, rows=1, at=-1):
    return np.array([[result.thermo[ROW.format(row + 1, column)][at] for column in range(1, 20)]
                     for row in range(rows)])


class Shapes(unittest.TestCase):
    def test_disc_and_sphere_anywhere(self):
        for name in ("rbc_162", "capsule_162", "rbc_642"):
            points, triangles = read_template(POTENTIALS / f"{name}.mol")
            for where in ((6, 6, 6), (0, 6, 6), (11.9, 0.1, 5)):
                for ranks in (1, 4):
                    with self.subTest(name, where=where, ranks=ranks):
                        turn = rotation(35, (1, 2, -1))
                        area, volume, centre, axes, directions = geometry(points @ turn.T,
                                                                          triangles)
                        row = rows_of(run(cell_scene(
                            molecule=f"molecule rbc {POTENTIALS}/{name}.mol", fluid=None, ib=None,
                            cells=f"rbc/create rbc single {' '.join(map(str, where))} rotate 35 "
                                  "1 2 -1"), ranks))[0]
                        self.assertEqual(row[0], 1)
                        np.testing.assert_allclose(row[1:4], where + centre, atol=1e-12)
                        np.testing.assert_allclose(row[4:6], (area, volume), rtol=1e-12)
                        self.assertAlmostEqual(row[6], (axes[0] - axes[2]) / (axes[0] + axes[2]),
                                               delta=1e-10)
                        np.testing.assert_allclose(row[7:10], axes, rtol=1e-10)
                        np.testing.assert_allclose(np.linalg.norm(row[10:16].reshape(2, 3), axis=1),
                                                   1, rtol=1e-12)
                        if "rbc" in name:
                            self.assertAlmostEqual(abs(row[13:16] @ turn[:, 2]), 1, delta=1e-10)
                            self.assertGreater(row[13:16][abs(row[13:16]) > 1e-9][0], 0)
                        else:
                            self.assertLess(row[6], 1e-3)
                            self.assertAlmostEqual(row[7], (volume * 3 / 4 / np.pi)**(1 / 3),
                                                   delta=2e-2 * row[7])
                        np.testing.assert_array_equal(row[16:], 0)

    def test_long_axis_of_a_stretched_cell(self):
        row = rows_of(run(cell_scene(fluid=None, ib=None, cells="rbc/create rbc single 6 6 6",
                                     last="variable x atom 6+1.2*(x-6)\nset group all x v_x")))[0]
        np.testing.assert_allclose(row[10:13], (1, 0, 0), atol=1e-10)
        np.testing.assert_allclose(row[13:16], (0, 0, 1), atol=1e-10)
        points, triangles = read_template(POTENTIALS / "rbc_162.mol")
        np.testing.assert_allclose(row[7:10], geometry(points * (1.2, 1, 1), triangles)[3],
                                   rtol=1e-10)


THREE = dict(box="region box block 0 30 0 12 0 12", create_box="create_box 2 box angle/types 1",
             cells=f"molecule capsule {POTENTIALS}/capsule_162.mol\nrbc/create rbc single 5 6 6\n"
                   "rbc/create capsule single 15 6 6 type 2\nrbc/create rbc single 25 6 6",
             before="group a type 1\ngroup b type 2")
MEMBRANES = ["fix mem b rbc/membrane capsule neo-hookean 0.01",
             "fix mem2 a rbc/membrane rbc neo-hookean 0.01"]


class Rows(unittest.TestCase):
    def test_are_in_order_of_molecules(self):
        for order in (MEMBRANES, MEMBRANES[::-1]):
            for ranks in (1, 4):
                with self.subTest(order, ranks=ranks):
                    rows = rows_of(run(cell_scene(3, **THREE, membrane="\n".join(order)), ranks), 3)
                    np.testing.assert_array_equal(rows[:, 0], (1, 2, 3))
                    np.testing.assert_allclose(rows[:, 1], (5, 15, 25), atol=1e-10)
                    self.assertAlmostEqual(rows[0, 5], rows[2, 5], delta=1e-10)
                    self.assertGreater(abs(rows[0, 5] - rows[1, 5]), 1)

    def test_of_a_group(self):
        # a cell with a vertex outside the group has no row
        for ids, molecules in (("1:162", [1]), ("163:486", [2, 3]), ("100:486", [2, 3]),
                               ("1:161 325:486", [3])):
            for ranks in (1, 2):
                with self.subTest(ids, ranks=ranks):
                    text = "\n".join(MEMBRANES) + f"\ngroup some id {ids}"
                    result = run(cell_scene(len(molecules), "some", **THREE, membrane=text), ranks)
                    rows = rows_of(result, len(molecules))
                    np.testing.assert_array_equal(rows[:, 0], molecules)
                    np.testing.assert_allclose(rows[:, 1], [5 + 10 * (m - 1) for m in molecules],
                                               atol=1e-10)

    def test_other_atoms_with_the_molecule_id_of_a_cell(self):
        # they are no vertices: outside of the group they leave the cell in it
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(cell_scene(
                    create_box="create_box 2 box angle/types 1", fluid=None, ib=None,
                    cells="mass * 1\nrbc/create rbc single 6 6 6\ncreate_atoms 2 single 1 1 1\n"
                          "set type 2 mol 1",
                    before="group cell type 1",
                    membrane="fix mem cell rbc/membrane rbc neo-hookean 0.01",
                    compute="compute cell cell rbc/cell\ncompute agg cell rbc/aggregate 0.5\n"
                            "compute label all reduce sum c_agg",
                    thermo="thermo_style custom step c_cell[1][1] c_agg[1] c_label"), ranks)
                self.assertEqual(result.thermo["c_cell[1][1]"][0], 1)
                self.assertEqual(result.thermo["c_agg[1]"][0], 1)
                self.assertEqual(result.thermo["c_label"][0], 162)

    def test_follow_cells_that_come_and_go(self):
        more = ("rbc/create rbc single 25 6 6\nrun 1\n"
                "group first molecule 1\ndelete_atoms group first compress no\nrun 1")
        result = run(cell_scene(1, box=THREE["box"], cells="rbc/create rbc single 5 6 6",
                                run="run 1\n" + more))
        np.testing.assert_array_equal(result.thermo["c_cell[1][1]"], [1, 1, 1, 1, 2, 2])


class BetweenRuns(unittest.TestCase):
    """What is known of cells is that of the last run, until atoms change."""

    CHANGES = {
        "deleted": "group gone molecule 1\ndelete_atoms group gone compress no",
        "added": "rbc/create rbc single 15 6 6",
        "moved": "displace_atoms all move 13 0 0",
        "one vertex": "set atom 170 x 25.5",
        "box": "change_box all x scale 1.25 remap",
        "another fix": "unfix mem\nfix mem all rbc/membrane rbc neo-hookean 0.01",
        "IDs": "reset_atoms id"}
    USES = {"Compute rbc/cell cell": "$(c_cell[1][6])", "Compute rbc/aggregate agg": "$(c_agg[1])",
            "Fix rbc/membrane mem": "$(f_mem[5])"}

    @staticmethod
    def printed(lines, use, ranks):
        return attempt(cell_scene(
            box=THREE["box"], cells="rbc/create rbc single 5 6 6\nrbc/create rbc single 25 6 6",
            fluid=None, ib=None, thermo=None,
            membrane="fix mem all rbc/membrane rbc neo-hookean 0.01 viscosity 0.1",
            compute="compute cell all rbc/cell\ncompute agg all rbc/aggregate 0.3",
            run=f"group first molecule 2\ndelete_atoms group first compress no\n"
                f"rbc/create rbc single 25 6 6\nrun 0\n{lines}\n"
                f'print "found {use}"'), ranks)

    def check_error(self, change, owner, ranks):
        with self.subTest(change, ranks=ranks, owner=owner):
            result = self.printed(self.CHANGES[change], self.USES[owner], ranks)
            for words in (owner, "changed since the last run", "use run 0 first"):
                self.assertIn(words, result.error, result.printed)

    def test_changed_atoms_are_an_error(self):
        for change in self.CHANGES:
            for ranks in (1, 2):
                self.check_error(change, "Compute rbc/cell cell", ranks)

    def test_whatever_uses_cells(self):
        for owner in self.USES:
            self.check_error("deleted", owner, 2)

    def test_after_run_0_all_is_known(self):
        points, triangles = read_template(POTENTIALS / "rbc_162.mol")
        volume = geometry(points, triangles)[1]
        for lines in ("velocity all set 0.1 0 0", self.CHANGES["deleted"] + "\nrun 0",
                      self.CHANGES["moved"] + "\nrun 0"):
            for ranks in (1, 2):
                with self.subTest(lines, ranks=ranks):
                    result = self.printed(lines, self.USES["Compute rbc/cell cell"], ranks)
                    found = float(re.search(r"^found (\S+)", result.printed, re.MULTILINE)[1])
                    self.assertAlmostEqual(found / volume, 1, delta=1e-9)


class Motion(unittest.TestCase):
    def test_centre_is_unwrapped_and_velocity_that_of_the_cell(self):
        plug = ("fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025"
                " wall zlo 0.004 -0.003 0 wall zhi 0.004 -0.003 0")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(cell_scene(fluid=plug, timestep="timestep 160", run="run 75"), ranks)
                row = rows_of(result)[0]
                np.testing.assert_allclose(row[1:4],
                                           np.array([6 + 48, 6 - 36, 6]) +
                                           (rows_of(result, at=0)[0][1:4] - 6),
                                           atol=1e-9)
                np.testing.assert_allclose(row[16:], (0.004, -0.003, 0), atol=1e-12)
                np.testing.assert_allclose(row[5], rows_of(result, at=0)[0][5], rtol=1e-10)

    def test_velocity_is_the_mean_of_the_vertices(self):
        result = run(cell_scene(run="run 10", dump=dump_line(10, columns="id vx vy vz")))
        np.testing.assert_allclose(rows_of(result)[0][16:],
                                   result.dump()("vx", "vy", "vz").mean(axis=0), atol=1e-15)


class Use(unittest.TestCase):
    def test_fix_ave_time_and_variables(self):
        last = ("fix out all ave/time 1 1 2 c_cell[1] c_cell[6] c_cell[7] mode vector file out.txt "
                "format ' %.17g'\n"
                "variable ratio equal c_cell[1][6]/c_cell[2][6]\n"
                "thermo_style custom step v_ratio " +
                " ".join(ROW.format(row + 1, column) for row in range(3)
                         for column in range(1, 20)) +
                "\nthermo_modify format float %.17g")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(cell_scene(3, **THREE, membrane="\n".join(MEMBRANES), last=last,
                                        every="thermo 1", run="run 4"), ranks)
                rows = rows_of(result, 3, at=0)
                np.testing.assert_allclose(result.thermo["v_ratio"][0], rows[0, 5] / rows[1, 5],
                                           rtol=1e-12)
                lines = [line.split() for line in result.path("out.txt").read_text().splitlines()
                         if line[0] != "#"]
                self.assertEqual([line for line in lines if len(line) == 2],
                                 [["0", "3"], ["2", "3"], ["4", "3"]])
                table = np.array([line for line in lines if len(line) == 4],
                                 dtype=float).reshape(3, 3, 4)
                np.testing.assert_array_equal(table[:, :, 1], np.tile((1, 2, 3), (3, 1)))
                np.testing.assert_allclose(table[0, :, 2], rows[:, 5], rtol=1e-14)
                np.testing.assert_allclose(table[2, :, 2], rows_of(result, 3)[:, 5], rtol=1e-14)

    # what a fix averages over steps, the run in which cells come or go after it has begun, and
    # whether it may go on
    AVERAGES = {
        "1 1 1": ("run 2", True), "1 2 2": ("run 4", True), "1 3 4": ("run 3", False),
        "1 1 1 ave running": ("run 2", False), "1 1 1 ave window 3": ("run 2", False)}
    CHANGES = {"fewer": "group gone molecule 1\ndelete_atoms group gone compress no",
               "as many": "group gone molecule 1\ndelete_atoms group gone compress no\n"
                          "rbc/create rbc single 6 6 6", "more": "rbc/create rbc single 15 6 6"}

    def averaged(self, when, change, columns="c_cell[1] c_cell[6]", unfix="", ranks=1):
        every, _, ave = when.partition(" ave ")
        average = (f"fix out all ave/time {every} {columns} mode vector file out.txt" +
                   (f" ave {ave}" if ave else ""))
        run_before = self.AVERAGES[when][0]
        return attempt(cell_scene(
            1, box=THREE["box"], cells="rbc/create rbc single 6 6 6\nrbc/create rbc single 25 6 6",
            ib=None, fluid=None,
            compute="compute cell all rbc/cell\ncompute agg all rbc/aggregate 0.3",
            run=f"{average}\n{run_before}\n{unfix}\n{change}\nrun 4"), ranks)

    def test_averages_over_other_cells_are_refused(self):
        for when, (_, allowed) in self.AVERAGES.items():
            for name, change in self.CHANGES.items():
                with self.subTest(when, change=name):
                    result = self.averaged(when, change)
                    if allowed:
                        self.assertEqual(result.error, "")
                        blocks = [line.split()
                                  for line in result.path("out.txt").read_text().splitlines()]
                        rows = [line for line in blocks if len(line) == 3 and line[0] != "#"][-2:]
                        self.assertLess(abs(float(rows[0][2]) / float(rows[1][2]) - 1), 1e-5)
                        self.assertEqual([int(float(row[1])) for row in rows],
                                         {"fewer": [2, 2], "as many": [2, 3], "more": [2, 3]}[name])
                        continue
                    for word in ("compute rbc/cell cell", "cells changed (2 before",
                                 "fix out averages", "unfix"):
                        self.assertIn(word, result.error.lower(), result.printed)

    def test_averages_go_on(self):
        for when in ("1 3 4", "1 1 1 ave running"):
            with self.subTest(when):
                self.assertEqual(self.averaged(when, "", ranks=2).error, "")
                self.assertEqual(
                    self.averaged(when, self.CHANGES["fewer"], unfix="unfix out").error, "")

    def test_classes_of_aggregates(self):
        result = self.averaged("1 1 1 ave running", self.CHANGES["fewer"], "c_agg[2] c_agg[3]")
        self.assertIn("Compute rbc/aggregate agg: classes of size changed (2 before, 1 now)",
                      result.error)
        self.assertIn("fix out averages", result.error)


if __name__ == "__main__":
    unittest.main()
