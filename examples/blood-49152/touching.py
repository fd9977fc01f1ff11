#!/usr/bin/python3
"""How sizes of aggregates depend on what counts as touching: how near two surfaces are, and on what
share of one of them. Takes the surfaces that one run of study.py wrote from a strain on, counts
again with in.touching, and writes touching.csv and touching.png.

touching.py --output FOLDER --run FOLDER/10
"""
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
import numpy as np  # noqa: E402
import blood_runs  # noqa: E402
import example_study  # noqa: E402
from rbc.aggregates import COLORS, mean_classes  # noqa: E402
from rbc.tables import read_table  # noqa: E402
from rbc.snapshots import surfaces  # noqa: E402
from rbc.surfaces import read_surfaces  # noqa: E402

REACHES = "300", "400", "500", "600", "700"      # nm, as in in.touching
SHARES = "1", "2", "5", "7", "10"                # % of the surface


def write_dump(files, lengths, path):
    """Positions of all vertices of files of surfaces, as a dump with image flags. A cell's vertices
    have the IDs that rbc/create gave them: in order of the cells and of the template."""
    with open(path, "w", encoding="utf-8") as dump:
        for step, name in files:
            surface = read_surfaces(name)
            points = surface.points
            order = np.argsort(surface.data["molecule"], kind="stable")
            images = np.floor(points / lengths) * (1, 1, 0)
            wrapped = points - images * lengths
            bounds = "\n".join(f"0 {length!r}" for length in lengths.tolist())
            dump.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(points)}\n"
                       f"ITEM: BOX BOUNDS pp pp ff\n{bounds}\nITEM: ATOMS id x y z ix iy iz\n")
            rows = np.column_stack([np.arange(1, len(points) + 1), wrapped[order], images[order]])
            np.savetxt(dump, rows, fmt="%d %.15g %.15g %.15g %d %d %d")


def settled(folder, start):
    """(step, file) of the surfaces from a strain of `start` on."""
    table = blood_runs.history(folder)
    return [(step, name) for step, name in surfaces(folder)
            if np.interp(step, table["Step"], table["v_sheared"]) >= start]


def row(folder, reach, share, cells):
    """Of touching.csv: means over the surfaces."""
    classes = mean_classes(folder / f"classes.{reach}.{share}.dat")
    sizes = read_table(folder / f"sizes.{reach}.{share}.dat")
    aggregates, median, largest = (
        sizes[f"c_agg_{reach}_{share}[{n}]"].mean() for n in (1, 3, 4))
    shares, singles = classes.fractions(False), classes.aggregates[0]
    return {"reach_um": float(reach) / 1000, "share": float(share) / 100,
            "singles": singles / cells,
            "median": median, "largest": largest,
            "mean_of_two_and_more": (cells - singles) / max(aggregates - singles, 1),
            **{f"of_{size}_to_{2 * size - 1}": shares[classes.edges == size].sum()
               for size in (2, 4, 8, 16, 32, 64)},
            "of_128_and_more": shares[classes.edges >= 128].sum()}


def count(arguments):
    """{name: row} of all distances and shares."""
    files, cells = settled(arguments.run, arguments.start), blood_runs.cell_count(arguments.run)
    with tempfile.TemporaryDirectory() as folder:
        write_dump(files, blood_runs.box(arguments.run), Path(folder) / "surfaces.dump")
        done = example_study.run_script(arguments, HERE / "in.touching", folder,
                                        {"restart": arguments.run / "last.restart"})
        print(*blood_runs.said(done), sep="\n")
        done.check_returncode()
        return {f"{reach} {share}": row(Path(folder), reach, share, cells)
                for reach in REACHES for share in SHARES}


def print_table(table):
    """In Markdown."""
    print("| near, µm | " + " | ".join(f"{share} %" for share in SHARES) + " |")
    print("|" + "---|" * (len(SHARES) + 1))
    for reach in REACHES:
        each = [table[f"{reach} {share}"] for share in SHARES]
        print(f"| {float(reach) / 1000:g} | " + " | ".join(
            f"{100 * one['singles']:.0f} %, {one['largest']:.0f}, {100 * one['of_2_to_3']:.0f} %, "
            f"{100 * one['of_64_to_127']:.2g} %" for one in each) + " |")


def draw(table, path):
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    axes = figure.subplots(1, 2)
    for share, color in zip(SHARES, COLORS):
        for panel, name in zip(axes, ("largest", "singles")):
            panel.plot([float(reach) / 1000 for reach in REACHES],
                       [table[f"{reach} {share}"][name] for reach in REACHES], "o-", color=color,
                       label=f"{share} % of the surface")
    axes[0].set(xlabel="surfaces are near below (um)", ylabel="cells in the largest aggregate",
                yscale="log")
    axes[1].set(xlabel="surfaces are near below (um)", ylabel="share of cells that are single")
    axes[1].legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = example_study.options(__doc__)
    parser.add_argument("--run", type=lambda path: Path(path).resolve(), required=True,
                        help="folder of a run of study.py")
    parser.add_argument("--from", dest="start", type=float, default=1.5, metavar="STRAIN",
                        help="leave out surfaces before it")
    arguments = command_line.parse(parser, HERE)
    table = count(arguments)
    example_study.write_rows(table, arguments.output / "touching.csv")
    draw(table, arguments.output / "touching.png")
    print_table(table)


if __name__ == "__main__":
    main()
