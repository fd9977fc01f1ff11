#!/usr/bin/env python3
"""Packings of rbc/create: run time, least gap, directions; the same places on any number of ranks.

Writes packing.csv, packing.png (directions) and packing-cells.png to a folder; the executables come
from the environment (LMP_RBC, MPIEXEC), as in packing.sh.
"""
import csv
import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "tests" / "helpers"), str(HERE.parent / "scripts")]
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from lammps_case import POTENTIALS, Failed, dump_line, read_template, run  # noqa: E402
from rbc.surface_distances import least_gap  # noqa: E402

PLATES = 30.0    # um apart

SCRIPT = """
    units      micro
    atom_style molecular
    boundary   p p %(boundary)s
    region     box block 0 %(width).10g 0 %(width).10g 0 %(height).10g
    create_box 1 box angle/types 1
    molecule   rbc %(potentials)s/%(template)s.mol
    rbc/create rbc number %(cells)d seed %(seed)d
    %(dump)s
    fix        mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01
    fix        surfaces all rbc/vtk 1 cells.*.vtp
    timestep   1
    run        0 post no\n"""

# template, cells, hematocrit, between plates, seed, ranks
CASES = [("rbc_162", 512, hematocrit, plates, 4711, ranks) for hematocrit in (0.45, 0.50)
         for plates in (False, True)
         for ranks in (2, 1, 4)]
CASES += [("rbc_162", 512, 0.50, False, seed, 2) for seed in range(1, 8)]
CASES += [("rbc_162", 128, hematocrit, False, 4711, 2) for hematocrit in (0.55, 0.60)]
CASES += [("rbc_642", 512, hematocrit, False, 4711, 2) for hematocrit in (0.45, 0.50)]
CASES += [("rbc_162", 4096, 0.45, plates, 4711, 2) for plates in (False, True)]
PICTURE = ("rbc_162", 512, 0.45, True, 4711)
SAMPLES = 2000    # of isotropic directions


def pack(template, cells, hematocrit, plates, seed, ranks):
    points, triangles = read_template(POTENTIALS / f"{template}.mol")
    a, b, c = points[triangles].transpose(1, 0, 2)
    volume = cells * (a * np.cross(b, c)).sum() / 6 / hematocrit
    height = PLATES if plates else volume**(1 / 3)
    width = np.sqrt(volume / height)
    result = run(SCRIPT % {
        "boundary": "f" if plates else "p", "width": width, "height": height, "cells": cells,
        "potentials": POTENTIALS, "template": template, "seed": seed,
        "dump": dump_line(1, columns="id xu yu zu").replace("\n", "\n    ")}, ranks, timeout=3600)
    places = result.dump().positions().reshape(cells, len(points), 3)
    return result, places, triangles, np.array([width, width, height])


def order(axes):
    """Eigenvalues of the mean of (3 n n - 1) / 2, which are 0 for isotropic directions and 1 for
    one direction."""
    return np.linalg.eigvalsh(1.5 * axes.T @ axes / len(axes) - 0.5 * np.eye(3))


def largest_order(axes):
    return abs(order(axes)).max()


def isotropic_axes(random, count):
    axes = random.normal(size=(count, 3))
    return axes / np.linalg.norm(axes, axis=1, keepdims=True)


def short_axes(places):
    """Of the discs: their vertices spread least along them."""
    centred = places - places.mean(axis=1, keepdims=True)
    return np.array([np.linalg.eigh(cell.T @ cell)[1][:, 0] for cell in centred])


def processor_time():
    """Of all runs so far, which leaves out what other processes take on a busy machine."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measure(case, reference, output):
    template, cells, hematocrit, plates, seed, ranks = case
    row = {"template": template, "cells": cells, "hematocrit": hematocrit,
           "box": "plates" if plates else "periodic", "seed": seed, "ranks": ranks,
           "oversubscribed": "yes" if ranks > len(os.sched_getaffinity(0)) else "no",
           "load_average": f"{os.getloadavg()[0]:.1f}", "packed": hematocrit}
    spent = processor_time()
    try:
        result, places, triangles, box = pack(*case)
    except Failed as failure:
        row["packed"] = re.search(r"densest reached is a volume fraction of (\S+)",
                                  failure.result.error).group(1)
        print(*row.values(), sep=", ", flush=True)
        return row, None
    spent = processor_time() - spent
    random = np.random.default_rng(1)
    axes = short_axes(places)
    if plates:    # a cell next to a plate can only lie flat
        from_plates = np.minimum(places[..., 2], PLATES - places[..., 2]).mean(axis=1)
        axes = axes[
            from_plates > 2 * np.linalg.norm(places[0] - places[0].mean(axis=0), axis=1).max()]
    samples = [largest_order(isotropic_axes(random, len(axes))) for _ in range(SAMPLES)]
    same = ""
    if case[:5] in reference:
        same = "yes" if np.array_equal(reference[case[:5]], places) else "no"
    else:
        reference[case[:5]] = places
    row |= {"run_time_s": float(re.search(r"rbc/create CPU = (\S+)", result.printed).group(1)),
            "processor_time_s": f"{spent:.2f}",
            "attempts": int(re.search(r"Packed cells in (\d+)", result.printed).group(1)),
            "least_gap_um": "", "cells_a_diameter_from_plates": len(axes),
            "order": f"{largest_order(axes):.4f}",
            "isotropic_share_above": f"{np.mean(samples >= largest_order(axes)):.3f}",
            "mean_square_of_axis_x_y_z": " ".join(f"{x:.3f}" for x in (axes**2).mean(axis=0)),
            "same_as_first_ranks": same}
    if not same:
        gap = least_gap([(place, triangles) for place in places], box, (True, True, not plates),
                        0.2)
        row["least_gap_um"] = f"{gap:.5f}"
    print(*row.values(), sep=", ", flush=True)
    if case[:5] == PICTURE and not same:
        picture = ["--box", "0", f"{box[0]}", "0", f"{box[1]}", "0", f"{box[2]}", "--plates",
                   "--view", "25", "22"]
        subprocess.run([sys.executable, HERE.parent / "scripts" / "render_cells.py",
                        result.path("cells.0.vtp"), "-o",
                        output / "packing-cells.png", *picture], check=True)
    return row, axes


def plot(directions, path):
    """Distribution of the axes' components: uniform between 0 and 1 for isotropic directions."""
    figure = Figure(figsize=(9, 3.2), layout="constrained")
    panels = figure.subplots(1, len(directions), sharey=True)
    grid = np.linspace(0, 1, 200)
    for panel, ((_, _, hematocrit, plates, _), axes) in zip(panels, directions.items()):
        for d, name in enumerate("xyz"):
            panel.plot(np.sort(abs(axes[:, d])), (np.arange(len(axes)) + 0.5) / len(axes),
                       label=name)
        band = 1.36 / np.sqrt(len(axes))    # Kolmogorov and Smirnov, 95 %
        panel.fill_between(grid, grid - band, grid + band, color="0.85", label="isotropic, 95 %")
        panel.set_title(f"{hematocrit:.0%}, {'plates' if plates else 'periodic'}")
        panel.set_xlabel("component of the axis")
    panels[0].set_ylabel("share of cells below")
    panels[0].legend()
    figure.savefig(path, dpi=120)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--quick", action="store_true",
                        help="64 cells at most; prints the table and writes none")
    arguments = command_line.parse(parser, HERE, ["LMP_RBC", "MPIEXEC"])
    quick = arguments.quick
    cases = ([(template, 64, *rest) for template, cells, *rest in CASES if cells <= 512]
             if quick else CASES)
    rows, reference, directions = [], {}, {}
    with tempfile.TemporaryDirectory() as scratch:
        os.chdir(scratch)
        for case in cases:
            row, axes = measure(case, reference, arguments.output)
            rows.append(row)
            if case[0] == "rbc_162" and case[1] == 512 and case[4] == 4711:
                directions[case[:5]] = axes
    if quick:
        return
    with open(arguments.output / "packing.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    plot(directions, arguments.output / "packing.png")


if __name__ == "__main__":
    main()
