#!/usr/bin/python3
"""Cells per block over time, of a straight tube and of one with a throat, as Figure 7 of the paper.

draw.py straight/ throat/ --output FOLDER

The first two folders are those in which in.throat ran, with -var throat 3 and without. Writes
throat.png and throat.csv: the lines of both blocks.dat.
"""
import csv
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from rbc.tables import read_table  # noqa: E402

BLOCKS = "v_block0", "v_block1", "v_block2"
TITLES = "(a) straight tube", "(b) with a throat"
VERTICES = 642


def read_slices(path):
    """Steps, middles of the slices and vertices in them, of `fix ave/chunk`."""
    rows = [line.split() for line in Path(path).read_text(encoding="ascii").splitlines()
            if not line.startswith("#")]
    size = int(rows[0][1]) + 1
    blocks = [rows[n:n + size] for n in range(0, len(rows) - size + 1, size)]
    table = np.array([[row[1:3] for row in block[1:]] for block in blocks], dtype=float)
    return np.array([int(block[0][0]) for block in blocks]), table[0, :, 0], table[:, :, 1]


def mean_over_time(time, values):
    """By the trapezoidal rule, as timesteps differ; rows of values belong to times."""
    weights = np.diff(time)
    return weights @ (values[1:] + values[:-1]) / (2 * weights.sum())


def second_half(time):
    """Rows from the last one before half of the time on."""
    return time >= time[time <= time[-1] / 2][-1]


def draw(folders, path):
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.6), sharey="row")
    for column, (folder, title) in enumerate(zip(folders, TITLES)):
        table = read_table(folder / "blocks.dat")
        top, bottom = axes[:, column]
        for name, color in zip(BLOCKS, ("#b3202a", "#4b8b3b", "#2a6fb0")):
            top.step(table["v_seconds"], table[name], where="post", color=color,
                     label=f"BLOCK {name[-1]}")
        top.set(title=title, xlabel="time / s", ylabel="cells in a block" if column == 0 else None)
        top.legend(frameon=False, fontsize=8, ncol=3)
        steps, x, vertices = read_slices(folder / "slices.dat")
        time = np.interp(steps, table["TimeStep"], table["v_seconds"])
        last = second_half(time)
        bottom.step(x, vertices[0] / VERTICES, where="mid", color="0.6", label="at the start")
        bottom.step(x, mean_over_time(time[last], vertices[last]) / VERTICES, where="mid",
                    color="k", label="mean over the second half")
        bottom.set(xlabel="x / µm (flow to the right)",
                   ylabel="cells in a slice of D/2" if column == 0 else None)
        bottom.legend(frameon=False, fontsize=8)
    for left in axes[:, 0]:    # both columns share its limits
        left.set_ylim(0, 1.15 * left.get_ylim()[1])
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("straight", type=Path)
    parser.add_argument("throat", type=Path)
    command_line.add_results(parser)
    arguments = command_line.parse(parser, HERE)
    folders = arguments.straight, arguments.throat
    with open(arguments.output / "throat.csv", "w", newline="", encoding="ascii") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(("vessel", "seconds", "block0", "block1", "block2", "mean_velocity_um_s",
                         "lengths_gone"))
        for folder, vessel in zip(folders, ("straight", "throat")):
            table = read_table(folder / "blocks.dat")
            gone = table["v_passed"] - table["v_passed"][0]
            writer.writerows(
                (vessel, f"{t:.5f}", *(f"{n:g}" for n in counts), f"{u:.4g}", f"{g:.4f}")
                for t, *counts, u, g in
                zip(table["v_seconds"], *(table[name] for name in BLOCKS), table["v_u"], gone))
            time = table["v_seconds"]
            last = second_half(time)
            print(f"{vessel}: {time[-1]:.3f} s, cells went {gone[-1]:.2f} lengths; mean of the "
                  "second half:",
                  *(f"BLOCK {name[-1]} {mean_over_time(time[last], table[name][last]):.2f}"
                    for name in BLOCKS),
                  f"velocity {mean_over_time(time[last], table['v_u'][last]):.1f} um/s")
            for length in range(int(gone[-1] + 0.01)):
                rows = (gone >= length) & (gone < length + 1)
                before, behind = (mean_over_time(time[rows], table[name][rows])
                                  for name in (BLOCKS[0], BLOCKS[2]))
                print(f"  length {length + 1}: BLOCK 0 over BLOCK 2 {before / behind:.3f}")
    draw(folders, arguments.output / "throat.png")


if __name__ == "__main__":
    main()
