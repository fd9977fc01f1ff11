"""Sizes of aggregates at several shear rates: histogram by powers of two and median, from `compute
rbc/aggregate`:

fix sizes   all ave/time 1000 1 1000 c_agg[*] file sizes.dat
  fix classes all ave/time 1000 1 1000 c_agg[*] mode vector file classes.dat
  %(prog)s --case 10 low/classes.dat low/sizes.dat \\
                     --case 100 high/classes.dat high/sizes.dat -o sizes.png

Fractions are of the aggregates of all frames together. With --no-singles single cells do not count
as aggregates.
"""
from rbc import command_line
from rbc.aggregates import mean_classes, mean_median, plot_aggregates


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("--case", nargs=3, action="append", required=True,
                        metavar=("RATE", "CLASSES", "SIZES"),
                        help="shear rate in 1/s, files of fix ave/time with the array and with "
                             "the vector")
    parser.add_argument("--from", dest="start", type=int, default=0, metavar="STEP",
                        help="leave out earlier frames")
    parser.add_argument("--no-singles", action="store_true",
                        help="leave single cells out of the fractions")
    parser.add_argument("-o", "--output", default="aggregates.png")
    return parser.parse_args(arguments)


def main(arguments=None):
    args = parse(arguments)
    cases = [(float(rate), mean_classes(classes, args.start), mean_median(sizes, args.start))
             for rate, classes, sizes in args.case]
    for rate, classes, (median, deviation) in cases:
        shown = ", ".join(f"{edge:.0f}: {100 * fraction:.1f}" for edge, fraction in
                          zip(classes.edges, classes.fractions(not args.no_singles)))
        print(f"{rate:g} /s: median {median:.4g} +- {deviation:.2g} cells; "
              f"% of aggregates from {shown}")
    plot_aggregates(args.output, cases, not args.no_singles)
