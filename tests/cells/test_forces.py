"""Forces of fix rbc/membrane through LAMMPS against its energy, and what fix_modify makes of
both."""

import unittest

import numpy as np

from lammps_case import attempt, dump_line, run, scene

# Every term at once, with energies of a like size.
LAWS = {
    "mooney-rivlin": "mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-3 area 0.01 0.01 volume 0.02",
    "skalak": "skalak 0.005 1 bending 2.0e-3 0.5 area 0.02 0 volume no",
    "neo-hookean": "neo-hookean 0.005",
    "dihedral": "neo-hookean 0.005 bending 2.0e-3 dihedral -0.3 area 0 0.02",
}

# No fluid: atoms stay where they are put. The cell straddles an edge of the box and is out of
# shape.
STRAIN = {"x": 1.10, "y": 0.93, "z": 1.05}
DEFORM = "\n".join(
    [f"variable {d} atom {STRAIN[d]}*{d}" for d in STRAIN] +
    ["change_box all boundary p p p", "set group all x v_x y v_y z v_z",
     "displace_atoms all random 0.02 0.02 0.02 77", "displace_atoms all move 6.0 6.3 5.5"])


def membrane_scene(law, **changes):
    lines = dict(boundary="boundary p p p", cells="rbc/create rbc single 6 6 6 rotate 30 1 2 0",
                 membrane=f"fix mem all rbc/membrane rbc {law}\n"
                          "fix_modify mem energy yes virial yes",
                 fluid=None, ib=None, every="thermo 1", dump=dump_line(1),
                 thermo="thermo_style custom step pe f_mem f_mem[1] f_mem[2] f_mem[3] f_mem[4] "
                        "press pxx pyy pzz pxy pxz pyz",
                 last=DEFORM)
    lines.update(changes)
    return scene(**lines)


class Forces(unittest.TestCase):
    def test_limits_by_fix_modify_are_those_of_the_fix(self):
        law, limits = LAWS["mooney-rivlin"], "crease 0.05 20 stretch 0.02 1.05"
        given, changed, without = (
            run(membrane_scene(*arguments)).dump().forces() for arguments in
            ((f"{law} {limits}",), (f"{law} crease 0.3 90\nfix_modify mem {limits}",), (law,)))
        np.testing.assert_array_equal(changed, given)
        self.assertGreater(abs(given - without).max(), 1e-3 * abs(without).max())

    def test_limits_by_fix_modify_are_checked(self):
        for limits, message in (("crease 0.05 180",
                                 "crease angle value 180 must be below 180 degrees"),
                                ("stretch 0.05 1", "stretch lambda value 1 must be above 1"),
                                ("crease 0.05 45", "crease needs a bending modulus > 0")):
            with self.subTest(limits):
                result = attempt(membrane_scene(f"neo-hookean 0.005\nfix_modify mem {limits}"))
                self.assertIn(f"Fix rbc/membrane {message}", result.error)

    def test_minus_the_gradient_of_the_energy(self):
        step = 2e-4
        atoms = [1, 12, 80, 81, 162]
        moves = ["group one id 1"]
        for atom in atoms:
            moves.append(f"group one clear\ngroup one id {atom}")
            for d in range(3):
                there = ["0", "0", "0"]
                for distance in (step, -2 * step):
                    there[d] = repr(distance)
                    moves.append(f"displace_atoms one move {' '.join(there)}\nrun 0 post no")
                there[d] = repr(step)
                moves.append(f"displace_atoms one move {' '.join(there)}")
        for name, law in LAWS.items():
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    result = run(
                        membrane_scene(law, run="run 0\nundump atoms\n" + "\n".join(moves)), ranks)
                    energy = result.thermo["f_mem"][1:]
                    numerical = -(energy[0::2] - energy[1::2]).reshape(-1, 3) / (2 * step)
                    forces = result.dump().forces()[np.array(atoms) - 1]
                    worst = abs(numerical - forces).max() / abs(forces).max()
                    print(
                        f"\n{name}, {ranks} ranks: forces differ from the gradient by {worst:.2g}")
                    self.assertLess(worst, 1e-6)

    def test_no_net_force_and_torque(self):
        for name, law in LAWS.items():
            for ranks in (1, 4):
                with self.subTest(name, ranks=ranks):
                    dump = run(membrane_scene(law), ranks).dump()
                    f, x = dump.forces(), dump.positions()
                    largest = abs(f).max()
                    self.assertLess(abs(f.sum(axis=0)).max(), 1e-12 * largest * len(f))
                    self.assertLess(abs(np.cross(x - x.mean(axis=0), f).sum(axis=0)).max(),
                                    1e-11 * largest * len(f))

    def test_the_stress_free_shape_turned_has_no_force(self):
        law = LAWS["mooney-rivlin"]
        scale = abs(run(membrane_scene(law)).dump().forces()).max()
        for rotate in ("", "rotate 90 1 0 0", "rotate 33 1 2 3"):
            for ranks in (1, 2):
                with self.subTest(rotate, ranks=ranks):
                    result = run(membrane_scene(
                        law, last=None, cells=f"rbc/create rbc single 6 6 6 {rotate}"), ranks)
                    self.assertLess(abs(result.dump().forces()).max(), 1e-11 * scale)
                    self.assertLess(abs(result.thermo["f_mem"][0]), 1e-12 * scale)

    def test_energy_parts_and_potential_energy(self):
        for name, law in LAWS.items():
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    thermo = run(membrane_scene(law), ranks).thermo
                    parts = [thermo[f"f_mem[{n}]"][0] for n in (1, 2, 3, 4)]
                    self.assertEqual([part > 0 for part in parts],
                                     [True, "bending" in law, "area" in law, "volume 0" in law])
                    np.testing.assert_allclose(sum(parts), thermo["f_mem"][0], rtol=1e-14)
                    self.assertEqual(thermo["f_mem"][0], thermo["PotEng"][0])

    def test_pressure_is_the_derivative_by_strain(self):
        # x' = x + e y for each pair of directions, about the middle of the box
        step = 1e-4
        centre = "variable cx equal 6.0\nvariable cy equal 6.3\nvariable cz equal 5.5\n"
        runs, pairs = [], [("x", "x"), ("y", "y"), ("z", "z"), ("x", "y"), ("x", "z"), ("y", "z")]
        middle = DEFORM.replace("move 6.0 6.3 5.5", "move 0.1 0.2 0.1").replace(
            "*x", "*(x-6)+6").replace("*y", "*(y-6)+6").replace("*z", "*(z-6)+6")
        for to, by in pairs:
            once, back = -2 * step, step
            if to == by:    # a strain takes the place of the one before
                once, back = (1 - step) / (1 + step) - 1, 1 / (1 - step) - 1
            set_to = f"set group all {to} v_m"
            for strain in (step, once):
                runs.append(f"variable m atom {to}+({strain!r})*({by}-v_c{by})\n{set_to}\n"
                            "run 0 post no")
            runs.append(f"variable m atom {to}+({back!r})*({by}-v_c{by})\n{set_to}")
        for name, law in LAWS.items():
            with self.subTest(name):
                thermo = run(membrane_scene(law, last=middle, dump=None,
                                            run=centre + "run 0\n" + "\n".join(runs))).thermo
                energy = thermo["f_mem"][1:]
                volume = 12.0**3
                numerical = -(energy[0::2] - energy[1::2]) / (2 * step) / volume
                pressure = np.array(
                    [thermo[column][0] for column in ("Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz")])
                np.testing.assert_allclose(pressure, numerical, atol=1e-6 * abs(numerical).max())
                np.testing.assert_allclose(thermo["Press"][0], pressure[:3].mean(), rtol=1e-12)

    def test_pressure_does_not_depend_on_place_and_ranks(self):
        law = LAWS["mooney-rivlin"]
        columns = ("Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz")
        def pressure(move, ranks):
            last = DEFORM.replace("move 6.0 6.3 5.5", f"move {move}")
            thermo = run(membrane_scene(law, last=last, dump=None), ranks).thermo
            return np.array([thermo[column][0] for column in columns])
        first = pressure("6.0 6.3 5.5", 1)
        for move in ("0 0 0", "3 1 4"):
            for ranks in (1, 4):
                with self.subTest(move, ranks=ranks):
                    np.testing.assert_allclose(pressure(move, ranks), first,
                                               atol=1e-11 * abs(first).max())


if __name__ == "__main__":
    unittest.main()
