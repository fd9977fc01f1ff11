"""Order, limit and error of values computed with finer and finer settings.

value(h) = limit + C h^p, fitted by least squares with weights 1/h. A value is a number or a list of
numbers (times of a series), which share p. What is said of the error follows

  P. J. Roache, J. Fluids Eng. 116 (1994) 405: the grid convergence index, a safety factor times the
  distance from the extrapolated limit, 3 for two grids; 1.25 where three or more show the order
  (Roache, Verification and Validation in Computational Science and Engineering, Hermosa, 1998);
  L. Eca and M. Hoekstra, J. Comput. Phys. 262 (2014) 104: more grids than unknowns, weights, data
  that do not fit: 3 times their range over h_coarsest/h_finest - 1.
"""
from typing import NamedTuple

import numpy as np

CONFIDENT, CAUTIOUS = 1.25, 3.0      # Roache's safety factors
LEAST, HIGHEST = 0.5, 2.0            # orders that an error is estimated with, if none is given
ORDERS = np.arange(0.05, 8.0, 0.01)  # that are tried
DRAWS = 400                          # of the noise
SURE = 0.95                          # share of the draws that must show an order
WIDEST = 1.0                         # range of two thirds of the orders drawn, up to HIGHEST
FLAT = 1e-9                          # relative range that is round-off
SAME = "the values are the same"     # why no order is found: none is needed


class Fit(NamedTuple):
    """Of n settings, finest first, and values of m numbers."""
    order: float         # that errors are estimated with; NaN: none was found
    observed: float      # of the best fit; NaN where there is none
    between: tuple       # two thirds of the orders that the noise allows; () without noise
    limit: np.ndarray    # (m,) that of the fit, or the finest value where no order was found
    offsets: np.ndarray  # (n,) root mean square of value - limit; with its sign where m is 1
    bounds: np.ndarray   # (n,) errors of the values, with safety factor and noise
    why: str             # no order was found


def extrapolate(fine, value, coarse, other, order):
    """Limit of two values, of a fine and a coarse setting, whose errors are of a known order."""
    return value - (other - value) / ((coarse / fine)**order - 1)


def size(values):
    """Root mean square over the last axis."""
    return np.sqrt(np.mean(np.square(values), axis=-1))


def straight(x, weights, values):
    """Limit (m,), factor (m,) and rms residual of values = limit + factor x."""
    middle, mean = weights @ x, weights @ values
    factor = (weights * (x - middle)) @ (values - mean) / (weights @ (x - middle)**2)
    limit = mean - factor * middle
    rest = values - limit - np.multiply.outer(x, factor)
    return limit, factor, np.sqrt(weights @ np.mean(rest**2, axis=1))


def explained(h, weights, values):
    """(ORDERS, sets): what each order explains of the variance of sets of values (sets, n, m)."""
    x = h**ORDERS[:, None]
    x = x - (x @ weights)[:, None]
    shares = np.tensordot(x * weights, values, axes=(1, 1))
    return np.sum(shares**2, axis=2) / (x**2 @ weights)[:, None]


def best_order(h, weights, values):
    """That with the least residual, the last of ORDERS if it is higher, NaN if it is lower."""
    n = int(np.argmax(explained(h, weights, values[None])[:, 0]))
    if n in (0, len(ORDERS) - 1):
        return ORDERS[n] if n else np.nan
    low, high = ORDERS[n - 1], ORDERS[n + 1]
    for _ in range(40):                                       # thirds of the interval
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if straight(h**left, weights, values)[2] < straight(h**right, weights, values)[2]:
            high = right
        else:
            low = left
    return (low + high) / 2


def mixed_limit(h, weights, values):
    """Of values = limit + C h + D h^2, least squares."""
    powers = np.sqrt(weights)[:, None] * h[:, None]**np.arange(3)
    return np.linalg.lstsq(powers, np.sqrt(weights)[:, None] * values, rcond=None)[0][0]


def turns(values):
    """Of sets of values (sets, n, m): whether a difference of neighbours does not point the way of
    the one before."""
    steps = np.diff(values, axis=1)
    return np.any(np.sum(steps[:, 1:] * steps[:, :-1], axis=2) < 0, axis=1)


def drawn_orders(h, weights, values, noise):
    """Orders of values to which the noise is added once more, NaN where there is none."""
    random = np.random.default_rng(1)
    drawn = values + noise[:, None] * random.standard_normal((DRAWS, *values.shape))
    best = np.argmax(explained(h, weights, drawn), axis=0)
    return np.where((best == 0) | turns(drawn), np.nan, ORDERS[best])


def fit(sizes, values, noise=None, order=None):
    """Fit of values (n,) or (n, m) with settings of some sizes, in any order; results come in the
    same order. `noise`: standard errors of the values. `order`: that of the method, if known."""
    h = np.asarray(sizes, float)
    values = np.asarray(values, float).reshape(len(h), -1)
    noise = np.zeros(len(h)) if noise is None else np.asarray(noise, float)
    if len(h) < 2 or len(set(h)) < len(h) or min(h) <= 0:
        raise ValueError("a fit needs two sizes or more, which differ and are positive")
    by_size = np.argsort(h)
    found = fit_sorted(h[by_size] / h.max(), values[by_size], noise[by_size], order)
    places = np.argsort(by_size)
    return found._replace(offsets=found.offsets[places], bounds=found.bounds[places])


def fit_sorted(h, values, noise, order):
    spread = max(size(a - b) for a in values for b in values)
    observed, between, why = np.nan, (), ""
    weights = 1 / h / np.sum(1 / h)
    if spread <= FLAT * size(values[0]):
        why = SAME
    elif len(h) == 2:
        why = "" if order else "two settings show none"
    elif turns(values[None])[0]:
        why = "the values go up and down" if values.shape[1] == 1 else \
            "the differences of the series do not point one way"
    else:
        observed = best_order(h, weights, values)
        why = "" if observed >= LEAST else \
            "the differences do not shrink as they should with an order of 0.5 or more"
    if noise.any() and len(h) > 2 and why != SAME:
        orders = drawn_orders(h, weights, values, noise)
        share = np.mean(np.nan_to_num(orders) >= LEAST)
        between = tuple(np.nanpercentile(orders, (100 / 6, 500 / 6))) if share > 0.5 else ()
        if share < SURE or np.ptp(np.minimum(between, order or HIGHEST)) > WIDEST:
            why = "it is within the noise"
    if why:
        return without_order(h, weights, values, noise, observed, between, why)
    return with_order(h, weights, values, noise, observed, between, order)


def without_order(h, weights, values, noise, observed, between, why):
    """Nothing is extrapolated: the error of the finest value is a multiple of the range."""
    rest = CAUTIOUS * max(size(a - b) for a in values for b in values) / (h[-1] / h[0] - 1)
    if len(h) > 2:
        rest = max(rest, CONFIDENT * size(values[0] - mixed_limit(h, weights, values)))
    if observed < LEAST:                                        # slower than that assumes
        limit = straight(h**observed, weights, values)[0]
        rest = max(rest, CAUTIOUS * size(values[0] - limit))
    rest += 2 * noise[0]
    offsets = signed(values - values[0])
    return Fit(np.nan, observed, between, values[0], offsets, abs(offsets) + rest + 2 * noise, why)


def with_order(h, weights, values, noise, observed, between, given):
    """Errors are distances from the limit of the fit, with a factor, and scatter and noise."""
    used = given if np.isnan(observed) else min(observed, given or HIGHEST)
    sure, scatter = False, 0.0
    if len(h) > 2:
        free = len(h) - 2 - 1 / values.shape[1]
        residual = straight(h**observed, weights, values)[2]
        scatter = residual * np.sqrt(len(h) / free) if free > 0 else 0.0
        sure = scatter < size(values[-1] - values[0]) / (len(h) - 1) and (
            given is None or abs(observed / given - 1) < 0.1)
    pairs = [extrapolate(h[0], values[0], h[n], values[n], used) for n in range(1, len(h))]
    limit = straight(h**used, weights, values)[0] if used == observed else pairs[0]
    offsets = signed(values - limit)
    others = [] if used == observed else pairs
    if len(h) > 2:
        others = [*others, mixed_limit(h, weights, values)]
    missed = max([0.0, *(size(values[0] - other) - abs(offsets[0]) for other in others)])
    factor = CONFIDENT if sure else CAUTIOUS
    blur = 2 * np.hypot(noise, noise[0] * (1 + 1 / ((h[1] / h[0])**used - 1)))
    return Fit(used, observed, between, limit, offsets,
               factor * (abs(offsets) + missed) + scatter + blur, "")


def signed(differences):
    return differences[:, 0] if differences.shape[1] == 1 else size(differences)
