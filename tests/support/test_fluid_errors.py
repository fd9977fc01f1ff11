"""What bad input to fix rbc/fluid and fix rbc/ib gets."""

import unittest

from error_case import BadInput
from lammps_case import SHEAR, scene

FLUID = SHEAR["fluid"]
PERIODIC = {"boundary": "boundary p p p"}
FREE = FLUID.split(" wall")[0]
UNSTEADY = FLUID.replace("inertia none", "inertia unsteady")
NO_CELLS = {"cells": None, "membrane": None, "ib": None}

# A script that goes wrong before the first step, and words of its message.
# Lines of the scene are replaced; "last" comes before `run`.

FLUID_ERRORS = {
    "triclinic box": (dict(box="region box prism 0 12 0 12 0 12 2 0 0", **NO_CELLS),
                      ["rbc/fluid", "orthogonal"]),
    "x not periodic": (dict(boundary="boundary f p f", **NO_CELLS), ["rbc/fluid", "periodic", "x and y"]),
    "y not periodic": (dict(boundary="boundary p f f", **NO_CELLS), ["rbc/fluid", "periodic", "x and y"]),
    "z shrinks": (dict(boundary="boundary p p s", **NO_CELLS),
                  ["rbc/fluid", "z", "periodic or fixed", "p p p, or p p f between plates"]),
    "x shrinks": (dict(boundary="boundary m p f", **NO_CELLS),
                  ["rbc/fluid", "periodic", "x and y", "p p p, or p p f between plates"]),
    "two dimensions": (dict(boundary="boundary p p p", box="dimension 2\nregion box block 0 12 0 12 -0.5 0.5",
                            molecule=None, **NO_CELLS), ["rbc/fluid", "3d"]),
    "unknown keyword": (dict(fluid=FLUID + " viscocity 2"),
                        ["rbc/fluid", "keyword", "viscocity", "viscosity, density"]),
    "dx missing": (dict(fluid="fix flow all rbc/fluid dx"), ["fix rbc/fluid dx", "missing"]),
    "dx zero": (dict(fluid=FLUID.replace("dx 1.0", "dx 0")), ["rbc/fluid", "dx", "0", "> 0"]),
    "dx negative": (dict(fluid=FLUID.replace("dx 1.0", "dx -1")), ["rbc/fluid", "dx", "-1", "> 0"]),
    "dx no number": (dict(fluid=FLUID.replace("dx 1.0", "dx one")), ["one", "fix flow all rbc/fluid"]),
    "dx not a number": (dict(fluid=FLUID.replace("dx 1.0", "dx nan")), ["rbc/fluid", "dx", "nan"]),
    "dx infinite": (dict(fluid=FLUID.replace("dx 1.0", "dx inf")), ["rbc/fluid dx value 'inf' must be a finite"]),
    "dx beyond all numbers": (dict(fluid=FLUID.replace("dx 1.0", "dx 1e999")),
                              ["rbc/fluid dx value '1e999' must be a finite number"]),
    "viscosity not a number": (dict(fluid=FLUID.replace("1.5", "nan")),
                               ["rbc/fluid viscosity value 'nan' must be a finite number"]),
    "dx too large": (dict(fluid=FLUID.replace("dx 1.0", "dx 4")), ["rbc/fluid", "dx 4", "3 cells in x", "at least 4",
                                                                  "at most 3"]),
    "dx too small": (dict(fluid=FLUID.replace("dx 1.0", "dx 1e-9")),
                     ["rbc/fluid", "dx 1e-09", "9.9e+27 cells", "at most 5.37e+08"]),
    "dx far too small": (dict(fluid=FLUID.replace("dx 1.0", "dx 1e-300")),
                         ["rbc/fluid", "dx 1e-300", "cells", "at most 5.37e+08"]),
    "grid too small": (dict(fluid=FLUID.replace("dx 1.0", "grid 12 3 12")), ["rbc/fluid", "grid", "3", "at least 4"]),
    "grid too large": (dict(fluid=FLUID.replace("dx 1.0", "grid 12 12 2000000000")),
                       ["rbc/fluid", "grid 12 12 2000000000", "2.88e+11 cells", "at most"]),
    "grid missing": (dict(fluid="fix flow all rbc/fluid grid 12 12"), ["fix rbc/fluid grid", "missing"]),
    "grid no integer": (dict(fluid=FLUID.replace("dx 1.0", "grid 12 12 7.5")),
                        ["rbc/fluid grid value '7.5' must be an integer at least 4"]),
    "grid beyond all integers": (dict(fluid=FLUID.replace("dx 1.0", "grid 12 12 4294967308")),
                                 ["rbc/fluid grid value 4294967308 must be between 4 and 2147483647"]),
    "grid and dx": (dict(fluid=FLUID + " grid 12 12 12"), ["rbc/fluid", "either dx or grid"]),
    "neither grid nor dx": (dict(fluid=FLUID.replace("dx 1.0", "")), ["rbc/fluid", "needs dx or grid"]),
    "viscosity missing": (dict(fluid=FLUID.replace("viscosity 1.5", "")), ["rbc/fluid", "needs viscosity"]),
    "viscosity without value": (dict(fluid=FLUID + " viscosity"), ["fix rbc/fluid viscosity", "missing"]),
    "viscosity negative": (dict(fluid=FLUID.replace("1.5", "-1.5")), ["rbc/fluid", "viscosity", "-1.5", "> 0"]),
    "density missing": (dict(fluid=UNSTEADY.replace("density 1.025", "")), ["rbc/fluid", "needs density"]),
    "density without value": (dict(fluid=FLUID + " density"), ["fix rbc/fluid density", "missing"]),
    "density zero": (dict(fluid=FLUID.replace("1.025", "0")), ["rbc/fluid", "density", "0", "> 0"]),
    "inertia without value": (dict(fluid=FLUID + " inertia"), ["fix rbc/fluid inertia", "missing"]),
    "inertia unknown": (dict(fluid=FLUID + " inertia all"),
                        ["rbc/fluid", "inertia", "all", "none, unsteady, convective"]),
    "scheme without value": (dict(fluid=FLUID + " scheme"), ["fix rbc/fluid scheme", "missing"]),
    "scheme unknown": (dict(fluid=FLUID + " scheme exact"), ["rbc/fluid", "scheme", "exact", "coupled, projection"]),
    "projection without inertia": (dict(fluid=FLUID + " scheme projection"),
                                   ["rbc/fluid", "scheme projection", "inertia unsteady or convective"]),
    "mean between plates": (dict(fluid=FLUID + " mean 0.001 0 0"), ["rbc/fluid", "mean", "triply periodic"]),
    "mean force between plates": (dict(fluid=FLUID + " inertia unsteady mean force"),
                                  ["rbc/fluid", "mean", "triply periodic"]),
    "mean force without inertia": (dict(PERIODIC, fluid=FREE + " mean force"),
                                   ["rbc/fluid", "mean force", "inertia unsteady or convective"]),
    "mean without value": (dict(PERIODIC, fluid=FREE + " mean"), ["fix rbc/fluid mean", "missing"]),
    "mean too short": (dict(PERIODIC, fluid=FREE + " mean 0 0"), ["fix rbc/fluid mean", "missing"]),
    "mean no number": (dict(PERIODIC, fluid=FREE + " mean 0 0 fast"), ["'fast'", "rbc/fluid"]),
    "mean not a number": (dict(PERIODIC, fluid=FREE + " mean nan 0 0"), ["rbc/fluid", "mean", "nan"]),
    "mean by a missing variable": (dict(PERIODIC, fluid=FREE + " mean 0 v_U 0"),
                                   ["Variable U", "rbc/fluid", "does not exist"]),
    "mean by forces and held": (dict(PERIODIC, fluid=FREE.replace("none", "unsteady") + " mean force mean 0 0 0"),
                                ["rbc/fluid", "either mean force or mean vx vy vz"]),
    "mean held and by forces": (dict(PERIODIC, fluid=FREE.replace("none", "unsteady") + " mean 0 0 0 mean force"),
                                ["rbc/fluid", "either mean force or mean vx vy vz"]),
    "mean along two directions": (dict(PERIODIC, fluid=FREE + " mean x 0.001 mean y 0.001"),
                                  ["rbc/fluid mean y", "after mean x", "only one direction"]),
    "mean along a direction without value": (dict(PERIODIC, fluid=FREE + " mean x"), ["fix rbc/fluid mean", "missing"]),
    "wall side unknown": (dict(fluid=FLUID + " wall xlo 0 0 0"), ["rbc/fluid", "wall", "xlo", "zlo or zhi"]),
    "wall without side": (dict(fluid=FLUID + " wall"), ["fix rbc/fluid wall", "missing"]),
    "wall without velocity": (dict(fluid=FLUID + " wall zlo 0 0"), ["fix rbc/fluid wall", "missing"]),
    "wall without condition": (dict(fluid=FLUID + " wall zlo"), ["fix rbc/fluid wall", "missing"]),
    "wall condition unknown": (dict(fluid=FLUID + " wall zlo stick 0 0"), ["rbc/fluid", "wall", "stick"]),
    "no wall that holds": (dict(fluid=FREE + " wall zlo slip wall zhi slip"),
                           ["rbc/fluid", "wall slip", "both", "inertia unsteady or convective", "mean velocity"]),
    "wall on a periodic side": (dict(boundary="boundary p p p"), ["rbc/fluid", "wall", "zlo", "periodic"]),
    "wall along z": (dict(fluid=FLUID + " wall zhi 0 0 0.1"), ["rbc/fluid", "wall", "zhi", "0.1", "must be 0"]),
    "wall along z by a variable": (dict(fluid="variable w equal 0\n" + FLUID + " wall zhi 0 0 v_w"),
                                   ["rbc/fluid", "wall", "zhi", "v_w", "must be 0"]),
    "wall velocity not a number": (dict(fluid=FLUID + " wall zhi nan 0 0"), ["rbc/fluid", "wall", "nan"]),
    "no walls": (dict(fluid=FLUID.split(" wall")[0]), ["rbc/fluid", "needs wall zlo and wall zhi"]),
    "one wall": (dict(fluid=FLUID.split(" wall zhi")[0]), ["rbc/fluid", "needs wall zlo and wall zhi"]),
    "body missing": (dict(fluid=FLUID + " body 0 0"), ["fix rbc/fluid body", "missing"]),
    "body infinite": (dict(fluid=FLUID + " body 0 -1e999 0"),
                      ["rbc/fluid body value '-1e999' must be a finite number or a variable v_name"]),
    "body no number": (dict(fluid=FLUID + " body 0 0 g"), ["'g'", "rbc/fluid"]),
    "variable missing": (dict(fluid=FLUID + " body v_g 0 0"), ["Variable g", "rbc/fluid", "does not exist"]),
    "variable of the wrong style": (dict(fluid="variable g atom x\n" + FLUID + " body v_g 0 0"),
                                    ["Variable g", "rbc/fluid", "equal-style"]),
    "two fluids": (dict(fluid=FLUID + "\n" + FLUID.replace("fix flow", "fix flow2")), ["Only one", "rbc/fluid"]),
    "changing box": (dict(last="fix deform all deform 1 x vel 0.1"), ["rbc/fluid", "changing simulation box"]),
    "box changed": (dict(last="change_box all z final 0 12.5"), ["rbc/fluid flow", "box has changed"]),
    "respa": (dict(last="run_style respa 2 2", membrane=None, ib=None, thermo=None), ["rbc/fluid", "respa"]),
    "before the box": (dict(box=FLUID), ["fix", "before simulation box"]),
    "velocity of a grid unknown": (dict(last="dump g all grid 1 g.txt f_flow:grid:vorticity[1]"),
                                   ["flow", "vorticity"]),
}

DIRECT = SHEAR["ib"] + " scheme direct"

IB_ERRORS = {
    "no fluid": (dict(fluid=None, thermo=None), ["rbc/ib", "no fix rbc/fluid", "flow"]),
    "fluid of another style": (dict(ib="fix ib all rbc/ib mem"), ["rbc/ib", "no fix rbc/fluid", "mem"]),
    "no arguments": (dict(ib="fix ib all rbc/ib"), ["fix rbc/ib", "missing"]),
    "unknown keyword": (dict(ib="fix ib all rbc/ib flow kernels roma3"), ["rbc/ib", "kernels", "kernel, "]),
    "keyword without value": (dict(ib="fix ib all rbc/ib flow kernel"), ["fix rbc/ib kernel", "missing"]),
    "unknown kernel": (dict(ib="fix ib all rbc/ib flow kernel roma4"), ["rbc/ib", "kernel", "roma4", "roma3"]),
    "unknown integrator": (dict(ib="fix ib all rbc/ib flow integrator verlet"),
                           ["rbc/ib", "integrator", "verlet", "midpoint"]),
    "gaps of points": (dict(ib=SHEAR["ib"] + " sheets no gaps yes"), ["gaps yes needs sheets yes"]),
    "unknown scheme": (dict(ib="fix ib all rbc/ib flow scheme plastic"), ["rbc/ib", "scheme", "plastic", "elastic"]),
    "direct without inertia": (dict(ib=DIRECT), ["rbc/ib ib", "scheme direct", "inertia unsteady or convective"]),
    "direct without inertia, integrator by default": (dict(ib="fix ib all rbc/ib flow scheme direct"),
                                                      ["rbc/ib ib", "scheme direct", "inertia unsteady or convective"]),
    "direct with projection": (dict(fluid=UNSTEADY + " scheme projection", ib=DIRECT),
                               ["rbc/ib ib", "scheme direct", "rbc/fluid flow", "scheme coupled"]),
    "direct without masses": (dict(fluid=UNSTEADY, ib=DIRECT, create_box="create_box 2 box angle/types 1"),
                              ["mass"]),
    "tol without direct": (dict(ib=SHEAR["ib"] + " tol 1e-3"), ["rbc/ib", "tol and maxiter", "scheme direct"]),
    "maxiter without direct": (dict(ib=SHEAR["ib"] + " scheme elastic maxiter 9"),
                               ["rbc/ib", "tol and maxiter", "scheme direct"]),
    "tol without value": (dict(ib=DIRECT + " tol"), ["fix rbc/ib tol", "missing"]),
    "tol zero": (dict(ib=DIRECT + " tol 0"), ["rbc/ib", "tol", "0", "between 0 and 1"]),
    "tol one": (dict(ib=DIRECT + " tol 1"), ["rbc/ib", "tol", "1", "between 0 and 1"]),
    "tol not a number": (dict(ib=DIRECT + " tol nan"), ["rbc/ib", "tol", "nan"]),
    "tol no number": (dict(ib=DIRECT + " tol small"), ["'small'", "rbc/ib"]),
    "maxiter zero": (dict(ib=DIRECT + " maxiter 0"), ["rbc/ib", "maxiter", "0", "> 0"]),
    "maxiter no integer": (dict(ib=DIRECT + " maxiter 1.5"), ["rbc/ib maxiter value '1.5' must be an integer > 0"]),
    "maxiter without value": (dict(ib=DIRECT + " maxiter"), ["fix rbc/ib maxiter", "missing"]),
    "maxiter beyond all integers": (dict(ib=DIRECT + " maxiter 4294967306"),
                                    ["rbc/ib maxiter value 4294967306 must be between 1 and 2147483647"]),
    "order without value": (dict(ib=SHEAR["ib"] + " order"), ["fix rbc/ib order", "missing"]),
    "rkc without stages": (dict(ib="fix ib all rbc/ib flow integrator rkc"), ["fix rbc/ib integrator rkc", "missing"]),
    "rkc of too many stages": (dict(ib="fix ib all rbc/ib flow integrator rkc 10001"),
                               ["rbc/ib", "rkc", "10001", "auto or from 2 to 10000"]),
    "courant of more than half the box": (dict(ib=SHEAR["ib"] + " courant 6.1"),
                                          ["rbc/ib ib", "courant", "6.1", "<= 6", "rbc/fluid flow"]),
    "rkc of one stage": (dict(ib="fix ib all rbc/ib flow integrator rkc 1"), ["rbc/ib", "rkc", "1", "auto or from 2 to 10000"]),
    "rkc of many": (dict(ib="fix ib all rbc/ib flow integrator rkc many"), ["many", "auto or from 2 to 10000"]),
    "order four": (dict(ib="fix ib all rbc/ib flow integrator rkc 5 order 4"), ["rbc/ib", "order", "4", "2 or 3"]),
    "order of midpoint": (dict(ib=SHEAR["ib"] + " order 3"), ["rbc/ib", "order 3", "integrator rkc"]),
    "courant zero": (dict(ib=SHEAR["ib"] + " courant 0"), ["rbc/ib", "courant", "0", "> 0"]),
    "courant not a number": (dict(ib=SHEAR["ib"] + " courant nan"),
                             ["rbc/ib courant value 'nan' must be a finite number"]),
    "courant without value": (dict(ib=SHEAR["ib"] + " courant"), ["fix rbc/ib courant", "missing"]),
    "sheets maybe": (dict(ib=SHEAR["ib"] + " sheets maybe"), ["maybe", "boolean"]),
    "sheets with masses": (dict(fluid=UNSTEADY, ib=DIRECT + " sheets yes"), ["rbc/ib", "sheets yes", "scheme elastic"]),
    "adapt with one value": (dict(ib=SHEAR["ib"] + " adapt 1e-4"), ["fix rbc/ib adapt", "missing"]),
    "adapt to any error": (dict(ib=SHEAR["ib"] + " adapt 1e999 10"),
                           ["rbc/ib adapt error value '1e999' must be a finite number"]),
    "adapt up to infinity": (dict(ib=SHEAR["ib"] + " adapt 1e-4 inf"),
                             ["rbc/ib adapt largest timestep value 'inf' must be a finite number"]),
    "adapt to zero": (dict(ib=SHEAR["ib"] + " adapt 0 100"), ["rbc/ib", "adapt error", "0", "> 0"]),
    "adapt up to zero": (dict(ib=SHEAR["ib"] + " adapt 1e-4 0"), ["rbc/ib", "adapt largest timestep", "0", "> 0"]),
    "adapt with inertia": (dict(fluid=UNSTEADY, ib=SHEAR["ib"] + " adapt 1e-4 100"),
                           ["rbc/ib ib", "adapt", "rbc/fluid flow", "inertia none"]),
    "rkc with inertia": (dict(fluid=UNSTEADY, ib="fix ib all rbc/ib flow integrator rkc 4"),
                         ["rbc/ib ib", "rbc/fluid flow", "inertia", "euler or midpoint"]),
    "ab2 with inertia": (dict(fluid=UNSTEADY, ib="fix ib all rbc/ib flow integrator ab2"),
                         ["rbc/ib ib", "rbc/fluid flow", "inertia", "euler or midpoint"]),
    "viscous membrane with inertia": (dict(fluid=UNSTEADY, membrane=SHEAR["membrane"] + " viscosity 1"),
                                      ["rbc/ib ib", "viscosity", "rbc/fluid flow", "inertia none"]),
    "before the membrane": (dict(membrane=FLUID + "\n" + SHEAR["ib"], fluid=SHEAR["membrane"], ib=None),
                            ["rbc/ib", "ib", "after fix rbc/membrane mem"]),
    "minimize": (dict(run="minimize 0 1e-6 10 10", membrane=None, thermo=None), ["rbc/ib", "minimize"]),
    "does not move a whole viscous cell": (
        dict(before="group most id 2:162", ib="fix ib most rbc/ib flow",
             membrane=SHEAR["membrane"].replace("volume yes", "volume no viscosity 1")),
        ["rbc/ib ib", "rbc/membrane mem", "viscosity"]),
    "does not move a whole cell": (dict(before="group most id 2:162", ib="fix ib most rbc/ib flow"),
                                   ["rbc/ib ib", "does not move all atoms", "rbc/membrane mem"]),
    "two on one fluid": (dict(last="fix ib2 all rbc/ib flow"), ["rbc/ib", "ib2", "flow", "both"]),
    "respa": (dict(last="run_style respa 2 2", membrane=None, fluid=None, ib=SHEAR["ib"] + "\n" + FLUID, thermo=None),
              ["rbc/ib", "respa"]),
    "ghost cutoff too short": (dict(last="comm_modify cutoff 1.05", run="run 0"),
                               ["ghost cutoff", "comm_modify cutoff"]),
}


class Fluid(BadInput):
    def test_fluid(self):
        self.check(FLUID_ERRORS)

    def test_ib(self):
        self.check({name: case for name, case in IB_ERRORS.items() if "cutoff" not in name})

    def test_ghost_cutoff_too_short(self):
        name = "ghost cutoff too short"
        self.check({name: IB_ERRORS[name]}, ranks=2)

    def test_restart_of_another_flow(self):
        later = {"units": None, "style": "read_restart r", "boundary": None, "box": None, "create_box": None,
                 "cells": None}
        table = {}
        for name, change in (("grid", ("dx 1.0", "dx 0.75")), ("inertia", ("unsteady", "convective")),
                             ("scheme", ("wall zlo", "scheme projection wall zlo")),
                             ("plates", ("wall zlo 0 0 0", "wall zlo slip"))):
            again = scene(**{**later, "fluid": UNSTEADY.replace(*change), "run": "run 0"})
            table[name] = (dict(fluid=UNSTEADY, run="run 0\nwrite_restart r\nclear\n" + again),
                           ["rbc/fluid flow", "restart file", "grid of 12 12 12", "other plates", "another inertia or scheme",
                            "another fix ID"])
        self.check(table, ranks=2)


if __name__ == "__main__":
    unittest.main()
