"""A run in pieces, or continued from a restart file, is that of one piece: bit for bit on the same
ranks.

test_exact_restart.py --all [words]

runs all combinations that the tables below make (those with the words in their names), and prints
how many failed. The environment is that of ctest (see helpers/lammps_case.py); a few of them run in
CI.
"""

import itertools
import struct
import sys
import unittest

from lammps_case import SHEAR, attempt, dump_line, in_parallel, run, scene

STEPS = 8    # of each half: estimates of the spectral radius are 5 steps apart at first

INTEGRATORS = {
    "euler": "euler", "midpoint": "midpoint", "ab2": "ab2", "rkc": "rkc 4", "rkc auto": "rkc auto",
    "rkc adapt": "rkc auto adapt 1e-4 200", "order 3": "rkc 4 order 3",
    "auto order 3": "rkc auto order 3", "adapt order 3": "rkc auto order 3 adapt 1e-4 200"}
PLATES = "wall zlo 0 0 0 wall zhi {} 0 0"
WALL = dict(
    boundary="boundary p p p", box="region box block 0 12 0 12 0 12\nlattice sc 1.0",
    create_box="create_box 2 box",
    walls="region slab block INF INF INF INF -0.1 0.1\ncreate_atoms 2 region slab")
BOUNDARIES = {"plates": {}, "walls": dict(WALL, wall="fix vessel wall rbc/wall flow"),
              "sheet walls": dict(WALL, wall="fix vessel wall rbc/wall flow sheets yes"),
              "moving walls": dict(WALL, wall="fix vessel wall rbc/wall flow velocity v_U 0 0")}
MEMBRANES = {"elastic": "volume yes", "viscous": "volume yes viscosity 0.5",
             "thinning": "volume yes viscosity 0.5 thinning 0.1 0.001",
             "smooth": "volume yes smooth yes", "inside": "volume yes interior 7.5 viscosity 0.5",
             "filled": "volume yes interior 7.5"}
CONTACTS = {"no contact": "", "contact": "pair_style rbc/jkr 0.6\npair_coeff * * none\n"
            "pair_coeff 1 1 adhesive 0.0628 1.0e-3 0.3",
            "boundaries": "region between block INF INF INF INF 0 12\n"
                          "pair_style rbc/jkr 2.6 units dx BOUNDARIES\n"
            "pair_coeff * * none\npair_coeff 1 1 repulsive 0.02 2.6"}
CONTROLS = {"driven": "body 1e-5 0 0", "mean x": "mean x 0.001"}
INERTIA = ("unsteady", "convective", "unsteady scheme projection", "direct")

STEADY = list(itertools.product(INTEGRATORS, BOUNDARIES, MEMBRANES, CONTACTS, CONTROLS))
UNSTEADY = list(itertools.product(("euler", "midpoint"), INERTIA, CONTACTS))

# Which of them run in CI.
FEW = [("euler", "plates", "elastic", "contact", "mean x"),
       ("ab2", "walls", "viscous", "no contact", "mean x"),
       ("midpoint", "walls", "thinning", "contact", "driven"),
       ("rkc auto", "walls", "elastic", "contact", "mean x"),
       ("rkc adapt", "plates", "viscous", "contact", "mean x"),
       ("rkc", "moving walls", "elastic", "contact", "driven"),
       ("midpoint", "sheet walls", "elastic", "contact", "mean x"),
       ("adapt order 3", "moving walls", "elastic", "no contact", "driven"),
       ("order 3", "plates", "thinning", "contact", "driven"), ("midpoint", "direct", "contact"),
       ("rkc auto", "plates", "smooth", "contact", "driven"),
       ("rkc adapt", "plates", "inside", "contact", "driven"),
       ("midpoint", "walls", "inside", "no contact", "mean x"),
       ("midpoint", "plates", "filled", "contact", "driven"),
       ("rkc auto", "plates", "filled", "contact", "mean x"),
       ("rkc auto", "plates", "elastic", "boundaries", "driven"),
       ("midpoint", "walls", "elastic", "boundaries", "mean x")]


def lines(combination):
    """What the combination changes of a scene of two cells."""
    integrator, *more = combination
    inertia = more[0] if more[0] in INERTIA else "none"
    boundary = BOUNDARIES.get(more[0], {})
    membrane = MEMBRANES[more[1]] if inertia == "none" else "volume yes"
    contact = CONTACTS[more[2] if inertia == "none" else more[1]]
    control = CONTROLS[more[3]] if inertia == "none" else "body 1e-5 0 0"
    direct = inertia == "direct"
    plates = "" if boundary else PLATES.format("v_U")
    walls = "f_vessel[1] f_vessel[4] f_vessel[7] f_vessel[8]" if boundary else "f_flow[1] f_flow[4]"
    order = "units newton style boundary processors box create_box molecule cells walls mass"
    base = dict(SHEAR, walls="", mass="mass * 0.5")
    created = {name: boundary.get(name, base[name]) for name in order.split()}
    if boundary:
        created["create_box"] += " angle/types 1"
    created["cells"] = ("rbc/create rbc single 5.2 6 4.8 rotate 30 1 0 0\n"
                        "rbc/create rbc single 6.6 6.3 7.2 rotate 25 0.5 1 0")
    common = dict(
        groups="group cells type 1" + ("\ngroup wall type 2" if boundary else ""),
        variable="variable U equal 0.0012*cos(step/10)",
        neighbor="neighbor 1.0 bin\nneigh_modify every 1 delay 0 check no" +
        (" exclude group wall all" if boundary else "") +
        "\ncomm_modify cutoff 5.5\natom_modify sort 0 0.0",
        membrane="fix mem cells rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 " +
        membrane,
        contact=contact.replace("BOUNDARIES", "walls between" if boundary else "plates yes"),
        fluid=f"fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 inertia"
              f" {'unsteady' if direct else inertia} {plates} {control}",
        ib=f"fix ib cells rbc/ib flow integrator {INTEGRATORS[integrator]}" +
        (" scheme direct" if direct else ""),
        wall=boundary.get("wall", ""),
        thermo="thermo_style custom step pe f_mem f_mem[5] f_flow[7] f_flow[10] f_flow[13] "
               "f_flow[19] f_ib[1] f_ib[5]"
               f" f_ib[6] f_ib[7] f_ib[9] {walls}\nthermo_modify format float %.17g\n"
               f"thermo {STEPS}",
        timestep="timestep 100")
    return created, common


def script(combination):
    """Three runs: of one piece, in two, and the second one from the restart file between them."""
    created, common = lines(combination)

    def dump(name):
        return dump_line(2 * STEPS, name, "id xu yu zu vx vy vz fx fy fz")

    begin = scene({**created, **common})
    return (f"{begin}{dump('whole')}\nrun {2 * STEPS}\nclear\n"
            f"{begin}{dump('pieces')}\nrun {STEPS}\nwrite_restart r\nrun {STEPS}\nclear\n"
            f"read_restart r\n{SHEAR['molecule']}\n{scene(common)}{dump('after')}\nrun {STEPS}\n")


def flaw(combination, ranks):
    """What differs, or nothing."""
    result = attempt(script(combination), ranks)
    if result.code:
        return result.error or result.printed
    tables = result.tables()
    whole = result.dump("whole")
    found = []
    for name, table in (("pieces", tables[2]), ("after", tables[3])):
        ends = result.dump(name)
        for first, what in ((1, "positions"), (4, "velocities"), (7, "forces")):
            apart = abs(ends.frames[-1][:, first:first + 3] -
                        whole.frames[-1][:, first:first + 3]).max()
            if apart != 0:
                found.append(f"{name}: {what} {apart:.2g}")
        found += [f"{name}: {column} {values[-1]:.6g} {values[-1] - tables[0][column][-1]:.2g}"
                  for column, values in table.items() if values[-1] != tables[0][column][-1]]
    return ", ".join(found)


class ExactRestart(unittest.TestCase):
    def test_a_few_combinations(self):
        cases = list(itertools.product(FEW, (1, 2)))
        for (combination, ranks), found in zip(cases, in_parallel(flaw, cases)):
            with self.subTest(combination, ranks=ranks):
                self.assertEqual(found, "")


class OtherRanks(unittest.TestCase):
    def test_walls_go_on_to_round_off(self):
        # forces and directions find their atoms: without them the first evaluation is off by a part
        # of tol, 1e-3
        combination = ("rkc auto", "walls", "elastic", "no contact", "mean x")
        for ranks, later in ((2, 1), (1, 4)):
            whole = run(script(combination), ranks)
            dump = dump_line(2 * STEPS, "after", "id xu yu zu vx vy vz")
            after = run(f"read_restart {whole.path('r')}\n{SHEAR['molecule']}\n"
                        f"{scene(lines(combination)[1])}{dump}\n"
                        f"run {STEPS}\n", later).dump("after").frames[-1]
            apart = abs(after[:, 1:4] - whole.dump("whole").frames[-1][:, 1:4]).max()
            print(f"\n{ranks} ranks, then {later}: {apart:.2g} um apart")
            self.assertLess(apart, 1e-11)


class OtherLayouts(unittest.TestCase):
    """Restart files in which fix rbc/ib keeps other numbers than now: 2 of scheme direct, then 13
    of the steps."""

    LINES = dict(ib=SHEAR["ib"].replace("midpoint", "rkc 4 order 3"), timestep="timestep 100",
                 neighbor=SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no")
    NUMBERS = 16
    BLOCK = struct.pack("<id", 8 * NUMBERS, -1)

    def continued(self, file):
        again = {**self.LINES,
                 **dict.fromkeys(("style", "boundary", "box", "create_box", "cells", "units"))}
        return attempt(f"read_restart {file}\n" + scene(**again, dump=dump_line(10), run="run 10"))

    def test_of_before_and_of_a_later_version(self):
        whole = run(scene(**self.LINES, run=f"run 10\nwrite_restart r\n{dump_line(10)}\nrun 10"))
        data = whole.path("r").read_bytes()
        self.assertEqual(data.count(self.BLOCK), 1)
        at = data.index(self.BLOCK)
        end = at + 4 + 8 * self.NUMBERS
        numbers = struct.unpack(f"<{self.NUMBERS}d", data[at + 4:end])
        self.assertEqual(numbers[1:9], (0, 0, 100, 0, 10, 100, 100, 100))
        apart = {}
        before = numbers[1:5] + numbers[6:9]
        for name, kept in (("before", before), ("no past", (0,) * 7),
                           ("later", (-2,) * self.NUMBERS)):
            block = struct.pack(f"<i{len(kept)}d", 8 * len(kept), *kept)
            file = whole.path(name.replace(" ", "_"))
            file.write_bytes(data[:at] + block + data[end:])
            after = self.continued(file)
            if name == "later":
                self.assertIn("Fix rbc/ib ib: the restart file is of a later version of this "
                              "package", after.error)
                continue
            self.assertEqual(after.code, 0, after.printed)
            apart[name] = abs(after.dump().positions() - whole.dump().positions()).max()
        print(f"\nfrom the run of one piece: {apart}")
        self.assertLess(apart["before"], 1e-12)
        self.assertGreater(apart["no past"], 1e-9)


def run_all(words):
    cases = [case for case in itertools.product(STEADY + UNSTEADY, (1, 2))
             if all(word in ", ".join(case[0]) for word in words)]
    if not cases:
        sys.exit(f"no combination has {words} in its name")

    def report(combination, ranks):
        found = flaw(combination, ranks)
        if found:
            print(f"{', '.join(combination)}, {ranks} ranks: {found}", flush=True)
        return bool(found)

    failures = sum(in_parallel(report, cases))
    print(f"{len(cases)} combinations, {failures} failures")
    return failures > 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--all"]:
        sys.exit(run_all(sys.argv[2:]))
    unittest.main()
