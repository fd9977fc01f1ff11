#!/usr/bin/python3
"""How the viscosity of blood of 40 % at 100 /s depends on the grid, the mesh and the kernel: error
against run time. Runs in.blood in a small box over a strain of 5 for each (ten minutes of
processor time in all), writes convergence.csv to a folder and prints the table of the README.

converge.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only roma3]
"""
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
import command_line  # noqa: E402
import example_study  # noqa: E402
from read_ave_time import read_table  # noqa: E402
from study import settled  # noqa: E402

KERNELS = "roma3", "peskin4"
RESOLUTIONS = (("rbc_162", 0.8), ("rbc_162", 0.65), ("rbc_362", 0.5), ("rbc_642", 0.4), ("rbc_2562", 0.25))
STRAIN = 5
SMALL_BOX = {"length": 14, "gap": 12, "hematocrit": 0.4, "rate": 100, "strain": STRAIN}
COLUMNS = "viscosity", "core_seconds"


def measure(arguments, variables):
    """A row of COLUMNS; NaN for the viscosity of a run that stopped."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.monotonic()
        done = example_study.run_script(arguments, HERE / "in.blood", folder, {**SMALL_BOX, **variables})
        seconds = (time.monotonic() - begin) * arguments.ranks
        table = read_table(Path(folder) / "blood.dat")
    if done.returncode:
        print(done.stdout[-2000:])
    return [[float("nan") if done.returncode else settled(table, STRAIN), seconds]]


def cases():
    for kernel in KERNELS:
        for shape, dx in RESOLUTIONS:
            yield kernel, f"{kernel} {shape} {dx:g}", {"kernel": kernel, "shape": shape, "dx": dx}


def main():
    arguments = command_line.parse(example_study.options(__doc__, KERNELS), HERE)
    table = example_study.run_cases(arguments, arguments.output / "convergence.csv", COLUMNS, cases(), measure)
    finest = next(rows[-1][0] for label, rows in table.items() if label == f"roma3 {RESOLUTIONS[-1][0]} {RESOLUTIONS[-1][1]:g}")
    for label, rows in table.items():
        viscosity, seconds = rows[-1]
        print(f"{label:24} {viscosity:6.3f} {100 * (viscosity / finest - 1):+6.1f} % {seconds:8.1f} s")


if __name__ == "__main__":
    main()
