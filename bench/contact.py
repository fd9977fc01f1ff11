#!/usr/bin/env python3
"""Time of pair rbc/jkr for 512 red cells of 162 vertices on one core, per evaluation and per search
of near triangles.

The cells lie in 8 x 8 x 8 places, side by side and face to face, slightly turned, at a volume
fraction of 0.5; more than a quarter of their surface is in contact. They stay where they are:
evaluations are all alike, and with `check no` each step begins with a search. Times are processor
time of the run (which a busy machine changes less than wall time) less that of the same run without
the pair style: more ghost atoms count in. Writes contact.csv to a folder. The executable comes from
the environment (LMP_RBC).
"""
import csv
import resource
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = str(HERE.parent / "tests" / "helpers"), str(HERE.parent / "scripts")
from rbc import command_line  # noqa: E402
from lammps_case import POTENTIALS, run  # noqa: E402

SCRIPT = """
units           micro
atom_style      molecular
boundary        p p p
variable        n equal 8
variable        wide equal 8.2
variable        high equal 2.75
region          box block 0 $(v_n*v_wide) 0 $(v_n*v_wide) 0 $(v_n*v_high)
create_box      1 box angle/types 1
molecule        rbc %(potentials)s/rbc_162.mol
variable        i loop 8
label           next_i
variable        j loop 8
label           next_j
variable        k loop 8
label           next_k
rbc/create      rbc single $(v_wide*(v_i-0.5)) $(v_wide*(v_j-0.5)) $(v_high*(v_k-0.5)) &
                rotate 3 $(v_i-4.2) $(v_j-3.1) 0
next            k
jump            SELF next_k
next            j
jump            SELF next_j
next            i
jump            SELF next_i
neighbor        0.5 bin
neigh_modify    every 1 delay 0 check %(check)s
%(pair)s
fix             membrane all rbc/membrane rbc neo-hookean 1e-30 volume no
thermo          1000
run             %(steps)d
"""
ADHESIVE = ("pair_style rbc/jkr 0.4\npair_coeff 1 1 adhesive 0.0628 1e-3 0.3\n"
            "compute contact all pair rbc/jkr\n"
            "thermo_style custom step c_contact[1]")
CASES = {
    "repulsive": "pair_style rbc/jkr 0.3\npair_coeff 1 1 repulsive 0.0628 0.3",
    "adhesive": ADHESIVE,
}
VERTICES = 512 * 162
REPEATS = 3


def processor_time():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def per_step(pair, check, few, many):
    """Median of the processor time of a step, and the last run."""
    times = []
    for _ in range(REPEATS):
        used = []
        for steps in (few, many):
            before = processor_time()
            result = run(SCRIPT % {"potentials": POTENTIALS, "pair": pair, "check": check,
                                   "steps": steps},
                         timeout=1200)
            used.append(processor_time() - before)
        times.append((used[1] - used[0]) / (many - few))
    return statistics.median(times), result


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    arguments = command_line.parse(parser, HERE, ["LMP_RBC"])
    rows = []
    for check, few, many, what in (("yes", 5, 85, "evaluation"),
                                   ("no", 2, 12, "search and evaluation")):
        base, _ = per_step("", check, few, many)
        for name, pair in CASES.items():
            seconds, result = per_step(pair, check, few, many)
            rows.append([name, what, seconds - base, 1e6 * (seconds - base) / VERTICES])
            print("{:10} {:22} {:6.1f} ms, {:.3f} us per vertex".format(
                name, what, 1e3 * rows[-1][2], rows[-1][3]), flush=True)
    print(f"area in contact: {2 * result.thermo['c_contact[1]'][-1] / 512:.1f} um^2 of each cell")
    with open(arguments.output / "contact.csv", "w", encoding="utf-8", newline="") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(["pair", "what", "core_s", "us_per_vertex"])
        table.writerows([*row[:2], f"{row[2]:.4g}", f"{row[3]:.4g}"] for row in rows)


if __name__ == "__main__":
    main()
