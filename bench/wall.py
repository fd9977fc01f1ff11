"""Slip against solves that `wall` measures, wall.csv: prints the solves to a slip of 1e-3 and draws
wall.png."""

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

CASES = {"base": "radius 14 dx, markers 1.2 dx apart",
         "closer": "radius 14 dx, markers 0.6 dx apart",
         "finer": "radius 28 dx, markers 1.2 dx apart"}
COLORS = {"plain": "tab:gray", "preconditioned": "tab:blue", "recycled": "tab:red"}


def main():
    folder = folder_with("wall", __doc__)
    with open(folder / "wall.csv", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), sharey=True, constrained_layout=True)
    for axis, (case, title) in zip(axes, CASES.items()):
        for method, color in COLORS.items():
            chosen = [row for row in rows if row["case"] == case and row["method"] == method]
            solves, slip = ([float(row[name]) for row in chosen] for name in ("solves", "slip"))
            axis.loglog(solves, slip, "o-", color=color, markersize=3, label=method)
            enough = [n for n, s in zip(solves, slip) if s <= 1e-3]
            print(f"{case:7} {method:15} {chosen[0]['markers']:>6} markers: slip below 1e-3 after "
                  f"{f'{enough[0]:g}' if enough else f'more than {solves[-1]:g}'} solves")
        axis.axhline(1e-3, color="k", linewidth=0.5)
        axis.set(title=f"{title}\n{chosen[0]['markers']} markers", xlabel="solves")
    axes[0].set_ylabel("largest slip / largest speed")
    axes[0].legend()
    figure.savefig(folder / "wall.png", dpi=120)


if __name__ == "__main__":
    main()
