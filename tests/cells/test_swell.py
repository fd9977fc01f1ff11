"""swell of fix rbc/membrane: a capsule in a resting fluid follows the factor on its rest volume."""

import unittest

import numpy as np

from lammps_case import POTENTIALS, dump_line, run, scene

FLUID = "fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025"
LAW = "neo-hookean 5e-3 bending 2.0e-4"
STEPS = 200
RAMP = f"variable f equal 1+0.4*step/{STEPS}"


def swelling(variable=RAMP, integrator="midpoint", inertia="none", scheme="", keywords="swell v_f",
             law=LAW, steps=STEPS, dt=20, **changes):
    lines = dict(
        boundary="boundary p p p", molecule=f"molecule ball {POTENTIALS}/capsule_162.mol",
        before=variable,
        box="region box block -6 6 -6 6 -6 6", cells="rbc/create ball single 0.2 0.1 0.3" +
        ("\nmass 1 0.01" if scheme else ""),
        membrane=f"fix mem all rbc/membrane ball {law} {keywords}",
        fluid=f"{FLUID} inertia {inertia}",
        ib="fix ib all rbc/ib flow kernel peskin4 " + (scheme or f"integrator {integrator}"),
        compute="compute cell all rbc/cell",
        thermo="thermo_style custom step c_cell[1][2] c_cell[1][3] c_cell[1][4] c_cell[1][6] "
               "f_mem[4] " +
        ("v_f" if variable else ""),
        every="thermo 1", timestep=f"timestep {dt}", run=f"run {steps}")
    return scene(**{**lines, **changes})


def volume(result):
    return result.thermo["c_cell[1][6]"] / result.thermo["c_cell[1][6]"][0]


WAYS = {"midpoint": {}, "euler": dict(integrator="euler"), "ab2": dict(integrator="ab2"),
        "rkc": dict(integrator="rkc 4"), "inertia": dict(inertia="unsteady"),
        "direct": dict(inertia="unsteady", scheme="scheme direct")}


class Swell(unittest.TestCase):
    def errors(self, script, ranks=1):
        result = run(script, ranks)
        return abs(volume(result) / result.thermo["v_f"] - 1)

    def test_follows_a_ramp_without_lag(self):
        lag = 10 * 0.4 / STEPS    # of a volume that only relaxes over 10 steps
        for name, options in WAYS.items():
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    errors = self.errors(swelling(**options), ranks)
                    later = errors[STEPS // 2:].max()
                    print(f"\n{name}, {ranks} ranks: at most {errors.max():.2g} off, later "
                          f"{later:.2g}")
                    self.assertLess(later, 1e-3 * lag)
                    # whose stages give the velocity at the start of a step a weight of its own
                    if name != "rkc":
                        self.assertLess(errors.max(), 1.01 * lag / 10)    # of the first step

    def test_follows_a_wave_at_second_order(self):
        for name, options in WAYS.items():
            with self.subTest(name):
                errors = [
                    self.errors(swelling(variable=f"variable f equal 1+0.2*sin(PI*step/{steps})^2",
                                         steps=steps, dt=8000 / steps, **options)).max()
                    for steps in (400, 800)]
                order = np.log2(errors[0] / errors[1])
                print(f"\n{name}: {errors[0]:.2g}, {errors[1]:.2g} off: order {order:.2f}")
                self.assertLess(errors[0], 2e-3)
                self.assertGreater(order, 1.8)

    def test_a_number(self):
        for factor in (0.9, 1.1):
            with self.subTest(factor):
                self.assertAlmostEqual(volume(run(swelling("", keywords=f"swell {factor}")))[-1],
                                       factor, delta=1e-5)

    def test_one_changes_nothing(self):
        lines = dict(dump=dump_line(50), last="displace_atoms all random 0.02 0.02 0.02 7")
        dumps = [run(swelling("", keywords=keywords, **lines)).dump()
                 for keywords in ("", "swell 1")]
        np.testing.assert_array_equal(dumps[0].frames, dumps[1].frames)

    def test_jump_between_runs_relaxes(self):
        found = volume(run(swelling("variable f equal 1", steps=20,
                                    run="run 20\nvariable f delete\nvariable f equal 1.1\n"
                                        "run 60")))[21:]
        expected = 1.1 - 0.1 * 0.9**np.arange(len(found))
        np.testing.assert_allclose(found, expected, atol=2e-3)

    def test_a_modulus_inflates_a_balloon(self):
        # at rest the pressure of the volume balances a neo-Hookean sheet, p = 2 T/R with T = Gs
        # (1 - l^-6)
        modulus, shear, steps = 0.1, 5e-3, 3000
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(swelling(
                    "variable f equal ramp(1,1.4)\nmass 1 1e-3",
                    keywords=f"volume {modulus} swell v_f",
                    fluid=None, ib="fix move all nve\nfix drag all viscous 5e-3", dt=0.1,
                    every="thermo 30", molecule=f"molecule ball {POTENTIALS}/capsule_362.mol",
                    law=f"neo-hookean {shear}",
                    run=f"run {steps}\nvariable f delete\nvariable f equal 1.4\n"
                        f"run {steps}"), ranks)
                rest, first, found = (result.thermo["v_f"], result.thermo["c_cell[1][6]"][0],
                                      volume(result))
                np.testing.assert_allclose(result.thermo["f_mem[4]"],
                                           modulus / 2 * first * (found - rest)**2 / rest,
                                           rtol=1e-9, atol=1e-15 * first)
                pressure = modulus * (1 - found[-1] / 1.4)
                balance = (2 * shear *
                           (1 - found[-1]**-2) / (3 * first * found[-1] / (4 * np.pi))**(1 / 3))
                print(f"\nballoon, {ranks} ranks: volume {found[-1]:.5f}, pressure "
                      f"{pressure / balance:.4f} of 2 T/R")
                self.assertLess(abs(pressure / balance - 1), 0.01)

    def test_restart_bit_for_bit(self):
        for name, options in WAYS.items():
            if name == "direct":
                continue
            with self.subTest(name):
                columns = "id mol type xu yu zu vx vy vz fx fy fz"
                dump = dump_line(20, columns=columns)
                whole = run(
                    swelling(**options, run=f"run 20\nwrite_restart r.restart\n{dump}\nrun 20"))
                again = run(swelling(
                    **options, units=None, style=f"read_restart {whole.path('r.restart')}",
                    boundary=None, box=None, create_box=None, cells=None, dump=dump, run="run 20"))
                np.testing.assert_array_equal(whole.dump().frames, again.dump().frames)


if __name__ == "__main__":
    unittest.main()
