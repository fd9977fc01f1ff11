"""Reads bench/wall.csv, prints the solves to a slip of 1e-3 and draws bench/wall.png: slip against solves."""

import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).parent
CASES = {"base": "radius 14 dx, markers 1.2 dx apart", "closer": "radius 14 dx, markers 0.6 dx apart",
         "finer": "radius 28 dx, markers 1.2 dx apart"}
COLORS = {"plain": "tab:gray", "preconditioned": "tab:blue", "recycled": "tab:red"}

with open(HERE / "wall.csv", encoding="utf-8") as table:
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
figure.savefig(HERE / "wall.png", dpi=120)
