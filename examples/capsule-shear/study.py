#!/usr/bin/python3
"""Error of the capsule in shear against grid spacing, vertices, time step, box and run time.

Runs in.capsule-shear for a list of cases, writes study.csv to a folder, and once it has all cases
compares D(t) with the references of examples/reference and draws study.png. Cases that its
study.csv already holds are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--only base] [--ranks 1]
"""

import csv
import os
import re
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
from example_study import options, run_script, wanted  # noqa: E402
from rbc.tables import read_ave_time  # noqa: E402

CAPILLARY = (0.0375, 0.075, 0.15, 0.3, 0.6)
BASE = dict(Ca=0.3, shape="capsule_642", dx=1 / 12, length=8, gap=8, timestep=0.005, strain=5.0,
            kernel="roma3")
COARSE = dict(BASE, dx=1 / 8, strain=2.0)
SLOPE = dict(BASE, Ca=0.01, shape="capsule_2562", timestep=0.0005, strain=0.4)


def cases():
    """(name of the series, variables) of every run."""
    for ca in CAPILLARY:
        yield "base", dict(BASE, Ca=ca)
    for kernel in ("roma3", "peskin4"):
        for dx in (1 / 6, 1 / 8, 1 / 12, 1 / 16):
            yield "slope", dict(SLOPE, dx=dx, kernel=kernel)
    for box in (6, 8, 12, 16):
        yield "slope-box", dict(SLOPE, shape="capsule_642", dx=1 / 6, length=box, gap=box)
    for ca in CAPILLARY:
        for box in (6, 8, 12, 16):
            yield "box", dict(COARSE, Ca=ca, dx=1 / 6, length=box, gap=box)
        for dx in (1 / 4, 1 / 6, 1 / 8, 1 / 12):
            yield "dx", dict(COARSE, Ca=ca, dx=dx)
    for ca in (0.0375, 0.3):
        for dx in (1 / 4, 1 / 6, 1 / 8, 1 / 12):
            yield "dx", dict(COARSE, Ca=ca, dx=dx, kernel="peskin4")
        for vertices in (162, 362, 642, 2562):
            yield "vertices", dict(COARSE, Ca=ca, shape=f"capsule_{vertices}", timestep=0.0025)
    for dt in (0.02, 0.01, 0.005, 0.0025):
        yield "timestep", dict(COARSE, timestep=dt)


def run(arguments, variables):
    """Times (strain), D(t) and the loop time of one run."""
    every = variables["strain"] / 40 if variables["strain"] < 1 else 0.05
    with tempfile.TemporaryDirectory() as folder:
        done = run_script(arguments, os.path.join(HERE, "in.capsule-shear"), folder,
                          dict(variables, every=every))
        done.check_returncode()
        history = read_ave_time(os.path.join(folder, "cell.dat"))
    loop = float(re.search(r"Loop time of (\S+)", done.stdout).group(1))
    return history.steps * variables["timestep"], history.column(7)[:, 0], loop


def references(ca):
    """{source: (t, D)} of the transients at a capillary number on G_s."""
    series = {}
    with open(
            os.path.join(HERE, "..", "reference", "02b_capsule_shear_NH_transient_D.csv")) as file:
        rows = [line.strip() for line in file if not line.startswith("#")]
    for row in rows[1:]:
        ca_e, rest = row.split(",", 1)
        source, t, d = rest.rsplit(",", 2)
        if abs(3 * float(ca_e) - ca) < 1e-9:
            series.setdefault(source, []).append((float(t), float(d)))
    return {source: np.array(points).T for source, points in series.items()}


FIELDS = ["series", *BASE, "loop_seconds", "D_end", "samples"]


def key(series, variables):
    return (series, *(f"{variables[name]:.6g}" if isinstance(variables[name], float)
                      else str(variables[name]) for name in BASE))


def load(path):
    if not os.path.exists(path):
        return {}
    with open(path) as file:
        return {tuple(row[name] for name in ["series", *BASE]): row for row in csv.DictReader(file)}


def samples_of(row):
    """(t, D) as stored in a row of study.csv."""
    return np.array([[float(x) for x in pair.split(":")] for pair in row["samples"].split()]).T


def select(rows, series, **wanted):
    """Rows of a series with the given variables."""
    return [row for row in rows.values() if row["series"] == series and
            all(row[name] == (f"{value:.6g}" if isinstance(value, float) else str(value))
                for name, value in wanted.items())]


def to_zero_dx(points):
    """Limit dx -> 0 of (dx, value): the parabola through the three finest."""
    dx, value = np.array(sorted(points)[:3]).T
    return np.polyfit(dx, value, 2)[-1]


def to_infinite_box(points):
    """Limit of (box, value): periodic images and plates act as 1/box^3; least squares over boxes of
    8 and more."""
    box, value = np.array([point for point in sorted(points) if point[0] >= 8]).T
    return np.polyfit(box**-3.0, value, 1)[-1]


def at(row, time):
    t, d = samples_of(row)
    return np.interp(time, t, d)


def box_factor(rows, ca, time):
    """D in an infinite box over D in the box of the base runs."""
    points = [(float(row["length"]), at(row, time)) for row in select(rows, "box", Ca=ca)]
    return to_infinite_box(points) / dict(points)[8.0]


def dx_factor(rows, ca, time):
    """D at dx -> 0 over D at the spacing of the base runs."""
    points = [(float(row["dx"]), at(row, time))
              for row in select(rows, "dx", Ca=ca, kernel="roma3")]
    return to_zero_dx(points) / at(select(rows, "dx", Ca=ca, kernel="roma3", dx=BASE["dx"])[0],
                                   time)


def report_slopes(rows):
    print("\nSlope D/Ca at Ca = 0.01; theory 25/12 = 2.0833 in an unbounded fluid")
    boxes = [(float(r["length"]), float(r["D_end"])) for r in select(rows, "slope-box")]
    factor = to_infinite_box(boxes) / dict(boxes)[8.0]
    for kernel in ("roma3", "peskin4"):
        runs = select(rows, "slope", kernel=kernel)
        limit = (to_zero_dx([(float(r["dx"]), float(r["D_end"]) / float(r["Ca"])) for r in runs]) *
                 factor)
        finest = min(runs, key=lambda r: float(r["dx"]))
        print(f"  {kernel:<8} finest dx in a box of 8: "
              f"{float(finest['D_end']) / float(finest['Ca']):.4f}; "
              f"dx -> 0, infinite box: {limit:.4f} ({100 * (limit * 12 / 25 - 1):+.1f}%)")


def report_transients(rows):
    for name in ("base runs (dx = 1/12, box 8)", "extrapolated to dx -> 0 and an infinite box"):
        print(f"\nD against the references, {name}")
        print(f"{'Ca':>7} {'source':<28} " + " ".join(f"t={t:<5g}" for t in (0.5, 1.0, 1.5, 5.0)))
        for row in select(rows, "base"):
            ca = float(row["Ca"])
            for source, (times, values) in references(ca).items():
                errors = []
                for time in (0.5, 1.0, 1.5, 5.0):
                    match = np.isclose(times, time)
                    factor = 1.0
                    if name.startswith("extra"):
                        late = min(time, COARSE["strain"])
                        factor = box_factor(rows, ca, late) * dx_factor(rows, ca, late)
                    errors.append(f"{100 * (factor * at(row, time) / values[match][0] - 1):+6.1f}%"
                                  if match.any()
                                  else "      -")
                print(f"{row['Ca']:>7} {source:<28} " + " ".join(errors))


def report(rows):
    """The tables of the README."""
    report_slopes(rows)
    report_transients(rows)
    for series, column in (("dx", "dx"), ("vertices", "shape"), ("timestep", "timestep"),
                           ("box", "length"),
                           ("slope", "dx"), ("slope-box", "length")):
        print(f"\n{series}: D at strain 0.5, 1, 1.5, 2 (or at the end), run time of 1 task")
        for row in select(rows, series):
            t, d = samples_of(row)
            values = " ".join(f"{at(row, x):.5f}"
                              for x in (0.5, 1.0, 1.5, 2.0) if x <= t[-1] + 1e-9)
            print(f"  Ca {row['Ca']:>6} {row['kernel']:<8} {column} {row[column]:<12} "
                  f"{values or row['D_end']}  {float(row['loop_seconds']):6.1f} s")


def plot(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5))
    markers = {"Pozrikidis1995": "s", "Ramanujan&Pozrikidis1998": "o", "Doddi&Bagchi2008": "^",
               "Huet2022(high)": "x"}
    for row in rows.values():
        if row["series"] == "base":
            t, d = samples_of(row)
            line, = left.plot(t, d, label=f"Ca = {row['Ca']}")
            for source, (rt, rd) in references(float(row["Ca"])).items():
                left.plot(rt, rd, markers.get(source, "."), color=line.get_color(), mfc="none",
                          ms=5)
    left.set(xlabel="shear rate × time", ylabel="Taylor deformation D", xlim=(0, 5),
             ylim=(0, 0.75))
    for source, marker in markers.items():
        left.plot([], [], marker, color="0.4", mfc="none", ms=5, label=source)
    left.legend(fontsize=7, ncol=2, loc="upper left")
    for kernel, marker in (("peskin4", "o"), ("roma3", "s")):
        points = [(float(r["dx"]), float(r["D_end"]) / float(r["Ca"])) for r in rows.values()
                  if r["series"] == "slope" and r["kernel"] == kernel]
        if points:
            right.plot(*np.array(sorted(points)).T, marker + "-", label=kernel)
    right.axhline(25 / 12, color="k", lw=1, label="25/12, unbounded")
    right.set(xlabel="dx / radius", ylabel="D / Ca at Ca = 0.01", xlim=(0, None))
    right.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    arguments = command_line.parse(options(__doc__, (series for series, _ in cases())), HERE)
    path = arguments.output / "study.csv"
    rows = load(path)
    for series, variables in cases():
        name = key(series, variables)
        if name in rows or not wanted(arguments, series):
            continue
        t, d, loop = run(arguments, variables)
        row = dict(zip(["series", *BASE], name), loop_seconds=f"{loop:.2f}", D_end=f"{d[-1]:.8g}",
                   samples=" ".join(f"{x:.6g}:{y:.8g}" for x, y in zip(t, d)))
        rows[name] = row
        with open(path, "w", newline="") as file:
            writer = csv.DictWriter(file, FIELDS)
            writer.writeheader()
            writer.writerows(rows.values())
        print(*name, f"{loop:.1f} s", f"D = {d[-1]:.5f}", flush=True)
    if all(key(*case) in rows for case in cases()):
        report(rows)
        plot(rows, arguments.output / "study.png")


if __name__ == "__main__":
    main()
