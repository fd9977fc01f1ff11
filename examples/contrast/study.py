#!/usr/bin/python3
"""Error of a capsule of another viscosity inside against grid spacing, box and run time.

Runs in.contrast for a list of cases, writes contrast.csv and steady.csv to a folder, compares
deformation, inclination and tank-treading with the boundary-element results of examples/reference
and with the theory of small deformation, and draws contrast.png. Cases that these files already
hold are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--only contrast] [--ranks 1]
"""
import os
import re
import resource
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
from example_study import options, run_cases, run_script  # noqa: E402
from rbc.membrane_motion import read_dump, revolutions  # noqa: E402
from rbc.tables import read_ave_time, read_csv  # noqa: E402
from richardson import extrapolate  # noqa: E402

REFERENCES = os.path.join(HERE, "..", "reference")
REFERENCE = os.path.join(REFERENCES, "02j_capsule_shear_BEM_contrast_transient.csv")
STEADY_REFERENCE = os.path.join(REFERENCES, "02k_capsule_shear_BEM_contrast_steady.csv")
COLUMNS = ["t", "D", "inclination", "iterations", "solves", "core_seconds"]
T, D, INCLINATION, ITERATIONS, SOLVES, SECONDS = range(len(COLUMNS))
# Of the end of a long run: means over half a period of tank-treading, and largest less smallest.
STEADY_COLUMNS = ["t", "D", "inclination", "period", "D_range", "inclination_range", "iterations",
                  "solves", "core_seconds"]
PERIOD, D_RANGE, INCLINATION_RANGE = 3, 4, 5
TIMESTEP = 0.02    # of in.contrast
RATIOS = (1, 2, 5, 10)
SMALL_RATIOS = (0.2, 1, 5)
SMALL = dict(Ca=0.01, timestep=0.01, every=0.02, integrator="rkc auto")
# Small deformations, in their relaxation times: when they are steady, and when runs end. A membrane
# that does not resist bending wrinkles where it is compressed, and wrinkles grow in a strain of 1.
STEADY, END = 8, 11
# Vertices by cells a radius: edges of 0.8 to 1.3 spacings.
SHAPES = {4: "capsule_362", 6: "capsule_642", 8: "capsule_642", 12: "capsule_2562",
          16: "capsule_2562"}
TOLERANCES = {1e-3: "tol 0.001", 1e-6: "tol 1e-06"}    # beside that of in.contrast
HALF_STEP = "half timestep"
CHOICE_SPACING = 4    # cells a radius in runs for tolerance and time step
STRAINS = (0.5, 1, 1.5, 2)
BASE_BOX = 8
BOX_SPACING = 4    # cells a radius in runs that tell what the box does
# Strains of long runs: the more viscous, the longer a capsule swings.
LONG = {1: 16, 2: 16, 5: 20, 10: 36}
MOONEY = dict(series="steady-mooney", law="Mooney-Rivlin psi=0.5")


def label(series, inside, cells, box=BASE_BOX):
    return f"{series} lambda {inside:g} dx 1/{cells} box {box}"


def case(series, inside, cells, box=BASE_BOX, **others):
    variables = dict(inside=inside, dx=1 / cells, shape=SHAPES[cells], length=box, gap=box)
    return series, label(series, inside, cells, box), dict(variables, **others)


def cases():
    """(series, label, variables) of every run."""
    for cells in (4, 6, 8):
        for inside in RATIOS:
            yield case("contrast", inside, cells)
    for inside in RATIOS:
        yield case("contrast", inside, BOX_SPACING, 12)
    for inside in (1, 2, 5):
        yield case("contrast", inside, BOX_SPACING, 16)
    for inside in (5, 10):
        for tolerance, series in TOLERANCES.items():
            yield case(series, inside, CHOICE_SPACING, tol=tolerance)
        yield case(HALF_STEP, inside, CHOICE_SPACING, timestep=TIMESTEP / 2)
    for inside in SMALL_RATIOS:
        strain = round(END * relaxation_time(inside, SMALL["Ca"]), 1)
        for cells, box in ((4, 8), (4, 12), (6, 8)):
            yield case("small", inside, cells, box, strain=strain, **SMALL)
    for cells, box in ((4, 8), (4, 12), (6, 8)):
        yield case("mooney", 5, cells, box, psi=0.5)
    for inside in RATIOS:
        yield case("contrast", inside, 12)
    yield case("contrast", 10, 16)
    for cells, box in ((4, 8), (4, 12), (6, 8), (8, 8)):
        yield case("long", 5, cells, box, strain=10)


def steady_cases():
    """The same of the runs that end in a steady shape."""
    for inside, strain in LONG.items():
        for cells, box in ((4, 8), (4, 12), (6, 8)):
            yield case("steady", inside, cells, box, strain=strain, trace=1)
        if inside < 10:
            yield case("steady", inside, 8, strain=strain, trace=1)
    for cells, box in ((4, 8), (4, 12), (6, 8)):
        yield case(MOONEY["series"], 5, cells, box, strain=LONG[5], trace=1, psi=0.5)


def shape_rows(history, timestep):
    """t, D and inclination of each output."""
    axis = history.columns(11, 13)[:, 0]
    angle = np.degrees(np.arctan2(axis[:, 2], axis[:, 0]))
    return list(zip(history.steps * timestep, history.column(7)[:, 0], angle))


def steady_row(history, traced, timestep):
    """STEADY_COLUMNS without the costs. In half a period each vertex makes half a revolution, and
    its mate opposite the other one."""
    steps, positions = traced
    strain = steps * timestep
    left = revolutions(positions).mean(axis=1)
    left = abs(left[-1] - left)
    begin = np.interp(-0.5, -left, strain)
    rows = np.array(shape_rows(history, timestep))
    rows = rows[rows[:, T] >= begin]
    return [strain[-1], *rows[:, [D, INCLINATION]].mean(axis=0), 2 * (strain[-1] - begin),
            *np.ptp(rows[:, [D, INCLINATION]], axis=0)]


def run(arguments, variables):
    """A row of COLUMNS for each output of one run, or with `trace` one row of STEADY_COLUMNS."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    timestep = variables.get("timestep", TIMESTEP)
    with tempfile.TemporaryDirectory() as folder:
        done = run_script(arguments, os.path.join(HERE, "in.contrast"), folder, variables)
        done.check_returncode()
        history = read_ave_time(os.path.join(folder, "cell.dat"))
        if "trace" in variables:
            traced = read_dump(os.path.join(folder, "section.dump"))
            found = [steady_row(history, traced, timestep)]
        else:
            found = shape_rows(history, timestep)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    solves = float(re.search(r"(\d+) solves in", done.stdout).group(1))
    thermo = done.stdout.split("USER-RBC step cost")[0].rstrip().splitlines()
    iterations = float(thermo[-1].split()[-2])
    return [[*row, iterations, solves, seconds] for row in found]


def references(inside, law="neo-Hookean"):
    """(t, D, inclination) of the boundary-element results at Ca = 0.3."""
    names = "gdot_t", "D_ell", "inclination_deg"
    return np.array([[float(row[name]) for name in names] for row in read_csv(REFERENCE)
                     if row["law"] == law and float(row["lambda"]) == inside])


def theory(inside, ca):
    """D and inclination of a small deformation, arXiv 2602.15626; the inclination as derived in
    the reference 02j."""
    return 25 / 12 * ca, 45 - np.degrees(relaxation_time(inside, ca) / 2)


def relaxation_time(inside, ca):
    """Of a small deformation, in strain: the axes lag behind by half of it."""
    return ca * (276 + 209 * inside) / 120


def at(table, name, time):
    """D, inclination and, of a steady shape, the period of a run at a time."""
    rows = table[name]
    last = PERIOD if rows.shape[1] == len(STEADY_COLUMNS) else INCLINATION
    return np.array([np.interp(time, rows[:, T], rows[:, n]) for n in range(D, last + 1)])


def spacings(table, series, inside):
    """Cells a radius of the runs in the base box, coarsest first."""
    return [cells for cells in SHAPES if label(series, inside, cells) in table]


def box_change(table, series, inside, time):
    """What an infinite box adds to D and inclination; images and plates act as 1/box^3."""
    names = {box: label(series, inside, BOX_SPACING, box) for box in (8, 12, 16)}
    boxes = np.array([box for box, name in names.items() if name in table])
    values = np.array([at(table, names[box], time) for box in boxes])
    return np.polyfit(boxes**-3.0, values, 1)[-1] - values[0]


def extrapolated(table, series, inside, time):
    """D and inclination at dx -> 0, by the two finest as of second order, in an infinite box."""
    coarse, fine = spacings(table, series, inside)[-2:]
    values = [at(table, label(series, inside, cells), time) for cells in (coarse, fine)]
    return (extrapolate(1 / fine, values[1], 1 / coarse, values[0], 2) +
            box_change(table, series, inside, time))


def exact_at(inside, time, law="neo-Hookean"):
    reference = references(inside, law)
    return reference[np.isclose(reference[:, 0], time)][0][1:]


def percent(errors):
    return ", ".join(f"{100 * error:+.1f}" for error in errors) + " %"


def report_transients(table, series, law, ratios, times=STRAINS):
    """Error of the finest in a box of 8, and extrapolated."""
    for inside in ratios:
        finest = spacings(table, series, inside)[-1]
        print(f"\n{series}: {law}, lambda {inside:g}: strain; D, error at dx = 1/{finest}, "
              "extrapolated; the same of the inclination")
        for time in times:
            exact = exact_at(inside, time, law)
            errors = [values / exact - 1 for values in
                      (at(table, label(series, inside, finest), time),
                       extrapolated(table, series, inside, time))]
            columns = [f"{value:.{digits}f} | {percent([one])} | {percent([other])}"
                       for value, digits, one, other in zip(exact, (4, 2), *errors)]
            print(f"| {inside:g} | {time:g} | {' | '.join(columns)} |")


def report_steady(table, series="steady", law="neo-Hookean", ratios=tuple(LONG)):
    exact_rows = [row for row in read_csv(STEADY_REFERENCE) if row["law"] == law]
    names = "D_ell", "inclination_deg", "tank_tread_period_gdot"
    for inside in ratios:
        row, = (row for row in exact_rows if float(row["lambda"]) == inside)
        exact = np.array([float(row[name]) for name in names])
        errors = [at(table, label(series, inside, cells), LONG[inside]) / exact - 1
                  for cells in spacings(table, series, inside)]
        limit = extrapolated(table, series, inside, LONG[inside]) / exact - 1
        print(f"\n{series}: {law}, lambda {inside:g}: boundary elements; errors by dx in a box "
              "of 8, extrapolated; of D, inclination and period")
        for n, digits in enumerate((4, 2, 2)):
            print(f"| {inside:g} | {exact[n]:.{digits}f} | {percent(np.array(errors)[:, n])} | "
                  f"{percent([limit[n]])} |")
        finest = spacings(table, series, inside)[-1]
        last = table[label(series, inside, finest)][-1]
        print(f"at dx = 1/{finest} to strain {last[T]:g}: ranges in half a period "
              f"{last[D_RANGE]:.4f} of D, {last[INCLINATION_RANGE]:.2f} degrees; "
              f"{last[-1]:.0f} core seconds")


def costs(last, timestep):
    """Of a run with integrator midpoint, of which `last` is the last row."""
    solves = last[SOLVES] / (2 * last[T] / timestep)
    return f"{last[SECONDS]:.3g} | {last[ITERATIONS]:.1f} | {solves:.1f}"


def report_costs(table):
    print("\nlambda, dx: errors in an infinite box at strains 1 and 2 of D, of the inclination; "
          "core seconds, iterations and solves per evaluation")
    for inside in RATIOS:
        for cells in spacings(table, "contrast", inside):
            name = label("contrast", inside, cells)
            values = [at(table, name, time) + box_change(table, "contrast", inside, time)
                      for time in (1, 2)]
            errors = np.array(values) / [exact_at(inside, time) for time in (1, 2)] - 1
            print(f"| {inside:g} | 1/{cells} | {percent(errors[:, 0])} | {percent(errors[:, 1])} | "
                  f"{costs(table[name][-1], TIMESTEP)} |")


def steady(table, name, inside):
    """The mean over the end of a run as its only row: vertices that pass the grid make D and
    inclination swing."""
    rows = table[name]
    begin = STEADY * relaxation_time(inside, SMALL["Ca"])
    return rows[rows[:, T] > begin].mean(axis=0, keepdims=True)


def report_small(table):
    print("\nCa = 0.01: lambda; D/Ca by dx in a box of 8, extrapolated, error; inclination by dx, "
          "extrapolated, theory, error")
    ca = SMALL["Ca"]
    for inside in SMALL_RATIOS:
        means = {name: steady(table, name, inside) for name in table
                 if name.startswith(f"small lambda {inside:g} ")}
        values = np.array([means[label("small", inside, cells)][-1, [D, INCLINATION]]
                           for cells in spacings(means, "small", inside)])
        limit = extrapolated(means, "small", inside, END)
        exact = theory(inside, ca)
        print(f"| {inside:g} | {', '.join(f'{v / ca:.3f}' for v in values[:, 0])} | "
              f"{limit[0] / ca:.3f} | {percent([limit[0] / exact[0] - 1])} | "
              f"{', '.join(f'{v:.2f}' for v in values[:, 1])} | {limit[1]:.2f} | {exact[1]:.2f} | "
              f"{percent([limit[1] / exact[1] - 1])} |")


def report_choices(table):
    print("\ndx = 1/4: lambda; D and inclination at strain 2; core seconds, iterations and solves "
          "per evaluation")
    for inside in (5, 10):
        for series in ("contrast", *TOLERANCES.values(), HALF_STEP):
            last = table[label(series, inside, CHOICE_SPACING)][-1]
            timestep = TIMESTEP / 2 if series == HALF_STEP else TIMESTEP
            print(f"| {inside:g} | {series} | {last[D]:.4f} | {last[INCLINATION]:.2f} | "
                  f"{costs(last, timestep)} |")


def plot(table, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5))
    for inside in RATIOS:
        reference = references(inside)
        reference = reference[reference[:, 0] <= max(STRAINS)]
        times = table[label("contrast", inside, BOX_SPACING)][1:, T]
        limits = np.array([extrapolated(table, "contrast", inside, time) for time in times])
        for axis, column in zip(axes, (0, 1)):
            line, = axis.plot(times, limits[:, column], label=f"λ = {inside:g}")
            axis.plot(reference[:, 0], reference[:, 1 + column], "o", color=line.get_color(),
                      mfc="none")
    for axis, name in zip(axes, ("Taylor deformation D", "inclination / degrees")):
        axis.plot([], [], "o", color="0.4", mfc="none", label="boundary elements")
        axis.set(xlabel="shear rate × time", ylabel=name, xlim=(0, None))
        axis.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    every = [*cases(), *steady_cases()]
    arguments = command_line.parse(options(__doc__, (series for series, *_ in every)), HERE)
    table = run_cases(arguments, arguments.output / "contrast.csv", COLUMNS, cases(), run)
    steady_table = run_cases(arguments, arguments.output / "steady.csv", STEADY_COLUMNS,
                             steady_cases(), run)
    if all(name in steady_table for _, name, _ in steady_cases()):
        report_steady(steady_table)
        report_steady(steady_table, **MOONEY, ratios=[5])
    if any(name not in table for _, name, _ in cases()):
        return
    report_transients(table, "contrast", "neo-Hookean", RATIOS)
    report_transients(table, "mooney", "Mooney-Rivlin psi=0.5", [5])
    report_transients(table, "long", "neo-Hookean", [5], times=(3, 4, 6, 8, 10))
    report_costs(table)
    report_small(table)
    report_choices(table)
    plot(table, arguments.output / "contrast.png")


if __name__ == "__main__":
    main()
