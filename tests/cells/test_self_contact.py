"""Cells that touch themselves (pair_style rbc/jkr with self yes): two faces that meet outside,
through a fold, and inside, through the cell."""

import io
import sys
import unittest

import numpy as np

from contact_case import (ADHESIVE, COMPUTES, K, NUMERICAL, R, RADIUS, REPULSIVE, SIGMA, THERMO,
                          contact, force_of_equation_7)
from lammps_case import POTENTIALS, dump_line, run

sys.path.insert(0, str(POTENTIALS))
import shapes    # noqa: E402
from molecule_file import write_molecule    # noqa: E402


def plate(frequency, thickness):
    """Vertices and triangles of a flat disc of that thickness."""
    points, triangles = shapes.geodesic(frequency)
    half = thickness / 2
    return RADIUS * shapes.revolved(
        points, lambda x: half / RADIUS * np.sqrt(np.maximum(0, 1 - x**12))), triangles


def folded(points, gap, thickness):
    """Bent about the y axis to a U whose arms are `gap` apart, faces that were the top of the plate
    inside."""
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
        at_a, at_b, at_c = (((q - p) * (r - p)).sum(axis=1)
                            for p, q, r in ((a, b, c), (b, c, a), (c, a, b)))
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


class SelfContact(unittest.TestCase):
    """A plate that is too thin touches itself through its inside, one that is folded outside."""

    GAP, THICK = 0.15, 0.8
    NEAR = 1.6    # from the middle of a flat part
    NOISE = "\ndisplace_atoms all random 0.01 0.01 0.01 5"    # no vertex is as near to two places

    def scene(self, name, self_contact="self yes", coeff=ADHESIVE, noise="", frequency=8,
              **changes):
        """The scene, its files, rest shape and triangles, which vertices lie in the flat parts that
        face each other."""
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
        # the fold stretches edges
        changes["neighbor"] = "neighbor 0.5 bin\ncomm_modify cutoff 3.5"
        made = contact(coeff, f"pair_style rbc/jkr 0.4 {self_contact}",
                       molecule="molecule rbc plate.mol", cells="\n".join(lines) + noise, **changes)
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
                print(f"\n{name}: energies of {known.sum()} vertices over equation 7: "
                      f"{ratio.min():.6f} to {ratio.max():.6f}")
                self.assertGreater(known.sum(), 12)
                self.assertLess(abs(ratio - 1).max(), 2e-3)    # faces are not quite flat
                # what is pushed inward from the inside of a plate goes outward, and the arms of the
                # U away from each other
                f, x = dump.forces(), dump.positions() - 6
                outward = (np.sign(x[:, 2]) * f[:, 2]
                           if name == "inside" else np.sign(x[:, 0]) * f[:, 0])
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
                # of the membrane
                self.assertLess(abs(run(made, files=files).dump().forces()).max(), 1e-20)

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
                    name, noise=self.NOISE, frequency=4,
                    compute=COMPUTES + "\nfix numerical all numdiff/virial 1 1e-6",
                    thermo=THERMO + "".join(f" f_numerical[{n}]" for n in range(1, 7)))
                thermo = run(made, files=files).thermo
                virial = np.array([thermo[f"c_press[{n}]"][0] for n in (1, 2, 3, 6, 5, 4)])
                numerical = np.array([thermo[f"f_numerical[{n}]"][0] for n in range(1, 7)])
                np.testing.assert_allclose(virial, numerical, atol=1e-6 * abs(virial).max(), rtol=0)
                np.testing.assert_allclose(thermo["c_sums[1]"], thermo["c_pe"], rtol=1e-12)
                for n in range(1, 7):
                    np.testing.assert_allclose(-thermo[f"c_sums[{n + 1}]"] / 12**3,
                                               thermo[f"c_press[{n}]"], rtol=1e-11)

    def test_switched_off_and_overlaid(self):
        made, files, *_ = self.scene("outside", noise=self.NOISE)
        forces = run(made, files=files).dump().forces()
        off = made + f"pair_style rbc/jkr 0.4 self no\n{ADHESIVE}\nrun 1\n"
        # of the membrane
        self.assertLess(abs(run(off, files=files).dump().forces(-1)).max(), 1e-20)
        both = made.replace("pair_style rbc/jkr 0.4 self yes",
                            "pair_style hybrid/overlay rbc/jkr 0.4 self yes rbc/jkr 0.3")
        both = both.replace(ADHESIVE, f"pair_coeff * * rbc/jkr 1 adhesive {K} {SIGMA} {R}\n"
                                      f"pair_coeff * * rbc/jkr 2 repulsive {K} {R}")
        both = both.replace("compute contact all pair rbc/jkr",
                            "compute contact all pair rbc/jkr 1")
        np.testing.assert_allclose(run(both, files=files).dump().forces(), forces,
                                   atol=1e-14 * abs(forces).max(), rtol=0)

    def test_its_periodic_image_is_the_cell_itself(self):
        # a row of cells, of which one or two are in the box
        one = "rbc/create rbc single 3.975 6 6 rotate 10 0 0 1"
        two = one + "\nrbc/create rbc single 11.925 6 6 rotate 10 0 0 1"
        apart = [run(contact(pair=f"pair_style rbc/jkr 0.5 self {own}",
                             box=f"region box block 0 {length} 0 12 0 12",
                             cells=cells, neighbor="neighbor 0.3 bin")).dump().forces()
                 for own, length, cells in (("yes", 7.95, one), ("no", 15.9, two))]
        self.assertGreater(abs(apart[0]).max(), 1e-4)
        np.testing.assert_allclose(apart[0], apart[1][:len(apart[0])],
                                   atol=1e-12 * abs(apart[0]).max(), rtol=0)

    def test_atoms_with_the_molecule_id_of_a_cell(self):
        made, files, *_ = self.scene("outside", noise=self.NOISE)
        forces = run(made, files=files).dump().forces()
        others = made.replace("create_box 1 box angle/types 1", "create_box 2 box angle/types 1")
        others = others.replace("fix mem all",
                                "create_atoms 2 single 6.1 6 7.6\ncreate_atoms 2 single 6.2 6 8.6\n"
                                "set type 2 mol 1\nmass * 1\ngroup cell type 1\nfix mem cell")
        others = others.replace(ADHESIVE, ADHESIVE.replace("* *", "1 1") + "\npair_coeff * 2 none")
        np.testing.assert_allclose(run(others, files=files).dump().forces()[:len(forces)], forces,
                                   atol=1e-14 * abs(forces).max(), rtol=0)

    def test_moves_on_any_number_of_ranks(self):
        moving = dict(
            fluid="fix flow all rbc/fluid dx 0.5 viscosity 1.5 density 1.025 inertia none",
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
            self.assertGreater(abs(run(made, files=files).dump().positions() - reference).max(),
                               0.1)

    def test_ranks(self):
        for name in ("inside", "outside"):
            reference = None
            for ranks, newton, last in ((1, "newton on", ""), (2, "newton off", ""),
                                        (4, "newton on", ""),
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
        made = "\n".join(line for line in made.splitlines()
                         if not line.startswith(("rbc/create", "variable", "set ")))
        np.testing.assert_array_equal(run(made, files=files).dump().forces(), whole.dump().forces())


if __name__ == "__main__":
    unittest.main()
