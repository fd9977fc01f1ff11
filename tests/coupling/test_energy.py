"""Cells that are let go in a fluid at rest lose energy in each step, as much as their forces do
work on the fluid."""

import unittest

import numpy as np

from lammps_case import SHEAR, in_parallel, run, scene

CONTACT = "0.5 0.6"    # modulus and range of the repulsion


def relaxing(integrator, timestep, steps, kernel, plates):
    """Two red cells, drawn out by a fifth, 0.2 apart and, between plates, as far from the lower
    one: their energy, that of contacts in it, and the power of their forces, after each step."""
    ends, shift = (" wall zlo 0 0 0 wall zhi 0 0 0", -2.93) if plates else ("", 0)
    seen = " plates yes" if plates else ""
    table = run(scene(
        boundary="boundary p p f" if plates else "boundary p p p",
        cells=f"rbc/create rbc single 6.1 6.2 {4.4 + shift}\n"
              f"rbc/create rbc single 6.4 6 {7.15 + shift}\n"
              "variable long atom 6+1.2*(x-6)\nvariable narrow atom 6+(y-6)/1.2\n"
              "set group all x v_long y v_narrow",
        before=f"pair_style rbc/jkr 0.6{seen}\npair_coeff * * repulsive {CONTACT}",
        membrane=SHEAR["membrane"].replace("volume yes", "area 0.1 0.05 volume yes smooth yes"),
        fluid="fix flow all rbc/fluid dx 1 viscosity 1.5 density 1.025" + ends,
        ib=f"fix ib all rbc/ib flow kernel {kernel} sheets yes gaps yes integrator {integrator}",
        compute="variable work atom fx*vx+fy*vy+fz*vz\ncompute power all reduce sum v_work",
        thermo="thermo_style custom step f_mem evdwl c_power", every="thermo 1",
        timestep=f"timestep {timestep}", run=f"run {steps}")).thermo
    return table["f_mem"] + table["E_vdwl"], table["E_vdwl"], table["c_power"]


class RelaxingCells(unittest.TestCase):
    def test_energy_falls_in_each_step(self):
        cases = [(integrator, timestep, 4000 // timestep, kernel, plates)
                 for integrator, timestep in (("euler", 20), ("rkc auto", 50))
                 for kernel, plates in (("roma3", False), ("peskin4", True))]
        for case, (energy, contact, power) in zip(cases, in_parallel(relaxing, cases)):
            with self.subTest(case):
                lost, least = energy[0] - energy[-1], -np.diff(energy).max()
                later = len(energy) // 4    # when forces have become smooth in time
                work = case[1] * (power[later:].sum() - (power[later] + power[-1]) / 2)
                off = work / (energy[later] - energy[-1]) - 1
                print(f"\n{case}: energy from {energy[0]:.3g}, {contact[0]:.3g} of it that of "
                      f"contacts, to {energy[-1]:.3g}; by {least / lost:.1e} of what is lost or "
                      f"more in each step; work differs by {off:.1e}")
                self.assertGreater(contact[0], 0.2 * energy[0])
                self.assertGreater(lost, 0.9 * energy[0])
                self.assertGreater(least, 0)
                self.assertGreater(power.min(), 0)
                self.assertLess(abs(off), 0.01)


if __name__ == "__main__":
    unittest.main()
