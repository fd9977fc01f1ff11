"""Runs that get no more memory end with an error of LAMMPS, wherever it runs out."""

import os
import re
import resource
import unittest

from lammps_case import SHEAR, attempt, in_parallel, scene

EMPTY = "units micro\n"
SCENES = {
    "cell": {},
    "order 3": dict(ib="fix ib all rbc/ib flow integrator rkc auto order 3"),
    "walls": dict(boundary="boundary p p p",
                  create_box="create_box 2 box angle/types 1\nregion tube cylinder x 6 6 5 INF INF",
                  cells="rbc/create rbc single 6 6 6 rotate 90 0 1 0 type 1\n"
                        "rbc/surface tube type 2 spacing 0.5\n"
                        "group cells type 1\ngroup wall type 2",
                  membrane=SHEAR["membrane"].replace("all", "cells"),
                  fluid="fix flow all rbc/fluid dx 0.5 viscosity 1.5 density 1.025",
                  ib="fix ib cells rbc/ib flow\nfix wall wall rbc/wall flow"),
    "fine grid": dict(fluid=SHEAR["fluid"].replace("dx 1.0", "dx 0.125")),
    "history": dict(
        fluid=SHEAR["fluid"].replace("dx 1.0", "dx 0.25").replace("none", "convective")),
    "packing": dict(cells="rbc/create rbc hematocrit 0.3 seed 5"),
}
STEPS = 6    # limits between what LAMMPS needs without a scene and what it needs with it


def address_space(script):
    """The most that a run has used at the end of a script, in bytes."""
    result = attempt(script + "shell 'grep VmPeak /proc/$PPID/status'\n")
    if result.code:
        raise AssertionError(result.printed)
    return int(re.search(r"VmPeak:\s+(\d+) kB", result.printed).group(1)) << 10


def limited(script, limit):
    return attempt(script, before=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))


@unittest.skipIf(os.environ.get("RBC_SANITIZE"),
                 "the sanitizers reserve address space of their own")
class NoMemory(unittest.TestCase):
    def test_an_error_says_so(self):
        scripts = [scene(**{**lines, "timestep": "timestep 1", "run": "run 1"})
                   for lines in SCENES.values()]
        least, *most = in_parallel(address_space, [(script,) for script in (EMPTY, *scripts)])
        for name, script, enough in zip(SCENES, scripts, most):
            limits = [least + (enough - least) * step // STEPS for step in range(STEPS)]
            for limit, result in zip(limits,
                                     in_parallel(limited, [(script, limit) for limit in limits])):
                with self.subTest(name, megabytes=limit >> 20, least=least >> 20,
                                  enough=enough >> 20):
                    if result.code == 0:
                        continue    # other libraries do without
                    self.assertGreater(result.code, 0, result.printed)
                    self.assertRegex(result.error, "(?i)memory|allocat", result.printed)


if __name__ == "__main__":
    unittest.main()
