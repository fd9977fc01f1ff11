"""Means over time of what goes up and down, and how sure they are."""
import numpy as np

from rbc.errors import InputError

BLOCKS = 5, 10, 20      # numbers of blocks for errors of means; the largest error counts


def mean_with_error(times, values, part=0.5):
    """Mean over the last part of the time, and its standard error by blocks of time.

    The error is the largest of those that 5, 10 and 20 blocks give. Blocks that are shorter than
    the memory of the values make it too small.
    """
    times, values = np.asarray(times, float), np.asarray(values, float)
    if times.ndim != 1 or times.shape != values.shape or np.any(np.diff(times) <= 0):
        raise InputError("a mean over time needs as many values as times, which rise")
    if not 0 < part <= 1:
        raise InputError(f"a part of {part:g} is not above 0 and up to 1")
    start = times[-1] - part * (times[-1] - times[0])
    late = times[times > start]
    if len(late) < 2 * BLOCKS[0]:
        raise InputError(f"the last {100 * part:g} % of the time has {len(late)} lines of output, "
                         f"a mean with its noise needs {2 * BLOCKS[0]} or more")
    grid = np.concatenate([[start], late])
    area = np.concatenate([[0], np.cumsum(np.diff(grid) * 0.5 * (
        np.interp(grid[1:], times, values) + np.interp(grid[:-1], times, values)))])
    errors = []
    for count in BLOCKS:
        if len(late) >= 2 * count:
            edges = np.linspace(start, times[-1], count + 1)
            means = np.diff(np.interp(edges, grid, area)) / np.diff(edges)
            errors.append(np.std(means, ddof=1) / np.sqrt(count))
    return float(area[-1] / (times[-1] - start)), float(max(errors))
