#!/usr/bin/env python3
"""Messages and bytes that a rank sends in a solve of dense blood, with as many cells for each rank.
Runs examples/suspension/in.suspension on cubes of ranks, which may share cores: counts do not
depend on time. Each count is the difference of a longer run and a shorter one.

messages.py --output FOLDER --counter ../build/count_messages.so [--ranks 1 8 27 64]

Writes messages.csv and messages.png: the counts, and the time of a solve on a network of the
LATENCY and BANDWIDTH below. Messages of one kind are taken to follow each other; those of
transposes go as the square root of the number of ranks, bytes of all others as the surface of what
a rank has.
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
from rbc import command_line  # noqa: E402
from example_study import POTENTIALS  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
import numpy as np  # noqa: E402

SCRIPT = HERE.parent / "examples" / "suspension" / "in.suspension"
VOLUME = 89.30                       # of rbc_162, um^3
HEMATOCRIT = 0.35                    # less than in the scene: small boxes are hard to pack
STRAINS = 0.05, 0.2                  # of both runs
KINDS = {"halo": "layers of fluid cells", "transposes": "transposes of the fluid's transforms",
         "shared_cells": "sums of shared cells", "lammps": "atoms and forces, by LAMMPS",
         "collective": "collective calls"}
NUMBERS = "messages", "bytes", "most_messages", "most_bytes"
LATENCY, BANDWIDTH = 2e-6, 1e10      # of the network: s, bytes/s for each rank
VERTICES, COMPUTE = 162, 6e-7        # of a cell; s for each vertex and solve
PAPER = 49152                        # cells of the paper's scene
COLUMNS = ("ranks", "kind", *(f"{name}_per_solve" for name in NUMBERS), "solves", "steps")


def count(arguments, ranks, strain):
    """({kind: NUMBERS}, solves, steps) of a run from its start."""
    side = round(ranks ** (1 / 3))
    cells = arguments.cells * ranks
    gap = (arguments.cells * VOLUME / HEMATOCRIT) ** (1 / 3) * side
    variables = {"cells": cells, "gap": f"{gap:.10g}", "strain": strain,
                 "hematocrit": HEMATOCRIT, "sigma": 0, "rate": 100, "every": 1000000,
                 "frames": 1000000, "templates": POTENTIALS}
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "-np", str(ranks), "-x", f"LD_PRELOAD={arguments.counter}",
                   "-x", f"COUNT_MESSAGES={folder}/counted", arguments.lmp, "-in", SCRIPT,
                   "-log", "log"]
        for name, value in variables.items():
            command += ["-var", name, str(value)]
        subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        lines = (Path(folder) / "counted").read_text(encoding="utf-8").splitlines()
        log = (Path(folder) / "log").read_text(encoding="utf-8")
    solves, steps = map(int, re.search(r"step cost: (\d+) solves in (\d+) steps", log).groups())
    counted = {line.split()[0]: [float(word) for word in line.split()[1:]] for line in lines}
    return counted, solves, steps


def rows(arguments):
    for ranks in arguments.ranks:
        runs = [count(arguments, ranks, strain) for strain in STRAINS]
        (first, few, _), (last, many, steps) = runs
        for kind in KINDS:
            each = [(b - a) / (many - few) for a, b in zip(first[kind], last[kind])]
            yield [ranks, kind, *(f"{number:.5g}" for number in each), many, steps]


def network_seconds(table, ranks, cells, measured_cells):
    """Of a solve with so many cells for each rank, by the counts on the most ranks."""
    most = max(table)
    messages, moved = ({kind: table[most][kind][n] for kind in KINDS} for n in (0, 1))
    surface = (cells / measured_cells) ** (2 / 3)
    seconds = messages["collective"] * LATENCY * np.log2(ranks)
    for kind in ("halo", "shared_cells", "lammps"):
        seconds = seconds + messages[kind] * LATENCY + moved[kind] * surface / BANDWIDTH
    return (seconds + messages["transposes"] * LATENCY * np.sqrt(ranks / most)
            + moved["transposes"] * cells / measured_cells / BANDWIDTH)


def draw(table, cells, path):
    figure = Figure(figsize=(11, 4.4), layout="constrained")
    counts, times = figure.subplots(1, 2)
    for kind, label in KINDS.items():
        sent = {ranks: table[ranks][kind][0] for ranks in table if table[ranks][kind][0] > 0}
        counts.loglog(list(sent), list(sent.values()), "o-", label=label)
    counts.set(xlabel="ranks", ylabel="messages of a rank in a solve")
    ranks = np.logspace(np.log10(max(table)), 5, 60)
    for title, each in ((f"{cells} cells for each rank", 0 * ranks + cells),
                        ("512 cells for each rank", 0 * ranks + 512),
                        (f"{PAPER} cells in all", PAPER / ranks)):
        line, = times.loglog(ranks, network_seconds(table, ranks, each, cells),
                             label=f"{title}: network")
        times.loglog(ranks, each * VERTICES * COMPUTE, "--", color=line.get_color(),
                     label=f"{title}: computing")
    times.set(xlabel="ranks", ylabel="seconds of a solve")
    for axes in (counts, times):
        axes.legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    build = HERE.parent / "build"
    parser.add_argument("--lmp", type=os.path.abspath, default=build / "lmp_rbc")
    parser.add_argument("--counter", type=os.path.abspath, default=build / "count_messages.so")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 8, 27, 64],
                        help="cubes of whole numbers")
    parser.add_argument("--cells", type=int, default=8, help="red cells of each rank")
    arguments = command_line.parse(parser, HERE)
    with open(arguments.output / "messages.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        table = {}
        for row in rows(arguments):
            writer.writerow(row)
            stream.flush()
            print(*row, flush=True)
            table.setdefault(row[0], {})[row[1]] = [float(number) for number in row[2:6]]
    draw(table, arguments.cells, arguments.output / "messages.png")


if __name__ == "__main__":
    main()
