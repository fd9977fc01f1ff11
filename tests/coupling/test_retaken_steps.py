"""Steps that go wrong are taken again, a bounded number of times, and are counted; a run that stops
names what may help."""

import re
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from lammps_case import SHEAR, attempt, dump_line, in_parallel, run, scene
from test_extreme_stops import FAR, pull
from test_run_errors import through_its_neighbours

IB = "fix ib all rbc/ib flow"
MEMBRANE = SHEAR["membrane"].replace("volume yes", "area 1.0 0.05 volume yes")    # healthy.material
OUTPUT = "fix out all rbc/vtk 1 cells.*.vtp"


def lifted(stiffness, dt, time=8000, ib=" integrator rkc auto", **changes):
    """A stiff wall that comes from below lifts a cell: modes become fast from one step to the next.
    Its range is 1."""
    return dict(membrane=MEMBRANE, timestep=f"timestep {dt}", ib=IB + ib,
                before="variable place equal 2.4+time*1e-4\n"
                       f"fix wall all wall/harmonic zlo v_place {stiffness} 1.0 1.0",
                thermo="thermo_style custom step v_place f_ib[5] f_ib[8] f_ib[10]",
                every=f"thermo {200 // dt}",
                dump=dump_line(200 // dt), run=f"run {time // dt}", **changes)


class RetakenSteps(unittest.TestCase):
    def test_contact_with_a_stiff_wall(self):
        # explicit steps of any length that suits the membrane alone are unstable in contact
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(scene(**lifted(50, 20, 5000)), ranks)
                table, dump = result.thermo, result.dump()
                print(f"\nlifted by a wall: {table['f_ib[8]'][-1]:.0f} steps taken again in "
                      f"{table['Step'][-1]:.0f}")
                self.assertGreaterEqual(table["f_ib[8]"][-1], 1)
                self.assertLessEqual(table["f_ib[10]"][-1], table["f_ib[8]"][-1])
                for frame, place in enumerate(table["v_place"][:len(dump.frames)]):
                    lowest = dump.positions(frame)[:, 2].min()
                    # rests on the wall, or is a little above it
                    self.assertGreater(lowest, place + 0.93)
                    if frame > 10:
                        self.assertLess(lowest, place + 1.2)

    def test_a_vertex_that_becomes_stiff_among_fast_ones(self):
        # All vertices move with the plates by half a fluid cell in a step. From step 61 on a spring
        # holds one of them at a height; the cell is softer, and nothing else pulls there.
        fluid = SHEAR["fluid"].replace("zlo 0 0 0", "zlo 0.0025 0 0").replace("0.0012", "0.0025")
        spring = ("group one id 40\nfix kept one store/state 60 z\n"
                  "fix pull one addforce 0 0 v_pull\n"
                  "variable pull atom -{}*(step>60)*(z-f_kept-0.001)")
        for stiffness in (0.3, 0.5, 0.7):
            result = run(scene(fluid=fluid, ib=IB + " integrator rkc auto", run="run 110",
                               last=spring.format(stiffness), every="thermo 10",
                               thermo="thermo_style custom step f_ib[8]", dump=dump_line(1)))
            dump = result.dump()
            heights = np.array([dump.positions(frame)[39, 2] for frame in range(60, 111)])
            off = abs(heights - heights[0] - 0.001)
            print(
                f"\nspring of {stiffness:g}: {result.thermo['f_ib[8]'][-1]:.0f} steps taken again, "
                f"the vertex at most {off.max():.2g} um off")
            self.assertLess(off.max(), 0.1)
            self.assertLess(off[-1], 0.02)

    def test_count_and_warning(self):
        result = run(scene(**lifted(5, 200, 4000)))
        wrong = int(result.thermo["f_ib[10]"][-1])
        self.assertGreater(wrong, 0)
        self.assertEqual([int(n) for n in
                          re.findall(r"Steps taken again: (\d+), (\d+) of them gone wrong",
                                     result.printed)[0]],
                         [int(result.thermo["f_ib[8]"][-1]), wrong])
        self.assertRegex(result.printed, rf"WARNING: Fix rbc/ib ib took steps again, {wrong} times")

    def test_none_without_need(self):
        # a step costs its stages, and estimates are made as ever: at most one in five steps, of 1
        # to 20 iterations
        result = run(scene(ib=IB + " integrator rkc auto", membrane=MEMBRANE, run="run 40",
                           every="thermo 1",
                           thermo="thermo_style custom step f_ib[5] f_ib[8] f_flow[12]"))
        self.assertEqual(result.thermo["f_ib[8]"][-1], 0)
        self.assertNotIn("taken again", result.printed)
        self.assertNotIn("WARNING: Fix rbc/ib", result.printed)
        solves = np.diff(result.thermo["f_flow[12]"])
        self.assertGreaterEqual(np.count_nonzero(solves == result.thermo["f_ib[5]"][1:]), 32)

    def test_fixed_stages_stop(self):
        for ib in ("integrator euler", "integrator midpoint", "integrator ab2", "integrator rkc 2"):
            with self.subTest(ib):
                result = attempt(scene(membrane=MEMBRANE, ib=f"{IB} {ib}", run="run 100"))
                self.assertEqual(result.code, 1)
                self.assertRegex(result.error, "CFL above 1.*likeliest first: integrator rkc auto; "
                                               "adapt of fix rbc/ib; a timestep shorter than 200 ")


class Default(unittest.TestCase):
    def positions(self, **changes):
        return run(scene(**{**dict(membrane=MEMBRANE, run="run 40", dump=dump_line(40)),
                            **changes})).dump().positions()

    def test_runs_healthy_cells_at_the_timestep_of_the_readme(self):
        default, named = in_parallel(lambda ib: self.positions(ib=ib),
                                     [(IB,), (IB + " integrator rkc auto",)])
        np.testing.assert_array_equal(default, named)
        # right, too: as with timesteps that an explicit method bears
        short = self.positions(ib=IB + " integrator midpoint", timestep="timestep 20",
                               run="run 400", dump=dump_line(400))
        self.assertLess(abs(default - short).max(), 2e-3)
        self.assertGreater(
            abs(default - self.positions(run="run 0", dump=dump_line(1), ib=IB)).max(), 1)

    def test_of_a_fluid_with_inertia(self):
        # whether the fluid is defined before the fix or after it
        fluid = SHEAR["fluid"].replace("inertia none", "inertia unsteady")
        lines = dict(timestep="timestep 1", run="run 10", dump=dump_line(10), fluid=fluid)
        midpoint, default, after = (run(scene(**{**lines, **changes})).dump().positions()
                                    for changes in (
            dict(ib=IB + " integrator midpoint"), dict(ib=IB), dict(fluid=IB, ib=fluid)))
        np.testing.assert_array_equal(default, midpoint)
        np.testing.assert_array_equal(after, midpoint)
        result = attempt(scene(**{**lines, "fluid": IB + " order 3", "ib": fluid}))
        self.assertIn("integrator must be euler or midpoint", result.error)


class LastFrame(unittest.TestCase):
    def test_shows_the_cells_that_went_wrong(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = attempt(scene(membrane=MEMBRANE, ib=IB + " integrator midpoint",
                                       last=OUTPUT, run="run 100", dump=dump_line(1)), ranks)
                step = int(re.search(r"at step (\d+)", result.error).group(1))
                place = [float(x) for x in re.search(r"\(([^ ,]+), ([^ ,]+), ([^ ,]+)\)",
                                                     result.error).groups()]
                self.assertEqual(result.dump().steps[-1], step - 1)
                reader = vtkXMLPolyDataReader()
                reader.SetFileName(str(result.path(f"cells.{step}.vtp")))
                reader.Update()
                points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
                self.assertEqual(points.shape, (162, 3))
                # the vertex of the message is in it
                self.assertLess(np.linalg.norm(points - place, axis=1).min(), 1e-4)


class Remedies(unittest.TestCase):
    def test_of_a_fold(self):
        bare, full = (attempt(scene(ib=IB, run="run 10", last=through_its_neighbours(),
                                    cells="rbc/create rbc single 6 6 6",
                                    membrane=SHEAR["membrane"] + more))
                      for more in ("", " crease 0.04 45 stretch 0.02 2.5"))
        self.assertRegex(
            bare.error, "likeliest first: crease of fix rbc/membrane; stretch of fix rbc/membrane; "
                        "adapt of fix rbc/ib; a timestep shorter than 200; a finer mesh")
        self.assertRegex(full.error, "likeliest first: adapt of fix rbc/ib; a timestep shorter "
                                     "than 200; a finer mesh")

    def test_of_atoms_that_overlap(self):
        beads = "mass 1 1\ncreate_atoms 1 single 6 6 6\ncreate_atoms 1 single 6 6 6.05"
        for pair, names_it in (("pair_style lj/cut 2\npair_coeff 1 1 0.1 1", True), (None, False)):
            push = "fix push all addforce 1e30 0 0" if not names_it else None
            result = attempt(scene(cells=beads, membrane=None, compute=None, thermo=None,
                                   before=pair, last=push, timestep="timestep 1", run="run 5"))
            self.assertRegex(result.error, "likeliest first: .*a timestep shorter than 1")
            self.assertEqual("; atoms that do not overlap with others at the start (pair_style "
                             "lj/cut)" in result.error, names_it, result.error)

    def test_of_other_forces(self):
        """Those that act on atoms which the fix moves, whatever the group of either is."""
        for tasks in (1, 2):
            result = attempt(scene(
                cells="rbc/create rbc single 6 6 6\ngroup half id < 80\ngroup none empty",
                ib=IB + " integrator midpoint", run="run 20", timestep="timestep 100",
                last="fix push half addforce 1e3 0 0\nfix rest none addforce 1e3 0 0"), tasks)
            self.assertRegex(result.error, "likeliest first: smaller forces of fix addforce push; ")

    def test_of_ghosts_that_are_missing(self):
        result = attempt(
            scene(**FAR, before=pull(20), processors="processors 1 2 1", timestep="timestep 1"), 2)
        cutoff = float(re.search(r"ghost cutoff (\S+) is too short", result.error).group(1))
        named = float(
            re.search(r"likeliest first: comm_modify cutoff ([0-9.]+)", result.error).group(1))
        self.assertAlmostEqual(named, 1.5 * cutoff, delta=0.01 * cutoff)


if __name__ == "__main__":
    unittest.main()
