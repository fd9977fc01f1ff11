#!/usr/bin/env python3
"""Time of the membrane's forces per vertex and evaluation on one core.

Reads what `membrane` measured alone (Google Benchmark's JSON), measures the same in runs of LAMMPS
(row "Membrane" of the table at their end: the positions' way in and the forces' way out belong to
it), and writes membrane.csv. The executable comes from the environment (LMP_RBC).

membrane.py membrane.json --output FOLDER
"""
import csv
import json
import re
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = str(HERE.parent / "tests" / "helpers"), str(HERE.parent / "scripts")
from rbc import command_line  # noqa: E402
from lammps_case import POTENTIALS, run  # noqa: E402

SCRIPT = """
    units      micro
    atom_style molecular
    boundary   p p p
    region     box block 0 16 0 16 0 16
    create_box 1 box angle/types 1
    include    %(potentials)s/healthy.material
    molecule   rbc %(potentials)s/rbc_%(vertices)d.mol
    rbc/create rbc number 8 seed 4711 overlap 0.5
    neighbor   0.8 bin
    fix        membrane all rbc/membrane rbc mooney-rivlin ${C1} ${C2} ${h} &
               bending ${kappa} %(bending)s volume %(volume)s
    fix        flow all rbc/fluid grid 16 16 16 viscosity ${viscosity} density ${density}
    fix        ib all rbc/ib flow kernel peskin4 integrator euler
    timestep   1
    thermo     1000
    run        20
    run        %(steps)d\n"""
REPEATS = 5


def alone(path):
    """Of the repetitions that Google Benchmark made."""
    times = {}
    for result in json.load(open(path))["benchmarks"]:
        if result["run_type"] == "iteration":
            times.setdefault(result["run_name"], []).append(1e9 * result["vertex"])
    for name, of in times.items():
        law, bending, vertices = name.split("/")
        yield {"where": "alone", "what": law, "bending": bending, "vertices": vertices, "times": of}


def in_a_run(vertices, bending, volume):
    script = SCRIPT % {"potentials": POTENTIALS, "vertices": vertices, "bending": bending,
                       "volume": volume,
                       "steps": 128400 // vertices}
    times = []
    for _ in range(REPEATS):
        printed = run(script, 1).printed
        last = printed[printed.rindex("USER-RBC step cost"):]
        times.append(
            1000 * float(re.search(r"^Membrane *\|[^|]*\| *(\S+)", last, re.MULTILINE).group(1)))
    what = "mooney-rivlin" + (", volume kept" if volume == "yes" else "")
    return {"where": "run", "what": what, "bending": bending, "vertices": vertices, "times": times}


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("measured")
    command_line.add_results(parser)
    arguments = command_line.parse(parser, HERE, ["LMP_RBC"])
    rows = list(alone(arguments.measured))
    rows += [in_a_run(vertices, bending, volume) for volume in ("no", "yes")
             for bending in ("dihedral", "helfrich") for vertices in (642, 2562)]
    with open(arguments.output / "membrane.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["where", "what", "bending", "vertices", "least_ns_per_vertex",
                         "median_ns_per_vertex"])
        for row in rows:
            times = row.pop("times")
            writer.writerow([*row.values(), f"{min(times):.1f}", f"{statistics.median(times):.1f}"])
            print(f"{row['where']:6} {row['what']:28} {row['bending']:9} {row['vertices']:>5} "
                  "vertices:"
                  f" {min(times):6.1f} ns per vertex, median {statistics.median(times):6.1f}")


if __name__ == "__main__":
    main()
