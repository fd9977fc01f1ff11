"""What cannot go on stops with a message, on any rank, and all that was written before is whole:
readers accept it."""

import re
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from lammps_case import (POTENTIALS, SHEAR, attempt, dump_line, make_template, read_template, run,
                         scene)
from test_extremes import AUTO, BOX, area, cut_edges, fluid, membrane, rms, volume

SHAPE, TRIANGLES = read_template(POTENTIALS / "rbc_162.mol")
IB = "fix ib all rbc/ib flow kernel peskin4 integrator "
FAR = dict(box="region box block 0 36 0 36 0 24", cells="rbc/create rbc single 12 12 12",
           fluid=fluid(0.0, height=24))


def pull(vertex=0, by=20.0):
    """A vertex moved away from the cell along its direction from the centre."""
    x, y, z = SHAPE[vertex] / np.linalg.norm(SHAPE[vertex]) * by
    return f"group pulled id {vertex + 1}\ndisplace_atoms pulled move {x!r} {y!r} {z!r}"


class Stops(unittest.TestCase):
    def stopped(self, words, ranks=1, position=True, **changes):
        """Runs what must stop; checks the message and everything on disk. Returns result and
        step."""
        changes.setdefault("run", "run 400")
        lines = {**dict(compute="compute cell all rbc/cell", every="thermo 1",
                        last="fix rows all ave/time 1 1 1 c_cell[*] mode vector file cell.dat\n"
                             "fix surface all rbc/vtk 1 cells.*.vtp\nrestart 1 state.*"),
                 **changes}
        result = attempt(scene(dump=dump_line(1), **lines), ranks)
        self.assertEqual(result.code, 1, result.printed)
        for word in words:
            self.assertIn(word.lower(), result.error.lower(), result.printed)
        step = int(re.search(r"at step (\d+)", result.error).group(1))
        if position:
            self.assertRegex(result.error, r"molecule ID 1.*\(\S+, \S+, \S+\)")
        self.whole_files(result, step)
        return result, step

    def whole_files(self, result, step):
        """Each holds all steps before the one that failed."""
        last = max(step - 1, 0) if step else None    # a run that fails in its setup has no output
        log = result.path("log.case").read_text()
        self.assertIn(result.error.split(" (src")[0].split(" Last input")[0][:60], log)
        if last is None:
            self.assertNotIn("Loop time", log)
            return
        rows = re.findall(r"^ *(\d+)(?: +\S+)+$", log[log.index("Step "):], re.MULTILINE)
        self.assertIn(int(rows[-1]), (last, step))
        dump = result.dump()
        self.assertIn(dump.steps[-1], (last, step))
        self.assertEqual(dump.steps, list(range(len(dump.steps))))
        self.assertTrue(np.isfinite(dump.positions()).all())
        surface = vtkXMLPolyDataReader()
        surface.SetFileName(str(result.path(f"cells.{dump.steps[-1]}.vtp")))
        surface.Update()
        points = vtk_to_numpy(surface.GetOutput().GetPoints().GetData())
        np.testing.assert_allclose(np.sort(points[:, 2]), np.sort(dump.positions()[:, 2]),
                                   atol=1e-5)
        rows = [line for line in result.path("cell.dat").read_text().splitlines()
                if not line.startswith("#")]
        self.assertEqual(len(rows), 2 * len(dump.steps))
        self.assertEqual(len(rows[-1].split()), 20)

    def test_timestep_a_thousand_times_too_long(self):
        # at rest: only round-off can grow; automatic stages are stable at any step
        for integrator in ("euler", "midpoint", "ab2", "rkc 4", "rkc 4 order 3"):
            with self.subTest(integrator):
                self.stopped(["rbc/ib ib", "CFL above 1", "timestep too large"], ib=IB + integrator,
                             fluid=fluid(0.0), timestep="timestep 1e6")
        for order in ("", " order 3"):
            done = run(scene(ib=AUTO + order, fluid=fluid(0.0), timestep="timestep 1e6",
                             dump=dump_line(50), run="run 50")).dump()
            self.assertLess(abs(done.positions() - done.positions(0)).max(), 1e-9)

    def test_the_task_with_the_cell_is_not_the_one_that_writes(self):
        for cells in ("rbc/create rbc single 6 6 4", "rbc/create rbc single 6 6 14"):
            self.stopped(["rbc/ib ib", "CFL above 1"], ranks=2, processors="processors 1 1 2",
                         cells=cells, box="region box block 0 12 0 12 0 18", ib=IB + "euler",
                         fluid=fluid(1e-5, height=18.0), timestep="timestep 4000")

    def test_restart_from_before_the_stop(self):
        # the plates speed up; the last restart file continues with a shorter step
        speeding = ("variable U equal 0.0006*exp(step/10)\nvariable L equal -v_U\n"
                    + re.sub(r"zlo \S+", "zlo v_L", re.sub(r"zhi \S+", "zhi v_U", fluid())))
        result, step = self.stopped(["rbc/ib ib", "CFL above 1"], fluid=speeding)
        at = result.path(f"state.{step - 1}")
        again = run(scene(units=None, style=None, boundary=None, box=None, create_box=None,
                          cells=None,
                          newton=f"read_restart {at}", fluid=fluid(), timestep="timestep 50",
                          dump=dump_line(120) + " first yes", run="run 120"))
        frame = result.dump().steps.index(step - 1)
        np.testing.assert_array_equal(again.dump().positions(0), result.dump().positions(frame))
        self.assertLess(
            abs(volume(again.dump().positions(), TRIANGLES) / volume(SHAPE, TRIANGLES) - 1), 1e-4)

    def test_inside_out_from_a_data_file(self):
        # mirrored: every triangle faces inward, none is folded
        data = (run(scene(cells=SHEAR["cells"] + "\nwrite_data cell.data nocoeff", run="run 0"))
                .path("cell.data"))
        mirror = "variable m atom 12-z\nset group all z v_m"
        for ranks in (1, 2):
            for kept in ("volume yes", "volume no", "volume 0.1"):
                with self.subTest(kept, ranks=ranks):
                    self.stopped(["rbc/membrane mem", "turned inside out"], ranks,
                                 membrane=membrane(more=kept),
                                 box=None, create_box=None, cells=f"read_data {data}\n{mirror}")

    def test_inside_out_template(self):
        rows = (POTENTIALS / "rbc_162.mol").read_text()
        head, angles = rows.split("Angles")
        inward = head + "Angles" + re.sub(r"^(\d+ 1) (\d+) (\d+) (\d+)", r"\1 \2 \4 \3", angles,
                                          flags=re.MULTILINE)
        result = attempt(scene(molecule="molecule rbc inward.mol"), files={"inward.mol": inward})
        self.assertEqual(result.code, 1)
        self.assertIn("inward", result.error)

    def test_vertex_pulled_20_um_out(self):
        # the step that suits a healthy cell cannot resolve how fast it snaps back
        self.stopped(["rbc/ib ib", "CFL above 1"], **FAR, before=pull())
        for layout in ("2 1 1", "1 2 1"):
            result = attempt(scene(**FAR, before=pull(20), processors=f"processors {layout}",
                                   timestep="timestep 1"), 2)
            if result.code:
                self.assertIn("edges are stretched too far", result.error)
        # steps by error do; the energy can only fall in a fluid at rest
        lines = dict(FAR, before=pull(), ib=AUTO + " adapt 0.005 2000", every="thermo 1",
                     membrane=membrane(more="volume no"), run="run 600", dump=dump_line(600),
                     thermo="thermo_style custom step time f_mem f_ib[9] f_ib[8]")
        for ranks, cutoff in ((1, ""), (2, "\ncomm_modify cutoff 24")):
            result = run(scene(**{**lines, "neighbor": SHEAR["neighbor"] + cutoff}), ranks)
            energy, end = result.thermo["f_mem"], result.dump().positions()
            print(f"\nvertex pulled out by 20 um: energy {energy[0]:.3g} to {energy[-1]:.3g} fJ in "
                  f"{result.thermo['Time'][-1]:.3g} us, steps of "
                  f"{result.thermo['f_ib[9]'][1]:.2g} to {result.thermo['f_ib[9]'].max():.4g} us")
            self.assertTrue((np.diff(energy) < 1e-12 * energy[0]).all())
            self.assertLess(energy[-1], 1e-3 * energy[0])
            self.assertLess(np.ptp(end, axis=0).max(), 9)
            self.assertEqual(cut_edges(end, TRIANGLES), 0)

    def test_folded_until_it_would_pass_through_itself(self):
        # a healthy cell drawn out by 1e5/s, beyond what 162 vertices resolve, however short the
        # steps
        times = []
        for ib, words in ((SHEAR["ib"], []),
                          (IB + "midpoint adapt 1e-3 1", ["so with all timesteps"])):
            result, _ = self.stopped(
                ["rbc/membrane mem", "folded onto each other", *words], run="run 4000", ib=ib,
                fluid=fluid(0.1, height=12.0), timestep="timestep 0.2",
                box="region box block 0 24 0 12 0 12", thermo="thermo_style custom step time")
            end = result.dump().positions()
            self.assertEqual(cut_edges(end, TRIANGLES), 0)
            self.assertGreater(area(end, TRIANGLES), 3 * area(SHAPE, TRIANGLES))
            times.append(result.thermo["Time"][-1])
        self.assertAlmostEqual(times[0], times[1], delta=0.01 * times[0])

    def test_error_bounds_that_cannot_be_met(self):
        self.stopped(["rbc/ib ib", "no timestep above", "adapt"], position=False,
                     ib=AUTO + " adapt 1e-30 200")
        # and one that asks for nothing: no atom crosses more than half a fluid cell in a step
        result = run(scene(ib=AUTO + " adapt 1e30 1e9", dump=dump_line(1), run="run 30",
                           thermo="thermo_style custom step f_ib[9]", every="thermo 1"))
        steps = result.thermo["f_ib[9]"][1:]
        for frame, dt in enumerate(steps):
            moved = result.dump().positions(frame + 1) - result.dump().positions(frame)
            self.assertLess(np.linalg.norm(moved, axis=1).max(), 1)
        self.assertGreater(steps.max(), 200)

    def test_rkc_with_more_stages_than_round_off_allows(self):
        self.stopped(["rbc/ib ib", "more than 10000 stages"], position=False, ib=AUTO,
                     timestep="timestep 1e12", fluid=fluid(0.0))

    def test_no_stiffness_at_all(self):
        run(scene(ib="group none empty\n" + AUTO.replace("all", "none"),
                  membrane=membrane(more="volume no"), run="run 3"))
        run(scene(ib=AUTO, membrane="fix mem all rbc/membrane rbc neo-hookean 1e-300", run="run 3"))


class Squeezed(unittest.TestCase):
    """Two planes press a cell to a fifth of its thickness: a body of volume V in a slab of height H
    has a surface of at least 2 V / H."""

    def test_to_a_fifth_of_its_thickness(self):
        thickness = np.ptp(SHAPE[:, 2])
        steps, final = 1500, 0.2 * thickness
        half = f"ramp({thickness / 2 + 0.05},{final / 2 - 0.12})"
        planes = (f"variable low equal 4-{half}\nvariable high equal 4+{half}\n"
                  "fix low all indent 10 plane z v_low lo\n"
                  "fix high all indent 10 plane z v_high hi")
        result = run(scene(box="region box block 0 20 0 20 0 8",
                           cells="rbc/create rbc single 10 10 4", before=planes,
                           fluid=fluid(0.0, height=8.0), ib=IB + "rkc 24 sheets no",
                           timestep="timestep 1000",
                           dump=dump_line(steps), run=f"run {steps}", every="thermo 100"))
        start, end = result.dump().positions(0), result.dump().positions()
        height, kept = np.ptp(end[:, 2]), volume(end, TRIANGLES) / volume(start, TRIANGLES)
        ratio = area(end, TRIANGLES) * height / (2 * volume(end, TRIANGLES))
        print(
            f"\nsqueezed from {thickness:.3g} to {height:.3g} um: volume {kept - 1:.2g} off, area "
            f"{area(end, TRIANGLES) / area(start, TRIANGLES):.3g} times, {ratio:.3g} times the "
            "least")
        self.assertLess(height, final)
        self.assertLess(abs(kept - 1), 1e-3)
        self.assertGreater(ratio, 1)
        self.assertEqual(cut_edges(end, TRIANGLES), 0)
        self.assertLess(rms(end[:, 2:] - 4), 0.5 * final)

    def test_faster_than_the_fluid_can_leave(self):
        result = attempt(
            scene(box="region box block 0 20 0 20 0 8", cells="rbc/create rbc single 10 10 4",
                  before="variable low equal 2.6+0.05*step\nvariable high equal 5.4-0.05*step\n"
                  "fix press all indent 100 plane z v_low lo\n"
                         "fix press2 all indent 100 plane z v_high hi",
                  fluid=fluid(0.0, height=8.0), run="run 50", every="thermo 1"))
        self.assertEqual(result.code, 1)
        self.assertRegex(result.error, "CFL above 1.*at step .*molecule ID 1")


if __name__ == "__main__":
    unittest.main()
