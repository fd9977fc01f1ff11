#!/usr/bin/python3
"""How the viscosity of blood of 45 % at 10, 60 and 100 /s, with adhesion and without, depends on
the grid, the mesh and the kernel: error against run time. Runs in.suspension with 32 cells over a
strain of 5 for each, the range of contact the same in all, writes convergence.csv and
convergence.png to a folder and prints the tables of the README. Errors are against the value to
which the finest runs extrapolate.

converge.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only rbc_162 rbc_362 rbc_642]
"""
import itertools
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOP = HERE.parents[1]
sys.path.insert(0, str(TOP / "scripts"))
import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from blood_study import COLUMNS, measure_viscosity  # noqa: E402

KERNELS = "roma3", "peskin4"
RATES = 100, 10, 60                                       # 1/s
WORKS = {"repulsive": 0.0, "adhesive": 2.0e-4}            # of adhesion, mJ/m^2
COARSE = ("rbc_162", 0.8), ("rbc_162", 0.65), ("rbc_362", 0.65), ("rbc_642", 0.5)
FINE = ("rbc_1442", 0.35), ("rbc_2562", 0.25)             # with the first kernel only
SCENES = tuple(itertools.product(WORKS, RATES))
VOLUMES = {"rbc_162": 89.30, "rbc_362": 91.90, "rbc_642": 92.84, "rbc_1442": 93.52, "rbc_2562": 93.75}    # of cells as meshed, um^3
SMALL_BOX = {"cells": 32, "gap": 15, "strain": 5, "range": 0.8, "frames": 1000000}


def made_templates(folder):
    """The folder of templates, with those that the package does not ship."""
    templates = folder / "templates"
    if not templates.exists():
        shutil.copytree(TOP / "potentials", templates, ignore=shutil.ignore_patterns("*.py", "__pycache__"))
        subprocess.run([TOP / "potentials" / "make_template.py", "disc", "--diameter", "7.82", "--frequency", "12",
                        "--output", templates / "rbc_1442.mol"], check=True)
    return templates


def label(work, rate, kernel, shape, dx):
    return f"{work} {rate} {kernel} {shape} {dx:g}"


def cases():
    """(series, label, variables) of all runs, the cheap ones first."""
    coarse = itertools.product(SCENES, COARSE, KERNELS)
    fine = itertools.product(SCENES, FINE, KERNELS[:1])
    for (work, rate), (shape, dx), kernel in (*coarse, *fine):
        yield shape, label(work, rate, kernel, shape, dx), {
            "sigma": WORKS[work], "rate": rate, "kernel": kernel, "shape": shape, "volume": VOLUMES[shape], "dx": dx}


def main():
    arguments = command_line.parse(example_study.options(__doc__, [shape for shape, _ in COARSE + FINE]), HERE)
    templates = made_templates(arguments.output)
    example_study.run_cases(
        arguments, arguments.output / "convergence.csv", COLUMNS, cases(),
        lambda arguments, variables: measure_viscosity(arguments, HERE / "in.suspension",
                                                       {**SMALL_BOX, **variables}, templates))


if __name__ == "__main__":
    main()
