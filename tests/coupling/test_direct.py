"""Atoms with mass (fix rbc/ib scheme direct): the limits of small and large masses, momentum,
falling markers, rigid obstacles."""

import unittest

import numpy as np

from lammps_case import SHEAR, attempt, dump_line, run, scene

DIAMETER = 7.82
DENSITY, VOLUME = 1.025, 12.0**3
PLATES = "wall zlo 0 0 0 wall zhi 0 0 0"
MARKER = "create_atoms 1 single 6.3 5.9 6.1"
MOTION = "id xu yu zu vx vy vz"
FTM2V_REAL = 48.88821291**-2


def markers(mass, push="", regime="inertia unsteady", ib="scheme direct tol 1e-12", cells=MARKER,
            start=None, steps=20, every=1, ranks=1, **changes):
    """Atoms without springs, in a triply periodic box unless there are plates; the result and the
    atoms' velocities."""
    plates = "wall" in regime
    columns = [f"f_flow[{n}]" for n in (7, 8, 9, 10, 12)] + [f"f_ib[{n}]" for n in (1, 2, 3, 4)
                                                             if "direct" in ib]
    lines = dict(
        boundary=f"boundary p p {'f' if plates else 'p'}",
        cells=f"{cells}\nmass 1 {mass!r}", membrane=None,
        compute=start and f"velocity all set {start}", before=push and f"fix push all {push}",
        timestep="timestep 1",
        fluid=f"fix flow all rbc/fluid dx 1.0 viscosity 1.5 density {DENSITY} {regime}",
        ib=f"fix ib all rbc/ib flow {ib}", thermo="thermo_style custom step " + " ".join(columns),
        every=f"thermo {every}", dump=dump_line(every, columns=MOTION), run=f"run {steps}")
    result = run(scene(**{**lines, **changes}), ranks)
    dump = result.dump()
    return result, np.array([dump("vx", "vy", "vz", frame=n) for n in range(len(dump.frames))])


def columns(result, *names):
    return np.array([result.thermo[name] for name in names]).T


class Limits(unittest.TestCase):
    CELL = dict(fluid=SHEAR["fluid"].replace("none", "unsteady"), dump=dump_line(40), run="run 40",
                every="thermo 40")

    def test_no_mass_is_scheme_elastic(self):
        elastic = run(scene(**self.CELL, ib=SHEAR["ib"] + " sheets no")).dump()
        apart = []
        for mass in (1.0, 0.1, 0.01):
            direct = run(scene(**self.CELL, before=f"mass 1 {mass}",
                               ib=SHEAR["ib"] + " scheme direct tol 1e-12"))
            apart.append(abs(direct.dump().positions() - elastic.positions()).max() / DIAMETER)
        print(f"\nmasses of 1, 0.1, 0.01 pg: {apart} diameters from none")
        np.testing.assert_allclose(np.array(apart[:-1]) / apart[1:], 10, rtol=0.1)
        result = run(scene(**self.CELL, before="mass 1 1e-9", ib=SHEAR["ib"] + " scheme direct"))
        self.assertLess(abs(result.dump().positions() - elastic.positions()).max(), 1e-8 * DIAMETER)

    def test_a_light_marker_costs_one_solve_a_step(self):
        result, _ = markers(1e-9, "addforce 1e-6 0 0", ib="scheme direct")
        np.testing.assert_array_equal(np.diff(result.thermo["f_flow[12]"]), [2, 2] + [1] * 18)

    def test_masses_of_all_sizes(self):
        # in Couette flow with a timestep beyond the reach of explicit coupling
        for mass in 10.0**np.arange(-12, 13, 4):
            for ib in ("midpoint", "euler"):
                with self.subTest(ib, mass=mass):
                    result, velocity = markers(
                        mass, regime="inertia unsteady wall zlo 0 0 0 wall zhi 0.003 0 0",
                        ib=f"scheme direct maxiter 1000 integrator {ib}",
                        cells=SHEAR["cells"], timestep="timestep 200", steps=40, every=10)
                    self.assertLess(abs(velocity).max(), 0.003)
                    self.assertLess(result.thermo["f_flow[10]"].max(), 0.0031)
                    self.assertLess(result.thermo["f_ib[4]"].max(), 1e-4)

    def test_a_large_mass_accelerates_by_its_force_alone(self):
        mass, force = 1e11, np.array([1e-2, -2e-2, 3e-2])
        for units, factor in (("micro", 1), ("real", FTM2V_REAL)):
            for regime in ("inertia unsteady", "inertia convective " + PLATES):
                with self.subTest(units, regime=regime):
                    push = "addforce " + " ".join(repr(float(f / factor)) for f in force)
                    result, velocity = markers(mass, push, regime, units=f"units {units}",
                                               timestep="timestep 1")
                    middle = np.arange(1, 21) - 0.5
                    np.testing.assert_allclose(velocity[1:, 0], np.outer(middle, force / mass),
                                               rtol=1e-6)
                    self.assertLess(abs(columns(result, "f_ib[1]", "f_ib[2]", "f_ib[3]") * factor)
                                    .max(), 1e-6 * abs(force).max())

    def test_a_rigid_obstacle_bears_what_drives_the_fluid(self):
        # on average over two steps: where masses hold the fluid, its velocity at the ends of steps
        # may ring
        for regime in ("inertia unsteady", "inertia convective"):
            with self.subTest(regime):
                result, velocity = markers(1e12, "setforce 0 0 0", regime + " body v_g v_half 0",
                                           "scheme direct maxiter 1000", SHEAR["cells"], steps=120,
                                           timestep="timestep 50",
                                           newton="variable half equal v_g/2\n"
                                           "variable g equal 1e-6*(1-exp(0-(time/500)^2))")
                force = columns(result, "f_ib[1]", "f_ib[2]", "f_ib[3]") / VOLUME
                np.testing.assert_allclose((force[-1] + force[-2]) / 2, [-1e-6, -5e-7, 0],
                                           atol=1e-9)
                slip = (np.sqrt((velocity[-1]**2).sum(axis=1).mean()) /
                        result.thermo["f_flow[10]"][-1])
                moved = abs(result.dump().positions() - result.dump().positions(0)).max()
                print(f"\nobstacle, {regime}: slip {slip:.2g} of the fastest fluid, moved "
                      f"{moved:.2g} um, force {force[-2:, 0]}")
                self.assertLess(slip, 1e-4)
                self.assertLess(result.thermo["f_ib[4]"].max(), 1e-4)


class Falling(unittest.TestCase):
    """One marker; forces so small that it stays where it is on the grid."""

    def test_terminal_velocity(self):
        for push in ("addforce 1e-7 0 2e-7", "gravity 1e-10 vector 0 0 -1"):
            for regime in ("mean 0 0 0", PLATES):
                with self.subTest(push, regime=regime):
                    def last(inertia, ib):
                        return markers(1e3, push, f"inertia {inertia} {regime}", ib, steps=400,
                                       every=400, timestep="timestep 2")[1][-1, 0]
                    steady, elastic, direct = (last("none", ""), last("unsteady", ""),
                                               last("unsteady", "scheme direct tol 1e-12"))
                    scale = abs(steady).max()
                    self.assertGreater(scale, 0)
                    np.testing.assert_allclose(direct, elastic, atol=1e-6 * scale)
                    np.testing.assert_allclose(direct, steady, atol=1e-6 * scale)

    def test_decay_of_its_velocity(self):
        # a heavy marker without force: V = V0 exp(-t / (mass * mobility)), the fluid quasi-steady
        mass, force = 1e6, 1e-7
        steady = markers(1.0, f"addforce {force} 0 0", "inertia none mean 0 0 0", "",
                         steps=1)[1][-1, 0, 0]
        time = mass * steady / force
        errors = []
        for steps in (20, 40, 80):
            _, velocity = markers(mass, regime="inertia unsteady mean 0 0 0", steps=steps,
                                  every=steps,
                                  start="1e-9 0 0", timestep=f"timestep {time / steps!r}")
            middle = 1 - 0.5 / steps
            errors.append(abs(velocity[-1, 0, 0] / (1e-9 * np.exp(-middle)) - 1))
        print(f"\ndecay of a velocity in {time:.4g} us: errors {errors}")
        self.assertLess(errors[-1], 2e-3)


class Momentum(unittest.TestCase):
    SWARM = dict(cells="create_atoms 1 random 30 5 NULL", start="2e-3 0 -1e-3")
    BODY = np.array([1e-6, 0, 2e-6])

    def test_of_fluid_and_masses(self):
        # a triply periodic box; forces of the atoms by the differences that stand for accelerations
        push = np.array([1e-4, -2e-4, 0])
        for regime in ("inertia unsteady", "inertia convective"):
            for mass in (0.1, 30.0):
                for ranks in (1, 2):
                    with self.subTest(regime, mass=mass, ranks=ranks):
                        body = "body " + " ".join(map(str, self.BODY))
                        result, velocity = markers(mass, "addforce " + " ".join(map(str, push)),
                                                   f"{regime} {body}", ranks=ranks, **self.SWARM)
                        on_fluid = columns(result, "f_ib[1]", "f_ib[2]", "f_ib[3]")[1:]
                        momentum = DENSITY * VOLUME * columns(result, "f_flow[7]", "f_flow[8]",
                                                              "f_flow[9]")
                        scale = abs(on_fluid).max()
                        np.testing.assert_allclose(np.diff(momentum, axis=0),
                                                   on_fluid + VOLUME * self.BODY,
                                                   atol=1e-11 * scale)

                        v = velocity.sum(axis=1)
                        acceleration = np.concatenate([[2 * (v[1] - v[0]), v[2] - v[1]],
                                                       1.5 * v[3:] - 2 * v[2:-1] + 0.5 * v[1:-2]])
                        np.testing.assert_allclose(on_fluid, 30 * push - mass * acceleration,
                                                   atol=1e-9 * scale)

    def test_conserved(self):
        # what a pulse of force brought in is there when all has come to rest relative to the box
        pulse = 1e-4 * np.sin(np.pi * np.arange(1, 41) / 40)**4
        for mass in (0.1, 30.0):
            for regime in ("inertia unsteady", "inertia convective"):
                with self.subTest(regime, mass=mass):
                    result, velocity = markers(
                        mass, "addforce v_F 0 v_F", regime, cells=self.SWARM["cells"], steps=100,
                        every=100, newton="variable F equal 1e-4*(step<40)*sin(PI*step/40)^4")
                    momentum = (DENSITY * VOLUME *
                                columns(result, "f_flow[7]", "f_flow[8]", "f_flow[9]")[-1] +
                                mass * velocity[-1].sum(axis=0))
                    given = 30 * pulse.sum()
                    print(f"\n{regime}, mass {mass}: momentum {momentum / given} of that given")
                    np.testing.assert_allclose(momentum, given * np.array([1, 0, 1]),
                                               atol=1e-4 * given)


class WithACell(unittest.TestCase):
    CELL = dict(before="variable U equal 0.0012*(1-exp(0-(time/3000)^2))\nmass 1 100",
                fluid=SHEAR["fluid"].replace("none", "unsteady").replace("0.0012", "v_U"),
                every="thermo 40",
                thermo="thermo_style custom step f_ib[1] f_ib[2] f_ib[3] f_ib[4] f_flow[11]",
                ib=SHEAR["ib"] + " scheme direct tol 1e-10", dump=dump_line(40), run="run 40")

    def test_ranks(self):
        reference = run(scene(**self.CELL)).dump().positions()
        ways = ((2, {}), (2, dict(processors="processors 2 1 1")), (4, {}),
                (4, dict(newton="newton off")))
        for ranks, changes in ways:
            with self.subTest(changes, ranks=ranks):
                result = run(scene(**{**self.CELL, **changes}), ranks)
                apart = abs(result.dump().positions() - reference).max() / DIAMETER
                print(f"\n{ranks} ranks: {apart:.2g} diameters from 1")
                self.assertLess(apart, 1e-12)
                self.assertLess(result.thermo["f_flow[11]"].max(), 1e-12)

    def test_second_order_in_time(self):
        ends = [run(
            scene(**{**self.CELL, "timestep": f"timestep {6000 / steps!r}", "run": f"run {steps}",
                     "dump": dump_line(steps)})).dump().positions() for steps in (30, 60, 120, 240)]
        apart = [abs(b - a).max() / DIAMETER for a, b in zip(ends, ends[1:])]
        orders = np.log2(np.array(apart[:-1]) / apart[1:])
        print(f"\nhalving the timestep moves heavy vertices by {apart} diameters, orders {orders}")
        self.assertGreater(orders[-1], 1.8)

    def test_tolerance(self):
        reference = run(scene(**self.CELL)).dump().positions()
        for tol in (1e-2, 1e-4, 1e-6):
            with self.subTest(tol):
                result = run(
                    scene(**{**self.CELL, "ib": SHEAR["ib"] + f" scheme direct tol {tol}"}))
                apart = abs(result.dump().positions() - reference).max() / DIAMETER
                print(f"\ntol {tol}: error {result.thermo['f_ib[4]'][-1]:.2g}, {apart:.2g} "
                      "diameters from tol 1e-10")
                self.assertLess(result.thermo["f_ib[4]"][-1], tol)
                self.assertLess(apart, 0.1 * tol)
                self.assertNotIn("maxiter", result.printed)

    def test_maxiter(self):
        result = run(
            scene(**{**self.CELL, "ib": SHEAR["ib"] + " scheme direct tol 1e-10 maxiter 1"}))
        self.assertRegex(result.printed,
                         r"WARNING: Fix rbc/ib ib reached its maxiter of 1 in \d+ steps")
        self.assertGreater(result.thermo["f_ib[4]"][-1], 1e-10)

    def test_cells_that_come_after_the_fix(self):
        scene_of = {**self.CELL, "ib": SHEAR["ib"] + " scheme direct", "dump": ""}
        dump = dump_line(40)
        early = run(scene(**{**scene_of, "last": dump})).dump()
        late = run(
            scene(**{**scene_of, "cells": "mass 1 1", "last": SHEAR["cells"] + "\n" + dump})).dump()
        np.testing.assert_array_equal(early.positions(), late.positions())

    def test_a_mass_of_zero_stops(self):
        result = attempt(
            scene(**{**self.CELL, "ib": "fix m all property/atom rmass ghost yes\n" + SHEAR["ib"] +
                     " scheme direct"}))
        self.assertIn("has mass 0; scheme direct needs a mass > 0", result.error)


if __name__ == "__main__":
    unittest.main()
