#!/usr/bin/python3
"""Frequency of tank-treading over the shear rate for two viscosities of the membrane, beside Fischer's cells.

Runs in.tank-treading at the six shear rates of the data (about 10 minutes on one core in all), writes
tank-treading.csv and draws tank-treading.png. With --draw only the picture and the numbers, from tank-treading.csv.
"""

import argparse
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from membrane_motion import angles, read_dump, revolutions  # noqa: E402

REFERENCE = HERE.parent / "reference" / "03b_ttf_fischer_28p9mPas_binned.csv"
VISCOSITIES = 600, 300
FROM = 20    # strain from which frequencies and angles count


def motion(folder, step, start=FROM):
    """Frequency over the shear rate, mean inclination in degrees and its range, of the strains from `start`."""
    steps, positions = read_dump(Path(folder) / "vertices.dump")
    strain = steps * step
    late = strain >= min(start, strain[-1] / 2)
    turns = revolutions(positions[late]).mean(axis=1)
    shape = np.degrees(angles(positions)[0][late])
    return (abs(turns[-1]) / (strain[late][-1] - strain[late][0]), (shape.mean() + 90) % 180 - 90,
            shape.max() - shape.min())


def measure(lmp, templates, rate, viscosity, step=0.05):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([lmp, "-in", HERE / "in.tank-treading", "-log", "none", "-screen", "out", "-var", "rate",
                               str(rate), "-var", "surface_viscosity", str(viscosity), "-var", "step", str(step), "-var",
                               "templates", templates], cwd=folder, check=False)
        if done.returncode:
            print((Path(folder) / "out").read_text()[-400:])
        return motion(folder, step)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=HERE.parents[1] / "build" / "lmp_rbc")
    parser.add_argument("--draw", action="store_true", help="do not run")
    options = parser.parse_args()
    with open(REFERENCE, encoding="utf-8") as stream:
        data = np.array([[float(word) for word in line.split(",")] for line in stream if line[0].isdigit()])
    table = HERE / "tank-treading.csv"
    if not options.draw:
        with open(table, "w", encoding="utf-8") as stream:
            stream.write("eta_m,rate_1_s,f_over_rate,inclination_deg,range_deg\n")
            for viscosity in VISCOSITIES:
                for rate in data[:, 0]:
                    found = measure(options.lmp, HERE.parents[1] / "potentials", rate, viscosity)
                    stream.write(",".join(f"{value:.5g}" for value in (viscosity, rate, *found)) + "\n")
                    stream.flush()
    with open(table, encoding="utf-8") as stream:
        rows = np.array([[float(word) for word in row] for row in list(csv.reader(stream))[1:]])

    figure, axis = plt.subplots(figsize=(7, 4.6))
    axis.errorbar(data[:, 0], data[:, 1], data[:, 2], fmt="ok", capsize=3, label="Fischer, 28.9 mPa s: mean, s.d. over cells")
    axis.fill_between(data[:, 0], 0.8 * data[:, 1], 1.2 * data[:, 1], alpha=0.12, color="k", label="within 20 %")
    for n, viscosity in enumerate(VISCOSITIES):
        mine = rows[rows[:, 0] == viscosity]
        axis.plot(mine[:, 1], mine[:, 2], "s-v-"[2 * n:2 * n + 2], color=f"C{n}", label=f"η_m = {viscosity} pg/µs")
        for row in mine:
            measured = data[np.argmin(abs(data[:, 0] - row[1])), 1]
            print(f"eta_m {viscosity}, {row[1]:7.2f} /s: f/rate {row[2]:.4f}, data {measured:.4f} "
                  f"({100 * (row[2] / measured - 1):+.0f} %), angle {row[3]:.1f} deg, "
                  + ("tank-treads" if row[4] < 90 else "tumbles"))
    axis.set_xscale("log")
    axis.set_xlabel("shear rate / (1/s)")
    axis.set_ylabel("revolutions per strain")
    axis.set_ylim(0, 0.07)
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(HERE / "tank-treading.png", dpi=110)


if __name__ == "__main__":
    main()
