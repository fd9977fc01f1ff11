#!/usr/bin/python3
"""Diameters of a red cell in optical tweezers against load: material, contact, mesh, grid spacing
and box.

Runs in.stretch for a list of cases, compares with the references of examples/reference and writes
stretch.csv and stretch.png to a folder. Cases that its stretch.csv already holds are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only set mesh]
"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "..", folder) for folder in ("scripts", "potentials")]
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import make_template  # noqa: E402
from example_study import options, run_cases, run_script  # noqa: E402
from rbc.tables import read_csv, read_table  # noqa: E402

LAW, AREA = "mooney-rivlin ${C1} ${C2} ${h}", "${kglobal} ${klocal}"    # as in.stretch has them
FULL = "0 15.987 19.338 30.754 38.365 47.245 67.964 87.837 108.95 130.51 150.81 172.37 192.69"
FEW = "19.338 67.964 108.95 192.69"
BASE = dict(law=LAW, area=AREA, contact="rigid", shape="rbc_642", patch=3.69, dx=0.5, length=32,
            width=16, timestep=25, still=2e-6, load=FULL)
SHORT = dict(BASE, load=FEW)
NONE, LONG = "0 0", dict(SHORT, length=48)


def mooney_rivlin(modulus, ratio):
    """Law of a shear modulus in uN/m and C2/C1."""
    first = modulus * 1e-3 / 2 / (1 + ratio) / 0.01
    return f"mooney-rivlin {first:.6g} {ratio * first:.6g} 0.01"


def cases():
    """(name of the series, label, variables) of every run."""
    yield "set", "healthy.material", BASE
    yield "material", "sheet alone free contact", dict(LONG, area=NONE, contact="free")
    yield "material", "sheet alone", dict(LONG, area=NONE)
    yield ("material", "sheet alone, C2/C1 = 1",
           dict(LONG, area=NONE, law=mooney_rivlin(5.654, 1), length=64))
    yield "material", "sheet alone, Gs = 10 uN/m", dict(LONG, area=NONE, law=mooney_rivlin(10, 0.1))
    yield "material", "area 1 0", dict(SHORT, area="1.0 0")
    yield "material", "area 0 0.5", dict(SHORT, area="0 0.5", timestep=6)
    yield ("material", "area 1 0, Gs = 6.5 uN/m",
           dict(SHORT, area="1.0 0", law=mooney_rivlin(6.5, 0.1)))
    yield "material", "area 1 0.05 free contact", dict(LONG, contact="free", timestep=12.5)
    yield "material", "Skalak, Gs = 4 uN/m, C = 10", dict(SHORT, area=NONE, law="skalak 0.004 10")
    yield ("material", "Skalak free contact",
           dict(SHORT, area=NONE, law="skalak 0.004 10", contact="free"))
    for shape, patch in (("rbc_162", 3.65), ("rbc_642", 3.65), ("rbc_2562", 3.69)):
        yield "mesh", f"{shape}, patch {patch}", dict(SHORT, shape=shape, patch=patch)
    yield "dx", "dx 0.8", dict(SHORT, dx=0.8)
    yield "dx", "dx 0.4", dict(SHORT, dx=0.4, timestep=12.5)
    yield "box", "box 40 x 24 x 24", dict(SHORT, length=40, width=24)
    yield "still", "still 5e-7", dict(SHORT, still=5e-7)


def run(arguments, variables):
    """Rows of RESULTS that in.stretch writes; loads at which the run stopped with an error are
    missing."""
    with open(os.path.join(HERE, "in.stretch")) as file:
        script = file.read()
    assert LAW in script and AREA in script
    script = script.replace(LAW, variables["law"]).replace(AREA, variables["area"])
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "in.stretch"), "w") as file:
            file.write(script)
        given = {name: value for name, value in variables.items() if name not in ("law", "area")}
        result = run_script(arguments, "in.stretch", folder,
                            dict(given, load=variables["load"].split()))
        errors = [line for line in result.stdout.splitlines() if line.startswith("ERROR")]
        print(*errors, sep="\n", end="\n" if errors else "")
        if not os.path.exists(os.path.join(folder, "stretch.dat")):
            raise SystemExit(result.stdout + result.stderr)
        found = read_results(folder)
        return list(zip(*(found[name] for name in RESULTS)))


RESULTS = ("load", "axial", "transverse", "area", "volume", "energy", "speed")


def read_results(folder):
    """Columns by name of the table of a run."""
    return read_table(os.path.join(folder, "stretch.dat"))


def reference(name):
    """Columns of a CSV of examples/reference."""
    rows = read_csv(os.path.join(HERE, "..", "reference", name))
    return {column: np.array([float(row[column]) for row in rows]) for column in rows[0]}


def deviations(rows):
    """(load, axial, transverse) of a run as deviations from the experiment over the length of its
    error bar."""
    data = reference("01a_stretch_mills2004_errorbars.csv")
    found = []
    for row in rows:
        at = np.argmin(np.abs(data["force_pN"] - row["load"]))
        if abs(data["force_pN"][at] - row["load"]) < 1e-6:
            found.append([row["load"]])
            for measured, name in (("axial", "axial"), ("transverse", "trans")):
                excess = row[measured] - data[f"D_{name}_um"][at]
                bar = (data[f"D_{name}_{'hi' if excess > 0 else 'lo'}"][at] -
                       data[f"D_{name}_um"][at])
                found[-1].append(excess / abs(bar))
    return np.array(found)


def patch_area(patch):
    """Area of the smooth disc (of a mesh of 40,962 vertices) beyond x = patch."""
    points, triangles = make_template.template("disc", 64, 3.91)
    corners = points[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                          axis=1) / 2
    return area[corners[:, :, 0].mean(axis=1) > patch].sum()


def report(table):
    """The tables of the README."""
    for patch in (3.65, 3.69):
        print(f"patch beyond {patch}: {patch_area(patch):.2f} um^2")
    hemocell = reference("01e_stretch_hemocell_reference_sim.csv")
    for label, rows in table.items():
        ratios = deviations(rows)
        worst = ratios[:, 1:].max(axis=1), np.abs(ratios[:, 1:]).max(axis=1)
        print(f"\n{label}: {int((np.abs(ratios[:, 1:]) > 1).sum())} of {2 * len(ratios)} diameters "
              f"outside the error bars, the worst at {worst[1].max():.2f} of the bar "
              f"({ratios[worst[1].argmax(), 0]:g} pN)")
        for row, (load, *ratio) in zip(rows, ratios):
            other = [np.interp(load, hemocell["force_pN"], hemocell[f"D_{name}_um"], np.nan, np.nan)
                     for name in ("axial", "trans")]
            print(f"  {load:8.2f} pN  axial {row['axial']:6.2f} ({ratio[0]:+.2f})  transverse "
                  f"{row['transverse']:5.2f} ({ratio[1]:+.2f})  area {row['area']:6.1f}  volume "
                  f"{row['volume']:.2f}  HemoCell {other[0]:6.2f} {other[1]:5.2f}")


def plot(table, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(8, 5.2))
    mills = reference("01a_stretch_mills2004_errorbars.csv")
    for name in ("axial", "trans"):
        middle = mills[f"D_{name}_um"]
        axes.errorbar(mills["force_pN"], middle,
                      yerr=[middle - mills[f"D_{name}_lo"], mills[f"D_{name}_hi"] - middle],
                      fmt="o", color="0.45", ms=4, capsize=3, lw=1,
                      label="Mills et al. 2004" if name == "axial" else None)
    for file, style, label in (("01c_stretch_suresh2005.csv", "x", "Suresh et al. 2005"),
                               ("01e_stretch_hemocell_reference_sim.csv", ":",
                                "HemoCell, published values")):
        other = reference(file)
        line, = axes.plot(other["force_pN"], other["D_axial_um"], style, color="#2a6fb0",
                          label=label)
        axes.plot(other["force_pN"], other["D_trans_um"], style, color=line.get_color())
    for label, style, color in (("healthy.material", "-", "#b3202a"),
                                ("sheet alone", "--", "#e09a9f")):
        if label in table:
            columns = np.array(
                [[row[name] for name in ("load", "axial", "transverse")] for row in table[label]])
            axes.plot(columns[:, 0], columns[:, 1], style, color=color,
                      label=label + (" (without area moduli)" if label == "sheet alone" else ""))
            axes.plot(columns[:, 0], columns[:, 2], style, color=color)
    axes.set(xlabel="load / pN", ylabel="axial and transverse diameter / µm", xlim=(-5, 200),
             ylim=(2, 21))
    axes.legend(frameon=False, loc="upper left")
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main():
    arguments = command_line.parse(options(__doc__, (series for series, *_ in cases())), HERE)
    table = run_cases(arguments, arguments.output / "stretch.csv", RESULTS, cases(), run)
    table = {label: [dict(zip(RESULTS, row)) for row in rows] for label, rows in table.items()}
    report(table)
    plot(table, arguments.output / "stretch.png")


if __name__ == "__main__":
    main()
