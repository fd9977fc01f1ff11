#!/usr/bin/python3
"""Which hematocrits and shear rates run through with which kernel, and how viscous the blood is.
Runs in.blood over a strain of 5 for each (six minutes of processor time in all), writes blood.csv
to a folder. The series rbc_162, rbc_362 and rbc_642 are the same with these meshes, in smaller
boxes and with steps of one length, `rkc auto` without `adapt` (an hour in all): meshes.csv. Series
readme is the scene ../suspension-shear/in.plain, which was the README's, with these meshes:
readme.csv. Series scene is in.blood as it is, with a finer mesh and with cells that adhere, over a
strain of 10: scene.csv.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only roma3]
"""
import itertools
import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import example_study  # noqa: E402
from blood_study import settled  # noqa: E402
from rbc.tables import read_table  # noqa: E402

KERNELS = "roma3", "peskin4"
HEMATOCRITS = 0.2, 0.3, 0.4, 0.45
RATES = 10, 100, 1000    # 1/s
STRAIN = 5
COLUMNS = "strain", "viscosity", "volume", "again"

# fluid spacings, um: edges are 1.2 to 1.5 of them
MESHES = {"rbc_162": 0.65, "rbc_362": 0.5, "rbc_642": 0.4}
LENGTHS = {0.2: 18, 0.3: 16, 0.4: 14, 0.45: 14}               # of boxes with 8 to 12 cells, um
GAP = 12
MESH_COLUMNS = "through", *COLUMNS, "wrong", "warned"

SCENES = {"100 /s": {}, "100 /s rbc_362": {"shape": "rbc_362", "dx": 0.5}, "10 /s": {"rate": 10},
          "10 /s adhesion": {"rate": 10, "adhesion": 2e-4}}
SCENE_STRAIN = 10
SCENE_COLUMNS = "peak", "late", *COLUMNS[2:]

README_COLUMNS = "through", "strain", "again", "wrong", "warned"


def log_lines(printed):
    """The numbers of thermo_style in in.blood."""
    return [[float(word) for word in line.split()]
            for line in printed.splitlines() if re.match(r"^ +\d+( +\S+){10} *$", line)]


def warnings(printed):
    """Those of the table of the scene at its start."""
    return re.findall(r"^WARNING: Fix rbc/fluid flow: (.*) \(", printed, re.MULTILINE)


def print_why(done):
    """A run that stopped: what it had warned of, and its error."""
    print(*warnings(done.stdout), *re.findall(r"^ERROR.*", done.stdout, re.MULTILINE), sep="\n",
          flush=True)


def run_blood(arguments, variables):
    """Dictionary of MESH_COLUMNS and SCENE_COLUMNS; NaN for the viscosity of a run that stopped."""
    with tempfile.TemporaryDirectory() as folder:
        done = example_study.run_script(arguments, HERE / "in.blood", folder, variables)
        table = read_table(Path(folder) / "blood.dat")
    lines = log_lines(done.stdout)
    found = {"through": not done.returncode,
             **dict.fromkeys(("viscosity", "peak", "late"), float("nan")),
             "strain": table["v_sheared"][-1] if len(table["v_sheared"]) else 0,
             "volume": max(abs(line[7] / lines[0][7] - 1) for line in lines),
             "again": lines[-1][9], "wrong": lines[-1][10], "warned": bool(warnings(done.stdout))}
    if done.returncode:
        print_why(done)
    else:
        found["viscosity"] = settled(table, variables["strain"])
        found["peak"] = table["v_relative"].max()
        found["late"] = table["v_relative"][table["v_sheared"] > 0.5 * variables["strain"]].mean()
    return found


def measure(arguments, variables):
    """A row of COLUMNS."""
    found = run_blood(arguments, variables)
    return [[found[name] for name in COLUMNS]]


def measure_scene(arguments, variables):
    """A row of SCENE_COLUMNS."""
    found = run_blood(arguments, variables)
    return [[found[name] for name in SCENE_COLUMNS]]


def measure_mesh(arguments, variables):
    """A row of MESH_COLUMNS."""
    found = run_blood(arguments, variables)
    return [[found[name] for name in MESH_COLUMNS]]


def plain_scene(shape, dx, kernel, hematocrit, rate, length, lines=""):
    """The plain scene with other numbers, and further lines before its run."""
    scene = (HERE.parent / "suspension-shear" / "in.plain").read_text(encoding="utf-8")
    speed = rate * 1e-6 * GAP / 2
    for pattern, new in (
            (r"\.\./\.\./potentials/rbc_642", f"{example_study.POTENTIALS}/{shape}"),
            (r"dx 0\.5", f"dx {dx}"),
            (r"rbc/ib flow .*", f"rbc/ib flow kernel {kernel}"), (r"zlo -0\.0012", f"zlo -{speed}"),
            (r"zhi 0\.0012", f"zhi {speed}"),
            (r"block 0 24 0 24 0 24", f"block 0 {length} 0 {length} 0 {GAP}"),
            (r"number 27 (.*) overlap 0\.5", rf"hematocrit {hematocrit} \1 overlap 0.1"),
            (r"rbc/vtk 250", "rbc/vtk 1000000"),
            (r"timestep +200", f"timestep {min(0.02 / (rate * 1e-6), 1000)}"),
            (r"f_mem f_flow\[1\]", "f_mem f_ib[8] f_ib[10] f_flow[1]"), (r"thermo +50", "thermo 1"),
            (r"run +500", f"{lines}\nrun $(ceil({STRAIN}/({rate}*1e-6*dt)))")):
        scene, found = re.subn(pattern, new, scene)
        if found != 1:
            raise SystemExit(f"in.plain has {found} times {pattern}")
    return scene


def measure_readme(arguments, variables):
    """A row of README_COLUMNS."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "in.scene"
        script.write_text(plain_scene(**variables), encoding="utf-8")
        done = example_study.run_script(arguments, script, folder, {})
    if done.returncode:
        print_why(done)
    lines = [line.split()
             for line in done.stdout.splitlines() if re.match(r"^ +\d+( +\S+){7} *$", line)]
    last = [float(word) for word in lines[-1]]
    return [[not done.returncode, last[1] * variables["rate"] * 1e-6, last[3], last[4],
             bool(warnings(done.stdout))]]


def cases():
    for kernel, hematocrit, rate in itertools.product(KERNELS, HEMATOCRITS, RATES):
        yield (kernel, f"{kernel} {hematocrit:g} {rate}",
               {"kernel": kernel, "hematocrit": hematocrit, "rate": rate,
                "strain": STRAIN})


def scene_cases():
    for label, variables in SCENES.items():
        yield "scene", label, {**variables, "strain": SCENE_STRAIN}


def mesh_cases():
    for (mesh, dx), kernel, hematocrit, rate in itertools.product(MESHES.items(), KERNELS,
                                                                  HEMATOCRITS, RATES):
        yield mesh, f"{mesh} {kernel} {hematocrit:g} {rate}", {
            "shape": mesh, "dx": dx, "kernel": kernel, "hematocrit": hematocrit, "rate": rate,
            "length": LENGTHS[hematocrit]}


def blood_cases():
    """With steps of one length."""
    for mesh, label, variables in mesh_cases():
        yield (mesh, label,
               {**variables, "gap": GAP, "strain": STRAIN, "error": 0, "frames": 1000000})


def readme_cases():
    """The hardest ones with what dense blood needs, and all as they are."""
    include = f"include {example_study.POTENTIALS}/dense.blood"
    for _, label, variables in mesh_cases():
        if variables["hematocrit"] >= 0.4 and variables["rate"] != 100:
            yield "readme", f"{label} dense.blood", {**variables, "lines": include}
    for _, label, variables in mesh_cases():
        yield "readme", f"{label} as it is", variables


def main():
    arguments = command_line.parse(
        example_study.options(__doc__, [*KERNELS, "scene", *MESHES, "readme"]), HERE)
    for name, columns, runs, run in (("blood.csv", COLUMNS, cases(), measure),
                                     ("scene.csv", SCENE_COLUMNS, scene_cases(), measure_scene),
                                     ("meshes.csv", MESH_COLUMNS, blood_cases(), measure_mesh),
                                     ("readme.csv", README_COLUMNS, readme_cases(),
                                      measure_readme)):
        table = example_study.run_cases(arguments, arguments.output / name, columns, runs, run)
        for label, rows in table.items():
            print(f"{label:38}", *(f"{value:10.4g}" for value in rows[-1]))


if __name__ == "__main__":
    main()
