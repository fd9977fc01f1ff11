"""What bad input to fix rbc/membrane, rbc/create and the computes of cells gets."""

import unittest

from error_case import BadInput
from lammps_case import POTENTIALS, SHEAR

MEMBRANE = "fix mem all rbc/membrane rbc "
CREATE = "rbc/create rbc "


def printed(text):
    """Lines that write f.txt, and the begin of a command that reads it."""
    return f'print """{text}""" file f.txt\n{CREATE}'


# A script that goes wrong before the first step, and words of its message.
# Lines of the scene are replaced; "last" comes before `run`.

MEMBRANE_ERRORS = {
    "no arguments": (dict(membrane="fix mem all rbc/membrane"), ["fix rbc/membrane", "missing"]),
    "no law": (dict(membrane=MEMBRANE), ["fix rbc/membrane", "missing"]),
    "unknown law": (dict(membrane=MEMBRANE + "hooke 1"),
                    ["rbc/membrane", "law", "hooke", "skalak"]),
    "no such template": (dict(membrane="fix mem all rbc/membrane rb skalak 1 1"),
                         ["Molecule template", "rb ", "rbc/membrane", "does not exist"]),
    "mooney-rivlin too short": (dict(membrane=MEMBRANE + "mooney-rivlin 1 1"),
                                ["rbc/membrane mooney-rivlin", "missing"]),
    "C1 negative": (dict(membrane=MEMBRANE + "mooney-rivlin -1 1 1"),
                    ["mooney-rivlin C1", "-1", ">"]),
    "C1 zero": (dict(membrane=MEMBRANE + "mooney-rivlin 0 1 1"), ["mooney-rivlin C1", "0", "> 0"]),
    "C2 negative": (dict(membrane=MEMBRANE + "mooney-rivlin 1 -1 1"),
                    ["mooney-rivlin C2", "-1", ">= 0"]),
    "h negative": (dict(membrane=MEMBRANE + "mooney-rivlin 1 1 -1"),
                   ["mooney-rivlin h", "-1", ">"]),
    "C1 not a number": (dict(membrane=MEMBRANE + "mooney-rivlin nan 1 1"),
                        ["rbc/membrane", "mooney-rivlin", "nan"]),
    "C infinite": (dict(membrane=MEMBRANE + "skalak 1 1e999"),
                   ["rbc/membrane skalak C value '1e999' must be a finite"]),
    "C1 no number": (dict(membrane=MEMBRANE + "mooney-rivlin one 1 1"), ["'one'", "rbc/membrane"]),
    "neo-hookean too short": (dict(membrane=MEMBRANE + "neo-hookean"),
                              ["rbc/membrane neo-hookean", "missing"]),
    "neo-hookean zero": (dict(membrane=MEMBRANE + "neo-hookean 0"), ["neo-hookean Gs", "0", "> 0"]),
    "neo-hookean negative": (dict(membrane=MEMBRANE + "neo-hookean -2"),
                             ["neo-hookean Gs", "-2", ">"]),
    "skalak too short": (dict(membrane=MEMBRANE + "skalak 1"), ["rbc/membrane skalak", "missing"]),
    "skalak Gs": (dict(membrane=MEMBRANE + "skalak 0 1"), ["skalak Gs", "0", "> 0"]),
    "skalak C": (dict(membrane=MEMBRANE + "skalak 1 -1"), ["skalak C", "-1", ">= 0"]),
    "bending missing": (dict(membrane=MEMBRANE + "neo-hookean 1 bending"),
                        ["rbc/membrane bending", "missing"]),
    "bending negative": (dict(membrane=MEMBRANE + "neo-hookean 1 bending -1"),
                         ["bending", "-1", ">= 0"]),
    "bending with two curvatures":
        (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 0.5 dihedral reference"),
         ["rbc/membrane bending value reference is one too many", "one of reference or c0"]),
    "bending of two forms": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 helfrich dihedral"),
                             ["rbc/membrane bending", "dihedral", "one of helfrich or dihedral"]),
    "bending of an unknown form": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 hinge"),
                                   ["rbc/membrane", "keyword", "hinge", "bending, area, volume"]),
    "curvature infinite": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 1e999"),
                           ["rbc/membrane bending", "'1e999' must be a finite number"]),
    "crease missing": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 crease 1"),
                       ["rbc/membrane crease", "missing"]),
    "crease negative": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 crease -1 45"),
                        ["crease k", "-1", ">= 0"]),
    "crease angle": (dict(membrane=MEMBRANE + "neo-hookean 1 bending 1 crease 1 180"),
                     ["crease angle", "180", "below 180 degrees"]),
    "crease without bending": (dict(membrane=MEMBRANE + "neo-hookean 1 crease 1 45"),
                               ["crease", "bending modulus > 0"]),
    "stretch missing": (dict(membrane=MEMBRANE + "neo-hookean 1 stretch 1"),
                        ["rbc/membrane stretch", "missing"]),
    "stretch negative": (dict(membrane=MEMBRANE + "neo-hookean 1 stretch -1 2"),
                         ["stretch k", "-1", ">= 0"]),
    "stretch of less than 1": (dict(membrane=MEMBRANE + "neo-hookean 1 stretch 1 0.9"),
                               ["stretch lambda", "0.9", "above 1"]),
    "area missing": (dict(membrane=MEMBRANE + "neo-hookean 1 area 1"),
                     ["rbc/membrane area", "missing"]),
    "area global": (dict(membrane=MEMBRANE + "neo-hookean 1 area -1 1"),
                    ["area kglobal", "-1", ">= 0"]),
    "area local": (dict(membrane=MEMBRANE + "neo-hookean 1 area 1 -1"),
                   ["area klocal", "-1", ">= 0"]),
    "volume missing": (dict(membrane=MEMBRANE + "neo-hookean 1 volume"),
                       ["rbc/membrane volume", "missing"]),
    "volume negative": (dict(membrane=MEMBRANE + "neo-hookean 1 volume -1"),
                        ["volume", "-1", ">= 0"]),
    "volume infinite": (dict(membrane=MEMBRANE + "neo-hookean 1 volume 1e999"),
                        ["rbc/membrane volume value '1e999' must be a finite number"]),
    "volume neither": (dict(membrane=MEMBRANE + "neo-hookean 1 volume maybe"),
                       ["volume", "maybe", "yes, no"]),
    "unknown keyword": (dict(membrane=MEMBRANE + "neo-hookean 1 bend 1"),
                        ["rbc/membrane", "keyword", "bend", "bending, area, volume, swell"]),
    "swell missing": (dict(membrane=MEMBRANE + "neo-hookean 1 swell"),
                      ["rbc/membrane swell", "missing"]),
    "swell negative": (dict(membrane=MEMBRANE + "neo-hookean 1 swell -1"), ["swell", "-1", ">"]),
    "swell infinite": (dict(membrane=MEMBRANE + "neo-hookean 1 volume yes swell 1e999"),
                       ["rbc/membrane swell value '1e999' must be a finite number or a variable "
                        "v_name"]),
    "swell zero": (dict(membrane=MEMBRANE + "neo-hookean 1 swell 0"), ["swell", "0", "> 0"]),
    "swell not a number": (dict(membrane=MEMBRANE + "neo-hookean 1 swell much"),
                           ["much", "rbc/membrane"]),
    "viscosity without value": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity"),
                                ["fix rbc/membrane viscosity", "missing"]),
    "viscosity negative": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity -1"),
                           ["rbc/membrane viscosity", "-1", ">= 0"]),
    "thinning without rate": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning 1"),
                              ["fix rbc/membrane viscosity thinning", "missing"]),
    "thinning to less than nothing":
        (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning -1 1"),
         ["viscosity thinning eta_inf", "-1", ">= 0"]),
    "thickening": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning 2.5 1"),
                   ["viscosity thinning eta_inf", "2.5", "<= eta_m, 2"]),
    "thinning at no rate": (dict(membrane=MEMBRANE + "neo-hookean 1 viscosity 2 thinning 1 0"),
                            ["viscosity thinning rate", "0", "> 0"]),
    "thinning of no viscosity": (dict(membrane=MEMBRANE + "neo-hookean 1 thinning 1 1"),
                                 ["rbc/membrane", "keyword", "thinning", "viscosity"]),
    "swell of nothing": (dict(membrane=MEMBRANE + "neo-hookean 1 volume no swell 1.1"),
                         ["rbc/membrane swell", "volume yes", "modulus"]),
    "swell variable unknown": (dict(membrane=MEMBRANE + "neo-hookean 1 swell v_no"),
                               ["rbc/membrane swell", "no ", "does not exist"]),
    "swell variable of atoms": (dict(before="variable f atom x",
                                     membrane=MEMBRANE + "neo-hookean 1 swell v_f"),
                                ["rbc/membrane swell", "equal-style"]),
    "swell variable zero": (dict(before="variable f equal 0",
                                 membrane=MEMBRANE + "neo-hookean 1 swell v_f"),
                            ["rbc/membrane mem", "swell is 0 at step 0", "> 0"]),
    "stress-free missing": (dict(membrane=MEMBRANE + "neo-hookean 1 stress-free"),
                            ["rbc/membrane stress-free", "missing"]),
    "stress-free unknown": (dict(membrane=MEMBRANE + "neo-hookean 1 stress-free ball"),
                            ["Molecule template", "ball", "rbc/membrane stress-free",
                             "does not exist"]),
    "stress-free of another size": (
        dict(before=f"molecule ball {POTENTIALS}/capsule_362.mol",
             membrane=MEMBRANE + "neo-hookean 1 stress-free ball"),
        ["Molecule template ball", "rbc/membrane stress-free", "triangles of rbc",
         "362 vertices, not 162"]),
    "stress-free with other triangles": (
        dict(before=f"molecule ball {POTENTIALS}/capsule_162.mol",
             membrane=MEMBRANE + "neo-hookean 1 stress-free ball"),
        ["Molecule template ball", "rbc/membrane stress-free", "triangles of rbc", "its triangle",
         "in place of"]),
    "triclinic": (dict(last="change_box all triclinic", fluid=None, ib=None, thermo=None),
                  ["rbc/membrane", "orthogonal"]),
    "minimize": (dict(run="minimize 0 1e-6 10 10", fluid=None, ib=None, thermo=None),
                 ["rbc/membrane", "minimize"]),
    "two on the same atoms": (dict(last=SHEAR["membrane"].replace("fix mem", "fix two"), fluid=None,
                                   ib=None, thermo=None),
                              ["rbc/membrane mem and two", "share atoms"]),
    "respa": (dict(last="run_style respa 2 2", fluid=None, ib=None, thermo=None),
              ["rbc/membrane", "respa"]),
    "cell broken by a group": (dict(before="group half id 1:100",
                                    membrane=SHEAR["membrane"].replace("all", "half")),
                               ["rbc/membrane mem", "molecule ID 1", "100", "162"]),
    "cell broken by delete_atoms":
        (dict(before="group few id 7 9\ndelete_atoms group few compress no"),
         ["rbc/membrane mem", "molecule ID 1", "160", "162"]),
    "cell broken by delete_atoms after a run": (
        dict(last="run 0\ngroup few id 7 9\ndelete_atoms group few compress no"),
        ["rbc/membrane mem", "molecule ID 1", "160", "162"]),
    "group defined before its cells":
        (dict(molecule=f"molecule rbc {POTENTIALS}/rbc_162.mol\ngroup cells type 1",
              membrane=SHEAR["membrane"].replace("all", "cells")),
         ["rbc/membrane mem", "group has no atoms", "after the cells are made"]),
    "atom of no molecule": (dict(before="create_atoms 1 single 1 1 1"),
                            ["rbc/membrane mem", "1 atoms", "no molecule"]),
    "atoms of another kind": (dict(before="molecule small " + str(POTENTIALS / "capsule_362.mol") +
                                   "\nchange_box all x final 0 30 boundary p p f\n"
                                   "rbc/create small single 20 6 6"),
                              ["rbc/membrane mem", "molecule ID 2", "362", "162"]),
    "IDs not consecutive":
        (dict(before="change_box all x final 0 30\nrbc/create rbc single 20 6 6\n"
              "set atom 162 mol 2\nset atom 163 mol 1"),
         ["rbc/membrane mem", "molecule ID 1", "consecutive", "1 to 163"]),
    "no molecule IDs": (
        dict(style="atom_style atomic", create_box="create_box 1 box", molecule=None, cells=None,
             membrane="molecule rbc " + str(POTENTIALS / "rbc_162.mol") + "\n" + SHEAR["membrane"]),
        ["olecule"]),
    "no atom map": (dict(style="atom_style molecular\natom_modify id no", cells="mass 1 1"),
                    ["requires", "atom", "ID"]),
}

CELL_ERRORS = {
    "argument": (dict(compute="compute c all rbc/cell volume"),
                 ["compute rbc/cell", "volume", "none"]),
    "no membrane": (dict(membrane=None, compute="compute c all rbc/cell",
                         thermo="thermo_style custom step c_c[1][1]"),
                    ["rbc/cell c", "needs a fix rbc/membrane"]),
    "row that is not there": (dict(compute="compute c all rbc/cell",
                                   thermo="thermo_style custom step c_c[2][1]"),
                              ["compute array", "out-of-range"]),
}

AGGREGATE = "compute a all rbc/aggregate "
AGGREGATE_ERRORS = {
    "no gap": (dict(compute=AGGREGATE), ["compute rbc/aggregate", "missing"]),
    "gap no number": (dict(compute=AGGREGATE + "near"), ["near", "rbc/aggregate"]),
    "gap zero": (dict(compute=AGGREGATE + "0"), ["rbc/aggregate", "gap value 0", "> 0"]),
    "gap negative": (dict(compute=AGGREGATE + "-0.2"), ["rbc/aggregate", "gap value -0.2", "> 0"]),
    "gap not a number": (dict(compute=AGGREGATE + "nan"), ["rbc/aggregate", "nan"]),
    "gap infinite": (dict(compute=AGGREGATE + "inf"),
                     ["rbc/aggregate gap value 'inf' must be a finite number"]),
    "unknown keyword": (dict(compute=AGGREGATE + "0.2 volume 0.1"),
                        ["rbc/aggregate", "keyword", "volume", "area"]),
    "area missing": (dict(compute=AGGREGATE + "0.2 area"),
                     ["compute rbc/aggregate area", "missing"]),
    "area zero": (dict(compute=AGGREGATE + "0.2 area 0"),
                  ["rbc/aggregate", "area 0", "above 0", "at most 1"]),
    "area percent": (dict(compute=AGGREGATE + "0.2 area 10"),
                     ["rbc/aggregate", "area 10", "above 0", "at most 1"]),
    "area not a number": (dict(compute=AGGREGATE + "0.2 area nan"),
                          ["rbc/aggregate", "area", "nan"]),
    "no membrane": (dict(membrane=None, compute=AGGREGATE + "0.2",
                         thermo="thermo_style custom step c_a[1]"),
                    ["rbc/aggregate a", "needs a fix rbc/membrane"]),
    "triclinic": (dict(last="change_box all triclinic", fluid=None, ib=None, membrane=None,
                       thermo=None, compute=AGGREGATE + "0.2"), ["rbc/aggregate a", "orthogonal"]),
    "ghost cutoff too short":
        (dict(compute=AGGREGATE + "0.2", before="comm_modify cutoff 2.5", ib=None, fluid=None,
              thermo=None),
         ["rbc/aggregate a", "ghost cutoff 2.5", "0.2", "comm_modify cutoff"]),
    "too few rows": (dict(compute=AGGREGATE + "0.2", thermo="thermo_style custom step c_a[2][1]"),
                     ["compute array", "out-of-range"]),
}

CREATE_ERRORS = {
    "before the box": (dict(box=CREATE + "single 6 6 6", molecule=None, cells=None),
                       ["rbc/create", "after the simulation box"]),
    "no molecule IDs": (dict(style="atom_style atomic", create_box="create_box 1 box",
                             molecule=None),
                        ["rbc/create", "molecule IDs", "atom_style molecular"]),
    "triclinic": (dict(box="region box prism 0 12 0 12 0 12 2 0 0"), ["rbc/create", "orthogonal"]),
    "no arguments": (dict(cells="rbc/create rbc"), ["rbc/create", "missing"]),
    "no such template": (dict(cells="rbc/create white single 6 6 6"),
                         ["Molecule template", "white", "rbc/create", "does not exist"]),
    "no placement": (dict(cells=CREATE + "seed 1"),
                     ["rbc/create", "needs one of single, file, hemocell, number and hematocrit"]),
    "two placements": (dict(cells=CREATE + "single 6 6 6 number 4 seed 1"),
                       ["rbc/create", "only one of"]),
    "one placement twice": (dict(cells=CREATE + "single 6 6 6 single 5 5 5"),
                            ["rbc/create", "only one of"]),
    "number twice": (dict(cells=CREATE + "number 2 number 3 seed 1"),
                     ["rbc/create", "only one of"]),
    "single missing": (dict(cells=CREATE + "single 6 6"), ["rbc/create single", "missing"]),
    "single no number": (dict(cells=CREATE + "single 6 6 z"), ["'z'", "rbc/create"]),
    "single not a number": (dict(cells=CREATE + "single nan 6 6"), ["rbc/create", "single", "nan"]),
    "single infinite": (dict(cells=CREATE + "single 1e999 6 6"),
                        ["rbc/create single value '1e999' must be a finite number"]),
    "single outside": (dict(cells=CREATE + "single 6 6 11.9"),
                       ["rbc/create single", "z", "outside", "12"]),
    "single beyond image flags": (dict(cells=CREATE + "single 6144 6 6"),
                                  ["rbc/create single", "x 614", "511", "image flags",
                                   "-512 to 511"]),
    "single beyond all boxes": (dict(cells=CREATE + "single 6 -1e300 6"),
                                ["rbc/create single", "y -1e+300", "image flags"]),
    "rotate missing": (dict(cells=CREATE + "single 6 6 6 rotate 30 1 0"),
                       ["rbc/create rotate", "missing"]),
    "rotate without single": (dict(cells=CREATE + "rotate 30 1 0 0 number 1"),
                              ["rbc/create rotate", "single"]),
    "rotate without axis": (dict(cells=CREATE + "single 6 6 6 rotate 30 0 0 0"),
                            ["rbc/create rotate", "axis", "0 0 0"]),
    "file missing": (dict(cells=CREATE + "type 1 file"), ["rbc/create file", "missing"]),
    "no such file": (dict(cells=CREATE + "file none.txt"),
                     ["rbc/create file", "cannot open none.txt", "No such file"]),
    "file and number": (dict(cells=CREATE + "file none.txt number 3 seed 1"),
                        ["rbc/create", "only one of"]),
    "file with a region":
        (dict(cells="region r sphere 6 6 6 5\n" + CREATE + "file none.txt region r"),
         ["rbc/create file takes no region"]),
    "file with velocity": (dict(cells=CREATE + "file none.txt velocity 1"),
                           ["rbc/create file", "needs a seed"]),
    "file without cells": (dict(cells="shell touch empty.txt\n" + CREATE + "file empty.txt"),
                           ["rbc/create file", "empty.txt holds no places"]),
    "file of words": (dict(cells="print '6 6 x' file f.txt\n" + CREATE + "file f.txt"),
                      ["line 1 of f.txt has x where a number is wanted"]),
    "file of pairs": (dict(cells="print '6 6' file f.txt\n" + CREATE + "file f.txt"),
                      ["line 1 of f.txt has 2 words", "x y z theta nx ny nz"]),
    "file of one word": (dict(cells=printed("6 6 6\n6") + "file f.txt"),
                         ["line 2 of f.txt has 1 word; x y z or"]),
    "file of HemoCell": (
        dict(cells=printed("1\n6 6 6 0 0 0") + "file f.txt"),
        ["line 1 of f.txt has 1 number (a HemoCell .pos file begins so: use hemocell"]),
    "no such .pos": (dict(cells=CREATE + "hemocell none.pos"),
                     ["rbc/create hemocell: cannot open none.pos", "No such file"]),
    ".pos without a number": (
        dict(cells=printed("6 6 6 0 0 0") + "hemocell f.txt"),
        ["rbc/create hemocell: line 1 of f.txt must hold one number alone"]),
    ".pos of five": (dict(cells=printed("1\n6 6 6 0 0") + "hemocell f.txt"),
                     ["rbc/create hemocell: line 2 of f.txt has 5 words; x y z rx ry rz"]),
    ".pos cut off": (dict(cells=printed("3\n6 6 6 0 0 0") + "hemocell f.txt"),
                     ["f.txt says in its first line that there are 3 cells, but has places of 1"]),
    ".pos without cells": (dict(cells=printed("0") + "hemocell f.txt"),
                           ["rbc/create hemocell: f.txt holds no places of cells"]),
    ".pos with a region":
        (dict(cells="region r sphere 6 6 6 5\n" + CREATE + "hemocell none.pos region r"),
         ["rbc/create hemocell takes no region"]),
    "file without axis": (dict(cells="print '6 6 6 30 0 0 0' file f.txt\n" + CREATE + "file f.txt"),
                          ["line 1 of f.txt has an axis nx ny nz of length 0"]),
    "file outside": (dict(cells="print '6 6 11.9' file f.txt\n" + CREATE + "file f.txt"),
                     ["rbc/create file: line 1 of f.txt: a vertex at z", "outside"]),
    "number missing": (dict(cells=CREATE + "seed 1 number"), ["rbc/create number", "missing"]),
    "number zero": (dict(cells=CREATE + "number 0 seed 1"), ["rbc/create number", "0", "> 0"]),
    "number no integer": (dict(cells=CREATE + "number 1.5 seed 1"),
                          ["rbc/create number value '1.5' must be an integer > 0"]),
    "hematocrit missing": (dict(cells=CREATE + "seed 1 hematocrit"),
                           ["rbc/create hematocrit", "missing"]),
    "hematocrit zero": (dict(cells=CREATE + "hematocrit 0 seed 1"),
                        ["hematocrit", "0", "between 0 and 1"]),
    "hematocrit percent": (dict(cells=CREATE + "hematocrit 45 seed 1"),
                           ["hematocrit", "45", "between 0 and 1"]),
    "hematocrit not a number": (dict(cells=CREATE + "hematocrit nan seed 1"),
                                ["rbc/create", "hematocrit", "nan"]),
    "hematocrit below one cell": (dict(cells=CREATE + "hematocrit 0.001 seed 1"),
                                  ["hematocrit", "0.001", "less than one cell"]),
    "region missing": (dict(cells=CREATE + "number 1 seed 1 region"),
                       ["rbc/create region", "missing"]),
    "no such region": (dict(cells=CREATE + "number 1 seed 1 region tube"),
                       ["Region", "tube", "rbc/create", "does not exist"]),
    "single with region": (dict(cells=CREATE + "single 6 6 6 region box"),
                           ["rbc/create single", "no region"]),
    "seed missing": (dict(cells=CREATE + "number 1 seed"), ["rbc/create seed", "missing"]),
    "no seed": (dict(cells=CREATE + "number 1"), ["rbc/create", "need a seed"]),
    "seed negative": (dict(cells=CREATE + "number 1 seed -5"), ["rbc/create seed", "-5", "> 0"]),
    "seed beyond all integers": (dict(cells=CREATE + "number 1 seed 4294967297"),
                                 ["rbc/create seed value 4294967297 must be between 1 and "
                                  "2147483647"]),
    "type missing": (dict(cells=CREATE + "number 1 seed 5 type"), ["rbc/create type", "missing"]),
    "type too large": (dict(cells=CREATE + "number 1 seed 5 type 2"),
                       ["rbc/create type", "2", "between 1 and 1"]),
    "type label unknown":
        (dict(before="labelmap atom 1 soft\nrbc/create rbc single 6 6 6 type hard"),
         ["rbc/create type value 'hard' must be a type label or an integer between 1 and 1"]),
    "type label without a map": (dict(cells=CREATE + "single 6 6 6 type soft"),
                                 ["rbc/create type value 'soft' must be an integer between 1 "
                                  "and 1"]),
    "overlap missing": (dict(cells=CREATE + "number 1 seed 5 overlap"),
                        ["rbc/create overlap", "missing"]),
    "overlap zero": (dict(cells=CREATE + "number 1 seed 5 overlap 0"),
                     ["rbc/create overlap", "0", "> 0"]),
    "overlap infinite": (dict(cells=CREATE + "number 1 seed 5 overlap inf"),
                         ["rbc/create overlap value 'inf' must be a finite number"]),
    "attempts missing": (dict(cells=CREATE + "number 1 seed 5 attempts"),
                         ["rbc/create attempts", "missing"]),
    "attempts zero": (dict(cells=CREATE + "number 1 seed 5 attempts 0"),
                      ["rbc/create attempts", "0", "> 0"]),
    "mix missing": (dict(cells=CREATE + "number 1 seed 5 mix rbc 0.1"),
                    ["rbc/create mix", "missing"]),
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
    "single with mix": (dict(cells=CREATE + "single 6 6 6 mix rbc 0.5 1"),
                        ["rbc/create single", "no mix"]),
    "velocity missing": (dict(cells=CREATE + "number 1 seed 5 velocity"),
                         ["rbc/create velocity", "missing"]),
    "velocity negative": (dict(cells=CREATE + "number 1 seed 5 velocity -1"),
                          ["rbc/create velocity", "-1", ">= 0"]),
    "single with velocity": (dict(cells=CREATE + "single 6 6 6 velocity 1"),
                             ["rbc/create single", "no velocity"]),
    "unknown keyword": (dict(cells=CREATE + "number 1 seed 5 colour red"),
                        ["rbc/create", "keyword", "colour", "single, rotate"]),
    "too dense": (dict(cells=CREATE + "hematocrit 0.7 seed 5 attempts 100"),
                  ["rbc/create could not pack 14 cells, 0.72", "of the box, without overlap in 100 "
                   "attempts; the densest reached is 0.", "of the box; use fewer cells, another "
                   "seed, a smaller overlap distance or more attempts"]),
    "too dense for a region": (
        dict(cells="region part block 0 12 0 12 1 11\n" + CREATE +
             "hematocrit 0.7 seed 5 attempts 100 region part"),
        ["rbc/create could not pack 11 cells, 0.6", "of region part and 0.5", "of the box, ",
         "the densest reached is 0.", "of region part; use fewer cells, another seed, a smaller "
         "overlap distance, a region that ends at INF in periodic directions or more attempts"]),
    "more cells than fill the box": (dict(cells=CREATE + "number 2000000000 seed 5"),
                                     ["rbc/create", "the volume of 2000000000 cells, 1.78",
                                      "e+11, must be below", "box they are packed into, 1728"]),
    "more cells than fill a region": (dict(cells="region small block 4 8 4 8 4 8\n" + CREATE +
                                           "number 1 seed 5 region small mix rbc 0.5 1"),
                                      ["rbc/create", "the volume of 1 cells, 89",
                                       "region they are packed into, 64"]),
    "region too small for a cell": (
        dict(cells="region small block 3.5 8.5 3.5 8.5 3.5 8.5\n" + CREATE +
             "number 1 seed 5 region small"), ["rbc/create", "could not pack 1 cells", "densest"]),
    "region outside":
        (dict(cells="region far block 40 80 40 80 40 80\n" + CREATE + "number 1 seed 5 region far"),
         ["rbc/create", "region", "far"]),
}


class Cells(BadInput):
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


if __name__ == "__main__":
    unittest.main()
