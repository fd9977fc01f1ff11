#!/usr/bin/python3
"""How the viscosity of blood of 45 % at 10, 60 and 100 /s, with adhesion and without, depends on
the grid, the mesh and the kernel: error against run time. Runs in.suspension with 32 cells over a
strain of 5 for each, the range of contact the same in all, writes convergence.csv and
convergence.png to a folder and prints the table of the README. Errors are against the value to
which the finest runs extrapolate.

converge.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only r100 r100-fine]

--only names scenes: a10, a60, a100 adhesive, r10, r60, r100 repulsive; with -fine their finest
grids, which take most of the time; seeds: other packings of r100.
"""
import itertools
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOP = HERE.parents[1]
sys.path.insert(0, str(TOP / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from blood_study import COLUMNS, measure_viscosity  # noqa: E402
from richardson import extrapolate  # noqa: E402
from study import KINDS, SMALL_BOX, VOLUMES, WORDS, made_templates  # noqa: E402

KERNELS = "roma3", "peskin4"
SCENES = "r100", "r10", "a100", "a10", "r60", "a60"
COARSE = ("rbc_162", 0.8), ("rbc_162", 0.65), ("rbc_362", 0.65), ("rbc_642", 0.5)    # dx in um
FINE = ("rbc_1442", 0.35), ("rbc_2562", 0.25)             # with the first kernel only
ORDER = 2                                                 # of errors in dx, at least
SEEDS = 4712, 4713, 4714, 4715
SEEDED = "r100", "roma3", "rbc_162", 0.8
COLUMNS_OF_PANELS = 3


def label(scene, kernel, shape, dx):
    return f"{scene} {kernel} {shape} {dx:g}"


def variables(scene, kernel, shape, dx):
    return {"sigma": KINDS[scene[0]], "rate": scene[1:], "kernel": kernel, "shape": shape,
            "volume": VOLUMES[shape], "dx": dx}


def cases():
    """(series, label, variables) of all runs, those that take longest at the end."""
    for scene, (shape, dx), kernel in itertools.product(SCENES, COARSE, KERNELS):
        yield scene, label(scene, kernel, shape, dx), variables(scene, kernel, shape, dx)
    for seed in SEEDS:
        yield "seeds", f"{label(*SEEDED)} {seed}", {**variables(*SEEDED), "seed": seed}
    for (shape, dx), scene in itertools.product(FINE, SCENES):
        run = scene, KERNELS[0], shape, dx
        yield f"{scene}-fine", label(*run), variables(*run)


def run_all(arguments):
    """{label: rows of COLUMNS}."""
    templates = made_templates(arguments.output)

    def measure(arguments, changed):
        return measure_viscosity(arguments, HERE / "in.suspension", {**SMALL_BOX, **changed},
                                 templates)

    return example_study.run_cases(arguments, arguments.output / "convergence.csv", COLUMNS,
                                   cases(), measure)


def runs_of(table, scene):
    """{kernel: {(shape, dx): (viscosity, seconds)}} of the runs that there are."""
    return {kernel: {(shape, dx): table[label(scene, kernel, shape, dx)][-1]
                     for shape, dx in COARSE + FINE if label(scene, kernel, shape, dx) in table}
            for kernel in KERNELS}


def limit(runs):
    """Viscosity at dx = 0: that of the two finest grids of the first kernel, less errors that are
    of ORDER in dx; NaN where there are not two of them."""
    points = sorted((dx, viscosity) for (_, dx), (viscosity, _) in runs[KERNELS[0]].items())
    (fine, value), (coarse, other) = points[:2] if len(points) > 1 else [(1, np.nan), (2, np.nan)]
    return extrapolate(fine, value, coarse, other, ORDER)


def entry(run, exact):
    """Viscosity, its error and seconds, as the README's table has them."""
    if run is None:
        return "-"
    viscosity, seconds = run
    return f"{viscosity:.2f}, {100 * (viscosity / exact - 1):+.1f} %, {seconds:.0f} s"


def print_table(table):
    runs = {scene: runs_of(table, scene) for scene in SCENES}
    scenes = [scene for scene in SCENES if np.isfinite(limit(runs[scene]))]
    print("| vertices, dx (µm) | kernel |",
          *(f"{scene[1:]} /s, {WORDS[scene[0]]} |" for scene in scenes))
    print("|---|---|" + "---|" * len(scenes))
    for (shape, dx), kernel in itertools.product(COARSE + FINE, KERNELS):
        entries = [entry(runs[scene][kernel].get((shape, dx)), limit(runs[scene]))
                   for scene in scenes]
        if set(entries) != {"-"}:
            print(f"| {shape.removeprefix('rbc_')}, {dx:g} | *{kernel}* |",
                  *(f"{text} |" for text in entries))
    print("| extrapolated | |", *(f"{limit(runs[scene]):.2f} |" for scene in scenes))


def draw(table, path):
    """Error against seconds, a panel for each scene of which there is a limit."""
    scenes = [scene for scene in SCENES if np.isfinite(limit(runs_of(table, scene)))]
    rows = -(-len(scenes) // COLUMNS_OF_PANELS)
    figure, axes = plt.subplots(rows, COLUMNS_OF_PANELS, figsize=(12, 3.6 * rows), sharey=True,
                                layout="constrained", squeeze=False)
    for scene, panel in zip(scenes, axes.flat):
        runs = runs_of(table, scene)
        exact = limit(runs)
        for kernel, line in zip(KERNELS, ("o-", "s--")):
            points = {key: (seconds, 100 * (viscosity / exact - 1))
                      for key, (viscosity, seconds) in runs[kernel].items()}
            if not points:
                continue
            panel.plot(*np.array(list(points.values())).T, line, label=kernel)
            for (shape, dx), at in points.items():
                panel.annotate(f"{shape.removeprefix('rbc_')}, {dx:g}", at, xytext=(4, 4),
                               textcoords="offset points", fontsize=7)
        panel.axhspan(-5, 5, color="0.9", zorder=0)
        panel.set(title=f"{scene[1:]} /s, {WORDS[scene[0]]}", xlabel="core seconds",
                  xscale="log", xlim=(4, 500))
    for panel in axes[:, 0]:
        panel.set_ylabel("error of the viscosity (%)")
    axes[0][0].legend(frameon=False)
    figure.savefig(path, dpi=110)


def main():
    series = [*SCENES, *(f"{scene}-fine" for scene in SCENES), "seeds"]
    arguments = command_line.parse(example_study.options(__doc__, series), HERE)
    table = run_all(arguments)
    print_table(table)
    draw(table, arguments.output / "convergence.png")


if __name__ == "__main__":
    main()
