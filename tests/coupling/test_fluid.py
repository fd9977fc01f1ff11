"""Flows of fix rbc/fluid by itself against the exact solutions of the discrete equations, and what
it offers to dumps, fix ave/grid, thermo and variables."""

import re
import unittest

import numpy as np

from lammps_case import dump_line, run, scene

H, N, ETA, RHO = 12.0, 16, 1.5, 1.025
Z = (np.arange(N) + 0.5) * H / N


def fluid_scene(body="", lower="0 0 0", upper="0 0 0", grid=f"grid 6 4 {N}", regime="inertia none",
                **changes):
    walls = f"wall zlo {lower} wall zhi {upper}" if lower else ""
    body = f"body {body}" if body else ""
    lines = dict(cells="mass 1 1", membrane=None, ib=None,
                 fluid=f"fix flow all rbc/fluid {grid} viscosity {ETA} density {RHO} {regime} "
                       f"{walls} {body}",
                 thermo="thermo_style custom step time f_flow " +
                 " ".join(f"f_flow[{n}]" for n in range(1, 13)),
                 every="thermo 1")
    lines.update(changes)
    return scene(**lines)


def grid_dump(every, *fields, name="grid.dump"):
    return (f"dump grid all grid {every} {name} " +
            " ".join(f"f_flow:grid:{field}" for field in fields) +
            "\ndump_modify grid sort id format float %.17g")


VELOCITY = [f"velocity[{n}]" for n in (1, 2, 3)]


def discrete_profile(force, lower, upper):
    """Exact solution of the discrete momentum balance at the cell centres. Ghosts mirror the
    plates; a plate whose velocity is None exerts no shear."""
    h = H / N
    matrix = np.diag(np.full(N, -2.0)) + np.diag(np.ones(N - 1), 1) + np.diag(np.ones(N - 1), -1)
    right = np.full(N, -force * h * h / ETA)
    for at, wall in ((0, lower), (-1, upper)):
        matrix[at, at] -= 1 if wall is not None else -1
        if wall is None:
            continue
        right[at] -= 2 * wall
    return np.linalg.solve(matrix, right)


def vector(thermo, row=-1):
    return np.array([thermo[f"f_flow[{n}]"][row] for n in range(1, 13)])


class Steady(unittest.TestCase):
    def flow(self, ranks, force=(0, 0, 0), lower=(0, 0, 0), upper=(0, 0, 0), **changes):
        words = [" ".join(repr(float(x)) for x in triple) for triple in (force, lower, upper)]
        result = run(fluid_scene(*words, dump=grid_dump(10, *VELOCITY, "pressure",
                                                        *[v.replace("velocity", "force")
                                                          for v in VELOCITY]),
                                 run="run 10", **changes), ranks)
        data = result.dump("grid.dump").frames[-1].reshape(N, 4, 6, 7)
        return result, data

    def check(self, ranks, force, lower, upper):
        result, data = self.flow(ranks, force, lower, upper)
        speed = max(abs(np.array(lower + upper)).max(),
                    abs(np.array(force[:2])).max() * H * H / (8 * ETA))
        expected = np.array([discrete_profile(force[c], lower[c], upper[c]) for c in range(2)])
        for c in range(2):
            np.testing.assert_allclose(data[..., c],
                                       np.broadcast_to(expected[c][:, None, None], (N, 4, 6)),
                                       atol=1e-10 * speed)
        np.testing.assert_allclose(data[..., 2], 0, atol=1e-10 * speed)
        # a normal force is held by the pressure
        np.testing.assert_allclose(data[..., 3],
                                   np.broadcast_to((force[2] * (Z - H / 2))[:, None, None],
                                                   (N, 4, 6)),
                                   atol=1e-10 * max(abs(force[2]) * H, ETA * speed / H))
        np.testing.assert_allclose(data[..., 4:], np.broadcast_to(force, (N, 4, 6, 3)),
                                   atol=1e-12 * max(1e-30, abs(np.array(force)).max()))

        measured = vector(result.thermo)
        shear = ETA * (np.array(upper) - np.array(lower)) / H
        half = np.array(force) * H / 2
        stress = abs(np.concatenate([shear, half])).max()
        np.testing.assert_allclose(measured[0:3], shear + half, atol=1e-10 * stress)
        np.testing.assert_allclose(measured[3:6], -shear + half, atol=1e-10 * stress)
        np.testing.assert_allclose(measured[6:9], [*expected.mean(axis=1), 0], atol=1e-10 * speed)
        np.testing.assert_allclose(measured[9], np.hypot(*expected).max(), rtol=1e-10)
        self.assertLess(measured[10], 1e-12)
        self.assertEqual(measured[11], 1)
        energy = RHO / 2 * (expected**2).sum() * 12 * 12 * H / N
        np.testing.assert_allclose(result.thermo["f_flow"], energy, rtol=1e-10)

    def test_couette(self):
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                self.check(ranks, (0, 0, 0), (-0.001, 0.0005, 0), (0.003, 0.002, 0))

    def test_poiseuille(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(ranks, (1e-3, -2e-3, 0), (0, 0, 0), (0, 0, 0))

    def test_all_at_once_with_a_normal_force(self):
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                self.check(ranks, (1e-3, -2e-3, 5e-3), (0.002, 0, 0), (0, -0.003, 0))

    def test_a_plate_that_slips(self):
        force = (1e-3, -2e-3, 5e-3)
        for ranks in (1, 4):
            for side in ("zlo", "zhi"):
                with self.subTest(ranks=ranks, side=side):
                    held = "wall {} 0.002 -0.001 0".format("zhi" if side == "zlo" else "zlo")
                    result = run(fluid_scene(" ".join(map(str, force)), None, run="run 2",
                                             regime=f"inertia none wall {side} slip {held}",
                                             dump=grid_dump(2, *VELOCITY)), ranks)
                    data = result.dump("grid.dump").frames[-1].reshape(N, 4, 6, 3)
                    walls = [(None, u) if side == "zlo" else (u, None) for u in (0.002, -0.001)]
                    expected = ([discrete_profile(force[c], *walls[c]) for c in range(2)] +
                                [np.zeros(N)])
                    for c in range(3):
                        np.testing.assert_allclose(
                            data[..., c], np.broadcast_to(expected[c][:, None, None], (N, 4, 6)),
                            atol=1e-11)
                    shear = [force[0] * H, force[1] * H, force[2] * H / 2]
                    free = [0, 0, force[2] * H / 2]
                    tractions = [*free, *shear] if side == "zlo" else [*shear, *free]
                    np.testing.assert_allclose(vector(result.thermo)[:6], tractions, atol=1e-12)

    def test_both_plates_slip(self):
        """With inertia the force accelerates the fluid as a whole."""
        for scheme in ("coupled", "projection"):
            with self.subTest(scheme=scheme):
                thermo = run(fluid_scene("1e-3 -2e-3 0", None, run="run 8",
                                         regime=f"inertia unsteady scheme {scheme} wall zlo slip "
                                                "wall zhi slip")).thermo
                for n, force in ((7, 1e-3), (8, -2e-3)):
                    np.testing.assert_allclose(thermo[f"f_flow[{n}]"], force / RHO * thermo["Time"],
                                               rtol=1e-10, atol=1e-18)
                np.testing.assert_array_equal([thermo[f"f_flow[{n}]"][-1] for n in (1, 2, 4, 5)], 0)

    def test_couette_energy_in_the_limit(self):
        result, _ = self.flow(1, upper=(0.003, 0, 0))
        exact = RHO * 0.003**2 / 6 * 12**3
        np.testing.assert_allclose(result.thermo["f_flow"][-1], exact, rtol=1 / (2 * N**2))

    def test_a_periodic_box_is_at_rest_under_a_uniform_force(self):
        result = run(fluid_scene("1e-3 2e-3 3e-3", None, boundary="boundary p p p", run="run 5"), 2)
        np.testing.assert_allclose(vector(result.thermo)[6:10], 0, atol=1e-15)

    def test_forces_in_real_units(self):
        # viscosity in g/mol/A/fs, body force and tractions in kcal/mol/A^3 and kcal/mol/A/A^2
        for body, upper, factors in (("0 0 0", "0.003 0 0", (48.88821291**2, 1)),
                                     ("1e-3 0 2e-3", "0 0 0", (1, 48.88821291**-2))):
            micro, real = (
                vector(run(fluid_scene(body, upper=upper, units=f"units {units}",
                                       timestep=None)).thermo)
                for units in ("micro", "real"))
            np.testing.assert_allclose(real[:6], micro[:6] * factors[0], rtol=1e-9, atol=1e-15)
            np.testing.assert_allclose(real[6:10], micro[6:10] * factors[1], rtol=1e-9, atol=1e-18)


class InTime(unittest.TestCase):
    def test_plate_velocity_from_a_variable(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run("variable U equal 0.001*sin(time*0.001)\n" +
                             fluid_scene(upper="v_U 0 0", run="run 12"), ranks)
                thermo = result.thermo
                np.testing.assert_allclose(thermo["f_flow[1]"],
                                           ETA * 0.001 * np.sin(thermo["Time"] * 0.001) / H,
                                           atol=1e-15)
                np.testing.assert_array_equal(thermo["f_flow[12]"], np.arange(13) + 1)

    def test_body_force_from_a_variable(self):
        thermo = run("variable g equal 1e-3*step\n" + fluid_scene("v_g 0 0", run="run 4")).thermo
        np.testing.assert_allclose(thermo["f_flow[4]"], 1e-3 * thermo["Step"] * H / 2, atol=1e-15)

    def test_a_second_run_solves_once_more(self):
        thermo = run(fluid_scene(upper="0.001 0 0", run="run 4\nrun 4")).thermo
        self.assertEqual(thermo["f_flow[12]"].tolist(), [1] * 5 + [2] * 5)

    def test_an_equal_style_variable_of_the_flow_itself(self):
        # a controller: body force until the mean velocity is what is wanted
        script = ("variable g equal 1e-4*(1+step)\n" + fluid_scene(
            "v_g 0 0", last="variable ratio equal f_flow[7]/v_g\nthermo_style custom step v_ratio",
            run="run 5"))
        ratio = run(script).thermo["v_ratio"]
        np.testing.assert_allclose(ratio, ratio[0], rtol=1e-12)


TRACERS = dict(cells="mass 1 1\ncreate_atoms 1 single 1 2 3\ncreate_atoms 1 single 11.9 11.9 6\n"
                     "create_atoms 1 single 6 6 10.5", thermo="thermo_style custom step f_flow[12]",
               every="thermo 100", ib="fix ib all rbc/ib flow integrator midpoint")


class Tracers(unittest.TestCase):
    """Atoms without forces follow the flow."""

    def test_couette(self):
        for kernel in ("peskin4", "roma3"):
            for integrator, solves in (("euler", 1), ("midpoint", 2)):
                for ranks in (1, 2):
                    with self.subTest(kernel, integrator=integrator, ranks=ranks):
                        result = run(fluid_scene(upper="0.003 0.001 0", dump=dump_line(50),
                                                 run="run 50", **{
                            **TRACERS, "ib": f"fix ib all rbc/ib flow kernel {kernel} integrator "
                                             f"{integrator}"}), ranks)
                        dump = result.dump()
                        moved = dump.positions() - dump.positions(0)
                        heights = dump.positions(0)[:, 2]
                        expected = np.outer(heights / H, [0.003, 0.001, 0]) * 50 * 200
                        np.testing.assert_allclose(moved, expected, atol=1e-12 * H)
                        self.assertEqual(result.thermo["f_flow[12]"][-1], 1 + solves * 50)

    def test_a_plate_that_moves_in_time_is_followed_to_second_order(self):
        errors = []
        for steps in (20, 40, 80):
            total = 4000.0
            script = f"variable U equal 0.003*sin(time*{2 * np.pi / total / 0.7})\n" + fluid_scene(
                upper="v_U 0 0", timestep=f"timestep {total / steps}", dump=dump_line(steps),
                run=f"run {steps}", **TRACERS)
            dump = run(script).dump()
            moved = (dump.positions() - dump.positions(0))[:, 0]
            omega = 2 * np.pi / total / 0.7
            exact = 0.003 * (1 - np.cos(omega * total)) / omega * dump.positions(0)[:, 2] / H
            errors.append(abs(moved - exact).max())
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        print(f"\nmoving plate: errors {errors}, orders {orders}")
        self.assertGreater(orders.min(), 1.8)

    def test_steady_flow_survives_load_balancing(self):
        for ib in (None, "fix ib all rbc/ib flow"):
            with self.subTest(ib=ib):
                result = run(fluid_scene(upper="0.003 0 0", dump=grid_dump(1, *VELOCITY),
                                         run="run 10", **{
                    **TRACERS, "ib": ib, "last": "fix lb all balance 2 1.0 shift xyz 5 1.0",
                    "thermo": "thermo_style custom step f_flow[1] f_flow[10]",
                    "every": "thermo 1"}), 4)
                np.testing.assert_allclose(result.thermo["f_flow[1]"], ETA * 0.003 / H, rtol=1e-12)
                for frame in result.dump("grid.dump").frames:
                    np.testing.assert_allclose(frame[:, 0].reshape(N, 4, 6).mean(axis=(1, 2)),
                                               0.003 * Z / H, rtol=1e-10)


class Output(unittest.TestCase):
    def test_vtk(self):
        from vtkmodules.vtkIOXML import vtkXMLRectilinearGridReader
        from vtkmodules.util.numpy_support import vtk_to_numpy
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                dumps = ("dump u all grid/vtk 5 u.*.vtr " +
                         " ".join(f"f_flow:grid:{name}" for name in VELOCITY) +
                         "\ndump p all grid/vtk 10 p.*.vtr f_flow:grid:pressure")
                result = run(fluid_scene("0 0 1e-3", upper="0.003 0 0", run="run 10", dump=dumps),
                             ranks)
                self.assertEqual(sorted(path.name for path in result.folder.glob("*.vtr")),
                                 ["p.0.vtr", "p.10.vtr", "u.0.vtr", "u.10.vtr", "u.5.vtr"])
                for name, width, expected in (("u", 3, 0.003 * Z / H),
                                              ("p", 1, 1e-3 * (Z - H / 2))):
                    reader = vtkXMLRectilinearGridReader()
                    reader.SetFileName(str(result.path(f"{name}.10.vtr")))
                    reader.Update()
                    grid = reader.GetOutput()
                    self.assertEqual(grid.GetNumberOfCells(), 6 * 4 * N)
                    np.testing.assert_allclose(grid.GetBounds(), (0, 12) * 3)
                    values = vtk_to_numpy(grid.GetCellData().GetArray(0)).reshape(N, 24, width)
                    np.testing.assert_allclose(values[:, :, 0], np.tile(expected[:, None], 24),
                                               rtol=1e-5)

    def test_fix_ave_grid(self):
        script = ("variable U equal 0.001*step\n" + fluid_scene(
            upper="v_U 0 0", run="run 10", timestep="timestep 1",
            last="fix mean all ave/grid 1 5 5 6 4 16 f_flow:grid:velocity[1] f_flow:grid:pressure\n"
                 "dump mean all grid 5 mean.dump f_mean:grid:data[1] f_mean:grid:data[2]\n"
                 "dump_modify mean sort id format float %.17g"))
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                dump = run(script, ranks).dump("mean.dump")
                mean = dump.frames[-1].reshape(N, -1, 2).mean(axis=1)
                # steps 6 to 10
                np.testing.assert_allclose(mean[:, 0], 0.001 * 8 * Z / H, rtol=1e-10)

    def test_fix_ave_time_and_variables(self):
        result = run(fluid_scene(
            upper="0.003 0 0", run="run 4", last="fix out all ave/time 1 2 2 f_flow f_flow[1] "
            "f_flow[12] file out.txt format ' %.17g'\nvariable stress equal f_flow[1]\n"
            "thermo_style custom step v_stress"))
        rows = np.loadtxt(result.path("out.txt"))
        np.testing.assert_allclose(rows[:, 2], ETA * 0.003 / H, rtol=1e-12)
        np.testing.assert_allclose(result.thermo["v_stress"], ETA * 0.003 / H, rtol=1e-12)


class Costs(unittest.TestCase):
    """What a flow does not need it neither stores nor sends."""

    def cost(self, regime, ranks=1, vertices=False, walls=True):
        """Messages and bytes of a solve and MPI task, bytes of memory per cell."""
        steps = 20
        script = fluid_scene(upper="v_U 0 0", lower="0 0 0" if walls else None, grid="grid 8 8 16",
                             regime=regime + ("" if walls else " mean v_U 0 0"), run=f"run {steps}",
                             boundary=f"boundary p p {'f' if walls else 'p'}",
                             **{**TRACERS, "before": "variable U equal 1e-3*cos(step/10)",
                                "thermo": "thermo_style custom step f_flow[12]",
                                "ib": "fix ib all rbc/ib flow integrator euler"
                                if vertices else None})
        result = run(script, ranks)
        words = re.search(r"Fluid: (\S+) messages and (\S+) bytes per step and MPI task, (\S+) "
                          "bytes of memory per cell", result.printed).groups()
        messages, sent, memory = map(float, words)
        # of the steps: that of the setup does not count
        solves = np.ptp(result.thermo["f_flow[12]"])
        return messages * steps / solves, sent * steps / solves, memory

    def test_one_rank_sends_nothing(self):
        for regime in ("none", "unsteady", "convective"):
            for vertices in (False, True):
                self.assertEqual(self.cost("inertia " + regime, vertices=vertices)[:2], (0, 0),
                                 regime)

    def test_memory(self):
        for walls in (True, False):
            with self.subTest(walls=walls):
                none, unsteady, convective, projection = (
                    self.cost(f"inertia {regime}", walls=walls)[2]
                    for regime in ("none", "unsteady", "convective", "unsteady scheme projection"))
                cells = {name: self.cost(f"inertia {name}", vertices=True, walls=walls)[2]
                         for name in ("none", "unsteady", "convective")}
                print(f"\nbytes per cell: none {none}, unsteady {unsteady}, convective "
                      f"{convective}, projection {projection}; with vertices {cells}")
                ghosts = 10 * 10 * 18 / (8 * 8 * 16)
                np.testing.assert_allclose(unsteady - none, 24 * ghosts, rtol=0.01)
                np.testing.assert_allclose(convective - unsteady, 24, rtol=0.01)
                # keeps a pressure
                (self.assertGreater if walls else self.assertEqual)(projection, unsteady)
                for name, alone in (("none", none), ("unsteady", unsteady),
                                    ("convective", convective)):
                    self.assertGreater(cells[name], alone + 24)

    def test_messages_without_vertices(self):
        for walls in (True, False):
            for ranks in (2, 4):
                with self.subTest(ranks=ranks, walls=walls):
                    none, unsteady, convective, projection = (
                        self.cost(f"inertia {regime}", ranks, walls=walls)
                        for regime in ("none", "unsteady", "convective",
                                       "unsteady scheme projection"))
                    vertices = self.cost("inertia none", ranks, True, walls)
                    print(f"\n{ranks} ranks: messages and bytes a solve: none {none[:2]}, unsteady "
                          f"{unsteady[:2]}, "
                          f"convective {convective[:2]}; with vertices {vertices[:2]}")
                    self.assertGreater(none[0], 0)
                    for other in (unsteady, projection):
                        np.testing.assert_allclose(other[:2], none[:2], rtol=1e-3)
                    self.assertGreater(convective[0], unsteady[0])
                    self.assertGreater(convective[1], unsteady[1])
                    self.assertGreater(vertices[1], convective[1])


class WithCells(unittest.TestCase):
    def test_divergence_and_balance_of_forces(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                thermo = "thermo_style custom step f_flow[11] " + " ".join(f"f_flow[{n}]"
                                                                           for n in range(1, 7))
                table = run(scene(thermo=thermo, run="run 50"), ranks).thermo
                print(f"\nlargest divergence with a cell, {ranks} ranks: "
                      f"{table['f_flow[11]'].max():.2g}")
                self.assertLess(table["f_flow[11]"].max(), 1e-12)
                # a membrane exerts no net force: what one plate gets the other gives
                for low, high in ((1, 4), (2, 5), (3, 6)):
                    np.testing.assert_allclose(table[f"f_flow[{low}]"], -table[f"f_flow[{high}]"],
                                               atol=1e-12 * table["f_flow[1]"].max())

    def test_a_force_on_the_cell_goes_to_the_plates(self):
        # wherever the fix that makes it comes in the script
        results = []
        for place in ("before", "last"):
            result = run(scene(
                **{place: "fix push all addforce 1e-4 2e-4 -3e-4"}, run="run 5", every="thermo 5",
                dump=dump_line(5),
                thermo="thermo_style custom step " + " ".join(f"f_flow[{n}]" for n in range(1, 7))))
            for d, force in enumerate((1e-4, 2e-4, -3e-4)):
                total = (result.thermo[f"f_flow[{d + 1}]"] + result.thermo[f"f_flow[{d + 4}]"])[-1]
                np.testing.assert_allclose(total, 162 * force / 144, rtol=1e-9)
            results.append(result.dump().positions())
        np.testing.assert_array_equal(results[0], results[1])


if __name__ == "__main__":
    unittest.main()
