#!/usr/bin/env python3
"""Scaling of fix rbc/fluid, alone and with red cells, over ranks and over layouts of the ranks.

Writes scaling.csv and scaling.png to a folder; the executables come from the environment (LMP_RBC,
MPIEXEC), as in scaling.sh.
"""
import csv
import os
import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = str(HERE.parent / "tests" / "helpers"), str(HERE.parent / "scripts")
from rbc import command_line  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from lammps_case import POTENTIALS, run  # noqa: E402

RANKS = (1, 2, 4)
LAYOUTS = {"default": "", "* * 1": "processors * * 1"}
CORES = len(os.sched_getaffinity(0))

FLUID = """
    units      micro
    boundary   p p f
    %(layout)s
    region     box block 0 64 0 64 0 64
    create_box 1 box
    mass       1 1
    timestep   1
    fix        flow all rbc/fluid grid 128 128 128 viscosity 1.2 density 1 inertia unsteady &
               wall zlo 0 0 0 wall zhi 0.001 0 0
    thermo     1000
    run        2
    run        %(steps)d\n"""

SUSPENSION = """
    units      micro
    atom_style molecular
    boundary   p p f
    %(layout)s
    region     box block 0 24 0 24 0 24
    create_box 1 box angle/types 1
    include    %(potentials)s/healthy.material
    molecule   rbc %(potentials)s/rbc_642.mol
    rbc/create rbc number 27 seed 4711 overlap 0.5
    neighbor   0.8 bin
    fix        membrane all rbc/membrane rbc mooney-rivlin ${C1} ${C2} ${h} &
               bending ${kappa} volume yes
    fix        flow all rbc/fluid grid 64 64 64 viscosity ${viscosity} density ${density} &
               inertia unsteady wall zlo -0.0012 0 0 wall zhi 0.0012 0 0
    fix        ib all rbc/ib flow kernel peskin4
    timestep   100
    thermo     1000
    run        2
    run        %(steps)d\n"""

# script, steps, what it is
SCENES = {"fluid": (FLUID, 40, "fluid alone, 128³ cells"),
          "suspension": (SUSPENSION, 100, "27 red cells of 642 vertices, 64³ cells")}
SECTIONS = ("Membrane", "Spread", "Solve", "Interpolate", "Exchange")
LINES = {("fluid", "default"): ("C0", "o", "-"), ("fluid", "* * 1"): ("C0", "s", "--"),
         ("suspension", "default"): ("C1", "o", "-"), ("suspension", "* * 1"): ("C1", "s", "--")}


def measure(scene, ranks, layout):
    """Of the second run of the script, in which the flow no longer starts."""
    script, steps, _ = SCENES[scene]
    printed = run(script % {"layout": LAYOUTS[layout], "steps": steps, "potentials": POTENTIALS},
                  ranks).printed
    last = printed[printed.rindex("USER-RBC step cost"):]
    fluid = re.search(r"Fluid: (\S+) messages and (\S+) bytes per step and MPI task, (\S+) bytes",
                      last)
    messages, size, memory = (float(number) for number in fluid.groups())
    row = {"scene": scene, "ranks": ranks, "oversubscribed": "yes" if ranks > CORES else "no",
           "layout": layout if ranks > 1 else "any",
           "processors": re.search(r"(\d+) by (\d+) by (\d+) MPI", printed).expand(r"\1x\2x\3"),
           "steps": steps,
           "run_time_s": float(re.search(r"Loop time of (\S+)", last).group(1)), "speed_up": 1.0,
           "messages_per_step_and_rank": messages, "bytes_per_step_and_rank": size,
           "memory_bytes_per_cell": memory}
    for section in SECTIONS:
        cost = re.search(rf"^{section} *\| *(\S+)", last, re.MULTILINE)
        row[f"{section.lower()}_core_ms_per_solve"] = (f"{1000 * float(cost.group(1)):.4g}"
                                                       if cost else "")
    return row


def draw(rows, path):
    figure = Figure(figsize=(12, 8), layout="constrained")
    (faster, traffic), (memory, parts) = figure.subplots(2, 2)
    for (scene, layout), (color, marker, style) in LINES.items():
        mine = [row for row in rows if row["scene"] == scene and row["layout"] in (layout, "any")]
        ranks = [row["ranks"] for row in mine]
        for axes, name, unit in ((faster, "speed_up", 1), (traffic, "bytes_per_step_and_rank", 1e6),
                                 (memory, "memory_bytes_per_cell", 1)):
            axes.plot(ranks, [row[name] / unit for row in mine], color=color, marker=marker,
                      ls=style, mfc="white" if marker == "s" else None,
                      label=f"{SCENES[scene][2]}, processors {layout}")
        for row in mine[1:]:
            place = row["ranks"], row["bytes_per_step_and_rank"] / 1e6
            traffic.annotate(f"{row['messages_per_step_and_rank']:.3g}", place,
                             (0, -14 if layout == "default" else 7),
                             textcoords="offset points", ha="center", size=8, color=color)
    faster.plot(RANKS, RANKS, color="0.6", lw=1, label="ideal")
    faster.legend(fontsize=8)
    for axes, title in ((faster, "speed-up of a run"),
                        (traffic, "MB per step and rank (labels: messages)"),
                        (memory, "memory of the flow, bytes per cell")):
        axes.set_title(title, size=11)
        axes.set_xlabel("ranks" + f" (shaded: they share {CORES} cores)" * (CORES < max(RANKS)))
        axes.set_xticks(RANKS)
        axes.set_ylim(0, axes.get_ylim()[1] * 1.1)
        if CORES < max(RANKS):
            axes.axvspan(CORES + 0.5, max(RANKS) + 0.5, color="0.93", zorder=0)
        axes.grid(alpha=0.3)

    bars = [row for row in rows if row["scene"] == "suspension"]
    below = [0.0] * len(bars)
    for section in SECTIONS:
        heights = [float(row[f"{section.lower()}_core_ms_per_solve"]) for row in bars]
        parts.bar(range(len(bars)), heights, bottom=below, width=0.6, label=section)
        below = [low + height for low, height in zip(below, heights)]
    parts.set_xticks(range(len(bars)), ["{ranks}: {processors}".format(**row)
                                        + "\n(they wait)" * (row["ranks"] > CORES) for row in bars])
    parts.set_xlabel("ranks: processors")
    parts.set_title("suspension: core time of a solve with all that belongs to it (ms)", size=11)
    parts.legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--repeats", type=int, default=3,
                        help="runs of each case, of which the quickest counts")
    cases = [(scene, ranks, layout) for scene in SCENES for ranks in RANKS for layout in LAYOUTS
             if ranks > 1 or layout == "default"]
    arguments = command_line.parse(parser, HERE, ["LMP_RBC", "MPIEXEC"])
    runs = []
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for _ in range(arguments.repeats):
            runs.append([measure(*case) for case in cases])
    rows = [min(repeats, key=lambda row: row["run_time_s"]) for repeats in zip(*runs)]
    alone = {row["scene"]: row["run_time_s"] for row in rows if row["ranks"] == 1}
    for row in rows:
        row["speed_up"] = round(alone[row["scene"]] / row["run_time_s"], 2)
        print("{scene:10} {ranks} rank(s) ({processors}) {run_time_s:8.3f} s, speed-up "
              "{speed_up:.2f}".format(**row)
              + f", {row['ranks']} ranks share {CORES} cores" * (row["ranks"] > CORES))
    with open(arguments.output / "scaling.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    draw(rows, arguments.output / "scaling.png")


if __name__ == "__main__":
    main()
