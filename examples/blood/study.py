#!/usr/bin/python3
"""Which hematocrits and shear rates run through with which kernel, and how viscous the blood is.
Runs in.blood over a strain of 5 for each (six minutes of processor time in all), writes blood.csv
to a folder.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only roma3]
"""
import itertools
import re
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
import command_line  # noqa: E402
import example_study  # noqa: E402
from read_ave_time import read_table  # noqa: E402

KERNELS = "roma3", "peskin4"
HEMATOCRITS = 0.2, 0.3, 0.4, 0.45
RATES = 10, 100, 1000    # 1/s
STRAIN = 5
COLUMNS = "strain", "viscosity", "volume", "again", "seconds"


def settled(table, strain):
    """Mean viscosity over that of plasma in the last two fifths of the strain."""
    return table["v_relative"][table["v_sheared"] > 0.6 * strain].mean()


def volume_change(printed):
    """Relative change of the cells' volume over the run, from the lines of the log."""
    volumes = [float(line.split()[7]) for line in printed.splitlines() if re.match(r"^ +\d+( +\S+){9} *$", line)]
    return max(abs(volume / volumes[0] - 1) for volume in volumes)


def measure(arguments, variables):
    """A row of COLUMNS; NaN for the viscosity of a run that stopped."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.monotonic()
        done = example_study.run_script(arguments, HERE / "in.blood", folder, variables)
        seconds = time.monotonic() - begin
        table = read_table(Path(folder) / "blood.dat")
    reached = table["v_sheared"][-1] if len(table["v_sheared"]) else 0
    again = re.findall(r"^ +\d+.* (\d+) *$", done.stdout, re.MULTILINE)
    if done.returncode:
        print(*re.findall(r"^ERROR.*", done.stdout, re.MULTILINE), sep="\n")
        viscosity = float("nan")
    else:
        viscosity = settled(table, variables["strain"])
    return [[reached, viscosity, volume_change(done.stdout), float(again[-1]), seconds]]


def cases():
    for kernel, hematocrit, rate in itertools.product(KERNELS, HEMATOCRITS, RATES):
        yield kernel, f"{kernel} {hematocrit:g} {rate}", {"kernel": kernel, "hematocrit": hematocrit, "rate": rate,
                                                          "strain": STRAIN}


def main():
    arguments = command_line.parse(example_study.options(__doc__, KERNELS), HERE)
    table = example_study.run_cases(arguments, arguments.output / "blood.csv", COLUMNS, cases(), measure)
    for label, rows in table.items():
        print(f"{label:18}", *(f"{value:10.4g}" for value in rows[-1]))


if __name__ == "__main__":
    main()
