"""The mobility of all vertices of two near cells, with sheets, gaps and smooth: each of its columns
is the velocities that one force makes. It is symmetric; no force draws energy from the fluid."""

import unittest
from pathlib import Path

import numpy as np

from lammps_case import POTENTIALS, make_template, read_template, run, scene


def mobility(template, centres, kernel, plates):
    vertices, _ = read_template(template)
    size = 3 * len(vertices) * len(centres)
    # at step n there is a force of 1 on coordinate n; the cells stay where they are
    forces = [f"variable f{axis} atom 3*(id-1)+{d}==step" for d, axis in enumerate("xyz")]
    ends = " wall zlo 0 0 0 wall zhi 0 0 0" if plates else ""
    dump = run(scene(
        boundary="boundary p p f" if plates else "boundary p p p",
        molecule=f"molecule rbc {template}",
        cells="\n".join(f"rbc/create rbc single {x} {y} {z}" for x, y, z in centres),
        before="\n".join(["pair_style rbc/jkr 0.5 self yes", "pair_coeff * * none", *forces,
                          "fix push all addforce v_fx v_fy v_fz"]),
        membrane="fix mem all rbc/membrane rbc neo-hookean 1e-30 volume no smooth yes",
        fluid="fix flow all rbc/fluid dx 1 viscosity 1.5 density 1.025" + ends,
        ib=f"fix ib all rbc/ib flow kernel {kernel} integrator euler sheets yes gaps yes",
        thermo="", every="thermo 1000", timestep="timestep 1e-12", run=f"run {size - 1}",
        dump="dump atoms all custom 1 atoms.dump id vx vy vz\n"
             "dump_modify atoms sort id format float %.17g")).dump()
    return np.column_stack([dump("vx", "vy", "vz", frame=n).ravel() for n in range(size)])


class Mobility(unittest.TestCase):
    def check(self, name, kernel, template, centres, plates=False):
        """Returns the asymmetry over the largest element."""
        matrix = mobility(template, centres, kernel, plates)
        asymmetry = abs(matrix - matrix.T).max() / abs(matrix).max()
        values = np.linalg.eigvalsh((matrix + matrix.T) / 2)
        print(f"\n{name}, {kernel}: {len(matrix)} columns, asymmetry {asymmetry:.1e}, "
              f"eigenvalues {values[0] / values[-1]:.1e} to 1")
        self.assertGreaterEqual(values[0], -1e-12 * values[-1])
        return asymmetry

    def test_of_two_red_cells(self):
        # the rims are 0.2 to 0.4 fluid cells apart
        centres = [(6.1, 6.2, 4.4), (6.4, 6.0, 7.15)]
        self.assertLess(self.check("two red cells", "roma3", POTENTIALS / "rbc_162.mol", centres),
                        1e-12)

    def test_of_two_spheres(self):
        # 0.3 fluid cells apart; beside a plate, the lower one as far from it
        make_template("sphere", "--radius", 2, "--frequency", 2, "--output", "sphere.mol")
        template = Path("sphere.mol").resolve()
        for kernel in ("roma3", "peskin4"):
            with self.subTest(kernel):
                apart = self.check("two spheres", kernel, template,
                                   [(6.1, 6.2, 4.3), (6.1, 6.2, 8.6)])
                self.assertLess(apart, 1e-12)
                beside = self.check("two spheres beside a plate", kernel, template,
                                    [(6.1, 6.2, 2.3), (6.1, 6.2, 6.6)], plates=True)
                self.assertLess(beside, 0.1)    # sheets yes is symmetric away from plates only


if __name__ == "__main__":
    unittest.main()
