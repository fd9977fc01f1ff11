#!/usr/bin/python3
"""Write a cell template: a LAMMPS molecule file of a closed, oriented triangle mesh.

The Coords are the stress-free shape, centred at 0; the Angles are the triangles, right-handed
outward. Any frequency f >= 1 gives V = 10 f^2 + 2 vertices and 20 f^2 triangles.

Lengths are in the unit of --radius or --diameter (um in `units micro`).

Shapes
  sphere  of radius R
  disc    biconcave, axis along z: z = +-(R/2) sqrt(1 - x^2) (a0 + a1 x^2 + a2 x^4), x = r/R,
          a0 = 0.207, a1 = 2.002, a2 = -1.122 (Evans and Fung, Microvasc Res 4, 335 (1972))

Examples
  make_template.py disc --diameter 7.82 --frequency 8 --output rbc_642.mol
  make_template.py sphere --radius 1 --frequency 16 --output capsule_2562.mol
"""
import argparse
import math
import sys
from collections import Counter

import numpy as np

DATE = "2026-11-22"
PROFILE = 0.207, 2.002, -1.122
CITATION = {
    "disc": "Evans and Fung, Microvasc Res, 4, 335-347 (1972)",
    "sphere": "Wenninger, Spherical Models, Cambridge University Press (1979)",
}


def icosahedron():
    """Unit vertices (12, 3) and outward faces (20, 3); three of its two-fold axes are x, y, z."""
    golden = (1 + math.sqrt(5)) / 2
    corner = np.array([(0, s, t * golden) for s in (1, -1) for t in (1, -1)])
    points = np.concatenate([np.roll(corner, k, axis=1) for k in range(3)])
    close = ((points[:, None] - points) ** 2).sum(axis=2) < 5
    faces = [(i, j, k) for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12)
             if close[i, j] and close[j, k] and close[k, i]]
    outward = [np.linalg.det(points[list(face)]) > 0 for face in faces]
    faces = [face if out else face[::-1] for face, out in zip(faces, outward)]
    return points / math.sqrt(1 + golden * golden), faces


def geodesic(frequency):
    """Unit sphere: vertices (10 f^2 + 2, 3) and outward triangles (20 f^2, 3).

    A point with barycentric counts i + j + k = f of face (a, b, c) is the direction of
    sin(i w/f) a + sin(j w/f) b + sin(k w/f) c, with w the angle of an icosahedral edge: equal
    steps along the edges, and triangle areas within a factor 1.2 of each other.
    """
    corners, faces = icosahedron()
    edge_angle = math.atan(2)
    # Rounded, so that every machine's sine gives the same file; the projection makes it exact.
    weight = [round(math.sin(edge_angle * i / frequency), 12) for i in range(frequency + 1)]
    index, points, triangles = {}, [], []

    def vertex(face, counts):
        key = tuple(sorted((corner, n) for corner, n in zip(face, counts) if n))
        if key not in index:
            index[key] = len(points)
            points.append(sum(weight[n] * corners[corner] for corner, n in key))
        return index[key]

    for face in faces:
        row = [[vertex(face, (frequency - i, i - j, j)) for j in range(i + 1)]
               for i in range(frequency + 1)]
        for i in range(frequency):
            triangles += [(row[i][j], row[i + 1][j], row[i + 1][j + 1]) for j in range(i + 1)]
            triangles += [(row[i][j], row[i + 1][j + 1], row[i][j + 1]) for j in range(i)]
    points = np.array(points)
    return points / np.sqrt((points ** 2).sum(axis=1))[:, None], np.array(triangles)


def half_thickness(x):
    """Half thickness over R of the biconcave disc at x = r/R."""
    a0, a1, a2 = PROFILE
    square = x * x
    return 0.5 * np.sqrt((1 - x) * (1 + x)) * (a0 + square * (a1 + square * a2))


def disc(points):
    """Map the unit sphere to the biconcave disc of R = 1.

    Latitude becomes arc length along the profile, in proportion: of the maps tried (equal area,
    conformal, same r), the one with the most even edges (table in README.md).
    """
    phi = np.linspace(0, np.pi / 2, 20001)
    profile = np.stack([np.sin(phi), half_thickness(np.sin(phi))])
    arc = np.append(0, np.cumsum(np.sqrt((np.diff(profile) ** 2).sum(axis=0))))
    rho = np.sqrt((points[:, :2] ** 2).sum(axis=1))
    polar = np.arctan2(rho, np.abs(points[:, 2]))
    # Rounded as above: where on the profile a vertex sits may vary, that it sits on it may not.
    x = np.round(np.sin(np.interp(polar * (2 / np.pi) * arc[-1], arc, phi)), 9)
    direction = points[:, :2] / np.where(rho > 0, rho, 1)[:, None]
    return np.column_stack([x[:, None] * direction, np.copysign(half_thickness(x), points[:, 2])])


def hilbert_order(points, bits=16):
    """Order of the points along a Hilbert curve (Skilling, AIP Conf Proc 707, 381 (2004))."""
    low = points.min(axis=0)
    # The odd offset keeps mirror planes off the cell faces.
    scaled = (points - low) / (points - low).max() * 0.97 + 0.0123
    cell = (scaled * (1 << bits)).astype(np.int64).T
    for b in range(bits - 1, 0, -1):
        bit, below = 1 << b, (1 << b) - 1
        for i in range(3):
            swap = np.where(cell[i] & bit, 0, (cell[0] ^ cell[i]) & below)
            cell[0] ^= np.where(cell[i] & bit, below, swap)
            cell[i] ^= swap
    cell[1] ^= cell[0]
    cell[2] ^= cell[1]
    flip = np.zeros_like(cell[0])
    for b in range(bits - 1, 0, -1):
        flip ^= np.where(cell[2] & (1 << b), (1 << b) - 1, 0)
    cell ^= flip
    key = np.zeros_like(flip)
    for b in range(bits - 1, -1, -1):
        for i in range(3):
            key = key << 1 | (cell[i] >> b & 1)
    return np.argsort(key, kind="stable")


def reorder(points, triangles):
    """Number the vertices along a Hilbert curve, and the triangles by their lowest vertex."""
    order = hilbert_order(points)
    rank = np.empty(len(order), dtype=int)
    rank[order] = np.arange(len(order))
    triangles = rank[triangles]
    first = triangles.argmin(axis=1)[:, None]
    triangles = np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1)
    return points[order], triangles[np.lexsort(triangles.T[::-1])]


def exact(shape, radius):
    """Area and volume of the smooth surface."""
    if shape == "sphere":
        return 4 * math.pi * radius ** 2, 4 / 3 * math.pi * radius ** 3
    a0, a1, a2 = PROFILE
    node, weight = np.polynomial.legendre.leggauss(200)
    phi, weight = np.pi / 4 * (node + 1), np.pi / 4 * weight
    r, cosine = np.sin(phi), np.cos(phi)
    shape_factor = 0.5 * (a0 + a1 * r ** 2 + a2 * r ** 4)
    slope = -r * shape_factor + cosine ** 2 * (a1 * r + 2 * a2 * r ** 3)
    area = 4 * np.pi * (weight * r * np.hypot(cosine, slope)).sum()
    volume = 4 * np.pi * (weight * r * cosine ** 2 * shape_factor).sum()
    return area * radius ** 2, volume * radius ** 3


def enclosed_volume(points, triangles):
    """Signed volume; positive when the triangles are right-handed outward."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def check(points, triangles):
    """Raise ValueError unless the mesh is a closed, outward oriented sphere."""
    count = Counter(map(tuple, np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])))
    if any(n != 1 or count[edge[::-1]] != 1 for edge, n in count.items()):
        raise ValueError("the surface is not closed and consistently oriented")
    euler = len(points) - len(count) // 2 + len(triangles)
    if euler != 2:
        raise ValueError(f"Euler characteristic is {euler}, not 2")
    if enclosed_volume(points, triangles) <= 0:
        raise ValueError("the triangles point inward")


def measure(points, triangles):
    """Area, volume, edge lengths, angles (degrees) and area ratio of a mesh."""
    corner = points[triangles]
    edge = np.roll(corner, -1, axis=1) - corner
    length = np.linalg.norm(edge, axis=2)
    cosine = -(edge * np.roll(edge, 1, axis=1)).sum(axis=2) / (length * np.roll(length, 1, axis=1))
    angle = np.degrees(np.arccos(cosine))
    area = np.linalg.norm(np.cross(edge[:, 0], edge[:, 1]), axis=1) / 2
    return {"area": area.sum(), "volume": enclosed_volume(points, triangles),
            "edge": (length.min(), length.mean(), length.max()),
            "angle": (angle.min(), angle.max()), "area_ratio": area.max() / area.min()}


def template(shape, frequency, radius, match_volume=False):
    """Checked vertices and triangles of a template, in file order."""
    points, triangles = geodesic(frequency)
    if shape == "disc":
        points = disc(points)
    points, triangles = reorder(points * radius, triangles)
    points += 0.0  # no negative zeros
    check(points, triangles)
    if match_volume:
        points *= (exact(shape, radius)[1] / enclosed_volume(points, triangles)) ** (1 / 3)
    return points, triangles


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


def report(stream, points, triangles, smooth):
    """Print sizes, mesh quality and the difference from the smooth surface."""
    found = measure(points, triangles)
    lines = [f"vertices      {len(points)}", f"triangles     {len(triangles)}"]
    for name, value in zip(("area", "volume"), smooth):
        lines.append(f"{name:13} {found[name]:.8g}  smooth {value:.8g}"
                     f"  ({100 * (found[name] / value - 1):+.4f} %)")
    lines += ["edge length   min {:.5g}  mean {:.5g}  max {:.5g}".format(*found["edge"]),
              "angle         min {:.2f}  max {:.2f} degrees".format(*found["angle"]),
              f"triangle area max/min {found['area_ratio']:.3f}",
              f"centroid      {np.abs(points.mean(axis=0)).max():.1e} from 0",
              "closed, oriented outward, Euler characteristic 2"]
    stream.write("\n".join(lines) + "\n")


def number(kind, lowest):
    """Argument type: a finite number of a kind that is at least (int) or above (float) lowest."""
    def convert(text):
        value = kind(text)
        if not math.isfinite(value) or value < lowest or (kind is float and value == lowest):
            raise ValueError
        return value
    convert.__name__ = f"{kind.__name__} {'>=' if kind is int else '>'} {lowest}"
    return convert


def parse(arguments):
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("-f", "--frequency", type=number(int, 1), required=True, metavar="F",
                        help="edges per icosahedral edge: 10 F^2 + 2 vertices")
    common.add_argument("--match-volume", action="store_true",
                        help="scale so that the polyhedron has the smooth shape's volume")
    common.add_argument("-o", "--output", metavar="FILE", help="molecule file (default: none)")
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    shapes = parser.add_subparsers(dest="shape", required=True)
    shapes.add_parser("sphere", parents=[common], help="sphere").add_argument(
        "--radius", type=number(float, 0), default=1.0, help="radius (default 1)")
    shapes.add_parser("disc", parents=[common], help="biconcave disc").add_argument(
        "--diameter", type=number(float, 0), default=7.82, help="diameter (default 7.82)")
    return parser.parse_args(arguments)


def main(arguments=None):
    args = parse(arguments)
    radius = args.radius if args.shape == "sphere" else args.diameter / 2
    points, triangles = template(args.shape, args.frequency, radius, args.match_volume)
    smooth = exact(args.shape, radius)
    report(sys.stdout, points, triangles, smooth)
    if args.output:
        size = f"--radius {radius:g}" if args.shape == "sphere" else f"--diameter {2 * radius:g}"
        command = f"{args.shape} {size} --frequency {args.frequency}"
        command += " --match-volume" if args.match_volume else ""
        title = [f"DATE: {DATE} UNITS: micro CONTRIBUTOR: USER-RBC "
                 f"CITATION: {CITATION[args.shape]}",
                 f"make_template.py {command}",
                 "smooth surface: area {:.8g}, volume {:.8g}".format(*smooth)]
        with open(args.output, "w", encoding="ascii") as stream:
            write_molecule(stream, title, points, triangles)


if __name__ == "__main__":
    main()
