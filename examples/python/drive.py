#!/usr/bin/python3
"""Holds the deformation of a capsule at given values by the shear rate, which it changes while
LAMMPS runs: every few steps it reads compute rbc/cell as an array, compares, and sets a variable of
the input script.

bash ../../scripts/python.sh drive.py --output mine
mpirun -np 2 bash ../../scripts/python.sh drive.py --output mine

Writes python.csv (time, capillary number, deformation) and python.png.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import rbc  # noqa: E402

RATE = 0.1            # at the start
START = 5.0           # time at that rate, in which the sphere takes a shape
STEPS = 10            # between two looks at the cell
GAIN = 0.5            # of the controller: change of the rate's logarithm per time and error
PUBLISHED = HERE.parent / "reference" / "02a_capsule_shear_NH_steady_D.csv"


def hold(lmp, target, duration, rate):
    """Rows (time, rate, D) while the deformation of the only cell is driven to the target.

    What deforms too little is sheared faster, by an amount that grows with the error. As the
    deformation follows the rate with a delay, small changes are enough.
    """
    timestep = lmp.extract_global("dt")
    rows = []
    for _ in range(round(duration / (STEPS * timestep))):
        deformation = rbc.cells_now(lmp)["deformation"][0, 0]
        rate *= np.exp(GAIN * STEPS * timestep * (1 - deformation / target))
        lmp.set_internal_variable("rate", rate)
        lmp.command(f"run {STEPS} post no")
        rows.append((lmp.extract_global("ntimestep") * timestep, rate,
                     rbc.cells_now(lmp)["deformation"][0, 0]))
    return rows


def published():
    """{source: (Ca, D)} of the steady deformations that others computed."""
    points = {}
    for row in rbc.read_csv(PUBLISHED):
        if row["D_steady"]:
            points.setdefault(row["source"], []).append((row["Ca_G"], row["D_steady"]))
    return {source: np.array(pairs, dtype=float).T for source, pairs in points.items()}


def published_at(ca):
    """Least and largest D of the sources at a capillary number, by powers of it between points."""
    found = [np.exp(np.interp(np.log(ca), *np.log(curve))) for curve in published().values()]
    return min(found), max(found)


def settled(rows, target):
    """Mean Ca and D over the last fifth of the time that a target was held."""
    late = rows[rows[:, 0] > rows[-1, 0] - 0.2 * (rows[-1, 0] - rows[0, 0])]
    ca, deformation = late[:, 1].mean(), late[:, 2].mean()
    least, most = published_at(ca)
    print(f"D {target:g} asked for, {deformation:.4f} held at Ca {ca:.4f}, "
          f"where others find {least:.3f} to {most:.3f}")
    return ca, deformation


def draw(path, pieces, means):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    panels = figure.subplot_mosaic([["D", "curve"], ["Ca", "curve"]], width_ratios=(3, 2))
    for target, rows in pieces.items():
        panels["D"].plot(rows[:, 0], rows[:, 2], color="#b3202a")
        panels["D"].plot(rows[[0, -1], 0], [target] * 2, "--", color="#777777", lw=1)
        panels["Ca"].plot(rows[:, 0], rows[:, 1], color="#1f4e79")
    panels["D"].set(ylabel="deformation D", ylim=(0, None), xticklabels=[])
    panels["Ca"].set(xlabel="time (viscosity · radius / G$_s$)", ylabel="Ca, set", ylim=(0, None))
    others = np.concatenate(list(published().values()), axis=1)
    panels["curve"].plot(*others, "o", mfc="none", color="#222222", label="published")
    panels["curve"].plot(*np.transpose(means), "D", color="#b3202a", label="held here")
    panels["curve"].set(xlabel="capillary number Ca", ylabel="steady D", xlim=(0, None),
                        ylim=(0, None))
    panels["curve"].legend(frameon=False)
    figure.savefig(path, dpi=100)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--deformation", type=float, nargs="+", default=[0.27, 0.385], metavar="D",
                        help="values to hold, one after the other (default 0.27 0.385)")
    parser.add_argument("--duration", type=float, default=20, help="of each (default 20)")
    parser.add_argument("--var", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"),
                        help="a variable of in.python")
    arguments = command_line.parse(parser, HERE)

    templates = HERE.parents[1] / "potentials"
    variables = {"templates": templates, **dict(arguments.var)}
    words = [word for pair in variables.items() for word in ("-var", *pair)]
    lmp = rbc.start_lammps("-log", "none", "-screen", "none", *words)
    lmp.file(str(HERE / "in.python"))
    lmp.set_internal_variable("rate", RATE)
    lmp.command(f"run {round(START / lmp.extract_global('dt'))} post no")
    pieces, rate = {}, RATE
    for target in arguments.deformation:
        pieces[target] = np.array(hold(lmp, target, arguments.duration, rate))
        rate = pieces[target][-1, 1]
    first_task = lmp.extract_setting("world_rank") == 0
    lmp.finalize()

    if first_task:    # the others have the same numbers
        means = [settled(rows, target) for target, rows in pieces.items()]
        np.savetxt(arguments.output / "python.csv", np.concatenate(list(pieces.values())),
                   delimiter=",", header="time,Ca,D", comments="", fmt="%.6g")
        draw(arguments.output / "python.png", pieces, means)


if __name__ == "__main__":
    main()
