#!/usr/bin/env python3
"""Messages and bytes that a rank sends in a solve of dense blood, with as many cells for each rank.
Runs examples/suspension/in.suspension on cubes of ranks, which may share cores: counts do not depend
on time. Each count is the difference of a longer run and a shorter one.

messages.py --output FOLDER --counter ../build/bench/count_messages.so [--ranks 1 8 27 64]

Writes messages.csv and messages.png, which draws what a network makes of the counts.
"""
import csv
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
import command_line  # noqa: E402
from example_study import POTENTIALS  # noqa: E402

SCRIPT = HERE.parent / "examples" / "suspension" / "in.suspension"
VOLUME, HEMATOCRIT = 89.30, 0.35     # of rbc_162, um^3; less than in the scene: small boxes are hard to pack
STRAINS = 0.05, 0.2                  # of both runs
KINDS = {"halo": "layers of fluid cells", "transposes": "transposes of the fluid's transforms",
         "shared_cells": "sums of shared cells", "lammps": "atoms and forces, by LAMMPS",
         "collective": "collective calls"}
NUMBERS = "messages", "bytes", "most_messages", "most_bytes"
COLUMNS = ("ranks", "kind", *(f"{name}_per_solve" for name in NUMBERS), "solves", "steps")


def count(arguments, ranks, strain):
    """({kind: NUMBERS}, solves, steps) of a run from its start."""
    side = round(ranks ** (1 / 3))
    cells = arguments.cells * ranks
    gap = (arguments.cells * VOLUME / HEMATOCRIT) ** (1 / 3) * side
    variables = {"cells": cells, "gap": f"{gap:.10g}", "strain": strain, "hematocrit": HEMATOCRIT, "sigma": 0, "rate": 100,
                 "every": 1000000, "frames": 1000000, "templates": POTENTIALS}
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "-np", str(ranks), "-x", f"LD_PRELOAD={arguments.counter}",
                   "-x", f"COUNT_MESSAGES={folder}/counted", arguments.lmp, "-in", SCRIPT, "-log", "log"]
        for name, value in variables.items():
            command += ["-var", name, str(value)]
        subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        lines = (Path(folder) / "counted").read_text(encoding="utf-8").splitlines()
        log = (Path(folder) / "log").read_text(encoding="utf-8")
    solves, steps = map(int, re.search(r"step cost: (\d+) solves in (\d+) steps", log).groups())
    return {line.split()[0]: [float(word) for word in line.split()[1:]] for line in lines}, solves, steps


def rows(arguments):
    for ranks in arguments.ranks:
        (first, few, _), (last, many, steps) = (count(arguments, ranks, strain) for strain in STRAINS)
        for kind in KINDS:
            each = [(b - a) / (many - few) for a, b in zip(first[kind], last[kind])]
            yield [ranks, kind, *(f"{number:.5g}" for number in each), many, steps]


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--lmp", type=os.path.abspath, default=HERE.parent / "build" / "lmp_rbc")
    parser.add_argument("--counter", type=os.path.abspath, default=HERE.parent / "build" / "bench" / "count_messages.so")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 8, 27, 64], help="cubes of whole numbers")
    parser.add_argument("--cells", type=int, default=8, help="red cells of each rank")
    arguments = command_line.parse(parser, HERE)
    with open(arguments.output / "messages.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in rows(arguments):
            writer.writerow(row)
            stream.flush()
            print(*row, flush=True)


if __name__ == "__main__":
    main()
