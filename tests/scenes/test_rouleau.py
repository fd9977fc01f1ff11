"""A rouleau of coarse cells at 100 and 200 /s: without adhesion it comes apart, adhesion of several
times the shear stress times the radius of a cell holds it together (the dimensional estimate of the
scene's README)."""

import unittest

from lammps_case import in_parallel
from scene_case import run_example

SHORT = dict(rates="100 200", shape="rbc_162", rest=10000)


class Rouleau(unittest.TestCase):
    def test_adhesion_holds_what_shear_parts(self):
        apart, held = (result.tables() for result in in_parallel(
            lambda sigma, K, ranks: run_example("rouleau", ranks, sigma=sigma, K=K, **SHORT),
            [(0, 0.07, 1), (3.0e-3, 0.21, 2)]))
        self.assertEqual(apart[0]["c_rouleau[1]"][-1], 1)    # stacked and at rest
        self.assertGreater(apart[-1]["c_rouleau[1]"][-1], 1)
        for table in held:
            self.assertEqual(table["c_rouleau[1]"].max(), 1)
            self.assertLess(table["E_vdwl"].max(), 0)


if __name__ == "__main__":
    unittest.main()
