"""Fluids with inertia: parallel flows against their series and the recursion of the scheme, what
carries on from run to run, and a cell in them."""

import unittest

import numpy as np

from lammps_case import SHEAR, dump_line, in_parallel, run, scene
from test_fluid import ETA, H, N, RHO, VELOCITY, Z, fluid_scene, grid_dump

DIAMETER = 7.82
REGIMES = ("inertia unsteady", "inertia convective", "inertia unsteady scheme projection",
           "inertia convective scheme projection")
STEPS = 40
SPEED = 0.003


def marched(steps, dt, upper=lambda t: SPEED, body=lambda t: 0.0, cells=N):
    """Profiles of the steps of Crank-Nicolson, the first two of two halves by backward Euler; dt
    may be a list."""
    h = H / cells
    laplace = (np.diag(np.full(cells, -2.0)) + np.diag(np.ones(cells - 1), 1) +
               np.diag(np.ones(cells - 1), -1)) / h**2
    laplace[0, 0] = laplace[-1, -1] = -3 / h**2
    at_the_plate = np.zeros(cells)
    at_the_plate[-1] = 2 / h**2
    profiles, t = [np.zeros(cells)], 0.0
    for n, dt in enumerate(np.broadcast_to(dt, steps)):
        def half(start, drive):
            right = 2 * RHO / dt * start + ETA * at_the_plate * drive(upper) + drive(body)
            return np.linalg.solve(2 * RHO / dt * np.eye(cells) - ETA * laplace, right)
        middle = half(profiles[-1], lambda f: 0.5 * (f(t) + f(t + dt)))
        profiles.append(half(middle, lambda f: f(t + dt)) if n < 2 else 2 * middle - profiles[-1])
        t += dt
    return np.array(profiles)


def couette(z, t):
    """Start-up of Couette flow."""
    n = np.arange(1, 200)[:, None]
    return SPEED * (z / H +
                    2 / np.pi * ((-1.0)**n / n * np.exp(-(n * np.pi / H)**2 * ETA / RHO * t) *
                                 np.sin(n * np.pi * z / H)).sum(axis=0))


def oscillation(z, t, omega):
    """Between a plate at rest and one with the velocity SPEED cos(omega t), long after the
    start."""
    k = np.sqrt(1j * omega * RHO / ETA)
    return (SPEED * np.exp(1j * omega * t) * np.sinh(k * z) / np.sinh(k * H)).real


def profiles(result, column="velocity[1]", cells=N, name="grid.dump"):
    """Of all frames; the flow is parallel."""
    dump = result.dump(name)
    values = np.array([dump(f"f_flow:grid:{column}", frame=n) for n in range(len(dump.frames))])
    values = values.reshape(len(values), cells, -1)
    np.testing.assert_allclose(values, values[:, :, :1] + 0 * values,
                               atol=1e-12 * max(1e-30, abs(values).max()))
    return values[:, :, 0]


class Parallel(unittest.TestCase):
    """Flows along the plates; every regime has the same."""

    def check(self, expected, dt=1.0, ranks=1, **changes):
        results = in_parallel(lambda regime: run(fluid_scene(**{
            "regime": regime, "grid": f"grid 4 4 {N}", "timestep": f"timestep {dt}",
            "dump": grid_dump(1, *VELOCITY),
            "run": f"run {STEPS}", **changes}), ranks), [(regime,) for regime in REGIMES])
        for regime, result in zip(REGIMES, results):
            with self.subTest(regime, ranks=ranks):
                np.testing.assert_allclose(profiles(result), expected,
                                           atol=1e-12 * abs(expected).max())
                for other in VELOCITY[1:]:
                    np.testing.assert_allclose(profiles(result, other), 0,
                                               atol=1e-12 * abs(expected).max())

    def test_couette_start_up(self):
        for ranks, dt in ((1, 0.5), (1, 100.0), (4, 0.5)):
            self.check(marched(STEPS, dt), dt, ranks, upper=f"{SPEED} 0 0")

    def test_oscillating_plate(self):
        self.check(marched(STEPS, 0.7, lambda t: SPEED * np.cos(0.3 * t)), 0.7, upper="v_U 0 0",
                   before=f"variable U equal {SPEED}*cos(0.3*time)")

    def test_body_force_in_time(self):
        self.check(marched(STEPS, 0.7, lambda t: 0, lambda t: 1e-3 * np.sin(0.3 * t)), 0.7,
                   body="v_g 0 0", before="variable g equal 1e-3*sin(0.3*time)")

    def test_timestep_changed_between_runs(self):
        steps = [1.0] * 10 + [0.25] * 10 + [4.0] * 20
        self.check(marched(STEPS, steps), upper=f"{SPEED} 0 0", ranks=2,
                   run="run 10\ntimestep 0.25\nrun 10 pre no\nrun 0\ntimestep 4\nrun 20")

    def errors(self, exact, time, **changes):
        found = []
        for cells, steps in ((16, 40), (32, 80), (64, 160)):
            result = run(
                fluid_scene(grid=f"grid 4 4 {cells}",
                            regime="inertia unsteady", every=f"thermo {steps}",
                            timestep=f"timestep {time / steps}", dump=grid_dump(steps, VELOCITY[0]),
                            run=f"run {steps}", **changes))
            z = (np.arange(cells) + 0.5) * H / cells
            found.append(abs(profiles(result, cells=cells)[-1] - exact(z, time)).max() / SPEED)
        orders = np.log2(np.array(found[:-1]) / found[1:])
        print(f"\n{exact.__name__}: errors {found} of the speed, orders {orders}")
        return found, orders

    def test_couette_start_up_against_its_series(self):
        errors, orders = self.errors(couette, 20.0, upper=f"{SPEED} 0 0")
        self.assertLess(errors[-1], 2e-4)
        self.assertGreater(orders.min(), 1.9)

    def test_oscillating_plate_against_the_exact_solution(self):
        omega = 2 * np.pi / 40

        def periodic(z, t):
            return oscillation(z, t, omega)
        errors, orders = self.errors(periodic, 110.0, upper="v_U 0 0",
                                     before=f"variable U equal {SPEED}*cos({omega!r}*time)")
        self.assertLess(errors[-1], 2e-3)
        self.assertGreater(orders.min(), 1.9)

    def test_any_timestep(self):
        for regime in ("inertia unsteady", "inertia unsteady scheme projection"):
            sizes = 10.0**np.arange(-3, 6)
            results = in_parallel(
                lambda dt: run(fluid_scene(regime=regime, upper=f"{SPEED} 0 0", run="run 100",
                                           timestep=f"timestep {dt!r}")), [(dt,) for dt in sizes])
            for dt, result in zip(sizes, results):
                with self.subTest(regime, dt=dt):
                    self.assertLess(result.thermo["f_flow[10]"].max(), SPEED)
                    if dt >= 100:
                        np.testing.assert_allclose(result.thermo["f_flow[1]"][-1], ETA * SPEED / H,
                                                   rtol=1e-6)


class Periodic(unittest.TestCase):
    """A triply periodic box."""

    def mean(self, ranks, **changes):
        thermo = run(
            fluid_scene(**{"lower": None, "boundary": "boundary p p p", "timestep": "timestep 0.7",
                           "run": f"run {STEPS}", **changes}), ranks).thermo
        return thermo["Time"], np.array([thermo[f"f_flow[{n}]"] for n in (7, 8, 9)]).T

    def test_a_body_force_accelerates_the_fluid(self):
        force = np.array([1e-3, -2e-3, 3e-3])
        for regime in REGIMES:
            for ranks, mean in ((1, ""), (2, " mean force")):
                with self.subTest(regime + mean, ranks=ranks):
                    t, u = self.mean(ranks, regime=regime + mean, body="1e-3 -2e-3 3e-3")
                    np.testing.assert_allclose(u, np.outer(t, force / RHO), rtol=1e-12)

    def test_a_body_force_that_varies(self):
        # trapezia; in the first two steps a half each by the force in the middle and at the end
        for regime in REGIMES:
            with self.subTest(regime):
                t, u = self.mean(1, regime=regime, body="0 v_g 0",
                                 before="variable g equal 1e-3*cos(0.1*time)")
                g = 1e-3 * np.cos(0.1 * t)
                gain = (g[1:] + g[:-1]) / 2
                gain[:2] = (gain[:2] + g[1:3]) / 2
                np.testing.assert_allclose(u[1:, 1], np.cumsum(gain) * 0.7 / RHO, atol=1e-14)

    def test_a_mean_velocity_held(self):
        for regime in ("inertia none", *REGIMES):
            for ranks in (1, 2):
                with self.subTest(regime, ranks=ranks):
                    t, u = self.mean(ranks, regime=regime + " mean 0.001 v_U -0.002",
                                     before="variable U equal 0.003*cos(0.1*time)")
                    expected = np.array([0.001 + 0 * t, 0.003 * np.cos(0.1 * t), -0.002 + 0 * t]).T
                    np.testing.assert_allclose(u[1:], expected[1:], atol=1e-15)

    def test_a_body_force_has_no_effect_where_the_mean_is_held(self):
        with_force, without = (self.mean(1, regime="inertia unsteady mean 0.001 0 0", body=body)[1]
                               for body in ("1 2 3", ""))
        np.testing.assert_allclose(with_force, without, atol=1e-15)


class Output(unittest.TestCase):
    CASE = dict(regime="inertia unsteady", grid=f"grid 4 4 {N}", timestep="timestep 0.7",
                run="run 10",
                upper=f"{SPEED} 0 0", body="0 0 v_g", before="variable g equal 1e-3*cos(0.3*time)")

    def test_hydrostatic_pressure_and_force(self):
        for regime in REGIMES:
            for ranks in (1, 2):
                with self.subTest(regime, ranks=ranks):
                    result = run(fluid_scene(**{**self.CASE, "regime": regime},
                                             dump=grid_dump(1, "velocity[1]", "pressure",
                                                            "force[3]")), ranks)
                    g = 1e-3 * np.cos(0.3 * 0.7 * np.arange(11))
                    pressure = np.outer((g[1:] + g[:-1]) / 2, Z - H / 2)
                    # of the later halves of the first two steps
                    pressure[:2] = np.outer(g[1:3], Z - H / 2)
                    np.testing.assert_allclose(profiles(result, "pressure")[1:], pressure,
                                               atol=1e-13)
                    np.testing.assert_array_equal(profiles(result, "pressure")[0], 0)
                    np.testing.assert_allclose(profiles(result, "force[3]"),
                                               np.outer(g, np.ones(N)), rtol=1e-12)
                    np.testing.assert_allclose(profiles(result), marched(10, 0.7),
                                               atol=1e-12 * SPEED)

    def test_fix_ave_grid_and_vtk(self):
        from vtkmodules.vtkIOXML import vtkXMLRectilinearGridReader
        from vtkmodules.util.numpy_support import vtk_to_numpy
        last = (f"fix mean all ave/grid 1 5 5 4 4 {N} f_flow:grid:velocity[1] "
                "f_flow:grid:pressure\n"
                "dump mean all grid 5 mean.dump f_mean:grid:data[1] f_mean:grid:data[2]\n"
                "dump_modify mean sort id format float %.17g\n"
                "dump u all grid/vtk 10 u.*.vtr " +
                " ".join(f"f_flow:grid:{name}" for name in VELOCITY))
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                result = run(fluid_scene(**self.CASE, dump=grid_dump(1, "velocity[1]", "pressure"),
                                         last=last), ranks)
                frames = result.dump("grid.dump").frames
                np.testing.assert_allclose(result.dump("mean.dump").frames[-1],
                                           np.mean(frames[6:11], axis=0), atol=1e-15)
                reader = vtkXMLRectilinearGridReader()
                reader.SetFileName(str(result.path("u.10.vtr")))
                reader.Update()
                velocity = vtk_to_numpy(reader.GetOutput().GetCellData().GetArray(0))
                np.testing.assert_allclose(velocity[:, 0], frames[-1][:, 0], rtol=1e-5)


# A cell; the plate starts smoothly.
CELL = dict(before="variable U equal 0.0012*(1-exp(0-(time/3000)^2))", every="thermo 10",
            dump=dump_line(10),
            thermo="thermo_style custom step f_mem f_flow[1] f_flow[10] f_flow[11] f_flow[12]",
            run="run 40", neighbor=SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no")
FLUID = SHEAR["fluid"].replace("0.0012", "v_U")
WITH_CELLS = {name: dict(CELL, fluid=FLUID.replace("inertia none", name), ib=SHEAR["ib"])
              for name in REGIMES}
WITH_CELLS["direct"] = dict(CELL, fluid=FLUID.replace("inertia none", "inertia unsteady"),
                            cells=SHEAR["cells"] +
                            "\nmass 1 2", ib=SHEAR["ib"] + " scheme direct tol 1e-10")
NONE = dict(CELL, fluid=FLUID)


class WithACell(unittest.TestCase):
    def ends(self, steps, time, **case):
        lines = {**case, "timestep": f"timestep {time / steps!r}", "run": f"run {steps}",
                 "every": f"thermo {steps}",
                 "dump": dump_line(steps)}
        return run(scene(**lines)).dump().positions()

    def test_inertia_none_is_the_limit_of_a_light_fluid(self):
        # at 300 to 30000 times the timestep that explicit viscosity would allow; behind by a time
        # that density gives
        steady = self.ends(100, 2e4, **NONE)
        for name in ("inertia unsteady", "inertia convective"):
            with self.subTest(name):
                apart = [
                    abs(self.ends(100, 2e4, **{
                        **WITH_CELLS[name],
                        "fluid": WITH_CELLS[name]["fluid"].replace("1.025", f"{density}")}) -
                        steady).max() / DIAMETER
                    for density in (1.025, 0.1025, 0.01025)]
                print(f"\n{name}: {apart} diameters from inertia none")
                self.assertLess(apart[0], 1e-3)
                self.assertLess(apart[1], 1e-4)
                self.assertLess(apart[2], 2e-5)

    def test_second_order_in_time(self):
        for name in ("inertia unsteady", "inertia convective"):
            with self.subTest(name):
                ends = [self.ends(steps, 6000.0, **WITH_CELLS[name]) for steps in (30, 60, 120)]
                apart = [abs(b - a).max() / DIAMETER for a, b in zip(ends, ends[1:])]
                order = np.log2(apart[0] / apart[1])
                print(f"\n{name}: halving the timestep moves vertices by {apart} diameters, order "
                      f"{order:.3g}")
                self.assertLess(apart[-1], 1e-5)
                self.assertGreater(order, 1.8)

    def test_projection(self):
        # of first order in steps much longer than viscosity needs for a cell of the grid, then of
        # second
        ramp = CELL["before"].replace("3000", "200")
        for name in ("inertia unsteady", "inertia convective"):
            with self.subTest(name):
                apart = [
                    abs(np.subtract(
                        *(self.ends(steps, time, **{**WITH_CELLS[regime], "before": before})
                          for regime in (name, name + " scheme projection")))).max() / DIAMETER
                    for steps, time, before in ((30, 6000.0, CELL["before"]), (160, 400.0, ramp),
                                                (320, 400.0, ramp))]
                order = np.log2(apart[1] / apart[2])
                print(f"\n{name}: projection {apart} diameters from coupled, order {order:.3g}")
                self.assertLess(apart[0], 1e-3)
                self.assertLess(apart[2], 2e-7)
                self.assertGreater(order, 1.6)


class Pieces(unittest.TestCase):
    """Runs that go on where the last one ended."""

    def compare(self, lines, ranks=1, names=WITH_CELLS, exact=True, **changes):
        cases = [{**WITH_CELLS[name], **changes} for name in names]
        results = in_parallel(lambda case: (run(scene(**case), ranks),
                                            run(scene(**{**case, "run": lines}), ranks)),
                              [(case,) for case in cases])
        for name, (whole, pieces) in zip(names, results):
            with self.subTest(name, lines=lines, ranks=ranks):
                a, b = whole.dump(), pieces.dump()
                compare = (np.testing.assert_array_equal if exact else
                           lambda x, y: np.testing.assert_allclose(x, y, atol=1e-12 * DIAMETER,
                                                                   rtol=0))
                compare(b.positions(), a.positions())
                compare(b.forces(), a.forces())
                if exact:
                    self.assertEqual([column[-1] for column in pieces.thermo.values()],
                                     [column[-1] for column in whole.thermo.values()])
                self.assertEqual(pieces.thermo["f_flow[12]"][-1], whole.thermo["f_flow[12]"][-1])

    def test_in_two(self):
        self.compare("run 20\nrun 20", 2)
        self.compare("run 1\nrun 39 pre no")

    def test_run_0(self):
        self.compare("run 0\nrun 20\nrun 0\nrun 20")

    def test_euler(self):
        for name in ("inertia convective", "direct"):
            self.compare("run 20\nrun 20", names=[name],
                         ib=WITH_CELLS[name]["ib"].replace("midpoint", "euler"))

    def test_reneighboring_as_usual(self):
        self.compare("run 20\nrun 20", exact=False, neighbor=SHEAR["neighbor"])

    def with_steady_plates(self, name, lines, dump=None):
        case = {**WITH_CELLS[name], "before": "variable U equal 0.0012", "dump": dump}
        end = ("\nwrite_dump all custom end.dump id xu yu zu fx fy fz modify sort id format float "
               "%.17g")
        return run(scene(**{**case, "run": lines + end}))

    def test_reset_timestep(self):
        for name in WITH_CELLS:
            with self.subTest(name):
                whole = self.with_steady_plates(name, "run 40").dump("end.dump")
                reset = self.with_steady_plates(name, "run 20\nreset_timestep 7000\n"
                                                      "run 20").dump("end.dump")
                np.testing.assert_array_equal(reset.frames, whole.frames)

    def test_rerun_leaves_the_fluid_alone(self):
        again = "run 20\nundump atoms\nrerun atoms.dump dump x y z ix iy iz\nrun 20"
        for name in WITH_CELLS:
            with self.subTest(name):
                whole = self.with_steady_plates(name, "run 40")
                result = self.with_steady_plates(name, again,
                                                 dump_line(10, columns="id type x y z ix iy iz"))
                first, rerun, second = result.tables()
                np.testing.assert_array_equal(rerun["f_mem"], first["f_mem"])
                for column in ("f_flow[10]", "f_flow[12]"):
                    np.testing.assert_array_equal(rerun[column], first[column][-1])
                    self.assertEqual(second[column][-1], whole.thermo[column][-1])
                np.testing.assert_array_equal(result.dump("end.dump").frames,
                                              whole.dump("end.dump").frames)

    def test_timestep_changed(self):
        # on the way, to steps twice as long: the error stays of second order
        for name in ("inertia unsteady", "inertia convective", "direct"):
            with self.subTest(name):
                ends = [run(scene(**{**WITH_CELLS[name], "timestep": f"timestep {100 / n}",
                                     "dump": dump_line(45 * n),
                                     "run": f"run {30 * n}\ntimestep {200 / n}\nrun {15 * n}"}))
                        .dump().positions()
                        for n in (1, 2, 4)]
                apart = [abs(b - a).max() / DIAMETER for a, b in zip(ends, ends[1:])]
                order = np.log2(apart[0] / apart[1])
                print(
                    f"\n{name}: timestep changed on the way: {apart} diameters, order {order:.3g}")
                self.assertGreater(order, 1.8)


if __name__ == "__main__":
    unittest.main()
