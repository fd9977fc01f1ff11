#!/usr/bin/python3
"""Where cells are to each other and where they go, from the array of `compute rbc/cell`:

fix out all ave/time 1000 1 1000 c_cell[*] mode vector file cell.dat
  cell_statistics.py cell.dat --box 0 24 0 24 0 24 --boundary p p f --neighbours 4 -o statistics

writes statistics-pairs.dat (radial distribution of the centres and mean |cos| of the angle between
the short axes, against distance), statistics-paths.dat (coordinates of sampled cells against time)
and statistics.png, and prints the rouleau order: the mean |cos| over pairs of neighbours, 1/2 for
directions at random, 1 for a stack of coins. Neighbours are cells with their centres closer than
--neighbours and, if the aggregate of each cell is given,

compute molecule all chunk/atom molecule compress yes
  compute member all reduce/chunk molecule max c_agg
  fix members all ave/time 1000 1 1000 c_member mode vector file member.dat

with --aggregates member.dat, in the same aggregate.
"""
from typing import NamedTuple

import command_line
import numpy as np

from read_ave_time import read_ave_time


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
        z, turn = 1 - 2 * n / directions, np.pi * (1 + 5**0.5) * n    # points of a Fibonacci lattice on the sphere
        unit = np.column_stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z])
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
        return PairStatistics(edges, counts / expected, 2 * np.cumsum(counts) / (frames * cells), cosines / counts)


def rouleau_order(box, centres, axes, closest, members=None):
    """Mean |cos| between the axes of neighbours and how many neighbours a cell has, [frame, 2]."""
    found = []
    for frame, (frame_centres, frame_axes) in enumerate(zip(centres, axes)):
        _, cosine = pairs(box, frame_centres, frame_axes, closest, None if members is None else members[frame])
        found.append((cosine.mean() if cosine.size else np.nan, 2 * cosine.size / len(frame_centres)))
    return np.array(found)


def sampled(identities, number, seed):
    """Places of some cells taken at random, in order."""
    return np.sort(np.random.default_rng(seed).choice(len(identities), min(number, len(identities)), replace=False))


def members_of(path, history):
    """Aggregate ID of each cell at the steps of `history`."""
    found = read_ave_time(path)
    if found.data.shape[1] != history.data.shape[1]:
        raise SystemExit(f"{path} has {found.data.shape[1]} rows, not one for each of {history.data.shape[1]} cells")
    at = np.searchsorted(found.steps, history.steps)
    if at.max() >= len(found.steps) or np.any(found.steps[at] != history.steps):
        raise SystemExit(f"{path} lacks some of the steps of the cells")
    return np.round(found.column(1)[at]).astype(int)


def draw(path, statistics, time, paths, labels, coordinate, time_label):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (radial, order, way) = plt.subplots(3, 1, figsize=(6.4, 7.8), layout="constrained")
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
    way.set(xlabel=time_label, ylabel=f"{coordinate} of the centre", xlim=(time[0], time[-1]) if len(time) > 1 else None)
    way.legend(fontsize=8, ncols=2)
    figure.savefig(path, dpi=150)


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("cells", help="file of fix ave/time with the columns of compute rbc/cell")
    parser.add_argument("--box", type=float, nargs=6, required=True, metavar=("XLO", "XHI", "YLO", "YHI", "ZLO", "ZHI"))
    parser.add_argument("--boundary", nargs=3, default=["p", "p", "p"], metavar=("X", "Y", "Z"),
                        help="as in the input script (default p p p): p is periodic")
    parser.add_argument("--from", dest="start", type=int, default=0, metavar="STEP", help="leave out earlier frames")
    parser.add_argument("--width", type=float, default=0.25, help="of the shells of distance (default 0.25)")
    parser.add_argument("--neighbours", type=float, default=4.0, metavar="R",
                        help="distance below which cells are neighbours (default 4)")
    parser.add_argument("--aggregates", metavar="FILE", help="aggregate ID of each cell at the same steps")
    parser.add_argument("--sample", type=int, default=6, metavar="N", help="how many paths (default 6)")
    parser.add_argument("--seed", type=int, default=1, help="of the choice of paths (default 1)")
    parser.add_argument("--molecules", type=int, nargs="+", metavar="ID", help="paths of these cells instead")
    parser.add_argument("--coordinate", choices="xyz", default="z", help="of the paths drawn (default z)")
    parser.add_argument("--timestep", type=float, default=1.0, help="time per step (default 1)")
    parser.add_argument("--time-label", default="time")
    parser.add_argument("-o", "--output", default="statistics", help="first part of the names written")
    return parser.parse_args(arguments)


def main(arguments=None):
    args = parse(arguments)
    low, high = np.reshape(args.box, (3, 2)).T
    box = Box(low, high, np.array([side == "p" for side in args.boundary]))
    history = read_ave_time(args.cells)
    late = history.steps >= args.start
    if not late.any():
        raise SystemExit(f"{args.cells} ends at step {history.steps[-1]}, before --from {args.start}")
    identities = history.column(1)[0].astype(int)
    centres, axes = history.columns(2, 4), history.columns(14, 16)

    edges = np.arange(0, box.longest_distance() + 1e-9, args.width)
    statistics = pair_statistics(box, centres[late], axes[late], edges)
    np.savetxt(f"{args.output}-pairs.dat",
               np.column_stack([statistics.middles, statistics.radial, statistics.neighbours, statistics.order]),
               header="r g neighbours order", fmt="%.6g")

    members = members_of(args.aggregates, history)[late] if args.aggregates else None
    order = rouleau_order(box, centres[late], axes[late], args.neighbours, members)
    for step, (cosine, count) in zip(history.steps[late], order):
        print(f"step {step}: rouleau order {cosine:.4f}, {count:.3f} neighbours per cell")

    if args.molecules:
        missing = set(args.molecules) - set(identities)
        if missing:
            raise SystemExit(f"no cells with molecule IDs {' '.join(map(str, sorted(missing)))} in {args.cells}")
        chosen = [int(np.flatnonzero(identities == molecule)[0]) for molecule in args.molecules]
    else:
        chosen = sampled(identities, args.sample, args.seed)
    time = history.steps * args.timestep
    names = " ".join(f"{d}_{identities[i]}" for i in chosen for d in "xyz")
    np.savetxt(f"{args.output}-paths.dat", np.column_stack([time, centres[:, chosen].reshape(len(time), -1)]),
               header="time " + names, fmt="%.8g")
    draw(f"{args.output}.png", statistics, time, centres[:, chosen, "xyz".index(args.coordinate)], identities[chosen],
         args.coordinate, args.time_label)


if __name__ == "__main__":
    main()
