"""fix rbc/membrane interior: cells whose inside has a viscosity of its own."""

import unittest

import numpy as np

from lammps_case import POTENTIALS, attempt, in_parallel, push, read_template, run, scene

VISCOSITY, BOX = 1.5, 6
NODES, TRIANGLES = read_template(POTENTIALS / "capsule_642.mol")[:2]
COUNT = len(NODES)


def area_vectors():
    """A third of the areas around each vertex of the sphere, times their normals."""
    a, b, c = (NODES[TRIANGLES[:, n]] for n in range(3))
    third = np.cross(b - a, c - a) / 6
    vectors = np.zeros_like(NODES)
    for n in range(3):
        np.add.at(vectors, TRIANGLES[:, n], third)
    return vectors


AREA = np.linalg.norm(area_vectors(), axis=1)
NORMAL = NODES / np.linalg.norm(NODES, axis=1)[:, None]


def velocities(forces, interior="", ib="tol 1e-6", dx=1 / 6, ranks=1, steps=0, more=""):
    """Of all vertices of a sphere of radius 1 that these forces act on."""
    before, files = push(forces)
    dump = ("dump atoms all custom 1 atoms.dump id x y z vx vy vz\n"
            "dump_modify atoms sort id format float %.17g")
    result = run(scene(
        boundary="boundary p p p", box=f"region box block 0 {BOX} 0 {BOX} 0 {BOX}",
        molecule=f"molecule rbc {POTENTIALS}/capsule_642.mol",
        cells="rbc/create rbc single 3.02 2.95 3.01 rotate 30 1 0.3 0",
        neighbor="neighbor 0.3 bin",
        membrane=f"fix mem all rbc/membrane rbc neo-hookean 1e-30 volume yes {interior}",
        before=before, fluid=f"fix flow all rbc/fluid dx {dx} viscosity {VISCOSITY}",
        thermo="thermo_style custom step f_ib[11] f_ib[12] f_flow[1]",
        ib=f"fix ib all rbc/ib flow integrator midpoint {ib}",
        timestep="timestep 1e-3", dump=dump + "\n" + more, run=f"run {steps}"), ranks, files=files)
    return result.dump()("vx", "vy", "vz"), result


def rotated(vectors):
    """As rbc/create turns the template in velocities()."""
    axis, angle = np.array([1, 0.3, 0]) / np.hypot(1, 0.3), np.radians(30)
    return (vectors * np.cos(angle) + np.cross(axis, vectors) * np.sin(angle)
            + np.outer(vectors @ axis, axis) * (1 - np.cos(angle)))


def twist(n):
    return np.stack([-n[:, 0] * n[:, 2], n[:, 1] * n[:, 2], n[:, 0]**2 - n[:, 1]**2], axis=1)


def strain(n):
    return n @ np.array([[0, 0.7, 0], [0.7, 0, 0.5], [0, 0.5, 0]])


# Velocity over the traction that causes it, of a sphere of radius 1 in a fluid of viscosity 1
# (Lamb, Hydrodynamics, 1932).
EXACT = {twist: lambda contrast: 1 / (contrast + 4),
         strain: lambda contrast: 1 / (2 * contrast + 3)}


def response(mode, contrast):
    traction = mode(rotated(NORMAL))
    moves, _ = velocities(traction * AREA[:, None], f"interior {contrast * VISCOSITY}")
    return VISCOSITY * np.sum(moves * traction) / np.sum(traction**2)


class Sphere(unittest.TestCase):
    def test_moves_as_its_tractions_ask(self):
        # images of the periodic box change the second by a few parts of the volume fraction, 0.02
        cases = [(mode, contrast) for mode in EXACT for contrast in (0.2, 5, 20)]
        for (mode, contrast), seen in zip(cases, in_parallel(response, cases)):
            off = seen / EXACT[mode](contrast) - 1
            print(f"\n{mode.__name__}, inside {contrast} times as viscous: {off:+.2%}")
            self.assertLess(abs(off), 0.015 if mode is twist else 0.02)

    def test_falls_as_if_it_were_rigid(self):
        forces = np.outer(AREA, [0.3, -0.2, 0.5])
        alike, _ = velocities(forces, ib="")
        for contrast in (0.1, 30):
            moves, _ = velocities(forces, f"interior {contrast * VISCOSITY}")
            mean = [AREA @ field / AREA.sum() for field in (moves, alike)]
            print(f"\ninside {contrast} times as viscous: falls "
                  f"{np.linalg.norm(mean[0]) / np.linalg.norm(mean[1]) - 1:+.3%}")
            np.testing.assert_allclose(*mean, rtol=5e-3)


class Inside(unittest.TestCase):
    def test_flow_is_that_of_the_fluid(self):
        # tractions that strain and turn a sphere strain and turn its inside evenly
        contrast, axis = 5, [0.8, -0.4, 0.6]
        traction = strain(rotated(NORMAL)) + np.cross(axis, rotated(NORMAL))
        columns = " ".join(f"f_flow:grid:{name}"
                           for name in ("interior", "velocity[1]", "velocity[2]", "velocity[3]"))
        _, result = velocities(traction * AREA[:, None], f"interior {contrast * VISCOSITY}",
                               more=f"fix grid all ave/grid 1 1 1 36 36 36 {columns}\n"
                               "dump grid all grid 1 flow.grid f_grid:grid:data[*]")
        rows = [line.split() for line in (result.folder / "flow.grid").read_text().splitlines()]
        grid = np.array([row for row in rows if len(row) == 4 and row[0] != "ITEM:"],
                        dtype=float).reshape(36, 36, 36, 4)
        centres = (np.arange(36) + 0.5) / 6
        z, y, x = np.meshgrid(centres, centres, centres, indexing="ij")
        place = np.stack([x - 3.02, y - 2.95, z - 3.01], axis=-1)
        radius = np.linalg.norm(place, axis=-1)
        share, u = grid[..., 0], grid[..., 1:]
        volume = np.sum(area_vectors() * NODES) / 3
        # what overshoots is cut off
        self.assertAlmostEqual(share.sum() / 216 / volume, 1, delta=4e-3)
        self.assertGreater(share[radius < 0.6].min(), 0.99)
        self.assertLess(share[radius > 1.4].max(), 0.01)
        within = radius < 0.6
        expected = (strain(place[within]) / (VISCOSITY * (2 * contrast + 3)) +
                    np.cross(axis, place[within]) / (3 * VISCOSITY))
        self.assertLess(abs(u[within] - expected).max(), 0.05 * abs(expected).max())


class Ranks(unittest.TestCase):
    def test_one_and_two_agree(self):
        forces = np.random.default_rng(3).normal(size=(COUNT, 3))
        one, _ = velocities(forces, "interior 7.5", "tol 1e-11", dx=0.25)
        two, _ = velocities(forces, "interior 7.5", "tol 1e-11", dx=0.25, ranks=2)
        self.assertLess(abs(one - two).max(), 1e-8 * abs(one).max())

    def test_no_force_takes_energy_from_the_fluid(self):
        for seed in range(3):
            forces = np.random.default_rng(seed).normal(size=(COUNT, 3))
            moves, _ = velocities(forces, "interior 7.5", dx=0.25)
            self.assertGreater(np.sum(forces * moves), 0)


def radius(contrast):
    """Of the spectrum of an elastic sphere, as integrator rkc finds it."""
    result = run(scene(
        boundary="boundary p p p", box=f"region box block 0 {BOX} 0 {BOX} 0 {BOX}",
        molecule=f"molecule rbc {POTENTIALS}/capsule_642.mol",
        cells="rbc/create rbc single 3.02 2.95 3.01",
        neighbor="neighbor 0.3 bin", fluid=f"fix flow all rbc/fluid dx 0.25 viscosity {VISCOSITY}",
        timestep="timestep 0.5",
        membrane="fix mem all rbc/membrane rbc neo-hookean 1.0 volume yes interior "
                 f"{contrast * VISCOSITY}",
        ib="fix ib all rbc/ib flow tol 1e-3 integrator rkc auto",
        thermo="thermo_style custom step f_ib[6]", run="run 1"))
    return result.thermo["f_ib[6]"][-1]


class Spectrum(unittest.TestCase):
    def test_fastest_modes_relax_as_between_two_fluids(self):
        # short waves are those of a plane between both, slower than the longest by no more than
        # Lamb's strain
        contrasts = 1, 0.2, 5, 20
        alike, *others = in_parallel(radius, [(contrast,) for contrast in contrasts])
        for contrast, found in zip(contrasts[1:], others):
            short, long = 2 / (1 + contrast), 5 / (3 + 2 * contrast)
            print(f"\ninside {contrast} times as viscous: {found / alike:.3f} of the rate, a plane "
                  f"{short:.3f}, strain {long:.3f}")
            self.assertGreater(found / alike, min(short, long))
            self.assertLess(found / alike, max(short, long))


class Steps(unittest.TestCase):
    def test_flow_is_known_after_atoms_were_sorted(self):
        # the velocities that end a step were found before LAMMPS gave the atoms other numbers
        cell = ("fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                "interior 7.5")
        for ranks in (1, 2):
            result = run(scene(
                style="atom_style molecular\natom_modify sort 1 1.0", membrane=cell,
                neighbor="neighbor 1.0 bin\nneigh_modify every 1 delay 0 check no",
                ib="fix ib all rbc/ib flow tol 1e-6 integrator rkc auto adapt 1e-3 200",
                thermo="thermo_style custom step f_flow[1] f_flow[4] f_flow[7] f_flow[10]",
                every="thermo 5",
                thermo_modify="thermo_modify format float %.17g", run="run 5\nrun 0"), ranks)
            within, anew = result.tables()
            for column in ("f_flow[1]", "f_flow[4]", "f_flow[7]", "f_flow[10]"):
                np.testing.assert_allclose(within[column][-1], anew[column][-1], rtol=1e-4,
                                           err_msg=f"{column}, {ranks} ranks")

    def test_velocities_found_are_those_of_the_flow(self):
        # so the next run finds nothing to do; forces are rough, which smooth yes counts
        before, files = push(1e-3 * np.random.default_rng(5).normal(size=(162, 3)))
        cell = ("fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                "volume yes interior 7.5")
        for more in ("", " smooth yes", " viscosity 300"):
            result = run(
                scene(membrane=cell + more,
                      ib="fix ib all rbc/ib flow tol 1e-6 integrator midpoint",
                      cells="rbc/create rbc single 6 6 3 rotate 20 0 1 0", before=before,
                      thermo="thermo_style custom step f_ib[11]", run="run 2\nrun 0"), files=files)
            first, second = result.tables()
            self.assertGreater(first["f_ib[11]"][-1], 1)
            self.assertEqual(second["f_ib[11]"][-1], 0, more)

    def test_output_changes_nothing(self):
        # the flow of the velocities found is computed when it is asked for
        cell = ("fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                "volume yes interior 7.5")
        dump = ("dump atoms all custom 6 atoms.dump id x y z vx vy vz\n"
                "dump_modify atoms sort id format float %.17g")

        def moved(every, ib, before=""):
            result = run(scene(membrane=cell, ib=f"fix ib all rbc/ib flow {ib}", dump=dump,
                               run="run 6", every=f"thermo {every}", before=before,
                               thermo="thermo_style custom step f_flow[1] f_flow[9] f_flow"))
            return result.dump().frames[-1], [column[-1] for column in result.thermo.values()]

        for ib in ("integrator midpoint", "integrator rkc auto",
                   "integrator rkc auto adapt 1e-3 200", "integrator ab2"):
            (often, shown), (seldom, late) = moved(1, ib), moved(6, ib)
            np.testing.assert_array_equal(often, seldom, err_msg=ib)
            self.assertEqual(shown, late, ib)
        # forces that depend on the flow ask for it at other times
        push = "variable fx equal f_flow[1]\nfix push all addforce v_fx 0 0"
        (often, _), (seldom, _) = (moved(1, "integrator midpoint", push),
                                   moved(6, "integrator midpoint", push))
        np.testing.assert_array_equal(often, seldom)

    def test_last_velocities_of_a_sudden_step_are_those_of_the_flow(self):
        # the spectrum is estimated anew at the end of such a step, with velocities of no meaning
        cell = ("fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                "volume yes interior 7.5")
        dump = ("dump {0} all custom 1 {0}.dump id vx vy vz\n"
                "dump_modify {0} sort id format float %.17g")
        for more in ("", " viscosity 300"):
            result = run(scene(
                membrane=cell + more, ib="fix ib all rbc/ib flow tol 1e-4 integrator rkc auto",
                before="group one id 5\nvariable fz equal 0.1*(step>=3)\n"
                       "fix push one addforce 0 0 v_fz", timestep="timestep 50",
                dump=dump.format("within"), run=f"run 3\n{dump.format('anew')}\nrun 0"))
            within, anew = (result.dump(f"{name}.dump")("vx", "vy", "vz", frame=frame)
                            for name, frame in (("within", 3), ("anew", 0)))
            off = (np.sqrt(((within - anew)**2).sum(axis=1).mean()) /
                   np.linalg.norm(anew, axis=1).max())
            self.assertLess(off, 3e-4, more)

    def test_a_rank_without_atoms_takes_part(self):
        for more in ("", " viscosity 300", " smooth yes interior 7.5 viscosity 300",
                     " interior 7.5"):
            run(scene(
                processors="processors 2 1 1", box="region box block 0 24 0 12 0 12",
                neighbor="neighbor 0.5 bin", thermo=None,
                membrane="fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending "
                         f"2.0e-4{more}",
                before="pair_style rbc/jkr 0.5\npair_coeff * * repulsive 0.5 0.4",
                ib="fix ib all rbc/ib flow integrator midpoint gaps yes", timestep="timestep 10",
                run="run 2"), 2)

    def test_a_flow_without_cells_has_no_inside(self):
        membrane = ("fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                    "interior 7.5")
        result = run(
            scene(membrane=membrane, thermo="thermo_style custom step f_flow[10] f_flow[11]",
                  run="run 2\nunfix ib\nunfix mem\ndelete_atoms group all bond yes\nrun 2"))
        speed, divergence = (result.tables()[1][f"f_flow[{n}]"][-1] for n in (10, 11))
        self.assertAlmostEqual(speed, 0.0012 * (1 - 0.5 / 12), delta=1e-12)
        self.assertLess(divergence, 1e-12)

    def test_flow_is_known_after_balance(self):
        # with this tolerance the flow of the last evaluation is that of the velocities, and moves
        # as it is
        cell = ("fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                "interior 7.5")
        columns = "f_flow:grid:velocity[*] f_flow:grid:interior"
        result = run(scene(
            membrane=cell, ib="fix ib all rbc/ib flow tol 0.1 integrator rkc auto adapt 1e-3 200",
            before="fix even all balance 2 1.0 shift xy 10 1.05", every="thermo 1",
            thermo="thermo_style custom step f_flow[1] f_flow[10] f_flow",
            thermo_modify="thermo_modify format float %.17g",
            dump=f"dump grid all grid 2 flow.*.grid {columns}", run="run 4\nrun 0"), 3)
        within, anew = result.tables()
        for column in ("f_flow[1]", "f_flow[10]", "f_flow"):
            np.testing.assert_allclose(within[column][-1], anew[column][-1], rtol=5e-3,
                                       err_msg=column)

    def test_a_viscous_inside_leaves_nothing_behind(self):
        membrane = "fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4"
        again = f"unfix ib\nunfix mem\n{membrane}\n"
        ib = "fix ib all rbc/ib flow integrator midpoint"
        result = run(scene(membrane=membrane + " interior 7.5", run=f"run 2\n{again}{ib}\nrun 3"))
        self.assertIn("6 solves in 3 steps", result.printed)


class Alike(unittest.TestCase):
    def test_nothing_changes_where_the_viscosity_is_that_outside(self):
        forces = np.random.default_rng(1).normal(size=(COUNT, 3))
        without, _ = velocities(forces, "", "", dx=0.25, steps=3)
        alike, result = velocities(forces, f"interior {VISCOSITY}", "", dx=0.25, steps=3)
        np.testing.assert_array_equal(without, alike)
        self.assertNotIn("Contrast", result.printed)


class Errors(unittest.TestCase):
    def check(self, message, **changes):
        result = attempt(scene(run="run 0", **changes))
        self.assertIn(message, result.error)

    def test_bad_settings(self):
        membrane = "fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 interior "
        self.check("interior value 0 must be > 0", membrane=membrane + "0")
        self.check("interior needs a fix rbc/ib", membrane=membrane + "7.5", ib="")
        self.check("needs fix rbc/ib ib with sheets yes", membrane=membrane + "7.5",
                   ib="fix ib all rbc/ib flow integrator midpoint sheets no")
        self.check("which has another viscosity inside", membrane=membrane + "7.5",
                   before="group held id 1",
                   ib="fix wall held rbc/wall flow\ngroup free subtract all held\n"
                   "fix ib free rbc/ib flow integrator midpoint")
        self.check("needs its inertia none", membrane=membrane + "7.5",
                   fluid="fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 inertia "
                         "unsteady wall zlo 0 0 0 wall zhi 0 0 0")


if __name__ == "__main__":
    unittest.main()
