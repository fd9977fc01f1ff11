"""A capsule in shear whose inside is as viscous as the outside, and five times as viscous."""

import sys
import unittest

import numpy as np

from lammps_case import ROOT, in_parallel
from scene_case import run_example, study_of

sys.path.insert(0, str(ROOT / "scripts"))
from rbc.tables import read_ave_time  # noqa: E402

STUDY = study_of("contrast")
COARSE = dict(shape="capsule_362", dx=0.25, strain=1)


class Contrast(unittest.TestCase):
    def test_boundary_elements(self):
        # The box alone makes D larger by 1 to 2 %.
        ratios = 1, 5
        results = in_parallel(
            lambda inside, ranks: run_example("contrast", ranks, inside=inside, **COARSE),
            list(zip(ratios, (1, 2))))
        for inside, result in zip(ratios, results):
            history = read_ave_time(result.path("cell.dat"))
            _, *shape = STUDY.shape_rows(history, STUDY.TIMESTEP)[-1]
            errors = np.array(shape) / STUDY.exact_at(inside, COARSE["strain"]) - 1
            print(f"\nlambda {inside}: errors of D and inclination {STUDY.percent(errors)}")
            self.assertLess(abs(errors[0]), 0.05)
            self.assertLess(abs(errors[1]), 0.015)


if __name__ == "__main__":
    unittest.main()
