"""What a run of in.files wrote, in numpy; doc/tutorial_python.rst explains it. Runs in the folder
of the files."""
import numpy as np
import rbc

# Cells over time
cells = rbc.read_cell_table("cell.dat", timestep=0.2)
milliseconds = cells.time
deformation = cells["deformation"].mean(axis=1)
print(f"{len(cells.molecules)} cells, {milliseconds[-1]:g} ms")
print(f"mean D: {deformation[0]:.3f} at first, {deformation[-1]:.3f} at the end")
drift = np.abs(cells["volume"] / cells["volume"][0] - 1).max()
print(f"volumes change by up to {drift:.1e}")

# Surfaces
surfaces = rbc.read_surfaces("cells.200.vtp")
tension = surfaces.data["tension"]
print(f"{len(surfaces.points)} vertices; tension up to {1000 * tension.max():.2f} uN/m")
shapes = rbc.shapes_of("cells.200.vtp")
flattest = min(shapes, key=lambda molecule: abs(shapes[molecule].tilt))
shape = shapes[flattest]
print(f"cell {flattest}: {shape.tilt:.1f} degrees to the flow, "
      f"reduced volume {shape.reduced_volume:.3f}")

# The flow
grid = rbc.read_grid("velocity.200.vtr")
profile = grid.vector()[..., 0].mean(axis=(0, 1))
height = grid.centres[2]
middle = np.abs(height - 8) < 4
shear = np.polyfit(height[middle], profile[middle], 1)[0]
print(f"shear rate {shear * 1e6:.1f} /s in the middle, 100 /s on average")

# The log
run = rbc.read_log("log.lammps")[-1]
viscosity = run["f_flow[1]"] / 1e-4
print(f"viscosity {viscosity[-1]:.2f} mPa s, of plasma 1.5")

# Pictures
box = (0, 16) * 3
look = rbc.Look(box=box, plates=True, size=(640, 560), color="velocity")
rbc.render("cells.200.vtp", "cells.png", look)
flow = look._replace(color=None, flow="velocity.200.vtr", slice="y", slice_at=8)
rbc.render("cells.200.vtp", "flow.png", flow)
rbc.plot_shear("deformation.png", [("mean of 12 cells", milliseconds, deformation)],
               labels=rbc.ShearLabels(x="time (ms)"))
