"""A step allocates nothing: what our code allocates does not depend on the number of steps.

The library of count_allocations.cpp counts by the places that allocate. LIBCOUNT names its file, as
ctest sets it. Allocations within LAMMPS, MPI and FFTW are theirs and do not count.
"""

import collections
import itertools
import os
import re
import subprocess
import unittest

from lammps_case import SHEAR, in_parallel, run, scene

SHORT, LONG = 30, 45
# No list is built anew within a run.
STILL = "neigh_modify delay 1000 every 1000 check no"
BASE = dict(newton=STILL, timestep="timestep 20",
            thermo="thermo_style custom step f_flow[10] f_ib[5]", every="thermo 1000",
            neighbor="neighbor 1.0 bin")
TUBE = dict(boundary="boundary p p p", box="region box block 0 14 0 20 0 20",
            create_box="create_box 2 box angle/types 1\nregion tube cylinder x 10 10 7 INF INF",
            cells="rbc/create rbc single 6 10.5 10 rotate 50 0 1 0 type 1\n"
                  "rbc/surface tube type 2 spacing 1.2 offset 0.381\n"
                  "group cells type 1\ngroup wall type 2",
            membrane=SHEAR["membrane"].replace("all", "cells"),
            compute="fix wall wall rbc/wall flow")
FLUID = "fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 "
IB = "fix ib all rbc/ib flow "
# Cells that overlap at the start would move too far for the list at a longer timestep.
DENSE = dict(box="region box block 0 12 0 12 0 14", timestep="timestep 2",
             cells="rbc/create rbc hematocrit 0.3 seed 4711 overlap 0.1",
             before="pair_style rbc/jkr 0.6 plates yes\npair_coeff 1 1 adhesive 0.07 1.0e-3 0.4\n"
                    "comm_modify cutoff 5.0")


def with_inertia(regime):
    return dict(fluid=SHEAR["fluid"].replace("inertia none", f"inertia {regime}"),
                timestep="timestep 1")


SCENES = {
    "midpoint": dict(ib=IB + "integrator midpoint"),
    "euler": dict(ib=IB + "integrator euler"),
    "ab2": dict(ib=IB + "integrator ab2"),
    "order 3": dict(ib=IB + "integrator rkc 6 order 3"),
    "dense": dict(DENSE, ib=IB + "integrator rkc auto adapt 1e-3 2"),
    "walls": dict(TUBE, fluid=FLUID + "inside tube mean x 1e-3",
                  ib="fix ib cells rbc/ib flow integrator rkc auto"),
    "sheet walls": dict(TUBE, fluid=FLUID + "inside tube mean x 1e-3",
                        compute="fix wall wall rbc/wall flow sheets yes",
                        ib="fix ib cells rbc/ib flow integrator rkc auto"),
    "walls body": dict(TUBE, fluid=FLUID + "inside tube body 5e-5 0 0",
                       ib="fix ib cells rbc/ib flow integrator midpoint"),
    "walls repel": dict(TUBE, fluid=FLUID + "inside tube mean x 1e-3",
                        ib="fix ib cells rbc/ib flow integrator rkc auto",
                        before="pair_style rbc/jkr 3.5 walls tube\npair_coeff * * none\n"
                               "pair_coeff 1 1 repulsive 0.01 3.5", timestep="timestep 10"),
    "viscous": dict(membrane=SHEAR["membrane"] + " viscosity 50", ib=IB + "integrator rkc auto"),
    "thinning": dict(membrane=SHEAR["membrane"] + " viscosity 50 thinning 5 1e-4",
                     ib=IB + "integrator midpoint"),
    "viscous in a vessel": dict(TUBE, fluid=FLUID + "inside tube body 5e-5 0 0",
                                membrane=TUBE["membrane"] + " viscosity 50",
                                ib="fix ib cells rbc/ib flow integrator midpoint"),
    "unsteady": with_inertia("unsteady"),
    "convective": with_inertia("convective"),
    "projection": with_inertia("convective scheme projection"),
    "direct": dict(with_inertia("unsteady"), ib=IB + "scheme direct", before="mass 1 0.05"),
    "direct convective": dict(with_inertia("convective"), ib=IB + "scheme direct",
                              before="mass 1 0.05")}


def counts(result):
    """Allocations of all ranks of a run by place: (object, offset, symbol) -> number."""
    found = collections.Counter()
    for file in result.folder.glob("allocations.*"):
        for line in file.read_text().splitlines():
            name, offset, number, symbol = line.split(None, 3)
            found[name, offset, symbol] += int(number)
    return found


def place(name, offset, symbol):
    """Function, file and line of a place, as far as the build has them."""
    done = subprocess.run(["addr2line", "-f", "-C", "-i", "-e", name, offset], text=True,
                          check=False, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    lines = done.stdout.splitlines()
    pairs = [f"{function} {line}" for function, line in zip(lines[::2], lines[1::2])]
    ours = [pair for pair in pairs if re.search(r"/(fluid|USER-RBC)/", pair)]
    return "; from ".join(ours) or pairs and not pairs[0].startswith("?") and pairs[0] or symbol


@unittest.skipIf(os.environ.get("RBC_SANITIZE"), "the sanitizers count allocations themselves")
class Allocations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.environ["COUNT_ALLOCATIONS_OF"] = "lmp_rbc:rbcplugin"
        os.environ["LD_PRELOAD"] = os.environ["LIBCOUNT"]
        try:
            cases = list(itertools.product(SCENES, (1, 2), (SHORT, LONG)))
            cls.found = dict(zip(cases, in_parallel(cls.count, cases)))
        finally:
            del os.environ["LD_PRELOAD"]

    @staticmethod
    def count(name, ranks, steps):
        return counts(run(scene(**{**BASE, **SCENES[name], "run": f"run {steps}"}), ranks))

    def test_of_a_start_are_counted(self):
        for case, found in self.found.items():
            with self.subTest(case):
                self.assertGreater(sum(found.values()), 100)

    def test_none_in_a_step(self):
        for name in SCENES:
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    more = self.found[name, ranks, LONG] - self.found[name, ranks, SHORT]
                    lines = [f"{number / (LONG - SHORT):.3g} per step: {place(*where)}"
                             for where, number in more.most_common()]
                    if more:
                        self.fail("\n" + "\n".join(lines))


if __name__ == "__main__":
    unittest.main()
