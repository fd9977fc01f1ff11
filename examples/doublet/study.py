#!/usr/bin/python3
"""Shape of a pair of adhered red cells against the work of adhesion.

Runs in.doublet (about half a minute each on one core), writes doublet.csv and shapes.csv to a
folder, and draws doublet.png there. With --draw only the picture, from these tables, or where there
are none from those of the repository.

study.py --output FOLDER [--draw]
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = str(ROOT / "scripts"), str(ROOT / "potentials")
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from molecule_file import read_molecule    # noqa: E402

SIGMAS = 5e-5, 1e-4, 1.5e-4, 2e-4, 3e-4, 5e-4, 1e-3, 2e-3, 5e-3
DRAWN = 1e-4, 2e-4, 3e-4, 5e-4, 1e-3, 5e-3


def last_frame(path):
    """Columns mol xu yu zu c_adhesion of the last frame."""
    lines = Path(path).read_text(encoding="utf-8").split("ITEM: ATOMS")[-1].splitlines()[1:]
    return np.array([line.split()[1:] for line in lines], dtype=float)


def contact_zone(x, cell, in_contact):
    """Centre of the vertices in contact, direction along which they bend most, normal of their
    plane (from cell 1 to 2), and the amplitude A of z = A sin(pi s / s_max) + B s, their height
    above the plane fitted along that direction."""
    points = x[in_contact]
    centre = points.mean(axis=0)
    directions = np.linalg.svd(points - centre, full_matrices=False)[2]
    normal = directions[2] * np.sign(
        directions[2] @ (x[cell == 2].mean(axis=0) - x[cell == 1].mean(axis=0)))
    z = (points - centre) @ normal
    best = 0, directions[0]
    for angle in np.radians(range(0, 180, 3)):
        along = np.cos(angle) * directions[0] + np.sin(angle) * directions[1]
        s = (points - centre) @ along
        basis = np.stack([np.sin(np.pi * s / abs(s).max()), s], axis=1)
        amplitude = abs(np.linalg.lstsq(basis, z, rcond=None)[0][0])
        best = max(best, (amplitude, along), key=lambda candidate: candidate[0])
    return centre, best[1], normal, best[0]


def section(x, triangles, centre, along, normal):
    """Segments in which the plane through the centre with these two directions cuts the triangles,
    in its coordinates."""
    across = np.cross(along, normal)
    height = (x - centre) @ across
    flat = np.stack([(x - centre) @ along, (x - centre) @ normal], axis=1)
    segments = []
    for triangle in triangles:
        ends = []
        for u, v in zip(triangle, np.roll(triangle, -1)):
            if height[u] * height[v] < 0:
                ends.append(flat[u] + height[u] / (height[u] - height[v]) * (flat[v] - flat[u]))
        if len(ends) == 2:
            segments.append(np.concatenate(ends))
    return segments


def measure(lmp, shape, sigma):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([lmp, "-in", HERE / "in.doublet", "-log", "none", "-screen", "none", "-var",
                        "sigma", str(sigma),
                        "-var", "shape", shape, "-var", "templates", ROOT / "potentials"],
                       cwd=folder, check=True)
        row = np.loadtxt(Path(folder) / "doublet.dat")
        atoms = last_frame(Path(folder) / "doublet.dump")
    x, in_contact = atoms[:, 1:4], atoms[:, 4] != 0
    _, triangles = read_molecule(ROOT / "potentials" / f"{shape}.mol")
    centre, along, normal, amplitude = contact_zone(x, atoms[:, 0], in_contact)
    segments = []
    for cell in (1, 2):
        own = x[atoms[:, 0] == cell]
        segments += [(sigma, cell, *ends)
                     for ends in section(own, triangles, centre, along, normal)]
    return [*row, amplitude], segments


def draw(table, segments, path):
    figure = plt.figure(figsize=(11, 6.4))
    grid = figure.add_gridspec(2, len(DRAWN), height_ratios=(1, 1.7))
    for n, sigma in enumerate(DRAWN):
        axis = figure.add_subplot(grid[0, n])
        for s, cell, x0, z0, x1, z1 in segments:
            if abs(s / sigma - 1) < 1e-6:
                axis.plot([x0, x1], [z0, z1], color="C3" if cell == 1 else "C0", lw=1.4)
        axis.set_aspect("equal")
        axis.set_xlim(-4.8, 4.8)
        axis.set_ylim(-4, 4)
        axis.axis("off")
        axis.set_title(f"{1e3 * sigma:g} µJ/m²", fontsize=10)
    sigma, area, adhesion, membrane, _, amplitude = np.array(table, dtype=float).T
    left = figure.add_subplot(grid[1, :3])
    left.semilogx(1e3 * sigma, area, "o-", label="area in contact / µm²")
    left.semilogx(1e3 * sigma, -adhesion / sigma, "s--", label="energy of adhesion over σ / µm²")
    right = figure.add_subplot(grid[1, 3:])
    right.semilogx(1e3 * sigma, amplitude, "o-C2", label="amplitude of the S / µm")
    right.semilogx(1e3 * sigma, membrane / -adhesion, "s--C4",
                   label="energy of the membranes over that of adhesion")
    for axis in (left, right):
        axis.set_xlabel("work of adhesion σ / (µJ/m²)")
        axis.set_ylim(bottom=0)
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def read(path):
    with open(path, encoding="utf-8") as stream:
        return [[float(word) for word in row] for row in list(csv.reader(stream))[1:]]


def write(path, head, rows):
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(head + "\n")
        stream.writelines(",".join(f"{value:.6g}" for value in row) + "\n" for row in rows)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--lmp", type=Path, default=ROOT / "build" / "lmp_rbc")
    parser.add_argument("--shape", default="rbc_642")
    parser.add_argument("--draw", action="store_true", help="do not run")
    options = command_line.parse(parser, HERE)
    if not options.draw:
        table, segments = [], []
        for sigma in SIGMAS:
            row, cut = measure(options.lmp.resolve(), options.shape, sigma)
            print(f"sigma {sigma:g}: contact {row[1]:.2f} um^2, amplitude of the S {row[5]:.3f} "
                  f"um, speed {row[4]:.2g}", flush=True)
            table.append(row)
            segments += cut if sigma in DRAWN else []
        write(options.output / "doublet.csv",
              "sigma,contact_area,adhesion_energy,membrane_energy,speed,amplitude", table)
        write(options.output / "shapes.csv", "sigma,cell,x0,z0,x1,z1", segments)
    tables = (read(command_line.kept(options.output, HERE, name))
              for name in ("doublet.csv", "shapes.csv"))
    draw(*tables, options.output / "doublet.png")


if __name__ == "__main__":
    main()
