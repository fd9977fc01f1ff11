"""fix rbc/port through LAMMPS: a closed tube between two ports against Poiseuille's law, given
pressures, time, restart, tasks, errors."""

import re
import unittest

import numpy as np

from error_case import BadInput
from lammps_case import POTENTIALS, Failed, attempt, dump_line, in_parallel, run, scene

VISCOSITY = 1.2
MARGIN = 4    # between the tube and the sides of the box

TUBE = dict(
    units="units micro", style="atom_style molecular", boundary="boundary p p p", processors="",
    box="", create_box="create_box 2 box angle/types 1", vessel="", more="", mass="mass * 1.0",
    groups="group wall type 2\ngroup cells type 1",
    neighbor="neighbor 1.0 bin\nneigh_modify every 1 delay 0 check no exclude group wall all\n"
             "comm_modify cutoff 6",
    regions="", variables="",
    fluid=f"fix flow all rbc/fluid dx 1.0 viscosity {VISCOSITY} inside tube",
    wall="fix wall wall rbc/wall flow sheets yes kernel peskin4 tol 1e-4",
    inlet="fix in all rbc/port flow region inlet flow 1.0",
    outlet="fix out all rbc/port flow region outlet", ib="",
    thermo="thermo_style custom step f_in[1] f_in[2] f_in[3] f_out[1] f_out[2] f_out[3] f_flow[11] "
           "f_flow[12]",
    thermo_modify="thermo_modify format float %.17g", every="thermo 1", timestep="timestep 100",
    dump="", run="run 0")


def tube(radius, length, **changes):
    """A closed tube along x, with ports of a diameter at its ends."""
    begin, end, side = MARGIN, MARGIN + length, 2 * (radius + MARGIN)
    lines = dict(TUBE)
    lines["box"] = f"region box block 0 {length + 2 * MARGIN} 0 {side} 0 {side}"
    lines["vessel"] = (f"region tube cylinder x {side / 2} {side / 2} {radius} {begin} {end}\n"
                       "rbc/surface tube type 2 spacing 1.2 mass 1.0")
    lines["regions"] = (f"region inlet block INF {begin + 2 * radius} INF INF INF INF\n"
                        f"region outlet block {end - 2 * radius} INF INF INF INF INF")
    return scene(lines, **changes)


SMALL = (6, 40)    # radius and length: 0.2 s


class StraightTube(unittest.TestCase):
    RADIUS, LENGTH = 10, 88

    @classmethod
    def setUpClass(cls):
        dump = ("dump grid all grid 1 flow.grid f_flow:grid:velocity[*] f_flow:grid:pressure\n"
                "dump_modify grid format float %.12g")
        cls.result = run(tube(cls.RADIUS, cls.LENGTH, dump=dump))
        n = np.array([100, 28, 28])    # 28 is a product of 2, 2, 7; 96 is none of small primes
        data = cls.result.dump("flow.grid").frames[-1]
        n[0] = len(data) // (n[1] * n[2])
        cls.u = data[:, 0].reshape(n[2], n[1], n[0])
        cls.p = data[:, 3].reshape(n[2], n[1], n[0])
        side = np.array([cls.LENGTH + 2 * MARGIN, 2 * (cls.RADIUS + MARGIN),
                         2 * (cls.RADIUS + MARGIN)])
        cls.h = side / n
        y = (np.arange(n[1]) + 0.5) * cls.h[1] - side[1] / 2
        cls.r = np.hypot(y[None, :], y[:, None])
        x = (np.arange(n[0]) + 0.5) * cls.h[0] - MARGIN
        cls.x = x
        # a diameter from the ports
        cls.middle = abs(x - cls.LENGTH / 2) < cls.LENGTH / 2 - 4 * cls.RADIUS

    def test_profile(self):
        fastest = 2 / (np.pi * self.RADIUS**2)
        exact = fastest * (1 - (self.r / self.RADIUS)**2)
        core = self.r < self.RADIUS - 2    # the kernel blurs the rest
        for i in np.flatnonzero(self.middle):
            error = abs(self.u[:, :, i] - exact)[core].max() / fastest
            self.assertLess(error, 0.01)

    def test_pressure_gradient(self):
        core = self.r < self.RADIUS / 2
        p = np.array([self.p[:, :, i][core].mean() for i in np.flatnonzero(self.middle)])
        gradient = np.polyfit(self.x[self.middle], p, 1)[0]
        self.assertAlmostEqual(gradient / (-8 * VISCOSITY / (np.pi * self.RADIUS**4)), 1,
                               delta=0.01)

    def test_hardly_any_fluid_passes_the_wall(self):
        within = self.r < self.RADIUS + 1.5
        flow = [self.u[:, :, i][within].sum() * self.h[1] * self.h[2]
                for i in np.flatnonzero(self.middle)]
        self.assertLess(abs(np.array(flow) - 1).max(), 2e-3)

    def test_output(self):
        last = self.result.thermo
        self.assertEqual((last["f_in[1]"][0], last["f_out[1]"][0], last["f_out[2]"][0]), (1, -1, 0))
        self.assertLess(last["f_flow[11]"][0], 1e-13)
        volume = np.pi * self.RADIUS**2 * 2 * self.RADIUS
        for port in ("in", "out"):    # cut by the tube
            self.assertAlmostEqual(last[f"f_{port}[3]"][0] / volume, 1, delta=0.03)


class Pressures(unittest.TestCase):
    def test_resistance_grows_with_the_length(self):
        radius, lengths = 8, (48, 64)
        law = 8 * VISCOSITY * (lengths[1] - lengths[0]) / (np.pi * radius**4)
        given = [run(tube(radius, length)).thermo["f_in[2]"][0] for length in lengths]
        self.assertAlmostEqual((given[1] - given[0]) / law, 1, delta=0.01)
        ports = dict(inlet="fix in all rbc/port flow region inlet pressure 0.05",
                     outlet="fix out all rbc/port flow region outlet pressure 0.02")
        for length, pressure in zip(lengths, given):
            last = run(tube(radius, length, **ports)).thermo
            self.assertAlmostEqual(last["f_in[2]"][0], 0.05, delta=1e-7)
            self.assertEqual(last["f_out[2]"][0], 0.02)
            self.assertAlmostEqual(last["f_in[1]"][0] * pressure / 0.03, 1, delta=1e-4)
            self.assertAlmostEqual(last["f_in[1]"][0] + last["f_out[1]"][0], 0, delta=1e-15)

    def test_fork_of_three_ports(self):
        """Its resistances are symmetric, and pressures and flows belong together."""
        fork = dict(
            vessel="region trunk cylinder x 14 14 6 4 44\nregion branch cylinder y 24 14 5 14 40\n"
            "region tube union 2 trunk branch\nrbc/surface tube type 2 spacing 1.2 mass 1.0",
            box="region box block 0 48 0 44 0 28",
            regions="region inlet block INF 12 INF INF INF INF\n"
                    "region outlet block 36 INF INF INF INF INF\n"
            "region side block INF INF 31 INF INF INF")
        thermo = TUBE["thermo"] + " f_side[1] f_side[2]"
        names = ("in", "side", "out")

        def ports(keyword, values):
            lines = [f"fix {name} all rbc/port flow region {region}" +
                     (f" {keyword} {value}" if value is not None else "")
                     for name, region, value in zip(names, ("inlet", "side", "outlet"), values)]
            return run(tube(6, 40, **fork, thermo=thermo, inlet=lines[0],
                            outlet="\n".join(lines[1:]))).thermo

        cases = [("flow", (1, 0, None)), ("flow", (0, 1, None)), ("flow", (0.7, -0.4, None))]
        one, other, both = in_parallel(ports, cases)
        self.assertAlmostEqual(one["f_side[2]"][0] / other["f_in[2]"][0], 1, delta=2e-3)
        for name in names:
            self.assertAlmostEqual(both[f"f_{name}[2]"][0],
                                   0.7 * one[f"f_{name}[2]"][0] - 0.4 * other[f"f_{name}[2]"][0],
                                   delta=2e-5)
        held = ports("pressure", tuple(float(both[f"f_{name}[2]"][0]) for name in names))
        for name, rate in zip(names, (0.7, -0.4, -0.3)):
            self.assertAlmostEqual(held[f"f_{name}[1]"][0], rate, delta=1e-3)

    def test_another_one_at_the_start_of_a_run(self):
        ports = dict(variables="variable p equal 0.05",
                     inlet="fix in all rbc/port flow region inlet pressure v_p",
                     outlet="fix out all rbc/port flow region outlet pressure 0.02")
        begin = tube(*SMALL, **ports, run="run 0\nvariable p equal 0.08\nrun 0\nrun 1\n"
                                          "write_restart r\nclear")
        made = ("units", "atom_style", "boundary", "region box", "create_box", "rbc/surface",
                "mass", "run", "variable p", "write_restart", "clear")
        after = "\n".join(line for line in begin.splitlines() if not line.startswith(made))
        tables = run(f"{begin}\nread_restart r\nvariable p equal 0.14\n{after}\nrun 0\n").tables()
        rate = tables[0]["f_in[1]"][0] / 0.03
        for table, pressure in zip(tables, (0.05, 0.08, 0.08, 0.14)):
            np.testing.assert_allclose(table["f_in[2]"], pressure, atol=1e-6)
            np.testing.assert_allclose(table["f_in[1]"], rate * (pressure - 0.02), rtol=1e-4)

    def test_a_stream_much_faster_than_what_probes(self):
        """Half of what enters in the middle leaves at each end. The error of the wall, a part of
        the fastest flow, does not drown the response to the flows that tell it."""
        ends = tube(*SMALL, wall="fix wall wall rbc/wall flow",
                    inlet="fix in all rbc/port flow region inlet pressure 0",
                    outlet="fix out all rbc/port flow region outlet pressure 0\n"
                    "region middle block 19 29 INF INF INF INF\n"
                    "fix more all rbc/port flow region middle flow 0.6")
        last = run(ends).thermo
        self.assertAlmostEqual(last["f_in[1]"][0], -0.3, delta=0.003)
        self.assertAlmostEqual(last["f_in[2]"][0], 0, delta=1e-3)


CELL = dict(
    units="units micro", style="atom_style molecular", boundary="boundary p p p",
    box="region box block 0 24 0 16 0 16",
    create_box="create_box 1 box angle/types 1", molecule=f"molecule rbc {POTENTIALS}/rbc_162.mol",
    cells="rbc/create rbc single 12 8 8 rotate 30 1 0 0", mass="mass * 1.0",
    neighbor="neighbor 1.0 bin",
    membrane="fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
             "volume yes",
    variables="variable Q equal 0.05*cos(2*PI*step*dt/8000)",
    fluid="fix flow all rbc/fluid dx 1.0 viscosity 1.2",
    ports="region a sphere 3 8 8 2.5\nregion b sphere 21 8 8 2.5\n"
          "fix in all rbc/port flow region a flow v_Q\n"
    "fix out all rbc/port flow region b", ib="fix ib all rbc/ib flow integrator midpoint",
    thermo="thermo_style custom step f_in[1] f_out[1] v_Q",
    thermo_modify="thermo_modify format float %.17g",
    every="thermo 1", timestep="timestep 200", dump="", run="run 0")


class Added(unittest.TestCase):
    def test_a_port_has_no_numbers_before_its_first_run(self):
        ask = "print 'side $(f_side[1]) $(f_side[2]) $(f_side[3])'"
        lines = ["run 0", "region middle block 19 29 INF INF INF INF",
                 "fix side all rbc/port flow region middle flow 0", ask, "info memory", "run 0",
                 ask]
        printed = run(tube(*SMALL, run="\n".join(lines))).printed
        before, after = re.findall(r"^side (\S+) (\S+) (\S+)$", printed, re.MULTILINE)
        self.assertEqual(before, ("0", "0", "0"))
        self.assertEqual(after[0], "0")
        self.assertGreater(float(after[1]), 0)
        self.assertAlmostEqual(float(after[2]) / (10 * np.pi * SMALL[0]**2), 1, delta=0.03)


class Time(unittest.TestCase):
    def test_flow_of_a_variable(self):
        last = run(scene(CELL, run="run 7")).thermo
        np.testing.assert_array_equal(last["f_in[1]"], last["v_Q"])
        np.testing.assert_array_equal(last["f_out[1]"], -last["v_Q"])
        self.assertGreater(np.ptp(last["v_Q"]), 0.02)

    def test_second_order(self):
        places = [
            run(scene(CELL, timestep=f"timestep {1600 / steps}", dump=dump_line(steps), every="",
                      run=f"run {steps}")).dump().positions() for steps in (8, 16, 32)]
        apart = [np.sqrt(((a - b)**2).mean()) for a, b in zip(places, places[1:])]
        start = run(scene(CELL, dump=dump_line(1))).dump().positions()
        print(f"\nmoved {abs(places[0] - start).max():.3g}, apart {apart}")
        self.assertGreater(apart[0], 1e-6)
        self.assertGreater(np.log2(apart[0] / apart[1]), 1.8)


def with_cell(**changes):
    """A cell in a closed tube between pressures, one of which varies."""
    return tube(7, 40, **{
        "more": f"molecule rbc {POTENTIALS}/rbc_162.mol\n"
                "rbc/create rbc single 24 11 11 rotate 30 1 0 0",
        "variables": "variable p equal 0.05+0.01*sin(step)",
        "wall": TUBE["wall"] + "\nfix mem cells rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 "
                               "bending 2.0e-4 volume yes",
        "inlet": "fix in all rbc/port flow region inlet pressure v_p",
        "outlet": "fix out all rbc/port flow region outlet pressure 0.01",
        "timestep": "timestep 10", "ib": "fix ib cells rbc/ib flow integrator midpoint", **changes})


class Restart(unittest.TestCase):
    STEPS = 5

    def test_a_run_in_pieces_is_that_of_one_piece(self):
        steps = self.STEPS
        columns = "id xu yu zu vx vy vz"
        begin = with_cell(every=f"thermo {steps}", run="", dump="")
        after = "\n".join(line for line in begin.splitlines() if not line.startswith(
            ("units", "atom_style", "boundary", "region box", "create_box", "rbc/create",
             "rbc/surface", "mass")))
        script = (f"{begin}{dump_line(2 * steps, 'whole', columns)}\nrun {2 * steps}\nclear\n"
                  f"{begin}{dump_line(2 * steps, 'pieces', columns)}\nrun {steps}\n"
                  f"write_restart r\nrun {steps}\nclear\n"
                  f"read_restart r\n{after}\n{dump_line(2 * steps, 'after', columns)}\n"
                  f"run {steps}\n")
        for ranks in (1, 2):
            result = run(script, ranks)
            tables = result.tables()
            whole = result.dump("whole").frames[-1]
            for name, table in (("pieces", tables[2]), ("after", tables[3])):
                with self.subTest(name, ranks=ranks):
                    np.testing.assert_array_equal(result.dump(name).frames[-1], whole)
                    for column in ("f_in[1]", "f_in[2]", "f_out[1]"):
                        self.assertEqual(table[column][-1], tables[0][column][-1])


class Tasks(unittest.TestCase):
    def test_any_number_of_them(self):
        changes = dict(wall=with_cell().split("fix wall ")[1].split("fix in")[0])
        changes = dict(wall="fix wall " + changes["wall"].replace("tol 1e-4", "tol 1e-10"))
        results = [run(with_cell(**changes, dump=dump_line(3), run="run 3"), ranks)
                   for ranks in (1, 2, 4)]
        for result in results[1:]:
            apart = abs(result.dump().positions() - results[0].dump().positions()).max()
            print(f"\napart {apart:.2g}")
            self.assertLess(apart, 1e-9)
            for column in ("f_in[1]", "f_in[2]"):
                np.testing.assert_allclose(result.thermo[column], results[0].thermo[column],
                                           rtol=1e-8)
            self.assertEqual(result.thermo["f_in[3]"][0], results[0].thermo["f_in[3]"][0])

    def test_load_balancing(self):
        script = tube(*SMALL, run="run 0\nbalance 1.0 x 0.3\nrun 0\nrun 0")
        tables = run(script, 2).tables()
        for table in tables[1:]:
            # tol of the wall
            np.testing.assert_allclose(table["f_in[2]"], tables[0]["f_in[2]"], rtol=1e-3)
            self.assertLess(table["f_flow[11]"][0], 1e-13)
            self.assertEqual(table["f_in[3]"][0], tables[0]["f_in[3]"][0])


class Unused(unittest.TestCase):
    def test_nothing_is_left_of_ports_that_were_removed(self):
        changes = dict(thermo="thermo_style custom step f_flow[7] f_flow[10] f_mem", every="",
                       fluid=CELL["fluid"] + " body 1e-5 0 0 mean 1e-4 0 0")
        never = run(scene(CELL, **changes, ports="", run="run 0\nrun 5"))
        removed = run(scene(CELL, **changes, run="run 0\nunfix in\nunfix out\nrun 5"))
        self.assertNotEqual(removed.tables()[0]["f_flow[10]"][0],
                            never.tables()[0]["f_flow[10]"][0])
        for column, values in removed.tables()[1].items():
            np.testing.assert_array_equal(values, never.tables()[1][column])
        costs = [re.findall(r"Fluid: (\S+) messages and (\S+) bytes per step and MPI task, (\S+) "
                            "bytes of", result.printed)
                 for result in (never, removed)]
        self.assertEqual(costs[1][-1][:2], costs[0][-1][:2])
        modes = 16 * 0.6    # of the source: they stay with the solver
        self.assertLess(float(costs[1][-1][2]) - float(costs[0][-1][2]), modes)

    def test_ports_that_are_gone_before_other_commands(self):
        ports = dict(inlet="fix in all rbc/port flow region inlet pressure 0.02",
                     outlet="fix out all rbc/port flow region outlet pressure 0")
        after = ("thermo_style custom step\nunfix in\nbalance 1.0 x 0.4\nwrite_restart r\n"
                 f"{ports['inlet']}\n{TUBE['thermo']}\n{TUBE['thermo_modify']}\nrun 0")
        tables = run(tube(*SMALL, **ports, run="run 0\n" + after), 2).tables()
        np.testing.assert_allclose(tables[1]["f_in[2]"], 0.02, atol=1e-6)
        np.testing.assert_allclose(tables[1]["f_in[1]"], tables[0]["f_in[1]"], rtol=1e-3)

    def test_a_solve_with_ports_costs_a_transform_more(self):
        """And two scalar fields: the supply and its modes."""
        memory = [
            float(re.search(r"(\S+) bytes of memory per cell", run(
                scene(CELL, ports=ports, thermo="thermo_style custom step", run="run 5"))
                .printed).group(1))
            for ports in ("", CELL["ports"])]
        self.assertLess(memory[1] - memory[0], 8 + 16 * 0.6)
        self.assertGreater(memory[1] - memory[0], 8)


IN, OUT = TUBE["inlet"], TUBE["outlet"]
ERRORS = {
    "fluid missing": (dict(inlet="fix in all rbc/port"), ["rbc/port"]),
    "no such fluid": (dict(inlet=IN.replace("flow region", "water region")),
                      ["Fix rbc/port in: there is no fix rbc/fluid with ID water"]),
    "open sides": (dict(boundary="boundary f p p"),
                   ["periodic boundaries in x and y", "ends are ports lies as a whole",
                    "4 dx from its sides"]),
    "sides that shrink": (dict(boundary="boundary p m p"),
                          ["periodic boundaries in x and y", "ends are ports"]),
    "no region": (dict(inlet="fix in all rbc/port flow flow 1"),
                  ["Fix rbc/port in needs a region"]),
    "unknown keyword": (dict(inlet=IN + " speed 1"),
                        ["fix rbc/port", "speed", "region, flow, pressure"]),
    "flow missing": (dict(inlet="fix in all rbc/port flow region inlet flow"),
                     ["fix rbc/port flow", "missing"]),
    "flow no number": (dict(inlet=IN.replace("1.0", "much")), ["much"]),
    "flow and pressure": (dict(inlet=IN + " pressure 0"),
                          ["Fix rbc/port in: a port has one flow or one pressure"]),
    "no such region": (dict(inlet=IN.replace("region inlet", "region there")),
                       ["Region ID there for fix rbc/port in does not exist"]),
    "empty region":
        (dict(regions="region inlet block 5 6 0 1 0 1\nregion outlet block 30 40 0 20 0 20"),
         ["Region inlet for fix rbc/port in holds no centre of a cell", "inside the vessel"]),
    "region that moves": (dict(
        regions="variable z equal 0\nregion inlet block 5 10 0 20 0 20 move v_z v_z v_z\n"
        "region outlet block 30 40 0 20 0 20"), ["Region inlet for fix rbc/port in must not move"]),
    "no such variable": (dict(inlet=IN.replace("1.0", "v_Q")),
                         ["Variable Q for fix rbc/port does not exist"]),
    "flows with a sum": (dict(outlet=OUT + " flow -0.5"),
                         ["flows of fix rbc/port in, fix rbc/port out sum to 0.5", "must sum to 0",
                          "leave out"]),
    "one port with a flow": (dict(outlet=""), ["flows of fix rbc/port in sum to 1"]),
    "two without flow": (dict(inlet=IN.replace(" flow 1.0", "")),
                         ["Fix rbc/port in and Fix rbc/port out have neither flow nor pressure",
                          "only one"]),
    "pressure and nothing": (dict(inlet=IN.replace("flow 1.0", "pressure 1")),
                             ["Fix rbc/port out has neither flow nor pressure",
                              "Fix rbc/port in has a pressure"]),
    "no number": (dict(variables="variable Q equal exp(1e5)", inlet=IN.replace("1.0", "v_Q")),
                  ["Fix rbc/port in: its flow is not a number at step 0"]),
    "inertia": (dict(fluid=TUBE["fluid"] + " density 1 inertia unsteady", wall=""),
                ["Fix rbc/port in needs fix rbc/fluid flow inertia none"]),
    "all of the fluid": (dict(fluid=TUBE["fluid"].replace(" inside tube", ""), wall="",
                              regions="region inlet block INF INF INF INF INF INF\n"
                                      "region outlet block 30 40 0 20 0 20"),
                         ["Region inlet for fix rbc/port in holds all of the fluid"]),
    "pressures in one place": (dict(inlet=IN.replace("flow 1.0", "pressure 1"),
                                    outlet=OUT + " pressure 0",
                                    regions="region inlet block 5 20 0 20 0 20\n"
                                            "region outlet block 5 20 0 20 0 20", run="run 3"),
                               ["no flow gives it its pressure", "openings of one vessel"]),
    "a mean velocity": (dict(fluid=TUBE["fluid"] + " mean x 1e-3"),
                        ["Fix rbc/port in cannot be used with fix rbc/fluid flow mean x"]),
}


class Errors(BadInput):
    def test_errors(self):
        def attempt_one(name):
            changes = dict(ERRORS[name][0])
            changes["thermo"] = "thermo_style custom step"
            return attempt(tube(*SMALL, **changes))
        for name, result in zip(ERRORS, in_parallel(attempt_one, [(name,) for name in ERRORS])):
            with self.subTest(name):
                self.refused(result, ERRORS[name][1])

    def test_minimize(self):
        with self.assertRaises(Failed) as caught:
            run(tube(*SMALL, run="minimize 0 0 1 1", wall=""))
        self.assertIn("minimize", caught.exception.result.error)


if __name__ == "__main__":
    unittest.main()
