"""What bad input gets: an error before the first step that names style, keyword, value and what is allowed; and
during a run the step, the cell and its position."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, SHEAR, attempt, dump_line, in_parallel, read_template, scene

FLUID = SHEAR["fluid"]
MEMBRANE = "fix mem all rbc/membrane rbc "
CREATE = "rbc/create rbc "
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
    "z shrinks": (dict(boundary="boundary p p s", **NO_CELLS), ["rbc/fluid", "z", "periodic or fixed"]),
    "two dimensions": (dict(boundary="boundary p p p", box="dimension 2\nregion box block 0 12 0 12 -0.5 0.5",
                            molecule=None, **NO_CELLS), ["rbc/fluid", "3d"]),
    "unknown keyword": (dict(fluid=FLUID + " viscocity 2"),
                        ["rbc/fluid", "keyword", "viscocity", "viscosity, density"]),
    "dx missing": (dict(fluid="fix flow all rbc/fluid dx"), ["fix rbc/fluid dx", "missing"]),
    "dx zero": (dict(fluid=FLUID.replace("dx 1.0", "dx 0")), ["rbc/fluid", "dx", "0", "> 0"]),
    "dx negative": (dict(fluid=FLUID.replace("dx 1.0", "dx -1")), ["rbc/fluid", "dx", "-1", "> 0"]),
    "dx no number": (dict(fluid=FLUID.replace("dx 1.0", "dx one")), ["one", "fix flow all rbc/fluid"]),
    "dx not a number": (dict(fluid=FLUID.replace("dx 1.0", "dx nan")), ["rbc/fluid", "dx", "nan"]),
    "dx infinite": (dict(fluid=FLUID.replace("dx 1.0", "dx inf")), ["rbc/fluid", "dx", "inf"]),
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
    "grid no integer": (dict(fluid=FLUID.replace("dx 1.0", "grid 12 12 7.5")), ["7.5", "integer"]),
    "grid and dx": (dict(fluid=FLUID + " grid 12 12 12"), ["rbc/fluid", "either dx or grid"]),
    "neither grid nor dx": (dict(fluid=FLUID.replace("dx 1.0", "")), ["rbc/fluid", "needs dx or grid"]),
    "viscosity missing": (dict(fluid=FLUID.replace("viscosity 1.5", "")), ["rbc/fluid", "needs viscosity"]),
    "viscosity without value": (dict(fluid=FLUID + " viscosity"), ["fix rbc/fluid viscosity", "missing"]),
    "viscosity negative": (dict(fluid=FLUID.replace("1.5", "-1.5")), ["rbc/fluid", "viscosity", "-1.5", "> 0"]),
    "density missing": (dict(fluid=FLUID.replace("density 1.025", "")), ["rbc/fluid", "needs density"]),
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
    "wall side unknown": (dict(fluid=FLUID + " wall xlo 0 0 0"), ["rbc/fluid", "wall", "xlo", "zlo or zhi"]),
    "wall without side": (dict(fluid=FLUID + " wall"), ["fix rbc/fluid wall", "missing"]),
    "wall without velocity": (dict(fluid=FLUID + " wall zlo 0 0"), ["fix rbc/fluid wall", "missing"]),
    "wall on a periodic side": (dict(boundary="boundary p p p"), ["rbc/fluid", "wall", "zlo", "periodic"]),
    "wall along z": (dict(fluid=FLUID + " wall zhi 0 0 0.1"), ["rbc/fluid", "wall", "zhi", "0.1", "must be 0"]),
    "wall along z by a variable": (dict(fluid="variable w equal 0\n" + FLUID + " wall zhi 0 0 v_w"),
                                   ["rbc/fluid", "wall", "zhi", "v_w", "must be 0"]),
    "wall velocity not a number": (dict(fluid=FLUID + " wall zhi nan 0 0"), ["rbc/fluid", "wall", "nan"]),
    "no walls": (dict(fluid=FLUID.split(" wall")[0]), ["rbc/fluid", "needs wall zlo and wall zhi"]),
    "one wall": (dict(fluid=FLUID.split(" wall zhi")[0]), ["rbc/fluid", "needs wall zlo and wall zhi"]),
    "body missing": (dict(fluid=FLUID + " body 0 0"), ["fix rbc/fluid body", "missing"]),
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
    "unknown scheme": (dict(ib="fix ib all rbc/ib flow scheme plastic"), ["rbc/ib", "scheme", "plastic", "elastic"]),
    "direct without inertia": (dict(ib=DIRECT), ["rbc/ib ib", "scheme direct", "inertia unsteady or convective"]),
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
    "maxiter no integer": (dict(ib=DIRECT + " maxiter 1.5"), ["1.5", "integer"]),
    "rkc without stages": (dict(ib="fix ib all rbc/ib flow integrator rkc"), ["fix rbc/ib integrator rkc", "missing"]),
    "rkc of too many stages": (dict(ib="fix ib all rbc/ib flow integrator rkc 10001"),
                               ["rbc/ib", "rkc", "10001", "auto or from 2 to 10000"]),
    "courant of more than half the box": (dict(ib=SHEAR["ib"] + " courant 6.1"),
                                          ["rbc/ib ib", "courant", "6.1", "<= 6", "rbc/fluid flow"]),
    "rkc of one stage": (dict(ib="fix ib all rbc/ib flow integrator rkc 1"), ["rbc/ib", "rkc", "1", "auto or from 2 to 10000"]),
    "rkc of many": (dict(ib="fix ib all rbc/ib flow integrator rkc many"), ["many", "integer"]),
    "order four": (dict(ib="fix ib all rbc/ib flow integrator rkc 5 order 4"), ["rbc/ib", "order", "4", "2 or 3"]),
    "order of midpoint": (dict(ib=SHEAR["ib"] + " order 3"), ["rbc/ib", "order 3", "integrator rkc"]),
    "courant zero": (dict(ib=SHEAR["ib"] + " courant 0"), ["rbc/ib", "courant", "0", "> 0"]),
    "courant without value": (dict(ib=SHEAR["ib"] + " courant"), ["fix rbc/ib courant", "missing"]),
    "sheets maybe": (dict(ib=SHEAR["ib"] + " sheets maybe"), ["maybe", "boolean"]),
    "sheets with masses": (dict(fluid=UNSTEADY, ib=DIRECT + " sheets yes"), ["rbc/ib", "sheets yes", "scheme elastic"]),
    "adapt with one value": (dict(ib=SHEAR["ib"] + " adapt 1e-4"), ["fix rbc/ib adapt", "missing"]),
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

MEMBRANE_ERRORS = {
    "no arguments": (dict(membrane="fix mem all rbc/membrane"), ["fix rbc/membrane", "missing"]),
    "no law": (dict(membrane=MEMBRANE), ["fix rbc/membrane", "missing"]),
    "unknown law": (dict(membrane=MEMBRANE + "hooke 1"), ["rbc/membrane", "law", "hooke", "skalak"]),
    "no such template": (dict(membrane="fix mem all rbc/membrane rb skalak 1 1"), ["Molecule template", "rb ",
                                                                                  "rbc/membrane", "does not exist"]),
    "mooney-rivlin too short": (dict(membrane=MEMBRANE + "mooney-rivlin 1 1"), ["rbc/membrane mooney-rivlin",
                                                                              "missing"]),
    "C1 negative": (dict(membrane=MEMBRANE + "mooney-rivlin -1 1 1"), ["mooney-rivlin C1", "-1", ">"]),
    "C1 zero": (dict(membrane=MEMBRANE + "mooney-rivlin 0 1 1"), ["mooney-rivlin C1", "0", "> 0"]),
    "C2 negative": (dict(membrane=MEMBRANE + "mooney-rivlin 1 -1 1"), ["mooney-rivlin C2", "-1", ">= 0"]),
    "h negative": (dict(membrane=MEMBRANE + "mooney-rivlin 1 1 -1"), ["mooney-rivlin h", "-1", ">"]),
    "C1 not a number": (dict(membrane=MEMBRANE + "mooney-rivlin nan 1 1"), ["rbc/membrane", "mooney-rivlin", "nan"]),
    "C1 no number": (dict(membrane=MEMBRANE + "mooney-rivlin one 1 1"), ["'one'", "rbc/membrane"]),
    "neo-hookean too short": (dict(membrane=MEMBRANE + "neo-hookean"), ["rbc/membrane neo-hookean", "missing"]),
    "neo-hookean zero": (dict(membrane=MEMBRANE + "neo-hookean 0"), ["neo-hookean Gs", "0", "> 0"]),
    "neo-hookean negative": (dict(membrane=MEMBRANE + "neo-hookean -2"), ["neo-hookean Gs", "-2", ">"]),
    "skalak too short": (dict(membrane=MEMBRANE + "skalak 1"), ["rbc/membrane skalak", "missing"]),
    "skalak Gs": (dict(membrane=MEMBRANE + "skalak 0 1"), ["skalak Gs", "0", "> 0"]),
    "skalak C": (dict(membrane=MEMBRANE + "skalak 1 -1"), ["skalak C", "-1", ">= 0"]),
    "bending missing": (dict(membrane=MEMBRANE + "neo-hookean 1 bending"), ["rbc/membrane bending", "missing"]),
    "bending negative": (dict(membrane=MEMBRANE + "neo-hookean 1 bending -1"), ["bending", "-1", ">= 0"]),
    "bending with two curvatures": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 0.5 dihedral reference"),
                                    ["rbc/membrane bending", "reference", "one of reference or c0"]),
    "bending of two forms": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 helfrich dihedral"),
                             ["rbc/membrane bending", "dihedral", "one of helfrich or dihedral"]),
    "bending of an unknown form": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 hinge"),
                                   ["rbc/membrane", "keyword", "hinge", "bending, area, volume"]),
    "crease missing": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 crease 1"),
                       ["rbc/membrane crease", "missing"]),
    "crease negative": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 crease -1 45"), ["crease k", "-1", ">= 0"]),
    "crease angle": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 crease 1 180"),
                     ["crease angle", "180", "below 180 degrees"]),
    "crease without bending": (dict(membrane=MEMBRANE + "neo-hookean 1 crease 1 45"), ["crease", "bending modulus > 0"]),
    "stretch missing": (dict(membrane=MEMBRANE + "neo-hookean 1 stretch 1"), ["rbc/membrane stretch", "missing"]),
    "stretch negative": (dict(membrane=MEMBRANE + "neo-hookean 1 stretch -1 2"), ["stretch k", "-1", ">= 0"]),
    "stretch of less than 1": (dict(membrane=MEMBRANE + "neo-hookean 1 stretch 1 0.9"),
                               ["stretch lambda", "0.9", "above 1"]),
    "area missing": (dict(membrane=MEMBRANE + "neo-hookean 1 area 1"), ["rbc/membrane area", "missing"]),
    "area global": (dict(membrane=MEMBRANE + "neo-hookean 1 area -1 1"), ["area kglobal", "-1", ">= 0"]),
    "area local": (dict(membrane=MEMBRANE + "neo-hookean 1 area 1 -1"), ["area klocal", "-1", ">= 0"]),
    "volume missing": (dict(membrane=MEMBRANE + "neo-hookean 1 volume"), ["rbc/membrane volume", "missing"]),
    "volume negative": (dict(membrane=MEMBRANE + "neo-hookean 1 volume -1"), ["volume", "-1", ">= 0"]),
    "volume neither": (dict(membrane=MEMBRANE + "neo-hookean 1 volume maybe"), ["volume", "maybe", "yes, no"]),
    "unknown keyword": (dict(membrane=MEMBRANE + "neo-hookean 1 bend 1"), ["rbc/membrane", "keyword", "bend",
                                                                          "bending, area, volume, swell"]),
    "swell missing": (dict(membrane=MEMBRANE + "neo-hookean 1 swell"), ["rbc/membrane swell", "missing"]),
    "swell negative": (dict(membrane=MEMBRANE + "neo-hookean 1 swell -1"), ["swell", "-1", ">"]),
    "swell zero": (dict(membrane=MEMBRANE + "neo-hookean 1 swell 0"), ["swell", "0", "> 0"]),
    "swell not a number": (dict(membrane=MEMBRANE + "neo-hookean 1 swell much"), ["much", "rbc/membrane"]),
    "viscosity without value": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity"),
                                ["fix rbc/membrane viscosity", "missing"]),
    "viscosity negative": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity -1"), ["rbc/membrane viscosity", "-1", ">= 0"]),
    "thinning without rate": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning 1"),
                              ["fix rbc/membrane viscosity thinning", "missing"]),
    "thinning to less than nothing": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning -1 1"),
                                      ["viscosity thinning eta_inf", "-1", ">= 0"]),
    "thickening": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning 2.5 1"),
                   ["viscosity thinning eta_inf", "2.5", "<= eta_m, 2"]),
    "thinning at no rate": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning 1 0"),
                            ["viscosity thinning rate", "0", "> 0"]),
    "thinning of no viscosity": (dict(membrane=MEMBRANE + "neo-hookean 1 thinning 1 1"),
                                 ["rbc/membrane", "keyword", "thinning", "viscosity"]),
    "swell of nothing": (dict(membrane=MEMBRANE + "neo-hookean 1 volume no swell 1.1"),
                         ["rbc/membrane swell", "volume yes", "modulus"]),
    "swell variable unknown": (dict(membrane=MEMBRANE + "neo-hookean 1 swell v_no"), ["rbc/membrane swell", "no ",
                                                                                     "does not exist"]),
    "swell variable of atoms": (dict(before="variable f atom x", membrane=MEMBRANE + "neo-hookean 1 swell v_f"),
                                ["rbc/membrane swell", "equal-style"]),
    "swell variable zero": (dict(before="variable f equal 0", membrane=MEMBRANE + "neo-hookean 1 swell v_f"),
                            ["rbc/membrane mem", "swell is 0 at step 0", "> 0"]),
    "stress-free missing": (dict(membrane=MEMBRANE + "neo-hookean 1 stress-free"), ["rbc/membrane stress-free",
                                                                                  "missing"]),
    "stress-free unknown": (dict(membrane=MEMBRANE + "neo-hookean 1 stress-free ball"),
                            ["Molecule template", "ball", "rbc/membrane stress-free", "does not exist"]),
    "stress-free of another size": (
        dict(before=f"molecule ball {POTENTIALS}/capsule_362.mol",
             membrane=MEMBRANE + "neo-hookean 1 stress-free ball"),
        ["Molecule template ball", "rbc/membrane stress-free", "triangles of rbc", "362 vertices, not 162"]),
    "stress-free with other triangles": (
        dict(before=f"molecule ball {POTENTIALS}/capsule_162.mol",
             membrane=MEMBRANE + "neo-hookean 1 stress-free ball"),
        ["Molecule template ball", "rbc/membrane stress-free", "triangles of rbc", "its triangle", "in place of"]),
    "triclinic": (dict(last="change_box all triclinic", fluid=None, ib=None, thermo=None),
                  ["rbc/membrane", "orthogonal"]),
    "minimize": (dict(run="minimize 0 1e-6 10 10", fluid=None, ib=None, thermo=None), ["rbc/membrane", "minimize"]),
    "two on the same atoms": (dict(last=SHEAR["membrane"].replace("fix mem", "fix two"), fluid=None, ib=None,
                                   thermo=None),
                              ["rbc/membrane mem and two", "share atoms"]),
    "respa": (dict(last="run_style respa 2 2", fluid=None, ib=None, thermo=None), ["rbc/membrane", "respa"]),
    "cell broken by a group": (dict(before="group half id 1:100", membrane=SHEAR["membrane"].replace("all", "half")),
                               ["rbc/membrane mem", "molecule ID 1", "100", "162"]),
    "cell broken by delete_atoms": (dict(before="group few id 7 9\ndelete_atoms group few compress no"),
                                    ["rbc/membrane mem", "molecule ID 1", "160", "162"]),
    "cell broken by delete_atoms after a run": (
        dict(last="run 0\ngroup few id 7 9\ndelete_atoms group few compress no"),
        ["rbc/membrane mem", "molecule ID 1", "160", "162"]),
    "atom of no molecule": (dict(before="create_atoms 1 single 1 1 1"), ["rbc/membrane mem", "1 atoms", "no molecule"]),
    "atoms of another kind": (dict(before="molecule small " + str(POTENTIALS / "capsule_362.mol") +
                                   "\nchange_box all x final 0 30 boundary p p f\nrbc/create small single 20 6 6"),
                              ["rbc/membrane mem", "molecule ID 2", "362", "162"]),
    "IDs not consecutive": (dict(before="change_box all x final 0 30\nrbc/create rbc single 20 6 6\n"
                                 "set atom 162 mol 2\nset atom 163 mol 1"),
                            ["rbc/membrane mem", "molecule ID 1", "consecutive", "1 to 163"]),
    "no molecule IDs": (dict(style="atom_style atomic", create_box="create_box 1 box", molecule=None, cells=None,
                             membrane="molecule rbc " + str(POTENTIALS / "rbc_162.mol") + "\n" + SHEAR["membrane"]),
                        ["olecule"]),
    "no atom map": (dict(style="atom_style molecular\natom_modify id no", cells="mass 1 1"),
                    ["requires", "atom", "ID"]),
}

CELL_ERRORS = {
    "argument": (dict(compute="compute c all rbc/cell volume"), ["compute rbc/cell", "volume", "none"]),
    "no membrane": (dict(membrane=None, compute="compute c all rbc/cell",
                         thermo="thermo_style custom step c_c[1][1]"), ["rbc/cell c", "needs a fix rbc/membrane"]),
    "row that is not there": (dict(compute="compute c all rbc/cell", thermo="thermo_style custom step c_c[2][1]"),
                              ["compute array", "out-of-range"]),
}

AGGREGATE = "compute a all rbc/aggregate "
AGGREGATE_ERRORS = {
    "no gap": (dict(compute=AGGREGATE), ["compute rbc/aggregate", "missing"]),
    "gap no number": (dict(compute=AGGREGATE + "near"), ["near", "rbc/aggregate"]),
    "gap zero": (dict(compute=AGGREGATE + "0"), ["rbc/aggregate", "gap 0", "> 0"]),
    "gap negative": (dict(compute=AGGREGATE + "-0.2"), ["rbc/aggregate", "gap -0.2", "> 0"]),
    "gap not a number": (dict(compute=AGGREGATE + "nan"), ["rbc/aggregate", "nan"]),
    "gap infinite": (dict(compute=AGGREGATE + "inf"), ["rbc/aggregate", "inf"]),
    "unknown keyword": (dict(compute=AGGREGATE + "0.2 volume 0.1"), ["rbc/aggregate", "keyword", "volume", "area"]),
    "area missing": (dict(compute=AGGREGATE + "0.2 area"), ["compute rbc/aggregate area", "missing"]),
    "area zero": (dict(compute=AGGREGATE + "0.2 area 0"), ["rbc/aggregate", "area 0", "above 0", "at most 1"]),
    "area percent": (dict(compute=AGGREGATE + "0.2 area 10"), ["rbc/aggregate", "area 10", "above 0", "at most 1"]),
    "area not a number": (dict(compute=AGGREGATE + "0.2 area nan"), ["rbc/aggregate", "area", "nan"]),
    "no membrane": (dict(membrane=None, compute=AGGREGATE + "0.2", thermo="thermo_style custom step c_a[1]"),
                    ["rbc/aggregate a", "needs a fix rbc/membrane"]),
    "triclinic": (dict(last="change_box all triclinic", fluid=None, ib=None, membrane=None, thermo=None,
                       compute=AGGREGATE + "0.2"), ["rbc/aggregate a", "orthogonal"]),
    "ghost cutoff too short": (dict(compute=AGGREGATE + "0.2", before="comm_modify cutoff 2.5", ib=None, fluid=None,
                                    thermo=None),
                               ["rbc/aggregate a", "ghost cutoff 2.5", "0.2", "comm_modify cutoff"]),
    "too few rows": (dict(compute=AGGREGATE + "0.2", thermo="thermo_style custom step c_a[2][1]"),
                     ["compute array", "out-of-range"]),
}

CREATE_ERRORS = {
    "before the box": (dict(box=CREATE + "single 6 6 6", molecule=None, cells=None),
                       ["rbc/create", "after the simulation box"]),
    "no molecule IDs": (dict(style="atom_style atomic", create_box="create_box 1 box", molecule=None),
                        ["rbc/create", "molecule IDs", "atom_style molecular"]),
    "triclinic": (dict(box="region box prism 0 12 0 12 0 12 2 0 0"), ["rbc/create", "orthogonal"]),
    "no arguments": (dict(cells="rbc/create rbc"), ["rbc/create", "missing"]),
    "no such template": (dict(cells="rbc/create white single 6 6 6"), ["Molecule template", "white", "rbc/create",
                                                                    "does not exist"]),
    "no placement": (dict(cells=CREATE + "seed 1"), ["rbc/create", "needs one of single, number and hematocrit"]),
    "two placements": (dict(cells=CREATE + "single 6 6 6 number 4 seed 1"), ["rbc/create", "only one of"]),
    "single missing": (dict(cells=CREATE + "single 6 6"), ["rbc/create single", "missing"]),
    "single no number": (dict(cells=CREATE + "single 6 6 z"), ["'z'", "rbc/create"]),
    "single not a number": (dict(cells=CREATE + "single nan 6 6"), ["rbc/create", "single", "nan"]),
    "single outside": (dict(cells=CREATE + "single 6 6 11.9"), ["rbc/create single", "z", "outside", "12"]),
    "rotate missing": (dict(cells=CREATE + "single 6 6 6 rotate 30 1 0"), ["rbc/create rotate", "missing"]),
    "rotate without single": (dict(cells=CREATE + "rotate 30 1 0 0 number 1"), ["rbc/create rotate", "single"]),
    "rotate without axis": (dict(cells=CREATE + "single 6 6 6 rotate 30 0 0 0"),
                            ["rbc/create rotate", "axis", "0 0 0"]),
    "number missing": (dict(cells=CREATE + "seed 1 number"), ["rbc/create number", "missing"]),
    "number zero": (dict(cells=CREATE + "number 0 seed 1"), ["rbc/create number", "0", "> 0"]),
    "number no integer": (dict(cells=CREATE + "number 1.5 seed 1"), ["1.5", "integer"]),
    "hematocrit missing": (dict(cells=CREATE + "seed 1 hematocrit"), ["rbc/create hematocrit", "missing"]),
    "hematocrit zero": (dict(cells=CREATE + "hematocrit 0 seed 1"), ["hematocrit", "0", "between 0 and 1"]),
    "hematocrit percent": (dict(cells=CREATE + "hematocrit 45 seed 1"), ["hematocrit", "45", "between 0 and 1"]),
    "hematocrit not a number": (dict(cells=CREATE + "hematocrit nan seed 1"), ["rbc/create", "hematocrit", "nan"]),
    "hematocrit below one cell": (dict(cells=CREATE + "hematocrit 0.001 seed 1"), ["hematocrit", "0.001",
                                                                              "less than one cell"]),
    "region missing": (dict(cells=CREATE + "number 1 seed 1 region"), ["rbc/create region", "missing"]),
    "no such region": (dict(cells=CREATE + "number 1 seed 1 region tube"), ["Region", "tube", "rbc/create",
                                                                    "does not exist"]),
    "single with region": (dict(cells=CREATE + "single 6 6 6 region box"), ["rbc/create single", "no region"]),
    "seed missing": (dict(cells=CREATE + "number 1 seed"), ["rbc/create seed", "missing"]),
    "no seed": (dict(cells=CREATE + "number 1"), ["rbc/create", "need a seed"]),
    "seed negative": (dict(cells=CREATE + "number 1 seed -5"), ["rbc/create seed", "-5", "> 0"]),
    "type missing": (dict(cells=CREATE + "number 1 seed 5 type"), ["rbc/create type", "missing"]),
    "type too large": (dict(cells=CREATE + "number 1 seed 5 type 2"), ["rbc/create type", "2", "between 1 and 1"]),
    "overlap missing": (dict(cells=CREATE + "number 1 seed 5 overlap"), ["rbc/create overlap", "missing"]),
    "overlap zero": (dict(cells=CREATE + "number 1 seed 5 overlap 0"), ["rbc/create overlap", "0", "> 0"]),
    "overlap infinite": (dict(cells=CREATE + "number 1 seed 5 overlap inf"), ["rbc/create"]),
    "attempts missing": (dict(cells=CREATE + "number 1 seed 5 attempts"), ["rbc/create attempts", "missing"]),
    "attempts zero": (dict(cells=CREATE + "number 1 seed 5 attempts 0"), ["rbc/create attempts", "0", "> 0"]),
    "mix missing": (dict(cells=CREATE + "number 1 seed 5 mix rbc 0.1"), ["rbc/create mix", "missing"]),
    "no such template in mix": (dict(cells=CREATE + "number 1 seed 5 mix white 0.1 1"),
                                ["Molecule template", "white", "rbc/create mix", "does not exist"]),
    "mix fraction zero": (dict(cells=CREATE + "number 1 seed 5 mix rbc 0 1"),
                          ["rbc/create mix fraction", "0", "between 0 and 1"]),
    "mix fraction not a number": (dict(cells=CREATE + "number 1 seed 5 mix rbc nan 1"),
                                  ["rbc/create", "mix", "nan"]),
    "mix of all": (dict(cells=CREATE + "number 9 seed 5 mix rbc 0.6 1 mix rbc 0.4 1"),
                   ["rbc/create mix fractions", "add up to less than 1", "not 1"]),
    "mix type": (dict(cells=CREATE + "number 1 seed 5 mix rbc 0.5 2"),
                 ["rbc/create type", "2", "between 1 and 1"]),
    "single with mix": (dict(cells=CREATE + "single 6 6 6 mix rbc 0.5 1"), ["rbc/create single", "no mix"]),
    "velocity missing": (dict(cells=CREATE + "number 1 seed 5 velocity"), ["rbc/create velocity", "missing"]),
    "velocity negative": (dict(cells=CREATE + "number 1 seed 5 velocity -1"), ["rbc/create velocity", "-1", ">= 0"]),
    "single with velocity": (dict(cells=CREATE + "single 6 6 6 velocity 1"), ["rbc/create single", "no velocity"]),
    "unknown keyword": (dict(cells=CREATE + "number 1 seed 5 colour red"), ["rbc/create", "keyword", "colour",
                                                                     "single, rotate"]),
    "too dense": (dict(cells=CREATE + "hematocrit 0.7 seed 5 attempts 100"),
                  ["rbc/create", "could not pack 14 cells", "100 attempts", "densest reached", "volume fraction",
                   "wanted"]),
    "region too small for a cell": (dict(cells="region small block 4 8 4 8 4 8\n" + CREATE +
                                         "number 1 seed 5 region small"), ["rbc/create", "could not pack 1 cells", "densest"]),
    "region outside": (dict(cells="region far block 40 80 40 80 40 80\n" + CREATE + "number 1 seed 5 region far"),
                       ["rbc/create", "region", "far"]),
}

# Of the octahedron below: triangles, or a change of its vertices
OCTAHEDRON = [(1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5), (3, 1, 6), (2, 3, 6), (4, 2, 6), (1, 4, 6)]
CORNERS = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]


def molecule(corners, triangles):
    lines = ["# made by test_errors.py", "", f"{len(corners)} atoms", f"{len(triangles)} angles" if triangles else "",
             "", "Coords", ""]
    lines += [f"{n} {x} {y} {z}" for n, (x, y, z) in enumerate(corners, 1)]
    lines += ["", "Types", ""] + [f"{n} 1" for n in range(1, len(corners) + 1)]
    if triangles:
        lines += ["", "Angles", ""] + [f"{n} 1 {i} {j} {k}" for n, (i, j, k) in enumerate(triangles, 1)]
    return "\n".join(lines) + "\n"


def shifted(triangles, by):
    return [tuple(v + by for v in triangle) for triangle in triangles]


TEMPLATES = {
    "open": (CORNERS, OCTAHEDRON[:-1], ["edge", "one triangle only", "not closed"]),
    "inward": (CORNERS, [(i, k, j) for i, j, k in OCTAHEDRON], ["oriented inward"]),
    "one triangle turned": (CORNERS, [(3, 1, 5)] + OCTAHEDRON[1:], ["edge", "same direction", "not consistently"]),
    "two pieces": (CORNERS + [(x + 5, y, z) for x, y, z in CORNERS], OCTAHEDRON + shifted(OCTAHEDRON, 6),
                   ["more than one piece"]),
    "unused vertex": (CORNERS + [(5, 5, 5)], OCTAHEDRON, ["vertex 7", "no triangle"]),
    "flat triangle": ([(1, 0, 0)] * 1 + [(-1, 0, 0), (1, 0, 0)] + CORNERS[3:], OCTAHEDRON, ["triangle", "no area"]),
    "pinched": (CORNERS + [(2 * x, 2 * y, 0) for x, y, _ in CORNERS[:4]],
                OCTAHEDRON + [tuple(v if v > 4 else v + 6 for v in triangle) for triangle in OCTAHEDRON],
                ["touches itself", "vertex 5"]),
    "three triangles": (CORNERS[:5], OCTAHEDRON[:3], ["at least 4 triangles"]),
    "no triangles": (CORNERS, [], ["no Angles"]),
}


def torus(n=4, m=4):
    """n by m quadrilaterals, oriented outward."""
    corners, triangles = [], []
    for i in range(n):
        for j in range(m):
            a, b = 2 * np.pi * i / n, 2 * np.pi * j / m
            corners.append(((3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)))
            p, q = (i + 1) % n, (j + 1) % m
            triangles += [(i * m + j + 1, p * m + j + 1, p * m + q + 1), (i * m + j + 1, p * m + q + 1, i * m + q + 1)]
    return corners, triangles


class BadInput(unittest.TestCase):
    def check(self, table, ranks=1, files=None):
        results = in_parallel(lambda name: attempt(scene(**table[name][0]), ranks, files=files),
                              [(name,) for name in table])
        for name, result in zip(table, results):
            with self.subTest(name):
                self.refused(result, table[name][1])

    def refused(self, result, words):
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertTrue(result.error, result.printed)
        for word in words:
            self.assertIn(word.lower(), result.error.lower(), result.printed)
        steps = [step for table in result.tables() for step in table["Step"]]
        self.assertTrue(all(step == 0 for step in steps), result.printed)

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
                             ("scheme", ("wall zlo", "scheme projection wall zlo"))):
            again = scene(**{**later, "fluid": UNSTEADY.replace(*change), "run": "run 0"})
            table[name] = (dict(fluid=UNSTEADY, run="run 0\nwrite_restart r\nclear\n" + again),
                           ["rbc/fluid flow", "restart file", "grid of 12 12 12", "another inertia or scheme",
                            "another fix ID"])
        self.check(table, ranks=2)

    def test_membrane(self):
        self.check(MEMBRANE_ERRORS)

    def test_compute_cell(self):
        self.check(CELL_ERRORS)

    def test_compute_aggregate(self):
        self.check(AGGREGATE_ERRORS)

    def test_create(self):
        self.check(CREATE_ERRORS)

    def test_create_on_two_ranks(self):
        some = ["too dense", "single outside", "unknown keyword", "hematocrit below one cell"]
        self.check({name: CREATE_ERRORS[name] for name in some}, ranks=2)

    def test_templates(self):
        cases = {**TEMPLATES, "torus": (*torus(), ["not a sphere"])}
        files = {f"{name.replace(' ', '_')}.mol": molecule(corners, triangles)
                 for name, (corners, triangles, _) in cases.items()}
        table = {}
        for name, (_, _, words) in cases.items():
            file = name.replace(" ", "_") + ".mol"
            words = words if "Angles" in words[0] else ["not a closed oriented surface", *words]
            table[name + ": fix rbc/membrane"] = (
                dict(membrane=f"molecule bad {file}\nfix mem all rbc/membrane bad neo-hookean 1"),
                ["Molecule template bad", "fix rbc/membrane", *words])
            table[name + ": rbc/create"] = (
                dict(cells=f"molecule bad {file}\nrbc/create bad single 6 6 6"),
                ["Molecule template bad", "rbc/create", *words])
        self.check(table, files=files)

    def test_template_of_a_good_octahedron_is_accepted(self):
        script = scene(molecule="molecule rbc good.mol", run="run 0")
        result = attempt(script, files={"good.mol": molecule(CORNERS, OCTAHEDRON)})
        self.assertEqual(result.code, 0, result.printed)

    def test_other_template_files(self):
        good = molecule(CORNERS, OCTAHEDRON)
        table = {
            "two molecules in one template": (dict(molecule="molecule rbc good.mol good.mol"),
                                              ["Molecule template rbc", "one molecule, not 2"]),
            "no coordinates": (dict(molecule="molecule rbc bare.mol"), ["Molecule template rbc", "no Coords"]),
        }
        bare = good[:good.index("Coords")] + good[good.index("Types"):]
        self.check(table, files={"good.mol": good, "bare.mol": bare})


def through_its_neighbours():
    """One vertex moves across the opposite edge of a triangle."""
    corners, triangles = read_template(POTENTIALS / "rbc_162.mol")
    i, j, k = triangles[0]
    move = 1.3 * ((corners[j] + corners[k]) / 2 - corners[i])
    return f"group one id {i + 1}\ndisplace_atoms one move {move[0]} {move[1]} {move[2]}"


class DuringARun(unittest.TestCase):
    """A run that must stop says where, and what it wrote before is complete."""

    def check(self, words, ranks=1, earliest=1, latest=10**9, dumped=True, files=None, **changes):
        changes.setdefault("run", "run 100")
        script = scene(dump=dump_line(2), **changes)
        result = attempt(script, ranks, files=files)
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertNotIn("Loop time", result.printed)
        for word in words:
            self.assertIn(word.lower(), result.error.lower(), result.printed)
        step = re.search(r"at step (\d+)", result.error)
        self.assertTrue(step, result.printed)
        step = int(step.group(1))
        self.assertGreaterEqual(step, earliest, result.error)
        self.assertLessEqual(step, latest, result.error)
        position = re.search(r"\(([^ ,]+), ([^ ,]+), ([^ ,]+)\)", result.error)
        self.assertTrue(position, result.printed)
        if dumped:
            dump = result.dump()
            last = step - 1 if step % 2 else step - 2    # what happens in a step comes before its output
            self.assertEqual(dump.steps, list(range(0, last + 1, 2)), result.error)
            self.assertTrue(all(frame.shape == (162, 9) for frame in dump.frames))
        return result, step, np.array([float(x) for x in position.groups()])

    def test_timestep_too_large(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, _, where = self.check(["rbc/ib ib", "CFL above 1", "timestep", "molecule ID 1", "atom ID"],
                                         ranks, earliest=0, timestep="timestep 20000", dumped=False)
                self.assertTrue(((where > -1) & (where < 13)).all())

    def test_speed_above_a_cell_per_step_later(self):
        self.check(["rbc/ib ib", "CFL above 1", "molecule ID 1"], earliest=15, latest=25,
                   fluid="variable U equal 0.0012*(1+0.25*step)\n" + SHEAR["fluid"].replace("0.0012", "v_U"))

    def test_convective_flow_too_fast(self):
        # the plate speeds up to a cell a step in step 9
        for regime, ranks in (("convective", 2), ("convective scheme projection", 1)):
            with self.subTest(regime, ranks=ranks):
                _, _, where = self.check(
                    ["rbc/fluid flow", "CFL above 1", "inertia convective"], ranks, 8, 10,
                    fluid="variable U equal 0.0006*(1+step)\n" + SHEAR["fluid"].replace(
                        "0.0012", "v_U").replace("none", regime))
                self.assertEqual(where[2], 11.5)

    def test_a_force_that_is_not_a_number(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["rbc/", "not a number", "molecule ID 1"], ranks, earliest=6, latest=7,
                           before="variable big equal ternary(step>5,1e200,0)\n"
                                  "variable f equal v_big*v_big\nfix bad all addforce v_f 0 0")

    def test_a_position_that_is_not_a_number(self):
        result = attempt(scene(last="variable bad atom 0.0/0.0\nvariable bad atom (1e200*id)*(1e200*id)*0\n"
                               "set atom 5 x v_bad", run="run 10"))
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertRegex(result.error.lower(), "not a number|non-numeric|numeric|nan")

    def test_inverted_triangle(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["rbc/membrane mem", "triangle", "inverted", "molecule ID 1"], ranks, earliest=0,
                           dumped=False, last=through_its_neighbours(), run="run 10",
                           cells="rbc/create rbc single 6 6 6")

    def test_cell_turned_inside_out(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, _, where = self.check(["rbc/membrane mem", "inside out", "molecule ID 1"], ranks, earliest=0,
                                         last="variable x atom 12-x\nset group all x v_x", dumped=False)
                np.testing.assert_allclose(where, 6, atol=0.5)

    def test_vertex_pushed_through_a_plate(self):
        # a cell that swells back to its volume right above the plate
        corners, _ = read_template(POTENTIALS / "rbc_162.mol")
        shrink = 0.98
        bottom = 0.01 - shrink * corners[:, 2].min()
        last = (f"variable x atom 6+{shrink}*(x-6)\nvariable y atom 6+{shrink}*(y-6)\n"
                f"variable z atom {bottom}+{shrink}*(z-2)\nset group all x v_x y v_y z v_z")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, _, where = self.check(["rbc/ib ib", "through a plate", "atom ID", "molecule ID 1"], ranks, latest=10,
                                         last=last, cells="rbc/create rbc single 6 6 2",
                                         membrane="fix mem all rbc/membrane rbc neo-hookean 1e-5 volume yes")
                self.assertLess(where[2], 0)

    def test_two_vertices_at_one_place(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, triangles = read_template(POTENTIALS / "rbc_162.mol")
                i, j, _ = triangles[0] + 1
                there = " ".join(f"{d} $({d}[{j}]:%.17g)" for d in "xyz")
                self.check(["rbc/membrane mem", "triangle", "inverted", "molecule ID 1"], ranks, earliest=0,
                           dumped=False, run="run 10", last=f"set atom {i} {there}")

    def test_reneighboring_too_rare(self):
        # the plate carries the cell away from where its rank looks for it
        self.check(["rbc/ib ib", "left the fluid", "neigh_modify", "molecule ID 1"], earliest=5, latest=80,
                   fluid=SHEAR["fluid"].replace("zlo 0 0 0", "zlo 0.004 0 0").replace("0.0012", "0.004"),
                   neighbor="neighbor 1.0 bin\nneigh_modify delay 1000 every 1000")

    def test_molecule_IDs_changed_within_a_run(self):
        result = attempt(scene(last="run 5\nset atom 9 mol 4", run="run 100 pre no"))
        self.assertNotEqual(result.code, 0, result.printed)
        for word in ["rbc/membrane mem", "atom 9", "molecule 4", "not there at the start"]:
            self.assertIn(word.lower(), result.error.lower())

    def test_vertex_displaced_through_a_plate(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["rbc/membrane mem", "lost 1 of 162 vertices", "molecule ID 1"], ranks, earliest=0,
                           dumped=False,
                           last="group one id 7\ndisplace_atoms one move 0 0 8")


if __name__ == "__main__":
    unittest.main()
