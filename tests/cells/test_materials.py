"""The materials of potentials/ have the moduli that were published, as small deformations of a
sphere show; cells of all kinds go into one scene."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, attempt, dump_line, read_template, run, scene

SPHERE = POTENTIALS / "capsule_162.mol"
WHITE, RELAXED = POTENTIALS / "white_362.mol", POTENTIALS / "white_362_relaxed.mol"
SHEET = "mooney-rivlin ${C1} ${C2} ${h}"
CENTRE = 6
REACH = 5    # of a deformation, um from the centre


def area(path):
    x, triangles = read_template(path)
    a, b, c = x[triangles].transpose(1, 0, 2)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def include(material, *settings):
    """Lines that set variables, given as name=value, and include a material after them."""
    lines = [f"variable {' index '.join(setting.split('='))}" for setting in settings]
    return "\n".join([*lines, f"include {POTENTIALS}/{material}.material"])


def energy(strains, template, before, membrane, value="f_mem[1]"):
    """Energy of the sheet of a cell whose axes are longer by these parts."""
    ramps = [f"displace_atoms all ramp {axis} {-strain * REACH!r} {strain * REACH!r} "
             f"{axis} {CENTRE - REACH} {CENTRE + REACH} units box"
             for axis, strain in zip("xyz", strains)]
    found = run(scene(
        molecule=f"molecule cell {template}",
        cells=f"rbc/create cell single {CENTRE} {CENTRE} {CENTRE}",
        before="\n".join([before, *ramps]), membrane=f"fix mem all rbc/membrane cell {membrane}",
        fluid=None, ib=None, thermo=f"thermo_style custom step {value}"))
    return found.thermo[value][0]


def shear_modulus(material, *settings):
    """Of an incompressible sheet, from two small stretches of a sphere along an axis, at the same
    volume.

    A sheet of moduli Gs, K on a sphere has an energy per area of (2/5 Gs + K/15) e:e for a small
    affine strain e without change of volume, averaged over the sphere; its K is 3 Gs. The mean is
    exact on a mesh with the rotations of an icosahedron.
    """
    strain = 1e-3
    found = [energy((e, -e / 2, -e / 2), SPHERE, include(material, *settings), SHEET)
             for e in (strain, -strain)]
    return np.mean(found) / (area(SPHERE) * 1.5 * strain**2 * (2 / 5 + 3 / 15))


class Published(unittest.TestCase):
    def test_shear_modulus_of_a_healthy_cell(self):
        # 5.5 +- 0.8 uN/m of fluctuations at room temperature: Park et al, PNAS 105, 13730 (2008)
        self.assertAlmostEqual(1e3 * shear_modulus("healthy"), 5.5, delta=0.8)

    def test_malaria_stiffens_a_cell_as_measured(self):
        # uN/m: Suresh et al, Acta Biomater 1, 15 (2005), who have 8 for a healthy cell
        healthy = shear_modulus("healthy")
        for stage, modulus in (("ring", 16), ("trophozoite", 21.3), ("schizont", 53.3)):
            with self.subTest(stage):
                ratio = shear_modulus("malaria", f"stage={stage}") / healthy
                print(f"\n{stage}: {ratio:.3f} times as stiff, measured {modulus / 8:.3f}")
                self.assertAlmostEqual(ratio / (modulus / 8), 1, delta=2e-3)

    def test_what_is_unknown_stops_with_the_choices(self):
        for material, setting, choices in (
                ("malaria", "stage=Ring", "ring, trophozoite or schizont"),
                ("sickle", "state=oxidized", "deoxygenated or oxygenated")):
            script = f"units micro\n{include(material, setting)}\nprint 'went on'\n"
            for ranks in (1, 2):
                with self.subTest(material, ranks=ranks):
                    result = attempt(script, ranks)
                    name, value = setting.split("=")
                    self.assertEqual(result.error,
                                     f"{material}.material: {name} {value} must be {choices}")
                    self.assertNotEqual(result.code, 0)
                    self.assertNotIn("went on", result.printed)

    def test_oxygenated_sickle_cell_is_as_soft_as_a_healthy_one(self):
        healthy = shear_modulus("healthy")
        self.assertAlmostEqual(shear_modulus("sickle", "state=oxygenated") / healthy, 1, delta=1e-3)
        self.assertGreater(shear_modulus("sickle") / healthy, 500)

    def test_inside_of_a_sickle_cell_is_that_of_its_hemoglobin(self):
        # Ross and Minton (1977): 10.7 times that of water for a healthy cell's 33 g/dL
        script = ["units micro", include("sickle", "mchc=33"), "print 'inside ${interior}'\n"]
        printed = run("\n".join(script)).printed
        inside = float(re.search(r"^inside (\S+)", printed, re.MULTILINE).group(1))
        self.assertAlmostEqual(inside / (10.7 * 0.93), 1, delta=0.01)

    def test_young_modulus_of_a_platelet(self):
        # 170 +- 60 Pa: Haga et al, Ann Biomed Eng 26, 268 (1998); each side stands for 0.4 um
        young = 1e3 * 3 * shear_modulus("platelet") / 0.4
        print(f"\nYoung's modulus {young:.1f} Pa")
        self.assertAlmostEqual(young, 170, delta=2)

    def test_a_platelet_keeps_its_shape_in_shear(self):
        half = 3
        found = run(scene(
            box=f"region box block 0 {2 * half} 0 {2 * half} 0 {2 * half}",
            molecule=f"molecule cell {POTENTIALS / 'platelet_42.mol'}",
            cells=f"rbc/create cell single {half} {half} {half} rotate 30 1 0 0",
            before=include("platelet"),
            membrane=f"fix mem all rbc/membrane cell {SHEET} bending ${{kappa}} reference "
                     "volume yes smooth yes",
            fluid="fix flow all rbc/fluid dx 0.4 viscosity ${viscosity} "
                  f"wall zlo 0 0 0 wall zhi {2 * half * 1e-4} 0 0",
            ib="fix ib all rbc/ib flow integrator rkc auto", compute="compute cell all rbc/cell",
            thermo="thermo_style custom step c_cell[1][7]", timestep="timestep 200",
            run="run 30")).thermo["c_cell[1][7]"]
        print(f"\nTaylor deformation {found[0]:.4f}, {np.ptp(found):.1e} more or less in shear")
        self.assertLess(np.ptp(found), 1e-3)

    def test_tension_of_a_white_cell(self):
        # 0.024 mN/m, which grows by 0.039 times the change of area: Needham and Hochmuth (1992)
        before = include("white-cell") + f"\nmolecule relaxed {RELAXED}"
        step, rest = 2e-3, area(WHITE)
        found = [energy((strain, strain, strain), WHITE, before, SHEET + " stress-free relaxed")
                 for strain in step * np.arange(-2, 3)]
        areas = rest * (1 + step * np.arange(-2, 3))**2
        tension = np.diff(found) / np.diff(areas)
        middle = (areas[1:] + areas[:-1]) / 2
        growth, at_rest = np.polyfit(middle / rest - 1, tension, 1)
        print(f"\ntension {at_rest:.5f} mN/m, modulus of area {growth:.4f} mN/m")
        self.assertAlmostEqual(at_rest / 0.024, 1, delta=0.005)
        self.assertAlmostEqual(growth / 0.039, 1, delta=0.02)


# of each material, the number of cells of 14, the template, what else its membrane needs, and the
# strain that is too much for such a cell
KINDS = {"healthy": (9, "cell", "", 0.2), "malaria": (1, "cell", "", 0.1),
         "sickle": (2, "cell", "smooth yes", 2e-3), "platelet": (1, "platelet", "smooth yes", 0.02),
         "white-cell": (1, "white", "stress-free relaxed", 0.05)}


class Mixed(unittest.TestCase):
    def test_all_kinds_in_one_scene(self):
        templates = {"cell": POTENTIALS / "rbc_162.mol", "platelet": POTENTIALS / "platelet_42.mol",
                     "white": WHITE, "relaxed": RELAXED}
        mixes, fixes = [], []
        for kind, (material, (count, template, more, _)) in enumerate(KINDS.items(), 1):
            reference = " reference" if template == "platelet" else ""
            mixes.append(f"mix {template} {count / 14} {kind}")
            fixes += [f"group g{kind} type {kind}", include(material),
                      f"fix m{kind} g{kind} rbc/membrane {template} {SHEET} bending ${{kappa}}"
                      f"{reference} area ${{kglobal}} ${{klocal}} volume yes {more}"]
        dump = run(scene(
            box="region box block 0 18 0 18 0 16\nregion inside block 0 18 0 18 0.5 15.5",
            create_box="create_box 5 box angle/types 1",
            molecule="\n".join(f"molecule {name} {path}" for name, path in templates.items()),
            cells="rbc/create cell number 14 seed 3 overlap 0.3 region inside type 1 "
                  + " ".join(mixes[1:]),
            membrane="\n".join(fixes), neighbor=None,
            fluid="fix flow all rbc/fluid dx 0.8 viscosity ${viscosity} "
                  "wall zlo -0.0008 0 0 wall zhi 0.0008 0 0",
            ib="fix ib all rbc/ib flow integrator rkc auto adapt 5e-3 500",
            compute="variable membranes index m1 m2 m3\nvariable touching index 1*5\n"
                    f"include {POTENTIALS}/dense.blood",
            thermo="thermo_style custom step", dump=dump_line(15), run="run 15")).dump()
        for kind, (count, template, _, most) in enumerate(KINDS.values(), 1):
            cells = np.unique(dump("mol")[dump("type") == kind])
            self.assertEqual(len(cells), count)
            x, triangles = read_template(templates[template])
            for cell in cells:
                moved = dump.positions()[dump("mol") == cell]
                change = volume(moved, triangles) / volume(x, triangles) - 1
                self.assertLess(abs(change), 1e-4)
                self.assertLess(strain(x, moved, triangles), most)


def strain(x, moved, triangles):
    """Largest change of an edge over its length, but for a tenth of the edges."""
    ends = np.roll(triangles, 1, axis=1)
    before, after = (np.linalg.norm(points[triangles] - points[ends], axis=2)
                     for points in (x, moved))
    return np.quantile(abs(after / before - 1), 0.9)


def volume(x, triangles):
    a, b, c = x[triangles].transpose(1, 0, 2)
    return np.sum(a * np.cross(b, c)) / 6


if __name__ == "__main__":
    unittest.main()
