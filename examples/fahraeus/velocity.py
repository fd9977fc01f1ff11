#!/usr/bin/python3
"""Velocity over the radius of the tube, of the last flow in flow.grid, beside Poiseuille's."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import numpy as np  # noqa: E402
import rbc  # noqa: E402

RADIUS, FLOW = 10, 0.25    # um, um^3/us

grid = rbc.read_grid("flow.grid")
_, y, z = grid.centres
distance = np.hypot(*np.meshgrid(y, z, indexing="ij"))
speed = 1000 * grid.data["f_flow:grid:velocity[1]"].mean(axis=0)    # along the tube; mm/s
for inner in range(RADIUS):
    ring = (distance >= inner) & (distance < inner + 1)
    parabola = 1000 * 2 * FLOW / (np.pi * RADIUS**2) * (1 - distance[ring]**2 / RADIUS**2)
    print(f"{inner + 0.5:4.1f} um {speed[ring].mean():6.3f} mm/s, plasma {parabola.mean():6.3f}")
