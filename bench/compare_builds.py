"""Compares two executables lmp_rbc: the thermo output of many scenes, or the instructions of one.

usage: compare_builds.py <before> <now> [--only word ...] [--ranks n ...] [--steps n]
       compare_builds.py <before> <now> --instructions [scene]

Scenes are those of examples/, with meshes, grids and numbers of cells that take seconds, and small
ones of all that these do not use. Each column of the output, which has a line for every step, is
compared relative to its largest value. The script ends with 1 if a difference is above LIMIT, if a
run fails or if the columns differ.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOP / folder) for folder in ("tests/helpers", "tests/scenes", "scripts")]

from rbc import command_line
import numpy as np
from lammps_case import ENVIRONMENT, ROOT, SHEAR, attempt, in_parallel, scene
from scene_case import example_script

LIMIT = 1e-12
# What is zero but for round-off is compared with a number of the size of its terms: traction across
# the flow, divergence, sum of inner forces.
ROUND_OFF = {"f_flow[5]": 1e-4, "f_flow[11]": 1.0, "f_ib[1]": 1e-3}

SCRIPTS = ROOT / "scripts"
# Variables of the input scripts of examples/.
EXAMPLES = {
    "balloon": dict(shape="capsule_162", dx=0.25, box=4.5, stretch=1.5, timestep=0.06),
    "bifurcation": dict(dx=1.0, hematocrit=0.1, scripts=SCRIPTS),
    "capsule-channel": dict(shape="capsule_642", cells=10, length=4),
    "capsule-shear": dict(shape="capsule_162", dx=0.25, length=5, gap=5),
    "cell-statistics": dict(cells=4),
    "contrast": dict(shape="capsule_162", dx=0.25, length=5, gap=5),
    "doublet": dict(shape="rbc_162", dx=1.0),
    "fahraeus": dict(diameter=12, length=9.6, hematocrit=0.16, shape="rbc_162", dx=0.8),
    "relaxation": dict(shape="rbc_162", patch=3.3, dx=1, width=12, timestep=2000),
    "rouleau": dict(rates=100, shape="rbc_162", dx=1.0, cells=4),
    "settling-sphere": dict(cells=18, timestep=0.02),
    "shear-cell": dict(shape="rbc_162", dx=1.0),
    "stiff": dict(shape="rbc_162", dx=1.0, box=16, timestep=200),
    "stretch": dict(load=15.987, shape="rbc_162", patch=3.3, dx=1.0, width=12),
    "suspension": dict(shape="rbc_162", cells=16, gap=16, dx=0.8, hematocrit=0.35, every=1),
    "suspension-shear": dict(shape="rbc_162", cells=8, dx=0.8),
    "tank-treading": dict(shape="rbc_162", dx=1.0, height=14, width=12),
    "throat": dict(shape="rbc_162", length=4, width=2, hematocrit=0.15, dx=0.8, gradient=1e5,
                   rate=150, step=0.02, error=5e-3, scripts=SCRIPTS),
    "tube-poiseuille": dict(shape="rbc_162", diameter=14, length=12, hematocrit=0.15, dx=0.8)}

COLUMNS = ("thermo_style custom step time dt f_mem f_mem[1] f_mem[2] f_mem[5]"
           " f_flow f_flow[1] f_flow[3] f_flow[5] f_flow[7] f_flow[10] f_flow[12]"
           " f_ib[1] f_ib[4] f_ib[5] f_ib[6] f_ib[7] f_ib[8]"
           " c_cell[1][2] c_cell[1][4] c_cell[1][5] c_cell[1][6] c_cell[1][7]")
CELL = dict(thermo=COLUMNS, compute="compute cell all rbc/cell")
FLUID = "fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 "
IB = "fix ib all rbc/ib flow kernel peskin4 "


def shear(ib="", inertia="none", membrane="", **changes):
    """One cell of 162 vertices between plates."""
    fluid = SHEAR["fluid"].replace("inertia none", f"inertia {inertia}")
    lines = dict(CELL, fluid=fluid, ib=IB + ib, membrane=SHEAR["membrane"] + " " + membrane)
    if inertia != "none":
        lines["timestep"] = "timestep 1"
    return scene(**{**lines, **changes})


TUBE = dict(boundary="boundary p p p", box="region box block 0 14 0 20 0 20",
            create_box="create_box 2 box angle/types 1\nregion tube cylinder x 10 10 7 INF INF",
            cells="rbc/create rbc single 6 10.5 10 rotate 50 0 1 0 type 1\n"
                  "rbc/surface tube type 2 spacing 1.2 offset 0.381\n"
                  "group cells type 1\ngroup wall type 2",
            before="neigh_modify exclude group wall wall",
            compute="compute cell cells rbc/cell\nfix wall wall rbc/wall flow",
            thermo=COLUMNS + " f_flow[13] f_flow[16] f_flow[19]"
                             " f_wall[1] f_wall[5] f_wall[7] f_wall[8]")


def tube(drive, ib="integrator rkc auto", membrane="", wall=""):
    """The cell in a tube of atoms."""
    return scene(**{**CELL, **TUBE, "ib": f"fix ib cells rbc/ib flow {ib}",
                    "membrane": SHEAR["membrane"].replace("all", "cells") + " " + membrane,
                    "compute": TUBE["compute"] + " " + wall, "timestep": "timestep 50",
                    "fluid": FLUID + drive})


# Two cells that adhere and are pressed onto each other, and each onto itself.
CONTACT = dict(
    cells="rbc/create rbc single 6 6 4.2\nrbc/create rbc single 6.4 6 7.2\ncomm_modify cutoff 6.0",
    before="pair_style rbc/jkr 0.6 self yes\npair_coeff 1 1 adhesive 0.07 1.0e-3 0.4\n"
           "variable push atom 1e-4*(6-z)\nfix squeeze all addforce 0 0 v_push",
    thermo=COLUMNS + " evdwl")
STIFF = SHEAR["membrane"].replace("0.257 0.0257", "25.7 2.57")
LAWS = ("fix mem all rbc/membrane rbc skalak 5.0e-3 10 bending 2.0e-4 0.0 dihedral crease 0.01 45"
        " stretch 0.005 1.1 area 1.0 0.05 volume 1.0")
MOVING = "variable U equal 0.0012*sin(2*PI*step*dt/4000)"
MASSES = "velocity all set 0 0 0\nmass 1 0.05"
REGIMES = {
    "euler": shear("integrator euler", timestep="timestep 50"),
    "midpoint": shear("integrator midpoint"),
    "ab2": shear("integrator ab2", timestep="timestep 50"),
    "rkc 5": shear("integrator rkc 5"),
    "rkc auto": shear("integrator rkc auto"),
    "rkc auto stiff": shear("integrator rkc auto").replace(SHEAR["membrane"], STIFF),
    "rkc 6 order 3": shear("integrator rkc 6 order 3"),
    "adapt": shear("integrator rkc auto adapt 1e-3 400 courant 2"),
    "adapt ab2": shear("integrator ab2 adapt 1e-3 100"),
    "adapt midpoint sheets no": shear("integrator midpoint adapt 1e-3 200 sheets no"),
    "roma3": shear("integrator midpoint").replace("peskin4", "roma3"),
    "plates that move": shear("integrator rkc 5", before=MOVING).replace("zhi 0.0012", "zhi v_U"),
    "no plates": shear("integrator midpoint", boundary="boundary p p p",
                       fluid=FLUID + "mean 1e-3 0 0"),
    "viscous midpoint": shear("integrator midpoint tol 1e-6", membrane="viscosity 50"),
    "viscous rkc auto": shear("integrator rkc auto", membrane="viscosity 300"),
    "thinning": shear("integrator midpoint", membrane="viscosity 300 thinning 30 1e-4"),
    "laws": shear("integrator rkc auto").replace(SHEAR["membrane"], LAWS),
    "swell": shear("integrator midpoint", membrane="swell 1.05"),
    "unsteady": shear("integrator midpoint", "unsteady"),
    "unsteady euler": shear("integrator euler", "unsteady"),
    "convective": shear("integrator midpoint", "convective"),
    "projection": shear("integrator midpoint", "convective scheme projection"),
    "unsteady projection": shear("integrator midpoint", "unsteady scheme projection"),
    "direct": shear("scheme direct tol 1e-8", "unsteady", before=MASSES),
    "direct convective euler": shear("scheme direct tol 1e-6 integrator euler", "convective",
                                     before=MASSES),
    "contact with itself": shear("integrator rkc auto", **CONTACT),
    "contact adapt": shear("integrator rkc auto adapt 1e-3 200", **CONTACT),
    "walls body": tube("body 5e-5 0 0"),
    "walls body inside": tube("inside tube body 5e-5 0 0", "integrator midpoint"),
    "walls body viscous": tube("body 5e-5 0 0", "integrator midpoint tol 1e-6", "viscosity 50"),
    "walls mean inside": tube("inside tube mean x 1e-3"),
    "walls mean vector": tube("mean 1e-3 0 0", "integrator ab2"),
    "walls mean inside adapt": tube("inside tube mean x 1e-3",
                                    "integrator rkc auto adapt 1e-3 100"),
    "walls that move": tube("mean 0 0 0", wall="velocity 1e-4 0 0")}


def shortened(script, steps):
    """The script with every run cut to some steps, and all numbers of each step printed."""
    every = f"thermo 1\nthermo_modify format float %.17g\nrun {steps}"
    return re.sub(r"^run .*$", every, script, flags=re.MULTILINE)


def scenes(steps):
    """Name -> script, of all that is compared."""
    found = {f"examples/{name}": shortened(example_script(name, **variables), steps)
             for name, variables in EXAMPLES.items()}
    return {**found, **{name: shortened(script, steps) for name, script in REGIMES.items()}}


def difference(before, now):
    """Number of columns, largest relative difference and its column; ValueError if unlike."""
    if len(before) != len(now):
        raise ValueError(f"{len(before)} runs before, {len(now)} now")
    worst, where, count = 0.0, "", 0
    for old, new in zip(before, now):
        if list(old) != list(new):
            raise ValueError(f"columns {sorted(set(old) ^ set(new))} are not in both")
        count = max(count, len(old))
        for name, numbers in old.items():
            if len(numbers) != len(new[name]):
                raise ValueError(f"{len(numbers)} lines before, {len(new[name])} now")
            scale = max(np.abs(numbers).max(), ROUND_OFF.get(name, 0.0))
            apart = np.abs(new[name] - numbers).max()
            relative = apart / scale if scale > 0 else np.inf if apart > 0 else 0.0
            if not relative <= worst:    # also if it is not a number
                worst, where = relative, name
    return count, worst, where


def compare(builds, names, all_ranks, steps):
    table = {name: script for name, script in scenes(steps).items()
             if not names or any(word in name for word in names)}
    cases = [(name, ranks) for name in table for ranks in all_ranks]
    results = []
    for build in builds:
        os.environ["LMP_RBC"] = str(build)
        results.append(in_parallel(lambda name, ranks: attempt(table[name], ranks, timeout=600),
                                   cases))
    bad = 0
    print(f"{'scene':32} {'ranks':>5} {'columns':>7} {'difference':>11}  column")
    for (name, ranks), before, now in zip(cases, *results):
        try:
            for label, result in (("before", before), ("now", now)):
                if result.code:
                    raise ValueError(f"{label}: {result.error or result.printed[-200:]}")
            count, worst, where = difference(before.tables(), now.tables())
            bad += not worst <= LIMIT
            above = "" if worst <= LIMIT else "  <-- above"
            print(f"{name:32} {ranks:5} {count:7} {worst:11.2g}  {where}{above}")
        except ValueError as error:
            bad += 1
            print(f"{name:32} {ranks:5} {'':7} {'':11}  {error}")
    print(f"{len(cases)} cases, {bad} of them differ by more than {LIMIT} or failed")
    return bad


def instructions(builds, name, steps=(10, 40)):
    """Instructions per step of one scene on one rank, by valgrind, from runs of two lengths."""
    scripts = [scenes(length)[name] for length in steps]
    counts = []
    for label, build in zip(("before", "now"), builds):
        found = [collected(build, script, Path(f"{label}{length}"))
                 for script, length in zip(scripts, steps)]
        counts.append((found[1] - found[0]) / (steps[1] - steps[0]))
        print(f"{label:8} {counts[-1]:15.0f} instructions per step, {found[0]} in all of"
              f" {steps[0]} steps: {name}")
    print(f"ratio    {counts[1] / counts[0]:.4f}")


def collected(build, script, folder):
    """Instructions of a whole run."""
    folder.mkdir(exist_ok=True)
    (folder / "in.case").write_text(script)
    done = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=callgrind.out", build,
         "-in", "in.case", "-log", "none"], cwd=folder, text=True, check=False,
        env={**os.environ, **ENVIRONMENT}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    found = re.search(r"Collected : (\d+)", done.stdout)
    if done.returncode or not found:
        print(done.stdout[-2000:])
        sys.exit(f"{build} does not run under valgrind, which knows no AVX-512: build it with"
                 " -D RBC_NATIVE=OFF")
    return int(found.group(1))


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("before", type=Path)
    parser.add_argument("now", type=Path)
    parser.add_argument("--only", nargs="+", default=[], help="words of the names of scenes")
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--instructions", nargs="?", const="rkc auto", metavar="scene")
    options = parser.parse_args()
    builds = [options.before.resolve(), options.now.resolve()]
    for build in builds:
        if not os.access(build, os.X_OK):
            parser.error(f"{build} is not an executable")
    os.environ.setdefault("MPIEXEC", "mpiexec")
    folder = Path(os.environ.get("BUILD", ".")) / "compare_builds"
    folder.mkdir(parents=True, exist_ok=True)
    os.chdir(folder)
    if options.instructions:
        instructions(builds, options.instructions)
    elif compare(builds, options.only, options.ranks, options.steps):
        sys.exit(1)


if __name__ == "__main__":
    main()
