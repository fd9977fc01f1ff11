"""Two adhered cells on a coarse grid: flat contact where adhesion is weak, S-shaped where it is
strong (Ziherl and Svetina, PNAS 104, 761, 2007; Flormann et al., Sci Rep 7, 7928, 2017), no surface
inside the other, at rest in plasma."""

import unittest

import numpy as np

from lammps_case import POTENTIALS, in_parallel, read_template
from scene_case import run_example, study_of

STUDY = study_of("doublet")
WEAK, STRONG = 1e-4, 1e-3
COARSE = dict(dx=1.0, width=13, height=10, steps=4000, duration=4000)


def winding(points, x, triangles):
    """Turns of the surface around each point: 1 inside, 0 outside (Van Oosterom and Strackee
    1983)."""
    a, b, c = (x[triangles[:, n]][None] - points[:, None] for n in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=-1) for v in (a, b, c))
    triple = np.einsum("pti,pti->pt", a, np.cross(b, c))
    below = (la * lb * lc + np.einsum("pti,pti->pt", a, b) * lc +
             np.einsum("pti,pti->pt", b, c) * la +
             np.einsum("pti,pti->pt", c, a) * lb)
    return np.arctan2(triple, below).sum(axis=1) / (2 * np.pi)


class Doublet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = in_parallel(lambda sigma, ranks: run_example("doublet", ranks, sigma=sigma,
                                                                   **COARSE),
                                  [(WEAK, 1), (STRONG, 2)])
        cls.atoms = [STUDY.last_frame(result.path("doublet.dump")) for result in cls.results]
        cls.rows = [np.loadtxt(result.path("doublet.dat")) for result in cls.results]

    def test_flat_then_curved(self):
        amplitudes = []
        for (sigma, area, adhesion, *_), atoms in zip(self.rows, self.atoms):
            amplitudes.append(STUDY.contact_zone(atoms[:, 1:4], atoms[:, 0], atoms[:, 4] != 0)[3])
            print(f"\nsigma {sigma:g}: contact {area:.1f} um^2, amplitude of the S "
                  f"{amplitudes[-1]:.2f} um")
            self.assertLess(adhesion, 0)
            # sigma is the most that an area can give
            self.assertLessEqual(-adhesion / sigma, area)
        self.assertLess(amplitudes[0], 0.1)
        self.assertGreater(amplitudes[1], 0.3)
        self.assertGreater(self.rows[1][1], 1.4 * self.rows[0][1])

    def test_energies_have_a_minimum(self):
        # what is let go falls in a drag; in plasma, elsewhere in time but not in space, nothing
        # moves any more
        for result, row in zip(self.results, self.rows):
            fall, plasma = result.tables()
            total = fall["PotEng"] + fall["KinEng"]
            self.assertLess(np.diff(total).max(), 1e-6 * abs(total[-1]))
            np.testing.assert_allclose(plasma["PotEng"], fall["PotEng"][-1], rtol=1e-3)
            self.assertLess(row[4], 1e-5)    # um/us; cells that settle do 1e-6

    def test_surfaces_stay_apart(self):
        _, triangles = read_template(POTENTIALS / "rbc_642.mol")
        for atoms in self.atoms:
            cells = [atoms[atoms[:, 0] == cell][:, 1:4] for cell in (1, 2)]
            for one, other in (cells, cells[::-1]):
                edges = np.concatenate(
                    [(one[triangles[:, n]] + one[triangles[:, (n + 1) % 3]]) / 2 for n in range(3)])
                for points in (one, edges, one[triangles].mean(axis=1)):
                    self.assertLess(abs(winding(points, other, triangles)).max(), 1e-6)


if __name__ == "__main__":
    unittest.main()
