"""Sizes of aggregates from `compute rbc/aggregate`: of one run over time, or at several shear rates
with a histogram by powers of two and the median:

  fix sizes   all ave/time 1000 1 1000 c_agg[*] file sizes.dat
  fix classes all ave/time 1000 1 1000 c_agg[*] mode vector file classes.dat
  %(prog)s --sizes sizes.dat --timestep 2e-6 -o sizes.png
  %(prog)s --case 10 low/classes.dat low/sizes.dat \\
                     --case 100 high/classes.dat high/sizes.dat -o sizes.png

Fractions are of the aggregates of all frames together. With --no-singles single cells do not count
as aggregates. Over time those of the columns are drawn that the file has, c_agg[1] to c_agg[4].
"""
from rbc import command_line
from rbc.aggregates import (
    mean_classes, mean_median, plot_aggregates, plot_sizes, sizes_over_time)


def parse(arguments):
    parser = command_line.parser(__doc__)
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--sizes", metavar="FILE",
                        help="file of fix ave/time with the vector: its columns over time")
    source.add_argument("--case", nargs=3, action="append",
                        metavar=("RATE", "CLASSES", "SIZES"),
                        help="shear rate in 1/s, files of fix ave/time with the array and with "
                             "the vector")
    parser.add_argument("--x", metavar="COLUMN",
                        help="of --sizes, in the place of the step, such as v_strain")
    parser.add_argument("--timestep", type=float,
                        help="for --sizes: time per step, to draw over time")
    parser.add_argument("--from", dest="start", type=int, default=0, metavar="STEP",
                        help="leave out earlier frames")
    parser.add_argument("--no-singles", action="store_true",
                        help="leave single cells out of the fractions")
    parser.add_argument("-o", "--output", default="aggregates.png")
    args = parser.parse_args(arguments)
    if args.case and (args.x or args.timestep):
        parser.error("--x and --timestep are for --sizes")
    if args.x and args.timestep:
        parser.error("--timestep is of the step, not of --x")
    return args


def draw_sizes(args):
    name, x, sizes = sizes_over_time(args.sizes, args.x, args.start)
    if args.timestep:
        name, x = "time", args.timestep * x
    plot_sizes(args.output, name, x, sizes)


def main(arguments=None):
    args = parse(arguments)
    if args.sizes:
        draw_sizes(args)
        return
    cases = [(float(rate), mean_classes(classes, args.start), mean_median(sizes, args.start))
             for rate, classes, sizes in args.case]
    for rate, classes, (median, deviation) in cases:
        shown = ", ".join(f"{edge:.0f}: {100 * fraction:.1f}" for edge, fraction in
                          zip(classes.edges, classes.fractions(not args.no_singles)))
        print(f"{rate:g} /s: median {median:.4g} +- {deviation:.2g} cells; "
              f"% of aggregates from {shown}")
    plot_aggregates(args.output, cases, not args.no_singles)
