"""What is compared of a measure: its end, its mean with noise, or all of it over time."""
import numpy as np

BLOCKS = 5, 10, 20      # numbers of blocks for errors of means; the largest error counts
SAMPLES = 400           # of the time, at which series are compared


class TooShort(ValueError):
    """What is wrong with the table of a run."""


def history(table, column):
    """(times, values) of one column behind `Step Time`, the last of columns with equal times."""
    rows = table[np.isfinite(table[:, column])]
    if len(rows) < len(table):
        raise TooShort("the measure is not a number at all times")
    times, last = np.unique(rows[::-1, 1], return_index=True)
    return times, rows[::-1, column][last]


def mean(times, values, part):
    """Mean over the last part of the time, and its standard error by blocks of time."""
    start = times[-1] - part * (times[-1] - times[0])
    late = times[times > start]
    if len(late) < 2 * BLOCKS[0]:
        raise TooShort(f"the last {100 * part:g} % of the time has {len(late)} lines of thermo "
                       f"output, a mean with its noise needs {2 * BLOCKS[0]} or more")
    grid = np.concatenate([[start], late])
    area = np.concatenate([[0], np.cumsum(np.diff(grid) * 0.5 * (
        np.interp(grid[1:], times, values) + np.interp(grid[:-1], times, values)))])
    errors = []
    for count in BLOCKS:
        if len(late) >= 2 * count:
            edges = np.linspace(start, times[-1], count + 1)
            means = np.diff(np.interp(edges, grid, area)) / np.diff(edges)
            errors.append(np.std(means, ddof=1) / np.sqrt(count))
    return area[-1] / (times[-1] - start), max(errors)


def common_times(histories):
    """Those at which all series have values, no closer than the finest of them has on average."""
    start = max(times[0] for times, _ in histories)
    end = min(times[-1] for times, _ in histories)
    if end <= start and any(len(times) > 1 for times, _ in histories):
        raise TooShort(f"the runs have no time in common: {start:g} is the latest start, {end:g} "
                       "the earliest end")
    return np.linspace(start, end, min(SAMPLES, max(len(times) for times, _ in histories)))


def compared(histories, take, part):
    """Values (n, m) of the runs, and their standard errors (n,)."""
    none = np.zeros(len(histories))
    if take == "mean":
        means, errors = np.transpose([mean(*run, part) for run in histories])
        return means[:, None], errors
    times = common_times(histories)
    if take == "last":
        times = times[-1:]
    return np.array([np.interp(times, *run) for run in histories]), none
