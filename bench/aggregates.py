#!/usr/bin/python3
"""Core time of compute rbc/aggregate per call, for columns of stacked cells (162 vertices, 0.3 um
apart).

Four runs of one script at rest: without the compute, with it but not called, called every step, and
called every step with the keyword area. What it costs is the difference to the first; core time is
run time times the use of the CPU, so that other work on the machine counts little. The number of
aggregates must be that of the columns.
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

POTENTIALS = HERE.parent / "potentials"

SCENE = """
units           micro
atom_style      molecular
region          box block 0 8.9 0 8.9 0 11.2
create_box      1 box angle/types 1
molecule        rbc {potentials}/rbc_162.mol
rbc/create      rbc single 4.45 4.45 1.4
rbc/create      rbc single 4.45 4.45 4.2
rbc/create      rbc single 4.45 4.45 7.0
rbc/create      rbc single 4.45 4.45 9.8
replicate       {columns} {columns} {height}
neighbor        1.0 bin
fix             mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 volume no
run             {steps}
compute         agg all rbc/aggregate 0.5
run             {steps}
fix             sizes all ave/time 1 1 1 c_agg[1]
thermo_style    custom step c_agg[1]
run             {steps}
unfix           sizes
uncompute       agg
compute         agg all rbc/aggregate 0.5 area 0.1
fix             sizes all ave/time 1 1 1 c_agg[1]
run             {steps}
"""
FIELDS = ("cells", "ranks", "case", "core_ms_per_step", "core_ms_per_call",
          "core_us_per_vertex_and_call", "MB_per_rank")
CASES = ("without", "not called", "called", "called, area")
# cells: columns along x and y, times 4 cells of height
SHAPES = {512: (8, 2), 4096: (16, 4), 49152: (32, 12)}


def run(cells, ranks, steps):
    """Core milliseconds per step of each case and memory per rank in MB."""
    columns, height = SHAPES[cells]
    name = f"in.{cells}"
    with open(name, "w", encoding="utf-8") as stream:
        stream.write(SCENE.format(potentials=POTENTIALS, columns=columns, height=height,
                                  steps=steps))
    command = [os.environ["MPIEXEC"], "-np", str(ranks), os.environ["LMP_RBC"], "-in", name, "-log",
               f"log.{cells}.{ranks}"]
    printed = subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout
    found = {int(float(text))
             for text in re.findall(r"^ +\d+ +([\d.e+]+) *$", printed, re.MULTILINE)}
    if found != {columns**2}:
        raise SystemExit(f"{cells} cells on {ranks} ranks: aggregates {found}, not {columns**2}")
    times = [float(text) for text in re.findall(r"^Loop time of (\S+)", printed, re.MULTILINE)]
    use = [float(text) / 100 for text in re.findall(r"^(\S+)% CPU use", printed, re.MULTILINE)]
    memory = [float(text) for text in re.findall(r"\| ([\d.]+) Mbytes", printed)]
    return [1000 * t * u * ranks / steps for t, u in zip(times, use)], memory


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--cells", type=int, nargs="+", default=[512, 4096], choices=SHAPES)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--vertex-steps", type=float, default=3e6,
                        help="vertices times steps of each run")
    options = command_line.parse(parser, HERE, ["LMP_RBC", "MPIEXEC"])

    with open(options.output / "aggregates.csv", "w", newline="", encoding="utf-8") as stream, \
            tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        table = csv.DictWriter(stream, FIELDS)
        table.writeheader()
        for cells in options.cells:
            for ranks in options.ranks:
                vertices = 162 * cells
                times, memory = run(cells, ranks, max(3, round(options.vertex_steps / vertices)))
                for case, time, size in zip(CASES, times, memory):
                    row = dict(
                        zip(FIELDS, (cells, ranks, case, f"{time:.4g}", f"{time - times[0]:.3g}",
                                     f"{1000 * (time - times[0]) / vertices:.3g}", f"{size:.4g}")))
                    table.writerow(row)
                    stream.flush()
                    print(" ".join(f"{name}={value}" for name, value in row.items()))


if __name__ == "__main__":
    main()
