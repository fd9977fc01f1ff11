"""Sizes of aggregates from compute rbc/aggregate: histogram by powers of two and median."""
from typing import NamedTuple

import numpy as np

from rbc.errors import InputError
from rbc.tables import read_blocks, read_table

COLORS = ("#1f4e79", "#b3202a", "#2e7d4f", "#8a5a00", "#6a3d9a", "#00798c")
VECTOR = {"number": 1, "mean": 2, "median": 3, "largest": 4}    # of compute rbc/aggregate


class Classes(NamedTuple):
    """Aggregates of the sizes from one power of two to below the next, means over frames."""
    edges: np.ndarray         # the smaller size
    aggregates: np.ndarray

    def fractions(self, singles=True):
        counted = self.aggregates if singles else np.where(self.edges == 1, 0, self.aggregates)
        return counted / counted.sum() if counted.any() else counted


def mean_classes(path, start=0):
    """From step `start` on, of a file with the array of compute rbc/aggregate."""
    history = read_blocks(path)
    late = history.steps >= start
    if not late.any():
        raise InputError(f"{path} ends at step {history.steps[-1]}, before step {start}")
    return Classes(history.column(1)[late][0], history.column(2)[late].mean(axis=0))


def mean_median(path, start=0):
    """Mean and standard deviation over frames of the median size, from a file with the vector of
    compute rbc/aggregate."""
    table = read_table(path)
    steps = next(iter(table.values()))
    medians = [values for name, values in table.items() if name.endswith("[3]")]
    if len(medians) != 1:
        raise InputError(f"{path} needs one column that ends in [3], the median size; it has "
                         f"{' '.join(table)}")
    late = steps >= start
    if not late.any():
        raise InputError(f"{path} ends at step {steps[-1]:.0f}, before step {start}")
    return medians[0][late].mean(), medians[0][late].std()


def sizes_over_time(path, x=None, start=0):
    """(name of x, its values, {what: values}) from step `start` on of a file with the vector of
    compute rbc/aggregate, as far as it has its columns. x: the step, if no other is named."""
    table = read_table(path)
    step, x = next(iter(table)), x or next(iter(table))
    late, found = table[step] >= start, {}
    if not late.any():
        raise InputError(f"{path} ends at step {table[step][-1]:.0f}, before step {start}")
    for what, number in VECTOR.items():
        columns = [values for name, values in table.items() if name.endswith(f"[{number}]")]
        if len(columns) > 1:
            raise InputError(f"{path} has {len(columns)} columns that end in [{number}]")
        if columns:
            found[what] = columns[0][late]
    if not found:
        raise InputError(f"{path} has no column of compute rbc/aggregate, c_ID[1] to c_ID[4]; it "
                         f"has {' '.join(table)}")
    return x, table[x][late], found


def sizes_figure(along, x, sizes):
    """Number of aggregates and their sizes over x, which `along` names."""
    from matplotlib.figure import Figure

    panels = [["number"]] * ("number" in sizes) + [["size"]] * bool(set(sizes) - {"number"})
    figure = Figure(figsize=(6.4, 3 * len(panels)), layout="constrained")
    axes = figure.subplot_mosaic(panels, sharex=True)
    for n, (what, values) in enumerate(sizes.items()):
        panel = axes["number" if what == "number" else "size"]
        panel.plot(x, values, color=COLORS[n], label=what)
        panel.set_ylabel("aggregates" if what == "number" else "size (cells)")
    for panel in axes.values():
        panel.set_ylim(bottom=0)
    if "size" in axes:
        axes["size"].legend(frameon=False)
    axes[panels[-1][0]].set_xlabel(along)
    return figure


def plot_sizes(path, along, x, sizes):
    """A picture of what sizes_over_time returns."""
    sizes_figure(along, x, sizes).savefig(path, dpi=150)


def plot_aggregates(path, cases, singles=True):
    """cases: (shear rate in 1/s, Classes, (median, its deviation)) of each run."""
    from matplotlib.figure import Figure

    cases = sorted(cases, key=lambda case: case[0])
    figure = Figure(figsize=(9.2, 3.8), layout="constrained")
    bars, medians = figure.subplots(1, 2, width_ratios=(3, 2))
    width = 0.8 / len(cases)
    rows = max(len(classes.edges) for _, classes, _ in cases)
    for n, (rate, classes, _) in enumerate(cases):
        places = np.arange(len(classes.edges)) + width * (n - (len(cases) - 1) / 2)
        bars.bar(places, 100 * classes.fractions(singles), width, color=COLORS[n % len(COLORS)],
                 label=f"{rate:g} /s")
    bars.set(xlabel="cells in the aggregate, from", ylabel="aggregates (%)", xticks=np.arange(rows),
             xticklabels=[f"{2**row}" for row in range(rows)])
    bars.legend(title="shear rate", frameon=False)
    rates = [rate for rate, *_ in cases]
    median, deviation = np.array([values for *_, values in cases]).T
    medians.errorbar(rates, median, deviation, fmt="o-", color="#222222", capsize=3)
    medians.set(xlabel="shear rate (1/s)", ylabel="median size (cells)", xscale="log",
                ylim=(0, None), xticks=rates,
                xticklabels=[f"{rate:g}" for rate in rates])
    medians.minorticks_off()
    figure.savefig(path, dpi=150)
