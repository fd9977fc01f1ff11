"""Atoms that lie inside cells at the start of a run are warned of, with their number and type."""

import re
import unittest

from lammps_case import SHEAR, in_parallel, run, scene

# Relative to the centre of a biconcave cell with its axis along z, 7.8 wide, 0.8 thick in the
# middle and at most 2.6.
INSIDE = [(0, 0, 0), (2.8, 0, 0.6), (0, -2.8, -0.6), (-3.6, 0, 0)]
OUTSIDE = [(0, 0, 0.9), (0, 0, -0.9), (4.1, 0, 0), (2.8, 2.8, 0), (0, 3.6, 1.1)]
CENTRES = [(0.5, 6, 6), (12, 6, 6)]    # the first reaches through the periodic side


def atoms(places, centre, type):
    return [f"create_atoms {type} single " +
            " ".join(f"{(c + d) % side:.6g}" for c, d, side in zip(centre, place, (24, 12, 12)))
            for place in places]


def warned(lines, ranks, moved="all", **ways):
    cells = "\n".join(f"rbc/create rbc single {x} {y} {z}" for x, y, z in CENTRES)
    result = run(scene(
        box="region box block 0 24 0 12 0 12", create_box="create_box 3 box angle/types 1",
        cells="\n".join(["mass * 1", cells, *lines]), before="group cells type 1",
        membrane=SHEAR["membrane"].replace("all", "cells"), thermo=None,
        ib=SHEAR["ib"].replace("all", moved), **ways), ranks)
    return re.findall("WARNING: (Fix rbc/ib ib moves .*)", result.printed)


class EnclosedAtoms(unittest.TestCase):
    # Slices of 3, and a side through both cells: no rank has a whole cell, and most have a part.
    WAYS = [(1, {}), (2, {}), (4, {}), (8, {"processors": "processors 8 1 1"}),
            (3, {"processors": "processors 1 1 3"}),
            (4, {"processors": "comm_style tiled", "last": "balance 1.0 rcb"})]

    def test_are_warned_of(self):
        lines = [*atoms(OUTSIDE, CENTRES[0], 2), *atoms(OUTSIDE, CENTRES[1], 2),
                 *atoms(INSIDE, CENTRES[0], 2), *atoms(INSIDE[:1], CENTRES[1], 3)]
        first = 2 * 162 + 2 * len(OUTSIDE) + 1
        found_by = in_parallel(lambda ranks, ways: warned(lines, ranks, **ways), self.WAYS)
        for found in found_by:
            self.assertEqual(len(found), 1, found)
            self.assertIn("Fix rbc/ib ib moves 4 atoms of type 2, 1 atom of type 3 inside cells "
                          f"(the first has atom ID {first})", found[0])

    def test_others_are_not(self):
        outside = [*atoms(OUTSIDE, CENTRES[0], 2), *atoms(OUTSIDE, CENTRES[1], 2)]
        inside = atoms(INSIDE, CENTRES[0], 2)
        for lines, moved in ((outside, "all"), ([], "all"), (inside, "cells")):
            self.assertEqual(warned(lines, 1, moved), [])


if __name__ == "__main__":
    unittest.main()
