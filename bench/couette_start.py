"""Start-up of plane Couette flow: error against run time of fix rbc/fluid and of LAMMPS's own fix
lb/fluid.

Fluid at rest, the upper plate moves with U from t = 0 on. Writes couette_start.csv and
couette_start.png to a folder; the executable and fix lb/fluid as a plugin come from the environment
(LMP_RBC, LB_FLUID), as in couette_start.sh.
"""

import csv
import itertools
import os
import re
import shutil
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = str(HERE.parent / "tests" / "helpers"), str(HERE.parent / "scripts")
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from lammps_case import run  # noqa: E402

GAP, SPEED, VISCOSITY, DENSITY = 24.0, 1.0e-3, 1.0, 1.0    # units micro: water, 24 um, 1 mm/s
DIFFUSION_TIME = GAP**2 * DENSITY / VISCOSITY
FIRST = 0.05                                               # times in units of the diffusion time
TIMES = (FIRST, 2 * FIRST, 4 * FIRST)

OURS, D3Q15, D3Q19 = "rbc/fluid", "lb/fluid D3Q15", "lb/fluid D3Q19"
# fix lb/fluid gives its wall the new speed in the course of the first step: in effect half a step
# late. Where nu dt/dx^2 = 1/6 (a relaxation time of one step) that is its whole error of second
# order, in this flow.
HALF_STEP_LATE = ", clock - dt/2"
COST_GRID = 64

Case = namedtuple("Case", "grid steps code dx dt total_steps points")


def case_of(code, grid, viscous_number):
    """With `steps` steps up to the first of TIMES; nodes of fix lb/fluid lie on both plates."""
    steps = max(1, round(FIRST * grid**2 / viscous_number))
    return Case(grid, steps, code, GAP / grid, FIRST * DIFFUSION_TIME / steps,
                round(steps * TIMES[-1] / FIRST), grid**2 * (grid if code == OURS else grid + 1))


def all_cases():
    """nu dt/dx^2 from 0.8 to 100 for ours, around the best and up to 10 for fix lb/fluid."""
    ours, small, large = (100 * 0.5**np.arange(8), (1 / 24, 1 / 12),
                          (1 / 6, 1 / 3, 2 / 3, 4 / 3, 8 / 3, 10))
    plan = [(OURS, 24, ours), (D3Q15, 24, small + large), (D3Q19, 24, small + large),
            (OURS, 48, ours), (D3Q15, 48, large), (D3Q19, 48, large[2:]),
            (OURS, COST_GRID, ours), (D3Q15, COST_GRID, (8 / 3,)), (D3Q19, COST_GRID, (8 / 3,))]
    return sorted(
        {case_of(code, grid, number) for code, grid, numbers in plan for number in numbers})


def script(case, output):
    n = case.grid
    if case.code == OURS:
        fluid = (f"fix flow all rbc/fluid grid {n} {n} {n} viscosity {VISCOSITY} density {DENSITY} "
                 f"inertia unsteady wall zlo 0 0 0 wall zhi {SPEED} 0 0")
        if output:
            fluid += f"\ndump grid all grid {case.steps} grid.dump f_flow:grid:velocity[1]" \
                     "\ndump_modify grid sort id format float %.17g"
    else:
        fluid = (f"plugin load {os.environ['LB_FLUID']}\n"
                 f"fix flow all lb/fluid 1 {VISCOSITY} {DENSITY} dx {case.dx!r} "
                 f"zwall_velocity 0 {SPEED}")
        fluid += " D3Q19" * (case.code == D3Q19) + f" dumpxdmf {case.steps} grid 0" * output
    return f"""
        units      micro
        boundary   p p f
        region     box block 0 {GAP} 0 {GAP} 0 {GAP}
        create_box 1 box
        mass       1 1
        timestep   {case.dt!r}
        {fluid}
        run        {case.total_steps}\n"""


def profiles(case):
    """Heights and, for each of TIMES, the velocity along the plate: heights x points of a plane."""
    n, result = case.grid, run(script(case, output=True), timeout=3600)
    if case.code == OURS:
        heights = (np.arange(n) + 0.5) * case.dx
        fields = [frame.reshape(n, n * n) for frame in result.dump("grid.dump").frames]
    else:    # per frame the density, then the velocity in lattice units; the plate moves along y
        heights = np.arange(n + 1) * case.dx
        raw = np.fromfile(result.path("grid.raw")).reshape(-1, 4, (n + 1)**3)[:, 1:]
        fields = raw.reshape(-1, n + 1, (n + 1)**2, 3)[..., 1] * case.dx / case.dt
    shutil.rmtree(result.folder)
    return heights, [fields[round(time / FIRST)] for time in TIMES]


def exact(heights, time):
    n = np.arange(1, 200)
    waves = (-1.0)**n / n * np.exp(-(n * np.pi)**2 * time) * np.sin(
        np.pi * np.outer(heights / GAP, n))
    return SPEED * (heights / GAP + 2 / np.pi * waves.sum(axis=1))


def errors(case):
    """{name of the code: rms over the fluid, in units of the plate's speed, at each of TIMES}."""
    heights, fields = profiles(case)

    def against(delay):
        squares = (np.mean((field - exact(heights, time - delay)[:, None])**2, axis=1)
                   for time, field in zip(TIMES, fields))
        return [np.sqrt(square.sum() / case.grid) / SPEED for square in squares]

    if case.code == OURS:
        return {OURS: against(0)}
    return {case.code: against(0), case.code + HALF_STEP_LATE: against(FIRST / case.steps / 2)}


def loop_time(case):
    printed = run(script(case, output=False), timeout=3600).printed
    return float(re.search(r"^Loop time of (\S+)", printed, re.MULTILINE).group(1))


def summary(rows):
    """(run time, rms over the times) of each run."""
    runs = [list(group)
            for _, group in itertools.groupby(rows, key=lambda row: (row["dx"], row["steps"]))]
    return [(group[0]["run_time_s"], np.sqrt(np.mean([row["error"]**2 for row in group])))
            for group in runs]


def draw(rows, path):
    markers = {OURS: "o", D3Q15: "s", D3Q19: "^"}
    colors = {GAP / 24: "C0", GAP / 48: "C1", GAP / COST_GRID: "C2"}
    figure = Figure(figsize=(8, 6), layout="tight")
    axes = figure.subplots()

    def line(color, code, *data):
        late = code.endswith(HALF_STEP_LATE)
        return axes.loglog(*data, color=color, marker=markers[code.removesuffix(HALF_STEP_LATE)],
                           ms=6, lw=1, ls=":" if late else "-", mfc="white" if late else color)[0]

    for (code, dx), group in itertools.groupby(rows, key=lambda row: (row["code"], row["dx"])):
        line(colors[dx], code, *zip(*summary(group)))
    key = [(line("0.4", code, [], []), f"fix {code}") for code in (OURS, D3Q15, D3Q19)]
    key.append((line("0.4", D3Q15 + HALF_STEP_LATE, [], []),
                "the same against the exact flow dt/2 earlier"))
    key += [(Line2D([], [], color=color, lw=4), f"dx = {dx:g} µm") for dx, color in colors.items()]
    axes.legend(*zip(*key), fontsize=9, loc="lower left")
    axes.set_xlabel(r"run time to $\nu t/H^2$ = 0.2 on one core (s)")
    axes.set_ylabel("rms error of the velocity (units of the plate's speed)")
    axes.set_title(f"Start-up of Couette flow, box of ({GAP:g} µm)³; along a line the time step "
                   "varies", size=10)
    axes.grid(alpha=0.4)
    figure.savefig(path, dpi=130)


def report(rows):
    cost = {code: min(row["ns_per_cell_step"] for row in rows if row["code"] == code
                      and row["dx"] == GAP / COST_GRID)
            for code in (OURS, D3Q15, D3Q19)}
    for code in (D3Q15, D3Q19):
        print(f"{COST_GRID}^3 on one core, ns per cell and step: {code} {cost[code]:.0f}, {OURS} "
              f"{cost[OURS]:.0f}, ratio {cost[code] / cost[OURS]:.2f}")
    ours = summary(row for row in rows if row["code"] == OURS)
    for code in sorted({row["code"] for row in rows} - {OURS}):
        print(
            f"{code}: its error over ours at equal run time, its run time over ours at equal error")
        lowest = np.inf
        for seconds, error in sorted(summary(row for row in rows if row["code"] == code)):
            if error < lowest:
                lowest = error
                error_then = min((e for s, e in ours if s <= seconds), default=np.nan)
                time_then = min((s for s, e in ours if e <= error), default=np.nan)
                print(f"  {seconds:8.3f} s, error {error:.2e}: {error / error_then:8.3g} "
                      f"{seconds / time_then:8.3g}")


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--repeats", type=int, default=3,
                        help="timed runs of each case, of which the quickest counts")
    arguments = command_line.parse(parser, HERE, ["LMP_RBC"])
    repeats = arguments.repeats
    cases = all_cases()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        times = [[loop_time(case) for case in cases] for _ in range(repeats)]
        found = [errors(case) for case in cases]

    rows = []
    for case, seconds, by_code in zip(cases, np.min(times, axis=0), found):
        for code, values in by_code.items():
            for time, error in zip(TIMES, values):
                rows.append({"code": code, "dx": case.dx, "cells": case.points, "dt": case.dt,
                             "steps": case.total_steps, "run_time_s": float(f"{seconds:.4g}"),
                             "ns_per_cell_step": round(
                                 1e9 * seconds / case.points / case.total_steps, 1),
                             "nu t/H^2": time, "error": float(f"{error:.4g}")})
    rows.sort(key=lambda row: (row["code"], -row["dx"], row["steps"], row["nu t/H^2"]))
    with open(arguments.output / "couette_start.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    draw(rows, arguments.output / "couette_start.png")
    report(rows)


if __name__ == "__main__":
    main()
