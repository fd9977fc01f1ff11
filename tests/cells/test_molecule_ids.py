"""Molecule IDs name cells; how large they are does not matter."""

import unittest

import numpy as np

from error_case import BadInput
from lammps_case import SHEAR, dump_line, run, scene

LARGEST = 2147483647
IDS = (7, 2000000000, LARGEST)
TOUCHING = dict(
    box="region box block 0 18 0 18 0 18",
    cells="\n".join(f"rbc/create rbc single 9 9 {z}" for z in (6, 8.4, 14)),
    before="pair_style rbc/jkr 0.6\npair_coeff * * repulsive 0.003 0.5",
    compute="compute cell all rbc/cell\ncompute agg all rbc/aggregate 1.0",
    ib=SHEAR["ib"] + "\nfix out all rbc/vtk 10 cells.*.vtp",
    thermo="thermo_style custom step f_mem pe " + " ".join(f"c_agg[{n}]" for n in range(1, 6)) +
           "".join(f" c_cell[{n}][1] c_cell[{n}][4] c_cell[{n}][6]" for n in (1, 2, 3)),
    timestep="timestep 20", run="run 10", dump=dump_line(10))


class MoleculeIDs(BadInput):
    def test_gaps_do_not_matter(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                small = run(scene(**TOUCHING), ranks)
                rename = "".join(f"group g{n} molecule {n}\n" for n in (1, 2, 3))
                rename += "".join(f"set group g{n} mol {new}\n" for n, new in enumerate(IDS, 1))
                cells = TOUCHING["cells"] + "\n" + rename
                large = run(scene(**dict(TOUCHING, cells=cells)), ranks)
                for name, values in small.thermo.items():
                    if name.endswith("][1]"):
                        continue
                    np.testing.assert_array_equal(large.thermo[name], values, name)
                rows = tuple(large.thermo[f"c_cell[{n}][1]"][0] for n in (1, 2, 3))
                self.assertEqual(rows, IDS)
                self.assertGreater(abs(small.dump().forces()).max(), 1e-6)
                np.testing.assert_array_equal(large.dump().forces(), small.dump().forces())
                written = large.path("cells.10.vtp").read_bytes()
                self.assertEqual(written.count(LARGEST.to_bytes(8, "little")), 162)

    def test_cells_that_no_membrane_holds(self):
        lines = dict(box="region box block 0 30 0 12 0 12", before="group held molecule 1",
                     cells="\n".join(f"rbc/create rbc single {x} 6 6" for x in (5, 15, 25)),
                     membrane=SHEAR["membrane"].replace("all", "held"))
        for changes, said in (
                ({}, "moves 2 cells without a membrane (the first has molecule ID 2)"),
                (dict(before="group held molecule 1 3"),
                 "moves 1 cell without a membrane (the first "),
                (dict(membrane=None, thermo=None), "moves 3 cells without a membrane (the first "),
                (dict(before="group held molecule 1 2 3"), ""),
                (dict(ib=SHEAR["ib"].replace("all", "held")), ""),
                (dict(membrane=None, thermo=None, last="set group all mol 0"), "")):
            for ranks in (1, 2):
                with self.subTest(changes, ranks=ranks):
                    result = run(scene(**{**lines, **changes}), ranks)
                    self.assertEqual(result.printed.count(" without a membrane "), 1 if said else 0)
                    self.assertIn(said, result.printed)

    def test_no_ID_is_left(self):
        cells = f"{SHEAR['cells']}\nset group all mol {LARGEST}\nrbc/create rbc single 6 6 9"
        self.check({"no ID": (dict(cells=cells), ["rbc/create", "molecule IDs", str(LARGEST)])})


if __name__ == "__main__":
    unittest.main()
