"""A viscous membrane in a vessel of atoms adds its own resistance and takes nothing else away.

An evaluation of the velocities with viscosity solves for the flow many times over, and each time
with the same forcing. What is driven must stay driven, whichever way, with and without a region
`inside`, on any number of tasks.
"""

import itertools
import subprocess
import sys
import unittest

import numpy as np

from lammps_case import Failed, POTENTIALS, ROOT, dump_line, in_parallel, run, scene

TOLERANCE = 1e-6
MEAN, BODY = 1e-3, 5e-5    # um/us and kPa/um: flows of one order
SLIGHT = "viscosity 1e-6"
THINNING = "viscosity 300 thinning 1 1e-4"    # half of the fall at the rate of shear of the flow
VISCOSITIES = ("", SLIGHT, "viscosity 1", "viscosity 300", THINNING)
DRIVES = {"body": f"body {BODY} 0 0", "mean": f"mean x {MEAN}"}
INSIDE = {"inside": "inside vessel", "everywhere": ""}
INTEGRATORS = ("midpoint", "rkc auto")
STEPS = 1

# One cell in a tube of 12 um, of which it fills two thirds across.
VESSEL = {
    "units": "units micro",
    "style": "atom_style molecular",
    "boundary": "boundary p p p",
    "box": "region box block 0 12 0 18 0 18",
    "create_box": "create_box 2 box angle/types 1",
    "region": "region vessel rbc/mesh ../tube.stl shift 0 9 9",
    "molecule": f"molecule rbc {POTENTIALS}/rbc_162.mol",
    "cells": "rbc/create rbc single 6 9.5 9 rotate 50 0 1 0 type 1",
    "wall": "rbc/surface vessel type 2 spacing 1.2 offset 0.266",
    "groups": "group cells type 1\ngroup wall type 2",
    "neighbor": "neighbor 1.0 bin",
    "exclude": "neigh_modify exclude group wall all",
    "membrane": "fix mem cells rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4"
                " area 1.0 0.05 volume yes ",
    "fluid": "fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 ",
    "ib": f"fix ib cells rbc/ib flow kernel roma3 tol {TOLERANCE} maxiter 300 integrator ",
    "no_slip": f"fix wall wall rbc/wall flow kernel roma3 tol {TOLERANCE} maxiter 300",
    "thermo": "thermo_style custom step f_flow[13] f_flow[19] f_wall[7]",
    "thermo_modify": "thermo_modify format float %.17g",
    "every": "thermo 1",
    "timestep": "timestep 50",
    "dump": dump_line(1, columns="id type xu yu zu vx vy vz"),
    "run": f"run {STEPS}"}


def simulate(drive, inside, integrator, viscosity, ranks):
    """Velocities of the vertices and thermo output at each step, or the error of the run."""
    ib = VESSEL["ib"]
    if not viscosity:
        # Both keywords are allowed with a viscous membrane only.
        ib = ib.replace(f" tol {TOLERANCE} maxiter 300", "")
    try:
        result = run(scene(VESSEL, membrane=VESSEL["membrane"] + viscosity, ib=ib + integrator,
                           fluid=f"{VESSEL['fluid']} {INSIDE[inside]} {DRIVES[drive]}"), ranks)
    except Failed as failed:
        return failed
    dump = result.dump()
    velocities = [dump("vx", "vy", "vz", frame=n)[dump("type", frame=n) == 1]
                  for n in range(STEPS + 1)]
    return np.array(velocities), result.thermo


class ViscousVessel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([sys.executable, ROOT / "scripts" / "make_vessel.py", "tube",
                        "--length", "12", "--diameter", "12", "--edge", "1", "tube.stl"],
                       stdout=subprocess.DEVNULL, check=True)
        cases = list(itertools.product(DRIVES, INSIDE, INTEGRATORS, VISCOSITIES, (1, 2)))
        cls.results = dict(zip(cases, in_parallel(simulate, cases)))

    def result(self, *case):
        found = self.results[case]
        if isinstance(found, Failed):
            self.fail(found.result.error)
        return found

    def compare(self, check, viscosities, drives=DRIVES):
        """Calls check(results without viscosity, with it, viscosity) for every other choice."""
        for *case, ranks in itertools.product(drives, INSIDE, INTEGRATORS, (1, 2)):
            for viscosity in viscosities:
                with self.subTest(" ".join(case), ranks=ranks, viscosity=viscosity):
                    check(self.result(*case, "", ranks), self.result(*case, viscosity, ranks),
                          viscosity)

    def test_slight_viscosity_changes_nothing(self):
        def check(without, slight, _):
            difference = abs(slight[0] - without[0]).max()
            self.assertLess(difference, 5 * TOLERANCE * abs(without[0]).max())
        self.compare(check, (SLIGHT,))

    def test_ranks_agree(self):
        for case in itertools.product(DRIVES, INSIDE, INTEGRATORS, VISCOSITIES):
            with self.subTest(case):
                one, one_thermo = self.result(*case, 1)
                two, two_thermo = self.result(*case, 2)
                self.assertLess(abs(two - one).max(), 10 * TOLERANCE * abs(one).max())
                for column in ("f_flow[13]", "f_flow[19]"):
                    np.testing.assert_allclose(two_thermo[column], one_thermo[column],
                                               rtol=10 * TOLERANCE)

    def test_body_force_stays(self):
        def check(without, viscous, viscosity):
            np.testing.assert_allclose(viscous[1]["f_flow[19]"], BODY, rtol=1e-12)
            share = viscous[1]["f_flow[13]"] / without[1]["f_flow[13]"]
            self.assertLess(share[0], 1 + 5 * TOLERANCE if viscosity == SLIGHT else 1 - 1e-3)
            self.assertGreater(share.min(), 0.9)    # The stiffest cell takes 7 % of the flow.
        self.compare(check, VISCOSITIES[1:], ("body",))

    def test_mean_velocity_is_held(self):
        # Two solves find the drive at step 0, exactly where forces are linear in velocities. From
        # then on the velocity is off by the second difference of what the cell does to the flow.
        def check(without, viscous, viscosity):
            self.assertLess(abs(viscous[1]["f_flow[13]"][0] / MEAN - 1),
                            2e-3 if viscosity == THINNING else 20 * TOLERANCE)
            np.testing.assert_allclose(viscous[1]["f_flow[13]"], MEAN, rtol=0.015)
            share = viscous[1]["f_flow[19]"] / without[1]["f_flow[19]"]
            self.assertGreater(share.min(), 1 - 20 * TOLERANCE)
            self.assertLess(share.max(), 1.1)
        self.compare(check, VISCOSITIES, ("mean",))


if __name__ == "__main__":
    unittest.main()
