"""Scenes of pair_style rbc/jkr that its tests share, and equation 7 solved independently."""

import numpy as np

from lammps_case import dump_line, scene

K, SIGMA, R = 0.0628, 1e-3, 0.3
ADHESIVE = f"pair_coeff * * adhesive {K} {SIGMA} {R}"
REPULSIVE = f"pair_coeff * * repulsive {K} {R}"

# Two cells face to face, so near that some vertices are inside the other, and out of shape.
TWO = ("rbc/create rbc single 6.1 6.2 4.6 rotate 30 1 0.2 0\n"
       "rbc/create rbc single 6.4 6 6.6 rotate 33 1 0.15 0\n"
       "displace_atoms all random 0.03 0.03 0.03 11")
COMPUTES = "\n".join([
    "compute pe all pe pair", "compute ea all pe/atom pair", "compute sa all stress/atom NULL pair",
    "compute sums all reduce sum c_ea c_sa[*] fx fy fz", "compute contact all pair rbc/jkr",
    "compute press all pressure NULL pair"])
THERMO = ("thermo_style custom step c_pe c_contact c_contact[1] c_sums[*] c_press[*]")

NUMERICAL = [f"f_numerical[{n}]" for n in (1, 2, 3)]
RADIUS = 3.91    # of discs


def contact(coeff=ADHESIVE, pair="pair_style rbc/jkr 0.5", **changes):
    """Membranes without forces and no fluid: atoms stay, and feel contact only."""
    lines = dict(
        boundary="boundary p p p",
        cells=TWO, neighbor="neighbor 0.5 bin", before=f"{pair}\n{coeff}",
        membrane="fix mem all rbc/membrane rbc neo-hookean 1e-30 volume no", fluid=None, ib=None,
        compute=COMPUTES, thermo=THERMO, dump=dump_line(1, columns="id mol type xu yu zu fx fy fz"))
    lines.update(changes)
    return scene(**lines)


def force_of_equation_7(h):
    """Force of equation 7, by bisection for y = sqrt(a / a0): h R / a0^2 = y^4 - (2/3) y."""
    a0 = np.cbrt(6 * np.pi * SIGMA * R**2 / K)
    lo, hi = np.full_like(h, np.cbrt(1 / 6)), np.full_like(h, 10.0)
    for _ in range(200):
        middle = (lo + hi) / 2
        below = middle**4 - 2 / 3 * middle < h * R / a0**2
        lo, hi = np.where(below, middle, lo), np.where(below, hi, middle)
    a = a0 * lo**2
    return K * a**3 / R - np.sqrt(6 * np.pi * SIGMA * K * a**3)
