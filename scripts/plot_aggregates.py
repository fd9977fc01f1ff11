#!/usr/bin/python3
"""Sizes of aggregates at several shear rates: histogram by powers of two and median, from `compute
rbc/aggregate`:

fix sizes   all ave/time 1000 1 1000 c_agg[*] file sizes.dat
  fix classes all ave/time 1000 1 1000 c_agg[*] mode vector file classes.dat
  plot_aggregates.py --case 10 low/classes.dat low/sizes.dat --case 100 high/classes.dat high/sizes.dat -o sizes.png

Fractions are of the aggregates of all frames together. With --no-singles single cells do not count
as aggregates.
"""
from typing import NamedTuple

import command_line
import numpy as np

from read_ave_time import read_ave_time, read_table

COLORS = ("#1f4e79", "#b3202a", "#2e7d4f", "#8a5a00", "#6a3d9a", "#00798c")


class Classes(NamedTuple):
    """Aggregates of the sizes from one power of two to below the next, means over frames."""
    edges: np.ndarray         # the smaller size
    aggregates: np.ndarray

    def fractions(self, singles=True):
        counted = self.aggregates if singles else np.where(self.edges == 1, 0, self.aggregates)
        return counted / counted.sum() if counted.any() else counted


def mean_classes(path, start=0):
    """From step `start` on, of a file with the array of compute rbc/aggregate."""
    history = read_ave_time(path)
    late = history.steps >= start
    if not late.any():
        raise SystemExit(f"{path} ends at step {history.steps[-1]}, before step {start}")
    return Classes(history.column(1)[late][0], history.column(2)[late].mean(axis=0))


def mean_median(path, start=0):
    """Mean and standard deviation over frames of the median size, from a file with the vector of
    compute rbc/aggregate."""
    table = read_table(path)
    steps = next(iter(table.values()))
    medians = [values for name, values in table.items() if name.endswith("[3]")]
    if len(medians) != 1:
        raise SystemExit(f"{path} needs one column that ends in [3], the median size; it has {' '.join(table)}")
    late = steps >= start
    if not late.any():
        raise SystemExit(f"{path} ends at step {steps[-1]:.0f}, before step {start}")
    return medians[0][late].mean(), medians[0][late].std()


def draw(path, cases, singles=True):
    """cases: (shear rate in 1/s, Classes, (median, its deviation)) of each run."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    cases = sorted(cases, key=lambda case: case[0])
    figure, (bars, medians) = plt.subplots(1, 2, figsize=(9.2, 3.8), layout="constrained", width_ratios=(3, 2))
    width = 0.8 / len(cases)
    rows = max(len(classes.edges) for _, classes, _ in cases)
    for n, (rate, classes, _) in enumerate(cases):
        places = np.arange(len(classes.edges)) + width * (n - (len(cases) - 1) / 2)
        bars.bar(places, 100 * classes.fractions(singles), width, color=COLORS[n % len(COLORS)], label=f"{rate:g} /s")
    bars.set(xlabel="cells in the aggregate, from", ylabel="aggregates (%)", xticks=np.arange(rows),
             xticklabels=[f"{2**row}" for row in range(rows)])
    bars.legend(title="shear rate", frameon=False)
    rates = [rate for rate, *_ in cases]
    median, deviation = np.array([values for *_, values in cases]).T
    medians.errorbar(rates, median, deviation, fmt="o-", color="#222222", capsize=3)
    medians.set(xlabel="shear rate (1/s)", ylabel="median size (cells)", xscale="log", ylim=(0, None), xticks=rates,
                xticklabels=[f"{rate:g}" for rate in rates])
    medians.minorticks_off()
    figure.savefig(path, dpi=150)


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("--case", nargs=3, action="append", required=True, metavar=("RATE", "CLASSES", "SIZES"),
                        help="shear rate in 1/s, files of fix ave/time with the array and with the vector")
    parser.add_argument("--from", dest="start", type=int, default=0, metavar="STEP", help="leave out earlier frames")
    parser.add_argument("--no-singles", action="store_true", help="leave single cells out of the fractions")
    parser.add_argument("-o", "--output", default="aggregates.png")
    return parser.parse_args(arguments)


def main(arguments=None):
    args = parse(arguments)
    cases = [(float(rate), mean_classes(classes, args.start), mean_median(sizes, args.start))
             for rate, classes, sizes in args.case]
    for rate, classes, (median, deviation) in cases:
        shown = ", ".join(f"{edge:.0f}: {100 * fraction:.1f}" for edge, fraction in
                          zip(classes.edges, classes.fractions(not args.no_singles)))
        print(f"{rate:g} /s: median {median:.4g} +- {deviation:.2g} cells; % of aggregates from {shown}")
    draw(args.output, cases, not args.no_singles)


if __name__ == "__main__":
    main()
