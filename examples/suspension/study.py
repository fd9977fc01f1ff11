#!/usr/bin/python3
"""Blood sheared at 10, 60 and 100 /s, with adhesion and without: runs in.suspension in a folder for
each case, and draws the relative viscosity, the sizes of aggregates as Figure 12 of the paper, the
gaps between cells, and the cells.

study.py --output FOLDER --ranks 2      # cases of which the folder is there already are not run
again

Folders may hold runs of different numbers of cells.

Writes suspension.csv and suspension.png to FOLDER, where the runs are, too, without --folder.
--only names cases: a10, a60, a100 adhesive, r10, r60, r100 repulsive.
"""
import csv
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader  # noqa: E402
import example_study  # noqa: E402
from plot_aggregates import COLORS, mean_classes  # noqa: E402
from read_ave_time import read_ave_time  # noqa: E402
from snapshots import surfaces  # noqa: E402
from surface_distances import pair_distances  # noqa: E402
from surface_gaps import read_cells  # noqa: E402

SCRIPTS = HERE.parents[1] / "scripts"
RATES = 10, 60, 100                          # 1/s
KINDS = {"a": 2.0e-4, "r": 0.0}              # work of adhesion, mJ/m^2
NAMES = {"a": "adhesive", "r": "repulsive"}
VOLUME, HEMATOCRIT, GAP = 93.53, 0.45, 30    # of in.suspension
SETTLED = 10                                 # strain from which means are taken
REACH = 0.6                                  # gaps that count, um


def log_table(path):
    """Columns by name of the table in a LAMMPS log; a line cut short at the end is left out."""
    lines = path.read_text(encoding="utf-8").splitlines()
    start = next(n for n, line in enumerate(lines) if line.split()[:1] == ["Step"])
    names = lines[start].split()
    rows = []
    for line in lines[start + 1:]:
        if not re.fullmatch(r"[-+.\deE\s]+", line) or len(line.split()) != len(names):
            break
        rows.append(line.split())
    return dict(zip(names, np.array(rows, dtype=float).T))


def gaps(folder, cells):
    """Least distances of neighboring cells in all files of surfaces, 0 where they cut each
    other."""
    edge = (cells * VOLUME / HEMATOCRIT / GAP)**0.5
    return [pair_distances(read_cells(name), np.array([edge, edge, GAP]), (True, True, False), REACH)
            for _, name in surfaces(folder)]


def aggregate_sizes(path):
    """Cells in each aggregate of a file of surfaces."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    of_point = reader.GetOutput().GetPointData()
    cells = np.unique([vtk_to_numpy(of_point.GetArray(name)) for name in ("molecule", "aggregate")], axis=1)
    return np.unique(cells[1], return_counts=True)[1]


def measure(folder):
    cells = int(re.search(r"^Created (\d+) cells", (folder / "log.lammps").read_text(encoding="utf-8"), re.MULTILINE)[1])
    table, history = log_table(folder / "log.lammps"), read_ave_time(folder / "cell.dat")
    strain, steps = table["v_sheared"], table["Step"]
    start = min(SETTLED, strain[-1] / 2)
    late = strain >= start
    volumes = history.column(6)
    classes = mean_classes(folder / "classes.dat", steps[late][0])
    sizes = np.concatenate([aggregate_sizes(name) for step, name in surfaces(folder)
                            if np.interp(step, steps, strain) >= start])
    pairs = gaps(folder, cells)
    pairs = pairs[1:] or pairs    # without the packing at the start
    return {
        "cells": cells, "strain": strain[-1], "viscosity": table["v_relative"][late].mean(), "classes": classes,
        "median": np.median(sizes[sizes > 1]), "of_cells": np.median(np.repeat(sizes, sizes)),
        "singles": classes.aggregates[0] / cells,
        "mean": cells / table["c_agg[1]"][late].mean(), "largest": table["c_agg[4]"][late].mean(),
        "lost": cells - volumes.shape[1], "volume": abs(volumes / volumes[0] - 1).max(),
        "least": min(p.min() for p in pairs), "cut": sum(int((p == 0).sum()) for p in pairs),
        "pairs": np.concatenate(pairs), "history": (strain, table["v_relative"]),
    }


def write(cases, path):
    columns = "cells", "strain", "viscosity", "median", "of_cells", "mean", "largest", "singles", "lost", "volume", "least", "cut"
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", *columns])
        for name, case in cases.items():
            writer.writerow([name, *(f"{float(case[column]):.4g}" for column in columns)])


def draw(cases, pictures, path):
    figure = plt.figure(figsize=(13, 9.4), layout="constrained")
    curves, cells = figure.subfigures(2, 1, height_ratios=(3, 4))
    axes = curves.subplot_mosaic([["viscosity", "sizes", "gaps"]])
    axes.update(cells.subplot_mosaic([list(pictures)]))
    axes["sizes"].set_xticks(range(10), [str(2**n) for n in range(10)])
    bars = [name for name in cases if name[0] == "a"]
    for name, case in cases.items():
        color, line = COLORS[RATES.index(int(name[1:]))], "-" if name[0] == "a" else "--"
        label = f"{name[1:]} /s, {NAMES[name[0]]}"
        axes["viscosity"].plot(*case["history"], line, color=color, label=label)
        counts, edges = np.histogram(case["pairs"], np.arange(0, REACH + 0.01, 0.04))
        axes["gaps"].stairs(100 * counts / counts.sum(), edges, color=color, linestyle=line, label=label)
        if name in bars:
            places = np.arange(len(case["classes"].edges)) + 0.26 * (bars.index(name) - 1)
            axes["sizes"].bar(places, 100 * case["classes"].fractions(False), 0.26, color=color, label=f"{name[1:]} /s")
    axes["viscosity"].set(xlabel="strain", ylabel="viscosity over that of plasma", ylim=(0, None))
    axes["sizes"].set(xlabel="cells in the aggregate, from", ylabel="aggregates (%)", xlim=(0.4, 8.6))
    axes["gaps"].set(xlabel="least gap of two neighbors (um)", ylabel="pairs (%)")
    for name in ("viscosity", "sizes", "gaps"):
        axes[name].legend(frameon=False, fontsize=8)
    for rate, picture in pictures.items():
        axes[rate].axis("off")
        axes[rate].imshow(plt.imread(picture))
        axes[rate].set_title(f"{rate} /s, adhesive: a color for each aggregate", fontsize=10)
    figure.savefig(path, dpi=110)


def main():
    parser = example_study.options(__doc__, [f"{kind}{rate}" for kind in KINDS for rate in RATES])
    example_study.add_runs_folder(parser)
    parser.add_argument("--cells", type=int, default=512)
    arguments = command_line.parse(parser, HERE)
    arguments.folder = example_study.runs_folder(arguments)
    cases, pictures = {}, {}
    for kind, work in KINDS.items():
        for rate in RATES:
            name, folder = f"{kind}{rate}", arguments.folder / f"{kind}{rate}"
            if not (folder / "log.lammps").exists():
                if not example_study.wanted(arguments, name):
                    continue
                folder.mkdir(parents=True, exist_ok=True)
                command = [arguments.lmp, "-in", HERE / "in.suspension", "-var", "templates", example_study.POTENTIALS,
                           "-var", "rate", str(rate), "-var", "sigma", str(work), "-var", "cells", str(arguments.cells)]
                if arguments.ranks > 1:
                    command = ["mpirun", "-np", str(arguments.ranks), *command]
                subprocess.run(command, cwd=folder, check=False, stdout=subprocess.DEVNULL)
            cases[name] = measure(folder)
            print(name, {key: value for key, value in cases[name].items() if np.isscalar(value)}, flush=True)
            if kind == "a":
                pictures[str(rate)] = folder / "last.png"
                subprocess.run([sys.executable, SCRIPTS / "render_cells.py", surfaces(folder)[-1][1], "-o", pictures[str(rate)],
                                "--color", "aggregate", "--view", "20", "15", "--size", "900x900", "--zoom", "1.2"],
                               check=True)
    write(cases, arguments.output / "suspension.csv")
    draw(cases, pictures, arguments.output / "suspension.png")


if __name__ == "__main__":
    main()
