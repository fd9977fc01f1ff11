"""pair_style rbc/jkr through LAMMPS: forces against its energy, equation 7, flat patches of
different meshes, and that the result depends neither on ranks, newton nor on where in the box the
cells are."""

import io
import sys
import unittest

import numpy as np

from contact_case import (ADHESIVE, COMPUTES, K, NUMERICAL, R, RADIUS, REPULSIVE, SIGMA, THERMO,
                          TWO, contact, force_of_equation_7)
from lammps_case import POTENTIALS, dump_line, run

sys.path.insert(0, str(POTENTIALS))
import shapes    # noqa: E402
from molecule_file import write_molecule    # noqa: E402


class Forces(unittest.TestCase):
    def test_minus_the_gradient_of_the_energy(self):
        for name, coeff in (("adhesive", ADHESIVE), ("repulsive", REPULSIVE)):
            for ranks, newton in ((1, "newton on"), (2, "newton off"), (4, "newton on")):
                with self.subTest(name, ranks=ranks, newton=newton):
                    result = run(contact(coeff, newton=newton,
                                         compute=COMPUTES + "\nfix numerical all numdiff 1 1e-5",
                                         dump=dump_line(1, columns="id fx fy fz " +
                                                        " ".join(NUMERICAL))), ranks)
                    dump = result.dump()
                    f, numerical = dump.forces(), dump(*NUMERICAL)
                    worst = abs(f - numerical).max() / abs(f).max()
                    print(
                        f"\n{name}, {ranks} ranks: forces differ from the gradient by {worst:.2g}")
                    self.assertGreater((abs(f).max(axis=1) > 0).sum(), 50)
                    self.assertLess(worst, 1e-6)

    def test_pressure_is_the_derivative_by_strain(self):
        for name, coeff in (("adhesive", ADHESIVE), ("repulsive", REPULSIVE)):
            with self.subTest(name):
                result = run(
                    contact(coeff, compute=COMPUTES + "\nfix numerical all numdiff/virial 1 1e-6",
                            thermo=THERMO + "".join(f" f_numerical[{n}]" for n in range(1, 7))))
                virial = np.array([result.thermo[f"c_press[{n}]"][0] for n in (1, 2, 3, 6, 5, 4)])
                numerical = np.array([result.thermo[f"f_numerical[{n}]"][0] for n in range(1, 7)])
                np.testing.assert_allclose(virial, numerical, atol=1e-6 * abs(virial).max(), rtol=0)

    def test_no_net_force_and_torque(self):
        for ranks in (1, 2, 4):
            with self.subTest(ranks=ranks):
                dump = run(contact(), ranks).dump()
                f, x = dump.forces(), dump.positions()
                scale = abs(f).sum()
                self.assertLess(abs(f.sum(axis=0)).max(), 1e-15 * scale)
                self.assertLess(abs(np.cross(x - x.mean(axis=0), f).sum(axis=0)).max(),
                                1e-14 * scale)

    def test_per_atom_shares_add_up(self):
        for ranks, newton in ((1, "newton on"), (4, "newton on"), (2, "newton off"),
                              (4, "newton off on")):
            with self.subTest(ranks=ranks, newton=newton):
                thermo = run(contact(newton=newton), ranks).thermo
                np.testing.assert_allclose(thermo["c_sums[1]"], thermo["c_pe"], rtol=1e-12)
                np.testing.assert_allclose(thermo["c_contact"], thermo["c_pe"], rtol=1e-12)
                for n in range(1, 7):
                    np.testing.assert_allclose(-thermo[f"c_sums[{n + 1}]"] / 12**3,
                                               thermo[f"c_press[{n}]"], rtol=1e-12)

    def test_ranks_newton_and_place(self):
        reference = run(contact())
        f = reference.dump().forces()
        for ranks, newton, move in (
                (2, "newton on", "0 0 0"), (4, "newton off", "0 0 0"), (8, "newton on", "3 1 2"),
                (1, "newton off", "6 6 6"), (1, "newton on", "6 0 0"), (4, "newton on", "6 6 6"),
                (4, "newton off", "0 6 7"), (2, "newton off on", "6 0 6"),
                (2, "newton on", "-30 17 40"), (4, "newton off\ncomm_style tiled", "0 6 7"),
                (4, "newton on\ncomm_style tiled", "0 6 7")):
            with self.subTest(ranks=ranks, newton=newton, move=move):
                result = run(contact(newton=newton, last=f"displace_atoms all move {move}"), ranks)
                np.testing.assert_allclose(result.dump().forces(), f, atol=1e-12 * abs(f).max(),
                                           rtol=0)
                for column, value in reference.thermo.items():
                    # net forces, round-off
                    if "c_sums[8]" < column <= "c_sums[9]" or column == "c_sums[10]":
                        continue
                    np.testing.assert_allclose(result.thermo[column], value, rtol=1e-11,
                                               atol=1e-12 * abs(f).max(), err_msg=column)

    def test_types(self):
        # a cell of either type: their pair alone decides
        two = dict(create_box="create_box 2 box angle/types 1",
                   cells=TWO + "\nset mol 2 type 2\nmass * 1")
        both = run(contact()).dump().forces()
        for mixed, expected in ((f"adhesive {K} {SIGMA} {R}", both), ("none", 0 * both),
                                (f"repulsive {K} {R}", run(contact(REPULSIVE)).dump().forces())):
            for pair, word in (("pair_style rbc/jkr 0.5", ""),
                               ("pair_style hybrid/overlay rbc/jkr 0.5 zero 1.0", "rbc/jkr ")):
                with self.subTest(mixed, pair=pair):
                    coeff = (f"pair_coeff * * zero\n" if word else "") + "".join(
                        f"pair_coeff {types} {word}{mixed if types == '1 2' else 'none'}\n"
                        for types in ("1 1", "2 2", "1 2"))
                    dump = run(contact(coeff, pair, **two)).dump()
                    np.testing.assert_allclose(dump.forces(), expected,
                                               atol=1e-13 * abs(both).max(), rtol=0)

    def test_two_laws_overlaid(self):
        single = sum(run(contact(coeff)).dump().forces() for coeff in (ADHESIVE, REPULSIVE))
        both = run(contact(ADHESIVE.replace("adhesive", "rbc/jkr 1 adhesive") + "\n" +
                           REPULSIVE.replace("repulsive", "rbc/jkr 2 repulsive"),
                           "pair_style hybrid/overlay rbc/jkr 0.5 rbc/jkr 0.3",
                           compute=COMPUTES.replace("compute contact all pair rbc/jkr",
                                                    "compute contact all pair "
                                                    "rbc/jkr 1"))).dump().forces()
        np.testing.assert_allclose(both, single, atol=1e-13 * abs(single).max(), rtol=0)

    def test_leaving_and_coming_back_loses_nothing(self):
        steps = [0.06] * 25 + [-0.06] * 25
        lines = ["group upper molecule 2", "run 0 post no"]
        lines += [f"displace_atoms upper move 0 0 {step}\nrun 0 post no" for step in steps]
        energy = run(contact(dump=None, run="\n".join(lines))).thermo["c_pe"]
        self.assertEqual(len(energy), 51)
        self.assertLess(energy.min(), 0)
        self.assertEqual(energy[25], 0)
        np.testing.assert_allclose(energy[::-1], energy, atol=1e-11 * abs(energy).max(), rtol=0)


class InPlasma(unittest.TestCase):
    """Forces within steps too, with ghosts that have moved: a cell is carried off from another in
    shear."""

    STEPS = 150

    def carried(self, ranks=1, integrator="midpoint", neighbor="neighbor 0.6 bin", thermo="",
                **changes):
        box = "region box block 0 18 0 12 0 12"
        walls = " wall zlo -0.0012 0 0 wall zhi 0.0012 0 0"    # 200/s
        return run(contact(
            boundary="boundary p p f", box=box, neighbor=neighbor,
            cells="rbc/create rbc single 7 6 7.3 rotate 4 1 0.5 0\nrbc/create rbc single 7.4 6 4.5",
            membrane="fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                     "volume yes",
            fluid="fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 inertia none" + walls,
            ib=f"fix ib all rbc/ib flow kernel peskin4 integrator {integrator}", every="thermo 10",
            thermo="thermo_style custom step c_pe c_contact[1]" + thermo,
            dump=dump_line(self.STEPS), timestep="timestep 200",
            run=f"run {self.STEPS}", **changes), ranks)

    def test_ranks_and_newton(self):
        for integrator in ("midpoint", "rkc 4"):
            alone = self.carried(integrator=integrator)
            self.assertGreater(np.ptp(alone.thermo["c_contact[1]"]), 2)    # um^2: cells come and go
            x = alone.dump().positions()
            for ranks, newton in ((1, "newton off"), (2, "newton on"), (4, "newton off"),
                                  (4, "newton on")):
                with self.subTest(integrator, ranks=ranks, newton=newton):
                    result = self.carried(ranks, integrator, newton=newton)
                    apart = abs(result.dump().positions() - x).max() / 7.82
                    print(f"\n{integrator}, {ranks} ranks, {newton}: {apart:.2g} diameters apart")
                    self.assertLess(apart, 1e-11)
                    np.testing.assert_allclose(result.thermo["c_pe"], alone.thermo["c_pe"], rtol=0,
                                               atol=1e-9 * abs(alone.thermo["c_pe"]).max())

    def test_adapt_shortens_steps_that_leave_the_list(self):
        # at 200/s a vertex passes the skin in some hundred us; the error alone would allow more
        result = self.carried(2, "rkc auto adapt 1.0 5000 courant 5", "neighbor 0.2 bin",
                              " dt f_ib[8]")
        thermo = result.thermo
        self.assertGreater(thermo["f_ib[8]"][-1], 0)
        self.assertLess(thermo["Dt"].max(), 2000)
        self.assertRegex(result.printed, r"Steps taken again: (\d+), \1 of them gone wrong\n"
                                         "The last: Pair rbc/jkr: vertices moved by up to .* raise "
                                         "the skin")
        self.assertLess(thermo["c_pe"].min(), 0)

    def test_the_step_cost_has_its_rows(self):
        printed = self.carried().printed
        self.assertRegex(printed, r"(?s)Membrane  .*Detection  .*Contact  .*Spread  .*Total")


class Equation7(unittest.TestCase):
    def test_pair_write(self):
        result = run(
            contact(dump=None, run="run 0\npair_write 1 1 200 r 0.01 0.3825 table.txt tip"))
        rows = [line.split() for line in result.path("table.txt").read_text().splitlines()]
        rows = np.array([row for row in rows if len(row) == 4 and row[0].isdigit()], dtype=float)
        self.assertEqual(len(rows), 200)
        force = force_of_equation_7(R - rows[:, 1])
        np.testing.assert_allclose(rows[:, 3], force, atol=1e-8 * np.pi * SIGMA * R, rtol=1e-9)

    def test_restart(self):
        moving = dict(run="run 10", last="fix move all nve\nmass 1 1\ntimestep 0.05",
                      dump=dump_line(10))
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                whole = run(contact(**{**moving, "run": "run 5\nwrite_restart r\nrun 5"}), ranks)
                later = dict.fromkeys(("units", "boundary", "box", "create_box", "cells", "before"))
                after = run(contact(**{**moving, **later, "run": "run 5",
                                       "style": f"read_restart {whole.path('r')}"}), ranks)
                self.assertGreater(abs(whole.dump().positions() - whole.dump().positions(0)).max(),
                                   1e-6)
                np.testing.assert_array_equal(after.dump().positions(), whole.dump().positions())


HALF = 1.0


def height(x):
    """Half thickness over the radius of a disc with flat faces."""
    return HALF / RADIUS * np.sqrt(np.maximum(0, 1 - x**8))


def flat_disc(frequency):
    """A molecule file of that disc."""
    points, triangles = shapes.geodesic(frequency)
    text = io.StringIO()
    write_molecule(text, ["flat disc"], RADIUS * shapes.revolved(points, height), triangles)
    return text.getvalue()


def smooth_energy(gap):
    """Of two of the smooth discs face to face: twice a half of the integral of the energy per area
    over a face."""
    r = np.linspace(0, 1, 2001) * RADIUS
    z = RADIUS * height(r / RADIUS)
    # distance from (r, z) of the one to the face of the other, the mirror image about the middle of
    # the gap
    distance = np.array([np.hypot(s - r, gap + 2 * HALF - h - z).min() for s, h in zip(r, z)])
    a0 = np.cbrt(6 * np.pi * SIGMA * R**2 / K)
    y = np.linspace(np.cbrt(1 / 6), 3, 20001)
    overlap = (y**4 - 2 / 3 * y) * a0**2 / R
    work = np.concatenate(
        [[0], np.cumsum(np.diff(overlap) * ((f := 6 * (y**6 - y**3))[1:] + f[:-1]) / 2)])
    work *= SIGMA / -work.min()    # the depth of the well is sigma
    density = np.interp(R - distance, overlap, work, left=0)
    ring = 2 * np.pi * (r[1:] + r[:-1]) / 2 * np.hypot(np.diff(r), np.diff(z))
    return (ring * (density[1:] + density[:-1]) / 2).sum()


class FlatPatches(unittest.TestCase):
    GAP = R - np.cbrt(6 * np.pi * SIGMA * R**2 / K)**2 / R / 3

    def energy(self, frequency):
        cells = (f"rbc/create rbc single 6 6 4 rotate 17 0 0 1\n"
                 f"rbc/create rbc single 6 6 {4 + 2 * HALF + self.GAP!r} rotate 42 0 0 1")
        return run(contact(cells=cells, molecule="molecule rbc disc.mol", dump=None),
                   files={"disc.mol": flat_disc(frequency)}).thermo["c_pe"][0]

    def test_work_per_area(self):
        exact = smooth_energy(self.GAP)
        found = []
        for frequency in (4, 8, 16):
            energy = self.energy(frequency)
            found.append(energy)
            print(f"\n{10 * frequency**2 + 2} vertices: energy {energy / exact:.4f} of that of "
                  f"smooth discs, {-energy / SIGMA:.2f} um^2 times sigma")
        for energy in found:
            self.assertLess(abs(energy / exact - 1), 0.05)
            self.assertLess(abs(energy / found[-1] - 1), 0.05)


if __name__ == "__main__":
    unittest.main()
