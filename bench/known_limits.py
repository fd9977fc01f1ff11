#!/usr/bin/python3
"""Orders, limits and errors that scripts/converge.py finds in examples of which they are known.

Runs it for each case and writes known_limits.csv to a folder, of which it prints what the table of
doc/converge.rst has. A limit is a closed form, the README's of the example, or that of much finer
settings, extrapolated with the known order. Runs stay in the folder, in runs/, and are not made
again.
"""
import csv
import itertools
import math
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
TOP = HERE.parent
sys.path.insert(0, str(TOP / "scripts"))
from rbc import command_line  # noqa: E402
import converge  # noqa: E402
import example_study  # noqa: E402
import richardson  # noqa: E402

DEFORMATION, VOLUME = "c_cell[1][7]", "c_cell[1][6]"
CAPSULE = "sheets=no", "strain=1", "Ca=0.0375"
SMALL = "dx=0.25", "length=6", "gap=6"
BOX = "dx=0.166666666", "strain=1", "timestep=0.02", "shape=capsule_362"
SHEAR = "strain=4", "dx=1", "shape=rbc_162"
BLOOD = "cells=32", "gap=15", "strain=5", "frames=1000000", "sigma=0", "every=2"
BLOOD_VISCOSITY = 3.06              # examples/suspension/README.md
CAPSULE_DEFORMATION = 0.0796        # examples/capsule-shear/README.md


def sphere_speed(weight=2.0, side=5.83):
    """Of a sphere in a simple cubic array of its images (Sangani & Acrivos 1982, to 2nd order)."""
    share = 4 * math.pi / 3 / side**3
    return weight / (6 * math.pi) * (1 - 1.7601 * share**(1 / 3) + share - 1.5593 * share**2)


class Case(NamedTuple):
    example: str
    vary: str
    measure: str
    settings: tuple
    order: str             # that is known; "" if none is
    limit: object          # a number, or two much finer settings, from which it is extrapolated
    options: tuple = ()


CASES = {
    "capsule dx roma3": Case("capsule-shear", "dx=0.25,0.1666666666,0.125,0.1", DEFORMATION,
                             (*CAPSULE, "kernel=roma3"), "1", CAPSULE_DEFORMATION),
    "capsule dx peskin4": Case("capsule-shear", "dx=0.25,0.1666666666,0.125,0.1", DEFORMATION,
                               (*CAPSULE, "kernel=peskin4"), "1", CAPSULE_DEFORMATION),
    "capsule sheets roma3": Case("capsule-shear", "dx=0.25,0.1666666666,0.125", DEFORMATION,
                                 ("sheets=yes", *CAPSULE[1:], "kernel=roma3"), "",
                                 CAPSULE_DEFORMATION),
    "capsule sheets peskin4": Case("capsule-shear", "dx=0.25,0.1666666666,0.125", DEFORMATION,
                                   ("sheets=yes", *CAPSULE[1:], "kernel=peskin4"), "",
                                   CAPSULE_DEFORMATION),
    "capsule midpoint": Case("capsule-shear", "timestep=0.08,0.04,0.02", DEFORMATION,
                             (*SMALL, "strain=2", "every=0.08"), "2", ("0.005", "0.0025")),
    "capsule mesh, volume": Case("capsule-shear", "shape=capsule_162,capsule_362,capsule_642",
                                 VOLUME, (*SMALL, "strain=0.5"), "2", 4 * math.pi / 3),
    "capsule mesh, D": Case("capsule-shear", "shape=capsule_162,capsule_362,capsule_642",
                            DEFORMATION, (*SMALL, "strain=0.5"), "2",
                            ("capsule_642", "capsule_2562")),
    "capsule box": Case("capsule-shear", "length:gap=5:5,6:6,8:8", DEFORMATION, BOX, "3",
                        ("12:12", "16:16")),
    "red cell, rkc": Case("shear-cell", "step=0.1,0.05,0.025", DEFORMATION,
                          (*SHEAR, "integrator=rkc auto"), "2", ("0.01", "0.005")),
    "red cell, rkc order 3": Case("shear-cell", "step=0.1,0.05,0.025", DEFORMATION, SHEAR, "3",
                                  ("0.01", "0.005")),
    "settling sphere": Case("settling-sphere", "cells=18,24,36,48", "v_speed",
                            ("timestep=0.02", "steps=300"), "1", sphere_speed()),
    "empty tube": Case("tube-poiseuille", "dx=1.5,1.0,0.75,0.6", "v_relative",
                       ("hematocrit=0.02", "length=9", "duration=1", "every=1"), "", 1.0),
    "blood": Case("suspension", "dx:shape:volume=0.8:rbc_162:89.30,0.65:rbc_362:91.90,"
                  "0.5:rbc_642:92.84", "v_relative", BLOOD, "", BLOOD_VISCOSITY,
                  ("--take", "mean", "--part", "0.4"))}


def run_case(arguments, name, vary):
    """What converge.py prints for a case and its rows, with the words of `vary` as values."""
    case = CASES[name]
    folder = arguments.output / "runs" / name.replace(" ", "_").replace(",", "")
    command = [sys.executable, TOP / "scripts" / "converge.py",
               TOP / "examples" / case.example / f"in.{case.example}", "--vary", vary, "--measure",
               case.measure, "--set", *case.settings, *case.options, "--lmp", arguments.lmp,
               "--ranks", str(arguments.ranks), "--output", folder]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    with open(folder / "converge.csv", encoding="utf-8") as file:
        return done.stdout, list(csv.DictReader(file))


def limit_of(arguments, name):
    """That of the case, from much finer runs where it is not known otherwise."""
    case = CASES[name]
    if isinstance(case.limit, float):
        return case.limit
    vary = f"{case.vary.partition('=')[0]}={','.join(case.limit)}"
    _, rows = run_case(arguments, name, vary)
    varied = list_of(vary)
    values = {row[varied.title]: float(row["value"]) for row in rows}
    coarse, fine = (values[varied.word(n)] for n in range(2))
    return richardson.extrapolate(varied.sizes[1], fine, varied.sizes[0], coarse,
                                  float(case.order))


def list_of(vary):
    """The Varied of converge.py."""
    return converge.complete(*converge.varied(vary), {}, {})


def covered_by(rows, varied, exact, count):
    """Errors that fits of any `count` of the rows cover, and how many there are."""
    sizes = {varied.word(n): size for n, size in enumerate(varied.sizes)}
    found = []
    for some in itertools.combinations(rows, count):
        values, noise = ([float(row[name]) for row in some] for name in ("value", "noise"))
        fit = richardson.fit([sizes[row[varied.title]] for row in some], values, noise)
        found += [bound >= abs(value - exact) for value, bound in zip(values, fit.bounds)]
    return sum(found), len(found)


def measured(arguments, name):
    """The row of a case."""
    case = CASES[name]
    exact = limit_of(arguments, name)
    printed, rows = run_case(arguments, name, case.vary)
    found = re.search(r": order (unknown|[\d.]+)", printed)[1]
    limit = re.search(r"^limit (\S+),.*below (\S+)$", printed, re.MULTILINE)
    errors = [abs(float(row["value"]) - exact) for row in rows]
    bounds = [float(row["error_below"]) for row in rows]
    ratios = [bound / error for bound, error in zip(bounds, errors)]
    varied = list_of(case.vary)
    subsets = {f"covered_by_any_{count}": "{} of {}".format(*covered_by(rows, varied, exact, count))
               for count in (2, 3)}
    return {"case": name, "known_order": case.order, "order": found, "known_limit": f"{exact:.6g}",
            "limit": limit[1] if limit else "-", "settings": len(rows),
            "covered": sum(ratio >= 1 for ratio in ratios),
            "least_ratio": f"{min(ratios):.3g}", "largest_ratio": f"{max(ratios):.3g}",
            **subsets,
            "core_seconds": f"{sum(float(row['core_seconds']) for row in rows):.3g}"}


def main():
    parser = example_study.options(__doc__, CASES)
    arguments = command_line.parse(parser, HERE)
    found = []
    for name in CASES:
        if example_study.wanted(arguments, name):
            found.append(measured(arguments, name))
            print(*found[-1].values(), sep=" | ", flush=True)
    print(sum(row["covered"] for row in found), "of", sum(row["settings"] for row in found),
          "errors are covered")
    for name in ("covered_by_any_2", "covered_by_any_3"):
        good, all_of_them = zip(*(map(int, row[name].split(" of ")) for row in found))
        print(f"{name}: {sum(good)} of {sum(all_of_them)}")
    with open(arguments.output / "known_limits.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, found[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(found)


if __name__ == "__main__":
    main()
