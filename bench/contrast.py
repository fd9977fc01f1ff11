#!/usr/bin/env python3
"""Cost of a step of dense blood whose cells have an inside of another viscosity, over that with one
viscosity, which runs before each of them. Runs examples/blood/in.blood with 10 or 11 cells of 40 %
in a small box; writes contrast.csv to a folder and prints it. With --ratios only rows of these are
measured; others that its contrast.csv already holds stay.

contrast.py --output FOLDER [--lmp ../build/lmp_rbc] [--ratios 100]
"""
import csv
import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
from rbc import command_line  # noqa: E402
import example_study  # noqa: E402

SCRIPT = HERE.parent / "examples" / "blood" / "in.blood"
PLASMA = 1.4965                      # mPa s, as in healthy.material
GRIDS = ("rbc_162", 0.65), ("rbc_362", 0.65), ("rbc_362", 0.5)    # dx in um
RATIOS = 5, 10, 20, 100, 0.2         # of viscosities, inside over outside
BOX = {"length": 14, "gap": 12, "strain": 4, "frames": 1000000}
COLUMNS = ("vertices", "dx", "ratio", "steps", "stages", "solves_per_step", "iterations",
           "seconds_per_step", "over_one_viscosity", "relative_viscosity")


def blood(arguments, shape, dx, ratio):
    """Steps, stages of the last one, solves and processor seconds of a step, iterations of an
    evaluation, viscosity at the end."""
    with tempfile.TemporaryDirectory() as folder:
        before = example_study.processor_seconds()
        variables = {**BOX, "shape": shape, "dx": dx, "inside": ratio * PLASMA}
        printed = example_study.run_script(arguments, SCRIPT, folder, variables).stdout
        seconds = example_study.processor_seconds() - before
    solves, steps = map(int, re.search(r"step cost: (\d+) solves in (\d+) steps", printed).groups())
    table = re.search(r"^ +Step .*?(?=^Loop|^\n)", printed, re.MULTILINE | re.DOTALL).group()
    head, *_, end = table.strip().splitlines()
    last = dict(zip(head.split(), map(float, end.split())))
    return (steps, last["f_ib[5]"], solves / steps, seconds / steps, last["f_ib[11]"],
            last["v_relative"])


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--lmp", default=str(HERE.parent / "build" / "lmp_rbc"))
    parser.add_argument("--ratios", nargs="+", type=float, choices=RATIOS, help="default all")
    arguments = command_line.parse(parser, HERE)
    arguments.ranks = 1
    path = arguments.output / "contrast.csv"
    table = {}
    if arguments.ratios and path.exists():
        with open(path, newline="", encoding="utf-8") as stream:
            table = {key(row): row for row in list(csv.reader(stream))[1:]}
    for row in rows(arguments):
        print(*row, sep=", ", flush=True)
        table[key(row)] = row
        with open(path, "w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows(table[place] for place in sorted(table))


def key(row):
    """Place of a row in the table: by grids and ratios as listed above."""
    grids = [(shape[4:], f"{dx:g}") for shape, dx in GRIDS]
    return grids.index((row[0], f"{float(row[1]):g}")), (1, *RATIOS).index(float(row[2]))


def rows(arguments):
    for shape, dx in GRIDS:
        for ratio in arguments.ratios or RATIOS:
            alone = blood(arguments, shape, dx, 1)
            if ratio == RATIOS[0]:
                yield row_of(shape, dx, 1, alone, alone)
            yield row_of(shape, dx, ratio, blood(arguments, shape, dx, ratio), alone)


def row_of(shape, dx, ratio, of_run, alone):
    steps, stages, solves, seconds, iterations, viscosity = of_run
    return (shape[4:], dx, f"{ratio:g}", steps, f"{stages:.0f}", f"{solves:.1f}",
            f"{iterations:.2f}", f"{seconds:.4f}", f"{seconds / alone[3]:.2f}", f"{viscosity:.2f}")


if __name__ == "__main__":
    main()
