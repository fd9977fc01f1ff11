#!/usr/bin/python3
"""The paper's largest scene: 49,152 cells of 45 % that adhere, sheared at 10, 60 and 100 /s between
plates 30 um apart. Runs ../suspension/in.suspension in pieces that go on from restart files, and
after each piece says how far it is and writes what can be said by then: blood.csv, cost.csv,
blood-49152.png and, when a run is at its end, cells.png.

study.py --output FOLDER --cells 64 --strain 5      # small: a minute or two
study.py --output FOLDER --ranks 2                  # 49,152 cells: days; the same command goes on

A command that was stopped loses the piece that it was in, no more. --only names shear rates. --draw
runs nothing and looks at what is there.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import blood_runs  # noqa: E402
import example_study  # noqa: E402
import blood_pictures  # noqa: E402
from rbc.tables import read_ave_time  # noqa: E402
from rbc.surface_distances import pair_distances  # noqa: E402
from rbc.surfaces import read_cells  # noqa: E402

RATES = "10", "60", "100"                 # 1/s
SAMPLED = 6                               # cells whose paths are written
SETTLED = 10                              # strain from which means are taken
REACH = 0.6                               # gaps that count, um
EVEN = 0.3                                # strain between points of a path that count
VERTICES = 162                            # of a cell
# of a step: error in um, strain and time in us at most, fluid cells crossed at most
# (bench/steps.sh); and steps between lines of the data files
STEPS = {"error": 2.0e-2, "step": 0.08, "longest": 8000, "courant": 2, "every": 5}
DIAMETER = 8.0                            # of the paper, um

# what the paper says of its Figure 12: share of aggregates, from a size to below the next
PAPER_SIZES = {"10": ((64, 128), 0.33), "100": ((2, 4), 0.70)}
# its Table 1, and what of the step cost table belongs to each part
PAPER_COST = {
    "fluid": (20, ("Solve", "Spread", "Interpolate")),
    "deformation": (8.8, ("Membrane", "Smoothing")),
    "detection": (2.2, ("Detection", "Crossings")),
    "interactions": (60, ("Contact", "Gaps")),
    "exchange": (9, ("Exchange",))}


def sampled(cells):
    """Molecule IDs of the cells whose paths are written."""
    return np.unique(np.linspace(1, cells, min(SAMPLED, cells)).round().astype(int))


def variables(arguments, rate):
    """Of in.suspension."""
    return {"rate": rate, "cells": arguments.cells, "strain": arguments.strain,
            "gap": arguments.gap, "hematocrit": arguments.hematocrit, "frames": arguments.frames,
            "seconds": arguments.piece, **STEPS,
            "rows": " ".join(map(str, ["molecule", *sampled(arguments.cells)]))}


def progress(folder, end):
    """A line: how far a run is and, by its last piece, how many hours it still takes."""
    last = blood_runs.log_table(blood_runs.logs(folder)[-1])["v_sheared"]
    hours = blood_runs.loop_hours(blood_runs.last_log(folder))
    line = (f"{folder.name} /s: strain {last[-1]:.3f} of {end:g}, "
            f"{blood_runs.core_seconds(folder) / 3600:.3g} core hours")
    if blood_runs.is_finished(folder):
        return f"{line}, finished"
    if last[-1] == last[0]:
        return f"{line}, no step in this piece: make --piece longer"
    return f"{line}, about {hours * (end - last[-1]) / (last[-1] - last[0]):.3g} hours left"


def run_all(arguments, rate, folder):
    """All pieces that are left of a run, and after each what can be said by then."""
    while not blood_runs.is_finished(folder):
        first = not blood_runs.logs(folder)
        done = blood_runs.run_piece(arguments, folder, variables(arguments, rate))
        if first or done.returncode:
            print(*blood_runs.said(done), sep="\n", flush=True)
        done.check_returncode()
        print(progress(folder, arguments.strain), flush=True)
        analyse(arguments)


def gaps(folder):
    """Least distances of neighbors in the middle of the last surfaces, 0 where they cut."""
    cut_out = blood_pictures.cut_out(folder, folder / "cut_out.vtp")
    return pair_distances(read_cells(str(cut_out)), blood_runs.box(folder), [False] * 3, REACH)


def turns(strains, heights):
    """Of all cells together: how often heights begin to rise or to fall, at strains EVEN apart. At
    low rates more points are written."""
    even = np.arange(strains[0], strains[-1], EVEN)
    rises = [np.sign(np.diff(np.interp(even, strains, height))) for height in heights.T]
    return sum(int((rise[1:] != rise[:-1]).sum()) for rise in rises)


def paths(folder):
    """Times in s and heights in um of the sampled cells, a column for each."""
    table, rows = blood_runs.history(folder), read_ave_time(folder / "cell.dat")
    return np.interp(rows.steps, table["Step"], table["Time"]) * 1e-6, rows.column(4)


def share_of(classes, sizes):
    """Of the aggregates of two cells and more, those from one size to below another."""
    chosen = (classes.edges >= sizes[0]) & (classes.edges < sizes[1])
    return classes.fractions(False)[chosen].sum()


def measure(folder):
    """Of a run, by name: a row of blood.csv and what is drawn."""
    found, near = blood_runs.measures(folder, SETTLED), gaps(folder)
    times, heights = paths(folder)
    turned = turns(times * float(folder.name), heights) / heights.shape[1]
    return {**found, "of_64_to_127": share_of(found["classes"], (64, 128)),
            "least_gap": near.min(initial=REACH), "cut": int((near == 0).sum()),
            "median_gap": np.median(near) if len(near) else np.nan,
            "turns_per_s": turned / times[-1], "turns_per_strain": turned / found["strain"],
            "paths": (times, heights / DIAMETER)}


def costs(folder):
    """A row of cost.csv: shares in % as in the paper's Table 1, what a cell and a vertex take."""
    cost, cells = blood_runs.read_cost(folder), blood_runs.cell_count(folder)
    milliseconds = blood_runs.history(folder)["Time"][-1] * 1e-3
    row = {part: 100 * sum(cost.parts.get(name, 0) for name in names) / cost.loops
           for part, (_, names) in PAPER_COST.items()}
    row["other"] = 100 - sum(row.values())
    seconds, vertices = blood_runs.core_seconds(folder), VERTICES * cells
    return {**row, "steps": cost.steps, "solves_per_step": cost.solves / cost.steps,
            "core_s_per_step": seconds / cost.steps,
            "us_per_vertex_and_solve": 1e6 * seconds / cost.solves / vertices,
            "core_s_per_cell_and_ms": seconds / cells / milliseconds,
            "kB_per_vertex": 1e3 * cost.megabytes / vertices}


def print_table(title, rows, cases):
    """In Markdown: a row for each of `rows`, {name: values as text}."""
    print(f"\n| {title} | " + " | ".join(cases) + " |\n|" + "---|" * (len(cases) + 1))
    for name, values in rows.items():
        print(f"| {name} | " + " | ".join(values) + " |")


def print_tables(blood, cost):
    """Sizes and cost, those of the paper beside them."""
    cases = [f"{rate} /s" for rate in blood]
    rows = {name: [f"{case[name]:.3g}" for case in blood.values()]
            for name in next(iter(blood.values())) if np.isscalar(next(iter(blood.values()))[name])}
    for rate, (sizes, share) in PAPER_SIZES.items():
        rows[f"aggregates of {sizes[0]} to {sizes[1] - 1} cells, % (paper)"] = [
            f"{100 * share_of(case['classes'], sizes):.0f}" + (f" ({100 * share:.0f})"
                                                               if rate == name else "")
            for name, case in blood.items()]
    print_table("measured", rows, cases)
    rows = {name: [f"{row[name]:.3g}" for row in cost.values()] + ["–"]
            for name in next(iter(cost.values()))}
    for part, (share, _) in PAPER_COST.items():
        rows[part][-1] = f"{share:g}"
    print_table("cost", rows, [*cases, "paper"])


def analyse(arguments):
    """Writes the tables and the picture of the curves; returns the measures of the runs."""
    folder = example_study.runs_folder(arguments)
    rates = [rate for rate in RATES if blood_runs.has_begun(folder / rate)]
    blood = {rate: measure(folder / rate) for rate in rates}
    cost = {rate: costs(folder / rate) for rate in rates}
    if blood:
        numbers = {rate: {name: float(value) for name, value in case.items() if np.isscalar(value)}
                   for rate, case in blood.items()}
        example_study.write_rows(numbers, arguments.output / "blood.csv")
        example_study.write_rows(cost, arguments.output / "cost.csv")
        blood_pictures.draw_curves(blood, PAPER_SIZES, arguments.output / "blood-49152.png")
    return blood, cost


def options():
    parser = example_study.options(__doc__, RATES)
    example_study.add_runs_folder(parser)
    parser.add_argument("--cells", type=int, default=49152)
    parser.add_argument("--strain", type=float, default=20, help="shear rate times duration")
    parser.add_argument("--gap", type=float, default=30, help="between the plates, um")
    parser.add_argument("--hematocrit", type=float, default=0.45)
    parser.add_argument("--piece", type=int, default=1800, help="seconds that a piece may take")
    parser.add_argument("--frames", type=int, default=100,
                        help="steps between surfaces: 1 GB each of 49152 cells")
    parser.add_argument("--draw", action="store_true", help="only look at the runs that are there")
    return parser


def main():
    arguments = command_line.parse(options(), HERE)
    folder = example_study.runs_folder(arguments)
    for rate in RATES:
        if example_study.wanted(arguments, rate) and not arguments.draw:
            run_all(arguments, rate, folder / rate)
    blood, cost = analyse(arguments)
    if blood:
        print_tables(blood, cost)
        blood_pictures.draw_cells({f"{rate} /s": folder / rate for rate in blood},
                                  arguments.output / "cells.png")


if __name__ == "__main__":
    main()
