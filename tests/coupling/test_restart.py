"""Restart files and balanced subdomains: the fluid's history goes along."""

import unittest

import numpy as np

from lammps_case import SHEAR, dump_line, run, scene

DIAMETER = 7.82
REGIMES = ("inertia none", "inertia unsteady", "inertia convective",
           "inertia unsteady scheme projection", "inertia convective scheme projection", "direct")
BOX = dict.fromkeys(("units", "style", "newton", "boundary", "processors", "box", "create_box",
                     "cells"))
COLUMNS = "id mol type xu yu zu vx vy vz fx fy fz"


def case(regime, **changes):
    direct = regime == "direct"
    return dict(dict(
        before="variable U equal 0.0012*cos(step/10)" + ("\nmass 1 0.5" if direct else ""),
        fluid=SHEAR["fluid"].replace("inertia none", "inertia unsteady" if direct else regime)
        .replace("0.0012", "v_U"), ib=SHEAR["ib"] + (" scheme direct tol 1e-12" if direct else ""),
        dump=dump_line(10, columns=COLUMNS),
        thermo="thermo_style custom step f_flow[1] f_flow[7] f_flow[10] f_flow[12] f_mem",
        run="run 40"), **changes)


def continued(file, regime, **changes):
    return scene(**{**case(regime), **BOX, "style": f"read_restart {file}", "run": "run 20",
                    **changes})


def ends(result, regime):
    """Without history the solves are counted anew."""
    return {column: values[-1] for column, values in result.thermo.items()
            if regime != "inertia none" or column != "f_flow[12]"}


class Restart(unittest.TestCase):
    def test_bit_for_bit_and_on_other_ranks(self):
        for regime in REGIMES:
            for ranks, later in ((1, 1), (2, 2), (4, 4), (2, 1), (1, 4)):
                with self.subTest(regime, ranks=ranks, later=later):
                    lines = case(regime)
                    whole = run(
                        scene(**{**lines, "dump": None, "run": "run 20\nwrite_restart r.restart\n" +
                                 lines["dump"] + "\nrun 20"}), ranks)
                    after = run(continued(whole.path("r.restart"), regime), later)
                    a, b = whole.dump(), after.dump()
                    self.assertEqual(b.steps, [20, 30, 40])
                    if ranks == later:
                        np.testing.assert_array_equal(b.frames, a.frames)
                        self.assertEqual(ends(after, regime), ends(whole, regime))
                        continue
                    for n in range(3):
                        np.testing.assert_allclose(b.positions(n), a.positions(n), rtol=0,
                                                   atol=1e-13 * DIAMETER)
                    for column, value in ends(whole, regime).items():
                        if regime != "direct" or column != "f_flow[12]":    # a count of iterations
                            np.testing.assert_allclose(ends(after, regime)[column], value,
                                                       rtol=1e-9)

    def test_files_of_the_restart_command_from_any_step(self):
        # in one script; the first two steps of a flow are halved
        for regime in REGIMES:
            with self.subTest(regime):
                lines = case(regime, dump=dump_line(1, columns=COLUMNS), run="restart 1 r.*\nrun 5",
                             neighbor=SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no")
                script = scene(**lines)
                for step in range(1, 5):
                    script += "clear\n" + continued(f"r.{step}", regime, neighbor=lines["neighbor"],
                                                    run="run 5 upto",
                                                    dump=dump_line(1, f"after{step}.dump", COLUMNS))
                result = run(script)
                whole = result.dump().frames
                for step in range(1, 5):
                    np.testing.assert_array_equal(result.dump(f"after{step}.dump").frames[1:],
                                                  whole[step + 1:])

    def test_a_fluid_alone(self):
        for regime in REGIMES[:-1]:
            with self.subTest(regime):
                lines = case(
                    regime, cells="mass 1 1", molecule=None, membrane=None, ib=None, dump=None,
                    thermo="thermo_style custom step f_flow[1] f_flow[7] f_flow[10] f_flow[12]",
                    timestep="timestep 0.5", run="run 10\nwrite_restart r\nrun 10")
                first = run(scene(**lines), 2)
                again = {**lines, **BOX, "style": f"read_restart {first.path('r')}",
                         "run": "run 10"}
                after = run(scene(**again), 2)
                self.assertEqual(ends(after, regime), ends(first, regime))

    def test_another_ID_starts_from_rest(self):
        whole = run(scene(**case("inertia unsteady", run="run 20\nwrite_restart r.restart")))
        lines = {name: line.replace("flow", "other") if isinstance(line, str) else line
                 for name, line in case("inertia unsteady").items()}
        after = run(scene(**{**lines, **BOX, "style": f"read_restart {whole.path('r.restart')}",
                             "run": "run 0"}))
        self.assertEqual(after.thermo["f_other[10]"][0], 0)
        self.assertEqual(after.thermo["f_other[12]"][0], 0)


class Balance(unittest.TestCase):
    """Subdomains that move within a run."""

    WAYS = {
        "balance": (dict(last="run 10\nbalance 1.0 x 0.3 z 0.6", run="run 30",
                         processors="processors 2 1 2"), 4),
        "fix balance": (dict(last="fix lb all balance 5 1.0 shift xz 5 1.0",
                             processors="processors * 1 *"), None),
        "rcb": (dict(style="atom_style molecular\ncomm_style tiled",
                     last="fix lb all balance 5 1.0 rcb"), None),
    }

    def test_agrees_with_one_rank(self):
        cells = "rbc/create rbc single 5.3 6.4 6.2 rotate 30 1 0.5 0"
        for regime in ("inertia unsteady", "inertia convective",
                       "inertia unsteady scheme projection", "direct"):
            reference = run(scene(**case(regime, cells=cells)))
            for name, (changes, only) in self.WAYS.items():
                for ranks in (only,) if only else (2, 4):
                    with self.subTest(regime, way=name, ranks=ranks):
                        result = run(scene(**case(regime, cells=cells, **changes)), ranks)
                        apart = abs(result.dump().positions() -
                                    reference.dump().positions()).max() / DIAMETER
                        print(
                            f"\n{regime}, {name}, {ranks} ranks: {apart:.2g} diameters from 1 rank")
                        self.assertLess(apart, 1e-12)
                        for column, value in ends(reference, regime).items():
                            if regime != "direct" or column != "f_flow[12]":
                                np.testing.assert_allclose(ends(result, regime)[column], value,
                                                           rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
