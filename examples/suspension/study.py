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
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from blood_runs import box, history, is_finished, measures, run_piece, said  # noqa: E402
from rbc.aggregates import COLORS  # noqa: E402
from rbc.snapshots import surfaces  # noqa: E402
from rbc.surface_distances import pair_distances  # noqa: E402
from rbc.surfaces import read_cells  # noqa: E402

TOP = HERE.parents[1]
SCRIPTS = TOP / "scripts"
RATES = 10, 60, 100                          # 1/s
KINDS = {"a": 2.0e-4, "r": 0.0}              # work of adhesion, mJ/m^2
WORDS = {"a": "adhesive", "r": "repulsive"}
NAMES = [f"{kind}{rate}" for kind in KINDS for rate in RATES]
OPTIONS = ("cells", "shape", "volume", "dx", "kernel", "courant",
           "seconds")                        # of this script that the input takes
SETTLED = 10                                 # strain from which means are taken
REACH = 0.6                                  # gaps that count, um
PICTURES = 4                                 # of each run in which gaps are looked for
SMALL_BOX = {"cells": 32, "gap": 15, "strain": 5, "frames": 1000000}    # of the other scripts
VOLUMES = {"rbc_162": 89.30, "rbc_362": 91.90, "rbc_642": 92.84, "rbc_1442": 93.52,
           "rbc_2562": 93.75}                # of cells as meshed, um^3


def gaps(folder, lengths):
    """Least distances of neighboring cells in PICTURES files of surfaces, 0 where they cut each
    other; without that of the packing at the start if there are others."""
    files = surfaces(folder)[1:] or surfaces(folder)
    chosen = np.unique(np.linspace(len(files) - 1, 0, PICTURES, endpoint=False).round().astype(int))
    return [pair_distances(read_cells(files[n][1]), lengths, (True, True, False), REACH)
            for n in chosen]


def measure(folder):
    table, pairs = history(folder), gaps(folder, box(folder))
    return {
        **measures(folder, SETTLED),
        "pictures": len(pairs), "least": min(p.min() for p in pairs),
        "cut": sum(int((p == 0).sum()) for p in pairs),
        "pairs": np.concatenate(pairs), "history": (table["v_sheared"], table["v_relative"]),
    }


def write(cases, path):
    columns = [name for name, value in next(iter(cases.values())).items() if np.isscalar(value)]
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
    bars = [name for name in cases if name[0] == "a"] or list(cases)
    for name, case in cases.items():
        color, line = COLORS[RATES.index(int(name[1:]))], "-" if name[0] == "a" else "--"
        label = f"{name[1:]} /s, {WORDS[name[0]]}"
        axes["viscosity"].plot(*case["history"], line, color=color, label=label)
        counts, edges = np.histogram(case["pairs"], np.arange(0, REACH + 0.01, 0.04))
        axes["gaps"].stairs(100 * counts / counts.sum(), edges, color=color, linestyle=line,
                            label=label)
        if name in bars:
            places = np.arange(len(case["classes"].edges)) + 0.26 * (bars.index(name) - 1)
            axes["sizes"].bar(places, 100 * case["classes"].fractions(False), 0.26, color=color,
                              label=f"{name[1:]} /s")
    axes["viscosity"].set(xlabel="strain", ylabel="viscosity over that of plasma", ylim=(0, None))
    axes["sizes"].set(xlabel="cells in the aggregate, from", ylabel="aggregates (%)",
                      xlim=(0.4, 8.6))
    axes["gaps"].set(xlabel="least gap of two neighbors (um)", ylabel="pairs (%)")
    for name in ("viscosity", "sizes", "gaps"):
        axes[name].legend(frameon=False, fontsize=8)
    for case, picture in pictures.items():
        axes[case].axis("off")
        axes[case].imshow(plt.imread(picture))
        axes[case].set_title(f"{case}: a color for each aggregate", fontsize=10)
    figure.savefig(path, dpi=110)


def made_templates(folder):
    """A folder of templates, with those that the package does not ship."""
    templates = folder / "templates"
    if not templates.exists():
        shutil.copytree(TOP / "potentials", templates,
                        ignore=shutil.ignore_patterns("*.py", "__pycache__"))
        subprocess.run([TOP / "potentials" / "make_template.py", "disc", "--diameter", "7.82",
                        "--frequency", "12", "--output", templates / "rbc_1442.mol"], check=True,
                       stdout=subprocess.DEVNULL)
    return templates


def run_case(arguments, name, folder):
    """Runs in.suspension, or its next piece, in a folder."""
    variables = {"rate": name[1:], "sigma": KINDS[name[0]],
                 **{name: getattr(arguments, name) for name in OPTIONS}}
    templates = Path(example_study.POTENTIALS)
    if not (templates / f"{arguments.shape}.mol").exists():
        templates = made_templates(folder.parent)
    print(name, *said(run_piece(arguments, folder, variables, templates)), sep="\n", flush=True)


def draw_cells(folder):
    """Path of a picture of the last surfaces in a folder."""
    path = folder / "last.png"
    subprocess.run([sys.executable, SCRIPTS / "render_cells.py", surfaces(folder)[-1][1],
                    "-o", path, "--color", "aggregate", "--view", "20", "15", "--size", "900x900",
                    "--zoom", "1.2"], check=True)
    return path


def options():
    parser = example_study.options(__doc__, NAMES)
    example_study.add_runs_folder(parser)
    parser.add_argument("--cells", type=int, default=512)
    parser.add_argument("--shape", default="rbc_162")
    parser.add_argument("--volume", type=float, default=89.30, help="of the shape as meshed, um^3")
    parser.add_argument("--dx", type=float, default=0.8)
    parser.add_argument("--kernel", default="roma3")
    parser.add_argument("--courant", type=float, default=1)
    parser.add_argument("--seconds", type=int, default=0,
                        help="that a run may take; the next call goes on from its end")
    return parser


def main():
    arguments = command_line.parse(options(), HERE)
    folder = example_study.runs_folder(arguments)
    for name in NAMES:
        if example_study.wanted(arguments, name) and not is_finished(folder / name):
            run_case(arguments, name, folder / name)
    names = [name for name in NAMES if (folder / name / "log.lammps").exists()]
    cases = {name: measure(folder / name) for name in names}
    for name, case in cases.items():
        print(name, {key: value for key, value in case.items() if np.isscalar(value)}, flush=True)
    shown = [name for name in names if name[0] == "a"] or names
    pictures = {f"{name[1:]} /s, {WORDS[name[0]]}": draw_cells(folder / name) for name in shown}
    write(cases, arguments.output / "suspension.csv")
    draw(cases, pictures, arguments.output / "suspension.png")


if __name__ == "__main__":
    main()
