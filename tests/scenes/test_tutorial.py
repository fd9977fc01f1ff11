"""The input script of the tutorial runs as it is, and does what the tutorial says."""

import unittest

import numpy as np

from lammps_case import POTENTIALS, ROOT, run
from scene_case import polyhedron

SCRIPT = ROOT / "examples" / "shear-cell" / "in.tutorial"
PLAIN = 1.5 * 1e-4                      # viscosity times shear rate


class Tutorial(unittest.TestCase):
    def test_a_cell_tumbles(self):
        script = SCRIPT.read_text(encoding="utf-8").replace("../../potentials", str(POTENTIALS))
        thermo = run(script.replace("thermo          20", "thermo 2"), 2, timeout=500).thermo
        strain = thermo["Time"] * 1e-4
        deformation, volume = thermo["c_cell[1][7]"], thermo["c_cell[1][6]"]
        # the least is where the cell stands across the flow, once in each half turn
        first, last = (strain[(strain > a) & (strain < b)][np.argmin(
            deformation[(strain > a) & (strain < b)])] for a, b in ((5, 14.5), (14.5, 20)))
        relative = thermo["f_flow[1]"] / PLAIN
        print(f"\nD {deformation.min():.3f} to {deformation.max():.3f}, half a turn in "
              f"{last - first:.2f} strains, viscosity {relative.min():.4f} to {relative.max():.4f}")
        self.assertAlmostEqual(last - first, 9.3, delta=0.2)
        self.assertAlmostEqual(deformation.min(), 0.44, delta=0.01)
        self.assertAlmostEqual(deformation.max(), 0.57, delta=0.01)
        np.testing.assert_allclose(volume, polyhedron("rbc_642")[1], rtol=3e-5)
        self.assertTrue(np.all((relative[5:] > 1.01) & (relative[5:] < 1.025)))
        self.assertLessEqual(set(thermo["f_ib[5]"][5:]), {7, 8, 9})    # stages


if __name__ == "__main__":
    unittest.main()
