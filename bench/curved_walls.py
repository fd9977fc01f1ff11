"""Errors at curved walls that `curved_walls` measures, curved_walls.csv: prints them and draws
curved_walls.png, error against resolution."""

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

TITLES = {"array": "drag of spheres in a cubic array,\nby volume fraction",
          "tube": "flow rate in a tube,\ndriven inside (0) or everywhere (1)",
          "sphere in tube": "drag of a sphere held in a tube,\nby a/R"}
KEYS = "setting", "parameter", "kernel", "kind"
LINES = {"points": "--", "sheets": "-"}
MARKS = {"roma3": "o", "peskin4": "s"}


def main():
    folder = folder_with("curved_walls", __doc__)
    with open(folder / "curved_walls.csv", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    figure, axes = plt.subplots(1, 3, figsize=(12, 4), sharey=True, constrained_layout=True)
    for axis, (setting, title) in zip(axes, TITLES.items()):
        parameters = dict.fromkeys(row["parameter"] for row in rows if row["setting"] == setting)
        for number, parameter in enumerate(parameters):
            for kernel, mark in MARKS.items():
                for kind, line in LINES.items():
                    wanted = (setting, parameter, kernel, kind)
                    of = [row for row in rows if tuple(row[name] for name in KEYS) == wanted]
                    radius = [float(row["radius_over_dx"]) for row in of]
                    error = [float(row["error_percent"]) for row in of]
                    label = parameter if (kernel, kind) == ("roma3", "sheets") else None
                    axis.loglog(radius, [abs(e) for e in error], mark + line, color=f"C{number}",
                                markersize=4, label=label)
                    print(f"{setting:15} {parameter:>7} {kernel:8} {kind:7}"
                          + "".join(f"  R/dx {r:g}: {e:.2f} %" for r, e in zip(radius, error)))
        axis.set(title=title, xlabel="radius / dx")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[0].set_ylabel("error (%): sheets solid, points dashed;\ncircles roma3, squares peskin4")
    figure.savefig(folder / "curved_walls.png", dpi=120)


if __name__ == "__main__":
    main()
