#!/usr/bin/python3
"""A red cell in shear flow at several rates, in plasma and in a medium ten times as viscous, its
inside as viscous as the medium or five times as viscous as plasma: how shape and membrane turn, and
how far the cell is drawn out.

Runs in.shear-cell in a folder for each case, unless it is there, writes shear-cell.csv and prints
the table of the README.

study.py --output FOLDER [--folder runs] [--lmp ../../build/lmp_rbc] [--only p100 p100-inside]
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from rbc.membrane_motion import mean_motion, read_dump  # noqa: E402
from rbc.tables import read_ave_time  # noqa: E402

FLOWS = {"p10": {"rate": 10}, "p60": {"rate": 60}, "p100": {"rate": 100},
         "m60": {"rate": 60, "medium": 10}, "m100": {"rate": 100, "medium": 10}}
INSIDE = 7.4825          # five times the viscosity of plasma, mPa s
CASES = {**FLOWS, **{f"{name}-inside": {**flow, "inside": INSIDE} for name, flow in FLOWS.items()}}
START = 5                # strain from which means are taken


def measure(folder):
    """A row of numbers of a run."""
    rate, timestep, _ = np.loadtxt(folder / "scene.dat")
    strain = rate * 1e-6 * timestep
    steps, positions = read_dump(folder / "vertices.dump")
    motion = mean_motion(steps * strain, positions, START)
    cell = read_ave_time(folder / "cell.dat")
    area, volume, deformation = (cell.column(number)[:, 0] for number in (5, 6, 7))
    sheared = cell.steps * strain
    late = deformation[sheared >= min(START, sheared[-1] / 2)]
    return {"strain": steps[-1] * strain, "shape": motion["shape"], "membrane": motion["membrane"],
            "least_angle": motion["least"], "largest_angle": motion["largest"],
            "least_D": late.min(), "largest_D": late.max(), "least_area": area.min(),
            "largest_area": area.max(), "volume": abs(volume / volume[0] - 1).max()}


def print_table(rows):
    print("| shear rate, medium | inside | shape turns at | membrane turns at | angle of the shape "
          "| D | area / µm² | volume error |")
    print("|---" * 8 + "|")
    for name, row in rows.items():
        case = CASES[name]
        medium = f"medium {case['medium']}" if "medium" in case else "plasma"
        inside = "5 times plasma" if "inside" in case else "as the medium"
        tumbles = row["largest_angle"] - row["least_angle"] >= 180
        angle = "all" if tumbles else f"{row['least_angle']:.0f} to {row['largest_angle']:.0f}°"
        print(f"| {case['rate']} /s, {medium} | {inside} "
              f"| {row['shape']:+.3f} | {row['membrane']:+.3f} | {angle} "
              f"| {row['least_D']:.2f} to {row['largest_D']:.2f} "
              f"| {row['least_area']:.1f} to {row['largest_area']:.1f} | {row['volume']:.1e} |")


def main():
    parser = example_study.options(__doc__, CASES)
    example_study.add_runs_folder(parser)
    arguments = command_line.parse(parser, HERE)
    folder = example_study.runs_folder(arguments)
    rows = {name: measure(folder / name) for name, variables in CASES.items()
            if example_study.run_once(arguments, HERE / "in.shear-cell", folder / name, variables)}
    example_study.write_rows(rows, arguments.output / "shear-cell.csv")
    print_table(rows)


if __name__ == "__main__":
    main()
