#!/usr/bin/python3
"""Viscosity, hematocrit and cell-free layer of blood in tubes, over time, beside the fits of Pries
et al. to measurements.

Runs in.fahraeus in a folder for each case, and once without cells, writes fahraeus.csv and draws
fahraeus.png. Cases of which the folder is there already are not run again.

study.py --output FOLDER [--folder runs] [--lmp ../../build/lmp_rbc] [--only d20h30-coarse]
"""
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from rbc.tables import read_ave_time  # noqa: E402
from rbc.snapshots import surfaces  # noqa: E402

SCRIPT = HERE / "in.fahraeus"
TUBES = {    # variables of in.fahraeus
    "d10h30": {"diameter": 10, "hematocrit": 0.3, "length": 15.5, "turns": 36},
    # six cells fit in
    "d10h45": {"diameter": 10, "hematocrit": 0.45, "length": 15.5, "turns": 36, "seed": 1},
    "d20h30": {"diameter": 20, "hematocrit": 0.3, "length": 10.5},
    "d20h45": {"diameter": 20, "hematocrit": 0.45, "length": 10.5},
    "d40h30": {"diameter": 40, "hematocrit": 0.3, "length": 10.5},
    "d40h45": {"diameter": 40, "hematocrit": 0.45, "length": 10.5},
}
MESHES = {"coarsest": {"shape": "rbc_162", "dx": 0.8, "range": 0.8},
          "coarse": {"shape": "rbc_162", "dx": 0.65},
          "fine": {"shape": "rbc_362", "dx": 0.5}}
INSIDE = 7.4825          # five times the viscosity of plasma, mPa s
CASES = {**{f"{tube}-{mesh}": {**TUBES[tube], **MESHES[mesh]} for tube in TUBES for mesh in MESHES
            if mesh == "coarse" or mesh == ("coarsest" if tube == "d40h30" else "fine")},
         "d20h45-inside": {**TUBES["d20h45"], **MESHES["coarse"], "inside": INSIDE}}
RATE = 50e-6             # mean velocity over diameter, 1/us
COLORS = {"d10h30": "#8cbf6f", "d10h45": "#33691e", "d20h30": "#e06666", "d20h45": "#8b1a1a",
          "d40h30": "#6fa8dc", "d40h45": "#1c4587"}
WIDTHS = {"coarsest": 0.5, "coarse": 1, "fine": 2}    # of lines
PICTURES = "d10h45-fine", "d20h45-fine", "d40h45-coarse"


def pries_viscosity(diameter, discharge):
    """Relative apparent viscosity (Pries et al. 1992) for a discharge hematocrit; diameter in
    um."""
    at45 = 220 * np.exp(-1.3 * diameter) + 3.2 - 2.44 * np.exp(-0.06 * diameter**0.645)
    wide = 1 / (1 + 1e-11 * diameter**12)
    exponent = (0.8 + np.exp(-0.075 * diameter)) * (wide - 1) + wide
    return 1 + (at45 - 1) * ((1 - discharge)**exponent - 1) / (0.55**exponent - 1)


def pries_discharge(diameter, tube):
    """Discharge hematocrit for one in the tube (Pries et al. 1990)."""
    x = 1 + 1.7 * np.exp(-0.415 * diameter) - 0.6 * np.exp(-0.011 * diameter)
    half = x / (2 * (1 - x))
    return np.sqrt(half**2 + tube / (1 - x)) - half


def read_history(path):
    """Columns by name of a fix ave/time table of a run that may still be going on."""
    lines = path.read_text(encoding="utf-8").rpartition("\n")[0].splitlines()
    names = lines[1].lstrip("# ").split()
    return dict(zip(names, np.array([line.split() for line in lines[2:]], dtype=float).T))


def cell_free_layer(points, axis, diameter, length, views=12, slice_length=0.5):
    """Distance from the wall of the cells' silhouette, seen from the side; mean over views and
    slices along the axis."""
    slices = max(1, round(length / slice_length))
    slice_of = np.floor(points[:, 0] / length * slices).astype(int) % slices
    gaps = []
    for angle in np.arange(views) * 2 * np.pi / views:
        edge = np.full(slices, -np.inf)
        np.maximum.at(edge, slice_of, (points[:, 1:] - axis) @ (np.cos(angle), np.sin(angle)))
        gaps.append(diameter / 2 - edge[np.isfinite(edge)].mean())
    return np.mean(gaps)


def layers(folder, diameter, length, dx):
    """Times and cell-free layers of all surfaces written."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    axis = dx * np.ceil(diameter / dx + 6) / 2
    rows = []
    for _, name in surfaces(folder):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(name)
        reader.Update()
        cells = reader.GetOutput()
        points = vtk_to_numpy(cells.GetPoints().GetData()).astype(float)
        corners = points[vtk_to_numpy(cells.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
        time = cells.GetFieldData().GetArray("TimeValue").GetValue(0)
        rows.append((time, cell_free_layer(np.concatenate([points, corners.mean(axis=1)]), axis,
                                           diameter, length)))
    return np.array(rows).T


def measure(folder, plasma, diameter=20, length=10.5, dx=0.65, shape="rbc_162", **_):
    """Histories over U t / D, and means over the last third and the third before it."""
    history, cells = read_history(folder / "tube.dat"), read_ave_time(folder / "cell.dat")
    turned = history["v_time"] * RATE
    volumes = cells.column(6)
    real_tube = volumes[0].sum() / (np.pi / 4 * diameter**2 * length)
    viscosity = history["v_relative"] / plasma
    ratio = history["v_mean"] / history["v_u_cells"]
    time, layer = layers(folder, diameter, length, dx)
    case = {"turned": turned, "viscosity": viscosity, "ratio": ratio, "layer": (time * RATE, layer)}
    thirds = {"last": turned > 2 / 3 * turned[-1], "before": abs(turned / turned[-1] - 0.5) < 1 / 6}
    row = {"diameter": diameter, "length": length, "vertices": int(shape[4:]), "dx": dx,
           "cells": volumes.shape[1], "turns": turned[-1], "tube": real_tube}
    for name, chosen in thirds.items():
        row[f"viscosity_{name}"] = viscosity[chosen].mean()
        row[f"ratio_{name}"] = ratio[chosen].mean()
        row[f"layer_{name}"] = np.interp(turned[chosen], time * RATE, layer).mean()
    # of a solid core, same viscosity
    row["solid_layer"] = diameter / 2 * (1 - (1 - 1 / row["viscosity_last"])**0.25)
    row["discharge"] = real_tube / row["ratio_last"]
    row["pries_discharge"] = pries_discharge(diameter, real_tube)
    row["pries_ratio"] = real_tube / row["pries_discharge"]
    row["pries_viscosity"] = pries_viscosity(diameter, row["pries_discharge"])
    row["pries_viscosity_at_discharge"] = pries_viscosity(diameter, row["discharge"])
    row["least_gap"] = history["v_layer"].min()
    row["volume"] = abs(volumes / volumes[0] - 1).max()
    return case, row


def draw(cases, rows, pictures, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure = plt.figure(figsize=(13, 8), layout="constrained")
    grid = figure.add_gridspec(2, 6, height_ratios=(4, 3))
    panels = [figure.add_subplot(grid[0, 2 * n:2 * n + 2]) for n in range(3)]
    for name, case in cases.items():
        row, (tube, mesh) = rows[name], name.split("-")
        if mesh not in MESHES:
            continue
        label = f"{row['diameter']:g} µm, {100 * TUBES[tube]['hematocrit']:.0f} %"
        for panel, series, reference in zip(panels, ("viscosity", "ratio", "layer"),
                                            ("pries_viscosity", "pries_ratio", None)):
            x, y = case[series] if series == "layer" else (case["turned"], case[series])
            x = x / row["turns"]
            panel.plot(x, y, color=COLORS[tube], lw=WIDTHS[mesh],
                       label=label if mesh == "coarse" else None)
            if reference and mesh == "coarse":
                panel.axhline(row[reference], color=COLORS[tube], ls="--", lw=1)
    panels[0].set(ylabel="viscosity over that of plasma", ylim=(1, None))
    panels[1].set(ylabel="tube over discharge hematocrit", ylim=(None, 1))
    panels[2].set(ylabel="cell-free layer / µm", ylim=(0, None))
    for mesh, width in WIDTHS.items():
        panels[0].plot([], [], "k", lw=width,
                       label=f"{MESHES[mesh]['shape'][4:]} vertices, dx {MESHES[mesh]['dx']} µm")
    panels[0].plot([], [], "k--", lw=1, label="Pries et al., same tube hematocrit")
    for panel in panels:
        panel.set(xlabel="time over that of the run", xlim=(0, 1))
    panels[0].legend(frameon=False, fontsize=8, ncols=2)
    for n, (name, picture) in enumerate(pictures.items()):
        panel = figure.add_subplot(grid[1, 6 // len(pictures) * n:6 // len(pictures) * (n + 1)])
        panel.imshow(plt.imread(picture))
        panel.set_title(f"{rows[name]['diameter']:g} µm, {100 * rows[name]['tube']:.0f} %, at "
                        "the end", fontsize=9)
        panel.axis("off")
    figure.savefig(path, dpi=90)


def plasma(arguments, variables):
    """Force density of plasma over that of Poiseuille's law, in the same tube of atoms."""
    folder = arguments.folder / f"plasma-d{variables['diameter']}-dx{variables['dx']}"
    arguments.only = arguments.only and [*arguments.only, folder.name]
    example_study.run_once(arguments, SCRIPT, folder, {**variables, "hematocrit": 0})
    lines = [line.split()
             for line in (folder / "log.lammps").read_text(encoding="utf-8").splitlines()]
    start = next(n for n, words in enumerate(lines) if words[:1] == ["Step"])
    return float(lines[start + 1][lines[start].index("v_relative")])


def main():
    parser = example_study.options(__doc__, CASES)
    example_study.add_runs_folder(parser)
    arguments = command_line.parse(parser, HERE)
    arguments.folder = example_study.runs_folder(arguments)
    cases, rows, pictures = {}, {}, {}
    for name, variables in CASES.items():
        folder = arguments.folder / name
        if not example_study.run_once(arguments, SCRIPT, folder, variables):
            continue
        cases[name], rows[name] = measure(folder, plasma(arguments, variables), **variables)
        print(name, {key: float(f"{value:.4g}") for key, value in rows[name].items()}, flush=True)
        if name not in PICTURES:
            continue
        pictures[name] = folder / "last.png"
        subprocess.run(
            [sys.executable, HERE.parents[1] / "scripts" / "render_cells.py",
             surfaces(folder)[-1][1], "-o", pictures[name],
             "--color", "molecule", "--view", "60", "15", "--size", "640x480"], check=True)
    example_study.write_rows(rows, arguments.output / "fahraeus.csv")
    draw(cases, rows, pictures, arguments.output / "fahraeus.png")


if __name__ == "__main__":
    main()
