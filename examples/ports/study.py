#!/usr/bin/python3
"""Flow in a tube between two ports against Poiseuille's law: over resolution, kernel and length.

Runs in.ports for a list of cases and writes ports.csv and ports.png to a folder. Cases that its
ports.csv already holds are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--only resolution]
"""
import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402

DIAMETER, LENGTH, FLOW, VISCOSITY = 16.0, 64.0, 0.04, 1.2    # of in.ports
KERNELS = {"peskin4": "#2a6fb0", "roma3": "#b3202a"}
OFFSETS = {"peskin4": 0.381, "roma3": 0.266}                  # of walls with sheets no, in dx
COLUMNS = ("cells", "length", "profile", "gradient", "port", "entered", "halfway", "solves")
GRADIENT = 128 * VISCOSITY * FLOW / (np.pi * DIAMETER**4)


def cases():
    """(name of the series, label, variables) of every run."""
    for kernel in KERNELS:
        for dx in (1.6, 0.8, 0.4):
            yield "resolution", f"{kernel} dx {dx:g}", dict(kernel=kernel, dx=dx)
    for kernel in KERNELS:
        for length in (128, 256):
            yield "length", f"{kernel} length {length}", dict(kernel=kernel, length=length)
    for kernel, behind in OFFSETS.items():
        for length in (64, 128, 256):
            yield ("points", f"{kernel} points {length}",
                   dict(kernel=kernel, length=length, sheets="no", behind=behind))
    for kernel in KERNELS:
        for apart in (1.0, 1.4):
            yield ("spacing", f"{kernel} atoms {apart:g} dx",
                   dict(kernel=kernel, length=128, apart=apart))


class Grid:
    """Velocity along x and pressure of a dump, as [z, y, x], and where the cells are."""

    def __init__(self, path):
        text = path.read_text(encoding="utf-8")
        size = [int(n) for n in re.search(r"GRID SIZE.*\n(.*)", text).group(1).split()]
        sides = [float(line.split()[1])
                 for line in re.search(r"BOX BOUNDS.*\n(.*\n.*\n.*)", text).group(1).splitlines()]
        data = np.array(text.split("ITEM: GRID CELLS")[1].split("\n", 1)[1].split(), float)
        self.u, self.p = np.moveaxis(data.reshape(*size[::-1], 2), -1, 0)
        self.h = np.array(sides) / size
        x, y, z = ((np.arange(n) + 0.5) * h for n, h in zip(size, self.h))
        self.x = x
        self.r = np.hypot(y[None, :] - sides[1] / 2, z[:, None] - sides[2] / 2)

    def flow(self, within):
        """Through each section, of the cells within a radius."""
        return self.u[self.r < within].sum(axis=0) * self.h[1] * self.h[2]


def run(arguments, variables):
    with tempfile.TemporaryDirectory() as folder:
        done = example_study.run_script(arguments, HERE / "in.ports", folder, variables)
        done.check_returncode()
        grid = Grid(Path(folder) / "flow.grid")
    row = re.search(r"\n +Step .*\n(.*)", done.stdout).group(1).split()
    length = variables.get("length", LENGTH)
    port = (float(row[2]) / GRADIENT - (length - 2 * DIAMETER)) / (2 * DIAMETER)
    profile, gradient, *flows = measure(grid, variables.get("dx", 0.8), length,
                                        variables.get("sheets", "yes"))
    return [(DIAMETER / variables.get("dx", 0.8), length / DIAMETER, profile, gradient, port,
             *flows, float(row[7]))]


def measure(grid, dx, length, sheets="yes"):
    """Errors relative to Poiseuille flow of the given rate: of the profile halfway, relative to its
    maximum, of the pressure gradient between the ports, and of the flow a quarter of a diameter
    behind the port and halfway."""
    x = grid.x - 4 * dx
    # a diameter from the ports
    middle = np.abs(x - length / 2) <= max(length / 2 - 2 * DIAMETER, dx)
    fastest = 8 * FLOW / (np.pi * DIAMETER**2)
    exact = fastest * (1 - (2 * grid.r / DIAMETER)**2)
    core = grid.r < DIAMETER / 2 - 2 * dx    # the kernel blurs the rest
    profile = np.abs(grid.u[:, :, middle] - exact[:, :, None])[core].max() / fastest
    pressure = grid.p[grid.r < DIAMETER / 4].mean(axis=0)
    between = np.abs(x - length / 2) < length / 2 - 1.25 * DIAMETER
    gradient = np.polyfit(x[between], pressure[between], 1)[0] / -GRADIENT - 1
    blurred = 1.5 * dx if sheets == "yes" else 0    # behind a wall of points the fluid flows back
    flow = grid.flow(DIAMETER / 2 + blurred) / FLOW - 1
    return profile, gradient, *np.interp([1.25 * DIAMETER, length / 2], x, flow)


def report(table):
    print("                     cells  length  profile  gradient     port  behind it  halfway  "
          "solves")
    for label, rows in table.items():
        cells, length, profile, gradient, port, entered, halfway, solves = rows[0]
        print(f"{label:20s} {cells:5.0f} {length:5.0f} D {profile:8.2%} {gradient:+9.2%} "
              f"{port:8.3f} {entered:+10.3%} {halfway:+8.3%} {solves:7.0f}")
    for kernel in KERNELS:
        errors = [table[label][0][2] for _, label, _ in cases() if label.startswith(f"{kernel} dx")
                  and label in table]
        if len(errors) == 3:
            orders = np.log2(np.array(errors[:-1]) / errors[1:])
            print(f"{kernel}: order of the profile's error {orders[0]:.2f}, {orders[1]:.2f}")


def plot(table, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8))
    for kernel, color in KERNELS.items():
        rows = np.array(
            [values[0] for label, values in table.items() if label.startswith(f"{kernel} dx")])
        left.loglog(rows[:, 0], 100 * rows[:, 2], "o-", color=color, label=f"{kernel}, profile")
        left.loglog(rows[:, 0], 100 * np.abs(rows[:, 3]), "s--", color=color, mfc="none",
                    label=f"{kernel}, gradient")
        rows = np.array([values[0] for label, values in table.items()
                         if re.match(f"{kernel} (dx 0.8|length)", label)])
        right.plot(rows[:, 1], 100 * rows[:, 3], "o-", color=color, label=f"{kernel}, sheets yes")
        rows = np.array(
            [values[0] for label, values in table.items() if label.startswith(f"{kernel} points")])
        right.plot(rows[:, 1], 100 * rows[:, 3], "s--", color=color, mfc="none",
                   label=f"{kernel}, sheets no")
    cells = np.array([10, 40])
    left.loglog(cells, 8 * (10 / cells)**2, "k:", label="order 2")
    left.set(xlabel="cells of the grid across the tube", ylabel="error, %")
    right.set(xlabel="length / diameter, 20 cells wide", ylabel="error of the pressure gradient, %")
    for axes in (left, right):
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3, which="both")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    arguments = command_line.parse(
        example_study.options(__doc__, [series for series, _, _ in cases()]), HERE)
    table = example_study.run_cases(arguments, arguments.output / "ports.csv", COLUMNS, cases(),
                                    run)
    report(table)
    if arguments.only is None:
        plot(table, arguments.output / "ports.png")


if __name__ == "__main__":
    main()
