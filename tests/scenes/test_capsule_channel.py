"""A capsule in a tube on a coarse grid: nearly rigid it moves as a sphere does, softer it grows
long and hollow."""

import sys
import unittest

import numpy as np

from lammps_case import ROOT, in_parallel
from scene_case import run_example, study_of

sys.path.insert(0, str(ROOT / "scripts"))
from rbc.tables import read_table  # noqa: E402

STUDY = study_of("capsule-channel")
COARSE = dict(shape="capsule_642", length=5, cells=12)


class CapsuleChannel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.numbers = 0.001, 0.015, 0.05
        stiff = {**COARSE, **STUDY.STIFF, "ratio": 0.75}
        soft = [dict(COARSE, ratio=0.85, Ca=number, duration=2) for number in cls.numbers[1:]]
        cases = [stiff, *soft]
        cls.results = in_parallel(lambda variables, ranks: run_example("capsule-channel", ranks,
                                                                       **variables),
                                  list(zip(cases, (1, 2, 1))))
        cls.rows = [dict(zip(STUDY.COLUMNS, STUDY.measure(result.folder, variables)))
                    for result, variables in zip(cls.results, cases)]

    def test_stiff_limit(self):
        # the gap to the wall is three cells of the fluid wide
        speed, exact = self.rows[0]["U"], STUDY.RIGID[self.rows[0]["a/R"]]
        print(f"\nspeed {speed:.4f}, exact {exact:.4f}")
        self.assertLess(abs(speed / exact - 1), 0.02)
        self.assertLess(abs(self.rows[0]["length"] - 1), 5e-3)

    def test_softer(self):
        # Risso et al 2006: at fixed a/R the capsule is stretched axially as Ca rises; its back
        # turns hollow
        hollows = []
        for row, result in zip(self.rows[1:], self.results[1:]):
            x, _, _ = STUDY.outline(result.path("capsule.dump"), COARSE["shape"])
            hollows.append(x[-1] - x.min())
            print(f"\nlength {row['length']:.4f}, width {row['width']:.4f}, hollow "
                  f"{hollows[-1]:.4f} R")
            self.assertLess(row["width"], 0.985)
        self.assertGreater(self.rows[2]["length"] - self.rows[1]["length"], 0.1)
        self.assertLess(hollows[0], 0.1)
        self.assertGreater(hollows[1], 0.1)

    def test_kept(self):
        for result in self.results:
            table = read_table(result.path("capsule.dat"))
            self.assertLess(np.ptp(table["v_volume"]), 1e-4)
            self.assertLess(table["v_axis"].max(), 2e-3)


if __name__ == "__main__":
    unittest.main()
