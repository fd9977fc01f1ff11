#!/usr/bin/python3
"""Write a cell template: a LAMMPS molecule file of a closed, oriented triangle mesh.

The Coords are the shape, centred at 0; the Angles are the triangles, right-handed outward. Shapes
other than `mesh` have V = 10 f^2 + 2 vertices and 20 f^2 triangles for any frequency f >= 1.

Lengths are in the unit of --radius, --diameter or the mesh (um in `units micro`).

Shapes
  sphere    of radius R
  disc      biconcave, axis along z: z = +-(R/2) sqrt(1 - x^2) (a0 + a1 x^2 + a2 x^4), x = r/R,
            a0 = 0.207, a1 = 2.002, a2 = -1.122 (Evans and Fung, Microvasc Res 4, 335 (1972))
  spheroid  axis along z, by the ratio of its axis to its diameter or by its reduced volume. With
            --like, of the area, triangles and numbering of a disc or sphere: the stress-free shape
            of such a cell
  sickle    ellipsoid bent along its long axis
  mesh      a surface from an STL, PLY, OFF or VTP file, or another template

Examples
  make_template.py disc --diameter 7.82 --frequency 8 --output rbc_642.mol
  make_template.py sphere --radius 1 --frequency 16 --output capsule_2562.mol
  make_template.py spheroid --reduced-volume 0.95 --like rbc_642.mol --output rbc_642_spheroid95.mol
  make_template.py mesh scan.stl --volume 94 --output scan.mol
"""
import argparse
import math
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402

import shapes  # noqa: E402
import surface_mesh  # noqa: E402
from molecule_file import read_molecule, write_molecule

DATE = "2026-11-22"
CITATION = {
    "disc": "Evans and Fung, Microvasc Res, 4, 335-347 (1972)",
    "sphere": "Wenninger, Spherical Models, Cambridge University Press (1979)",
    "spheroid": "Wenninger, Spherical Models, Cambridge University Press (1979)",
    "sickle": "Wenninger, Spherical Models, Cambridge University Press (1979)",
}


def numbered(shape, points, triangles):
    """Points and triangles along a Hilbert curve of `shape`, another surface of the same
    triangles."""
    order = surface_mesh.hilbert_order(shape)
    return points[order], surface_mesh.renumber(order, triangles)


def template(shape, frequency, radius, match_volume=False):
    """Checked vertices and triangles of a sphere or disc, in file order."""
    points, triangles = shapes.geodesic(frequency)
    if shape == "disc":
        points = shapes.disc(points)
    points, triangles = numbered(points * radius, points * radius, triangles)
    points += 0.0  # no negative zeros
    surface_mesh.check(points, triangles)
    if match_volume:
        points = scaled_to_volume(exact(shape, radius)[1], points, triangles)
    return points, triangles


def scaled_to_volume(volume, points, triangles):
    return points * (volume / surface_mesh.enclosed_volume(points, triangles)) ** (1 / 3)


def exact(shape, radius):
    """Area and volume of the smooth sphere or disc."""
    return shapes.disc_size(radius) if shape == "disc" else shapes.spheroid_size(1, radius)


def recognised(path):
    """Shape and frequency of a template that is a sphere or disc of this script; its points and
    triangles."""
    points, triangles = read_molecule(path)
    frequency = max(1, math.isqrt(len(points) // 10))
    radius = np.linalg.norm(points[:, :2], axis=1).max()
    for shape in ("disc", "sphere"):
        made, made_triangles = template(shape, frequency, radius)
        if (made.shape == points.shape and triangles.shape == made_triangles.shape
                and (triangles == made_triangles).all()
                and np.abs(points - made).max() < 1e-6 * radius):
            return shape, frequency, points, triangles
    raise ValueError("is not a disc or sphere of this script")


def spheroid(axis_ratio, frequency, area=None, diameter=None):
    """Vertices and triangles of a spheroid, numbered as the sphere; its radius."""
    sphere, triangles = shapes.geodesic(frequency)
    points, triangles = numbered(
        sphere, shapes.revolved(sphere, shapes.spheroid_height(axis_ratio)), triangles)
    radius = diameter / 2 if diameter else scale_to(area, points, triangles)
    return points * radius, triangles, radius


def spheroid_like(path, axis_ratio):
    """The same with area, triangles and numbering of a template."""
    like, frequency, points, triangles = recognised(path)
    area = surface_mesh.measure(points, triangles)["area"]
    sphere, triangles = shapes.geodesic(frequency)
    shape, height = (shapes.disc(sphere), shapes.disc_height) if like == "disc" else (
        sphere, shapes.spheroid_height(1))
    points = shapes.revolved(sphere, shapes.spheroid_height(axis_ratio), caps=height)
    points, triangles = numbered(shape, points, triangles)
    radius = scale_to(area, points, triangles)
    return points * radius, triangles, radius


def scale_to(area, points, triangles):
    """Factor that gives the mesh an area; rounded, so that every machine's sum gives the same
    file."""
    return round(math.sqrt(area / surface_mesh.measure(points, triangles)["area"]), 12)


def mesh(path, scale=None, area=None, volume=None, size=None):
    """Checked vertices and triangles of a file, centred, along a Hilbert curve."""
    if Path(path).suffix == ".mol":
        points, triangles = read_molecule(path)
    else:
        from mesh_io import read_surface
        points, triangles = read_surface(path)
    points = points - points.mean(axis=0)  # far from 0 the volume drowns in round-off
    if surface_mesh.enclosed_volume(points, triangles) < 0:
        triangles = triangles[:, ::-1]
        sys.stderr.write(
            f"{Path(path).name}: the triangles pointed inward; they were turned outward\n")
    surface_mesh.check(points, triangles)
    points -= surface_mesh.centre_of_volume(points, triangles)
    found = surface_mesh.measure(points, triangles)
    points *= (scale if scale else math.sqrt(area / found["area"]) if area else
               (volume / found["volume"]) ** (1 / 3) if volume else
               size / np.ptp(points, axis=0).max() if size else 1)
    return numbered(points, points, triangles)


def report(stream, points, triangles, smooth=(None, None)):
    """Print sizes, mesh quality and the difference from the smooth surface."""
    found = surface_mesh.measure(points, triangles)
    lines = [f"vertices      {len(points)}", f"triangles     {len(triangles)}"]
    for name, value in zip(("area", "volume"), smooth):
        lines.append(f"{name:13} {found[name]:.8g}" + (
            f"  smooth {value:.8g}  ({100 * (found[name] / value - 1):+.4f} %)" if value else ""))
    lines += [f"reduced vol.  {shapes.reduced_volume(found['area'], found['volume']):.6g}",
              "extent        {:.5g} x {:.5g} x {:.5g}".format(*np.ptp(points, axis=0)),
              "edge length   min {:.5g}  mean {:.5g}  max {:.5g}".format(*found["edge"]),
              "angle         min {:.2f}  max {:.2f} degrees".format(*found["angle"]),
              f"triangle area max/min {found['area_ratio']:.3f}",
              "centre        {:.1e} from 0".format(
                  np.linalg.norm(surface_mesh.centre_of_volume(points, triangles))),
              "closed, oriented outward, Euler characteristic 2"]
    stream.write("\n".join(lines) + "\n")


def number(kind, lowest, highest=math.inf):
    """Argument type: a finite number of a kind, at least (int) or above (float) lowest, at most
    highest."""
    def convert(text):
        value = kind(text)
        if (not math.isfinite(value) or value < lowest or (kind is float and value == lowest)
                or value > highest):
            raise ValueError
        return value
    convert.__name__ = f"{kind.__name__} {'>=' if kind is int else '>'} {lowest}" + (
        f" and <= {highest}" if highest < math.inf else "")
    return convert


POSITIVE = number(float, 0)
FREQUENCY = dict(type=number(int, 1), metavar="F",
                 help="edges per icosahedral edge: 10 F^2 + 2 vertices")


def options():
    """Of all shapes."""
    files = argparse.ArgumentParser(add_help=False)
    files.add_argument("-o", "--output", metavar="FILE", help="molecule file (default: none)")
    files.add_argument("--surface", metavar="FILE",
                       help="the same surface as .stl, .ply, .off or .vtp")
    files.add_argument("--citation", metavar="TEXT",
                       help="where the shape comes from, for the file's first line")
    geodesic = argparse.ArgumentParser(add_help=False)
    geodesic.add_argument("-f", "--frequency", required=True, **FREQUENCY)
    smooth = argparse.ArgumentParser(add_help=False)
    smooth.add_argument("--match-volume", action="store_true",
                        help="scale so that the polyhedron has the smooth shape's volume")
    parser = command_line.parser(__doc__)
    shape = parser.add_subparsers(dest="shape", required=True)
    shape.add_parser("sphere", parents=[geodesic, smooth, files], help="sphere").add_argument(
        "--radius", type=POSITIVE, default=1.0, help="radius (default 1)")
    shape.add_parser("disc", parents=[geodesic, smooth, files], help="biconcave disc").add_argument(
        "--diameter", type=POSITIVE, default=7.82, help="diameter (default 7.82)")
    add_spheroid(shape.add_parser("spheroid", parents=[smooth, files],
                                  help="oblate or prolate spheroid"))
    add_sickle(shape.add_parser("sickle", parents=[geodesic, smooth, files],
                                help="ellipsoid bent along its long axis"))
    add_mesh(shape.add_parser("mesh", parents=[files], help="a surface from a file"))
    return parser


def add_spheroid(parser):
    form = parser.add_mutually_exclusive_group(required=True)
    form.add_argument("--axis-ratio", type=POSITIVE, metavar="Q",
                      help="length of the axis over the diameter across it: below 1 oblate, above "
                      "prolate")
    form.add_argument("--reduced-volume", type=number(float, 0, 1), metavar="V",
                      help="volume over that of the sphere of the same area; oblate")
    parser.add_argument("--prolate", action="store_true",
                        help="the prolate one of that reduced volume")
    size = parser.add_mutually_exclusive_group(required=True)
    size.add_argument("--area", type=POSITIVE, metavar="A", help="area of the polyhedron")
    size.add_argument("--diameter", type=POSITIVE, metavar="D", help="diameter across the axis")
    size.add_argument("--like", metavar="FILE",
                      help="template of a disc or sphere, with whose area, triangles and order of "
                      "vertices")
    parser.add_argument("-f", "--frequency", **FREQUENCY)


def add_sickle(parser):
    for name, default in (("length", 15.0), ("width", 4.0), ("thickness", 3.0)):
        parser.add_argument("--" + name, type=POSITIVE, default=default,
                            help=f"axis of the ellipsoid (default {default:g})")
    parser.add_argument("--bend", type=number(float, 0, 300), default=90.0,
                        help="angle of the arc of the long axis, degrees (default 90)")


def add_mesh(parser):
    parser.add_argument("file", help=".stl, .ply, .off, .vtp or .mol")
    scale = parser.add_mutually_exclusive_group()
    scale.add_argument("--scale", type=POSITIVE, metavar="S", help="factor on all lengths")
    scale.add_argument("--area", type=POSITIVE, metavar="A", help="scale to this area")
    scale.add_argument("--volume", type=POSITIVE, metavar="V", help="scale to this volume")
    scale.add_argument("--size", type=POSITIVE, metavar="D",
                       help="scale to this longest side along x, y or z")


def parse(arguments):
    parser = options()
    args = parser.parse_args(arguments)
    if args.shape == "spheroid":
        if args.like and args.frequency:
            parser.error("spheroid --like takes the frequency from the template: leave out "
                         "--frequency")
        if not args.like and not args.frequency:
            parser.error("spheroid needs --frequency")
        if args.prolate and args.axis_ratio:
            parser.error("spheroid --prolate goes with --reduced-volume")
        if args.match_volume and not args.diameter:
            parser.error("spheroid --match-volume goes with --diameter: --area and --like tell the "
                         "area of the mesh")
    if args.shape == "sickle" and args.width * math.radians(args.bend) >= 2 * args.length:
        parser.error("sickle is bent so far that its inner side folds: lower --bend or --width")
    return args


def build(args):
    """Points, triangles and the smooth area and volume, where known, of what was asked for."""
    if args.shape == "mesh":
        return *mesh(args.file, args.scale, args.area, args.volume, args.size), (None, None)
    if args.shape == "spheroid":
        ratio = args.axis_ratio or shapes.axis_ratio_of(args.reduced_volume, args.prolate)
        points, triangles, radius = (spheroid_like(args.like, ratio) if args.like else
                                     spheroid(ratio, args.frequency, args.area, args.diameter))
        smooth = shapes.spheroid_size(ratio, radius)
    elif args.shape == "sickle":
        sphere, triangles = shapes.geodesic(args.frequency)
        points = shapes.sickle(sphere, args.length, args.width, args.thickness,
                               math.radians(args.bend))
        points, triangles = numbered(sphere, points, triangles)
        points -= surface_mesh.centre_of_volume(points, triangles)
        smooth = None, math.pi / 6 * args.length * args.width * args.thickness
    else:
        radius = args.radius if args.shape == "sphere" else args.diameter / 2
        return (*template(args.shape, args.frequency, radius, args.match_volume),
                exact(args.shape, radius))
    points += 0.0  # no negative zeros
    surface_mesh.check(points, triangles)
    if args.match_volume:
        points = scaled_to_volume(smooth[1], points, triangles)
    return points, triangles, smooth


def command(args):
    """The command that makes the file, with names of files but not their folders."""
    words = [args.shape] + ([Path(args.file).name] if args.shape == "mesh" else [])
    for name in ("radius", "diameter", "axis_ratio", "reduced_volume", "prolate", "like", "length",
                 "width", "thickness", "bend", "scale", "area", "volume", "size", "frequency",
                 "match_volume"):
        value = getattr(args, name, None)
        if value is None or value is False:
            continue
        words.append("--" + name.replace("_", "-"))
        if value is not True:
            words.append(Path(value).name if name == "like" else f"{value:.12g}")
    return " ".join(words)


def title(args, smooth):
    """First lines of the molecule file. A surface from a file is its user's: nothing is said of
    who made it, when and in which units."""
    citation = args.citation or CITATION.get(args.shape)
    lines = [f"DATE: {DATE} UNITS: micro CONTRIBUTOR: USER-RBC CITATION: {citation}"]
    if args.shape == "mesh":
        lines = [f"CITATION: {citation}"] if citation else []
    lines.append(f"make_template.py {command(args)}")
    known = ["{} {:.8g}".format(name, value)
             for name, value in zip(("area", "volume"), smooth) if value]
    return lines + (["smooth surface: " + ", ".join(known)] if known else [])


def main(arguments=None):
    args = parse(arguments)
    try:
        points, triangles, smooth = build(args)
        report(sys.stdout, points, triangles, smooth)
        if args.output:
            with open(args.output, "w", encoding="ascii") as stream:
                write_molecule(stream, title(args, smooth), points, triangles)
        if args.surface:
            from mesh_io import write_surface
            write_surface(args.surface, points, triangles)
    except (ValueError, OSError) as problem:
        source = getattr(args, "file", None) or getattr(args, "like", None)
        raise SystemExit(f"make_template.py {args.shape}: " + (f"{source}: " if source else "")
                         + str(problem)) from None


if __name__ == "__main__":
    main()
