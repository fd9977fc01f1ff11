#!/usr/bin/python3
"""Pressure of a balloon against its stretch, of the membrane and of the fluid: laws, mesh, grid
spacing, speed.

Runs in.balloon for a list of cases, compares with the closed forms and writes balloon.csv and
balloon.png to a folder. Cases that its balloon.csv already holds are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only law mesh]
"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
from example_study import options, run_cases, run_script  # noqa: E402
from rbc.tables import read_csv  # noqa: E402


BASE = dict(law="neo", stretch=2.5, duration=72, shape="capsule_642", dx=0.125, box=6,
            timestep=0.04, kernel="peskin4")
NAMES = {"neo": "neo-Hookean", "mooney": "Mooney-Rivlin, C2/C1 = 0.1", "skalak": "Skalak, C = 1"}


def cases():
    """(name of the series, label, variables) of every run."""
    yield "law", "neo", BASE
    yield "law", "mooney", dict(BASE, law="mooney")
    yield "law", "skalak", dict(BASE, law="skalak", stretch=1.5, timestep=0.006, box=4.5)
    yield "mesh", "162 vertices, dx 1/4", dict(BASE, shape="capsule_162", dx=0.25)
    yield ("mesh", "2562 vertices, dx 1/16",
           dict(BASE, shape="capsule_2562", dx=0.0625, timestep=0.03))
    for name, dx in (("1/6", 1 / 6), ("1/10", 0.1), ("1/12", 1 / 12)):
        yield "dx", f"642 vertices, dx {name}", dict(BASE, dx=dx)
    yield "kernel", "642 vertices, dx 1/8, roma3", dict(BASE, kernel="roma3")
    yield "dx", "642 vertices, dx 1/4, ramp of 20", dict(BASE, dx=0.25, duration=20, timestep=0.02)
    for duration in (36, 144):
        yield "duration", f"642 vertices, dx 1/8, ramp of {duration}", dict(BASE, duration=duration)


def closed_form(law, stretch):
    """p R / Gs; the headers of examples/reference/08a and 08b."""
    if law == "skalak":
        return 2 / stretch * (stretch**2 - 1 + stretch**2 * (stretch**4 - 1))
    share = {"neo": 1, "mooney": 1 / 1.1}[law]
    return 2 * (1 / stretch - stretch**-7) * (share + (1 - share) * stretch**2)


def reference(law):
    """Stretches and p R / Gs of the closed forms as tabulated in examples/reference; none for C2/C1
    = 0.1."""
    name, column, value = {"neo": ("08a_mooney_rivlin_membrane_closed_forms.csv", "psi", "1"),
                           "skalak": ("08b_skalak_closed_forms.csv", "C", "1")}[law]
    rows = [row for row in read_csv(os.path.join(HERE, "..", "reference", name))
            if row[column] == value]
    return np.array([[float(row["lambda"]), float(row["pR0_balloon"])] for row in rows]).T


def read_pressure(path):
    """Pressure of a `dump grid` file as [z, y, x] and the coordinates of the cells along an
    axis."""
    with open(path) as file:
        lines = file.read().splitlines()
    after = lambda name: next(n for n, line in enumerate(lines)  # noqa: E731
                              if line.startswith("ITEM: " + name)) + 1
    low, high = map(float, lines[after("BOX BOUNDS")].split())
    cells = int(lines[after("GRID SIZE")].split()[0])
    values = np.array(lines[after("GRID CELLS"):], dtype=float).reshape(cells, cells, cells)
    return values, low + (np.arange(cells) + 0.5) * (high - low) / cells


def fluid_pressure(path):
    """Pressure of the fluid around the centre minus that in the corners of the box."""
    pressure, axis = read_pressure(path)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    radius = np.sqrt(x**2 + y**2 + z**2)
    return pressure[radius < 0.4].mean() - pressure[radius > 1.5 * axis[-1]].mean()


def run(arguments, variables):
    """Rows of stretch, pressure of membrane and fluid; times radius / Gs."""
    with tempfile.TemporaryDirectory() as folder:
        run_script(arguments, os.path.join(HERE, "in.balloon"), folder,
                   variables).check_returncode()
        return measure(folder)


def measure(folder):
    """The same from the files of a run."""
    table = np.loadtxt(os.path.join(folder, "balloon.dat"))
    rest = table[0, 1]
    radius = (3 * rest / (4 * np.pi))**(1 / 3)
    return [((row[1] / rest)**(1 / 3), row[2] * radius,
             fluid_pressure(os.path.join(folder, f"pressure.{int(row[0])}.grid")) * radius)
            for row in table[1:]]


def law_of(label):
    return label if label in NAMES else "neo"


def report(table):
    """Errors at a few stretches, in percent, of membrane and fluid."""
    for label, rows in table.items():
        exact = closed_form(law_of(label), rows[:, 0])
        errors = 100 * (rows[:, 1:] / exact[:, None] - 1)
        worst = np.abs(errors).max(axis=0)
        print(f"\n{label}: largest error of the membrane's pressure {worst[0]:.2f} %, of the "
              f"fluid's {worst[1]:.2f} %")
        for stretch in (1.05, 1.1, 1.2, 1.35, 1.5, 1.75, 2.0, 2.5):
            n = np.argmin(np.abs(rows[:, 0] - stretch))
            if abs(rows[n, 0] - stretch) < 5e-3:
                print(f"  stretch {rows[n, 0]:.3f}  p {exact[n]:8.4f}  membrane {rows[n, 1]:8.4f} "
                      f"({errors[n, 0]:+.2f} %)  fluid {rows[n, 2]:8.4f} ({errors[n, 1]:+.2f} %)")
    for law in ("neo", "skalak"):
        stretch, pressure = reference(law)
        print(f"\n{law}: closed form and table differ by "
              f"{np.abs(closed_form(law, stretch) / pressure - 1).max():.1e}")
    if "neo" in table:
        rows = table["neo"]
        top = np.argmax(rows[:, 1]) + np.arange(-1, 2)
        a, b, c = np.polyfit(rows[top, 0], rows[top, 1], 2)
        print(f"\nlimit point of the neo-Hookean balloon: stretch {-b / 2 / a:.4f}, p "
              f"{c - b * b / 4 / a:.4f}; "
              f"exact {7**(1 / 6):.4f}, {closed_form('neo', 7**(1 / 6)):.4f}")


def plot(table, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4))
    for law, color in zip(NAMES, ("#b3202a", "#2a6fb0", "#4b8b3b")):
        if law not in table:
            continue
        rows = table[law]
        stretch = np.linspace(1, rows[-1, 0], 200)
        left.plot(stretch, closed_form(law, stretch), color=color, label=NAMES[law])
        left.plot(rows[:, 0], rows[:, 1], "o", color=color, mfc="none", ms=5)
        left.plot(rows[:, 0], rows[:, 2], "+", color=color, ms=5)
    for law in ("neo", "skalak"):
        left.plot(*reference(law), "k.", ms=4)
    left.plot([], [], "k.", ms=4, label="closed form, tabulated")
    limit = 7**(1 / 6)
    left.annotate("limit point", (limit, closed_form("neo", limit)), (1.5, 0.75),
                  arrowprops=dict(arrowstyle="->"))
    left.plot([], [], "o", color="0.4", mfc="none", label="membrane (virial)")
    left.plot([], [], "+", color="0.4", label="fluid, inside minus outside")
    left.set(xlabel="radius over radius at rest", ylabel="pressure × radius at rest / G$_s$",
             xlim=(1, 2.5), ylim=(0, 2))
    left.legend(frameon=False, fontsize=8, loc="lower right")
    names = {"162 vertices, dx 1/4": "162, dx 1/4", "neo": "642, dx 1/8",
             "2562 vertices, dx 1/16": "2562, dx 1/16"}
    for (label, name), color in zip(names.items(), ("#e09a9f", "#b3202a", "#5a1015")):
        if label in table:
            rows = table[label]
            error = 100 * (rows[:, 1:] / closed_form("neo", rows[:, :1]) - 1)
            right.plot(rows[:, 0], error[:, 0], "o-", color=color, ms=3, lw=1,
                       label=f"membrane, {name}")
            right.plot(rows[:, 0], error[:, 1], "+--", color=color, ms=4, lw=1,
                       label=f"fluid, {name}")
    right.axhline(0, color="k", lw=0.8)
    right.set(xlabel="radius over radius at rest", ylabel="error of the neo-Hookean pressure / %",
              xlim=(1, 2.5))
    right.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main():
    arguments = command_line.parse(options(__doc__, (series for series, *_ in cases())), HERE)
    table = run_cases(arguments, arguments.output / "balloon.csv", ("stretch", "membrane", "fluid"),
                      cases(), run)
    report(table)
    plot(table, arguments.output / "balloon.png")


if __name__ == "__main__":
    main()
