"""Reads bench/bending.csv, prints it as a table and draws bench/bending.png: errors against the spacing of the mesh."""

import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
ENERGIES = [("sphere_energy", "sphere", "o"), ("disc_energy", "biconcave disc", "s")]
FORCES = [("force_bands", "16 bands of latitude", "o"), ("force_median", "median", "s"),
          ("force_rms", "rms", "^"), ("force_largest", "largest", "v"),
          ("force_rms_everywhere", "rms, all vertices", "x")]
LINES = {"helfrich": "-", "dihedral": "--"}


def main():
    rows = list(csv.DictReader(open(HERE / "bending.csv")))
    figure, (energies, forces) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    for form, line in LINES.items():
        mine = [row for row in rows if row["form"] == form]
        spacing = [float(row["spacing"]) for row in mine]
        exact = float(mine[-1]["force_exact"])
        for axes, curves, scale in ((energies, ENERGIES, 1), (forces, FORCES, exact)):
            for number, (name, label, marker) in enumerate(curves):
                error = [abs(float(row[name])) / scale for row in mine]
                axes.loglog(spacing, error, marker + line, color=f"C{number}", label=f"{form}: {label}")
                print(f"{form:9} {name:21} " + "  ".join(f"{e:9.2e}" for e in error))
        if form == "helfrich":
            guide = [0.5 * h * h for h in spacing]
            energies.loglog(spacing, guide, color="0.6", lw=1, label="second order")
            forces.loglog(spacing, [4 * g for g in guide], color="0.6", lw=1, label="second order")
    energies.set_title("energy")
    forces.set_title("normal force per area on the disc, of its rms")
    for axes in (energies, forces):
        axes.set_xlabel("mean edge over the radius")
        axes.set_ylabel("relative error")
        axes.legend(fontsize=7)
        axes.grid(alpha=0.3)
    figure.savefig(HERE / "bending.png", dpi=110)


main()
