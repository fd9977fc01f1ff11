#!/usr/bin/python3
"""Turning of a cell near the wall of a tube and of one near its axis, as Figure 5 of the paper, and
a picture as Figure 4.

Runs in.tube-poiseuille in a folder for each case, unless it is there, and writes a table with a row
per cell and a picture: tube-poiseuille.csv and .png of cells whose inside is as viscous as plasma,
inside.csv and .png of such as have one five times as viscous. Prints the README's table of both.

study.py --output FOLDER [--folder runs] [--lmp ../../build/lmp_rbc] [--only tube-poiseuille]
"""
import csv
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from rbc.tables import read_ave_time  # noqa: E402
from rbc.snapshots import surfaces  # noqa: E402
from rbc.surfaces import read_cells  # noqa: E402

RADIUS, DX, SPEED = 11.25, 0.6, 187.5e-6      # of in.tube-poiseuille
DISC = 7.82                                   # diameter D of a cell at rest, um
WALL, AXIS = "#2a6fb0", "#3d9141"             # the paper's colors of the two cells
CASES = {"tube-poiseuille": {}, "inside": {"inside": 7.4825}}    # variables of in.tube-poiseuille
WORDS = {"tube-poiseuille": "inside as viscous as plasma", "inside": "inside five times as viscous"}
OUTER = 7.5                                   # distance of outer cells from the axis, um
START = 2.0                                   # time * mean velocity / D from which means are taken


class Cells:
    """Histories [frame, cell] of a run: time, distance from the axis, deformation, velocity,
    angles."""

    def __init__(self, folder):
        table = np.loadtxt(
            (folder / "tube.dat").read_text(encoding="utf-8").rpartition("\n")[0].splitlines())
        history = read_ave_time(folder / "cell.dat")
        frames = min(len(table), len(history.steps))
        self.steps = history.steps[:frames]
        self.time, self.relative, self.gap = (table[:frames, 1] * 1e-3, table[:frames, 3],
                                              table[:frames, 4])
        axis = DX * np.ceil(2 * RADIUS / DX + 7) / 2
        across = history.columns(3, 4)[:frames] - axis
        self.r = np.linalg.norm(across, axis=2)
        self.volume, self.deformation = history.column(6)[:frames], history.column(7)[:frames]
        self.length = 2 * history.column(8)[:frames]
        self.velocity = history.column(17)[:frames]
        long, short = history.columns(11, 13)[:frames], history.columns(14, 16)[:frames]
        self.long_angle = np.degrees(np.arccos(np.minimum(abs(long[..., 0]), 1)))
        self.short = short = with_sense(short)
        self.short_angle = np.degrees(np.arccos(np.clip(short[..., 0], -1, 1)))
        self.turned = in_plane_angle(short, across / self.r[..., None])

    @property
    def periods(self):
        """Time in units of D over the mean velocity."""
        return self.time * 1e3 * SPEED / DISC


def with_sense(axes):
    """The axes [frame, cell] with the sense that each had in the frame before: an axis alone has
    none."""
    flips = np.where(np.einsum("tci,tci->tc", axes[1:], axes[:-1]) < 0, -1, 1)
    return np.concatenate([axes[:1], axes[1:] * np.cumprod(flips, axis=0)[..., None]])


def in_plane_angle(short, outward):
    """Angle, continuous in time, by which a disc is turned in the plane of axis and radius; 0 along
    the wall."""
    radial = np.einsum("tci,tci->tc", short[..., 1:], outward)
    return np.degrees(np.unwrap(np.arctan2(short[..., 0], radial), axis=0))


def membrane_angles(cells, folder):
    """Angles [file, cell] between the disc's normal and the line from one half of the membrane to
    the other.

    The halves are those on either side of the disc at rest. 0 as long as the cell turns as a rigid
    body, up to 90 where the membrane runs around it.
    """
    sides, angles = None, []
    for step, name in surfaces(folder):
        frame = np.flatnonzero(cells.steps == step)
        if frame.size == 0:
            continue
        centred = [points - points.mean(axis=0) for points, _ in read_cells(name)]
        normals = cells.short[frame[0]]
        if sides is None:
            sides = [np.sign(points @ normal) for points, normal in zip(centred, normals)]
        lines = np.array([side @ points for side, points in zip(sides, centred)])
        lines /= np.linalg.norm(lines, axis=1)[:, None]
        angles.append(
            np.degrees(np.arccos(np.minimum(abs(np.einsum("ci,ci->c", lines, normals)), 1))))
    return np.array(angles)


def measure(cells, membrane):
    """A row per cell, and the the cells nearest to the wall and to the axis on average."""
    late = cells.periods >= min(START, cells.periods[-1] / 2)
    span = cells.time[late][-1] - cells.time[late][0]
    rows = []
    for n in range(cells.r.shape[1]):
        half_turns = (cells.turned[late][-1, n] - cells.turned[late][0, n]) / 180
        rows.append({"cell": n + 1, "radius": cells.r[late, n].mean(),
                     "velocity": 1e6 * cells.velocity[late, n].mean(),
                     "length": cells.length[late, n].mean(), "longest": cells.length[late, n].max(),
                     "deformation": cells.deformation[late, n].mean(),
                     "half_turns_per_s": 1e3 * half_turns / span,
                     "long_axis_angle": cells.long_angle[late, n].mean(),
                     "long_axis_angle_sd": cells.long_angle[late, n].std(),
                     "membrane_angle": membrane[:, n].max()})
    mean_radius = np.array([row["radius"] for row in rows])
    return rows, int(mean_radius.argmax()), int(mean_radius.argmin())


def snapshot(surface, wall, axis, path):
    """The cells seen from the side, flow to the right; the two cells in their colors, the others
    pale."""
    import matplotlib.colors
    from rbc.actors import read_surface, refine, surface_actor
    from rbc.display import display
    from rbc.rendering import (
        add_renderer, aim, ambient_occlusion, light, save, vtkRenderWindow)
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    cells = refine(read_surface(str(surface)), 1)
    molecules = np.round(vtk_to_numpy(cells.GetPointData().GetArray("molecule"))).astype(int)
    colors = np.tile(np.uint8([222, 120, 110]), (len(molecules), 1))
    for number, color in ((wall + 1, WALL), (axis + 1, AXIS)):
        colors[molecules == number] = np.round(255 * np.array(matplotlib.colors.to_rgb(color)))
    scalars = numpy_to_vtk(colors, deep=True)
    cells.GetPointData().SetScalars(scalars)
    actor, _ = surface_actor(cells, None, None)
    actor.GetMapper().ScalarVisibilityOn()
    bounds = np.array(cells.GetBounds())
    with display():
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(1800, 1300)
        renderer = add_renderer(window, 0, 1)
        renderer.AddActor(actor)
        light(renderer)
        aim(renderer, bounds, 15, 20, False, 1.0)
        ambient_occlusion(renderer, bounds)
        window.Render()
        save(window, str(path))
        window.Finalize()


def draw(cells, rows, wall, axis, picture, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, panels = plt.subplot_mosaic([["angle", "picture"], ["turned", "radial"]],
                                        figsize=(12.5, 8), layout="constrained")
    for n, color, name in ((wall, WALL, "near the wall"), (axis, AXIS, "near the axis")):
        label = f"{name}, r = {rows[n]['radius']:.1f} µm"
        panels["angle"].plot(cells.periods, cells.short_angle[:, n], color=color, label=label)
    panels["angle"].set(ylabel="normal of the disc to the tube's axis (degrees)", ylim=(0, 180),
                        yticks=range(0, 181, 30))
    outermost = sorted(range(len(rows)), key=lambda n: -rows[n]["radius"])[:4]
    for n, color in zip(outermost, (WALL, "#e07b39", "#8e5ea2", "0.5")):
        panels["turned"].plot(cells.periods, cells.turned[:, n] - cells.turned[0, n], color=color,
                              label=f"r = {rows[n]['radius']:.1f} µm")
    panels["turned"].set(ylabel="turned in the plane of axis and radius (degrees)")
    for name in ("angle", "turned"):
        panels[name].set(xlabel="time × mean velocity / D", xlim=(0, cells.periods[-1]))
        panels[name].legend(frameon=False, fontsize=8)
    panels["picture"].imshow(plt.imread(picture))
    panels["picture"].axis("off")
    panels["picture"].set_title("blue: near the wall, green: near the axis", fontsize=10)
    radius = np.array([row["radius"] for row in rows])
    panel = panels["radial"]
    panel.plot(radius, [row["velocity"] for row in rows], "o", color="#b3202a", label="velocity")
    fine = np.linspace(0, RADIUS, 100)
    panel.plot(fine, 2e6 * SPEED * (1 - (fine / RADIUS)**2), color="0.6", lw=1,
               label="plasma alone")
    panel.set(xlabel="distance of the centre from the axis / µm",
              ylabel="velocity of a cell / (µm/s)", ylim=(0, None),
              xlim=(0, RADIUS))
    right = panel.twinx()
    right.plot(radius, [row["length"] for row in rows], "s", mfc="none", color="k", label="length")
    right.set(ylabel="length of a cell / µm")
    panel.legend(*(sum(pair, []) for pair in zip(panel.get_legend_handles_labels(),
                                                 right.get_legend_handles_labels())),
                 frameon=False, fontsize=8, loc="lower left")
    figure.savefig(path, dpi=85)


def write(rows, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows([f"{value:.4g}" for value in row.values()] for row in rows)


def summary(cells, rows):
    """What the README's table compares, of a run: text by name."""
    late = cells.periods >= min(START, cells.periods[-1] / 2)
    rates = {row["radius"]: row["velocity"] for row in rows}
    outer = [row for row in rows if row["radius"] > OUTER]
    inner = [row for row in rows if row["radius"] <= OUTER]
    axis = [rates[r] for r in sorted(rates)[:2]]
    turned = abs(cells.turned - cells.turned[0]).max(axis=0)
    outermost = sorted(range(len(rows)), key=lambda n: -rows[n]["radius"])[:4]

    def span(values, form):
        return f"{min(values):{form}} to {max(values):{form}}"

    return {f"velocity beyond {OUTER} µm, µm/s": span([row["velocity"] for row in outer], ".0f"),
            "next to the axis": span(axis, ".0f"),
            f"length beyond {OUTER} µm, µm": span([row["length"] for row in outer], ".1f"),
            "within": span([row["length"] for row in inner], ".1f"),
            "cells that turn by a quarter or more": f"{(turned >= 90).sum()} of {len(rows)}",
            "the four outermost turn by": span(turned[outermost], ".0f") + "°",
            "the membrane goes around them by":
                span([rows[n]["membrane_angle"] for n in outermost], ".0f") + "°",
            "viscosity over that of plasma": f"{cells.relative[late].mean():.3f}",
            "in the last 0.1 s": f"{cells.relative[cells.time >= cells.time[-1] - 100].mean():.3f}",
            "nearest vertex to the wall, µm": f"{cells.gap.min():.2f}",
            "volumes within": f"{abs(cells.volume / cells.volume[0] - 1).max():.1e}"}


def print_table(summaries):
    print("| |", *(f"{WORDS[name]} |" for name in summaries))
    print("|---|" + "---|" * len(summaries))
    for line in next(iter(summaries.values()), ()):
        print(f"| {line} |", *(f"{texts[line]} |" for texts in summaries.values()))


def main():
    parser = example_study.options(__doc__, CASES)
    example_study.add_runs_folder(parser)
    arguments = command_line.parse(parser, HERE)
    summaries = {}
    for name, variables in CASES.items():
        folder = example_study.runs_folder(arguments) / name
        if not example_study.run_once(arguments, HERE / "in.tube-poiseuille", folder, variables):
            continue
        cells = Cells(folder)
        rows, wall, axis = measure(cells, membrane_angles(cells, folder))
        for row in rows:
            print({key: float(f"{value:.4g}") for key, value in row.items()})
        write(rows, arguments.output / f"{name}.csv")
        picture = folder / "last.png"
        snapshot(surfaces(folder)[-1][1], wall, axis, picture)
        draw(cells, rows, wall, axis, picture, arguments.output / f"{name}.png")
        summaries[name] = summary(cells, rows)
    print_table(summaries)


if __name__ == "__main__":
    main()
