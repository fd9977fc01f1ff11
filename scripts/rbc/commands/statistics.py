"""Where cells are to each other and where they go, from the array of `compute rbc/cell`:

  fix out all ave/time 1000 1 1000 c_cell[*] mode vector file cell.dat
  %(prog)s cell.dat --box 0 24 0 24 0 24 --boundary p p f --neighbours 4 -o statistics

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
from rbc import command_line
import numpy as np

from rbc.cell_statistics import (
    Box, members_of, pair_statistics, plot_statistics, rouleau_order, sampled)
from rbc.errors import InputError
from rbc.tables import read_blocks


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("cells", help="file of fix ave/time with the columns of compute rbc/cell")
    parser.add_argument("--box", type=float, nargs=6, required=True,
                        metavar=("XLO", "XHI", "YLO", "YHI", "ZLO", "ZHI"))
    parser.add_argument("--boundary", nargs=3, default=["p", "p", "p"], metavar=("X", "Y", "Z"),
                        help="as in the input script (default p p p): p is periodic")
    parser.add_argument("--from", dest="start", type=int, default=0, metavar="STEP",
                        help="leave out earlier frames")
    parser.add_argument("--width", type=float, default=0.25,
                        help="of the shells of distance (default 0.25)")
    parser.add_argument("--neighbours", type=float, default=4.0, metavar="R",
                        help="distance below which cells are neighbours (default 4)")
    parser.add_argument("--aggregates", metavar="FILE",
                        help="aggregate ID of each cell at the same steps")
    parser.add_argument("--sample", type=int, default=6, metavar="N",
                        help="how many paths (default 6)")
    parser.add_argument("--seed", type=int, default=1, help="of the choice of paths (default 1)")
    parser.add_argument("--molecules", type=int, nargs="+", metavar="ID",
                        help="paths of these cells instead")
    parser.add_argument("--coordinate", choices="xyz", default="z",
                        help="of the paths drawn (default z)")
    parser.add_argument("--timestep", type=float, default=1.0, help="time per step (default 1)")
    parser.add_argument("--time-label", default="time")
    parser.add_argument("-o", "--output", default="statistics",
                        help="first part of the names written")
    return parser.parse_args(arguments)


def chosen_cells(args, identities):
    """Places of the cells whose paths are drawn."""
    if not args.molecules:
        return sampled(identities, args.sample, args.seed)
    missing = sorted(set(args.molecules) - set(identities))
    if missing:
        raise InputError(f"no cells with molecule IDs {' '.join(map(str, missing))} in "
                         f"{args.cells}")
    return [int(np.flatnonzero(identities == molecule)[0]) for molecule in args.molecules]


def main(arguments=None):
    args = parse(arguments)
    low, high = np.reshape(args.box, (3, 2)).T
    box = Box(low, high, np.array([side == "p" for side in args.boundary]))
    history = read_blocks(args.cells)
    late = history.steps >= args.start
    if not late.any():
        raise InputError(f"{args.cells} ends at step {history.steps[-1]}, before --from "
                         f"{args.start}")
    identities = history.column(1)[0].astype(int)
    centres, axes = history.columns(2, 4), history.columns(14, 16)

    edges = np.arange(0, box.longest_distance() + 1e-9, args.width)
    found = pair_statistics(box, centres[late], axes[late], edges)
    np.savetxt(f"{args.output}-pairs.dat",
               np.column_stack([found.middles, found.radial, found.neighbours, found.order]),
               header="r g neighbours order", fmt="%.6g")

    members = members_of(args.aggregates, history)[late] if args.aggregates else None
    order = rouleau_order(box, centres[late], axes[late], args.neighbours, members)
    for step, (cosine, count) in zip(history.steps[late], order):
        print(f"step {step}: rouleau order {cosine:.4f}, {count:.3f} neighbours per cell")

    chosen = chosen_cells(args, identities)
    time, paths = history.steps * args.timestep, centres[:, chosen]
    names = " ".join(f"{d}_{identities[i]}" for i in chosen for d in "xyz")
    np.savetxt(f"{args.output}-paths.dat",
               np.column_stack([time, paths.reshape(len(time), -1)]),
               header="time " + names, fmt="%.8g")
    plot_statistics(f"{args.output}.png", found, time, paths[..., "xyz".index(args.coordinate)],
                    identities[chosen], args.coordinate, args.time_label)
