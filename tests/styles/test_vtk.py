"""fix rbc/vtk: the surfaces as VTK reads them, on 1, 2 and 4 ranks, and what bad input gets."""

import shutil
import unittest
from pathlib import Path
from xml.etree import ElementTree

import lammps_case
import numpy as np
from lammps_case import POTENTIALS
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader

SHAPE = POTENTIALS / "rbc_162.mol"
SPHERE = POTENTIALS / "capsule_362.mol"

BOX = f"""
units       micro
atom_style  molecular
region      box block 0 12 0 12 0 12
create_box  1 box angle/types 1
molecule    rbc {SHAPE}
"""
MEMBRANE = "fix mem all rbc/membrane rbc neo-hookean 5.0 volume no\n"
DUMP = lammps_case.dump_line(2, columns="id mol x y z vx vy vz fx fy fz") + "\n"


def read_molecule(path):
    """Coordinates and triangles (from 0) of a molecule file."""
    text = Path(path).read_text()
    coords, angles = text.split("Coords", 1)[1].split("Types", 1)[0], text.split("Angles", 1)[1]
    points = np.array([line.split()[1:] for line in coords.splitlines() if line.strip()], float)
    rows = [line.split() for line in angles.splitlines()]
    return points, np.array([row[2:] for row in rows if len(row) == 5], int) - 1


def stretched(factors):
    """Molecule file of the cell's shape with each coordinate multiplied by a factor."""
    points, triangles = read_molecule(SHAPE)
    lines = ["# stretched", "", f"{len(points)} atoms", f"{len(triangles)} angles", "", "Coords",
             ""]
    lines += ["{} {!r} {!r} {!r}".format(n, *map(float, p * factors))
              for n, p in enumerate(points, 1)]
    lines += ["", "Types", ""] + [f"{n} 1" for n in range(1, len(points) + 1)] + ["", "Angles", ""]
    lines += ["{} 1 {} {} {}".format(n, *(t + 1)) for n, t in enumerate(triangles, 1)]
    return "\n".join(lines) + "\n"


def volume_of(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def cyclic(triangles):
    """The triangles, each from its first vertex on, in order."""
    return sorted(np.roll(triangle, -triangle.argmin()).tolist() for triangle in triangles)


class Surfaces:
    """What a file holds."""

    def __init__(self, path):
        assert Path(path).exists(), path
        reader = vtkXMLPPolyDataReader() if str(path).endswith(".pvtp") else vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        reader.UpdateInformation()
        steps = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        information = reader.GetOutputInformation(0)
        self.time_steps = list(information.Get(steps)) if information.Has(steps) else []
        reader.Update()
        self.data = reader.GetOutput()
        self.arrays = {}
        for n in range(self.data.GetPointData().GetNumberOfArrays()):
            array = self.data.GetPointData().GetArray(n)
            self.arrays[array.GetName()] = vtk_to_numpy(array)
        self.time = self.data.GetFieldData().GetArray("TimeValue").GetValue(0)
        self.points = np.empty((0, 3))
        self.triangles = np.empty((0, 3), int)
        if self.data.GetNumberOfPoints():
            self.points = vtk_to_numpy(self.data.GetPoints().GetData())
            assert set(np.diff(vtk_to_numpy(self.data.GetPolys().GetOffsetsArray()))) == {3}
            self.triangles = vtk_to_numpy(self.data.GetPolys().GetConnectivityArray()).reshape(-1,
                                                                                               3)

    def open_edges(self):
        edges = vtkFeatureEdges()
        edges.SetInputData(self.data)
        edges.BoundaryEdgesOn()
        edges.NonManifoldEdgesOn()
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()
        edges.Update()
        return edges.GetOutput().GetNumberOfCells()

    def volume(self):
        properties = vtkMassProperties()
        properties.SetInputData(self.data)
        return properties.GetVolume()

    def in_order_of_molecules(self):
        """Every point array, the position and the corners of each triangle by atom rather than by
        place in the file."""
        order = np.argsort(self.arrays["molecule"], kind="stable")
        place = np.argsort(order)
        triangles = place[self.triangles]
        arrays = {name: values[order] for name, values in self.arrays.items()}
        return dict(arrays, points=self.points[order],
                    triangles=triangles[np.argsort(triangles[:, 0], kind="stable")])


def moving(output, run="run 4"):
    """Three stretched cells, two of them across sides of the box, that move and pass to other
    ranks."""
    return BOX + f"""
molecule    stretched stretched.mol
rbc/create  stretched single 0.1 11.9 0
rbc/create  stretched single 6.2 6.1 5.5 rotate 70 1 2 3
rbc/create  stretched single 6.3 0.2 11.5 rotate 20 0 1 0
velocity    all ramp vx -1 1.5 z 0 12 sum no
fix         mem all rbc/membrane rbc neo-hookean 5.0 bending 2.0e-4 volume no
fix         move all nve
neigh_modify every 1 delay 0 check no
timestep    0.1
{DUMP}
{output}
{run}
"""


def run_moving(*arguments, ranks=1):
    return lammps_case.run(moving(*arguments), ranks,
                           files={"stretched.mol": stretched([1.15, 0.9, 1.05])})


class FixVTK(unittest.TestCase):
    def assert_close(self, a, b, tolerance=1e-12):
        self.assertEqual(np.shape(a), np.shape(b))
        np.testing.assert_allclose(a, b, rtol=0, atol=tolerance * max(1, np.abs(b).max(initial=0)))

    def assert_same(self, a, b):
        a, b = a.in_order_of_molecules(), b.in_order_of_molecules()
        self.assertEqual(a.keys(), b.keys())
        for name in a:
            with self.subTest(array=name):
                self.assert_close(a[name], b[name])

    def assert_is_dump(self, surfaces, dump, frame, box=12):
        """Point by point what dump wrote in order of atom ID, but for periods of the box."""
        self.assert_close(surfaces.arrays["molecule"], dump("mol", frame=frame))
        periods = (surfaces.points - dump("x", "y", "z", frame=frame)) / box
        np.testing.assert_allclose(periods, np.round(periods), rtol=0, atol=1e-12)
        self.assert_close(surfaces.arrays["velocity"], dump("vx", "vy", "vz", frame=frame))
        self.assert_close(surfaces.arrays["force"], dump.forces(frame))

    def test_undeformed_cell_is_its_template(self):
        points, triangles = read_molecule(SHAPE)
        middle = points.mean(axis=0)
        for centre in ([6.0, 5.5, 5.0], [0.0, 0.0, 0.0], [11.75, 0.25, 11.5]):
            for ranks in (1, 4):
                with self.subTest(centre=centre, ranks=ranks):
                    where = " ".join(map(str, centre))
                    result = lammps_case.run(BOX + f"rbc/create rbc single {where}\n" + MEMBRANE +
                                             "fix out all rbc/vtk 10 cells.*.vtp\nrun 0\n", ranks)
                    cells = Surfaces(result.path("cells.0.vtp"))
                    self.assert_close(cells.points - cells.points.mean(axis=0), points - middle)
                    self.assert_close(cells.points.mean(axis=0) - middle, centre)
                    self.assertEqual(cyclic(cells.triangles), cyclic(triangles))
                    self.assertEqual(cells.open_edges(), 0)
                    volume = volume_of(points, triangles)
                    self.assertAlmostEqual(cells.volume(), volume, delta=1e-6 * volume)
                    self.assertEqual(set(cells.arrays),
                                     {"velocity", "force", "tension", "molecule"})
                    self.assert_close(cells.arrays["tension"], np.zeros(len(points)))
                    self.assertEqual(set(cells.arrays["molecule"]), {1})

    def test_tension_of_an_inflated_sphere(self):
        stretch, Gs, C, kglobal, klocal = 1.2, 5.0, 10.0, 3.0, 2.0
        J = stretch**2
        neo_hookean = Gs * (1 - stretch**-6)
        mooney_rivlin = 2 * 0.7 * (1 - stretch**-6) + 2 * 0.4 * (J - stretch**-4)
        areas = (kglobal + klocal) * (J - 1)
        skalak = Gs * (J - 1 + C * J * (J**2 - 1))
        for law, tension in (
                (f"neo-hookean {Gs}", neo_hookean), ("mooney-rivlin 70 40 0.01", mooney_rivlin),
                (f"skalak {Gs} {C}", skalak),
                (f"neo-hookean {Gs} area {kglobal} {klocal} bending 0.1", neo_hookean + areas)):
            with self.subTest(law=law):
                result = lammps_case.run(BOX + f"""
molecule    sphere {SPHERE}
molecule    inflated {SPHERE} scale {stretch}
rbc/create  inflated single 0 6 6
fix         mem all rbc/membrane sphere {law} volume no
fix         out all rbc/vtk 10 cells.*.vtp
run         0
""", 2)
                found = Surfaces(result.path("cells.0.vtp")).arrays["tension"]
                self.assert_close(found, np.full(362, tension))

    def test_moving_cells_on_any_number_of_ranks(self):
        alone = {}
        for ranks in (1, 2, 4):
            result = run_moving("fix out all rbc/vtk 2 cells.*.vtp", ranks=ranks)
            dump = result.dump()
            self.assertEqual(dump.steps, [0, 2, 4])
            self.assertEqual(len(list(result.folder.glob("cells.*vtp"))), 3)
            for frame, step in enumerate(dump.steps):
                with self.subTest(ranks=ranks, step=step):
                    cells = Surfaces(result.path(f"cells.{step}.vtp"))
                    self.assert_is_dump(cells, dump, frame)
                    self.assertAlmostEqual(cells.time, 0.1 * step, delta=1e-15)
                    self.assertEqual(cells.time_steps, [cells.time])
                    self.assertEqual(cells.open_edges(), 0)
                    for cell in np.split(cells.points, 3):
                        self.assertLess(np.ptp(cell, axis=0).max(), 11)
                        self.assertTrue((cell.mean(axis=0) >= -1e-8).all()
                                        and (cell.mean(axis=0) < 12).all())
                    alone.setdefault(step, cells)
                    self.assertEqual(cells.triangles.tolist(), alone[step].triangles.tolist())
                    self.assert_same(cells, alone[step])

    def test_pieces_hold_whole_cells(self):
        one = run_moving("fix out all rbc/vtk 4 cells.*.vtp")
        two = run_moving("shell mkdir out\nfix out all rbc/vtk 4 out/cells.*.pvtp", ranks=2)
        for step in (0, 4):
            with self.subTest(step=step):
                whole, together = (Surfaces(one.path(f"cells.{step}.vtp")),
                                   Surfaces(two.path(f"out/cells.{step}.pvtp")))
                self.assert_same(together, whole)
                self.assertEqual((together.time, together.time_steps),
                                 (whole.time, whole.time_steps))
                pieces = [Surfaces(two.path(f"out/cells.{step}_{rank}.vtp")) for rank in (0, 1)]
                self.assertEqual(sum(len(piece.points) for piece in pieces), len(whole.points))
                for piece in pieces:
                    self.assertEqual(piece.open_edges(), 0)
                    self.assertEqual(len(piece.points) % 162, 0)
                    self.assertEqual(piece.time, whole.time)

    def test_ranks_without_cells_write_empty_pieces(self):
        result = lammps_case.run("processors 4 1 1\n" + BOX + "rbc/create rbc single 4.5 6 6\n" +
                                 MEMBRANE +
                                 "fix out all rbc/vtk 1 cells.*.pvtp\nrun 0\n", 4)
        together = Surfaces(result.path("cells.0.pvtp"))
        self.assertEqual(len(together.points), 162)
        self.assertEqual(together.open_edges(), 0)
        sizes = [len(Surfaces(result.path(f"cells.0_{rank}.vtp")).points) for rank in range(4)]
        self.assertEqual(sorted(sizes), [0, 0, 0, 162])

    def test_velocity_and_force_are_those_of_the_flow(self):
        result = lammps_case.run("boundary p p f\n" + BOX + f"""
molecule    large {SHAPE} scale 1.05
rbc/create  large single 6 6 6
{MEMBRANE}
fix         flow all rbc/fluid dx 0.75 viscosity 1.5 density 1.025 inertia none &
            wall zlo 0 0 0 wall zhi 4 0 0
fix         ib all rbc/ib flow
fix         out all rbc/vtk 2 cells.*.vtp
timestep    0.01
{DUMP}
run         2
""", 2)
        for frame, step in enumerate((0, 2)):
            with self.subTest(step=step):
                cells = Surfaces(result.path(f"cells.{step}.vtp"))
                self.assert_is_dump(cells, result.dump(), frame)
                self.assertGreater(np.abs(cells.arrays["velocity"]).max(), 1)

    def test_unwrap_follows_the_images(self):
        middle = np.array([6, 6, 5]) + read_molecule(SHAPE)[0].mean(axis=0)
        for value, centre in (("no", middle), ("yes", middle + [12, 0, -24])):
            with self.subTest(unwrap=value):
                result = lammps_case.run(
                    BOX + "rbc/create rbc single 6 6 5\nset group all image 1 0 -2\n" + MEMBRANE +
                    f"fix out all rbc/vtk 1 cells.*.vtp unwrap {value}\nrun 0\n", 2)
                self.assert_close(Surfaces(result.path("cells.0.vtp")).points.mean(axis=0), centre)

    def test_group_and_several_templates(self):
        expected = {"all": [(1, 162), (2, 362), (3, 362), (4, 162)],
                    "spheres": [(2, 362), (3, 362)],
                    "some": [(2, 362), (4, 162)], "none": []}
        for ranks in (1, 4):
            for end in ("vtp", "pvtp"):
                output = "".join(f"fix {name} {name} rbc/vtk 1 {name}.*.{end}\n"
                                 for name in expected)
                result = lammps_case.run(BOX + f"""
molecule    sphere {SPHERE}
rbc/create  rbc single 6 6 6
rbc/create  sphere single 2 2 2
rbc/create  sphere single 0 9 9
rbc/create  rbc single 6 6 9
group       discs molecule 1 4
group       spheres molecule 2 3
group       some molecule 2 4
group       none empty
fix         m1 discs rbc/membrane rbc neo-hookean 5 volume no
fix         m2 spheres rbc/membrane sphere skalak 5 1 volume no
{output}
run         0
""", ranks)
                for name, cells in expected.items():
                    with self.subTest(group=name, ranks=ranks, end=end):
                        surfaces = Surfaces(result.path(f"{name}.0.{end}"))
                        molecules, counts = np.unique(surfaces.arrays.get("molecule", []),
                                                      return_counts=True)
                        self.assertEqual(list(zip(molecules.astype(int).tolist(), counts.tolist())),
                                         cells)
                        self.assertEqual(surfaces.open_edges(), 0)
                        self.assertEqual(len(surfaces.triangles), sum(2 * n - 4 for _, n in cells))

    def test_aggregate_of_each_cell(self):
        # two that touch, one alone and one outside the compute's group; the gap opens after the
        # first frame
        for ranks, end in ((1, "vtp"), (2, "vtp"), (4, "vtp"), (2, "pvtp")):
            with self.subTest(ranks=ranks, end=end):
                result = lammps_case.run(BOX.replace("12 0 12 0 12", "12 0 12 0 16") + f"""
rbc/create  rbc single 6 6 6.1
rbc/create  rbc single 6 6 9
rbc/create  rbc single 6 6 0.5
rbc/create  rbc single 6 6 3.4
group       above molecule 2
velocity    above set 0 0 1.5
group       some molecule 1:3
{MEMBRANE}
fix         move all nve
compute     agg some rbc/aggregate 0.6
fix         out all rbc/vtk 1 cells.*.{end} aggregate agg
timestep    1
run         1
""", ranks)
                for step, expected in ((0, {1: 1, 2: 1, 3: 3, 4: 0}),
                                       (1, {1: 1, 2: 2, 3: 3, 4: 0})):
                    arrays = Surfaces(result.path(f"cells.{step}.{end}")).arrays
                    self.assertEqual(len(arrays["aggregate"]), 4 * 162)
                    pairs = set(zip(arrays["molecule"].tolist(), arrays["aggregate"].tolist()))
                    self.assertEqual(pairs, set(expected.items()))

    def test_runs_in_pieces_write_a_step_once(self):
        result = run_moving("fix out all rbc/vtk 2 cells.*.vtp", """
run 4
shell rm cells.4.vtp
run 1
run 3 pre no
""", ranks=2)
        found = sorted(path.name for path in result.folder.glob("cells.*vtp"))
        self.assertEqual(found, ["cells.0.vtp", "cells.2.vtp", "cells.6.vtp", "cells.8.vtp"])
        self.assertAlmostEqual(Surfaces(result.path("cells.8.vtp")).time, 0.8, delta=1e-12)

    def assert_fails(self, script, message):
        result = lammps_case.attempt(script)
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertRegex(result.error, message)

    def test_list_of_the_series(self):
        def entries(result):
            root = ElementTree.parse(result.path("cells.pvd")).getroot()
            self.assertEqual(root.attrib["type"], "Collection")
            return [(float(entry.attrib["timestep"]), entry.attrib["file"])
                    for entry in root.iter("DataSet")]

        def moved(steps, script, prepare=None):
            return lammps_case.run(f"{script}fix out all rbc/vtk 2 cells.*.pvtp\ntimestep 0.5\n"
                                   f"run {steps}\n"
                                   "write_restart last.restart\n", 2, prepare=prepare)

        def keep(folder):
            shutil.copy(first.path("last.restart"), folder)
            of_another = ('    <DataSet timestep="3" group="" part="0" '
                          'file="of-another-run.pvtp"/>\n  </Collection>')
            (folder / "cells.pvd").write_text(
                first.path("cells.pvd").read_text().replace("  </Collection>", of_another))

        first = moved(4, BOX + "rbc/create rbc single 6 6 6\n" + MEMBRANE)
        self.assertEqual(entries(first),
                         [(0, "cells.0.pvtp"), (1, "cells.2.pvtp"), (2, "cells.4.pvtp")])
        again = moved(2, f"read_restart last.restart\nmolecule rbc {SHAPE}\n" + MEMBRANE, keep)
        self.assertEqual(entries(again), [*entries(first), (3, "cells.6.pvtp")])

    def test_a_folder_for_each_step(self):
        result = lammps_case.run(BOX + "rbc/create rbc single 6 6 6\n" + MEMBRANE +
                                 "shell mkdir at0 at1\n"
                                 "fix out all rbc/vtk 1 at*/cells.vtp\ntimestep 0.5\nrun 1\n")
        self.assertEqual(sorted(path.parent.name for path in result.folder.glob("at*/cells.vtp")),
                         ["at0", "at1"])
        self.assertEqual(list(result.folder.rglob("*.pvd")), [])

    def test_bad_arguments(self):
        for arguments, message in (
                ("0 cells.*.vtp", r"Fix rbc/vtk N value 0 must be > 0"),
                ("-5 cells.*.vtp", r"Fix rbc/vtk N value -5 must be > 0"),
                ("x cells.*.vtp", r"Fix rbc/vtk N value 'x' must be an integer > 0"),
                ("10", r"Illegal fix rbc/vtk command: missing argument"),
                ("10 cells.vtp", r"Fix rbc/vtk file name cells.vtp must contain a \*"),
                ("10 cells.*.vtk", r"Fix rbc/vtk file name cells.\*.vtk must end in .vtp or .pvtp"),
                ("10 cells.*.vtp wrap yes",
                 r"Unknown fix rbc/vtk keyword wrap; allowed: unwrap, aggregate"),
                ("10 cells.*.vtp unwrap", r"Illegal fix rbc/vtk unwrap command: missing argument"),
                ("10 cells.*.vtp unwrap maybe", r"Expected boolean"),
                ("10 cells.*.vtp aggregate",
                 r"Illegal fix rbc/vtk aggregate command: missing argument"),
                ("10 cells.*.vtp aggregate agg",
                 r"Fix rbc/vtk out: compute ID agg for aggregate does not exist"),
                ("10 cells.*.vtp aggregate thermo_temp",
                 r"compute thermo_temp for aggregate is of style temp, not "
                 "rbc/aggregate"),
                ("10 nowhere/cells.*.vtp",
                 r"Fix rbc/vtk out: cannot open file nowhere/cells.0.vtp: No such file"),
                ("10 nowhere/cells.*.pvtp",
                 r"Fix rbc/vtk out: cannot open file nowhere/cells.0_\d.vtp: No such file")):
            with self.subTest(arguments=arguments):
                self.assert_fails(BOX + "rbc/create rbc single 6 6 6\n" + MEMBRANE +
                                  f"fix out all rbc/vtk {arguments}\nrun 0\n", message)

    def test_bad_surroundings(self):
        cell = BOX + "rbc/create rbc single 6 6 6\n"
        fluid = ("fix flow all rbc/fluid dx 1 viscosity 1.5 density 1.025 inertia none\n"
                 "fix ib all rbc/ib flow\n")
        output = "fix out all rbc/vtk 10 cells.*.vtp\n"
        for script, message in (
                (cell + output, r"Fix rbc/vtk out: there is no fix rbc/membrane"),
                (cell + output + MEMBRANE,
                 r"Fix rbc/vtk out must be defined after fix rbc/membrane mem"),
                (cell + MEMBRANE + output + fluid,
                 r"Fix rbc/vtk out must be defined after fix rbc/ib ib"),
                (cell + MEMBRANE + "group half id <= 100\n" + output.replace("all", "half"),
                 "group half breaks the cell with molecule ID 1: it holds 100 of its 162 "
                 "vertices"),
                (cell + MEMBRANE + "group high dynamic all every 1\n" +
                 output.replace("all", "high"),
                 r"Fix rbc/vtk out cannot be used with dynamic group high")):
            with self.subTest(message=message):
                self.assert_fails(script + "run 0\n", message)


if __name__ == "__main__":
    unittest.main()
