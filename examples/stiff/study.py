#!/usr/bin/python3
"""A cell a thousand times as stiff as a healthy one: how it turns, and what its stiffness costs
each integrator.

Runs in.stiff for a list of cases, measures the period of its tumbling against Jeffery's, writes
stiff.csv to a folder and once it has all cases draws stiff.png there. Cases that its stiff.csv
already holds are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only step rate]
"""

import csv
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "scripts"))
import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from example_study import POTENTIALS, options, run_script, wanted  # noqa: E402
from snapshots import picture, surfaces  # noqa: E402

BASE = dict(rate=100, strain=13, timestep=1000, integrator="rkc auto", error=0, shape="rbc_642", dx=0.5, box=24)
ASPECT = 2.565 / 7.82    # thickness over diameter of the disc, and the axis ratio of the spheroid
COLUMNS = ("sheared", "area", "volume", "D", "axis_x", "axis_z", "solves", "stages", "step", "repeated")
FIELDS = ("series", *BASE, "ended", "period", "D_low", "D_high", "area_change", "volume_error", "solves_per_ms", "stages",
          "mean_step")


def cases():
    """(name of the series, variables) of every run."""
    for timestep in (89, 200, 400, 1000):
        yield "step", dict(BASE, timestep=timestep)
    yield "third order", dict(BASE, integrator="rkc auto order 3")
    for rate, timestep in ((60, 1667), (10, 10000)):
        yield "rate", dict(BASE, rate=rate, timestep=timestep)
    for error in (1e-2, 1e-3, 1e-4):
        yield "adapt", dict(BASE, error=error)
    for dx in (1.0, 0.6667, 0.4):
        yield "dx", dict(BASE, dx=dx)
    for dx in (1.0, 0.6667, 0.5, 0.4):
        yield "spheroid", dict(BASE, shape="spheroid_642", dx=dx)
    for box in (16, 20, 32):
        yield "box", dict(BASE, shape="spheroid_642", box=box)
    for dx in (0.6667, 0.4):
        yield "small box", dict(BASE, shape="spheroid_642", dx=dx, box=16)
    for vertices in (162, 362):
        yield "mesh", dict(BASE, shape=f"spheroid_{vertices}")
    for integrator in ("euler", "midpoint", "ab2"):
        for timestep in (0.4, 0.8, 1.2, 1.6, 2.0):
            yield "explicit", dict(BASE, integrator=integrator, timestep=timestep, strain=round(1e-4 * 4000 * timestep, 6))


def jeffery_period(aspect):
    """Strain in which a spheroid turns once (Jeffery, Proc. R. Soc. A 102 (1922) 161)."""
    return 2 * np.pi * (aspect + 1 / aspect)


def jeffery_angle(strain, aspect, start):
    """Angle of the axis from the gradient, in the plane of shear, turning towards the flow."""
    at = np.arctan(np.tan(start) / aspect) + 2 * np.pi * strain / jeffery_period(aspect)
    turns = np.round(at / np.pi)
    return np.arctan(np.tan(at - np.pi * turns) * aspect) + np.pi * turns


def axis_angle(history):
    """Accumulated angle of the cell's short axis from the gradient."""
    angle = np.arctan2(history["axis_x"], history["axis_z"])
    return 0.5 * np.unwrap(2 * angle)


def half_turns(history):
    """Strains in which the axis turns by 180 degrees, from all starts that leave room for it."""
    angle, strain = axis_angle(history), history["sheared"]
    starts = angle < angle[-1] - np.pi
    return np.interp(angle[starts] + np.pi, angle, strain) - strain[starts]


def measure(folder):
    """The columns of cell.dat, by name."""
    data = np.loadtxt(os.path.join(folder, "cell.dat"))
    return dict(zip(COLUMNS, data.T[1:]))


def start(arguments, folder, variables):
    """Runs in.stiff; returns whether it came to its end."""
    shape, _, vertices = variables["shape"].partition("_")
    if shape == "spheroid":
        frequency = round(((int(vertices) - 2) / 10)**0.5)
        subprocess.run([sys.executable, os.path.join(POTENTIALS, "make_template.py"), "spheroid", "--axis-ratio", f"{ASPECT:.6f}",
                        "--diameter", "7.82", "--frequency", str(frequency), "--output", os.path.join(folder, f"{variables['shape']}.mol")],
                       check=True, stdout=subprocess.DEVNULL)
    for name in os.listdir(POTENTIALS):
        if name.endswith((".mol", ".material")):
            os.symlink(os.path.join(POTENTIALS, name), os.path.join(folder, name))
    return run_script(arguments, os.path.join(HERE, "in.stiff"), folder, variables, templates=folder).returncode == 0


def run(arguments, series, variables):
    """A row of the table."""
    with tempfile.TemporaryDirectory() as folder:
        ended = start(arguments, folder, variables)
        row = dict(variables, series=series, ended="yes" if ended else "no")
        if not ended:
            return row
        history = measure(folder)
        strain = history["sheared"]
        late = strain >= min(2.0, strain[-1] / 2)
        duration = (strain[-1] - strain[0]) / variables["rate"] * 1e3    # ms
        solves = history["solves"][-1] - history["solves"][0]
        row.update(D_low=history["D"][late].min(), D_high=history["D"][late].max(),
                   area_change=abs(history["area"] / history["area"][0] - 1).max(),
                   volume_error=abs(history["volume"] / history["volume"][0] - 1).max(),
                   solves_per_ms=solves / duration, stages=history["stages"][late].mean(),
                   mean_step=history["step"][1:].mean() if variables["error"] else variables["timestep"])
        if series != "explicit":
            row["period"] = 2 * half_turns(history).mean()
        return row


def text(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def write(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, FIELDS, restval="")
        writer.writeheader()
        for row in rows:
            writer.writerow({name: text(value) for name, value in row.items()})


def read(path):
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def snapshots(folder, strains):
    steps, files = zip(*surfaces(folder))
    at = np.array(steps) / steps[-1] * BASE["strain"]
    for strain in strains:
        n = abs(at - strain).argmin()
        yield at[n], picture(files[n], BASE["box"])


def draw(arguments, rows):
    figure = plt.figure(figsize=(12, 6))
    grid = figure.add_gridspec(2, 10, height_ratios=(1.7, 1))
    turning, cost = figure.add_subplot(grid[0, :5]), figure.add_subplot(grid[0, 5:])
    with tempfile.TemporaryDirectory() as folder:
        start(arguments, folder, dict(BASE, timestep=400))
        history = measure(folder)
        angle = axis_angle(history)
        turning.plot(history["sheared"], np.degrees(angle), color="#b3202a", label="cell, 1000 times healthy")
        strain = np.linspace(0, BASE["strain"], 300)
        for aspect, style in ((ASPECT, "--"), (best_aspect(history), ":")):
            turning.plot(strain, np.degrees(jeffery_angle(strain, aspect, angle[0])), style, color="#222222",
                         label=f"Jeffery, aspect ratio {aspect:.3f}")
        turning.set(xlabel="strain (shear rate × time)", ylabel="angle of the axis to the gradient / degrees",
                    title="a cell with the moduli of Table 2 as printed, 100 /s")
        turning.legend(frameon=False)
        for n, (at, image) in enumerate(snapshots(folder, np.linspace(0, BASE["strain"], 5))):
            panel = figure.add_subplot(grid[1, 2 * n:2 * n + 2])
            panel.imshow(image)
            panel.set_axis_off()
            panel.set_title(f"strain {at:.1f}", fontsize=10)
    for series, style, label in (("step", "o-", "rkc auto"), ("adapt", "s", "rkc auto, adapt"),
                                 ("explicit", "^", "euler, midpoint, ab2: stable")):
        points = sorted((float(row["mean_step"]), float(row["solves_per_ms"])) for row in rows
                        if row["series"] == series and row["ended"] == "yes")
        cost.loglog(*zip(*points), style, label=label)
    cost.axvline(89, color="#999999", linewidth=0.8)
    cost.text(95, cost.get_ylim()[1] / 2, "the paper's step", color="#666666", fontsize=9)
    cost.set(xlabel="timestep / µs", ylabel="solves per physical ms")
    cost.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(arguments.output / "stiff.png", dpi=90)


def best_aspect(history):
    """Of the spheroid with the period of the cell."""
    half = half_turns(history).mean() / np.pi    # aspect + 1 / aspect
    return half / 2 - np.sqrt(half**2 / 4 - 1)


def main():
    arguments = command_line.parse(options(__doc__, (series for series, _ in cases())), HERE)
    path = arguments.output / "stiff.csv"

    rows = read(path)
    known = {(row["series"], *(row[name] for name in BASE)) for row in rows}
    missing = False
    for series, variables in cases():
        if (series, *(text(variables[name]) for name in BASE)) in known:
            continue
        if not wanted(arguments, series):
            missing = True
            continue
        print(series, variables, flush=True)
        rows.append(run(arguments, series, variables))
        write(path, rows)
    if not missing:
        draw(arguments, rows)
    print(f"Jeffery's period for an aspect ratio of {ASPECT:.4f}: {jeffery_period(ASPECT):.2f}")


if __name__ == "__main__":
    main()
