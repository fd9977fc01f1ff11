#!/usr/bin/python3
"""Cells that enter a tube at a given discharge hematocrit and leave it: what passes both ends.

Runs in.stream, or reads its stream.dat, and writes stream.csv and stream.png to a folder; with
--dense the scene of 40 percent, dense.csv and dense.png.

study.py --output FOLDER [--dense] [--lmp ../../build/lmp_rbc] [--read stream.dat]
"""
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402

# of in.stream
DIAMETER, VOLUME = 20.0, 89.31


@dataclass(frozen=True)
class Scene:
    name: str
    hematocrit: float
    length: float    # of the tube

    @property
    def tube(self):
        """Volume of the tube."""
        return np.pi * DIAMETER**2 / 4 * self.length


STREAM, DENSE = Scene("stream", 0.2, 90.0), Scene("dense", 0.4, 94.0)
COLUMNS = ("transits", "entered", "left", "inside", "owed", "in", "out", "tube")


def read(path, scene=STREAM):
    """Rows of stream.dat: transits of the stream, cells that entered, left, are inside and are
    owed, discharge hematocrits of what entered and left since the start and tube hematocrit."""
    data = np.loadtxt(path)
    step_and_time, stream, tube = data[:, :2], data[:, 2:-1], data[:, -1]
    transits = stream[:, 6] / scene.tube
    return np.column_stack([transits, stream[:, :6], tube])[step_and_time[:, 0] > 0]


def discharge(rows, begin, end, scene=STREAM):
    """Discharge hematocrits in and out between two times, given in transits."""
    first, last = (rows[np.searchsorted(rows[:, 0], time)] for time in
                   (begin, min(end, rows[-1, 0])))
    volume = (last[0] - first[0]) * scene.tube
    return tuple((last[n] - first[n]) * VOLUME / volume for n in (1, 2))


def pries(discharged, diameter):
    """Tube hematocrit over discharge hematocrit: the fit of Pries et al. 1990 to measurements, the
    diameter in um."""
    lower = 1 + 1.7 * np.exp(-0.415 * diameter) - 0.6 * np.exp(-0.011 * diameter)
    return discharged + (1 - discharged) * lower


def report(rows, scene):
    whole = round(rows[-1, 0])
    for begin in range(whole):
        entered, left = discharge(rows, begin, begin + 1, scene)
        print(f"transit {begin + 1}: discharge hematocrit in {entered:.4f}, out {left:.4f}")
    entered, left = discharge(rows, 1, rows[-1, 0], scene)
    each = np.array([discharge(rows, begin, begin + 1, scene) for begin in range(1, whole)])
    error = each.std(axis=0, ddof=1) / np.sqrt(len(each)) if len(each) > 1 else (np.nan, np.nan)
    late = rows[rows[:, 0] > 1]
    print(f"behind the first: in {entered:.4f} +- {error[0]:.4f}, out {left:.4f} +- "
          f"{error[1]:.4f} (standard errors of the mean of transits)")
    print(f"entered {rows[-1, 1]:.0f}, left {rows[-1, 2]:.0f}, inside {late[:, 3].min():.0f} to "
          f"{late[:, 3].max():.0f}, owed {rows[:, 4].min():+.2f} to {rows[:, 4].max():+.2f}")
    ratio = pries(scene.hematocrit, DIAMETER)
    print(f"tube hematocrit {late[:, 7].mean():.4f}; of a long tube {scene.hematocrit:g} x "
          f"{ratio:.3f} = {scene.hematocrit * ratio:.4f}")


def plot(rows, path, scene):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8))
    left.plot(rows[:, 0], rows[:, 1], color="#b3202a", label="entered")
    left.plot(rows[:, 0], rows[:, 2], color="#2a6fb0", label="left")
    left.plot(rows[:, 0], rows[:, 3], color="#555555", label="inside")
    left.plot(rows[:, 0], scene.hematocrit * rows[:, 0] * scene.tube / VOLUME, "k:",
              label="H times volume that entered")
    left.set(xlabel="lengths of the tube that the stream went", ylabel="cells")
    half = 0.5
    times = rows[(rows[:, 0] > half) & (rows[:, 0] < rows[-1, 0] - half), 0]
    for n, (color, label) in enumerate((("#b3202a", "discharge, in"),
                                        ("#2a6fb0", "discharge, out"))):
        right.plot(times, [discharge(rows, time - half, time + half, scene)[n] for time in times],
                   color=color, label=label)
    right.plot(rows[:, 0], rows[:, 7], color="#555555", label="tube")
    right.axhline(scene.hematocrit, color="k", ls=":", label="H")
    right.set(xlabel="lengths of the tube that the stream went", ylabel="hematocrit",
              ylim=(0, 1.5 * scene.hematocrit))
    for axes in (left, right):
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = example_study.options(__doc__, [])
    parser.add_argument("--dense", action="store_true", help="40 percent instead of 20")
    parser.add_argument("--read", type=Path, help="a stream.dat that a run has written")
    arguments = command_line.parse(parser, HERE)
    scene = DENSE if arguments.dense else STREAM
    if arguments.read:
        rows = read(arguments.read, scene)
    else:
        with tempfile.TemporaryDirectory() as folder:
            example_study.run_script(arguments, HERE / "in.stream", folder,
                                     {"dense": int(arguments.dense)}).check_returncode()
            rows = read(Path(folder) / "stream.dat", scene)
    report(rows, scene)
    np.savetxt(arguments.output / f"{scene.name}.csv", rows[::5], fmt="%.6g", delimiter=",",
               header=",".join(COLUMNS), comments="")
    plot(rows, arguments.output / f"{scene.name}.png", scene)


if __name__ == "__main__":
    main()
