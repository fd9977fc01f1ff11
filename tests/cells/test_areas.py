"""Areas at which red cells burst are a warning."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, read_template, run, scene


def area(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


class Areas(unittest.TestCase):
    def growths(self, factor, words, ranks):
        """Of what is warned, with a cell that is drawn out along its axis."""
        printed = run(scene(
            cells="rbc/create rbc single 6 6 6", fluid=None, ib=None, thermo=None,
            membrane=f"fix mem all rbc/membrane rbc neo-hookean 1e-9 {words}",
            last=f"displace_atoms all ramp z {-6 * (factor - 1)} {6 * (factor - 1)} z 0 12",
            run="run 1"), ranks).printed
        return re.findall(r"WARNING: Fix rbc/membrane mem: the area of the cell with molecule ID 1 "
                          r"was up to (\S+) percent larger", printed)

    def test_of_a_cell_that_is_drawn_out(self):
        points, triangles = read_template(POTENTIALS / "rbc_162.mol")
        for factor, warns in ((1.3, True), (1.05, False)):
            growth = 100 * (area(points * [1, 1, factor], triangles) / area(points, triangles) - 1)
            self.assertEqual(growth > 4, warns)
            for ranks in (1, 2):
                found = self.growths(factor, "area 1e-9 0", ranks)
                self.assertEqual(len(found), warns)
                if warns:
                    self.assertEqual(found[0], f"{growth:.3g}")

    def test_of_a_cell_whose_area_is_free(self):
        self.assertEqual(self.growths(1.3, "area 0 0", 1), [])


if __name__ == "__main__":
    unittest.main()
