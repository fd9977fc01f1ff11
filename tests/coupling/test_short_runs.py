"""What goes from run to run: the memory of the flow rate and of estimates, but not past what has
changed in between."""

import unittest

import numpy as np

from lammps_case import SHEAR, dump_line, run, scene
from test_exact_restart import STEPS, lines

HELD = 0.001
CHANNEL = dict(fluid=SHEAR["fluid"].replace("0.0012", "v_U") + f" mean x {HELD}",
               before="variable U equal 0.0012",
               thermo="thermo_style custom step f_flow[13] f_flow[19] f_flow[12]", every="thermo 1")


class ShortRuns(unittest.TestCase):
    def test_one_step_at_a_time(self):
        # what each step costs besides does not change the run
        for combination in (("rkc auto", "plates", "elastic", "contact", "mean x"),
                            ("midpoint", "walls", "elastic", "no contact", "mean x"),
                            ("ab2", "plates", "viscous", "no contact", "mean x")):
            with self.subTest(combination):
                created, common = lines(combination)
                ends = []
                for way in ("", "every 1 NULL"):
                    more = {"dump": dump_line(STEPS), "run": f"run {2 * STEPS} {way}"}
                    result = run(scene({**created, **common, **more}))
                    ends.append(result.dump().frames[-1])
                np.testing.assert_array_equal(*ends)

    def test_forces_of_later_fixes(self):
        # the setup of a run does not see them
        for integrator in ("midpoint", "rkc auto"):
            for fluid in (SHEAR["fluid"], SHEAR["fluid"] + f" mean x {HELD}"):
                with self.subTest(integrator, fluid=fluid):
                    common = dict(fluid=fluid, ib=SHEAR["ib"].replace("midpoint", integrator),
                                  before="atom_modify sort 0 0.0", neighbor="neighbor 1.0 bin\n"
                                                                            "neigh_modify every 1 "
                                                                            "delay 0 check no",
                                  last="fix push all addforce 1e-4 0 5e-5", dump=dump_line(STEPS))
                    ends = [run(scene(**common, run=pieces)).dump().frames[-1]
                            for pieces in (f"run {2 * STEPS}", f"run {STEPS}\nrun 0\nrun {STEPS}")]
                    np.testing.assert_array_equal(*ends)

    def test_no_probes_but_in_the_first_run(self):
        solves = run(scene(**CHANNEL, ib="fix ib all rbc/ib flow integrator euler",
                           run="run 1\nrun 1\nrun 0\nrun 1")).thermo["f_flow[12]"]
        np.testing.assert_array_equal(np.diff(solves), [1, 1, 1, 1, 1, 1])

    def test_a_plate_that_jumps_between_runs_is_probed_anew(self):
        # the held velocity is right from the setup on, and in the steps after it
        for change in ("variable U equal 0.05", "variable U equal -0.02*cos(step)"):
            thermo = run(scene(**{**CHANNEL, "cells": "mass 1 1", "molecule": None,
                                  "membrane": None, "ib": None},
                               run=f"run 3\n{change}\nrun 3")).thermo
            with self.subTest(change):
                np.testing.assert_allclose(thermo["f_flow[13]"][3:5], HELD, rtol=1e-9)

    def test_what_becomes_stiff_between_runs(self):
        # springs that hold the vertices where they are change no velocity, only how fast they relax
        for steps in (1, 3):
            result = run(scene(ib=SHEAR["ib"].replace("midpoint", "rkc auto"), every="thermo 1",
                               timestep="timestep 20", thermo="thermo_style custom step f_ib[6]",
                               run=f"run {steps}\nrun 1\nfix hold all spring/self 1\nrun 2\n"
                                   "unfix hold\nrun 1"))
            radius = [table["f_ib[6]"] for table in result.tables()]
            with self.subTest(steps=steps):
                self.assertEqual(radius[1][-1], radius[0][-1])
                self.assertGreater(radius[2][1], 2 * radius[1][-1])
                self.assertEqual(radius[2][2], radius[2][1])


class FluidAlone(unittest.TestCase):
    """Walls of atoms and the flow rate, without cells."""

    def test_bit_for_bit(self):
        for ranks in (1, 2):
            created, common = lines(("euler", "walls", "elastic", "no contact", "mean x"))
            dropped = dict.fromkeys(("cells", "membrane", "ib", "groups", "contact"))
            table = ("thermo_style custom step f_flow[7] f_flow[10] f_flow[13] f_flow[19] "
                     "f_vessel[1] f_vessel[4] f_vessel[7]")
            common = {**common, **dropped, "groups": "group wall type 2", "thermo_": "thermo 5",
                      "thermo": f"{table}\nthermo_modify format float %.17g",
                      "fluid": common["fluid"].replace("mean x 0.001", "mean x v_U")}
            begin, again = scene({**created, **common, "cells": None}), scene(common)
            result = run(f"{begin}run 10\nclear\n{begin}run 5\nwrite_restart r\nrun 5\nclear\n"
                         f"read_restart r\n{again}run 5\n", ranks)
            whole, _, pieces, after = result.tables()
            for name, table in (("pieces", pieces), ("after", after)):
                with self.subTest(name, ranks=ranks):
                    for column, values in whole.items():
                        self.assertEqual(table[column][-1], values[-1], column)


class TimestepAfterRestart(unittest.TestCase):
    """With adapt a timestep command after read_restart says nothing: the file holds the next
    timestep."""

    def test_changes_nothing(self):
        for adapt in ("ab2 adapt 1e-4 200", "rkc auto adapt 1e-4 200", "midpoint adapt 1e-4 200"):
            ib = f"fix ib all rbc/ib flow integrator {adapt}"
            ends = ("dump atoms all custom 10 {} id xu yu zu vx vy vz\n"
                    "dump_modify atoms sort id format float %.17g")
            script = scene(ib=ib, timestep="timestep 10", last=ends.format("one"),
                           neighbor=SHEAR["neighbor"] +
                           "\nneigh_modify every 1 delay 0 check no",
                           run="run 10\nwrite_restart r\nrun 10")
            lines_after = dict.fromkeys(("units", "style", "boundary", "box", "create_box",
                                         "cells"))
            timesteps = ("", "timestep 1", "timestep 150")
            for n, timestep in enumerate(timesteps):
                script += "clear\nread_restart r\n" + scene(
                    **{**lines_after, "ib": ib, "timestep": timestep,
                       "last": ends.format(f"after{n}"),
                       "neighbor": SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no",
                       "run": "run 10"})
            result = run(script)
            whole = result.dump("one").frames
            for n, timestep in enumerate(timesteps):
                with self.subTest(adapt, timestep=timestep):
                    after = result.dump(f"after{n}").frames
                    np.testing.assert_array_equal(after[0], whole[1])
                    np.testing.assert_array_equal(after[1], whole[2])


if __name__ == "__main__":
    unittest.main()
