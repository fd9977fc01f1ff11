#!/usr/bin/python3
"""Error against solves of the integrators of fix rbc/ib, and the largest timestep at which each is
stable.

One red cell (642 vertices) in shear between plates, dx = 0.5 um, plasma, for a strain of 10, 2 and
1. The error is the root mean square distance of the vertices from those of a run with much shorter
steps, at ten times of equal distance (at a single time the error of a cell that turns may happen to
be small). A timestep is stable if nothing stops the run, and at its end, after 1000 steps or that
strain (but 60 steps at least), the elastic energy is not more than 1.5 times that of a stable run:
what is not stable crumples the membrane.
"""

import csv
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

POTENTIALS = HERE.parent / "potentials"

SCENE = """
units           micro
atom_style      molecular
boundary        p p f
region          box block 0 12 0 12 0 12
create_box      1 box angle/types 1
include         {potentials}/{material}.material
molecule        rbc {potentials}/rbc_642.mol
rbc/create      rbc single 6 6 6 rotate 45 0 1 0
neighbor        2.0 bin
variable        U equal {rate}*1e-6*6
variable        minus equal -v_U
fix             membrane all rbc/membrane rbc mooney-rivlin ${{C1}} ${{C2}} ${{h}} &
                bending ${{kappa}} area 0 {area} volume yes
fix             flow all rbc/fluid dx 0.5 viscosity ${{viscosity}} density ${{density}} &
                wall zlo ${{minus}} 0 0 wall zhi ${{U}} 0 0
fix             ib all rbc/ib flow kernel peskin4 integrator {integrator} courant 4 sheets no
compute         cell all rbc/cell
thermo_style    custom step time f_membrane
thermo          {steps}
dump            frames all custom {every} frames.dump id xu yu zu
dump_modify     frames sort id format float %.17g
timestep        {timestep:.17g}
run             {steps}
"""
# material, modulus of the local area, strain, fastest relaxation for a first guess (1/us)
MATERIALS = {
    "healthy": ("healthy", 0.0, 10, 0.0016), "area-stiff": ("healthy", 0.6, 2, 0.05),
    "paper-table2": ("paper-table2", 0.0, 1, 1.6)}
TARGETS = {"healthy": 1.5, "area-stiff": 2.5, "paper-table2": 20.0}
FRAMES = 10
FIELDS = ("material", "rate", "integrator", "timestep_us", "solves", "solves_per_ms", "error_um",
          "stable_limit_us")


class Cell:
    """One material at one shear rate."""

    def __init__(self, options, name, rate):
        self.options, self.name, self.rate = options, name, rate
        self.material, self.area, strain, self.fastest = MATERIALS[name]
        self.end = strain * 1e6 / rate
        self.unit = 1e6 / rate    # time of a strain of 1
        self.reference = None

    def run(self, integrator, timestep, end=None):
        """Positions at FRAMES times, elastic energy at the end, solves and the timestep, the
        largest up to that wanted with which the frames are on time, or None if the run stopped."""
        every = math.ceil((end or self.end) / timestep / FRAMES - 1e-9)
        steps = FRAMES * every
        timestep = (end or self.end) / steps
        script = SCENE.format(potentials=POTENTIALS, material=self.material, area=self.area,
                              rate=self.rate,
                              integrator=integrator, timestep=timestep, steps=steps, every=every)
        with open("in.integrators", "w", encoding="ascii") as stream:
            stream.write(script)
        printed = subprocess.run([self.options.lmp, "-in", "in.integrators", "-log", "none"],
                                 text=True, check=False, capture_output=True).stdout
        solves = re.search(r"(\d+) solves in", printed)
        rows = re.findall(r"^ +\d+ +\S+ +(\S+) *$", printed, re.MULTILINE)
        if not solves:
            return None
        with open("frames.dump", encoding="ascii") as stream:
            frames = stream.read().split("ITEM: ATOMS id xu yu zu\n")[2:]
        table = np.array([[line.split()[1:] for line in frame.split("ITEM")[0].splitlines()]
                          for frame in frames], dtype=float)
        return table, float(rows[-1]), int(solves.group(1)), timestep

    def limit(self, integrator, guess):
        """Largest stable timestep to 5 %."""
        def stable(timestep):
            end = max(min(1000 * timestep, self.end), 60 * timestep)
            result = self.run(integrator, timestep, end)
            return result is not None and result[1] < 1.5 * self.run("rkc auto", end / 100, end)[1]

        low = guess
        while not stable(low):
            low /= 1.5
        while stable(low * 1.05):
            low *= 1.05
        return low

    def error(self, positions):
        return np.sqrt(((positions - self.reference)**2).sum(2).mean())


def measure(options, rate, names):
    rows = []
    for name in names:
        cell = Cell(options, name, rate)
        cell.reference = cell.run("rkc auto order 3", cell.unit / 1600)[0]
        limits = {}
        for integrator, factor in (("euler", 1.9), ("midpoint", 1.9), ("ab2", 0.95), ("rkc 8", 40)):
            limits[integrator] = cell.limit(integrator, factor / cell.fastest)
        steps = [("euler", limits["euler"])]
        steps += [("midpoint", limits["midpoint"] / n) for n in (1, 4)]
        steps += [("ab2", limits["ab2"] / n) for n in (1, 4)]
        steps = [(i, t) for i, t in steps if cell.end / t < 3e5]
        steps += [(f"rkc auto{order}", cell.unit / n) for order in ("", " order 3") for n in
                  (10, 20, 30, 40, 50, 60, 70, 80, 100, 150, 200, 400)]
        for integrator, timestep in steps:
            result = cell.run(integrator, timestep)
            if result is None:
                continue
            positions, _, solves, timestep = result
            row = dict(
                zip(FIELDS, (name, rate, integrator, timestep, solves, 1e3 * solves / cell.end,
                             cell.error(positions), limits.get(integrator, ""))))
            print(row, flush=True)
            rows.append(row)
    return rows


def fewest(rows, name, rate, error):
    """Solves per physical ms of the cheapest run with no more than that error, and its row."""
    good = [row for row in rows if row["material"] == name and float(row["rate"]) == rate and
            float(row["error_um"]) <= error and row["integrator"] != "euler"]
    return min(good, key=lambda row: float(row["solves"])) if good else None


def summary(rows):
    lines = []
    for name, target in TARGETS.items():
        for rate in sorted({float(row["rate"]) for row in rows}):
            euler = next(
                (row for row in rows if row["material"] == name and row["integrator"] == "euler" and
                 float(row["rate"]) == rate), None)
            if not euler:
                continue
            best = fewest(rows, name, rate, float(euler["error_um"]))
            stable = min((row for row in rows if row["material"] == name
                          and float(row["rate"]) == rate),
                         key=lambda row: float(row["solves"]))
            ratio = float(euler["solves"]) / float(best["solves"]) if best else float("nan")
            lines.append(
                f"{name:13} {rate:5.0f}/s: euler {float(euler['timestep_us']):8.3g} us, "
                f"{float(euler['solves_per_ms']):8.4g} solves/ms, error "
                f"{float(euler['error_um']):.2g} um; "
                + (f"{best['integrator']} {float(best['timestep_us']):.4g} us, error "
                   f"{float(best['error_um']):.2g} um: "
                   f"{ratio:.1f} times fewer (target {target})" if best else "nothing as good")
                + f"; fewest of all {float(euler['solves']) / float(stable['solves']):.0f} times "
                f"({stable['integrator']} {float(stable['timestep_us']):.4g} us, error "
                  f"{float(stable['error_um']):.2g} um)")
    return lines


def draw(rows, path):
    rates = sorted({float(row["rate"]) for row in rows})
    figure, axes = plt.subplots(len(rates), 3, figsize=(13, 4 * len(rates)), squeeze=False)
    marks = {"euler": "ks-", "midpoint": "C0o-", "ab2": "C2^-", "rkc auto": "C1v-",
             "rkc auto order 3": "C3D-"}
    for across, rate in zip(axes, rates):
        for axis, name in zip(across, MATERIALS):
            for integrator, mark in marks.items():
                points = sorted((float(r["solves_per_ms"]), float(r["error_um"])) for r in rows if
                                r["material"] == name and r["integrator"] == integrator
                                and float(r["rate"]) == rate)
                if points:
                    axis.loglog(*zip(*points), mark, label=integrator, markersize=5)
            axis.set_title(f"{name}, {rate:g}/s")
            axis.set_xlabel("solves per physical ms")
            axis.set_ylabel("error / µm")
            axis.grid(alpha=0.3)
    axes[0][0].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--lmp", type=Path, default=HERE.parent / "build" / "lmp_rbc")
    parser.add_argument("--rates", type=float, nargs="+", default=[10, 100],
                        help="shear rates, 1/s")
    parser.add_argument("--materials", nargs="*", choices=MATERIALS, default=list(MATERIALS),
                        help="measured anew; what the table has of others stays")
    options = command_line.parse(parser, HERE)
    options.lmp = options.lmp.resolve()

    table = options.output / "integrators.csv"
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        new = [row for rate in options.rates for row in measure(options, rate, options.materials)]
    try:
        with open(table, encoding="ascii") as stream:
            rows = [row for row in csv.DictReader(stream)
                    if row["material"] not in options.materials
                    or float(row["rate"]) not in options.rates]
    except FileNotFoundError:
        rows = []
    with open(table, "w", newline="", encoding="ascii") as stream:
        writer = csv.DictWriter(stream, FIELDS)
        writer.writeheader()
        for row in rows + new:
            writer.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})
    with open(table, encoding="ascii") as stream:
        rows = list(csv.DictReader(stream))
    draw(rows, options.output / "integrators.png")
    print("\n".join(summary(rows)))


if __name__ == "__main__":
    main()
