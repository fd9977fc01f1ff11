#!/usr/bin/python3
"""A cell a thousand times as stiff as a healthy one: how it turns, and what its stiffness costs
each integrator. Spheroids as stiff turn against Jeffery's period, over grid, mesh and box.

Runs in.stiff for a list of cases, measures the period of the tumbling, writes stiff.csv to a folder
and once it has all cases draws stiff.png there. Cases that its stiff.csv already holds are not run
again. Prints the periods of spheroids, over Jeffery's, in the smallest box and in an unbounded
fluid.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only step rate]
"""

import csv
import os
import resource
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from example_study import POTENTIALS, options, run_script, wanted  # noqa: E402
from rbc.snapshots import picture, surfaces  # noqa: E402

BASE = dict(rate=100, strain=11.5, timestep=1000, integrator="rkc auto", error=0, shape="rbc_362",
            dx=0.65, box=19.5, kernel="roma3", smooth="yes", place=0,
            stiffer=1)
DIAMETER = 7.82
ASPECT = 2.565 / DIAMETER    # thickness over diameter of the disc, and the axis ratio of a spheroid
# fluid cells per diameter, frequency of the mesh: edges of 0.9 spacings
ACROSS = ((6, 3), (8, 4), (12, 6), (16, 8))
BOXES = (2.5, 4)         # in diameters, to extrapolate
COLUMNS = ("sheared", "area", "volume", "D", "axis_x", "axis_z", "solves", "stages", "step",
           "repeated")
FIELDS = ("series", *BASE, "ended", "period", "ratio", "D_low", "D_high", "area_change",
          "volume_error", "solves_per_ms", "stages", "mean_step", "core_s")


def spheroid(aspect, across, frequency, box, **others):
    """Variables of a spheroid of the disc's diameter that turns by a little more than 180
    degrees."""
    # the box lengthens the period by up to 7 %, rough tractions by 40
    slower = 1.07 if others.get("smooth", "yes") == "yes" else 1.5
    return dict(BASE, strain=round(slower * jeffery_period(aspect) / 2 + 0.3, 1),
                shape=f"spheroid_{aspect:.4g}_{10 * frequency**2 + 2}",
                dx=round(DIAMETER / across, 6), box=round(box * DIAMETER, 6)) | others


def against_jeffery():
    """The same of the runs of spheroids."""
    for across, frequency in ACROSS:
        for box in BOXES:
            yield "spheroid", spheroid(ASPECT, across, frequency, box)
    yield "spheroid", spheroid(ASPECT, 8, 4, 6)
    for aspect in (0.5, 0.9):
        for across, frequency in ACROSS[:3]:
            for box in BOXES:
                yield "aspect", spheroid(aspect, across, frequency, box)
    for across, frequency in ACROSS[:3]:
        for box in BOXES:
            yield "peskin4", spheroid(ASPECT, across, frequency, box, kernel="peskin4")
    for aspect, across, frequency in ((ASPECT, 16, 8), (ASPECT, 12, 5), (ASPECT, 12, 8),
                                      (0.5, 12, 6)):
        yield "peskin4", spheroid(aspect, across, frequency, BOXES[0], kernel="peskin4")
    for across, frequencies in ((8, (3, 5, 6)), (12, (4, 5, 8, 9))):
        for frequency in frequencies:
            yield "edges", spheroid(ASPECT, across, frequency, BOXES[0])
    for across, frequency in ACROSS[:3]:
        yield "rough", spheroid(ASPECT, across, frequency, BOXES[0], smooth="no")
    for stiffer in (1, 10):
        yield "modulus", spheroid(ASPECT, 8, 6, BOXES[0], smooth="no", stiffer=stiffer)
    yield "modulus", spheroid(ASPECT, 8, 6, BOXES[0], stiffer=10)
    for across, frequency, boxes in ((6, 3, BOXES), (12, 6, BOXES[:1])):
        for place in (0.25, 0.5):
            for box in boxes:
                yield "place", spheroid(ASPECT, across, frequency, box, place=place)


def cases():
    """(name of the series, variables) of every run."""
    yield from against_jeffery()
    for timestep in (89, 200, 400, 1000):
        yield "step", dict(BASE, timestep=timestep)
    yield "third order", dict(BASE, integrator="rkc auto order 3")
    for rate, timestep in ((60, 1667), (10, 10000)):
        yield "rate", dict(BASE, rate=rate, timestep=timestep)
    for error in (1e-2, 1e-3, 1e-4):
        yield "adapt", dict(BASE, error=error)
    for across, frequency in ((8, 4), (16, 8)):
        yield "dx", dict(BASE, dx=round(7.8 / across, 6), shape=f"rbc_{10 * frequency**2 + 2}")
    for integrator in ("euler", "midpoint", "ab2"):
        for timestep in (0.1, 0.2, 0.3, 0.4, 0.6):
            yield "explicit", dict(BASE, integrator=integrator, timestep=timestep,
                                   strain=round(1e-4 * 2000 * timestep, 6))


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
    if variables["shape"].startswith("spheroid"):
        _, aspect, vertices = variables["shape"].split("_")
        frequency = round(((int(vertices) - 2) / 10)**0.5)
        subprocess.run([sys.executable, os.path.join(POTENTIALS, "make_template.py"), "spheroid",
                        "--axis-ratio", aspect,
                        "--diameter", str(DIAMETER), "--frequency", str(frequency), "--output",
                        os.path.join(folder, f"{variables['shape']}.mol")],
                       check=True, stdout=subprocess.DEVNULL)
    for name in os.listdir(POTENTIALS):
        if name.endswith((".mol", ".material")):
            os.symlink(os.path.join(POTENTIALS, name), os.path.join(folder, name))
    return run_script(arguments, os.path.join(HERE, "in.stiff"), folder, variables,
                      templates=folder).returncode == 0


def run(arguments, series, variables):
    """A row of the table."""
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        ended = start(arguments, folder, variables)
        row = dict(variables, series=series, ended="yes" if ended else "no",
                   core_s=round(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 1))
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
                   mean_step=history["step"][1:].mean()
                   if variables["error"] else variables["timestep"])
        if series != "explicit":
            row["period"] = 2 * half_turns(history).mean()
            # of the polyhedron, a little thicker than the spheroid on which its vertices lie
            row["ratio"] = (1 - history["D"][0]) / (1 + history["D"][0])
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
    figure = plt.figure(figsize=(15, 6.5))
    grid = figure.add_gridspec(2, 15, height_ratios=(1.7, 1))
    turning, periods, cost = (figure.add_subplot(grid[0, n:n + 5]) for n in (0, 5, 10))
    draw_periods(periods, rows)
    with tempfile.TemporaryDirectory() as folder:
        start(arguments, folder, dict(BASE, timestep=400))
        history = measure(folder)
        angle = axis_angle(history)
        turning.plot(history["sheared"], np.degrees(angle), color="#b3202a",
                     label="cell, 1000 times healthy")
        strain = np.linspace(0, BASE["strain"], 300)
        for aspect, style in ((ASPECT, "--"), (best_aspect(history), ":")):
            turning.plot(strain, np.degrees(jeffery_angle(strain, aspect, angle[0])), style,
                         color="#222222", label=f"Jeffery, aspect ratio {aspect:.3f}")
        turning.set(xlabel="strain (shear rate × time)",
                    ylabel="angle of the axis to the gradient / degrees",
                    title="a cell with the moduli of Table 2 as printed")
        turning.legend(frameon=False)
        for n, (at, image) in enumerate(snapshots(folder, np.linspace(0, BASE["strain"], 5))):
            panel = figure.add_subplot(grid[1, 3 * n:3 * n + 3])
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


def draw_periods(axes, rows):
    found = spheroids(rows)
    styles = {(ASPECT, "roma3"): "o-", (0.5, "roma3"): "s-", (0.9, "roma3"): "^-",
              (ASPECT, "peskin4"): "o--"}
    for (aspect, kernel), style in styles.items():
        points = []
        for across, frequency in ACROSS:
            body = (float(f"{aspect:.4g}"), 10 * frequency**2 + 2, across, kernel, "yes", 0.0, 1.0)
            if len(found.get(body, (0, {}))[1]) > 1:
                points.append(
                    (across, 100 * (unbounded(found[body][1]) / jeffery_period(aspect) - 1)))
        axes.plot(*zip(*points), style, label=f"aspect ratio {aspect:.3g}, {kernel}")
    axes.axhspan(-1, 1, color="#eeeeee")
    axes.set(xlabel="fluid cells per diameter", ylabel="period over Jeffery's - 1 / %",
             title="spheroids as stiff, in an unbounded fluid")
    axes.legend(frameon=False)


def best_aspect(history):
    """Of the spheroid with the period of the cell."""
    half = half_turns(history).mean() / np.pi    # aspect + 1 / aspect
    return half / 2 - np.sqrt(half**2 / 4 - 1)


def spheroids(rows):
    """{(aspect ratio, vertices, fluid cells per diameter, kernel, smooth, place, factor on
    the moduli): ratio of the polyhedron, {box: period}}."""
    found = {}
    for row in rows:
        if row["shape"].startswith("spheroid") and row["period"]:
            _, aspect, vertices = row["shape"].split("_")
            body = (float(aspect), int(vertices), round(DIAMETER / float(row["dx"])), row["kernel"],
                    row["smooth"],
                    float(row["place"]), float(row["stiffer"]))
            found.setdefault(body,
                             (float(row["ratio"]), {}))[1][float(row["box"])] = float(row["period"])
    return found


def unbounded(periods):
    """Of periods in boxes, without plates and images: the constant of a + b / box^3, with three
    boxes + c / box^5."""
    boxes = np.array(list(periods))
    terms = boxes[:, None] ** -np.array([0.0, 3.0, 5.0])[:len(boxes)]
    return np.linalg.solve(terms, list(periods.values()))[0]


def report(rows):
    """Periods of spheroids over Jeffery's."""
    for body, (ratio, periods) in spheroids(rows).items():
        jeffery, smallest = jeffery_period(body[0]), periods[min(periods)]
        line = (
            "{:5} {:4} vertices, {:2} dx, {:8} smooth {:4} place {:4} moduli x {:3}".format(*body) +
            f" in the box {smallest / jeffery:.4f}")
        if len(periods) > 1:
            alone = unbounded(periods)
            line += (f" unbounded {alone / jeffery:.4f}, of ratio {ratio:.4f} "
                     f"{alone / jeffery_period(ratio):.4f}")
        print(line)


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
    report(read(path))


if __name__ == "__main__":
    main()
