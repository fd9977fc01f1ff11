#!/usr/bin/python3
"""Tank-treading of a red cell beside experiments: frequency, inclination, and the stress below
which the cell tumbles.

Runs in.tank-treading at many shear rates, one to five minutes each on one core, and keeps what it
finds in tank-treading.csv of a folder: all parts, or those named, for which it measures anew
(--part frequency --case thinning). Then it prints the tables and draws tank-treading.png and
inclination.png there; with --draw it does only that, from the table of the repository if the folder
has none.

study.py --output FOLDER [--part frequency] [--case thinning] [--draw]
"""

import csv
import subprocess
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from rbc.membrane_motion import angles, read_dump, revolutions  # noqa: E402

REFERENCE = HERE.parent / "reference"
TABLE = "tank-treading.csv"
FROM = 15    # strain from which frequencies and angles count
STEP = 0.2    # of the input script
FASTEST = 200    # shear rate from which it is halved

MEDIUM = 28.9    # of the frequencies, mPa s
COARSE = dict(shape="rbc_162", dx=0.8)
# free of stress in a spheroid of the same area and 0.98 of a sphere's volume for it
ROUNDER = dict(COARSE, sheet="rbc_162_spheroid98")
CASES = {"thinning": {}, "coarse": COARSE, "rounder": ROUNDER,
         "same inside": dict(COARSE, inside=MEDIUM)}
LABELS = {"thinning": "healthy.material", "coarse": "the same, 162 vertices",
          "rounder": "162, free of stress in a rounder shape",
          "same inside": "162, inside as viscous as the medium"}
INCLINATION = {23.9: (25.929, 81.559), 55.9: (17.71, 55.55)}    # rates for each medium
THRESHOLD = 23.9, 4, 28, 3    # medium, rates between which the cell ceases to tumble, halvings
LONG = 70    # strain of these runs, with the coarse mesh as there are many
CONVERGENCE_RATE = 65.169
CONVERGENCE = {"timestep / 2": dict(step=0.1),
               "162 vertices, dx 4/5": dict(shape="rbc_162", dx=0.8),
               "642 vertices, dx 2/5": dict(shape="rbc_642", dx=0.4),
               "642 vertices, dx 1/2": dict(shape="rbc_642"),
               "642 vertices, dx 1/2, peskin4": dict(shape="rbc_642", kernel="peskin4"),
               "box 16 x 12 x 16": dict(height=16, width=12)}

Row = namedtuple("Row", "part case medium rate frequency inclination range")


def frequency(strain, turns):
    """Turns per strain over as many whole half turns as there are: the motion repeats itself after
    each."""
    whole = max(np.floor(2 * turns[-1]), 1) / 2
    if turns[-1] < whole:
        return turns[-1] / (strain[-1] - strain[0])
    n = np.argmax(turns >= whole)
    end = np.interp(whole, turns[n - 1:n + 1], strain[n - 1:n + 1])
    return whole / (end - strain[0])


def motion(folder, step, start=FROM):
    """Frequency over the shear rate, mean inclination in degrees and its range, of the strains from
    `start`."""
    steps, positions = read_dump(Path(folder) / "vertices.dump")
    strain = steps * step
    late = strain >= min(start, strain[-1] / 2)
    turns = abs(revolutions(positions[late]).mean(axis=1))
    shape = np.degrees(angles(positions)[0][late])
    return frequency(strain[late], turns), (shape.mean() + 90) % 180 - 90, shape.max() - shape.min()


class Study:
    """Runs the scene and adds a row to the table for each run."""

    def __init__(self, lmp, potentials, table):
        self.lmp, self.potentials, self.table = lmp, potentials, table

    def measure(self, part, case, medium, rate, **variables):
        variables = dict(variables, medium=medium, rate=rate, templates=self.potentials)
        words = [str(word) for name, value in variables.items() for word in ("-var", name, value)]
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([self.lmp, "-in", HERE / "in.tank-treading", "-log", "none",
                                   "-screen", "out", *words],
                                  cwd=folder, check=False)
            if done.returncode:
                print(f"{part}, {case}, {rate} /s: " + (Path(folder) / "out").read_text()[-400:])
                return None
            row = Row(part, case, medium, rate, *motion(folder, variables.get("step", STEP)))
        write(self.table, [*read(self.table), row])
        print(describe(row), flush=True)
        return row

    def frequency(self, cases):
        for case in cases or CASES:
            for rate, *_ in reference("03b_ttf_fischer_28p9mPas_binned.csv"):
                self.measure("frequency", case, MEDIUM, rate,
                             step=STEP if rate < FASTEST else STEP / 2, **CASES[case])

    def inclination(self, _):
        for medium, rates in INCLINATION.items():
            for rate in rates:
                self.measure("inclination", "thinning", medium, rate)

    def threshold(self, cases):
        for case in cases or ("coarse", "rounder"):
            medium, low, high, halvings = THRESHOLD
            for _ in range(halvings):
                rate = (low + high) / 2
                row = self.measure("threshold", case, medium, rate, strain=LONG, **CASES[case])
                if not row:
                    break
                if tumbles(row):
                    low = rate
                else:
                    high = rate

    def convergence(self, cases):
        for case in cases or CONVERGENCE:
            self.measure("convergence", case, MEDIUM, CONVERGENCE_RATE, **CONVERGENCE[case])


PARTS = {"frequency": Study.frequency, "inclination": Study.inclination,
         "threshold": Study.threshold,
         "convergence": Study.convergence}


def tumbles(row):
    return row.range > 90


def describe(row):
    return (f"{row.part}, {row.case}, {row.medium} mPa s, {row.rate:7.2f} /s: f/rate "
            f"{row.frequency:.4f}, angle {row.inclination:.1f} deg, range {row.range:.0f} deg, " +
            ("tumbles" if tumbles(row) else "tank-treads"))


def reference(name):
    with open(REFERENCE / name, encoding="utf-8") as stream:
        return np.array([[float(word) for word in line.split(",") if word[0] in "0123456789."][:5]
                         for line in stream if line[0].isdigit()])


def read(table):
    if not table.exists():
        return []
    with open(table, encoding="utf-8") as stream:
        return [Row(*row[:2], *(float(word) for word in row[2:]))
                for row in list(csv.reader(stream))[1:]]


def write(table, rows):
    with open(table, "w", encoding="utf-8") as stream:
        stream.write("part,case,medium_mPas,rate_1_s,f_over_rate,inclination_deg,range_deg\n")
        stream.writelines(f"{row.part},\"{row.case}\"," +
                          ",".join(f"{value:.5g}" for value in row[2:]) + "\n" for row in rows)


def draw_frequency(rows, path):
    data = reference("03b_ttf_fischer_28p9mPas_binned.csv")
    figure, axis = plt.subplots(figsize=(7, 4.6))
    axis.errorbar(data[:, 0], data[:, 1], data[:, 2], fmt="ok", capsize=3,
                  label="Fischer, 28.9 mPa s: mean, s.d. over cells")
    axis.fill_between(data[:, 0], 0.85 * data[:, 1], 1.15 * data[:, 1], alpha=0.12, color="k",
                      label="within 15 %")
    for n, case in enumerate(CASES):
        mine = sorted((row for row in rows if row.part == "frequency" and row.case == case),
                      key=lambda row: row.rate)
        if not mine:
            continue
        axis.plot([row.rate for row in mine], [row.frequency for row in mine],
                  "osv^"[n] + ("-" if n == 0 else "--"),
                  color=f"C{n}", lw=2 if n == 0 else 1, label=LABELS[case])
        for row in mine:
            measured = data[np.argmin(abs(data[:, 0] - row.rate)), 1]
            print(f"{describe(row)}; data {measured:.4f}: "
                  f"{100 * (row.frequency / measured - 1):+.0f} %")
    axis.set_xscale("log")
    axis.set_xlabel("shear rate / (1/s)")
    axis.set_ylabel("revolutions per strain")
    axis.set_ylim(0, 0.07)
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def draw_inclination(rows, path):
    data = reference("03c_rbc_inclination_fischer2015.csv")
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.4))
    for n, medium in enumerate(INCLINATION):
        theirs = data[data[:, 0] == medium]
        left.errorbar(theirs[:, 1], theirs[:, 2],
                      [theirs[:, 2] - theirs[:, 3], theirs[:, 4] - theirs[:, 2]],
                      fmt="o", mfc="none", color=f"C{n}", capsize=2,
                      label=f"Fischer 2015, {medium} mPa s: mean, range over donors")
        mine = [row for row in rows if row.part == "inclination" and row.medium == medium]
        left.plot([row.rate for row in mine], [row.inclination for row in mine], "s-",
                  color=f"C{n}", label=f"here, {medium} mPa s")
        for row in mine:
            near = theirs[np.argmin(abs(np.log(theirs[:, 1] / row.rate)))]
            print(f"{describe(row)}; data {near[2]:.1f} ({near[3]:.1f} to {near[4]:.1f})")
    left.set_xscale("log")
    left.set_xlabel("shear rate / (1/s)")
    left.set_ylabel("inclination / degrees")
    left.set_ylim(0, 25)

    stress = reference("03d_tt_tb_threshold.csv")
    right.plot(stress[:, 0], stress[:, 1], "ok", mfc="none",
               label="Fischer 2013, Abkarian 2007: threshold")
    names = {"coarse": "here", "rounder": "free of stress in a rounder shape"}
    for shift, case in zip((1, 1.08), names):    # beside each other
        for n, (tumbling, label) in enumerate(((True, "tumbles"), (False, "tank-treads"))):
            mine = [row for row in rows if row.case == case and tumbles(row) == tumbling
                    and row.rate < 30]
            right.plot([row.medium * shift for row in mine],
                       [row.medium * row.rate * 1e-3 for row in mine], "xs"[n], ms=5,
                       color=f"C{3 - n}" if case == "coarse" else f"C{4 - 3 * n}",
                       mfc="none" if case == "rounder" else None, label=f"{names[case]}: {label}")
    for row in rows:
        if row.part == "threshold":
            print(f"{describe(row)}; {row.medium * row.rate * 1e-3:.3f} Pa")
    right.set_xscale("log")
    right.set_yscale("log")
    right.set_ylim(0.03, 30)
    right.set_xlabel("viscosity of the medium / (mPa s)")
    right.set_ylabel("shear stress / Pa")
    for axis in (left, right):
        axis.legend(fontsize=7, loc="upper right")
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--lmp", type=Path, default=HERE.parents[1] / "build" / "lmp_rbc")
    parser.add_argument("--part", action="append", choices=PARTS, help="measure this part only")
    parser.add_argument("--case", action="append", choices=[*CASES, *CONVERGENCE],
                        help="and of it this case only")
    parser.add_argument("--draw", action="store_true", help="do not run")
    options = command_line.parse(parser, HERE)
    if not options.draw:
        table = options.output / TABLE
        study = Study(options.lmp.resolve(), HERE.parents[1] / "potentials", table)
        for part in options.part or PARTS:
            write(table, [row for row in read(table) if row.part != part
                          or (options.case and row.case not in options.case)])
            PARTS[part](study, options.case)
    rows = read(command_line.kept(options.output, HERE, TABLE))
    draw_frequency(rows, options.output / "tank-treading.png")
    draw_inclination(rows, options.output / "inclination.png")
    for row in rows:
        if row.part == "convergence":
            print(describe(row))


if __name__ == "__main__":
    main()
