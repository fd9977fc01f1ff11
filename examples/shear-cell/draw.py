#!/usr/bin/python3
"""Picture of a run of in.shear-cell: D and angles against strain, above snapshots of the cell.
Prints the ranges of D (after a strain of 5), of the area, and the largest error of the volume.

draw.py RUN --output FOLDER

RUN is where cell.dat, vertices.dump, scene.dat and cells.*.vtp are; shear-cell.png goes to FOLDER.
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from rbc.membrane_motion import angles, read_dump  # noqa: E402
from rbc.tables import read_ave_time  # noqa: E402
from rbc.snapshots import picture, surfaces  # noqa: E402

SNAPSHOTS = 5
TUMBLE = 9.2  # strain of half a turn at 100 /s in plasma


def snapshots(folder, strain):
    """(step, image) of surfaces over one tumble in the middle of the run, seen along the
    vorticity."""
    steps, files = zip(*surfaces(folder))
    strains = np.array(steps) * strain
    wanted = strains[-1] / 2 + np.linspace(0, min(TUMBLE, strains[-1] / 2), SNAPSHOTS)
    for i in np.unique(np.abs(strains[:, None] - wanted).argmin(axis=0)):
        yield steps[i], picture(files[i], 24)


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("run")
    command_line.add_results(parser)
    arguments = command_line.parse(parser, HERE)
    folder = arguments.run
    rate, timestep, viscosity = np.loadtxt(os.path.join(folder, "scene.dat"))
    strain = rate * 1e-6 * timestep
    history = read_ave_time(os.path.join(folder, "cell.dat"))
    steps, positions = read_dump(os.path.join(folder, "vertices.dump"))
    shape, membrane = np.degrees(angles(positions))

    deformations, areas, volumes = (history.column(n)[:, 0] for n in (7, 5, 6))
    late = deformations[history.steps * strain >= 5]
    if late.size:
        print(f"D {late.min():.3f} to {late.max():.3f}, area {areas.min():.1f} to "
              f"{areas.max():.1f} um^2, volume within {np.abs(volumes / volumes[0] - 1).max():.1e}")

    figure = plt.figure(figsize=(12, 5.6))
    grid = figure.add_gridspec(2, 2 * SNAPSHOTS, height_ratios=(1.5, 1))
    deformation = figure.add_subplot(grid[0, :SNAPSHOTS])
    deformation.plot(history.steps * strain, deformations, color="#b3202a")
    deformation.set(xlabel="strain (shear rate × time)", ylabel="Taylor deformation D",
                    ylim=(0, None), title=f"healthy red cell at {rate:g} /s, {viscosity:.3g} mPa s")
    turning = figure.add_subplot(grid[0, SNAPSHOTS:])
    turning.plot(steps * strain, (shape - shape[0]) / 180, label="shape (long axis)")
    turning.plot(steps * strain, membrane / 180, "--", label="membrane")
    turning.set(xlabel="strain", ylabel="half turns since the start")
    turning.legend(frameon=False)
    for n, (step, image) in enumerate(snapshots(folder, strain)):
        panel = figure.add_subplot(grid[1, 2 * n:2 * n + 2])
        panel.imshow(image)
        panel.set_axis_off()
        panel.set_title(f"strain {step * strain:.0f}", fontsize=10)
    figure.tight_layout()
    figure.savefig(arguments.output / "shear-cell.png", dpi=90)


if __name__ == "__main__":
    main()
