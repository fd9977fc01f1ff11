#!/usr/bin/python3
"""How the viscosity of blood of 40 % at 100 and 10 /s depends on the grid, the mesh, the kernel and
on `smooth` of the membranes: error against run time. Runs in.blood in a small box over a strain of
5 for each (half an hour of processor time, most of it for rbc_2562), writes convergence.csv to a
folder and prints the table of the README.

converge.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only rbc_162 rbc_362 rbc_642]
"""
import itertools
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import example_study  # noqa: E402
from blood_study import COLUMNS, measure_viscosity  # noqa: E402

KERNELS = "roma3", "peskin4"
RATES = 100, 10    # 1/s
SMOOTH = "no", "yes"
RESOLUTIONS = (("rbc_162", 0.8), ("rbc_162", 0.65), ("rbc_362", 0.5), ("rbc_642", 0.4),
               ("rbc_2562", 0.25))
SMALL_BOX = {"length": 14, "gap": 12, "hematocrit": 0.4, "strain": 5}


def measure(arguments, variables):
    """A row of COLUMNS."""
    return measure_viscosity(arguments, HERE / "in.blood", {**SMALL_BOX, **variables})


def label(kernel, shape, dx, rate, smooth):
    return f"{kernel} {shape} {dx:g} {rate} smooth {smooth}"


def cases():
    for rate, (shape, dx), smooth, kernel in itertools.product(RATES, RESOLUTIONS, SMOOTH, KERNELS):
        yield shape, label(kernel, shape, dx, rate, smooth), {
            "kernel": kernel, "shape": shape, "dx": dx, "rate": rate, "smooth": smooth}


def entry(table, kernel, resolution, rate, smooth):
    """Viscosity, its error against the finest run and seconds, as the README's table has them."""
    finest = table.get(label(KERNELS[0], *RESOLUTIONS[-1], rate, SMOOTH[0]))
    case = table.get(label(kernel, *resolution, rate, smooth))
    if case is None:
        return "-"
    viscosity, seconds = case[-1]
    error = "" if finest is None else f"{100 * (viscosity / finest[-1][0] - 1):+.1f} %, "
    return f"{viscosity:.2f}, {error}{seconds:.2g} s"


def print_table(table):
    columns = list(itertools.product(KERNELS, RATES))
    print("| vertices, dx (µm) | *smooth* |",
          *(f"*{kernel}*, {rate} /s |" for kernel, rate in columns))
    print("|---|---|" + "---|" * len(columns))
    for (shape, dx), smooth in itertools.product(RESOLUTIONS, SMOOTH):
        print(f"| {shape.removeprefix('rbc_')}, {dx:g} | *{smooth}* |",
              *(f"{entry(table, kernel, (shape, dx), rate, smooth)} |" for kernel, rate in columns))


def main():
    series = [shape for shape, _ in RESOLUTIONS]
    arguments = command_line.parse(example_study.options(__doc__, series), HERE)
    print_table(example_study.run_cases(arguments, arguments.output / "convergence.csv", COLUMNS,
                                        cases(), measure))


if __name__ == "__main__":
    main()
