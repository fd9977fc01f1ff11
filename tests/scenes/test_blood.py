"""Dense blood between plates and in a tube, short runs; the include file that they share, in a
scene that lacks it."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, attempt, in_parallel, run
from scene_case import polyhedron, run_example

SMALL = dict(length=16, gap=12, every=1, frames=1000)
COLLECTED = r"WARNING: Fix rbc/fluid flow: (.*) \("

# what a newcomer makes of examples/suspension-shear/in.plain for 40 %, with coarse cells and a
# short run
FIRST_TRY = f"""
units           micro
atom_style      molecular
boundary        p p f
region          box block 0 14 0 14 0 14
create_box      1 box angle/types 1
molecule        rbc {POTENTIALS}/rbc_162.mol
rbc/create      rbc hematocrit 0.4 seed 4711
neighbor        0.8 bin
fix             mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 &
                area 1.0 0.05
fix             flow all rbc/fluid dx 0.8 viscosity 1.5 density 1.025 &
                wall zlo -0.0012 0 0 wall zhi 0.0012 0 0
fix             ib all rbc/ib flow kernel peskin4 integrator rkc auto
compute         cell all rbc/cell
thermo_style    custom step f_mem evdwl c_cell[1][7]
thermo          50
timestep        200
{{include}}
run             {{steps}}
"""
INCLUDE = f"include {POTENTIALS}/dense.blood"


class Blood(unittest.TestCase):
    def check(self, result, volume):
        table, (_, cell, _) = result.thermo, polyhedron("rbc_162")
        self.assertEqual(re.findall(COLLECTED, result.printed), [])
        self.assertAlmostEqual(table["v_sheared"][-1], result.strain, delta=0.03)
        count = round(table["v_volumes"][0] / cell)
        np.testing.assert_allclose(table["v_volumes"], count * cell, rtol=1e-4)
        self.assertAlmostEqual(count * cell / volume, result.hematocrit, delta=0.6 * cell / volume)
        return table["v_relative"][len(table["v_relative"]) // 2:]

    def one(self, **variables):
        result = run_example("blood", **{**SMALL, "strain": 0.6, **variables})
        result.hematocrit, result.strain = variables["hematocrit"], variables.get("strain", 0.6)
        return result

    def test_between_plates(self):
        cases = [(kernel, adhesion) for kernel in ("roma3", "peskin4") for adhesion in (0, 2.0e-4)]
        results = in_parallel(lambda kernel, adhesion: self.one(hematocrit=0.4, kernel=kernel,
                                                                adhesion=adhesion), cases)
        for case, result in zip(cases, results):
            with self.subTest(case):
                viscosity = self.check(result, SMALL["length"]**2 * SMALL["gap"])
                # cells dissipate more than they would far apart, Einstein's 1 + 2.5 phi, once they
                # are under way; the viscosity measured of such blood is below 10 times that of
                # plasma
                self.assertGreater(viscosity.min(), 1 + 2.5 * 0.4)
                self.assertLess(viscosity.max(), 10)
                self.assertIn(f"work per area {case[1]:g}", result.printed)

    def test_in_a_tube(self):
        result = self.one(hematocrit=0.3, tube=14, length=14, strain=0.3)
        viscosity = self.check(result, np.pi / 4 * 14**2 * 14)
        # of all flows at this flow rate plasma's dissipates least
        self.assertGreater(viscosity.min(), 1)
        self.assertIn("fix rbc/wall vessel; cells are repelled by pair rbc/jkr walls inside",
                      result.printed)


class FirstTry(unittest.TestCase):
    def test_says_what_is_missing(self):
        result = attempt(FIRST_TRY.format(include="", steps=500))
        for missing in ("nothing keeps the .* cells of .*", "nothing repels the .* cells .*"):
            self.assertRegex(result.printed, f"WARNING: .*{missing} include potentials/dense.blood")
        self.assertRegex(result.error,
                         "What may help, likeliest first: include potentials/dense.blood")

    def test_runs_with_the_include(self):
        result = run(FIRST_TRY.format(include=INCLUDE, steps=250))    # a strain of 9
        self.assertEqual(re.findall(r".*nothing (?:keeps|repels).*", result.printed), [])
        self.assertGreater(result.thermo["Step"][-1], 249)

    def test_include_says_that_membranes_are_not_there(self):
        early = FIRST_TRY.replace("fix             mem", f"{INCLUDE}\nfix             mem")
        other = FIRST_TRY.replace("fix             mem", "fix skin").replace(" f_mem", "")
        for script, missing in ((early, "mem"), (other, "mem"),
                                ("variable membranes index skin mem" + other, "mem")):
            result = attempt(script.format(include=INCLUDE, steps=0))
            self.assertEqual(result.error, f"dense.blood: no fix {missing} before it; variable "
                                           "membranes has the IDs")
            self.assertNotEqual(result.code, 0)
        named = "variable membranes index skin" + other
        self.assertNotIn("ERROR", run(named.format(include=INCLUDE, steps=0)).printed)

    def test_contact_of_the_scene_is_kept(self):
        own = ("pair_style rbc/jkr 0.9\npair_coeff 1 1 repulsive 0.2 0.9\n"
               "fix plates all wall/harmonic zlo EDGE 0.1 1 0.5")
        result = run(FIRST_TRY.format(include=f"{own}\n{INCLUDE}", steps=0))
        self.assertIn("gap 0.9 at rest, range 0.9", result.printed)


if __name__ == "__main__":
    unittest.main()
