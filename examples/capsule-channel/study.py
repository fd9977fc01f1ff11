#!/usr/bin/python3
"""A capsule in a tube: speed and outline over a/R and the capillary number, and the stiff limit
against the exact one.

Runs in.capsule-channel for a list of cases, writes capsule-channel.csv and outlines.csv to a
folder, and once it has all cases draws outline.png (as Figure 3 of the paper) and
capsule-channel.png. Cases that its capsule-channel.csv already holds are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only size Ca stiff]
"""
import csv
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = str(HERE.parents[1] / "scripts"), str(HERE.parents[1] / "potentials")
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
from example_study import POTENTIALS, options, run_cases, run_script  # noqa: E402
from molecule_file import read_molecule  # noqa: E402
from rbc.tables import read_table  # noqa: E402

COLUMNS = "a/R", "Ca", "cells", "time", "U", "length", "width", "pressure", "change"
BASE = dict(ratio=0.85, Ca=0.015, cells=20)
RIGID = {0.75: 1.346049, 0.8: 1.275486, 0.85: 1.205191, 0.9: 1.135625}    # exact, ../reference/04c
SIZES = tuple(RIGID)
NUMBERS = 0.005, 0.015, 0.03, 0.05, 0.1
FINER = 12, 16, 24
STIFF = dict(Ca=0.001, duration=0.6, length=5)
MODES = 16    # Legendre polynomials of an outline
FLOW = "flow.npz"
OUTLINES = "outlines.csv"


def label(variables):
    return f"a/R {variables['ratio']:g}, Ca {variables['Ca']:g}, {variables['cells']} cells"


def softer(number):
    """The softest take longer to become steady, if they do. Their edges grow to twice their length
    and more: on a finer grid fluid would go between the vertices."""
    return dict(BASE, Ca=number, **(dict(duration=6, length=7, cells=14) if number >= 0.05 else {}))


def cases():
    """(name of the series, label, variables) of every run."""
    for name, several in (("size", [dict(BASE, ratio=ratio) for ratio in SIZES]),
                          ("Ca", [softer(number) for number in NUMBERS if number != BASE["Ca"]]),
                          ("stiff", [{**BASE, **STIFF, "ratio": ratio, "cells": cells}
                                     for ratio in SIZES for cells in FINER])):
        for variables in several:
            yield name, label(variables), variables


def read_dump(path):
    """Box, and rows of a LAMMPS dump."""
    lines = Path(path).read_text(encoding="ascii").splitlines()
    first = next(n for n, line in enumerate(lines)
                 if line.startswith(("ITEM: ATOMS", "ITEM: GRID CELLS"))) + 1
    bounds = next(n for n, line in enumerate(lines) if line.startswith("ITEM: BOX BOUNDS")) + 1
    box = np.array([line.split() for line in lines[bounds:bounds + 3]], dtype=float)
    return box, np.array([line.split() for line in lines[first:]], dtype=float)


def outline(path, shape="capsule_2562", tube=2.0):
    """x and r of the meridian, over the radius of the tube, from the middle of the capsule; rms
    distance of the vertices from it. Front at the right. A series in the angle that a vertex had on
    the sphere, so that the back may be hollow."""
    x = read_dump(path)[1][:, 1:4] / tube
    place = read_molecule(Path(POTENTIALS) / f"{shape}.mol")[0]
    cosine = place[:, 0] / np.linalg.norm(place, axis=1)
    sine = np.sqrt(1 - cosine**2)
    along, across = x[:, 0] - (x[:, 0].min() + x[:, 0].max()) / 2, np.hypot(x[:, 1], x[:, 2])
    basis = np.polynomial.legendre.legvander(cosine, MODES)
    ahead = np.linalg.lstsq(basis, along, rcond=None)[0]
    outward = np.linalg.lstsq(basis * sine[:, None], across, rcond=None)[0]
    off = np.hypot(along - basis @ ahead, across - sine * (basis @ outward))
    angle = np.linspace(0, np.pi, 81)
    basis = np.polynomial.legendre.legvander(np.cos(angle), MODES)
    return basis @ ahead, np.sin(angle) * (basis @ outward), np.sqrt(np.mean(off**2))


def slice_of_flow(path, tube=2.0, mean=1.0):
    """Streamwise velocity over the mean in the plane through the axis, and the coordinates over the
    tube's diameter."""
    lines = Path(path).read_text(encoding="ascii").splitlines()
    counts = next(n for n, line in enumerate(lines) if line.startswith("ITEM: GRID SIZE")) + 1
    nx, ny, nz = map(int, lines[counts].split())
    box, values = read_dump(path)
    velocity = values.reshape(nz, ny, nx)
    middle = (velocity[nz // 2 - 1] + velocity[nz // 2]) / 2 / mean
    x, y = (low + (np.arange(n) + 0.5) * (high - low) / n for n, (low, high) in zip((nx, ny), box))
    return middle, x / (2 * tube), y / (2 * tube)


def measure(folder, variables):
    """A row of COLUMNS: the mean over the last tenth of the run, and the change of the speed in
    it."""
    table = read_table(Path(folder) / "capsule.dat")
    last = table["v_time"] > 0.9 * table["v_time"][-1]
    values = [table[name][last].mean() for name in ("v_U", "v_long", "v_width", "v_pressure")]
    return [variables["ratio"], variables["Ca"], variables["cells"], table["v_time"][-1], *values,
            np.ptp(table["v_U"][last])]


def run(arguments, variables):
    with tempfile.TemporaryDirectory() as folder:
        done = run_script(arguments, HERE / "in.capsule-channel", folder, variables)
        if done.returncode:
            sys.exit(done.stdout[-600:])
        if variables["Ca"] != STIFF["Ca"]:
            keep_outline(arguments.output / OUTLINES, label(variables),
                         Path(folder) / "capsule.dump")
        if variables == BASE:
            keep_flow(arguments.output / FLOW, Path(folder))
        return [measure(folder, variables)]


def keep_flow(path, folder, tube=2.0):
    velocity, x, y = slice_of_flow(folder / "flow.dump", tube)
    ends = read_dump(folder / "capsule.dump")[1][:, 1] / (2 * tube)
    np.savez_compressed(path, velocity=velocity.astype(np.float32), x=x, y=y,
                        centre=(ends.min() + ends.max()) / 2)


def keep_outline(path, name, dump):
    new = not path.exists()
    x, r, rough = outline(dump)
    with open(path, "a", newline="", encoding="ascii") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        if new:
            writer.writerow(("case", "x/R", "r/R", "rms distance of vertices"))
        writer.writerows((name, f"{a:.5f}", f"{b:.5f}", f"{rough:.1e}") for a, b in zip(x, r))


def outlines(path):
    found = {}
    with open(path, encoding="ascii") as stream:
        for row in csv.DictReader(stream):
            found.setdefault(row["case"], []).append((float(row["x/R"]), float(row["r/R"])))
    return {name: np.array(rows).T for name, rows in found.items()}


def draw_outline(folder):
    """The counterpart of the paper's Figure 3: velocity over its mean, and the outline, in
    diameters of the tube."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    flow = np.load(folder / FLOW)
    x, r = outlines(folder / OUTLINES)[label(BASE)]
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(8, 6.2), height_ratios=[1, 1.15])
    period = flow["x"][0] + flow["x"][-1]
    along = (flow["x"] - flow["centre"] + period / 2) % period - period / 2
    order = np.argsort(along)
    shade = top.contourf(along[order], flow["y"], flow["velocity"][:, order], np.linspace(0, 2, 21),
                         cmap="viridis")
    figure.colorbar(shade, ax=top, label="velocity / mean", ticks=[0, 0.5, 1, 1.5, 2])
    top.plot(np.r_[x, x[::-1]] / 2, np.r_[r, -r[::-1]] / 2, "w", lw=1.5)
    top.set(aspect="equal", xlim=(-1, 1), ylim=(-0.5, 0.5), xlabel="x / D", ylabel="y / D",
            title="(a) streamwise velocity in a plane through the axis")
    angle = np.linspace(0, 2 * np.pi, 200)
    bottom.plot(BASE["ratio"] / 2 * np.cos(angle), BASE["ratio"] / 2 * np.sin(angle), "--",
                color="0.6", label="at rest")
    bottom.plot(np.r_[x, x[::-1]] / 2, np.r_[r, -r[::-1]] / 2, color="#b3202a",
                label="carried at Ca = 0.015")
    for wall in (-0.5, 0.5):
        bottom.axhline(wall, color="k", lw=2)
    bottom.annotate("", (0.72, 0), (0.52, 0), arrowprops=dict(arrowstyle="->"))
    bottom.set(aspect="equal", xlim=(-1, 1), ylim=(-0.55, 0.55), xlabel="x / D", ylabel="y / D",
               title="(b) outline, a/R = 0.85")
    bottom.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
    figure.tight_layout()
    figure.savefig(folder / "outline.png", dpi=90)


def draw_study(table, folder):
    """Speed over a/R, with the exact stiff limit; over Ca; outlines."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 2, figsize=(10, 7.4))
    (left, right), (sizes, numbers) = axes
    left.plot(*zip(*RIGID.items()), "k-", label="rigid sphere, exact")
    for cells, mark in zip(FINER, "v^s"):
        rows = [table[label({**BASE, **STIFF, "ratio": ratio, "cells": cells})][0]
                for ratio in SIZES]
        left.plot(SIZES, [row[4] for row in rows], mark, mfc="none", color="#2a6fb0",
                  label=f"Ca = 0.001, R / dx = {cells}")
    left.plot(SIZES, [table[label(dict(BASE, ratio=ratio))][0][4] for ratio in SIZES], "o-",
              color="#b3202a", label="Ca = 0.015, R / dx = 20")
    left.set(xlabel="a / R", ylabel="speed / mean velocity")
    rows = [table[label(softer(number))][0] for number in NUMBERS]
    right.semilogx(NUMBERS, [row[5] for row in rows], "o-", label="length / 2a")
    right.semilogx(NUMBERS, [row[6] for row in rows], "s-", label="width / 2a")
    right.semilogx(NUMBERS, [row[4] for row in rows], "^-", label="speed / mean velocity")
    right.set(xlabel="Ca = viscosity x mean velocity / E$_s$", title="a/R = 0.85")
    shapes = outlines(folder / OUTLINES)
    for axis, several, name in ((sizes, [dict(BASE, ratio=ratio) for ratio in SIZES], "ratio"),
                                (numbers, [softer(number) for number in NUMBERS], "Ca")):
        for n, variables in enumerate(several):
            x, r = shapes[label(variables)]
            axis.plot(np.r_[x, x[::-1]], np.r_[r, -r[::-1]],
                      color=plt.cm.plasma(0.85 * n / (len(several) - 1)),
                      label=f"{'a/R' if name == 'ratio' else name} = {variables[name]:g}")
        for wall in (-1, 1):
            axis.axhline(wall, color="k", lw=2)
        axis.set(aspect="equal", xlabel="x / R (flow to the right)", ylabel="y / R",
                 xlim=(-1.5, 1.5), ylim=(-1.1, 1.1))
    for axis in axes.flat:
        axis.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(folder / "capsule-channel.png", dpi=90)


def report(table):
    for name, row in table.items():
        print(f"{name}: U {row[0][4]:.4f}, length {row[0][5]:.4f}, width {row[0][6]:.4f}, pressure "
              f"{row[0][7]:.4f}")
    for ratio, exact in RIGID.items():
        speeds = [table[label({**BASE, **STIFF, "ratio": ratio, "cells": cells})][0][4]
                  for cells in FINER]
        best = ((FINER[-1]**2 * speeds[-1] - FINER[-2]**2 * speeds[-2]) /
                (FINER[-1]**2 - FINER[-2]**2))
        print(f"a/R {ratio}: exact {exact:.4f}, errors",
              *(f"{100 * (speed / exact - 1):+.2f}" for speed in speeds),
              f"%, extrapolated in dx² {100 * (best / exact - 1):+.2f} %")


def main():
    arguments = command_line.parse(options(__doc__, (series for series, *_ in cases())), HERE)
    table = run_cases(arguments, arguments.output / "capsule-channel.csv", COLUMNS, cases(), run)
    if all(name in table for _, name, _ in cases()):
        report(table)
        draw_outline(arguments.output)
        draw_study(table, arguments.output)


if __name__ == "__main__":
    main()
