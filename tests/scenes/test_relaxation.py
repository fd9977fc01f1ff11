"""A stretched red cell lets go, on a coarse mesh: its time constant is that of its membrane,
viscosity over modulus."""

import unittest

import numpy as np

from scene_case import run_example, study_of

STUDY = study_of("relaxation")
SHEAR_MODULUS = 5.654e-3    # of healthy.material, pg/us^2


PLASMA = 1.4965    # mPa s


def time_constant(viscosity):
    """Of a cell with a membrane of constant viscosity, filled with plasma, the least that a fluid
    can add."""
    folder = run_example("relaxation", shape="rbc_162", patch=3.3, dx=1, width=12,
                         surface_viscosity=viscosity,
                         fast_viscosity=viscosity, inside=PLASMA, sheets="no", timestep=2000,
                         duration=600 * viscosity).folder
    t, ratio = np.loadtxt(folder / "relaxation.dat")[:, :2].T
    return STUDY.fit(t, ratio)[0]


class Relaxation(unittest.TestCase):
    def test_time_constant(self):
        # eta_m / G_s for a strip that shortens (Hochmuth, Worthy and Evans 1979), here for a whole
        # cell, to which the fluid adds the same small time in both cases
        one, two = time_constant(600), time_constant(1200)
        membrane, fluid = two - one, 2 * one - two
        expected = 600e-6 / SHEAR_MODULUS
        print(f"\ntime constants {one:.4f} and {two:.4f} s: membrane {membrane / expected:.3f} of "
              f"eta_m / G_s, fluid {fluid:.4f} s")
        self.assertLess(abs(membrane / expected - 1), 0.15)
        self.assertTrue(0 <= fluid < 0.02)

    def test_healthy_cell_relaxes_as_those_of_the_experiment(self):
        # measured by the same fit: Hochmuth, Worthy and Evans (1979), four cells
        folder = run_example("relaxation", shape="rbc_162", patch=3.3, dx=0.8, width=12,
                             timestep=2000).folder
        found = STUDY.fit(*np.loadtxt(folder / "relaxation.dat")[:, :2].T)[0]
        measured = [STUDY.fit(t, ratio)[0] for t, ratio in STUDY.read(STUDY.REFERENCE).values()]
        print(f"\ntime constant {found:.4f} s, data {min(measured):.4f} to {max(measured):.4f} s")
        self.assertTrue(min(measured) < found < max(measured))


class Fit(unittest.TestCase):
    def test_finds_what_made_the_curve(self):
        t = np.linspace(0, 0.4, 60)
        np.testing.assert_allclose(STUDY.fit(t, STUDY.curve(t, (0.13, 1.1, 2.1))), (0.13, 1.1, 2.1),
                                   rtol=1e-6)


if __name__ == "__main__":
    unittest.main()
