#!/usr/bin/env python3
"""Differences between runs of the examples' vessels and of dense blood that adheres, at reduced
length, on 1, 2 and 4 ranks.

Writes ranks.csv and ranks.png to a folder; the executables come from the environment (LMP_RBC,
MPIEXEC), as in ranks.sh.
"""
import csv
import itertools
import os
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / folder)
                for folder in ("tests/helpers", "tests/scenes", "scripts")]
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from lammps_case import ROOT, run  # noqa: E402
from scene_case import example_script, shortened  # noqa: E402

RANKS = (1, 2, 4)
FRAMES = 40
BOUND = 1e-6    # of a diameter
DIAMETER = 7.82    # um
GROUPS = {"capsule-channel": "capsule", "suspension": "all"}    # of the vertices; others: cells

# variables of the scene, steps, diameter of a cell in its units
SCENES = {
    "capsule-channel": (dict(shape="capsule_642", length=5, cells=12), 80, 3.4),
    "tube-poiseuille": (dict(length=9.6), 400, DIAMETER),
    "fahraeus": (dict(length=8.4, hematocrit=0.45, shape="rbc_642", dx=0.6), 400, DIAMETER),
    "throat": (dict(length=4, width=2, throat=1.2, hematocrit=0.3), 200, DIAMETER),
    "suspension": (dict(cells=64, rate=100), 120, DIAMETER),
    "stream": (dict(dense=1, tol=1e-11), 100, DIAMETER)}    # cells enter and leave


def script(name, variables, steps):
    variables = {**variables, "scripts": ROOT / "scripts", "frames": 100000}
    return shortened(example_script(name, **variables), GROUPS.get(name, "cells"), steps,
                     steps // FRAMES)


def compare(name):
    """Rows of ranks.csv: of each frame the largest distance of a vertex from where it is on one
    rank, in diameters."""
    variables, steps, diameter = SCENES[name]
    runs = {ranks: run(script(name, variables, steps), ranks, timeout=3600) for ranks in RANKS}
    dumps = {ranks: result.dump() for ranks, result in runs.items()}
    rows = []
    for frame, step in enumerate(dumps[1].steps):
        there = places(dumps[1], frame)
        row = {"scene": name, "step": step,
               "moved_diameters": f"{farthest(there, places(dumps[1], 0)) / diameter:.4g}"}
        for ranks in RANKS[1:]:
            here = places(dumps[ranks], frame)
            apart = farthest(here, there) / diameter if here.keys() == there.keys() else np.inf
            row[f"apart_{ranks}_ranks"] = f"{apart:.3g}"
        rows.append(row)
    return rows


def places(dump, frame):
    """{atom ID: position}."""
    return dict(zip(dump("id", frame=frame).astype(int).tolist(), dump.positions(frame)))


def farthest(one, other):
    """Largest distance between atoms that are in both."""
    return max(np.linalg.norm(one[atom] - other[atom]) for atom in one.keys() & other.keys())


def draw(rows, path):
    figure = Figure(figsize=(8, 5), layout="constrained")
    axes = figure.subplots()
    for n, name in enumerate(SCENES):
        mine = [row for row in rows if row["scene"] == name and int(row["step"]) > 0]
        for ranks, style in zip(RANKS[1:], ("-", "--")):
            axes.semilogy([int(row["step"]) for row in mine],
                          [float(row[f"apart_{ranks}_ranks"]) for row in mine],
                          style, color=f"C{n}", label=f"{name}, {ranks} ranks")
    axes.axhline(BOUND, color="0.6", lw=1)
    axes.set(xlabel="step", ylabel="largest distance from a vertex on 1 rank (diameters)")
    axes.legend(fontsize=8)
    axes.grid(alpha=0.3)
    figure.savefig(path, dpi=90)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--only", nargs="*", choices=SCENES, default=list(SCENES),
                        help="scenes to run; of others ranks.csv keeps its rows")
    arguments = command_line.parse(parser, HERE, ["LMP_RBC", "MPIEXEC"])
    path, only = arguments.output / "ranks.csv", arguments.only
    rows = []
    if path.exists():
        with open(path, newline="", encoding="ascii") as file:
            rows = [row for row in csv.DictReader(file) if row["scene"] not in only]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name in only:
            mine = compare(name)
            rows += mine
            below = list(itertools.takewhile(
                lambda row: max(float(row[f"apart_{ranks}_ranks"]) for ranks in RANKS[1:]) < BOUND,
                mine))
            print(f"{name}: below {BOUND:g} diameters to step {below[-1]['step']} (moved "
                  f"{below[-1]['moved_diameters']}); at the end", mine[-1], flush=True)
    with open(path, "w", newline="", encoding="ascii") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    draw(rows, arguments.output / "ranks.png")


if __name__ == "__main__":
    main()
