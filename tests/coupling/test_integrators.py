"""Time integration of vertices in a fluid without inertia: orders, stability, stages, restart,
ranks, adaptive steps."""

import unittest

import numpy as np

from lammps_case import SHEAR, Failed, dump_line, in_parallel, run, scene

DIAMETER = 7.82
# smooth enough for orders in time to show
IB = "fix ib all rbc/ib flow kernel peskin4 sheets no "
COLUMNS = "id mol type xu yu zu vx vy vz fx fy fz"
STIFF = SHEAR["membrane"].replace("0.257 0.0257", "25.7 2.57")
VISCOUS = SHEAR["membrane"] + " viscosity 50"
THINNING = VISCOUS + " thinning 5 1e-4"    # half of the plates' rate of shear


def advance(ib, timestep, end=8000, **changes):
    """Result after a time `end`."""
    steps = round(end / timestep)
    return run(scene(**{**dict(ib=IB + ib, timestep=f"timestep {timestep}", every=f"thermo {steps}",
                               thermo="thermo_style custom step time f_mem f_flow[12] f_ib[5] "
                                      "f_ib[6] f_ib[7] f_ib[8]",
                               dump=dump_line(steps), run=f"run {steps}"), **changes}))


def apart(a, b):
    """Root mean square distance between the vertices at the end."""
    return np.sqrt(((a.dump().positions() - b.dump().positions())**2).sum(1).mean())


class Order(unittest.TestCase):
    """Of a cell's vertices after a strain of 0.8, against steps of 12.5 us by the method of third
    order."""

    def errors(self, ib, timesteps, **changes):
        reference = advance("integrator rkc 4 order 3" + ib[1], 12.5, **changes)
        ends = in_parallel(lambda t: advance(ib[0] + ib[1], t, **changes),
                           [(t,) for t in timesteps])
        return [apart(end, reference) for end in ends]

    def check(self, name, order, tolerance, timesteps=(200, 100, 50), options="", **changes):
        errors = self.errors((f"integrator {name}", options), timesteps, **changes)
        orders = np.log2(np.divide(errors[:-1], errors[1:]))
        print(f"\n{name}{options}: errors {errors}, orders {orders}")
        self.assertLess(abs(orders - order).max(), tolerance)

    def test_euler(self):
        self.check("euler", 1, 0.05, (100, 50, 25))

    def test_midpoint(self):
        self.check("midpoint", 2, 0.1, (100, 50, 25))

    def test_ab2(self):
        self.check("ab2", 2, 0.1)

    def test_rkc(self):
        self.check("rkc 4", 2, 0.1, (100, 50, 25))
        self.check("rkc auto", 2, 0.1, (100, 50, 25))

    def test_rkc_of_third_order(self):
        self.check("rkc 6 order 3", 3, 0.1, (160, 80, 40))

    def test_with_a_viscous_membrane(self):
        self.check("ab2", 2, 0.15, options=" tol 1e-9 maxiter 300", membrane=VISCOUS)

    def test_with_a_membrane_whose_viscosity_falls(self):
        for name in ("midpoint", "rkc 4"):
            self.check(name, 2, 0.15, options=" tol 1e-9 maxiter 300", membrane=THINNING)

    def test_with_plates_that_move_in_time(self):
        # the drive within a step is interpolated linearly
        self.check("rkc 5", 2, 0.15, before="variable U equal 0.0012*sin(6.283*time/32000)",
                   fluid=SHEAR["fluid"].replace("0.0012", "v_U"))


class Stability(unittest.TestCase):
    """A cell of a hundred times the healthy moduli."""

    def test_limits(self):
        # 2 over the spectral radius for euler and midpoint, half of it for ab2, 0.65 s^2 over it
        # for rkc s
        found = advance("integrator rkc auto", 50, 100, membrane=STIFF).thermo["f_ib[6]"][-1] / 1.06
        for ib, limit in (("euler", 2), ("midpoint", 2), ("ab2", 1), ("rkc 3", 5.22),
                          ("rkc 10", 64.6)):
            with self.subTest(ib):
                stable = limit / found
                advance(f"integrator {ib}", 0.9 * stable, 200 * stable, membrane=STIFF)
                with self.assertRaises(Failed) as stop:
                    advance(f"integrator {ib}", 1.25 * stable, 400 * stable, membrane=STIFF)
                self.assertRegex(stop.exception.result.error,
                                 "CFL above 1|inverted|inside out|not a number")

    def test_automatic_stages_follow_the_timestep(self):
        stages = []
        for timestep in (50, 200, 800):
            result = advance("integrator rkc auto", timestep, 8000, membrane=STIFF)
            thermo = result.thermo
            stages.append(thermo["f_ib[5]"][-1])
            stiffness = timestep * thermo["f_ib[6]"][-1]
            self.assertGreater(0.655 * stages[-1]**2, stiffness)
            self.assertLess(0.655 * (stages[-1] - 1.1)**2, stiffness)
        self.assertGreater(stages[-1], 3 * stages[0])

    def test_a_step_takes_as_many_solves_as_stages(self):
        for ib, solves in (("euler", 1), ("midpoint", 2), ("ab2", 1), ("rkc 7", 7)):
            thermo = advance(f"integrator {ib}", 100, 2000).thermo
            self.assertEqual(thermo["f_flow[12]"][-1] - thermo["f_flow[12]"][0], 20 * solves)


class Adaptive(unittest.TestCase):
    def test_error_follows_the_tolerance(self):
        # from rest the plates start to move: small steps at first
        reference = advance("integrator rkc 4 order 3", 12.5)
        errors = []
        for tolerance in (1e-4, 1e-5, 1e-6):
            result = run(scene(
                ib=IB + f"integrator rkc auto adapt {tolerance} 1000", timestep="timestep 1000",
                before="variable elapsed equal time", every="thermo 1",
                thermo="thermo_style custom step time dt f_ib[7] f_ib[8] f_ib[9]",
                dump=dump_line(1), run="fix halt all halt 1 v_elapsed > 8000 error soft\nrun 5000"))
            thermo, dump = result.thermo, result.dump()
            self.assertLessEqual(thermo["f_ib[7]"].max(), tolerance)
            # positions at the time of the reference, between the two steps around it
            last = np.searchsorted(thermo["Time"], 8000)
            before, after = thermo["Time"][last - 1], thermo["Time"][last]
            part = (8000 - before) / (after - before)
            where = (1 - part) * dump.positions(last - 1) + part * dump.positions(last)
            chord = abs(dump.positions(last) - dump.positions(last - 1)).max()**2 / DIAMETER
            errors.append(np.sqrt(((where - reference.dump().positions())**2).sum(1).mean()))
            steps = len(thermo["Time"])
            print(f"\ntolerance {tolerance}: error {errors[-1]}, {steps} steps, chord {chord}")
            self.assertLess(errors[-1], 20 * tolerance * steps + chord)
        self.assertLess(errors[2], errors[0] / 5)

    def test_a_first_step_too_long_is_taken_again(self):
        result = run(
            scene(ib=IB + "integrator midpoint adapt 1e-6 2000",
                  timestep="timestep 1000", every="thermo 1",
                  thermo="thermo_style custom step time dt f_ib[7] f_ib[8] f_ib[9]", run="run 5"))
        thermo = result.thermo
        self.assertGreater(thermo["f_ib[8]"][-1], 0)
        np.testing.assert_allclose(np.diff(thermo["Time"]), thermo["f_ib[9]"][1:], rtol=1e-9)

    def test_a_step_that_goes_wrong_is_taken_again(self):
        # atoms would cross several fluid cells; the step that is taken then has the error that was
        # asked for
        with self.assertRaises(Failed) as stop:
            advance("integrator midpoint", 400, 2000, membrane=STIFF)
        self.assertRegex(stop.exception.result.error, "CFL above 1.*at step 1:")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                first = run(scene(ib=IB + "integrator midpoint adapt 1e-3 1000",
                                  timestep="timestep 400", membrane=STIFF,
                                  thermo="thermo_style custom step time f_ib[7] f_ib[8] f_ib[9]",
                                  every="thermo 1", dump=dump_line(1), run="run 1"), ranks)
                step = first.thermo["f_ib[9]"][-1]
                self.assertEqual(first.thermo["Time"][-1], step)
                self.assertGreaterEqual(first.thermo["f_ib[8]"][-1], 2)
                error = apart(first,
                              advance("integrator midpoint", step / 20, step, membrane=STIFF))
                print(f"\n400 us become {step:.4g}: error {error:.2g} um, estimated "
                      f"{first.thermo['f_ib[7]'][-1]:.2g}")
                self.assertLess(error, 1e-3)

    def test_no_timestep_is_small_enough(self):
        with self.assertRaises(Failed) as stop:
            run(scene(ib=IB + "integrator midpoint adapt 1e-30 1000", run="run 5"))
        self.assertRegex(stop.exception.result.error,
                         "no timestep above .* meets the error 1e-30 of adapt at step 1")


class Restart(unittest.TestCase):
    """A run goes on from a restart file bit for bit."""

    BOX = dict.fromkeys(("units", "style", "newton", "boundary", "processors", "box", "create_box",
                         "cells"))

    def test_bit_for_bit(self):
        for ib, membrane in (("ab2", SHEAR["membrane"]), ("rkc 5 order 3", SHEAR["membrane"]),
                             ("rkc auto adapt 1e-4 1000", SHEAR["membrane"]), ("midpoint", VISCOUS),
                             ("midpoint", THINNING)):
            for ranks in (1, 2):
                with self.subTest(ib, ranks=ranks):
                    lines = dict(ib=IB + "integrator " + ib, membrane=membrane,
                                 thermo="thermo_style custom step time")
                    dump = dump_line(10, columns=COLUMNS)
                    whole = run(scene(**lines, run=f"run 20\nwrite_restart r\n{dump}\nrun 20"),
                                ranks)
                    after = run(scene(**{**lines, **self.BOX,
                                         "style": f"read_restart {whole.path('r')}", "dump": dump,
                                         "run": "run 20"}), ranks)
                    # a viscous membrane starts its iterations from the velocities, which are solved
                    # for anew
                    same = (np.testing.assert_array_equal if membrane is SHEAR["membrane"] else
                            lambda a, b: np.testing.assert_allclose(a, b, rtol=0, atol=1e-4))
                    if "auto" in ib:    # the spectral radius is estimated at the start of a run
                        same = lambda a, b: np.testing.assert_allclose(a, b, rtol=0, atol=1e-5)
                    same(after.dump().positions(), whole.dump().positions())

    def test_history_survives_a_second_run(self):
        for ib in ("ab2", "rkc 5 order 3"):
            lines = dict(ib=IB + "integrator " + ib, dump=dump_line(40, columns=COLUMNS),
                         every="thermo 40")
            one, two = run(scene(**lines, run="run 40")), run(scene(**lines, run="run 20\nrun 20"))
            np.testing.assert_allclose(two.dump().positions(), one.dump().positions(), rtol=0,
                                       atol=1e-13 * DIAMETER)


class Ranks(unittest.TestCase):
    def test_agree(self):
        cell = dict(cells="rbc/create rbc single 5.3 6.4 6.2 rotate 30 1 0.5 0", every="thermo 100",
                    thermo="thermo_style custom step f_mem f_mem[5] f_ib[5]", dump=dump_line(100),
                    run="run 100")
        for ib, membrane, tolerance in (
                ("ab2", SHEAR["membrane"], 1e-13), ("rkc 5 order 3", SHEAR["membrane"], 1e-13),
                ("rkc auto", SHEAR["membrane"], 1e-13),
                ("midpoint tol 1e-8", VISCOUS, 1e-9), ("midpoint tol 1e-8", THINNING, 1e-9)):
            lines = dict(cell, ib=IB + "integrator " + ib, membrane=membrane)
            one = run(scene(**lines))
            for ranks in (2, 4):
                with self.subTest(ib, ranks=ranks):
                    many = run(scene(**lines), ranks)
                    self.assertLess(abs(many.dump().positions() - one.dump().positions()).max(),
                                    tolerance * DIAMETER)
                    for column in one.thermo:
                        np.testing.assert_allclose(many.thermo[column][-1], one.thermo[column][-1],
                                                   rtol=1e-6)


class Viscosity(unittest.TestCase):
    def test_power_is_what_the_elastic_energy_and_the_plates_lose(self):
        # a stretched cell relaxes in a fluid at rest: energy goes into the membrane and into the
        # fluid. With a membrane much more viscous than the fluid nearly all of it goes into the
        # membrane.
        fractions = []
        for viscosity in (100, 1000, 10000):
            lines = dict(cells=SHEAR["cells"] + "\ndisplace_atoms all ramp x -1 1 x 2 10",
                         membrane=SHEAR["membrane"].replace("volume yes",
                                                            f"volume no viscosity {viscosity}"),
                         timestep="timestep 2", fluid=SHEAR["fluid"].replace("0.0012", "0"),
                         ib=IB + "integrator midpoint tol 1e-8 maxiter 1000",
                         thermo="thermo_style custom step time f_mem f_mem[5]", every="thermo 1",
                         run="run 10")
            thermo = run(scene(**lines)).thermo
            lost = -(thermo["f_mem"][-1] - thermo["f_mem"][1])
            power = thermo["f_mem[5]"][1:]
            dissipated = ((power[1:] + power[:-1]) / 2 * np.diff(thermo["Time"][1:])).sum()
            fractions.append(dissipated / lost)
        print(f"\nshare of the energy that the membrane dissipates: {fractions}")
        self.assertTrue(0 < fractions[0] < fractions[1] < fractions[2] < 1)

    def test_velocities_do_not_depend_on_those_the_solution_starts_from(self):
        # a viscosity that falls to a thousandth: at velocities a hundred times too large nearly all
        # of it is gone
        def velocities(start):
            result = run(scene(membrane=VISCOUS + " thinning 0.05 1e-5", before=start,
                               ib=IB + "tol 1e-8 maxiter 300", dump=dump_line(1, columns=COLUMNS)))
            self.assertNotIn("maxiter", result.printed)
            return result.dump()("vx", "vy", "vz")
        rest, fast = velocities(""), velocities("velocity all ramp vz -0.1 0.1 x 2 10")
        np.testing.assert_allclose(fast, rest, rtol=0, atol=1e-7 * abs(rest).max())

    def test_without_viscosity_costs_nothing(self):
        lines = dict(run="run 5", thermo="thermo_style custom step f_flow[12] f_mem[5]")
        without, zero = (run(scene(**lines)),
                         run(scene(**lines, membrane=SHEAR["membrane"] + " viscosity 0")))
        self.assertEqual(without.thermo["f_flow[12]"][-1], zero.thermo["f_flow[12]"][-1])
        self.assertEqual(zero.thermo["f_mem[5]"][-1], 0)


if __name__ == "__main__":
    unittest.main()
