#!/usr/bin/env python3
"""How long the steps of dense blood may be: examples/suspension with 64 cells of 162 vertices at
45 %, from a strain of 1 on, with several errors allowed in a step and several strains of a step at
most. For each it writes to steps.csv and prints the solves per strain up to a strain of 5, the
viscosity from a strain of 3 to 5 over that of plasma, and by how much the centres of cells are off
at a strain of 1.5: against a run whose steps have errors 50 times smaller.

steps.py --output FOLDER [--lmp ../build/lmp_rbc]
"""
import csv
import re
import shutil
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
import blood_study  # noqa: E402
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from rbc.tables import read_ave_time, read_table  # noqa: E402

SCRIPT = HERE.parent / "examples" / "suspension" / "in.suspension"
BOX = {"cells": 64, "gap": 15, "shape": "rbc_162", "frames": 1000000, "every": 1}
FLOWS = (10, 2.0e-4), (10, 0), (100, 2.0e-4)    # shear rate, work of adhesion
SETTINGS = ((5.0e-3, 0.03, 2000), (1.0e-2, 0.08, 8000), (2.0e-2, 0.08, 8000),
            (4.0e-2, 0.08, 8000))               # error, um; strain and time, us, of a step at most
FINEST = (1.0e-4, 0.03, 2000)
START, MIDDLE, LATE, END = 1, 1.5, 3, 5         # strains
COLUMNS = ("rate", "adhesion", "error", "strain", "longest", "solves_per_strain",
           "steps_per_strain", "viscosity", "off", "off_median")


def continued(arguments, start, flow, setting, strain):
    """Runs on from the restart file of `start`; returns the folder and what was printed."""
    folder = tempfile.TemporaryDirectory()
    shutil.copy(Path(start) / "last.restart", folder.name)
    printed = example_study.run_script(arguments, SCRIPT, folder.name, {
        **variables(flow, setting), "strain": strain, "pieces": 1}).stdout
    return folder, printed


def variables(flow, setting):
    return {**BOX, **dict(zip(("rate", "sigma"), flow)),
            **dict(zip(("error", "step", "longest"), setting))}


def centres(folder):
    """Of all cells at a strain of MIDDLE, by a parabola in time through the steps around it."""
    cells = read_ave_time(Path(folder) / "cell.dat")
    strain = read_table(Path(folder) / "blood.dat")["v_sheared"]
    near = np.argsort(abs(strain - MIDDLE))[:3]
    places = cells.columns(2, 4)[near]
    weights = [np.prod([(MIDDLE - strain[m]) / (strain[n] - strain[m]) for m in near if m != n])
               for n in near]
    return np.tensordot(weights, places, axes=1)


def measure(arguments, start, flow, setting, exact):
    folder, printed = continued(arguments, start, flow, setting, END)
    with folder:
        cost = re.search(r"step cost: (\d+) solves in (\d+) steps", printed)
        solves, steps = map(int, cost.groups())
        table = read_table(Path(folder.name) / "blood.dat")
        off = np.linalg.norm(centres(folder.name) - exact, axis=1)
    made = table["v_sheared"][-1] - START
    viscosity = blood_study.mean_viscosity(table, END, LATE / END)
    return (*flow, *setting, f"{solves / made:.0f}", f"{steps / made:.1f}", f"{viscosity:.3f}",
            f"{np.sqrt((off**2).mean()):.4f}", f"{np.median(off):.4f}")


def rows(arguments):
    for flow in FLOWS:
        with tempfile.TemporaryDirectory() as start:
            example_study.run_script(arguments, SCRIPT, start, {
                **variables(flow, SETTINGS[0]), "strain": START, "seconds": 100000})
            folder, _ = continued(arguments, start, flow, FINEST, MIDDLE * 1.02)
            with folder:
                exact = centres(folder.name)
            for setting in SETTINGS:
                yield measure(arguments, start, flow, setting, exact)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--lmp", default=str(HERE.parent / "build" / "lmp_rbc"))
    arguments = command_line.parse(parser, HERE)
    arguments.ranks = 1
    with open(arguments.output / "steps.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in rows(arguments):
            writer.writerow(row)
            stream.flush()
            print(*row, sep=", ", flush=True)


if __name__ == "__main__":
    main()
