#!/usr/bin/python3
"""Picture of a run of in.shear-cell: D and angles against strain, above snapshots of the cell.

    draw.py FOLDER        where cell.dat, vertices.dump, scene.dat and cells.*.vtp are; writes shear-cell.png
"""

import glob
import os
import re
import subprocess
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
sys.path.insert(0, SCRIPTS)
from membrane_motion import angles, read_dump  # noqa: E402
from read_ave_time import read_ave_time  # noqa: E402

SNAPSHOTS = 4


def snapshots(folder):
    """(step, image) of surfaces spread evenly over the run, seen along the vorticity."""
    step = lambda name: int(re.search(r"cells\.(\d+)\.", name).group(1))  # noqa: E731
    files = sorted(glob.glob(os.path.join(folder, "cells.*.vtp")), key=step)
    files = [files[i] for i in np.unique(np.linspace(0, len(files) - 1, SNAPSHOTS).round().astype(int))]
    for name in files:
        png = name[:-4] + ".png"
        subprocess.run([os.path.join(SCRIPTS, "render_cells.py"), name, "-o", png, "--box", "0", "24", "0", "24",
                        "0", "24", "--view", "10", "8", "--zoom", "1.9", "--size", "640x480"], check=True)
        yield step(name), plt.imread(png)


def main():
    folder = sys.argv[1]
    rate, timestep, viscosity = np.loadtxt(os.path.join(folder, "scene.dat"))
    strain = rate * 1e-6 * timestep
    history = read_ave_time(os.path.join(folder, "cell.dat"))
    steps, positions = read_dump(os.path.join(folder, "vertices.dump"))
    shape, membrane = np.degrees(angles(positions))

    figure = plt.figure(figsize=(12, 6.6))
    grid = figure.add_gridspec(2, SNAPSHOTS, height_ratios=(1.15, 1))
    deformation = figure.add_subplot(grid[0, :SNAPSHOTS // 2])
    deformation.plot(history.steps * strain, history.column(7)[:, 0], color="#b3202a")
    deformation.set(xlabel="strain (shear rate × time)", ylabel="Taylor deformation D", ylim=(0, None),
                    title=f"healthy red cell at {rate:g} /s, {viscosity:.3g} mPa s")
    turning = figure.add_subplot(grid[0, SNAPSHOTS // 2:])
    turning.plot(steps * strain, shape, label="shape (long axis)")
    turning.plot(steps * strain, membrane + shape[0], "--", label="membrane")
    turning.set(xlabel="strain", ylabel="angle to the flow / degrees")
    turning.legend(frameon=False)
    for n, (step, image) in enumerate(snapshots(folder)):
        panel = figure.add_subplot(grid[1, n])
        panel.imshow(image)
        panel.set_axis_off()
        panel.set_title(f"strain {step * strain:.0f}", fontsize=10)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "shear-cell.png"), dpi=90)


if __name__ == "__main__":
    main()
