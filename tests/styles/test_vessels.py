"""Vessels: region rbc/mesh, rbc/surface, cells packed and held inside a region, flow rates inside
one."""

import subprocess
import sys
import unittest

import numpy as np

from lammps_case import Failed, POTENTIALS, ROOT, dump_line, read_template, run, scene
from rbc.surface_distances import least_gap

TUBE = "region tube cylinder x 11 12 9 INF INF"
MESH = "region tube rbc/mesh ../tube.stl shift 0 11 12"
# a throat of stock regions: cones between cylinders
THROAT = "\n".join(["region inlet cylinder x 11 12 8 INF 6", "region narrows cone x 11 12 8 4 6 10",
                    "region middle cylinder x 11 12 4 10 14",
                    "region widens cone x 11 12 4 8 14 18",
                    "region outlet cylinder x 11 12 8 18 INF",
                    "region tube union 5 inlet narrows middle widens outlet"])
LENGTH = np.array([24.0, 22.0, 24.0])
BOX = "region box block 0 24 0 22 0 24"
POINTS, TRIANGLES = read_template(POTENTIALS / "rbc_162.mol")


def make_vessel(*words):
    done = subprocess.run([sys.executable, ROOT / "scripts" / "make_vessel.py", *map(str, words)],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode:
        raise AssertionError(done.stdout)


def vessel(ranks=1, **changes):
    lines = dict(boundary="boundary p p p", box=BOX,
                 create_box="create_box 2 box angle/types 1\nmass * 1", cells=None,
                 membrane=None, fluid=None, ib=None, thermo=None,
                 dump=dump_line(1, columns="id mol type x y z xu yu zu"))
    lines.update(changes)
    return run(scene(**lines), ranks)


def radius(x):
    return np.hypot(x[:, 1] - 11, x[:, 2] - 12)


def throat_radius(x):
    return np.interp(x, [0, 6, 10, 14, 18, 24], [8, 8, 4, 4, 8, 8])


def nearest(points, others):
    """Distance of each point to the nearest other one, through periodic sides."""
    least = np.empty(len(points))
    for n, point in enumerate(points):
        arm = others - point
        arm -= LENGTH * np.round(arm / LENGTH)
        square = (arm**2).sum(axis=1)
        least[n] = np.sqrt(square[square > 0].min())
    return least


def write_capped_tube(path, ends):
    """A tube of radius 9 from x = 0 to 24 about y = z = 0, with flat lids at these ends, as CAD
    programs export it."""
    sides, rings = 32, np.linspace(0, 24, 13)

    def at(x, j):
        return x, 9 * np.cos(2 * np.pi * j / sides), 9 * np.sin(2 * np.pi * j / sides)
    triangles = []
    for j in range(sides):
        for a, b in zip(rings, rings[1:]):
            triangles += [(at(a, j), at(a, j + 1), at(b, j)),
                          (at(a, j + 1), at(b, j + 1), at(b, j))]
        triangles += [
            ((x, 0, 0), *((at(x, j + 1), at(x, j)) if x == 0 else (at(x, j), at(x, j + 1))))
            for x in ends]
    with open(path, "w", encoding="ascii") as file:
        for triangle in triangles:
            corners = "".join(f"vertex {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in triangle)
            file.write(("" if file.tell() else "SOLID tube\n") + "facet normal 0 0 0\nouter loop\n"
                                                                 f"{corners}"
                       "endloop\nendfacet\n")


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        make_vessel("tube", "--length", 24, "--diameter", 18, "--edge", 1, "tube.stl")

    def error(self, message, **changes):
        with self.assertRaises(Failed) as caught:
            vessel(**changes)
        self.assertIn(message, caught.exception.result.error)


class Mesh(Case):
    def test_holds_what_the_tube_holds(self):
        around = round(2 * np.pi * 9 / 1)
        for ranks in (1, 2):
            atoms = vessel(ranks, before=MESH + "\ncreate_atoms 1 random 4000 1 tube",
                           last=None).dump()("x", "y", "z")
            self.assertEqual(len(atoms), 4000)
            self.assertLess(radius(atoms).max(), 9)
        outside = "region out rbc/mesh ../tube.stl shift 0 11 12 side out"
        atoms = vessel(before=outside + "\ncreate_atoms 1 random 4000 1 out").dump()("x", "y", "z")
        self.assertGreater(radius(atoms).min(), 9 * np.cos(np.pi / around))

    def test_scale_and_units(self):
        make_vessel("tube", "--length", 2.4, "--diameter", 1.8, "--edge", 0.1, "small.stl")
        atoms = vessel(before="region tube rbc/mesh ../small.stl scale 10 shift 0 11 12 units box\n"
                              "create_atoms 1 random 1000 1 tube").dump()("x", "y", "z")
        self.assertLess(radius(atoms).max(), 9)
        self.assertGreater(radius(atoms).max(), 8.7)

    def test_wall_forces_are_those_of_the_cylinder(self):
        """Up to the depth of a facet, through the periodic side too."""
        sag = 9 * (1 - np.cos(np.pi / round(2 * np.pi * 9)))
        forces = []
        for region in (TUBE, MESH):
            lines = (region + "\nregion thick cylinder x 11 12 8.9 INF INF\n"
                              "create_atoms 1 random 2000 1 thick\n"
                     "fix wall all wall/region tube harmonic 0.5 0 1.0")
            dump = vessel(before=lines, dump=dump_line(1, columns="id x y z fx fy fz")).dump()
            forces.append(dump("fx", "fy", "fz"))
        self.assertGreater(abs(forces[0]).max(), 0.8)
        self.assertLess(abs(np.linalg.norm(forces[0], axis=1) - np.linalg.norm(forces[1], axis=1))
                        .max(), 1.05 * sag)

    def test_lids_on_periodic_faces_are_an_error(self):
        write_capped_tube("capped.stl", (0, 24))
        capped = "region tube rbc/mesh ../capped.stl"
        self.error("capped.stl: 32 triangles on the periodic face x = 0 and 32 on the one "
                   "opposite, x = 24, are lids", before=capped + " shift 0 11 12")
        wider = "region box block 0 25 0 22 0 24"
        fill = "\ncreate_atoms 1 random 2000 1 tube"
        for shift, box, boundary, warned in ((0.5, wider, "p p p", False), (0, BOX, "f p p", False),
                                             (0, wider, "p p p", True), (1, wider, "p p p", True)):
            run = vessel(before=f"{capped} shift {shift} 11 12{fill}", box=box,
                         boundary="boundary " + boundary, last=None)
            self.assertEqual("32 triangles close the vessel on the periodic face x" in run.printed,
                             warned)
            along = run.dump()("x")
            self.assertGreaterEqual(along.min(), shift)
            self.assertLessEqual(along.max(), 24 + shift)

    def test_errors(self):
        bad = "solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid\n"
        with open("bad.stl", "w") as file:
            file.write(bad)
        self.error("nothere.stl: cannot be opened", before="region tube rbc/mesh nothere.stl")
        self.error("Region rbc/mesh file /tmp: is a folder, not a file",
                   before="region tube rbc/mesh /tmp")
        self.error("is not closed: the edge from (",
                   before="region tube rbc/mesh ../bad.stl shift 3 3 3")
        self.error("lies on no periodic face", before=MESH, boundary="boundary f p p")
        self.error("lies on no periodic face", before=MESH, box="region box block 0 25 0 22 0 24")
        self.error("Region rbc/mesh takes no open faces", before=MESH + " open 1")
        self.error("Region rbc/mesh scale value -1 must be > 0",
                   before="region tube rbc/mesh ../tube.stl scale -1")
        self.error("Illegal region rbc/mesh shift command",
                   before="region tube rbc/mesh ../tube.stl shift 1 2")
        beyond = vessel(before="region tube rbc/mesh ../tube.stl").printed
        for way, radius_there in (("y", "9"), ("z", "8.99658")):
            self.assertIn(
                f"extends from -{radius_there} to {radius_there} in {way}, beyond the box", beyond)
        self.assertNotIn("beyond the box", vessel(before=MESH).printed)
        self.error("has changed since the region was defined",
                   before=MESH + "\ncreate_atoms 1 random 10 1 tube\nchange_box all x final 0 30\n"
                                 "fix wall all wall/region tube harmonic 0.5 0 1.0")


class Surface(Case):
    def test_atoms_are_on_the_surface(self):
        for name, region, wall in (("cylinder", TUBE, lambda x: 9 + 0 * x),
                                   ("throat", THROAT, throat_radius)):
            dumps = [vessel(ranks, before=f"{region}\nrbc/surface tube type 2 spacing 1.0").dump()
                     for ranks in (1, 2, 4)]
            x = dumps[0]("x", "y", "z")
            with self.subTest(name):
                np.testing.assert_allclose(radius(x), wall(x[:, 0]), atol=2e-8)
                np.testing.assert_array_equal(dumps[0]("mol"), 0)
                np.testing.assert_array_equal(dumps[0]("type"), 2)
                np.testing.assert_array_equal(dumps[0]("id"), np.arange(1, len(x) + 1))
                for other in dumps[1:]:
                    np.testing.assert_array_equal(other("x", "y", "z"), x)
                self.assertGreater(nearest(x, x).min(), 0.45)
                self.assertGreater(nearest(x, x).mean(), 0.9)

                # no holes, at the ends neither
                random = np.random.default_rng(1)
                along, angle = random.uniform(0, 24, 4000), random.uniform(0, 2 * np.pi, 4000)
                r = wall(along)
                places = np.stack([along, 11 + r * np.cos(angle), 12 + r * np.sin(angle)], axis=1)
                self.assertLess(nearest(places, x).max(), 0.95)

    def test_numbers_do_not_depend_on_how_the_surface_is_given(self):
        counts = [len(vessel(before=f"{region}\nrbc/surface tube type 2 spacing 1.0").dump()("id"))
                  for region in (TUBE, MESH)]
        lattice = 2 * np.pi * 9 * 24 / (np.sqrt(3) / 2)
        np.testing.assert_allclose(counts, lattice, rtol=0.02)

    def test_offset(self):
        for region, tolerance in ((TUBE, 2e-8), (MESH, 9 * (1 - np.cos(np.pi / 57)))):
            for offset in (0.4, -0.4):
                x = (vessel(before=f"{region}\nrbc/surface tube type 2 spacing 1.0 offset {offset}")
                     .dump()("x", "y", "z"))
                np.testing.assert_allclose(radius(x), 9 + offset, atol=tolerance)

    def test_numbering_goes_on_and_mass_is_set(self):
        dump = vessel(create_box="create_box 2 box angle/types 1\nmass 1 1",
                      cells="rbc/create rbc single 12 11 12",
                      before=f"{TUBE}\nrbc/surface tube type 2 spacing 1.5 mass 3",
                      dump=dump_line(1, columns="id mol type mass")).dump()
        np.testing.assert_array_equal(dump("id"), np.arange(1, len(dump("id")) + 1))
        np.testing.assert_array_equal(dump("type"), np.where(dump("id") <= 162, 1, 2))
        np.testing.assert_array_equal(dump("mass"), np.where(dump("id") <= 162, 1, 3))

    def test_errors(self):
        for words, message in (
                ("nope type 2 spacing 1", "Region ID nope for rbc/surface does not exist"),
                ("tube type 3 spacing 1", "Rbc/surface type value 3 must be 1 or 2"),
                ("tube type 2", "Rbc/surface needs spacing"),
                ("tube spacing 1", "Rbc/surface needs type"),
                ("tube type 2 spacing 0", "Rbc/surface spacing value 0 must be > 0"),
                ("tube type 2 spacing 1e-3", "Rbc/surface spacing 0.001 asks for a look at"),
                ("tube type 2 spacing 1 mass -1", "Rbc/surface mass value -1 must be > 0"),
                ("tube type 2 spacing", "Illegal rbc/surface spacing command"),
                ("tube type 2 spacing 1 colour red",
                 "Unknown rbc/surface keyword colour; allowed: type"),
                ("box type 2 spacing 1",
                 "Rbc/surface region box has no surface in the simulation box")):
            self.error(message, before=f"{TUBE}\nrbc/surface {words}")


class Cells(Case):
    def test_keep_off_the_wall_in_a_periodic_tube(self):
        overlap = 0.4
        for region in (TUBE, MESH, THROAT):
            with self.subTest(region):
                dumps = [vessel(ranks, cells=f"{region}\nrbc/create rbc hematocrit 0.25 seed 5 "
                                             f"overlap {overlap} region tube")
                         .dump() for ranks in (1, 2)]
                x = dumps[0].positions()
                np.testing.assert_array_equal(dumps[1].positions(), x)
                along = np.linspace(0, 24, 2001)
                wall = throat_radius if region == THROAT else lambda x: 9 + 0 * x
                volume = (np.trapezoid(np.pi * wall(along)**2, along)
                          if hasattr(np, "trapezoid") else
                          np.trapz(np.pi * wall(along)**2, along))
                cell = np.einsum("ij,ij->", POINTS[TRIANGLES[:, 0]],
                                 np.cross(POINTS[TRIANGLES[:, 1]], POINTS[TRIANGLES[:, 2]])) / 6
                self.assertAlmostEqual(len(x) / 162, 0.25 * volume / cell,
                                       delta=0.6 + 0.005 * len(x) / 162)
                profile = np.stack(
                    [np.linspace(-2, 26, 7001), wall(np.linspace(-2, 26, 7001) % 24)], axis=1)
                near = x[wall(x[:, 0] % 24) - radius(x) < 1]
                off = min(np.hypot(*(profile - (along % 24, r)).T).min()
                          for along, r in zip(near[:, 0], radius(near)))
                self.assertTrue((radius(x) < wall(x[:, 0] % 24)).all())
                self.assertGreater(off, overlap / 2 - 1e-9)
                cells = [(cell, TRIANGLES) for cell in x.reshape(-1, 162, 3)]
                self.assertGreaterEqual(least_gap(cells, LENGTH, (True,) * 3, 2 * overlap), overlap)

    def test_pushed_to_the_wall_stop_there(self):
        push = 3e-4
        for region in (TUBE, MESH):
            with self.subTest(region):
                lines = dict(cells=f"{region}\nrbc/create rbc single 12 15 12 rotate 60 1 0 0",
                             neighbor="neighbor 1.0 bin",
                             membrane="fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 "
                                      "0.01 bending 2.0e-4 area 1.0 0.05\n"
                                      "fix wall all wall/region tube harmonic 0.05 0 0.3\n"
                                      f"fix push all addforce 0 {push} 0",
                             fluid="fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025",
                             ib="fix ib all rbc/ib flow integrator rkc auto",
                             compute="variable r atom sqrt((y-11)^2+(z-12)^2)\n"
                                     "compute r all reduce max v_r",
                             thermo="thermo_style custom step c_r f_wall[2]", dump=None,
                             run="run 250")
                thermo = vessel(2, **lines).thermo
                self.assertLess(thermo["c_r"].max(), 9)
                self.assertGreater(thermo["c_r"].max(), 8.7)
                self.assertGreater(thermo["f_wall[2]"][-1], 0.5 * 162 * push)
                self.assertLess(thermo["f_wall[2]"][-1], 1.02 * 162 * push)


SLIT = dict(boundary="boundary p p f", before="region tube block INF INF 5 15 INF INF",
            box="region box block 0 18 0 20 0 12",
            thermo="thermo_style custom step f_flow[*]", every="thermo 1", dump=None, run="run 4")


def run_slit(words, ranks=1, walls="wall zlo 0 0 0 wall zhi 0 0 0", **changes):
    fluid = f"fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 {walls} {words}"
    return vessel(ranks, **{**SLIT, "fluid": fluid, **changes})


def slit(*words, **changes):
    return run_slit(*words, **changes).thermo


class Drive(Case):
    def test_mean_velocity_is_held(self):
        """Plane Poiseuille flow: the gradient of the discrete equations is 12 eta V / H^2 / (1 + 2
        dz^2 / H^2)."""
        expected = 12 * 1.5 * 0.01 / 12**2 / (1 + 2 / 12**2)
        for words in ("mean x 0.01", "mean x 0.01 inside tube", "mean x v_V inside tube"):
            thermo = slit(words, 2, every="thermo 1\nvariable V equal 0.01")
            np.testing.assert_allclose(thermo["f_flow[13]"], 0.01, rtol=1e-12)
            np.testing.assert_allclose(thermo["f_flow[19]"], expected, rtol=1e-12)
            volume = 18 * 12 * (10 if "inside" in words else 20)
            np.testing.assert_allclose(thermo["f_flow[22]"], volume, rtol=1e-12)
            np.testing.assert_allclose(thermo["f_flow[16]"], 0.01 * volume / 18, rtol=1e-12)

    def test_follows_a_variable(self):
        thermo = slit("mean y v_V inside tube",
                      every="thermo 1\nvariable V equal 0.01*cos(0.3*step)", run="run 10")
        np.testing.assert_allclose(thermo["f_flow[14]"], 0.01 * np.cos(0.3 * thermo["Step"]),
                                   rtol=1e-11)

    def test_is_held_with_cells_in_the_flow(self):
        lines = dict(
            cells="rbc/create rbc single 9 10 6 rotate 40 1 0 0", neighbor="neighbor 1.0 bin",
            membrane="fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                     "area 1.0 0.05",
            ib="fix ib all rbc/ib flow integrator rkc auto", timestep="timestep 100", run="run 60")
        for inside in ("", "inside tube"):
            thermo = slit(f"mean x 0.002 {inside}", **lines)
            np.testing.assert_allclose(thermo["f_flow[13]"][0], 0.002, rtol=1e-10)
            np.testing.assert_allclose(thermo["f_flow[13]"], 0.002, rtol=3e-3)
            np.testing.assert_allclose(thermo["f_flow[13]"][-20:], 0.002, rtol=1e-4)
            with_cell, without = (thermo["f_flow[19]"][-1],
                                  12 * 1.5 * 0.002 / 12**2 / (1 + 2 / 12**2))
            self.assertGreater(with_cell, 1.005 * without)

    def test_of_the_whole_periodic_box(self):
        """Held by the mean velocity of the box; a force on a bead is what the gradient has to
        balance."""
        lines = dict(boundary="boundary p p p",
                     cells="create_atoms 1 single 9 10 6\nfix pull all addforce 0.02 0 0",
                     ib="fix ib all rbc/ib flow integrator midpoint", timestep="timestep 10")
        result = run_slit("mean x 0.01 inside tube", walls="", **lines)
        self.assertIn("WARNING: Fix rbc/fluid flow inside tube: there is no fix rbc/wall",
                      result.printed)
        thermo = result.thermo
        np.testing.assert_allclose(thermo["f_flow[13]"][2:], 0.01, rtol=1e-5)
        self.assertGreater(abs(thermo["f_flow[7]"] / 0.01 - 1).min(), 3e-3)
        np.testing.assert_allclose(thermo["f_flow[19]"], -0.02 / (18 * 20 * 12), rtol=1e-10)

    def test_costs_nothing_unless_asked_for(self):
        with_vector = slit("body 1e-4 0 0", thermo="thermo_style custom step f_flow[12] f_flow[13]")
        np.testing.assert_array_equal(with_vector["f_flow[12]"], 1)

    def test_errors(self):
        for words, message in (("mean z 1", "Fix rbc/fluid mean z needs a triply periodic box"),
                               ("mean x", "Illegal fix rbc/fluid mean command"),
                               ("mean 1 0 0", "needs a triply periodic box"),
                               ("mean x 1 inertia unsteady",
                                "Fix rbc/fluid mean x needs inertia none"),
                               ("inside nope",
                                "Region ID nope for fix rbc/fluid inside does not exist"),
                               ("mean x v_nope", "Variable nope for fix rbc/fluid does not exist")):
            with self.assertRaises(Failed) as caught:
                slit(words)
            self.assertIn(message, caught.exception.result.error)


if __name__ == "__main__":
    unittest.main()
