"""Cells of atom_style template are those of style angle in less memory: the same digits, restart
files, removal."""

import re
import unittest

import numpy as np

from lammps_case import SHEAR, dump_line, run, scene

MOLECULE = SHEAR["molecule"]
ANGLE = dict(style="atom_style angle")
TEMPLATE = dict(style=f"{MOLECULE}\natom_style template rbc\natom_modify map array", molecule=None)

# Cells that touch, an atom beside them, and a list of neighbors, which LAMMPS filters by bonds.
PAIR = ("pair_style hybrid/overlay rbc/jkr 0.6 zero 1.0\n"
        "pair_coeff 1 1 rbc/jkr repulsive 0.007 0.4\npair_coeff * * zero")
CELLS = dict(create_box="create_box 2 box angle/types 1",
             cells="rbc/create rbc single 6 6 4.4\nrbc/create rbc single 6 6 7.2\n"
                   "create_atoms 2 single 1 1 1\nmass 2 1\ngroup cells molecule > 0",
             before=PAIR, membrane=SHEAR["membrane"].replace("mem all", "mem cells"),
             ib=SHEAR["ib"].replace("ib all", "ib cells"), every="thermo 1", dump=dump_line(20),
             thermo="thermo_style custom step f_mem evdwl f_flow[11]")

# LAMMPS's style angle, of each atom: numbers of bonds and of angles, six rows of these without any
# entry, three numbers and a row for neighbors along bonds. Style template: two numbers.
MORE = 2 * 4 + 6 * 8 + (3 * 4 + 8) + (4 + 8) - 2 * 4
HASH = 2 * 12 + 2 * 4    # twice as many entries, of three numbers, and heads of lists
ROOM = 16384    # atoms for which LAMMPS has room at least


def bytes_of_atoms(result):
    return float(re.search(r"^Atoms +\| +(\S+)", result.printed, re.MULTILINE).group(1))


class Template(unittest.TestCase):
    def test_moves_as_angle_bit_for_bit(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                angle, template = (run(scene(**{**CELLS, **style}, run="run 20"), ranks)
                                   for style in (ANGLE, TEMPLATE))
                self.assertGreater(abs(angle.thermo["E_vdwl"]).min(), 0)
                for name, column in angle.thermo.items():
                    np.testing.assert_array_equal(column, template.thermo[name], name)
                np.testing.assert_array_equal(angle.dump().positions(),
                                              template.dump().positions())
                less = (bytes_of_atoms(angle) - bytes_of_atoms(template)) * 324 / (ROOM * ranks)
                print(f"\n{ranks} ranks: {less:.2f} bytes an atom less")
                self.assertAlmostEqual(less, MORE, delta=0.1)

    def test_a_hash_finds_the_same_atoms_in_more_memory(self):
        hashed = {**TEMPLATE, "style": TEMPLATE["style"].replace("array", "hash")}
        array, table = (run(scene(**{**CELLS, **style}, run="run 20"), 2)
                        for style in (TEMPLATE, hashed))
        np.testing.assert_array_equal(array.dump().positions(), table.dump().positions())
        more = (bytes_of_atoms(table) - bytes_of_atoms(array)) * 324 / (ROOM * 2)
        print(f"\nhash: {more:.2f} bytes an atom more")
        self.assertAlmostEqual(more, HASH - 4 * 325 / ROOM, delta=0.1)

    def test_goes_on_from_a_restart_file(self):
        begin = scene(**{**CELLS, **TEMPLATE}, run="run 20\nwrite_restart half.restart")
        head = {name: None for name in ("boundary", "box", "create_box")}
        again = scene(**{**CELLS, **TEMPLATE, **head, "units": None}, run="run 20")
        again = again.replace(CELLS["cells"], "read_restart half.restart\ngroup cells molecule > 0")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                whole = run(scene(**{**CELLS, **TEMPLATE}, run="run 40"), ranks).dump()
                result = run(begin + "clear\n" + again, ranks)
                self.assertIn("restoring atom style template", result.printed)
                self.assertEqual(result.dump().steps[-1], 40)
                apart = abs(result.dump().positions() - whole.positions()).max()
                print(f"\ncontinued, {ranks} ranks: {apart:.2g} um from one run")
                self.assertLess(apart, 1e-11)

    def test_a_file_of_style_angle_goes_on(self):
        begin = scene(**{**CELLS, **ANGLE}, run="run 20\nwrite_restart half.restart")
        head = {name: None for name in ("boundary", "box", "create_box")}
        again = scene(**{**CELLS, **TEMPLATE, **head, "units": None}, run="run 20")
        again = again.replace(CELLS["cells"], "read_restart half.restart\ngroup cells molecule > 0")
        result = run(begin + "clear\n" + again)
        self.assertIn("restoring atom style angle", result.printed)
        self.assertEqual(result.dump().steps[-1], 40)

    def test_whole_cells_are_removed(self):
        ends = [run(scene(**{**CELLS, **style}, run="run 20\ngroup gone molecule 1\n"
                                                    "delete_atoms group gone\nrun 20"), 2)
                for style in (ANGLE, TEMPLATE)]
        self.assertEqual(len(ends[1].dump()("id")), 162 + 1)
        np.testing.assert_array_equal(*(end.dump().positions() for end in ends))


if __name__ == "__main__":
    unittest.main()
