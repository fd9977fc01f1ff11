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
import shutil
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

TOP = HERE.parents[1]
SCRIPTS = TOP / "scripts"
RATES = 10, 60, 100                          # 1/s
KINDS = {"a": 2.0e-4, "r": 0.0}              # work of adhesion, mJ/m^2
WORDS = {"a": "adhesive", "r": "repulsive"}
NAMES = [f"{kind}{rate}" for kind in KINDS for rate in RATES]
OPTIONS = ("cells", "shape", "volume", "dx", "kernel", "courant",
           "seconds")                        # of this script that the input takes
SECONDS = "core_seconds.txt"                 # in the folder of a run
SETTLED = 10                                 # strain from which means are taken
REACH = 0.6                                  # gaps that count, um
PICTURES = 4                                 # of each run in which gaps are looked for


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


def logs(folder):
    """Of the pieces of a run."""
    return sorted(folder.glob("log.lammps*"))


def history(folder):
    """Tables of the logs of all pieces, one after the other; the first step of a piece is the last
    of the one before."""
    first, *others = [log_table(log) for log in logs(folder)]
    for table in others:
        table["f_ib[8]"] += first["f_ib[8]"][-1]    # counted from the start of each piece
        first = {name: np.concatenate([first[name], table[name][1:]]) for name in first}
    return first


def is_finished(folder):
    """Whether the last piece of the run went to its end."""
    return logs(folder) and "Wall time limit reached" not in logs(folder)[-1].read_text()


def box(log):
    """Lengths of the box of a LAMMPS log."""
    corner = re.search(r"^Created orthogonal box = \(0 0 0\) to \((.*)\)", log, re.MULTILINE)[1]
    return np.array(corner.split(), float)


def gaps(folder, lengths):
    """Least distances of neighboring cells in PICTURES files of surfaces, 0 where they cut each
    other; without that of the packing at the start if there are others."""
    files = surfaces(folder)[1:] or surfaces(folder)
    chosen = np.unique(np.linspace(len(files) - 1, 0, PICTURES, endpoint=False).round().astype(int))
    return [pair_distances(read_cells(files[n][1]), lengths, (True, True, False), REACH)
            for n in chosen]


def aggregate_sizes(path):
    """Cells in each aggregate of a file of surfaces."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    of_point = reader.GetOutput().GetPointData()
    cells = np.unique([vtk_to_numpy(of_point.GetArray(name)) for name in ("molecule", "aggregate")], axis=1)
    return np.unique(cells[1], return_counts=True)[1]


def aggregate_statistics(folder, cells, table, start):
    """Sizes of aggregates from a strain of `start` on."""
    strain, steps = table["v_sheared"], table["Step"]
    late = strain >= start
    classes = mean_classes(folder / "classes.dat", steps[late][0])
    shares = classes.fractions(False)
    sizes = np.concatenate([aggregate_sizes(name) for step, name in surfaces(folder)
                            if np.interp(step, steps, strain) >= start])
    return {
        "classes": classes,
        "median": np.median(sizes[sizes > 1]) if (sizes > 1).any() else np.nan,
        "of_cells": np.median(np.repeat(sizes, sizes)),
        "of_2_or_3": shares[classes.edges == 2].sum(),
        "of_4_to_7": shares[classes.edges == 4].sum(),
        "mean": cells / table["c_agg[1]"][late].mean(), "largest": table["c_agg[4]"][late].mean(),
        "singles": classes.aggregates[0] / cells}


def measure(folder):
    log = (folder / "log.lammps").read_text(encoding="utf-8")
    cells = int(re.search(r"^Created (\d+) cells", log, re.MULTILINE)[1])
    table, volumes = history(folder), read_ave_time(folder / "cell.dat").column(6)
    strain = table["v_sheared"]
    start = min(SETTLED, strain[-1] / 2)
    pairs = gaps(folder, box(log))
    return {
        "cells": cells, "strain": strain[-1], "hematocrit": table["v_filled"].min(),
        "core_seconds": float((folder / SECONDS).read_text(encoding="utf-8")),
        "again": table["f_ib[8]"][-1], "viscosity": table["v_relative"][strain >= start].mean(),
        **aggregate_statistics(folder, cells, table, start),
        "lost": cells - volumes.shape[1], "volume": abs(volumes / volumes[0] - 1).max(),
        "pictures": len(pairs), "least": min(p.min() for p in pairs),
        "cut": sum(int((p == 0).sum()) for p in pairs),
        "pairs": np.concatenate(pairs), "history": (strain, table["v_relative"]),
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
        axes["gaps"].stairs(100 * counts / counts.sum(), edges, color=color, linestyle=line, label=label)
        if name in bars:
            places = np.arange(len(case["classes"].edges)) + 0.26 * (bars.index(name) - 1)
            axes["sizes"].bar(places, 100 * case["classes"].fractions(False), 0.26, color=color, label=f"{name[1:]} /s")
    axes["viscosity"].set(xlabel="strain", ylabel="viscosity over that of plasma", ylim=(0, None))
    axes["sizes"].set(xlabel="cells in the aggregate, from", ylabel="aggregates (%)", xlim=(0.4, 8.6))
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
    """Runs in.suspension, or its next piece, in a folder, which keeps the seconds of processors
    that all pieces took."""
    folder.mkdir(parents=True, exist_ok=True)
    pieces = len(logs(folder))
    before = example_study.processor_seconds()
    variables = {"rate": name[1:], "sigma": KINDS[name[0]],
                 **{name: getattr(arguments, name) for name in OPTIONS},
                 "pieces": pieces}
    templates = Path(example_study.POTENTIALS)
    if not (templates / f"{arguments.shape}.mol").exists():
        templates = made_templates(folder.parent)
    done = example_study.run_script(arguments, HERE / "in.suspension", folder, variables, templates,
                                    log=f"log.lammps.{pieces + 1}" if pieces else "log.lammps")
    seconds = example_study.processor_seconds() - before
    if pieces:
        seconds += float((folder / SECONDS).read_text(encoding="utf-8"))
    (folder / SECONDS).write_text(f"{seconds:.1f}\n", encoding="utf-8")
    said = re.findall(r"^(?:ERROR|WARNING).*", done.stdout, re.MULTILINE)
    print(name, *said, sep="\n", flush=True)


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
