"""Gaps between the surfaces of neighboring cells in .vtp files of fix rbc/vtk: of each two cells
nearer than a reach the least distance of all their triangles, 0 where they cut each other; writes a
row for each file to a CSV file.

%(prog)s cells.*.vtp --box 47.6 47.6 30 --walls z -o gaps.csv
"""
import csv

from rbc import command_line
import numpy as np

from rbc.surface_distances import pair_distances
from rbc.surfaces import read_cells


def main(arguments=None):
    parser = command_line.parser(__doc__)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--box", type=float, nargs=3, required=True, help="lengths of the box")
    parser.add_argument("--walls", default="", help="directions that are not periodic, of x, y, z")
    parser.add_argument("--reach", type=float, default=0.6, help="largest gap that counts")
    parser.add_argument("--bin", type=float, default=0.05,
                        help="width of the classes of the histogram")
    parser.add_argument("-o", "--output", required=True)
    arguments = parser.parse_args(arguments)
    edges = np.arange(0, arguments.reach + arguments.bin / 2, arguments.bin)
    periodic = [d not in arguments.walls for d in "xyz"]
    with open(arguments.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["file", "pairs", "cut", "least", *(f"{edge:.3g}" for edge in edges[:-1])])
        for path in arguments.files:
            gaps = pair_distances(read_cells(path), np.array(arguments.box), periodic,
                                  arguments.reach)
            counts, _ = np.histogram(gaps, edges)
            least = gaps.min(initial=arguments.reach)
            row = [path, len(gaps), int((gaps == 0).sum()), f"{least:.4g}", *counts]
            writer.writerow(row)
            print(*row[:4], flush=True)
