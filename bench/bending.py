"""Errors of bending that `bending` measures, bending.csv: prints a table and draws bending.png,
errors over the spacing of the mesh."""

import csv
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
from rbc import command_line  # noqa: E402, F401
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from program_table import folder_with  # noqa: E402

ENERGIES = [("sphere_energy", "sphere", "o"), ("disc_energy", "biconcave disc", "s")]
FORCES = [("force_bands", "16 bands of latitude", "o"), ("force_median", "median", "s"),
          ("force_rms", "rms", "^"), ("force_largest", "largest", "v"),
          ("force_rms_everywhere", "rms, all vertices", "x")]
LINES = {"helfrich": "-", "dihedral": "--"}


def main():
    folder = folder_with("bending", __doc__)
    rows = list(csv.DictReader(open(folder / "bending.csv")))
    figure, (energies, forces) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    for form, line in LINES.items():
        mine = [row for row in rows if row["form"] == form]
        spacing = [float(row["spacing"]) for row in mine]
        exact = float(mine[-1]["force_exact"])
        for axes, curves, scale in ((energies, ENERGIES, 1), (forces, FORCES, exact)):
            for number, (name, label, marker) in enumerate(curves):
                error = [abs(float(row[name])) / scale for row in mine]
                axes.loglog(spacing, error, marker + line, color=f"C{number}",
                            label=f"{form}: {label}")
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
    figure.savefig(folder / "bending.png", dpi=110)


if __name__ == "__main__":
    main()
