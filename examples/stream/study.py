#!/usr/bin/python3
"""Cells that enter a tube at a given discharge hematocrit and leave it: what passes both ends.

Runs in.stream, or reads its stream.dat, and writes stream.csv and stream.png to a folder.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--read stream.dat]
"""
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402

# of in.stream
HEMATOCRIT, DIAMETER, LENGTH, VOLUME = 0.2, 20.0, 90.0, 89.31
COLUMNS = ("transits", "entered", "left", "inside", "owed", "in", "out", "tube")


def read(path):
    """Rows of stream.dat: transits of the stream, cells that entered, left, are inside and are
    owed, discharge hematocrits of what entered and left since the start and tube hematocrit."""
    data = np.loadtxt(path)
    step_and_time, stream, tube = data[:, :2], data[:, 2:-1], data[:, -1]
    transits = stream[:, 6] / (np.pi * DIAMETER**2 / 4 * LENGTH)
    return np.column_stack([transits, stream[:, :6], tube])[step_and_time[:, 0] > 0]


def discharge(rows, begin, end):
    """Discharge hematocrits in and out between two times, given in transits."""
    first, last = (rows[np.searchsorted(rows[:, 0], time)] for time in
                   (begin, min(end, rows[-1, 0])))
    volume = (last[0] - first[0]) * np.pi * DIAMETER**2 / 4 * LENGTH
    return tuple((last[n] - first[n]) * VOLUME / volume for n in (1, 2))


def pries(discharged, diameter):
    """Tube hematocrit over discharge hematocrit: the fit of Pries et al. 1990 to measurements, the
    diameter in um."""
    lower = 1 + 1.7 * np.exp(-0.415 * diameter) - 0.6 * np.exp(-0.011 * diameter)
    return discharged + (1 - discharged) * lower


def report(rows):
    whole = round(rows[-1, 0])
    for begin in range(whole):
        entered, left = discharge(rows, begin, begin + 1)
        print(f"transit {begin + 1}: discharge hematocrit in {entered:.4f}, out {left:.4f}")
    entered, left = discharge(rows, 1, rows[-1, 0])
    late = rows[rows[:, 0] > 1]
    print(f"behind the first: in {entered:.4f}, out {left:.4f}")
    print(f"entered {rows[-1, 1]:.0f}, left {rows[-1, 2]:.0f}, inside {late[:, 3].min():.0f} to "
          f"{late[:, 3].max():.0f}, owed {rows[:, 4].min():+.2f} to {rows[:, 4].max():+.2f}")
    print(f"tube hematocrit {late[:, 7].mean():.4f}; of a long tube {HEMATOCRIT:g} x "
          f"{pries(HEMATOCRIT, DIAMETER):.3f} = {HEMATOCRIT * pries(HEMATOCRIT, DIAMETER):.4f}")


def plot(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8))
    left.plot(rows[:, 0], rows[:, 1], color="#b3202a", label="entered")
    left.plot(rows[:, 0], rows[:, 2], color="#2a6fb0", label="left")
    left.plot(rows[:, 0], rows[:, 3], color="#555555", label="inside")
    volume = np.pi * DIAMETER**2 / 4 * LENGTH
    left.plot(rows[:, 0], HEMATOCRIT * rows[:, 0] * volume / VOLUME, "k:",
              label="H times volume that entered")
    left.set(xlabel="lengths of the tube that the stream went", ylabel="cells")
    half = 0.5
    times = rows[(rows[:, 0] > half) & (rows[:, 0] < rows[-1, 0] - half), 0]
    for n, (color, label) in enumerate((("#b3202a", "discharge, in"),
                                        ("#2a6fb0", "discharge, out"))):
        right.plot(times, [discharge(rows, time - half, time + half)[n] for time in times],
                   color=color, label=label)
    right.plot(rows[:, 0], rows[:, 7], color="#555555", label="tube")
    right.axhline(HEMATOCRIT, color="k", ls=":", label="H")
    right.set(xlabel="lengths of the tube that the stream went", ylabel="hematocrit",
              ylim=(0, 1.5 * HEMATOCRIT))
    for axes in (left, right):
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = example_study.options(__doc__, [])
    parser.add_argument("--read", type=Path, help="a stream.dat that a run has written")
    arguments = command_line.parse(parser, HERE)
    if arguments.read:
        rows = read(arguments.read)
    else:
        with tempfile.TemporaryDirectory() as folder:
            example_study.run_script(arguments, HERE / "in.stream", folder, {}).check_returncode()
            rows = read(Path(folder) / "stream.dat")
    report(rows)
    np.savetxt(arguments.output / "stream.csv", rows[::5], fmt="%.6g", delimiter=",",
               header=",".join(COLUMNS), comments="")
    plot(rows, arguments.output / "stream.png")


if __name__ == "__main__":
    main()
