"""fix rbc/wall through LAMMPS: walls that rbc/surface makes, and atoms that act as sheets."""

import unittest

import numpy as np

from lammps_case import run
from wall_case import AT_REST, BASE, OFFSET, PLATES, VISCOSITY, script, sphere, tube, walls


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
        return run(script(f"inside tube {drive}" + (" " + AT_REST if plates else ""),
                          f"kernel {kernel} sheets {'yes' if sheets else 'no'}", data=made,
                          fluid=BASE["fluid"].replace("dx 1.0", f"grid {cells} {across} {across}"),
                          run=f"run {steps}",
                          thermo=BASE["thermo"] + " f_flow[13] f_flow[16] f_flow[19]",
                          **(PLATES if plates else {})))

    def vessel(self, *words, **more):
        result = self.run_vessel(*words, **more)
        last = {name: column[-1] for name, column in result.thermo.items()}
        poiseuille = last["f_flow[19]"] * np.pi * self.RADIUS**4 / (8 * VISCOSITY)
        last["law"] = last["f_flow[16]"] / poiseuille
        return last

    def test_flow_rate(self):
        for kernel in self.OFFSETS:
            for plates in (False, True):
                with self.subTest(kernel, plates=plates):
                    last = self.vessel("body 1e-5 0 0", kernel, plates)
                    # plates hold the fluid outside back
                    self.assertAlmostEqual(last["law"], 1, delta=0.012 if plates else 0.006)
                    if not plates:
                        force = 1e-5 * np.pi * self.RADIUS**2 * 32
                        self.assertAlmostEqual(last["f_w[1]"] / force, 1, delta=1e-3)

    def test_flow_rate_between_sheets(self):
        # plates next to the vessel do no harm; kernels carry 0.5 and 0.3 % of the flow beyond the
        # surface
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

    def test_another_rate_at_the_start_of_a_run(self):
        box = (8, 8, 8)
        result = walls(box, tube(box, 3), drive="inside tube mean x v_V",
                       before="region tube cylinder x 4 4 3 INF INF\nvariable V equal 1e-3",
                       thermo="thermo_style custom step f_flow[13] f_flow[19]",
                       run="run 0\nvariable V equal 3e-3\nrun 0\nrun 1")
        one, *others = result.tables()
        for table in others:
            np.testing.assert_allclose(table["f_flow[13]"], 3e-3, rtol=1e-3)
            np.testing.assert_allclose(table["f_flow[19]"], 3 * one["f_flow[19]"][0], rtol=1e-2)


class Sheets(unittest.TestCase):
    """Atoms on the surface of the body that they stand for."""

    def test_drag_of_spheres_that_rbc_surface_makes(self):
        # Zick & Homsy: K = 4.292 at 12.5 %, 7.442 at 21.6 %
        for kernel in ("roma3", "peskin4"):
            for share, factor in ((0.31017525, 4.292), (0.37221029, 7.442)):
                n = round(7.4 / share)
                made = (f"region box block 0 {n} 0 {n} 0 {n}\ncreate_box 2 box angle/types 1\n"
                        f"region ball sphere {n / 2 + 0.1} {n / 2 + 0.2} {n / 2 + 0.3} "
                        f"{share * n}\nrbc/surface ball type 2 spacing 1.2")
                result = run(script("mean 1e-3 0 0", f"sheets yes kernel {kernel}", data=made))
                expected = 6 * np.pi * VISCOSITY * share * n * factor * 1e-3
                with self.subTest(kernel, share=share):
                    self.assertAlmostEqual(result.thermo["f_w[1]"][0] / expected, 1, delta=0.005)

    def test_torque_in_shear_flow(self):
        # 4 pi eta a^3 times the shear rate in unbounded flow; what the plates add is below 1 %
        box, radius, rate = (54, 54, 54), 8.0, 1e-4
        u = rate * box[2] / 2
        result = walls(box, sphere((27.1, 27.2, 27.0), radius),
                       drive=f"wall zlo {-u} 0 0 wall zhi {u} 0 0",
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
            later = walls(box, surface, drive=lines["drive"],
                          wall=lines["wall"] + f"sheets {before}",
                          run=f"run 0{again.format(kind)} {lines['wall']}\nrun 0")
            found = later.tables()[-1]["f_w[1]"][0]
            self.assertAlmostEqual(found / force[kind], 1, delta=1e-5)
        self.assertGreater(force["no"] / force["yes"], 1.1)


if __name__ == "__main__":
    unittest.main()
