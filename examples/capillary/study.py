#!/usr/bin/python3
"""Croissant or slipper: a red cell in a channel of 12 x 10 um over its speed, from two starts,
beside the experiment and the simulations of Guckenberger et al.

Runs in.capillary in a folder for each case, and once without a cell, writes capillary.csv and draws
capillary.png. Cases of which the folder is there already are not run again; those that are neither
there nor asked for are left out.

study.py --output FOLDER [--folder runs] [--lmp ../../build/lmp_rbc] [--only 1.3-centred]
"""
import csv
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from rbc.tables import read_ave_time, read_table  # noqa: E402
from rbc.snapshots import surfaces  # noqa: E402

SCRIPT = HERE / "in.capillary"
# mean velocity of the fluid, mm/s; the cell is half as fast again
SPEEDS = 0.33, 0.65, 1.3, 1.95, 2.6, 3.9
STARTS = {"centred": {"offset": 0.2}, "beside": {"offset": 2, "tilt": 60}}
CASES = {f"{speed:g}-{start}": {"speed": speed, **variables} for speed in SPEEDS
         for start, variables in STARTS.items()}
FINE = {"0.65-centred": 75, "1.3-centred": 75, "1.3-beside": 75, "1.95-beside": 100,
        "2.6-centred": 75, "2.6-beside": 100}
CASES |= {f"{name}-fine": {**CASES[name], "dx": 0.5, "travel": travel}
          for name, travel in FINE.items()}
WIDTH, HEIGHT, PLASMA = 12, 10, 1.2    # of in.capillary
LAST = 1 / 4           # of a run, over which its end is measured
# distance from the axis that a slipper keeps, and a croissant does not have in the mean, um
BESIDE = 0.5
LINES = {"centred": "-", "beside": "--"}
COLORS = dict(zip(SPEEDS, ("#1c4587", "#6fa8dc", "#33691e", "#8cbf6f", "#e06666", "#8b1a1a")))


def duct_drive(speed, width=WIDTH, height=HEIGHT, viscosity=PLASMA):
    """Force density for a mean velocity in a rectangular duct without a cell: the series of its
    closed form."""
    n = np.arange(1, 200, 2)
    low, high = sorted((width, height))
    series = (np.tanh(n * np.pi * high / (2 * low)) / n**5).sum()
    return 12 * viscosity * speed / (low**2 * (1 - 192 * low / (np.pi**5 * high) * series))


def leans(shape):
    """Correlation of x with y and z over the volume of the cell at each output, from its semi-axes
    and axes: 0 where the cell is symmetric about a plane along the flow."""
    axes = np.stack([shape.columns(11, 13)[:, 0], np.zeros((len(shape.steps), 3)),
                     shape.columns(14, 16)[:, 0]], axis=1)
    axes[:, 1] = np.cross(axes[:, 2], axes[:, 0])
    moments = np.einsum("ta,tai,taj->tij", shape.columns(8, 10)[:, 0]**2, axes, axes)
    return moments[:, 0, 1:] / np.sqrt(
        moments[:, :1, 0] * np.stack([moments[:, 1, 1], moments[:, 2, 2]], axis=1))


def verdict(row):
    """What the numbers of the end of a run say of the shape: a slipper stays beside the axis and
    its membrane turns one way, a croissant may sway about the axis."""
    if row["nearest"] > BESIDE and abs(row["turned"]) > 0.25:
        return "slipper"
    return ("croissant" if np.hypot(row["y"], row["z"]) < BESIDE and row["furthest"] < 2 * BESIDE
            else "neither")


def measure(folder, speed):
    """Histories over time in ms, and a row of what the end of the run is like."""
    path, shape = read_table(folder / "channel.dat"), read_ave_time(folder / "cell.dat")
    time, lean = path["v_time"] / 1000, leans(shape)
    from_axis = np.hypot(path["v_y"], path["v_z"])
    turned = (np.concatenate([[0], np.cumsum(path["v_turning"][1:] * np.diff(path["v_time"]))]) /
              (2 * np.pi))
    history = {"time": time, "y": path["v_y"], "z": path["v_z"], "from_axis": from_axis,
               "lean": np.linalg.norm(lean, axis=1), "turned": turned}
    last = time > (1 - LAST) * time[-1]
    row = {"cell_speed": 1000 * path["v_u"][last].mean(), "time": time[-1],
           "y": path["v_y"][last].mean(), "z": path["v_z"][last].mean(),
           "from_axis": from_axis[last].mean(),
           "nearest": from_axis[last].min(), "furthest": from_axis[last].max(),
           "lean": history["lean"][last].mean(),
           "turned": turned[-1] - turned[last][0],
           "turns_per_s": 1000 * (turned[-1] - turned[last][0]) / (time[-1] - time[last][0]),
           "deformation": shape.column(7)[last[-len(shape.steps):], 0].mean(),
           "drive": path["v_drive"][last].mean() / duct_drive(speed * 1e-3),
           "mean_held": abs(path["v_mean"][len(time) // 20:] / (speed * 1e-3) - 1).max(),
           "volume": abs(shape.column(6)[:, 0] / shape.column(6)[0, 0] - 1).max(),
           "area": abs(shape.column(5)[:, 0] / shape.column(5)[0, 0] - 1).max()}
    return history, {**row, "shape": verdict(row)}


def empty_channel(arguments):
    """Force density that the empty channel takes over that of the closed form."""
    folder = arguments.folder / "empty"
    arguments.only = arguments.only and [*arguments.only, folder.name]
    example_study.run_once(arguments, SCRIPT, folder, {"cells": 0, "speed": 1})
    lines = [line.split()
             for line in (folder / "log.lammps").read_text(encoding="utf-8").splitlines()]
    start = next(n for n, words in enumerate(lines) if words[:1] == ["Step"])
    return float(lines[start + 1][lines[start].index("v_drive")]) / duct_drive(1e-3)


def picture(surface, view):
    """A cell seen along the height (view "top") or the width ("side")."""
    png = surface[:-4] + f"-{view}.png"
    angles = {"top": ("0", "89.9"), "side": ("0", "0")}[view]
    subprocess.run([sys.executable, HERE.parents[1] / "scripts" / "render_cells.py", surface, "-o",
                    png, "--view", *angles, "--parallel", "--size", "360x300"], check=True)
    return png


def draw(histories, rows, folder, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    speeds = [speed for speed in SPEEDS if any(name.startswith(f"{speed:g}-") for name in rows)]
    figure = plt.figure(figsize=(13, 11), layout="constrained")
    grid = figure.add_gridspec(5, len(speeds), height_ratios=(3, 1.3, 1.3, 1.3, 1.3))
    upper = grid[0, :].subgridspec(1, 3)
    panels = [figure.add_subplot(upper[0, column]) for column in range(3)]
    for name, history in histories.items():
        speed, *start = name.split("-")
        style = {"color": COLORS[float(speed)], "ls": LINES[start[0]],
                 "lw": 1.6 if "fine" in start else 0.8}
        travel = history["time"] * float(speed) / 1000    # mm
        label = f"{rows[name]['cell_speed']:.1f} mm/s, {', '.join(start)}"
        for panel, series in zip(panels, ("from_axis", "lean", "turned")):
            panel.plot(travel, history[series], label=label, **style)
    for panel, text in zip(panels, ("distance from the axis / µm", "lean",
                                    "turns of the membrane about z")):
        panel.set(xlabel="mean velocity × time / mm", ylabel=text, xlim=(0, None))
    panels[0].set(ylim=(0, 3.8))
    panels[0].legend(frameon=False, fontsize=6, ncols=3, loc="upper right", columnspacing=1)
    for column, speed in enumerate(speeds):
        for row, (start, view) in enumerate((start, view) for start in STARTS
                                            for view in ("top", "side")):
            panel, name = figure.add_subplot(grid[1 + row, column]), f"{speed:g}-{start}"
            panel.axis("off")
            if name not in rows:
                continue
            panel.imshow(plt.imread(picture(surfaces(folder / name)[-1][1], view)))
            words = (f"{rows[name]['cell_speed']:.2f} mm/s, {start}: {rows[name]['shape']}"
                     if view == "top" else "seen along y")
            panel.set_title(words, fontsize=8)
    figure.savefig(path, dpi=85)


def write(rows, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", *next(iter(rows.values()))])
        for name, row in rows.items():
            writer.writerow([name, *(value if isinstance(value, str) else f"{value:.4g}"
                                     for value in row.values())])


def report(rows):
    print("\nspeed of the cell, start; shape; distance from the axis in the mean, least, largest; "
          "lean; turns of the membrane")
    for name, row in rows.items():
        distances = f"{row['from_axis']:.2f} ({row['nearest']:.2f} to {row['furthest']:.2f})"
        print(f"| {row['cell_speed']:.2f} | {', '.join(name.split('-')[1:])} | {row['shape']} | "
              f"{distances} | {row['lean']:.2f} | {row['turns_per_s']:.1f} |")


def main():
    parser = example_study.options(__doc__, CASES)
    example_study.add_runs_folder(parser)
    arguments = command_line.parse(parser, HERE)
    arguments.folder = example_study.runs_folder(arguments)
    histories, rows = {}, {}
    for name, variables in CASES.items():
        if example_study.run_once(arguments, SCRIPT, arguments.folder / name, variables):
            histories[name], rows[name] = measure(arguments.folder / name, variables["speed"])
            print(name, {key: value if isinstance(value, str) else float(f"{value:.4g}")
                         for key, value in rows[name].items()}, flush=True)
    report(rows)
    print(f"\nempty channel: force density {empty_channel(arguments):.4f} of the closed form's")
    write(rows, arguments.output / "capillary.csv")
    draw(histories, rows, arguments.folder, arguments.output / "capillary.png")


if __name__ == "__main__":
    main()
