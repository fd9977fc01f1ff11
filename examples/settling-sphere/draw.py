#!/usr/bin/python3
"""Draws settling.dat and scene.dat, written by in.settling-sphere: the speed of the sphere against
the Basset-Boussinesq-Oseen equation of a sphere alone (short times) and the steady drag of a cubic
array (long times).

draw.py RUN --output FOLDER      # RUN: the folder of the run
"""

import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402


class Scene(NamedTuple):
    """What scene.dat holds."""
    side: float
    cells: float
    mass: float
    weight: float
    timestep: float


def hydrodynamic_radius(scene):
    """Of markers at radius 1 with the kernel peskin4: 0.40 dx + 0.80 dx^2 more (bench/drag measures
    it)."""
    h = scene.side / scene.cells
    return 1 + 0.40 * h + 0.80 * h * h


def array_drag(scene, radius):
    """Drag factor of a simple cubic array, Sangani & Acrivos, Int. J. Multiphase Flow 8 (1982)
    343."""
    c = 4 * np.pi / 3 * (radius / scene.side) ** 3
    return 1 / (1 - 1.7601 * c ** (1 / 3) + c - 1.5593 * c**2 +
                3.9799 * c ** (8 / 3) - 3.0734 * c ** (10 / 3))


def alone(scene, radius, times):
    """Basset-Boussinesq-Oseen: (m + V + V/2) u' + 6 pi a (u + a int u'(s) / sqrt(pi (t - s)) ds) =
    F, with the acceleration constant over each interval."""
    volume = 4 * np.pi / 3 * radius**3
    inertia, drag = scene.mass + 1.5 * volume, 6 * np.pi * radius
    speed, acceleration = [0.0], []
    for n in range(1, len(times)):
        dt = times[n] - times[n - 1]
        left = np.sqrt(times[n] - times[:n])
        right = np.append(np.sqrt(times[n] - times[1:n]), 0.0)
        weight = 2 * radius / np.sqrt(np.pi) * (left - right)
        history = np.dot(weight[:-1], acceleration)
        a = (scene.weight - drag * (speed[-1] + history)) / (inertia + drag * (dt + weight[-1]))
        acceleration.append(a)
        speed.append(speed[-1] + a * dt)
    return np.array(speed)


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("run", type=Path)
    command_line.add_results(parser)
    arguments = command_line.parse(parser, HERE)
    scene = Scene(*np.loadtxt(arguments.run / "scene.dat"))
    step, _, speed = np.loadtxt(arguments.run / "settling.dat").T
    time, radius = step * scene.timestep, hydrodynamic_radius(scene)
    terminal = scene.weight / (6 * np.pi * radius * array_drag(scene, radius))
    fine = np.linspace(0, 1, 2001)
    early = alone(scene, radius, fine)
    at = np.interp(0.2, fine, early)
    print(f"hydrodynamic radius {radius:.4f}: terminal speed {speed[-1]:.5f}, cubic array "
          f"{terminal:.5f} ({100 * (speed[-1] / terminal - 1):+.2f} %); at time 0.2 "
          f"{np.interp(0.2, time, speed):.5f}, "
          f"alone {at:.5f} ({100 * (np.interp(0.2, time, speed) / at - 1):+.2f} %)")

    figure, axis = plt.subplots(figsize=(6, 4))
    axis.plot(time, speed, label="USER-RBC")
    axis.plot(fine, early, "--", label="a sphere alone (Basset-Boussinesq-Oseen)")
    axis.axhline(terminal, color="grey", linestyle=":",
                 label="cubic array, steady (Sangani & Acrivos)")
    axis.set_xlabel("time · viscosity / (density · radius²)")
    axis.set_ylabel("speed")
    axis.set_ylim(0, 1.3 * terminal)
    axis.legend()
    figure.tight_layout()
    figure.savefig(arguments.output / "settling.png", dpi=110)


if __name__ == "__main__":
    main()
