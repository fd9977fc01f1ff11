#!/usr/bin/python3
"""Write the surface of a vessel along x as an STL file, for `region rbc/mesh` or `create_atoms ...
mesh`.

The vessel begins at x = 0, ends at x = length and is open there: in a box that is periodic in x and
as long, it goes on for ever. With --closed it has flat lids there, for a longer box and `fix
rbc/port`. Its axis is y = z = 0 (shift it with the region). All lengths are in one unit, um in
`units micro`. A network lies where its nodes do, and is closed by half spheres about its ends.

Shapes
  tube         straight and round
  throat       a tube that narrows in its middle: straight, a taper, the throat, a taper, straight.
               The taper is half a period of a cosine, so that the wall has no edges
  bifurcation  a tube that parts into two in the plane z = 0, which join again. Daughters have the
               diameter of Murray's law, 2^(-1/3) of the parent's, unless told otherwise
  network      round tubes between nodes, from two tables: of nodes, with the columns node, x, y, z,
               and of segments, with the columns from, to (names of nodes) and radius. Where tubes
               meet, edges are rounded

Examples
  make_vessel.py tube --length 45 --diameter 22.5 tube.stl
  make_vessel.py throat --unit 8 throat.stl       # Figure 6 of Xu et al. 2017 for cells of 8 um
  make_vessel.py bifurcation --length 120 --diameter 20 --distance 24 fork.stl
  make_vessel.py bifurcation --length 60 --diameter 16 --closed fork.stl    # for ports at both ends
  make_vessel.py network --nodes nodes.csv --segments segments.csv net.stl     # examples/network
"""
import math
import sys
from pathlib import Path

from rbc import command_line
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

import vessel_network

CENTRELINE = 400      # points along it at the least,
APART = 0.05          # and so far apart, in radii: a tube of spheres is a 3e-4 narrower at the most
MOST_TRIANGLES = 2e7
MOST_CELLS = 5e7      # of the grid around a network: some 4 GB at most, for a moment
SIZES = {             # that only some shapes have
    "throat_diameter": "throat", "throat_length": "throat", "taper": "throat",
    "daughter_diameter": "bifurcation", "distance": "bifurcation", "nodes": "network",
    "segments": "network"}
NOT_OF_NETWORKS = "unit", "length", "diameter", "closed"
BLEND = 0.15          # of the parent's diameter: where branches meet


def swept(radius, length, edge):
    """Points and triangles of a surface of revolution about x, from rings that are turned by half a
    step each."""
    widest = radius(np.linspace(0, length, 1001)).max()
    around = max(8, round(2 * np.pi * widest / edge))
    # even: the last is turned as the first
    rings = 2 * max(2, round(length / (edge * np.sqrt(3) / 2) / 2))
    x = np.linspace(0, length, rings + 1)
    angle = 2 * np.pi * (np.arange(around) + 0.5 * (np.arange(rings + 1)[:, None] % 2)) / around
    r = radius(x)[:, None]
    points = np.stack([x[:, None] + 0 * angle, r * np.cos(angle), r * np.sin(angle)],
                      axis=-1).reshape(-1, 3)
    triangles = []
    j = np.arange(around)
    following = (j + 1) % around
    for i in range(rings):
        here, beyond = i * around, (i + 1) * around
        if i % 2 == 0:
            triangles += [np.stack([here + j, here + following, beyond + j], 1),
                          np.stack([here + following, beyond + following, beyond + j], 1)]
        else:
            triangles += [np.stack([here + j, beyond + following, beyond + j], 1),
                          np.stack([here + j, here + following, beyond + following], 1)]
    return points, np.concatenate(triangles)


def tube_radius(options):
    return lambda x: np.full_like(x, options.diameter / 2)


def throat_radius(options):
    wide, narrow = options.diameter / 2, options.throat_diameter / 2
    half = options.throat_length / 2

    def radius(x):
        along = np.clip((np.abs(x - options.length / 2) - half) / options.taper, 0, 1)
        return narrow + (wide - narrow) * (1 - np.cos(np.pi * along)) / 2
    return radius


def rise(t):
    """From 0 to 1, smooth to the second derivative."""
    t = np.clip(t, 0, 1)
    return t**3 * (10 - 15 * t + 6 * t**2)


def fork(options):
    """Points and triangles: a contour of the distance from the walls of both branches, blended
    where they meet."""
    length, parent, daughter = options.length, options.diameter / 2, options.daughter_diameter / 2
    count = max(CENTRELINE, math.ceil((length + 2 * parent) / (APART * min(parent, daughter))) + 1)
    s = np.linspace(-parent, length + parent, count)
    part = rise((s / length - 0.1) / 0.3) * rise((0.9 - s / length) / 0.3)
    centres = np.stack([s, options.distance / 2 * part], axis=-1)
    radii = parent + (daughter - parent) * part

    step = options.edge
    reach = np.array([0, options.distance / 2 + daughter, 0]) + parent + 2 * step
    counts = [round(length / step) + 1, 2 * int(np.ceil(reach[1] / step)) + 1,
              2 * int(np.ceil(reach[2] / step)) + 1]
    spacing = [length / (counts[0] - 1), step, step]
    x, y, z = (np.arange(n) * h - (0 if d == 0 else (n - 1) * h / 2)
               for d, (n, h) in enumerate(zip(counts, spacing)))
    flat = np.empty((2, len(z), len(y), len(x)))
    blend = BLEND * options.diameter
    for here, near in pieces(x, s, max(parent, daughter) + blend + 2 * step):
        for branch, side in enumerate((1, -1)):
            for j, row in enumerate(y):
                square = ((x[here, None] - centres[near, 0])**2
                          + (row - side * centres[near, 1])**2)
                for k, height in enumerate(z):
                    flat[branch, k, j, here] = (np.sqrt(square + height**2)
                                                - radii[near]).min(axis=1)
    nearer = np.maximum(blend - np.abs(flat[0] - flat[1]), 0) / blend
    field = flat.min(axis=0) - nearer**2 / 4 * blend * blending(x, length)
    image = vtkImageData()
    image.SetDimensions(*counts)
    image.SetSpacing(*spacing)
    image.SetOrigin(x[0], y[0], z[0])
    image.GetPointData().SetScalars(numpy_to_vtk(field.ravel(), deep=True))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    contour.ComputeNormalsOff()
    contour.Update()
    surface = contour.GetOutput()
    return (vtk_to_numpy(surface.GetPoints().GetData()).astype(float),
            vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)[:, ::-1]
            .astype(int))


def pieces(x, s, reach):
    """Pieces of x, and of s what is within reach of each."""
    for start in np.arange(x[0], x[-1] + 1e-9 * reach, 4 * reach):
        here = np.flatnonzero((x >= start) & (x < start + 4 * reach))
        if len(here):
            near = np.flatnonzero((s >= x[here[0]] - reach) & (s <= x[here[-1]] + reach))
            yield slice(here[0], here[-1] + 1), slice(near[0], near[-1] + 1)


def blending(x, length):
    """Nothing where both branches are one tube."""
    return rise((x / length - 0.1) / 0.1) * rise((0.9 - x / length) / 0.1)


def enclosed_volume(points, triangles):
    """Of a surface that is open in planes of constant x only."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = np.cross(b - a, c - a) / 2
    middle = (a + b + c) / 3
    return (area[:, 1:] * middle[:, 1:]).sum() / 2, np.linalg.norm(area, axis=1).sum()


def with_lids(points, triangles):
    """The same with a fan of triangles over each end."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    key, back = sides @ [len(points), 1], sides[:, ::-1] @ [len(points), 1]
    rim = sides[~np.isin(key, back)]
    for end in (points[:, 0].min(), points[:, 0].max()):
        here = rim[points[rim[:, 0], 0] == end]
        middle = np.full(len(here), len(points))
        points = np.concatenate([points, points[here[:, 0]].mean(axis=0)[None]])
        triangles = np.concatenate([triangles, np.stack([here[:, 1], here[:, 0], middle], 1)])
    return points, triangles


def write_stl(path, points, triangles):
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    record = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)),
                                             ("attribute", "<u2")])
    record["normal"] = normals / np.where(size > 0, size, 1)
    record["corners"] = corners
    with open(path, "wb") as file:
        file.write(b"vessel by make_vessel.py".ljust(80) + np.uint32(len(record)).tobytes() +
                   record.tobytes())


def parse(words):
    parser = command_line.parser(__doc__)
    parser.add_argument("shape", choices=["tube", "throat", "bifurcation", "network"])
    parser.add_argument("output", type=Path, help="the STL file (binary)")
    parser.add_argument("--unit", type=float, help="all defaults below are in this length (1)")
    parser.add_argument("--length", type=float, help="of the vessel (15)")
    parser.add_argument("--diameter", type=float, help="of the tube or parent (3)")
    parser.add_argument("--throat-diameter", type=float, help="(half the diameter)")
    parser.add_argument("--throat-length", type=float,
                        help="of its straight part (a fifteenth of the length)")
    parser.add_argument("--taper", type=float,
                        help="length of each taper (two fifteenths of the length)")
    parser.add_argument("--daughter-diameter", type=float, help="(2^(-1/3) diameters)")
    parser.add_argument("--distance", type=float,
                        help="between the axes of the daughters (1.2 diameters)")
    parser.add_argument("--nodes", type=Path, metavar="CSV",
                        help="table of a network: node, x, y, z")
    parser.add_argument("--segments", type=Path, metavar="CSV",
                        help="table of a network: from, to, radius")
    parser.add_argument("--edge", type=float,
                        help="of the triangles (a twentieth of the least diameter)")
    parser.add_argument("--closed", action="store_true", help="with lids on both ends")
    options = parser.parse_args(words)
    for name, shape in SIZES.items():
        if getattr(options, name) is not None and options.shape != shape:
            parser.error(
                f"--{name.replace('_', '-')} is for the shape {shape}, not {options.shape}")
    if options.shape == "network":
        complete_network(parser, options)
    else:
        complete(parser, options)
        check(parser, options)
    return options


def default(parser, options, name, value):
    if getattr(options, name) is None:
        setattr(options, name, value)
    if not 0 < getattr(options, name) < math.inf:
        parser.error(f"--{name.replace('_', '-')} {getattr(options, name)} must be > 0 and finite")


def complete(parser, options):
    """Gives sizes that were left out their defaults."""
    default(parser, options, "unit", 1)
    default(parser, options, "length", 15 * options.unit)
    default(parser, options, "diameter", 3 * options.unit)
    default(parser, options, "throat_diameter", options.diameter / 2)
    default(parser, options, "throat_length", options.length / 15)
    default(parser, options, "taper", 2 * options.length / 15)
    default(parser, options, "daughter_diameter", options.diameter * 2**(-1 / 3))
    default(parser, options, "distance", 1.2 * options.diameter)
    default(parser, options, "edge", options.diameter / 20)


def complete_network(parser, options):
    """Reads its tables."""
    for name in NOT_OF_NETWORKS:
        if getattr(options, name):
            parser.error(f"--{name} is not for the shape network, whose sizes are in its tables")
    if options.nodes is None or options.segments is None:
        parser.error("the shape network needs --nodes and --segments")
    options.network = vessel_network.read_network(options.nodes, options.segments)
    default(parser, options, "edge", options.network.radii.min() / 10)
    check_count(parser, options,
                2 * math.pi * (options.network.radii * options.network.lengths()).sum())
    cells = np.prod(options.network.extent() / options.edge)
    if cells > MOST_CELLS:
        parser.error(f"--edge {options.edge:g} makes about {cells:.1g} cells in the box around the "
                     f"network, more than {MOST_CELLS:.0g}")


def check(parser, options):
    """What sizes must be to each other."""
    if options.shape == "throat" and options.throat_diameter > options.diameter:
        parser.error(f"--throat-diameter {options.throat_diameter:g} must not be above the "
                     f"--diameter {options.diameter:g}")
    if options.shape == "throat" and options.throat_length + 2 * options.taper > options.length:
        parser.error(
            f"throat and tapers are {options.throat_length + 2 * options.taper:g} long, the vessel "
            f"{options.length:g}")
    if (options.shape == "bifurcation"
            and options.distance < options.daughter_diameter + 2 * options.edge):
        parser.error(f"--distance {options.distance:g} leaves the daughters, "
                     f"{options.daughter_diameter:g} wide, in one")
    check_count(parser, options, math.pi * options.diameter * options.length)


def check_count(parser, options, area):
    triangles = 2 * area / options.edge**2
    if triangles > MOST_TRIANGLES:
        parser.error(f"--edge {options.edge:g} makes about {triangles:.1g} triangles, more than "
                     f"{MOST_TRIANGLES:.0g}")


def main(words):
    options = parse(words)
    if options.shape == "network":
        points, triangles = vessel_network.surface(options.network, options.edge)
    elif options.shape == "bifurcation":
        points, triangles = fork(options)
    else:
        radius = tube_radius(options) if options.shape == "tube" else throat_radius(options)
        points, triangles = swept(radius, options.length, options.edge)
    if options.closed:
        points, triangles = with_lids(points, triangles)
    write_stl(options.output, points, triangles)
    volume, area = enclosed_volume(points, triangles)
    print(f"{options.output}: {len(triangles)} triangles, area {area:.6g}, volume {volume:.6g}\n"
          f"x {points[:, 0].min():.6g} to {points[:, 0].max():.6g}, "
          f"y {points[:, 1].min():.6g} to {points[:, 1].max():.6g}, "
          f"z {points[:, 2].min():.6g} to {points[:, 2].max():.6g}")


if __name__ == "__main__":
    main(sys.argv[1:])
