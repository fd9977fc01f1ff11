"""pair_style rbc/jkr through LAMMPS: forces against its energy, equation 7, flat patches of different meshes, and that the
result depends neither on ranks, newton nor on where in the box the cells are."""

import io
import sys
import unittest

import numpy as np

from lammps_case import POTENTIALS, dump_line, read_template, run, scene

sys.path.insert(0, str(POTENTIALS))
import shapes    # noqa: E402
from molecule_file import write_molecule    # noqa: E402

K, SIGMA, R = 0.0628, 1e-3, 0.3
ADHESIVE = f"pair_coeff * * adhesive {K} {SIGMA} {R}"
REPULSIVE = f"pair_coeff * * repulsive {K} {R}"

# Two cells face to face, so near that some vertices are inside the other, and out of shape.
TWO = ("rbc/create rbc single 6.1 6.2 4.6 rotate 30 1 0.2 0\nrbc/create rbc single 6.4 6 6.6 rotate 33 1 0.15 0\n"
       "displace_atoms all random 0.03 0.03 0.03 11")
COMPUTES = "\n".join([
    "compute pe all pe pair", "compute ea all pe/atom pair", "compute sa all stress/atom NULL pair",
    "compute sums all reduce sum c_ea c_sa[*] fx fy fz", "compute contact all pair rbc/jkr",
    "compute press all pressure NULL pair"])
THERMO = ("thermo_style custom step c_pe c_contact c_contact[1] c_sums[*] c_press[*]")


def contact(coeff=ADHESIVE, pair="pair_style rbc/jkr 0.5", **changes):
    """Membranes without forces and no fluid: atoms stay, and feel contact only."""
    lines = dict(boundary="boundary p p p", cells=TWO, neighbor="neighbor 0.5 bin", before=f"{pair}\n{coeff}",
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


NUMERICAL = [f"f_numerical[{n}]" for n in (1, 2, 3)]


class Forces(unittest.TestCase):
    def test_minus_the_gradient_of_the_energy(self):
        for name, coeff in (("adhesive", ADHESIVE), ("repulsive", REPULSIVE)):
            for ranks, newton in ((1, "newton on"), (2, "newton off"), (4, "newton on")):
                with self.subTest(name, ranks=ranks, newton=newton):
                    result = run(contact(coeff, newton=newton,
                                         compute=COMPUTES + "\nfix numerical all numdiff 1 1e-5",
                                         dump=dump_line(1, columns="id fx fy fz " + " ".join(NUMERICAL))), ranks)
                    dump = result.dump()
                    f, numerical = dump.forces(), dump(*NUMERICAL)
                    worst = abs(f - numerical).max() / abs(f).max()
                    print(f"\n{name}, {ranks} ranks: forces differ from the gradient by {worst:.2g}")
                    self.assertGreater((abs(f).max(axis=1) > 0).sum(), 50)
                    self.assertLess(worst, 1e-6)

    def test_pressure_is_the_derivative_by_strain(self):
        for name, coeff in (("adhesive", ADHESIVE), ("repulsive", REPULSIVE)):
            with self.subTest(name):
                result = run(contact(coeff, compute=COMPUTES + "\nfix numerical all numdiff/virial 1 1e-6",
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
                self.assertLess(abs(np.cross(x - x.mean(axis=0), f).sum(axis=0)).max(), 1e-14 * scale)

    def test_per_atom_shares_add_up(self):
        for ranks, newton in ((1, "newton on"), (4, "newton on"), (2, "newton off"), (4, "newton off on")):
            with self.subTest(ranks=ranks, newton=newton):
                thermo = run(contact(newton=newton), ranks).thermo
                np.testing.assert_allclose(thermo["c_sums[1]"], thermo["c_pe"], rtol=1e-12)
                np.testing.assert_allclose(thermo["c_contact"], thermo["c_pe"], rtol=1e-12)
                for n in range(1, 7):
                    np.testing.assert_allclose(-thermo[f"c_sums[{n + 1}]"] / 12**3, thermo[f"c_press[{n}]"],
                                               rtol=1e-12)

    def test_ranks_newton_and_place(self):
        reference = run(contact())
        f = reference.dump().forces()
        for ranks, newton, move in ((2, "newton on", "0 0 0"), (4, "newton off", "0 0 0"), (8, "newton on", "3 1 2"),
                                    (1, "newton off", "6 6 6"), (1, "newton on", "6 0 0"), (4, "newton on", "6 6 6"),
                                    (4, "newton off", "0 6 7"), (2, "newton off on", "6 0 6"),
                                    (2, "newton on", "-30 17 40")):
            with self.subTest(ranks=ranks, newton=newton, move=move):
                result = run(contact(newton=newton, last=f"displace_atoms all move {move}"), ranks)
                np.testing.assert_allclose(result.dump().forces(), f, atol=1e-12 * abs(f).max(), rtol=0)
                for column, value in reference.thermo.items():
                    if "c_sums[8]" < column <= "c_sums[9]" or column == "c_sums[10]":    # net forces, round-off
                        continue
                    np.testing.assert_allclose(result.thermo[column], value, rtol=1e-11,
                                               atol=1e-12 * abs(f).max(), err_msg=column)

    def test_types(self):
        # a cell of either type: their pair alone decides
        two = dict(create_box="create_box 2 box angle/types 1", cells=TWO + "\nset mol 2 type 2\nmass * 1")
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
                    np.testing.assert_allclose(dump.forces(), expected, atol=1e-13 * abs(both).max(), rtol=0)

    def test_two_laws_overlaid(self):
        single = sum(run(contact(coeff)).dump().forces() for coeff in (ADHESIVE, REPULSIVE))
        both = run(contact(ADHESIVE.replace("adhesive", "rbc/jkr 1 adhesive") + "\n" +
                           REPULSIVE.replace("repulsive", "rbc/jkr 2 repulsive"),
                           "pair_style hybrid/overlay rbc/jkr 0.5 rbc/jkr 0.3",
                           compute=COMPUTES.replace("compute contact all pair rbc/jkr",
                                                    "compute contact all pair rbc/jkr 1"))).dump().forces()
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
    """Forces within steps too, with ghosts that have moved: a cell is carried off from another in shear."""

    STEPS = 150

    def carried(self, ranks=1, integrator="midpoint", neighbor="neighbor 0.6 bin", thermo="", **changes):
        box = "region box block 0 18 0 12 0 12"
        walls = " wall zlo -0.0012 0 0 wall zhi 0.0012 0 0"    # 200/s
        return run(contact(
            boundary="boundary p p f", box=box, neighbor=neighbor,
            cells="rbc/create rbc single 7 6 7.3 rotate 4 1 0.5 0\nrbc/create rbc single 7.4 6 4.5",
            membrane="fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 volume yes",
            fluid="fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 inertia none" + walls,
            ib=f"fix ib all rbc/ib flow integrator {integrator}", every="thermo 10",
            thermo="thermo_style custom step c_pe c_contact[1]" + thermo, dump=dump_line(self.STEPS), timestep="timestep 200",
            run=f"run {self.STEPS}", **changes), ranks)

    def test_ranks_and_newton(self):
        for integrator in ("midpoint", "rkc 4"):
            alone = self.carried(integrator=integrator)
            self.assertGreater(np.ptp(alone.thermo["c_contact[1]"]), 3)
            x = alone.dump().positions()
            for ranks, newton in ((1, "newton off"), (2, "newton on"), (4, "newton off"), (4, "newton on")):
                with self.subTest(integrator, ranks=ranks, newton=newton):
                    result = self.carried(ranks, integrator, newton=newton)
                    apart = abs(result.dump().positions() - x).max() / 7.82
                    print(f"\n{integrator}, {ranks} ranks, {newton}: {apart:.2g} diameters apart")
                    self.assertLess(apart, 1e-11)
                    np.testing.assert_allclose(result.thermo["c_pe"], alone.thermo["c_pe"], rtol=0,
                                               atol=1e-9 * abs(alone.thermo["c_pe"]).max())

    def test_adapt_shortens_steps_that_leave_the_list(self):
        # at 200/s a vertex passes the skin in some hundred us; the error alone would allow more
        result = self.carried(2, "rkc auto adapt 1.0 5000 courant 5", "neighbor 0.2 bin", " dt f_ib[8]")
        thermo = result.thermo
        self.assertGreater(thermo["f_ib[8]"][-1], 0)
        self.assertLess(thermo["Dt"].max(), 2000)
        self.assertRegex(result.printed, r"Steps taken again: (\d+), \1 of them gone wrong\n"
                                         r"The last: Pair rbc/jkr: vertices moved by up to .* raise the skin")
        self.assertLess(thermo["c_pe"].min(), 0)

    def test_the_step_cost_has_its_rows(self):
        printed = self.carried().printed
        self.assertRegex(printed, r"(?s)Membrane  .*Detection  .*Contact  .*Spread  .*Total")


class Equation7(unittest.TestCase):
    def test_pair_write(self):
        result = run(contact(dump=None, run="run 0\npair_write 1 1 200 r 0.01 0.3825 table.txt tip"))
        rows = [line.split() for line in result.path("table.txt").read_text().splitlines()]
        rows = np.array([row for row in rows if len(row) == 4 and row[0].isdigit()], dtype=float)
        self.assertEqual(len(rows), 200)
        force = force_of_equation_7(R - rows[:, 1])
        np.testing.assert_allclose(rows[:, 3], force, atol=1e-8 * np.pi * SIGMA * R, rtol=1e-9)

    def test_restart(self):
        moving = dict(run="run 10", last="fix move all nve\nmass 1 1\ntimestep 0.05", dump=dump_line(10))
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                whole = run(contact(**{**moving, "run": "run 5\nwrite_restart r\nrun 5"}), ranks)
                later = dict.fromkeys(("units", "boundary", "box", "create_box", "cells", "before"))
                after = run(contact(**{**moving, **later, "run": "run 5",
                                       "style": f"read_restart {whole.path('r')}"}), ranks)
                self.assertGreater(abs(whole.dump().positions() - whole.dump().positions(0)).max(), 1e-6)
                np.testing.assert_array_equal(after.dump().positions(), whole.dump().positions())


RADIUS, HALF = 3.91, 1.0


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
    """Of two of the smooth discs face to face: twice a half of the integral of the energy per area over a face."""
    r = np.linspace(0, 1, 2001) * RADIUS
    z = RADIUS * height(r / RADIUS)
    # distance from (r, z) of the one to the face of the other, the mirror image about the middle of the gap
    distance = np.array([np.hypot(s - r, gap + 2 * HALF - h - z).min() for s, h in zip(r, z)])
    a0 = np.cbrt(6 * np.pi * SIGMA * R**2 / K)
    y = np.linspace(np.cbrt(1 / 6), 3, 20001)
    overlap = (y**4 - 2 / 3 * y) * a0**2 / R
    work = np.concatenate([[0], np.cumsum(np.diff(overlap) * ((f := 6 * (y**6 - y**3))[1:] + f[:-1]) / 2)])
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
            print(f"\n{10 * frequency**2 + 2} vertices: energy {energy / exact:.4f} of that of smooth discs, "
                  f"{-energy / SIGMA:.2f} um^2 times sigma")
        for energy in found:
            self.assertLess(abs(energy / exact - 1), 0.05)
            self.assertLess(abs(energy / found[-1] - 1), 0.05)


def plate(frequency, thickness):
    """Vertices and triangles of a flat disc of that thickness."""
    points, triangles = shapes.geodesic(frequency)
    half = thickness / 2
    return RADIUS * shapes.revolved(points, lambda x: half / RADIUS * np.sqrt(np.maximum(0, 1 - x**12))), triangles


def folded(points, gap, thickness):
    """Bent about the y axis to a U whose arms are `gap` apart, faces that were the top of the plate inside."""
    bend = (gap + thickness) / 2
    arc = np.clip(points[:, 0], -np.pi / 2 * bend, np.pi / 2 * bend)
    along, angle = points[:, 0] - arc, arc / bend
    return np.column_stack([
        bend * np.sin(angle) + along * np.cos(angle) - points[:, 2] * np.sin(angle), points[:, 1],
        bend * (1 - np.cos(angle)) + along * np.sin(angle) + points[:, 2] * np.cos(angle)])


def voronoi_areas(points, triangles):
    """Of the vertices of acute triangles only; NaN at others."""
    areas = np.zeros(len(points))
    for corner in range(3):
        a, b, c = (points[np.roll(triangles, -corner, axis=1)[:, n]] for n in range(3))
        twice = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        at_a, at_b, at_c = (((q - p) * (r - p)).sum(axis=1) for p, q, r in ((a, b, c), (b, c, a), (c, a, b)))
        share = (((b - a)**2).sum(axis=1) * at_c + ((c - a)**2).sum(axis=1) * at_b) / twice / 8
        acute = (at_a > 0) & (at_b > 0) & (at_c > 0)
        np.add.at(areas, np.array(triangles)[:, corner], np.where(acute, share, np.nan))
    return areas


def energy_per_area(overlap):
    """U / A_t of equation 7, from its force by the trapezoidal rule."""
    a0 = np.cbrt(6 * np.pi * SIGMA * R**2 / K)
    lost = -6**(-1 / 3) / 2 * a0**2 / R
    h = lost + np.linspace(0, 1, 200001)**2 * (0.3 - lost)
    f = force_of_equation_7(h)
    work = np.concatenate([[0], np.cumsum(np.diff(h) * (f[1:] + f[:-1]) / 2)])
    return np.interp(overlap, h, work) / -work.min() * SIGMA


class OwnCell(unittest.TestCase):
    """A plate that is too thin touches itself through its inside, one that is folded outside."""

    GAP, THICK = 0.15, 0.8
    NEAR = 1.6    # from the middle of a flat part
    NOISE = "\ndisplace_atoms all random 0.01 0.01 0.01 5"    # no vertex is as near to two places

    def scene(self, name, self_contact="self yes", coeff=ADHESIVE, noise="", frequency=8, **changes):
        """The scene, its files, rest shape and triangles, which vertices lie in the flat parts that face each other."""
        thickness = self.GAP if name == "inside" else self.THICK
        rest, triangles = plate(frequency, thickness)
        x, flat = rest, np.hypot(rest[:, 0], rest[:, 1]) < self.NEAR
        if name == "outside":
            x = folded(rest, self.GAP, thickness)
            flat = (np.hypot(abs(rest[:, 0]) - 1.6, rest[:, 1]) < 0.6) & (rest[:, 2] > 0)
        text = io.StringIO()
        write_molecule(text, ["plate"], rest, triangles)
        files = {"plate.mol": text.getvalue()}
        lines = ["rbc/create rbc single 6 6 6"]
        for n, axis in enumerate("xyz"):
            values = "\n".join(f"{i + 1} {6 + v!r}" for i, v in enumerate(x[:, n].tolist()))
            files[axis] = f"{len(x)}\n{values}\n"
            lines += [f"variable {axis} atomfile {axis}", f"set group all {axis} v_{axis}"]
        changes.setdefault("dump", dump_line(1, columns="id xu yu zu fx fy fz c_ea"))
        changes["neighbor"] = "neighbor 0.5 bin\ncomm_modify cutoff 3.5"    # the fold stretches edges
        made = contact(coeff, f"pair_style rbc/jkr 0.4 {self_contact}", molecule="molecule rbc plate.mol",
                       cells="\n".join(lines) + noise, **changes)
        return made, files, rest, triangles, flat

    def test_energy_of_faces(self):
        a0 = np.cbrt(6 * np.pi * SIGMA * R**2 / K)
        work = energy_per_area(np.array([R - self.GAP, a0**2 / R / 3]))
        for name, expected in (("inside", work[0] - work[1]), ("outside", work[0])):
            with self.subTest(name):
                made, files, rest, triangles, flat = self.scene(name)
                dump = run(made, files=files).dump()
                areas = voronoi_areas(rest, triangles)[flat]
                known = np.isfinite(areas)
                ratio = dump("c_ea")[flat][known] / (areas[known] / 2 * expected)
                print(f"\n{name}: energies of {known.sum()} vertices over equation 7: {ratio.min():.6f} to {ratio.max():.6f}")
                self.assertGreater(known.sum(), 12)
                self.assertLess(abs(ratio - 1).max(), 2e-3)    # faces are not quite flat
                # what is pushed inward from the inside of a plate goes outward, and the arms of the U away from each other
                f, x = dump.forces(), dump.positions() - 6
                outward = np.sign(x[:, 2]) * f[:, 2] if name == "inside" else np.sign(x[:, 0]) * f[:, 0]
                self.assertGreater(outward[flat].min(), 0)
                self.assertLess(abs(f.sum(axis=0)).max(), 1e-15 * abs(f).sum())
                self.assertLess(abs(np.cross(x, f).sum(axis=0)).max(), 1e-14 * abs(f).sum())

    def test_adhesion_acts_outside_only(self):
        # further apart than at rest: outside it pulls, through the inside it does nothing
        self.GAP = 0.25
        for name, pulls in (("inside", False), ("outside", True)):
            with self.subTest(name):
                made, files, _, _, flat = self.scene(name)
                dump = run(made, files=files).dump()
                if pulls:
                    outward = np.sign(dump.positions()[:, 0] - 6) * dump.forces()[:, 0]
                    self.assertLess(outward[flat].max(), 0)
                else:
                    self.assertLess(abs(dump.forces()).max(), 1e-20)    # of the membrane

    def test_not_unless_asked(self):
        for name in ("inside", "outside"):
            for words in ("self no", ""):
                made, files, *_ = self.scene(name, words)
                self.assertLess(abs(run(made, files=files).dump().forces()).max(), 1e-20)    # of the membrane

    def test_other_cells_are_seen_as_before(self):
        f = run(contact()).dump().forces()
        both = run(contact(pair="pair_style rbc/jkr 0.5 self yes")).dump().forces()
        np.testing.assert_allclose(both, f, atol=1e-14 * abs(f).max(), rtol=0)

    def test_minus_the_gradient_of_the_energy(self):
        for name in ("inside", "outside"):
            for coeff in (ADHESIVE, REPULSIVE):
                with self.subTest(name, coeff=coeff):
                    made, files, *_ = self.scene(
                        name, coeff=coeff, noise=self.NOISE, frequency=4,
                        compute=COMPUTES + "\nfix numerical all numdiff 1 1e-5",
                        dump=dump_line(1, columns="id fx fy fz " + " ".join(NUMERICAL)))
                    dump = run(made, files=files).dump()
                    f = dump.forces()
                    self.assertGreater((abs(f).max(axis=1) > 0).sum(), 20)
                    self.assertLess(abs(f - dump(*NUMERICAL)).max() / abs(f).max(), 1e-6)

    def test_pressure_is_the_derivative_by_strain(self):
        for name in ("inside", "outside"):
            with self.subTest(name):
                made, files, *_ = self.scene(
                    name, noise=self.NOISE, frequency=4, compute=COMPUTES + "\nfix numerical all numdiff/virial 1 1e-6",
                    thermo=THERMO + "".join(f" f_numerical[{n}]" for n in range(1, 7)))
                thermo = run(made, files=files).thermo
                virial = np.array([thermo[f"c_press[{n}]"][0] for n in (1, 2, 3, 6, 5, 4)])
                numerical = np.array([thermo[f"f_numerical[{n}]"][0] for n in range(1, 7)])
                np.testing.assert_allclose(virial, numerical, atol=1e-6 * abs(virial).max(), rtol=0)
                np.testing.assert_allclose(thermo["c_sums[1]"], thermo["c_pe"], rtol=1e-12)
                for n in range(1, 7):
                    np.testing.assert_allclose(-thermo[f"c_sums[{n + 1}]"] / 12**3, thermo[f"c_press[{n}]"], rtol=1e-11)

    def test_switched_off_and_overlaid(self):
        made, files, *_ = self.scene("outside", noise=self.NOISE)
        forces = run(made, files=files).dump().forces()
        off = made + f"pair_style rbc/jkr 0.4 self no\n{ADHESIVE}\nrun 1\n"
        self.assertLess(abs(run(off, files=files).dump().forces(-1)).max(), 1e-20)    # of the membrane
        both = made.replace("pair_style rbc/jkr 0.4 self yes",
                            "pair_style hybrid/overlay rbc/jkr 0.4 self yes rbc/jkr 0.3")
        both = both.replace(ADHESIVE, f"pair_coeff * * rbc/jkr 1 adhesive {K} {SIGMA} {R}\n"
                                      f"pair_coeff * * rbc/jkr 2 repulsive {K} {R}")
        both = both.replace("compute contact all pair rbc/jkr", "compute contact all pair rbc/jkr 1")
        np.testing.assert_allclose(run(both, files=files).dump().forces(), forces, atol=1e-14 * abs(forces).max(), rtol=0)

    def test_its_periodic_image_is_the_cell_itself(self):
        # a row of cells, of which one or two are in the box
        one = "rbc/create rbc single 3.975 6 6 rotate 10 0 0 1"
        two = one + "\nrbc/create rbc single 11.925 6 6 rotate 10 0 0 1"
        apart = [run(contact(pair=f"pair_style rbc/jkr 0.5 self {own}", box=f"region box block 0 {length} 0 12 0 12",
                             cells=cells, neighbor="neighbor 0.3 bin")).dump().forces()
                 for own, length, cells in (("yes", 7.95, one), ("no", 15.9, two))]
        self.assertGreater(abs(apart[0]).max(), 1e-4)
        np.testing.assert_allclose(apart[0], apart[1][:len(apart[0])], atol=1e-12 * abs(apart[0]).max(), rtol=0)

    def test_atoms_with_the_molecule_id_of_a_cell(self):
        made, files, *_ = self.scene("outside", noise=self.NOISE)
        forces = run(made, files=files).dump().forces()
        others = made.replace("create_box 1 box angle/types 1", "create_box 2 box angle/types 1")
        others = others.replace("fix mem all", "create_atoms 2 single 6.1 6 7.6\ncreate_atoms 2 single 6.2 6 8.6\n"
                                "set type 2 mol 1\nmass * 1\ngroup cell type 1\nfix mem cell")
        others = others.replace(ADHESIVE, ADHESIVE.replace("* *", "1 1") + "\npair_coeff * 2 none")
        np.testing.assert_allclose(run(others, files=files).dump().forces()[:len(forces)], forces,
                                   atol=1e-14 * abs(forces).max(), rtol=0)

    def test_moves_on_any_number_of_ranks(self):
        moving = dict(fluid="fix flow all rbc/fluid dx 0.5 viscosity 1.5 density 1.025 inertia none",
                      ib="fix ib all rbc/ib flow kernel peskin4 integrator rkc auto", timestep="timestep 300",
                      run="run 12", dump=dump_line(12, columns="id xu yu zu fx fy fz"))
        for name in ("inside", "outside"):
            reference = None
            for ranks in (1, 2, 4):
                with self.subTest(name, ranks=ranks):
                    made, files, rest, *_ = self.scene(name, noise=self.NOISE, **moving)
                    x = run(made, ranks, files=files).dump().positions()
                    reference = x if reference is None else reference
                    np.testing.assert_allclose(x, reference, atol=1e-9, rtol=0)
            made, files, *_ = self.scene(name, "self no", noise=self.NOISE, **moving)
            self.assertGreater(abs(run(made, files=files).dump().positions() - reference).max(), 0.1)

    def test_ranks(self):
        for name in ("inside", "outside"):
            reference = None
            for ranks, newton, last in ((1, "newton on", ""), (2, "newton off", ""), (4, "newton on", ""),
                                        (2, "newton on", "displace_atoms all move 6 0 6")):
                with self.subTest(name, ranks=ranks, newton=newton, last=last):
                    made, files, *_ = self.scene(name, newton=newton, last=last, noise=self.NOISE)
                    f = run(made, ranks, files=files).dump().forces()
                    reference = f if reference is None else reference
                    np.testing.assert_allclose(f, reference, atol=1e-12 * abs(f).max(), rtol=0)

    def test_restart(self):
        made, files, *_ = self.scene("outside", run="run 0\nwrite_restart r")
        whole = run(made, files=files)
        later = dict.fromkeys(("units", "boundary", "box", "create_box", "before"))
        made, files, *_ = self.scene("outside", **later, style=f"read_restart {whole.path('r')}")
        made = "\n".join(line for line in made.splitlines() if not line.startswith(("rbc/create", "variable", "set ")))
        np.testing.assert_array_equal(run(made, files=files).dump().forces(), whole.dump().forces())


if __name__ == "__main__":
    unittest.main()
