"""Draw the Taylor deformation D(t) and the orientation of cells in shear, with reference curves.

Input is either the array of `compute rbc/cell` (all columns, or 1, 7 and 11 to 16 in any order),

  fix out all ave/time 100 1 100 c_cell[*] mode vector file cell.dat
  %(prog)s --cells cell.dat --timestep 2 --shear-rate 1e-3 \\
                --reference 02b_capsule_shear_NH_transient_D.csv --case Ca_E=0.1 --output D.png

several of these to compare runs, each with the mean of its cells,

  %(prog)s --cells low/cell.dat high/cell.dat --timestep 2 1 --output D.png

or a whitespace table with a line "# time D theta_long area" above it:

  %(prog)s table.dat --x time --y D --xscale 1e-3 \\
                --series "theory=curve.csv:time:D:Ca=0.1" --output D.png
  %(prog)s visc.dat --x v_strain --y v_relative --output viscosity.png

The flow is along x and its gradient along z. Angles are those of the projection on the x-z plane
to x, in degrees in (-90, 90]: of the long axis, and of the short axis (a disc's normal).
"""
from rbc import command_line
from rbc.shear_plot import (
    ShearLabels, cell_lines, compared_lines, given_series, plot_shear, reference_series,
    table_lines)


def parse(arguments):
    parser = command_line.parser(__doc__)
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("table", nargs="?", help="whitespace table with a '# name ...' line")
    source.add_argument("--cells", metavar="FILE", nargs="+",
                        help="fix ave/time files of compute rbc/cell")
    parser.add_argument("--timestep", type=float, nargs="+", default=[1.0], metavar="DT",
                        help="time per step (default 1), one or one for each of --cells")
    parser.add_argument("--shear-rate", type=float, metavar="G", help="draw against G t")
    parser.add_argument("--molecules", type=int, nargs="+", metavar="ID", help="only these cells")
    parser.add_argument("--x", default="time", help="column of the table (default time)")
    parser.add_argument("--y", nargs="+", default=["D"], help="columns of the table (default D)")
    parser.add_argument("--angles", nargs="+", default=[], metavar="COL",
                        help="columns of the table that are angles (default: those named theta*)")
    parser.add_argument("--xscale", type=float, default=1.0, help="factor for x")
    parser.add_argument("--series", action="append", default=[],
                        metavar="label=file.csv:xcol:ycol[:col=value]", help="extra points")
    parser.add_argument("--reference", metavar="CSV",
                        help="file with columns source, gdot_t and D: one series per source")
    parser.add_argument("--case", action="append", default=[], metavar="COL=VALUE",
                        help="rows of --reference to draw")
    parser.add_argument("--xlabel")
    parser.add_argument("--label", default="this run", help="name of a single cell's line")
    parser.add_argument("--title", default="")
    parser.add_argument("--dpi", type=int, default=150)
    parser.add_argument("-o", "--output", required=True, help="picture to write")
    args = parser.parse_args(arguments)
    files = len(args.cells) if args.cells else 1
    if len(args.timestep) not in (1, files):
        parser.error(f"{len(args.timestep)} values of --timestep for {files} files")
    return args


def lines_of_cells(args):
    unit = args.xscale * (args.shear_rate or 1)
    factors = [unit * timestep for timestep in args.timestep]
    if len(args.cells) == 1:
        return cell_lines(args.cells[0], factors[0], args.molecules, args.label)
    factors *= len(args.cells) if len(factors) == 1 else 1
    return compared_lines(args.cells, factors, args.molecules)


def main(arguments=None):
    args = parse(arguments)
    if args.cells:
        lines = lines_of_cells(args)
        along = r"$\dot\gamma\,t$" if args.shear_rate else "time"
    else:
        lines = table_lines(args.table, args.x, args.y, args.angles, args.xscale)
        along = args.x
    references = [given_series(text) for text in args.series]
    if args.reference:
        references += reference_series(args.reference, args.case, args.y[0])
    across = ShearLabels().y if args.y == ["D"] else ", ".join(args.y)
    labels = ShearLabels(args.xlabel or along, across, args.title)
    plot_shear(args.output, *lines, references, labels, args.dpi)
