#!/usr/bin/python3
"""Gaps between the surfaces of neighboring cells in .vtp files of fix rbc/vtk: of each two cells
nearer than a reach the least distance of all their triangles, 0 where they cut each other; writes a
row for each file to a CSV file.

surface_gaps.py cells.*.vtp --box 47.6 47.6 30 --walls z -o gaps.csv
"""
import csv

import command_line
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from surface_distances import pair_distances


def read_cells(path):
    """Vertices and triangles of each cell."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    surfaces = reader.GetOutput()
    points = vtk_to_numpy(surfaces.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(surfaces.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    molecules = vtk_to_numpy(surfaces.GetPointData().GetArray("molecule"))
    cells = []
    for molecule in np.unique(molecules):
        own = np.flatnonzero(molecules == molecule)
        mine = triangles[molecules[triangles[:, 0]] == molecule]
        cells.append((points[own], np.searchsorted(own, mine)))
    return cells


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--box", type=float, nargs=3, required=True, help="lengths of the box")
    parser.add_argument("--walls", default="", help="directions that are not periodic, of x, y, z")
    parser.add_argument("--reach", type=float, default=0.6, help="largest gap that counts")
    parser.add_argument("--bin", type=float, default=0.05, help="width of the classes of the histogram")
    parser.add_argument("-o", "--output", required=True)
    arguments = parser.parse_args()
    edges = np.arange(0, arguments.reach + arguments.bin / 2, arguments.bin)
    with open(arguments.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["file", "pairs", "cut", "least", *(f"{edge:.3g}" for edge in edges[:-1])])
        for path in arguments.files:
            gaps = pair_distances(read_cells(path), np.array(arguments.box), [d not in arguments.walls for d in "xyz"],
                                  arguments.reach)
            counts, _ = np.histogram(gaps, edges)
            row = [path, len(gaps), int((gaps == 0).sum()), f"{gaps.min(initial=arguments.reach):.4g}", *counts]
            writer.writerow(row)
            print(*row[:4], flush=True)


if __name__ == "__main__":
    main()
