"""Resistances of rigid spheres near a plate and near each other that `near_spheres` measures: adds
what they are in a fluid without a grid to near_spheres.csv, prints the errors and draws
near_spheres.png, error against the gap."""

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
from sphere_resistance import MOTIONS, resistance  # noqa: E402

REFERENCE = HERE.parent / "examples" / "reference"
LINES = {"points": "--", "sheets": "-"}
MARKS = {"roma3": "o", "peskin4": "s"}


def check_published():
    """Prints by how much the exact values differ from those that others have published."""
    for name, column, motion in (("05c_sphere_near_one_wall", "lambda_perp_exact", "apart"),
                                 ("05c2_goldman_cox_brenner_parallel", "F_t_memory", "past")):
        with open(REFERENCE / f"{name}.csv", encoding="utf-8") as table:
            rows = csv.DictReader(line for line in table if not line.startswith("#"))
            off = [resistance(motion, float(row["h_over_a"]) - 1, True) / float(row[column]) - 1
                   for row in rows]
        print(f"{name}: the reference differs by at most {max(map(abs, off)):.1e}")


def with_errors(path):
    """The table's rows, with the reference and the error in percent, also written to it."""
    with open(path, encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    known = {}
    for row in rows:
        gap = float(row["gap_over_dx"]) / float(row["radius_over_dx"])
        key = row["motion"], gap, row["near"] == "plate"
        known[key] = known.get(key) or resistance(*key)
        row["reference"] = f"{known[key]:.4f}"
        found = row["resistance"]    # none: it did not converge
        row["error_percent"] = f"{100 * (float(found) / known[key] - 1):.1f}" if found else ""
    with open(path, "w", encoding="utf-8", newline="") as table:
        writer = csv.DictWriter(table, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return rows


def lines(rows):
    """Gaps and errors by what was measured."""
    found = {}
    for row in rows:
        key = tuple(row[name] for name in ("near", "motion", "kernel", "kind", "radius_over_dx"))
        error = float(row["error_percent"] or "nan")
        found.setdefault(key, []).append((float(row["gap_over_dx"]), error))
    return found


def main():
    folder = folder_with("near_spheres", __doc__)
    check_published()
    found = lines(with_errors(folder / "near_spheres.csv"))
    figure, axes = plt.subplots(2, 4, figsize=(13, 6), sharex=True, sharey=True,
                                constrained_layout=True)
    for (near, motion, kernel, kind, radius), errors in found.items():
        print(f"{near:6} {motion:14} {kernel:7} {kind:6} radius {radius:>2} dx"
              + "".join(f"  gap {gap:g}: {error:.1f} %" for gap, error in errors))
        axis = axes["sphere plate".split().index(near)][MOTIONS.index(motion)]
        axis.plot(*zip(*errors), MARKS[kernel] + LINES[kind], markersize=4,
                  color="C0" if radius == "5" else "C1",
                  label=f"radius {radius} dx" if (kernel, kind) == ("roma3", "sheets") else None)
        axis.axhspan(-10, 10, color="0.93", zorder=0)
        axis.set(xscale="log", title=f"near a {near}: {motion}")
    for axis in axes.flat:
        axis.set_yscale("symlog", linthresh=10)
        axis.grid(alpha=0.3)
    for axis in axes[1]:
        axis.set_xlabel("gap / dx")
    for axis in axes[:, 0]:
        axis.set_ylabel("error (%): sheets solid, points\ndashed; circles roma3, squares peskin4")
    axes[0][0].legend(fontsize=8)
    figure.savefig(folder / "near_spheres.png", dpi=110)


if __name__ == "__main__":
    main()
