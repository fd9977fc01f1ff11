"""Cells of other shapes and sizes, made by potentials/make_template.py, in shear."""

import unittest
from pathlib import Path

from lammps_case import make_template, run, scene


class Shapes(unittest.TestCase):
    def check(self, words, timestep, ranks, **changes):
        path = Path.cwd() / "shape.mol"
        make_template(*words, "--output", path)
        result = run(scene(molecule=f"molecule rbc {path}", compute="compute cell all rbc/cell",
                           thermo="thermo_style custom step atoms f_mem c_cell[1][6] c_cell[1][7]",
                           timestep=f"timestep {timestep}", **changes), ranks)
        volume = result.thermo["c_cell[1][6]"]
        self.assertLess(abs(volume / volume[0] - 1).max(), 1e-4)
        self.assertGreater(result.thermo["f_mem"][-1], 0)
        return result.thermo["Atoms"][0]

    def test_smallest_and_largest_frequency(self):
        for shape in ("disc --diameter 7.82", "sphere --radius 3"):
            for frequency, ranks in ((1, 1), (1, 2), (32, 2)):
                with self.subTest(shape, frequency=frequency, ranks=ranks):
                    atoms = self.check([*shape.split(), "--frequency", frequency], 20, ranks,
                                       run="run 10")
                    self.assertEqual(atoms, 10 * frequency**2 + 2)

    def test_platelet_and_white_cell(self):
        self.check("spheroid --axis-ratio 0.3333333 --diameter 2.4 --frequency 4".split(), 20, 1,
                   run="run 200")
        self.check("sphere --radius 4 --frequency 6".split(), 100, 2, run="run 100")

    def test_sickle_from_a_file(self):
        surface = Path.cwd() / "sickle.stl"
        make_template(*"sickle --frequency 6 --surface".split(), surface)
        self.check(["mesh", surface, "--area", 100], 100, 2, run="run 100",
                   box="region box block 0 18 0 18 0 12",
                   cells="rbc/create rbc single 9 9 6 rotate 30 1 0 0")


if __name__ == "__main__":
    unittest.main()
