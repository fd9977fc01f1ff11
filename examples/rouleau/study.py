#!/usr/bin/python3
"""A rouleau sheared at rising rates, with four works of adhesion: aggregates and energy of adhesion
over the strain, and the cells halfway through each rate. Runs in.rouleau (three minutes in all on
one core), writes rouleau.csv to a folder and draws rouleau.png there.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1]
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from rbc.tables import read_table  # noqa: E402

WORKS = 0.0, 3.0e-4, 1.0e-3, 3.0e-3    # pg/us^2 = mJ/m^2
MODULUS = 70    # of the contact over the work of adhesion, 1/um: the same gap and range for all
SHOWN = 0.0, 1.0e-3, 3.0e-3
RENDER = HERE.parents[1] / "scripts" / "render_cells.py"


def run(arguments, work, folder):
    """Columns of rouleau.dat, and a picture of the cells halfway through each shear rate."""
    done = example_study.run_script(arguments, HERE / "in.rouleau", folder,
                                    {"sigma": work,
                                     "K": MODULUS * (work or min(filter(None, WORKS)))})
    if done.returncode:
        sys.exit(done.stdout[-600:])
    shots = {}
    if work in SHOWN:
        for surfaces in sorted(Path(folder).glob("cells.*.vtp")):
            picture = surfaces.with_suffix(".png")
            subprocess.run([sys.executable, RENDER, surfaces, "-o", picture, "--view", "0", "0",
                            "--color", "aggregate",
                            "--box", "0", "40", "0", "16", "0", "32", "--plates"], check=True)
            shots[float(surfaces.name.split(".")[1])] = plt.imread(picture)
    return read_table(Path(folder) / "rouleau.dat"), shots


def draw(tables, shots, path):
    rates = sorted(next(iter(shots.values())))
    figure, axes = plt.subplots(1 + len(SHOWN), len(rates), figsize=(3.2 * len(rates), 11),
                                height_ratios=[1.1] + len(SHOWN) * [1])
    for column, rate in enumerate(rates):
        axis = axes[0][column]
        for work, table in tables.items():
            here = table["v_rate"] == rate
            axis.plot(np.linspace(0, 15, here.sum()), table["c_rouleau[1]"][here],
                      label=f"{1000 * work:g} µJ/m²")
        axis.set_title(f"{rate:g} /s")
        axis.set_xlabel("strain at this rate")
        axis.set_ylim(0, 8.5)
        axis.grid(alpha=0.3)
        for row, work in enumerate(SHOWN, 1):
            axes[row][column].imshow(shots[work][rate])
            axes[row][column].set_xticks([])
            axes[row][column].set_yticks([])
            if column == 0:
                axes[row][column].set_ylabel(f"{1000 * work:g} µJ/m²")
    axes[0][0].set_ylabel("aggregates of 8 cells")
    axes[0][0].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main():
    arguments = command_line.parse(example_study.options(__doc__), HERE)
    path = arguments.output / "rouleau.csv"
    tables, shots = {}, {}
    for work in WORKS:
        with tempfile.TemporaryDirectory() as folder:
            tables[work], shots[work] = run(arguments, work, folder)
    with open(path, "w", newline="", encoding="ascii") as stream:
        writer = csv.writer(stream)
        writer.writerow(("sigma_mN_m", "rate_1_s", "aggregates_mean", "aggregates_end",
                         "largest_end", "energy_end"))
        for work, table in tables.items():
            for rate in sorted(set(table["v_rate"]) - {0}):
                here = table["v_rate"] == rate
                writer.writerow((work, f"{rate:g}", f"{table['c_rouleau[1]'][here].mean():.3g}",
                                 *(f"{table[name][here][-1]:.3g}" for name in
                                   ("c_rouleau[1]", "c_rouleau[4]", "c_adhesion"))))
    draw(tables, {work: shots[work] for work in SHOWN}, arguments.output / "rouleau.png")
    print(path.read_text(encoding="ascii"))


if __name__ == "__main__":
    main()
