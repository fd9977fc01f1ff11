"""`clear`, runs in pieces, restarts and data files continue as if nothing had happened."""

import os
import unittest

import numpy as np

from lammps_case import SHEAR, dump_line, run, scene

DIAMETER = 7.82
TABLE = dict(compute="compute cell all rbc/cell", every="thermo 10",
             thermo="thermo_style custom step f_mem f_flow[1] f_flow[10] c_cell[1][6] c_cell[1][7]")


class Pieces(unittest.TestCase):
    def compare(self, run_lines, ranks, exact, **changes):
        whole = run(scene(**{**TABLE, **changes}, dump=dump_line(10), run="run 100"), ranks)
        pieces = run(scene(**{**TABLE, **changes}, dump=dump_line(10), run=run_lines), ranks)
        a, b = whole.dump(), pieces.dump()
        self.assertEqual(b.steps[-1], 100)
        apart = abs(a.positions() - b.positions()).max() / DIAMETER
        print(f"\n{run_lines!r}, {ranks} ranks: differs from one run by {apart:.2g} diameters")
        if exact:
            np.testing.assert_array_equal(a.positions(), b.positions())
            np.testing.assert_array_equal(a.forces(), b.forces())
            self.assertEqual([c[-1] for c in whole.thermo.values()],
                             [c[-1] for c in pieces.thermo.values()])
        else:
            self.assertLess(apart, 1e-12)

    def test_two_halves(self):
        for every_step, exact in (("", False), ("\nneigh_modify every 1 delay 0 check no", True)):
            for ranks in (1, 2):
                with self.subTest(every_step, ranks=ranks):
                    self.compare("run 50\nrun 50", ranks, exact,
                                 neighbor=SHEAR["neighbor"] + every_step)

    def test_without_a_second_setup(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.compare("run 50\nrun 50 pre no", ranks, True)
                self.compare("run 50 post no\nrun 50 pre no post no", ranks, True)

    def test_run_0_changes_nothing(self):
        self.compare("run 0\nrun 50\nrun 0\nrun 50", 1, True,
                     neighbor=SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no")

    def test_with_a_plate_that_moves_in_time(self):
        # without and with the forces of a fix that comes after fix rbc/ib
        for last in ("", "fix push all addforce 1e-5 0 2e-5"):
            with self.subTest(last):
                self.compare("run 50\nrun 50", 1, True,
                             before="variable U equal 0.0012*cos(step/10)",
                             fluid=SHEAR["fluid"].replace("0.0012", "v_U"), last=last,
                             neighbor=SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no")

    def test_euler(self):
        self.compare("run 50\nrun 50", 1, True, ib=SHEAR["ib"].replace("midpoint", "euler"),
                     neighbor=SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no")


class Again(unittest.TestCase):
    def test_after_clear(self):
        one = scene(**TABLE, dump=dump_line(20), run="run 20")
        other = (one.replace("rotate 30", "rotate 70").replace("atoms.dump", "other.dump")
                 .replace("dx 1.0", "dx 0.8"))
        for plugin in (False, True):
            for ranks in (1, 2):
                with self.subTest(plugin=plugin, ranks=ranks):
                    load = f"plugin load {os.environ['RBC_PLUGIN']}\n" if plugin else ""
                    result = run(one + "clear\n" + load + other + "clear\n" + load +
                                 one.replace("atoms.dump", "again.dump"), ranks, plugin=plugin)
                    np.testing.assert_array_equal(result.dump().positions(),
                                                  result.dump("again.dump").positions())
                    first, _, again = result.tables()
                    for column in first:
                        np.testing.assert_array_equal(first[column], again[column])
                    self.assertGreater(abs(result.dump().positions() -
                                           result.dump("other.dump").positions()).max(),
                                       0.1)

    def test_fixes_replaced_between_runs(self):
        # a stiffer membrane, another grid and another kernel take over where the first left off
        more = "\n".join(
            ["unfix ib", "unfix flow", "unfix mem", SHEAR["membrane"].replace("0.257", "0.5"),
             SHEAR["fluid"].replace("dx 1.0", "dx 0.75"), SHEAR["ib"].replace("peskin4",
                                                                              "roma3"), "run 20"])
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(scene(**TABLE, run="run 20\n" + more), ranks)
                first, second = result.tables()
                self.assertGreater(second["f_mem"][0], 1.5 * first["f_mem"][-1])
                np.testing.assert_allclose(second["c_cell[1][6]"], first["c_cell[1][6]"][0],
                                           rtol=1e-4)


class Files(unittest.TestCase):
    """The template and the fixes are given again; the cells come from the file."""

    def test_continue(self):
        head = {name: None for name in ("boundary", "box", "create_box", "cells")}
        whole = run(scene(**TABLE, dump=dump_line(100), run="run 100")).dump()
        for name, save, load in (
                ("restart", "write_restart half.restart", "read_restart half.restart"),
                ("data", "write_data half.data nocoeff",
                 "boundary p p f\nread_data half.data\nreset_timestep 50")):
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    lines = dict(head, processors=load, dump=dump_line(100), run="run 50")
                    if name == "restart":
                        lines.update(units=None, style=None)
                    second = scene(**TABLE, **lines)
                    result = run(scene(**TABLE, run="run 50\n" + save) + "clear\n" + second, ranks)
                    dump = result.dump()
                    self.assertEqual(dump.steps[-1], 100)
                    np.testing.assert_array_equal(dump("mol"), 1)
                    apart = abs(dump.positions() - whole.positions()).max() / DIAMETER
                    print(f"\ncontinued from a {name} file, {ranks} ranks: {apart:.2g} diameters "
                          "from one run")
                    self.assertLess(apart, 1e-12)

    def test_cells_replicated(self):
        result = run(scene(**{**TABLE, "thermo": TABLE["thermo"] + " c_cell[4][1] c_cell[4][6]"},
                           cells="rbc/create rbc single 6 6 6 rotate 30 1 0 0\nreplicate 2 2 1",
                           run="run 10"), 2)
        self.assertEqual(result.thermo["c_cell[4][1]"][-1], 4)
        np.testing.assert_allclose(result.thermo["c_cell[4][6]"], result.thermo["c_cell[1][6]"],
                                   rtol=1e-12)

    def test_cells_deleted_whole(self):
        # with IDs closed up or not
        for words in ("compress yes", "compress no", "compress yes mol yes"):
            with self.subTest(words):
                result = run(scene(
                    box="region box block 0 30 0 12 0 12", cells="rbc/create rbc single 5 6 6\n"
                    "rbc/create rbc single 15 6 6\nrbc/create rbc single 25 6 6",
                    last=f"group out molecule 2\ndelete_atoms group out {words}", dump=dump_line(5),
                    run="run 5"))
                self.assertEqual(len(result.dump()("id")), 324)


if __name__ == "__main__":
    unittest.main()
