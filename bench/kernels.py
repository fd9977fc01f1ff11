#!/usr/bin/env python3
"""Puts the results of `kernels` (Google Benchmark's JSON, named *.<ranks>.json) into kernels.csv
and a table.

kernels.py kernels.1.json [kernels.2.json ...] --output FOLDER
"""
import csv
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
from rbc import command_line  # noqa: E402

NUMBERS = ["least", "median", "fftw_estimate", "fftw_measure"]
UNITS = {"walled": "ns/cell", "periodic": "ns/cell", "halo": "ns/ghost cell",
         "spread": "ns/vertex", "interpolate": "ns/vertex"}


def read(path):
    ranks = int(path.split(".")[-2])
    with open(path) as file:
        for run in json.load(file)["benchmarks"]:
            part, kind, cells = run["name"].split("/")[:3]
            yield {"part": part, "kind": kind, "cells": cells, "ranks": ranks, "unit": UNITS[part],
                   **{key: round(run[key], 2) for key in NUMBERS if key in run}}


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("results", nargs="+")
    command_line.add_results(parser)
    arguments = command_line.parse(parser, HERE)
    rows = [row for path in arguments.results for row in read(path)]
    with open(arguments.output / "kernels.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, ["part", "kind", "cells", "ranks", "unit"] + NUMBERS,
                                lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)

    alone = {(r["part"], r["kind"], r["cells"]): r["least"] for r in rows if r["ranks"] == 1}
    print(f"{'':32}{'ranks':>5}{'least':>9}{'median':>9} {'':13}"
          "    over bare FFTW: estimated  measured   speed-up")
    for row in rows:
        line = f"{row['part']}/{row['kind']}/{row['cells']}"
        line = f"{line:32}{row['ranks']:5}{row['least']:9.1f}{row['median']:9.1f} {row['unit']:13}"
        if "fftw_estimate" in row:
            ratios = [row["least"] / row[key] for key in NUMBERS[2:]]
            line += f"{'':20}{ratios[0]:9.2f}{ratios[1]:10.2f}"
        if row["ranks"] > 1 and row["unit"] == "ns/cell":
            line += f"{alone[row['part'], row['kind'], row['cells']] / row['least']:50.2f}"
        print(line)


if __name__ == "__main__":
    main()
