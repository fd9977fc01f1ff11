"""Pictures of runs of dense blood: sizes of aggregates, medians, paths; all cells, a cut-out and an
aggregate, colored by aggregate."""
import subprocess
import sys
from pathlib import Path

from rbc import command_line    # noqa: F401  before numpy, which may be missing
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import blood_runs  # noqa: E402
from rbc.aggregates import COLORS  # noqa: E402
from rbc.snapshots import surfaces  # noqa: E402
from rbc.surfaces import read_cell_ids, write_cells  # noqa: E402

RENDER = Path(__file__).resolve().parent / "render_cells.py"
WIDE = 26             # side of a cut-out, um
SKIN = 8              # from a side of the box to the centre of a cell that is seen, at most, um
MANY = 2000           # cells; with more those inside are left out of the picture of all
ROULEAU = 8           # cells of the aggregate that is shown by itself, at most


def latest(folder):
    """The last file of surfaces of a run."""
    return surfaces(folder)[-1][1]


def cut_out(folder, target):
    """A file with the cells in the middle of the last surfaces, the whole height of the box."""
    cells, middle = read_cell_ids(latest(folder)), blood_runs.box(folder) / 2
    within = (abs(cells.centres - middle)[:, :2] < WIDE / 2).all(axis=1)
    write_cells(latest(folder), target, cells.molecules[within])
    return target


def seen_from_outside(folder, target):
    """A file with the cells near the sides that the picture shows, or all if they are few."""
    cells, lengths = read_cell_ids(latest(folder)), blood_runs.box(folder)
    x, y, z = cells.centres.T
    near = (z > lengths[2] - SKIN) | (y < SKIN) | (x > lengths[0] - SKIN)
    write_cells(latest(folder), target, cells.molecules[near | (len(near) <= MANY)])
    return target


def rouleau(folder, target):
    """A file with the largest aggregate of few cells that no side of the box divides; None if
    there is none of two cells or more."""
    cells, lengths = read_cell_ids(latest(folder)), blood_runs.box(folder)
    best = []
    for name in np.unique(cells.aggregates):
        own = np.flatnonzero(cells.aggregates == name)
        extent = cells.highest[own].max(axis=0) - cells.lowest[own].min(axis=0)
        whole = len(own) == 1 or (extent[:2] < lengths[:2] / 2 + SKIN).all()
        if len(best) < len(own) <= ROULEAU and whole:
            best = own
    if len(best) < 2:
        return None
    write_cells(latest(folder), target, cells.molecules[best])
    return target


def rendered(surface, *options):
    png = surface.with_suffix(".png")
    subprocess.run([sys.executable, RENDER, surface, "-o", png, "--color", "aggregate", "--size",
                    "900x700", *options], check=True)
    return plt.imread(png)


def draw_cells(folders, path):
    """A column for each of {title: folder of a run}."""
    figure, rows = plt.subplots(3, len(folders), figsize=(4.4 * len(folders), 10),
                                layout="constrained", squeeze=False)
    for axes in rows.flat:
        axes.axis("off")
    for (all_cells, part, one), (title, folder) in zip(rows.T, folders.items()):
        outside = seen_from_outside(folder, folder / "seen.vtp")
        all_cells.imshow(rendered(outside, "--view", "20", "35"))
        all_cells.set_title(f"{title}: a color for each aggregate", fontsize=10)
        part.imshow(rendered(cut_out(folder, folder / "cut_out.vtp"), "--view", "20", "15"))
        part.set_title(f"{WIDE} um in the middle", fontsize=10)
        aggregate = rouleau(folder, folder / "rouleau.vtp")
        if aggregate:
            one.imshow(rendered(aggregate, "--view", "20", "15", "--scale-bar", "4"))
            one.set_title("one aggregate", fontsize=10)
    figure.savefig(path, dpi=110)


def draw_curves(cases, paper, path):
    """`cases`: {rate in 1/s: measures of study.py}; `paper`: {rate: ((sizes), share)}. Without
    medians over the rate where there is one rate."""
    many = len(cases) > 1
    panels = [["sizes", "medians"], ["fast", "slow"]] if many else [["sizes", "fast"]]
    figure, axes = plt.subplot_mosaic(panels, figsize=(11, 3.7 * len(panels)), layout="constrained")
    draw_sizes(axes["sizes"], cases, paper)
    draw_paths(axes["fast"], cases, max(cases, key=float))
    if many:
        draw_medians(axes["medians"], cases)
        draw_paths(axes["slow"], cases, min(cases, key=float))
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_paths(axes, cases, rate):
    axes.plot(*cases[rate]["paths"], lw=1)
    axes.set(xlabel="time (s)", ylabel="height of a cell / D", title=f"{rate} /s")


def draw_medians(axes, cases):
    rates = [float(rate) for rate in cases]
    axes.loglog(rates, [case["of_cells"] for case in cases.values()], "o-",
                label="aggregate of a cell, median over cells")
    axes.loglog(rates, [case["median"] for case in cases.values()], "s--",
                label="aggregates of two and more")
    largest = max(case["of_cells"] for case in cases.values())
    sizes = 2 ** np.arange(int(np.log2(largest)) + 2)
    axes.set(xlabel="shear rate (1/s)", ylabel="median size (cells)", ylim=(1, sizes[-1]))
    for axis, places in ((axes.xaxis, rates), (axes.yaxis, sizes)):
        axis.set_ticks([], minor=True)
        axis.set_ticks(places, [f"{place:g}" for place in places])
    axes.legend(frameon=False, fontsize=8)


def draw_sizes(axes, cases, paper):
    edges = max((case["classes"].edges for case in cases.values()), key=len)
    for n, (rate, case) in enumerate(cases.items()):
        places = np.arange(len(case["classes"].edges)) + 0.26 * (n - 1)
        axes.bar(places, 100 * case["classes"].fractions(False), 0.26, color=COLORS[n],
                 label=f"{rate} /s")
        if rate in paper:
            (size, _), share = paper[rate]
            axes.plot(np.log2(size) + 0.26 * (n - 1), 100 * share, "*", color=COLORS[n], ms=10,
                      mec="k", label=f"{rate} /s, paper")
    axes.set_xticks(range(len(edges)), [f"{edge:.0f}" for edge in edges], rotation=45)
    axes.set(xlabel="cells in the aggregate, from", ylabel="aggregates (%)", xlim=(0.4, None))
    axes.legend(frameon=False, fontsize=8)
