"""Where cells are to each other and where they go: radial distribution of the centres, order of the
axes of neighbours, paths."""
from typing import NamedTuple

import numpy as np

from rbc.errors import InputError
from rbc.tables import read_blocks


class Box(NamedTuple):
    """Sides of a box and which of them are periodic."""
    low: np.ndarray
    high: np.ndarray
    periodic: np.ndarray

    @property
    def lengths(self):
        return self.high - self.low

    def separations(self, a, b):
        """From a to the nearest image of each b."""
        apart = b - a
        shift = np.where(self.periodic, self.lengths * np.round(apart / self.lengths), 0)
        return apart - shift

    def longest_distance(self):
        """Up to which pairs are counted: half of the shortest period, or the shortest side."""
        return np.where(self.periodic, self.lengths / 2, self.lengths).min()

    def share_inside(self, distances, directions=4000):
        """Share of the pairs at a distance, from a point anywhere in the box, whose second point is
        in the box too."""
        n = np.arange(directions) + 0.5
        # points of a Fibonacci lattice on the sphere
        z, turn = 1 - 2 * n / directions, np.pi * (1 + 5**0.5) * n
        across = np.sqrt(1 - z * z)
        unit = np.column_stack([across * np.cos(turn), across * np.sin(turn), z])
        share = np.ones((np.size(distances), directions))
        for d in np.flatnonzero(~self.periodic):
            share *= np.clip(1 - np.outer(distances, np.abs(unit[:, d])) / self.lengths[d], 0, None)
        return share.mean(axis=1)


def pairs(box, centres, axes, longest, members=None):
    """Distance and |cos| of the angle between the axes of every pair of cells closer than `longest`
    and, where `members` names the aggregate of each, in the same one."""
    distances, cosines = [], []
    for i in range(len(centres) - 1):
        distance = np.linalg.norm(box.separations(centres[i], centres[i + 1:]), axis=1)
        near = distance < longest
        if members is not None:
            near &= members[i + 1:] == members[i]
        distances.append(distance[near])
        cosines.append(np.abs(axes[i + 1:][near] @ axes[i]))
    return np.concatenate(distances or [[]]), np.concatenate(cosines or [[]])


class PairStatistics(NamedTuple):
    """Means over frames, in shells between the `edges`."""
    edges: np.ndarray
    radial: np.ndarray        # pairs over those of as many points anywhere in the box
    neighbours: np.ndarray    # of a cell, up to the outer edge
    order: np.ndarray         # mean |cos|, NaN in a shell without pairs

    @property
    def middles(self):
        return (self.edges[1:] + self.edges[:-1]) / 2


def pair_statistics(box, centres, axes, edges):
    """Of centres and unit vectors [frame, cell, 3]."""
    counts, cosines = np.zeros(len(edges) - 1), np.zeros(len(edges) - 1)
    for frame_centres, frame_axes in zip(centres, axes):
        distance, cosine = pairs(box, frame_centres, frame_axes, edges[-1])
        counts += np.histogram(distance, edges)[0]
        cosines += np.histogram(distance, edges, weights=cosine)[0]
    frames, cells = centres.shape[:2]
    middles = (edges[1:] + edges[:-1]) / 2
    shells = 4 / 3 * np.pi * np.diff(edges**3) * box.share_inside(middles) / np.prod(box.lengths)
    expected = frames * cells * (cells - 1) / 2 * shells
    with np.errstate(invalid="ignore", divide="ignore"):
        return PairStatistics(edges, counts / expected, 2 * np.cumsum(counts) / (frames * cells),
                              cosines / counts)


def rouleau_order(box, centres, axes, closest, members=None):
    """Mean |cos| between the axes of neighbours and how many neighbours a cell has, [frame, 2]."""
    found = []
    for frame, (frame_centres, frame_axes) in enumerate(zip(centres, axes)):
        _, cosine = pairs(box, frame_centres, frame_axes, closest,
                          None if members is None else members[frame])
        found.append((cosine.mean() if cosine.size else np.nan,
                      2 * cosine.size / len(frame_centres)))
    return np.array(found)


def sampled(identities, number, seed):
    """Places of some cells taken at random, in order."""
    random = np.random.default_rng(seed)
    return np.sort(random.choice(len(identities), min(number, len(identities)), replace=False))


def members_of(path, history):
    """Aggregate ID of each cell at the steps of `history`."""
    found = read_blocks(path)
    if found.data.shape[1] != history.data.shape[1]:
        raise InputError(f"{path} has {found.data.shape[1]} rows, not one for each of "
                         f"{history.data.shape[1]} cells")
    at = np.searchsorted(found.steps, history.steps)
    if at.max() >= len(found.steps) or np.any(found.steps[at] != history.steps):
        raise InputError(f"{path} lacks some of the steps of the cells")
    return np.round(found.column(1)[at]).astype(int)


def plot_statistics(path, statistics, time, paths, labels, coordinate, time_label):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 7.8), layout="constrained")
    radial, order, way = figure.subplots(3, 1)
    r = statistics.middles
    radial.axhline(1, color="#bbbbbb", lw=1)
    radial.step(r, statistics.radial, where="mid", color="#1f4e79")
    radial.set(ylabel="g(r) of the centres", xlim=(0, statistics.edges[-1]), ylim=(0, None))
    order.axhline(0.5, color="#bbbbbb", lw=1)
    order.plot(r, statistics.order, "o-", ms=3, color="#b3202a")
    order.set(ylabel="mean |cos| of the short axes", xlabel="distance of the centres r",
              xlim=(0, statistics.edges[-1]), ylim=(0, 1.02))
    for label, coordinates in zip(labels, paths.T):
        way.plot(time, coordinates, lw=1, label=f"cell {label}")
    way.set(xlabel=time_label, ylabel=f"{coordinate} of the centre",
            xlim=(time[0], time[-1]) if len(time) > 1 else None)
    way.legend(fontsize=8, ncols=2)
    figure.savefig(path, dpi=150)
