"""LAMMPS molecule files of cells: Coords are the vertices, Angles the triangles (from 0 in the
arrays here)."""
from pathlib import Path

import numpy as np


def write_molecule(stream, title, points, triangles):
    """Write a LAMMPS molecule file; title holds its leading comment lines."""
    def section(name, rows):
        stream.write(f"\n{name}\n\n")
        stream.writelines(f"{i} {row}\n" for i, row in enumerate(rows, 1))

    stream.writelines(f"# {line}\n" for line in title)
    stream.write(f"\n{len(points)} atoms\n{len(triangles)} angles\n")
    section("Coords", ("{: .15e} {: .15e} {: .15e}".format(*point) for point in points))
    section("Types", ("1" for _ in points))
    section("Angles", ("1 {} {} {}".format(*triangle) for triangle in triangles + 1))


def read_molecule(path):
    """Vertices and triangles of a molecule file with Coords and Angles."""
    sections, rows = {}, None
    for line in Path(path).read_text(encoding="utf-8").splitlines()[1:]:
        words = line.split("#")[0].split()
        if words and words[0].isalpha():
            rows = sections.setdefault(words[0], [])
        elif words and rows is not None:
            rows.append([float(word) for word in words])
    if not {"Coords", "Angles"} <= sections.keys():
        raise ValueError("not a molecule file with Coords and Angles")
    coords, angles = (np.array(sorted(sections[name])) for name in ("Coords", "Angles"))
    points, triangles = coords[:, 1:4], angles[:, 2:5].astype(int) - 1
    if triangles.min() < 0 or triangles.max() >= len(points):
        raise ValueError("an angle names an atom that does not exist")
    return points, triangles
