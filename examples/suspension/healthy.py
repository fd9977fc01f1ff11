#!/usr/bin/python3
"""Viscosity of blood of 43 % beside the measurements of Wells and Merrill (1962): what an inside
five times as viscous as plasma adds, and what the viscosity of the membranes does, on two grids.
Runs in.suspension with 32 cells over a strain of 5 for each case; writes healthy.csv and
healthy.png to a folder and prints the table of the README.

healthy.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only plain inside healthy]
"""
import itertools
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from blood_study import COLUMNS, measure_viscosity  # noqa: E402
from rbc.tables import read_csv  # noqa: E402
from study import SMALL_BOX, VOLUMES  # noqa: E402

REFERENCE = HERE.parent / "reference" / "07c_blood_viscosity_wells_merrill1962.csv"
PLASMA = 1.2                         # of the measurements, at 37 C, mPa s
HEMATOCRIT = 0.43
RATES = 12.5, 62, 124                # 1/s
GRIDS = ("rbc_162", 0.65), ("rbc_362", 0.5)    # dx in um
MEDIUM = 1.4965                      # plasma of healthy.material
KINDS = {"plain": {}, "inside": {"inside": 5 * MEDIUM},
         "healthy": {"inside": 5 * MEDIUM, "viscous": 1}}
WORDS = {"plain": "inside as viscous as plasma", "inside": "inside five times as viscous",
         "healthy": "the same, membranes viscous"}
ADHESION = {"repulsive": 0, "adhesive": 2.0e-4}
LINES = {"repulsive": "-", "adhesive": "--"}
COLORS = {"plain": "#8cbf6f", "inside": "#1c4587", "healthy": "#8b1a1a"}


def label(kind, contact, rate, shape):
    return f"{kind} {contact} {rate:g} {shape}"


def cases():
    for (shape, dx), kind, contact, rate in itertools.product(GRIDS, KINDS, ADHESION, RATES):
        yield kind, label(kind, contact, rate, shape), {
            **KINDS[kind], "sigma": ADHESION[contact], "rate": rate, "shape": shape,
            "volume": VOLUMES[shape], "dx": dx, "hematocrit": HEMATOCRIT}


def measured():
    """(shear rate, viscosity over that of plasma) at 43 %."""
    rows = [row for row in read_csv(REFERENCE) if row["hematocrit_pct"] == "43"]
    return np.array([[float(row["shear_rate_1_s"]), float(row["viscosity_cP"]) / PLASMA]
                     for row in rows]).T


def print_table(table):
    rates, values = measured()
    print("| vertices, dx (µm) | cells | contact |", *(f"{rate:g} /s |" for rate in RATES))
    print("|---|---|---|" + "---|" * len(RATES))
    print("| measured | | |", *(f"{np.interp(rate, rates, values):.1f} |" for rate in RATES))
    for (shape, dx), kind, contact in itertools.product(GRIDS, KINDS, ADHESION):
        keys = [label(kind, contact, rate, shape) for rate in RATES]
        if all(key in table for key in keys):
            print(f"| {shape[4:]}, {dx:g} | {WORDS[kind]} | {contact} |",
                  *(f"{table[key][-1][0]:.2f}, {table[key][-1][1]:.0f} s |" for key in keys))


def draw(table, path):
    figure, axes = plt.subplots(1, len(GRIDS), figsize=(10, 4), sharey=True, layout="constrained")
    for (shape, dx), panel in zip(GRIDS, axes):
        panel.plot(*measured(), "k^", label="Wells and Merrill 1962")
        for kind, contact in itertools.product(KINDS, ADHESION):
            points = [(rate, table[label(kind, contact, rate, shape)][-1][0]) for rate in RATES
                      if label(kind, contact, rate, shape) in table]
            if points:
                panel.plot(*np.array(points).T, LINES[contact], marker="o", ms=4,
                           color=COLORS[kind], label=f"{WORDS[kind]}, {contact}")
        panel.set(title=f"{shape[4:]} vertices, dx {dx:g} µm", xlabel="shear rate, 1/s",
                  xscale="log", ylim=(0, None))
    axes[0].set_ylabel("viscosity over that of plasma")
    axes[0].legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    arguments = command_line.parse(example_study.options(__doc__, KINDS), HERE)

    def measure(arguments, changed):
        return measure_viscosity(arguments, HERE / "in.suspension", {**SMALL_BOX, **changed})

    table = example_study.run_cases(arguments, arguments.output / "healthy.csv", COLUMNS, cases(),
                                    measure)
    print_table(table)
    draw(table, arguments.output / "healthy.png")


if __name__ == "__main__":
    main()
