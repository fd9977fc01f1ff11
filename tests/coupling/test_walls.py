"""fix rbc/wall through LAMMPS: planes and spheres of atoms against closed forms, a tube with cells,
moving walls, tasks, errors."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, attempt, dump_line, run, scene

VISCOSITY = 1.2
OFFSET = 0.3810    # of a plane of markers with peskin4, mean over its places, in cells


def weights(s):
    """peskin4 at s cells from a layer of the grid: distances and weights."""
    r = s % 1
    root = np.sqrt(1 + 4 * r * (1 - r))
    return (np.arange(4) - 1 - r,
            np.array([3 - 2 * r - root, 3 - 2 * r + root, 1 + 2 * r + root, 1 + 2 * r - root]) / 8)


def offset(s):
    """Half the mean distance of two points."""
    x, w = weights(s)
    return 0.5 * (np.outer(w, w) * abs(np.subtract.outer(x, x))).sum()


def mean_square(s):
    x, w = weights(s)
    return w @ x**2


def data_file(box, *walls):
    """Atoms of type 2, 3, ... for each wall; cells are of type 1."""
    atoms = [(kind, *x) for kind, wall in enumerate(walls, 2) for x in wall]
    lines = [f"{n} 0 {kind} {x!r} {y!r} {z!r}" for n, (kind, x, y, z) in enumerate(atoms, 1)]
    sides = [f"0 {side} {name}lo {name}hi" for side, name in zip(box, "xyz")]
    return "\n".join(["walls", "", f"{len(atoms)} atoms", f"{1 + len(walls)} atom types",
                      "1 angle types", "", *sides, "", "Atoms # molecular", "", *lines, ""])


def plane(box, z):
    return [(i + 0.1, j + 0.7, z) for i in range(box[0]) for j in range(box[1])]


def tube(box, radius, spacing=1.2):
    rings, around = 2 * round(box[0] / (2 * spacing)), round(2 * np.pi * radius / spacing)
    return [(box[0] * (ring + 0.3) / rings, float(box[1] / 2 + radius * np.cos(angle)),
             float(box[2] / 2 + radius * np.sin(angle)))
            for ring in range(rings)
            for angle in 2 * np.pi * (np.arange(around) + 0.5 * (ring % 2)) / around]


def sphere(centre, radius, spacing=1.2):
    count = round(4 * np.pi * radius**2 / spacing**2)
    z = 1 - (2 * np.arange(count) + 1) / count
    angle, across = np.pi * (3 - 5**0.5) * np.arange(count), np.sqrt(1 - z * z)
    return (np.array(centre) +
            radius * np.array([across * np.cos(angle), across * np.sin(angle), z]).T).tolist()


COLUMNS = [f"f_w[{n}]" for n in range(1, 10)] + [f"f_flow[{n}]" for n in (1, 7, 8, 10, 12)]
BASE = dict(units="units micro", newton="", style="atom_style molecular", boundary="boundary p p p", processors="",
            data="read_data walls.data", mass="mass * 1.0", neighbor="neighbor 1.0 bin", comm="comm_modify cutoff 12",
            pair="pair_style zero 2.0\npair_coeff * *", groups="group w type 2", before="",
            fluid=f"fix flow all rbc/fluid dx 1.0 viscosity {VISCOSITY} density 1.0", drive="",
            wall="fix w w rbc/wall flow kernel peskin4", ib="",
            thermo="thermo_style custom step " + " ".join(COLUMNS), thermo_modify="thermo_modify format float %.15g",
            every="thermo 1", timestep="timestep 100", dump="", run="run 0")


def script(drive="", wall="", **changes):
    lines = dict(BASE, **changes)
    lines["fluid"] += " " + drive
    lines["wall"] += " " + wall
    del lines["drive"]
    return scene(lines)


def walls(box, *surfaces, drive="", wall="", ranks=1, tries=False, **changes):
    files = {"walls.data": data_file(box, *surfaces)}
    return (attempt if tries else run)(script(drive, wall, **changes), ranks, files=files)


PLATES = dict(boundary="boundary p p f")
AT_REST = "wall zlo 0 0 0 wall zhi 0 0 0"


class Planes(unittest.TestCase):
    BOX = (16, 16, 24)

    def test_poiseuille_flow_on_both_sides(self):
        for z in (12.0, 12.3):
            result = walls(self.BOX, plane(self.BOX, z), drive=f"body 1e-4 0 0 {AT_REST}",
                           wall="tol 1e-8", **PLATES)
            # Of the difference equations: u = g / 8 + b y - g y^2 / 2 at y from a plate, in each
            # channel of height h, as the mean of u at -1/2 and 1/2 is 0. The plane feels
            # u(h) + (both shears) d - g r^2 / 2.
            d, spread, h, g = (offset(z - 0.5), mean_square(z - 0.5), np.array([z, 24 - z]),
                               1e-4 / VISCOSITY)
            u = (g / 2 * spread - d * (g * h / 2 + g / 8 / h).sum()) / (1 - d * (1 / h).sum())
            b = (u - g / 8) / h + g * h / 2
            shears = g * h - b
            # sums over cells are integrals but for the curvature, and for the spread of the kink
            flux = (g / 8 * h + b * h**2 / 2 - g * h**3 / 6 + g * h / 24 +
                    shears * (spread / 2 - 1 / 8)).sum()
            self.assertAlmostEqual(result.thermo["f_flow[7]"][0] / (flux / 24), 1, delta=1e-3)
            self.assertAlmostEqual(result.thermo["f_w[1]"][0] / (VISCOSITY * shears.sum() * 256), 1,
                                   delta=1e-3)

    def test_moves_with_a_variable_velocity(self):
        z, steps, dt, final = 11.8, 8, 100.0, 4e-3
        result = walls(self.BOX, plane(self.BOX, z), drive=AT_REST, wall="velocity v_u v_v 0 tol 1e-8",
                       before=f"variable u equal {final}*step/{steps}\nvariable v equal 1e-3", run=f"run {steps}",
                       dump=dump_line(steps, columns="id xu yu zu vx vy vz"), **PLATES)
        start, end = (result.dump()("xu", "yu", "zu", frame=n) for n in (0, -1))
        expected = [final * steps * dt / 2, 1e-3 * steps * dt, 0]
        np.testing.assert_allclose(end - start, np.tile(expected, (256, 1)), atol=1e-12)
        np.testing.assert_allclose(result.dump()("vx", "vy", "vz"),
                                   np.tile([final, 1e-3, 0], (256, 1)))
        both, d = 1 / z + 1 / (24 - z), offset(z - 0.5)
        speeds = final * np.arange(steps + 1) / steps
        np.testing.assert_allclose(result.thermo["f_w[1]"],
                                   -VISCOSITY * speeds / (1 / both - d) * 256, rtol=1e-3, atol=1e-9)
        np.testing.assert_allclose(result.thermo["f_w[2]"],
                                   -VISCOSITY * 1e-3 / (1 / both - d) * 256, rtol=1e-3)

    def test_two_walls_shear_the_fluid_between_them(self):
        # and it carries that outside with it: no force is left in a periodic box
        box, apart = (16, 16, 32), 16
        result = walls(box, plane(box, 8.2), plane(box, 8.2 + apart), groups="group w type 2\ngroup v type 3",
                       wall="tol 1e-8 velocity 1e-3 0 0\nfix v v rbc/wall flow kernel peskin4 tol 1e-8 velocity -1e-3 0 0",
                       thermo=BASE["thermo"] + " f_v[1] f_v[8]")
        last = result.thermo
        d = offset(8.2 - 0.5)
        self.assertAlmostEqual(last["f_w[1]"][0], -last["f_v[1]"][0], delta=1e-9)
        # 16 cells to both sides: stress of both sides times 1 / (h / 2 (of two channels) - d)
        self.assertAlmostEqual(last["f_w[1]"][0] / (-VISCOSITY * 256 * 1e-3 / (apart / 4 - d)), 1,
                               delta=1e-3)
        self.assertEqual(last["f_w[8]"][0], last["f_v[8]"][0])


class Spheres(unittest.TestCase):
    def test_torque_in_shear_flow(self):
        # 4 pi eta a^3 times the shear rate in unbounded flow; with the offset of a plane, of second
        # order in 1 / a
        box, radius, rate = (54, 54, 54), 8.0, 1e-4
        u = rate * box[2] / 2
        result = walls(box, sphere((27.1, 27.2, 27.0), radius - OFFSET),
                       drive=f"wall zlo {-u} 0 0 wall zhi {u} 0 0", wall="tol 1e-5", **PLATES)
        expected = 4 * np.pi * VISCOSITY * radius**3 * rate
        self.assertAlmostEqual(result.thermo["f_w[5]"][0] / expected, 1, delta=0.03)
        for n in (1, 2, 3, 4, 6):
            self.assertLess(abs(result.thermo[f"f_w[{n}]"][0]), 0.01 * expected)

    def test_torque_beyond_the_last_image_flag(self):
        # across a side of the box; flags begin anew there once it has crossed 511 boxes
        box, u = (20, 16, 16), 1e-3
        torques = []
        for flags in ("-1*(x>10)", "511*(x>10)-512*(x<=10)"):
            result = walls(box, sphere((10, 8.1, 8.2), 3.5),
                           drive=f"wall zlo {-u} 0 0 wall zhi {u} 0 0", **PLATES,
                           before=f"displace_atoms w move -9 0 0\nvariable f atom {flags}\n"
                                  "set group w image v_f NULL NULL")
            torques.append([result.thermo[f"f_w[{n}]"][0] for n in (4, 5, 6)])
        self.assertGreater(torques[0][1], VISCOSITY * 3.5**3 * u / 8)
        np.testing.assert_allclose(torques[1], torques[0], rtol=1e-9, atol=1e-9 * torques[0][1])

    def test_drag_with_a_mean_velocity(self):
        # Zick & Homsy: 6 pi eta a K U, K = 4.292 at 12.5 %; with the offset of a plane, 2 % per (4
        # dx / a)^2 or so
        n, share = 32, 0.31017525
        radius, mean = share * n, 1e-3
        result = walls((n, n, n), sphere((16.1, 16.2, 16.3), radius - OFFSET),
                       drive=f"mean {mean} 0 0", wall="tol 1e-4")
        expected = 6 * np.pi * VISCOSITY * radius * 4.292 * mean
        self.assertAlmostEqual(result.thermo["f_w[1]"][0] / expected, 1, delta=0.045)
        self.assertAlmostEqual(result.thermo["f_flow[7]"][0] / mean, 1, delta=1e-12)

    def test_moves_through_the_box(self):
        # as often as it crosses a cell its drag is the same; its atoms change tasks and sides of
        # the box
        box, u = (20, 16, 16), 4e-3
        surface = sphere((10, 8.1, 8.2), 3.5)
        results = [walls(box, surface, drive="mean 0 0 0", wall=f"velocity {u} 0 0 tol 1e-6",
                         run="run 100", every="thermo 25", ranks=ranks, neighbor="neighbor 0.5 bin",
                         dump=dump_line(50, columns="id xu yu zu")) for ranks in (1, 2)]
        for result in results:
            moved = result.dump()("xu", frame=-1) - result.dump()("xu", frame=0)
            np.testing.assert_allclose(moved, 40, rtol=1e-12)
            force = result.thermo["f_w[1]"]
            np.testing.assert_allclose(force, force[0], rtol=1e-4)
        np.testing.assert_allclose(results[1].thermo["f_w[1]"], results[0].thermo["f_w[1]"],
                                   rtol=1e-5)


class Tube(unittest.TestCase):
    BOX, RADIUS = (20, 24, 24), 8.0
    CELLS = dict(groups=f"group w type 2\nmolecule rbc {POTENTIALS}/rbc_162.mol\n"
                 "rbc/create rbc single 6 12 12 rotate 30 0 1 0\nrbc/create rbc single 14 12 12.5 rotate 80 0 1 0\n"
                 "group cells type 1",
                 before="fix mem cells rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 volume yes",
                 ib="fix ib cells rbc/ib flow integrator midpoint", drive="body 1e-5 0 0", timestep="timestep 400",
                 dump=dump_line(10, columns="id mol xu yu zu vx vy vz"))

    def cells(self, **changes):
        return walls(self.BOX, tube(self.BOX, self.RADIUS), **{**self.CELLS, **changes})

    def test_the_wall_bears_what_drives_the_flow(self):
        result = walls(self.BOX, tube(self.BOX, self.RADIUS), drive="body 1e-5 2e-6 0", run="run 3")
        volume = np.prod(self.BOX)
        self.assertAlmostEqual(result.thermo["f_w[1]"][-1] / (1e-5 * volume), 1, delta=1e-9)
        self.assertAlmostEqual(result.thermo["f_w[2]"][-1] / (2e-6 * volume), 1, delta=1e-9)
        self.assertLess(result.thermo["f_w[7]"][-1], 1e-3)
        self.assertGreater(result.thermo["f_flow[7]"][-1], 0)
        # nothing changes
        self.assertEqual(result.thermo["f_flow[12]"][-1], result.thermo["f_flow[12]"][0])

    def test_changing_drive_costs_few_solves(self):
        result = walls(self.BOX, tube(self.BOX, self.RADIUS), drive="body v_g 0 0",
                       before="variable g equal 1e-5*(1+step)", run="run 10")
        np.testing.assert_array_less(np.diff(result.thermo["f_flow[12]"]), 3)
        np.testing.assert_allclose(result.thermo["f_flow[7]"] / result.thermo["f_flow[7]"][0],
                                   np.arange(1, 12), rtol=2e-3)

    def test_solves_with_cells(self):
        for integrator in ("euler", "midpoint", "ab2", "rkc 5", "rkc auto"):
            with self.subTest(integrator):
                timestep = "timestep 200" if integrator == "ab2" else self.CELLS["timestep"]    # it is stable for half
                result = self.cells(ib=self.CELLS["ib"] + " integrator " + integrator, timestep=timestep, run="run 20")
                last = result.thermo
                self.assertLess(last["f_w[9]"][-1], 4)
                self.assertLess(last["f_w[7]"].max(), 1e-3)
                table = re.search(r"step cost.*?Total", result.printed, re.DOTALL).group(0)
                self.assertIn("\nWalls ", table)

    def test_solves_with_four_times_the_atoms(self):
        surfaces = tube(self.BOX, self.RADIUS), tube(self.BOX, self.RADIUS, 0.6)
        once, four = (walls(self.BOX, surface, **self.CELLS, run="run 20").thermo["f_w[9]"][-1] for surface in surfaces)
        self.assertLess(four, 1.3 * once)

    def test_same_on_all_tasks(self):
        results = [self.cells(wall="tol 1e-9 maxiter 200", run="run 10", ranks=ranks) for ranks in (1, 2, 4)]
        one = results[0].dump()("vx", "vy", "vz")
        for result in results[1:]:
            for column in ("f_w[1]", "f_flow[7]", "f_flow[10]"):
                np.testing.assert_allclose(result.thermo[column], results[0].thermo[column], rtol=1e-6)
            np.testing.assert_allclose(result.dump()("vx", "vy", "vz"), one, atol=1e-6 * abs(one).max())

    def test_balancing_keeps_the_forces(self):
        plain = self.cells(wall="tol 1e-8 maxiter 200", run="run 12", ranks=2)
        moved = self.cells(wall="tol 1e-8 maxiter 200", run="run 12", ranks=2,
                           ib=self.CELLS["ib"] + "\nfix bal all balance 4 1.0 shift x 10 1.0")
        np.testing.assert_allclose(moved.thermo["f_flow[7]"], plain.thermo["f_flow[7]"], rtol=1e-6)
        self.assertLess(moved.thermo["f_w[9]"][-1], plain.thermo["f_w[9]"][-1] + 20)

    def test_viscous_membranes(self):
        mem = self.CELLS["before"] + " viscosity 0.3"
        tight, result = (self.cells(before=mem, wall=f"tol {tol} maxiter 200", run="run 5",
                                    ib=self.CELLS["ib"] + " tol 1e-5") for tol in (1e-8, 1e-4))
        for case in (tight, result):
            self.assertNotIn("maxiter", case.printed)
        u = tight.dump()("vx", "vy", "vz", frame=0)
        np.testing.assert_allclose(result.dump()("vx", "vy", "vz", frame=0), u, atol=1e-3 * abs(u).max())


class Vessel(unittest.TestCase):
    """A tube of 22.5 um made by rbc/surface, driven inside."""
    RADIUS, OFFSETS = 11.25, {"peskin4": OFFSET, "roma3": 0.2662}

    def run_vessel(self, drive, kernel="peskin4", plates=False, cells=40, steps=2, sheets=False):
        width, h = 26, 32 / cells
        offset = "" if sheets else f"offset {self.OFFSETS[kernel] * h}"
        made = (f"region box block 0 32 0 {width} 0 {width}\ncreate_box 2 box angle/types 1\n"
                f"region tube cylinder x 13 13 {self.RADIUS} INF INF\n"
                f"rbc/surface tube type 2 spacing {1.2 * h} {offset} mass 1.0")
        across = round(width / h / 2) * 2
        return run(script(f"inside tube {drive}" + (" " + AT_REST if plates else ""), f"kernel {kernel} sheets {'yes' if sheets else 'no'}",
                          data=made,
                          fluid=BASE["fluid"].replace("dx 1.0", f"grid {cells} {across} {across}"), run=f"run {steps}",
                          thermo=BASE["thermo"] + "".join(f" f_flow[{n}]" for n in (13, 16, 19)),
                          **(PLATES if plates else {})))

    def vessel(self, *words, **more):
        result = self.run_vessel(*words, **more)
        last = {name: column[-1] for name, column in result.thermo.items()}
        last["law"] = last["f_flow[16]"] / (last["f_flow[19]"] * np.pi * self.RADIUS**4 / (8 * VISCOSITY))
        return last

    def test_flow_rate(self):
        for kernel in self.OFFSETS:
            for plates in (False, True):
                with self.subTest(kernel, plates=plates):
                    last = self.vessel("body 1e-5 0 0", kernel, plates)
                    # plates hold the fluid outside back
                    self.assertAlmostEqual(last["law"], 1, delta=0.012 if plates else 0.006)
                    if not plates:
                        self.assertAlmostEqual(last["f_w[1]"] / (1e-5 * np.pi * self.RADIUS**2 * 32), 1, delta=1e-3)

    def test_flow_rate_between_sheets(self):
        # plates next to the vessel do no harm; kernels carry 0.5 and 0.3 % of the flow beyond the surface
        for kernel in self.OFFSETS:
            for plates in (False, True):
                with self.subTest(kernel, plates=plates):
                    last = self.vessel("body 1e-5 0 0", kernel, plates, steps=0, sheets=True)
                    self.assertAlmostEqual(last["law"], 0.996, delta=0.003)

    def test_without_a_drive(self):
        message = "Fix rbc/fluid flow inside tube: nothing drives the flow there; use mean or body"
        self.assertIn(message, self.run_vessel("", cells=16, steps=0).printed)
        self.assertNotIn(message, self.run_vessel("body 1e-5 0 0", cells=16, steps=0).printed)

    def test_given_rate(self):
        last = self.vessel("mean x 1.875e-4")
        self.assertAlmostEqual(last["f_flow[13]"] / 1.875e-4, 1, delta=1e-3)
        self.assertAlmostEqual(last["law"], 1, delta=0.006)
        self.assertLess(last["f_w[9]"], 3)


class Sheets(unittest.TestCase):
    """Atoms on the surface of the body that they stand for."""

    def test_drag_of_spheres_that_rbc_surface_makes(self):
        # Zick & Homsy: K = 4.292 at 12.5 %, 7.442 at 21.6 %
        for kernel in ("roma3", "peskin4"):
            for share, factor in ((0.31017525, 4.292), (0.37221029, 7.442)):
                n = round(7.4 / share)
                made = (f"region box block 0 {n} 0 {n} 0 {n}\ncreate_box 2 box angle/types 1\n"
                        f"region ball sphere {n / 2 + 0.1} {n / 2 + 0.2} {n / 2 + 0.3} {share * n}\n"
                        "rbc/surface ball type 2 spacing 1.2")
                result = run(script("mean 1e-3 0 0", f"sheets yes kernel {kernel}", data=made))
                expected = 6 * np.pi * VISCOSITY * share * n * factor * 1e-3
                with self.subTest(kernel, share=share):
                    self.assertAlmostEqual(result.thermo["f_w[1]"][0] / expected, 1, delta=0.005)

    def test_torque_in_shear_flow(self):
        # 4 pi eta a^3 times the shear rate in unbounded flow; what the plates add is below 1 %
        box, radius, rate = (54, 54, 54), 8.0, 1e-4
        u = rate * box[2] / 2
        result = walls(box, sphere((27.1, 27.2, 27.0), radius), drive=f"wall zlo {-u} 0 0 wall zhi {u} 0 0",
                       wall="tol 1e-4 sheets yes", **PLATES)
        expected = 4 * np.pi * VISCOSITY * radius**3 * rate
        self.assertAlmostEqual(result.thermo["f_w[5]"][0] / expected, 1, delta=0.01)

    def test_given_another_kind_between_runs(self):
        box, surface = (24, 24, 24), sphere((12.1, 12.2, 12.3), 7.4)
        again = "\nrun 0\nunfix w\nfix w w rbc/wall flow kernel peskin4 sheets {}"
        lines = dict(drive="mean 1e-3 0 0", wall="tol 1e-6 maxiter 300 ")
        force = {}
        for kind in ("yes", "no"):
            first = walls(box, surface, **dict(lines, wall=lines["wall"] + f"sheets {kind}"))
            force[kind] = first.thermo["f_w[1]"][0]
        for before, kind in (("no", "yes"), ("yes", "no")):
            later = walls(box, surface, drive=lines["drive"], wall=lines["wall"] + f"sheets {before}",
                          run=f"run 0{again.format(kind)} {lines['wall']}\nrun 0")
            found = later.tables()[-1]["f_w[1]"][0]
            self.assertAlmostEqual(found / force[kind], 1, delta=1e-5)
        self.assertGreater(force["no"] / force["yes"], 1.1)

    def test_cells_in_a_tube_on_any_tasks(self):
        results = [walls(Tube.BOX, tube(Tube.BOX, Tube.RADIUS), **Tube.CELLS, run="run 5", ranks=ranks,
                         wall="sheets yes tol 1e-9 maxiter 300") for ranks in (1, 2, 4)]
        one = results[0].dump()("vx", "vy", "vz")
        for result in results[1:]:
            np.testing.assert_allclose(result.thermo["f_flow[7]"], results[0].thermo["f_flow[7]"], rtol=1e-6)
            np.testing.assert_allclose(result.dump()("vx", "vy", "vz"), one, atol=1e-6 * abs(one).max())

    def test_solves_with_cells(self):
        result = walls(Tube.BOX, tube(Tube.BOX, Tube.RADIUS), **Tube.CELLS, run="run 20", wall="sheets yes")
        self.assertLess(result.thermo["f_w[9]"][-1], 4)
        self.assertLess(result.thermo["f_w[7]"].max(), 1e-3)


class Spacing(unittest.TestCase):
    """Of the atoms, on lattices that go on through the periodic sides."""
    BOX = (24, 24, 24)

    def warnings(self, across, along, ranks=1, grid="dx 1.0", steps="run 0", wall="", most="2.25"):
        atoms = [(x, y, 12.0) for x in np.arange(0.3, 24, across) for y in np.arange(0.2, 24, along)]
        printed = walls(self.BOX, atoms, ranks=ranks, run=steps, wall=wall,
                        fluid=BASE["fluid"].replace("dx 1.0", grid)).printed
        return re.findall(rf"WARNING: Fix rbc/wall w: (\d+) of (\d+) atoms are more than {most} spacings of "
                          r"the fluid's grid from those beside them \((\S+) in the mean of all\)", printed)

    def test_a_coarse_wall_is_a_warning_on_any_tasks(self):
        for ranks in (1, 2, 4):
            self.assertEqual(self.warnings(3, 3, ranks), [("64", "64", "3")])

    def test_lines_of_close_atoms_are_no_surface(self):
        self.assertEqual(self.warnings(4, 0.5), [("288", "288", "4")])

    def test_counts_in_cells_of_the_grid(self):
        self.assertEqual(self.warnings(3, 6, grid="grid 24 12 24"), [("32", "32", "3")])
        self.assertEqual(self.warnings(1.5, 3, grid="grid 24 12 24"), [])

    def test_a_wall_as_advised_is_none(self):
        for spacing in (1, 1.5, 2):
            self.assertEqual(self.warnings(spacing, spacing), [])

    def test_sheets_must_be_closer(self):
        for spacing, atoms in ((1.5, None), (2, "144")):
            self.assertEqual(self.warnings(spacing, spacing, wall="sheets yes", most="1.75"),
                             [(atoms, atoms, "2")] if atoms else [])

    def test_comes_once(self):
        self.assertEqual(len(self.warnings(3, 3, steps="run 1\nrun 1")), 1)


class Errors(unittest.TestCase):
    BOX = (8, 8, 8)

    def check(self, message, **changes):
        surfaces = changes.pop("surfaces", [plane(self.BOX, 4.0)])
        result = walls(self.BOX, *surfaces, tries=True, **changes)
        self.assertTrue(result.code, message)
        self.assertIn(message, result.error)

    def test_arguments(self):
        self.check("Unknown fix rbc/wall keyword slip; allowed: velocity, kernel, sheets, tol, maxiter", wall="slip 1")
        self.check("Unknown fix rbc/wall kernel hat; allowed: peskin4, roma3", wall="kernel hat")
        self.check("Expected boolean parameter instead of 'maybe'", wall="sheets maybe")
        self.check("Fix rbc/wall tol value 2 must be between 0 and 1", wall="tol 2")
        self.check("Fix rbc/wall maxiter value 0 must be > 0", wall="maxiter 0")
        self.check("Illegal fix rbc/wall velocity command: missing argument", wall="velocity 1 0")
        self.check("Variable nothing for fix rbc/wall does not exist", wall="velocity v_nothing 0 0")
        self.check("Fix rbc/wall w: there is no fix rbc/fluid with ID water", wall="\nunfix w\nfix w w rbc/wall water")

    def test_groups(self):
        self.check("Fix rbc/wall w: its group has no atoms", groups="group w type 1")
        self.check("Fix rbc/wall v and Fix rbc/wall w have atoms in common", wall="\nfix v all rbc/wall flow kernel peskin4")
        self.check("Fix rbc/wall v: kernel, sheets, tol and maxiter must be those of Fix "
                   "rbc/wall w", surfaces=[plane(self.BOX, 2.0), plane(self.BOX, 6.0)],
                   groups="group w type 2\ngroup v type 3", wall="\nfix v v rbc/wall flow tol 1e-4")
        self.check("Fix rbc/wall v: kernel, sheets, tol and maxiter must be those of Fix rbc/wall w",
                   surfaces=[plane(self.BOX, 2.0), plane(self.BOX, 6.0)], groups="group w type 2\ngroup v type 3",
                   wall="\nfix v v rbc/wall flow kernel peskin4 sheets yes")
        self.check("Fix rbc/ib ib would move atoms of fix rbc/wall w: their groups must have no "
                   "atoms in common", ib="fix ib all rbc/ib flow")

    def test_inertia(self):
        self.check("Fix rbc/wall w needs fix rbc/fluid flow inertia none", drive="inertia unsteady")

    def test_mean_force_without_walls(self):
        self.check("Fix rbc/fluid mean force needs inertia unsteady or convective, or a fix rbc/wall", drive="mean force",
                   wall="\nunfix w", thermo="thermo_style custom step")


if __name__ == "__main__":
    unittest.main()
