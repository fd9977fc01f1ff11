"""What is compared of a measure: its end, its mean with noise, or all of it over time."""
import numpy as np
from richardson import FLAT, size
from rbc.errors import InputError
from rbc.means import mean_with_error

SAMPLES = 400           # of the time, at which series are compared
SHORTEST = 10           # lines of the run with the fewest, for a series
ON_A_LINE = 1e-6        # share of the time between two lines
OFTENER = "have the script print more often, with a smaller number behind `thermo`"


class TooShort(InputError):
    """What is wrong with the table of a run."""


def history(table, column):
    """(times, values) of one column behind `Step Time`, the last of columns with equal times."""
    rows = table[np.isfinite(table[:, column])]
    if len(rows) < len(table):
        raise TooShort("the measure is not a number at all times")
    times, last = np.unique(rows[::-1, 1], return_index=True)
    return times, rows[::-1, column][last]


def common_times(histories):
    """The times of the lines of the run that has the fewest, within the time that all runs have. So
    the least is interpolated in the others."""
    start = max(times[0] for times, _ in histories)
    end = min(times[-1] for times, _ in histories)
    if end <= start:
        raise TooShort(f"the runs have no time in common: {start:g} is the latest start, {end:g} "
                       "the earliest end")
    slack = ON_A_LINE * (end - start)
    fewest = min((times[(times >= start - slack) & (times <= end + slack)]
                  for times, _ in histories), key=len)
    if len(fewest) < SHORTEST:
        raise TooShort(f"a run has {len(fewest)} lines of thermo output in the time that all have, "
                       f"a series needs {SHORTEST} or more: {OFTENER}")
    even = np.linspace(start, end, min(SAMPLES, len(fewest)))
    return fewest[np.unique(np.abs(fewest - even[:, None]).argmin(axis=1))]


def between_lines(times, values, at):
    """How far linear interpolation at some times may be off: (t - t_n) (t_n+1 - t) times half the
    second derivative, which neighbours tell by how far each line is off the chord of the two."""
    n = np.clip(np.searchsorted(times, at) - 1, 0, max(len(times) - 2, 0))
    gaps = np.diff(times)
    shares = (at - times[n]) * (times[n + 1] - at) / gaps[n]**2 if len(gaps) else np.zeros(len(at))
    shares = np.where(shares < ON_A_LINE, 0, shares)
    if not shares.any():
        return shares
    if len(times) < 3:
        raise TooShort(f"the runs end at different times, and one has {len(times)} lines of thermo "
                       f"output: {OFTENER}")
    chord = (values[:-2] * gaps[1:] + values[2:] * gaps[:-1]) / (gaps[:-1] + gaps[1:])
    half = np.pad(abs(values[1:-1] - chord) / (gaps[:-1] * gaps[1:]), 1, mode="edge")
    return np.maximum(half[n], half[n + 1]) * shares * gaps[n]**2


def compared(histories, take, part):
    """Values (n, m) of the runs, and their errors (n,): standard errors of means, or root mean
    squares of what interpolation between lines may be off."""
    if take == "mean":
        means, errors = np.transpose([mean_with_error(*run, part) for run in histories])
        return means[:, None], errors
    if take == "last":
        at = np.array([min(times[-1] for times, _ in histories)])
        if at < max(times[0] for times, _ in histories):
            raise TooShort("the runs have no time in common")
    else:
        at = common_times(histories)
    values = np.array([np.interp(at, *run) for run in histories])
    missed = size(np.array([between_lines(*run, at) for run in histories]))
    return values, np.where(missed > FLAT * size(values), missed, 0)
