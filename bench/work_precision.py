#!/usr/bin/env python3
"""Error against run time that `work_precision` measures, work_precision.csv, drawn as
work_precision.png."""
import csv
import sys
from itertools import groupby
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
from rbc import command_line  # noqa: E402, F401
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from program_table import folder_with  # noqa: E402

REGIMES = ("none", "unsteady", "convective")
BOUNDARIES = ("plates", "periodic")
COLORS = {16: "C0", 32: "C1", 64: "C2"}
STYLES = {"coupled": ("o", "-"), "projection": ("s", "--")}


def side(row):
    return round(int(row["cells"])**(1 / 3))


def main():
    folder = folder_with("work_precision", __doc__)
    with open(folder / "work_precision.csv") as file:
        rows = list(csv.DictReader(file))
    figure = Figure(figsize=(12, 7.5), layout="constrained")
    grid = figure.subplots(len(BOUNDARIES), len(REGIMES), sharey=True)
    for boundary, line in zip(BOUNDARIES, grid):
        for regime, axes in zip(REGIMES, line):
            number = "courant" if regime == "convective" else "viscous_courant"
            mine = sorted((row for row in rows if row["regime"] == regime
                           and row["boundary"] == boundary),
                          key=lambda row: (side(row), row["scheme"], int(row["steps"])))
            for (cells, scheme), group in groupby(mine, key=lambda row: (side(row), row["scheme"])):
                group = list(group)
                marker, style = STYLES[scheme]
                times, errors = zip(
                    *((float(row["run_time_s"]), float(row["velocity_error"])) for row in group))
                axes.loglog(times, errors, color=COLORS[cells], marker=marker, ls=style, ms=5,
                            lw=1.2, mfc="white" if scheme == "projection" else None)
                if regime != "none" and scheme == "coupled":
                    for end, place, align in ((0, (-6, 0), "right"), (-1, (0, -12), "center")):
                        axes.annotate(f"{float(group[end][number]):.3g}", (times[end], errors[end]),
                                      place,
                                      textcoords="offset points", size=8, color=COLORS[cells],
                                      ha=align, va="center")
            axes.margins(0.17, 0.1)
            axes.set_title(f"inertia {regime}, {boundary}" + " (one solve)" * (regime == "none"),
                           size=11)
            axes.grid(alpha=0.3)
    for axes in grid[-1]:
        axes.set_xlabel("run time on one core (s)")
    for line in grid:
        line[0].set_ylabel("relative rms error of the velocity")
    key = [Line2D([], [], color=color, lw=4, label=f"{cells}³ cells")
           for cells, color in COLORS.items()]
    key += [Line2D([], [], color="0.3", marker=marker, ls=style,
                   mfc="white" if name == "projection" else None,
                   label=f"scheme {name}") for name, (marker, style) in STYLES.items()]
    grid[0][0].legend(handles=key, fontsize=9, loc="lower left")
    figure.suptitle(
        "Manufactured flows; along a line the time step varies, its ends are labelled with "
        r"$\eta\,\Delta t/(\rho h^2)$ (unsteady), $u\,\Delta t/h$ (convective)", size=11)
    figure.savefig(folder / "work_precision.png", dpi=110)


if __name__ == "__main__":
    main()
