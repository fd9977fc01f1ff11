"""Drag of spheres that `drag` measures, drag.csv: prints the largest errors and draws drag.png,
error against resolution."""

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

STYLE = {"peskin4": "o-", "roma3": "s--"}


def main():
    folder = folder_with("drag", __doc__)
    rows = list(csv.DictReader(open(folder / "drag.csv")))
    settings = list(dict.fromkeys(row["setting"] for row in rows))
    figure, axes = plt.subplots(1, len(settings), figsize=(4.2 * len(settings), 3.8), sharey=True)
    for axis, setting in zip(axes, settings):
        parameters = list(
            dict.fromkeys(row["parameter"] for row in rows if row["setting"] == setting))
        for kernel, style in STYLE.items():
            for number, parameter in enumerate(parameters):
                of = [row for row in rows
                      if (row["setting"], row["parameter"], row["kernel"]) ==
                      (setting, parameter, kernel)]
                radius = [float(row["radius_over_dx"]) for row in of]
                error = [abs(float(row["error_percent"])) for row in of]
                name = "volume fraction" if setting == "array" else "a/l"
                axis.loglog(radius, error, style, color=f"C{number}",
                            label=f"{name} {parameter}, {kernel}")
                print(f"{setting:16} {parameter:>6} {kernel:8} "
                      + "  ".join(f"a/dx {r:.1f}: {e:.2f} %" for r, e in zip(radius, error)))
        axis.axhline(2, color="grey", linewidth=0.8)
        axis.set_title({"array": "simple cubic array (Zick & Homsy)"}.get(
            setting, f"{setting} (Faxén's series)"))
        axis.set_xlabel("hydrodynamic radius / dx")
        axis.legend(fontsize=7)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("error of the drag (%)")
    figure.tight_layout()
    figure.savefig(folder / "drag.png", dpi=110)


if __name__ == "__main__":
    main()
