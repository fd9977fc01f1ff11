"""The result depends neither on the ranks and their parts of the box, nor on newton, nor on the
product, nor on where in a periodic box the cells are."""

import unittest

import numpy as np

from lammps_case import SHEAR, dump_line, run, scene

DIAMETER = 7.82
TOLERANCE = 1e-8    # of the diameter
STEPS = 1000        # strain 20

# Whatever halves the box, and eighths in x and z, go through this cell.
CELL = dict(cells="rbc/create rbc single 5.3 6.4 6.2 rotate 30 1 0.5 0",
            fluid=SHEAR["fluid"].replace("dx 1.0", "dx 0.75"),
            thermo="thermo_style custom step f_mem f_flow[11]",
            every="thermo 100", dump=dump_line(STEPS), run=f"run {STEPS}")

WAYS = {
    "2 ranks": (2, {}),
    "4 ranks": (4, {}),
    "4 ranks, newton off": (4, dict(newton="newton off")),
    "8 ranks in x": (8, dict(processors="processors 8 1 1")),
    "8 ranks in z": (8, dict(processors="processors 1 1 8")),
    "8 ranks, 2 x 2 x 2, newton off": (8, dict(processors="processors 2 2 2", newton="newton off")),
    "1 rank, newton off": (1, dict(newton="newton off")),
    "4 ranks, uneven bricks": (4,
                               dict(processors="processors 2 1 2", last="balance 1.0 x 0.3 z 0.6")),
    "4 ranks, balance shift": (4, dict(processors="processors 2 2 1",
                                       last="balance 1.0 shift xy 10 1.01")),
    "4 ranks, fix balance": (4,
                             dict(processors="processors 1 2 2",
                                  last="fix lb all balance 100 1.0 shift yz 10 1.01")),
    "4 ranks, rcb": (4, dict(processors="comm_style tiled", last="balance 1.0 rcb")),
    "4 ranks, fix balance rcb": (4, dict(processors="comm_style tiled",
                                         last="fix lb all balance 100 1.0 rcb")),
}


class Ranks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.reference = run(scene(**CELL))

    def agree(self, name, result):
        apart = abs(result.dump().positions() - self.reference.dump().positions()).max() / DIAMETER
        print(f"\n{name}: {apart:.2g} diameters from 1 rank after {STEPS} steps")
        self.assertLess(apart, TOLERANCE)
        self.assertLess(result.thermo["f_flow[11]"].max(), 1e-12)
        np.testing.assert_allclose(result.thermo["f_mem"], self.reference.thermo["f_mem"],
                                   rtol=1e-6, atol=1e-8 * self.reference.thermo["f_mem"].max())

    def test_cell_moved(self):
        dump = self.reference.dump()
        self.assertGreater(abs(dump.positions() - dump.positions(0)).max(), 3)

    def test_ways_to_divide(self):
        for name, (ranks, changes) in WAYS.items():
            with self.subTest(name):
                self.agree(name, run(scene(**{**CELL, **changes}), ranks))

    def test_a_grid_smaller_than_the_kernel_needs_on_each_rank(self):
        # 4 cells in every direction, halved: the ghost layers go around the box more than once
        for boundary, walls in (("p p f", " wall zlo 0 0 0 wall zhi 0.0012 0 0"), ("p p p", "")):
            ends = []
            for ranks in (1, 8):
                fluid = "fix flow all rbc/fluid grid 4 4 4 viscosity 1.5 density 1.025" + walls
                result = run(scene(boundary=f"boundary {boundary}", fluid=fluid, dump=dump_line(50),
                                   run="run 50",
                                   last="displace_atoms all random 0.05 0.05 0.05 3"), ranks)
                self.assertLess(result.thermo["f_flow[11]"].max(), 1e-12)
                ends.append(result.dump().positions())
            self.assertLess(abs(ends[1] - ends[0]).max(), 1e-12 * DIAMETER, boundary)

    def test_plugin(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = run(scene(**CELL), ranks, plugin=True)
                self.agree(f"plugin, {ranks} ranks", result)
                if ranks == 1:
                    np.testing.assert_array_equal(result.dump().positions(),
                                                  self.reference.dump().positions())


class Places(unittest.TestCase):
    """Translations by whole cells of the grid change nothing, faces or not."""

    SHIFTS = [(0, 0, 0), (8, 0, 0), (0, 8, 0), (0, 0, 8), (8, 8, 0), (8, 0, 8), (0, 8, 8),
              (8, 8, 8), (-5, 3, 6),
              (16 * 3 + 7, -16 * 2, -9)]
    DEFORM = ("variable x atom {0[0]}+1.15*(x-{0[0]})\nvariable y atom {0[1]}+0.9*(y-{0[1]})\n"
              "set group all x v_x y v_y")

    def periodic(self, shift, ranks):
        # deformed in the middle, moved there, let go
        centre = (6, 6, 6)
        move = " ".join(str(0.75 * n) for n in shift)
        result = run(scene(boundary="boundary p p p",
                           fluid="fix flow all rbc/fluid dx 0.75 viscosity 1.5 density 1.025",
                           cells="rbc/create rbc single 6 6 6 rotate 30 1 0.5 0", run="run 100",
                           dump=dump_line(100), every="thermo 50",
                           last=self.DEFORM.format(centre) + f"\ndisplace_atoms all move {move}"),
                     ranks)
        dump = result.dump()
        self.assertLess(result.thermo["f_flow[11]"].max(), 1e-12)
        return dump.positions() - 0.75 * np.array(shift), dump.positions(0) - 0.75 * np.array(shift)

    def test_across_faces_edges_and_corners(self):
        reference, start = self.periodic(self.SHIFTS[0], 1)
        self.assertGreater(abs(reference - start).max(), 0.05)
        worst = 0
        for shift in self.SHIFTS[1:]:
            for ranks in (1, 4):
                with self.subTest(shift, ranks=ranks):
                    apart = abs(self.periodic(shift, ranks)[0] - reference).max() / DIAMETER
                    worst = max(worst, apart)
                    self.assertLess(apart, TOLERANCE)
        print(f"\nacross faces, edges and corners: at most {worst:.2g} diameters from the cell in "
              "the middle")

    def carried(self, cells, ranks, steps, lower, upper):
        walls = f" wall zlo {lower[0]} {lower[1]} 0 wall zhi {upper[0]} {upper[1]} 0"
        dump = run(
            scene(cells=f"rbc/create rbc single {' '.join(map(str, cells))} rotate 30 1 0.5 0",
                  fluid="fix flow all rbc/fluid dx 0.75 viscosity 1.5 density 1.025" + walls,
                  thermo="thermo_style custom step f_mem f_flow[11]", every="thermo 100",
                  timestep="timestep 100", dump=dump_line(steps), run=f"run {steps}"), ranks).dump()
        return dump.positions(0), dump.positions()

    def test_carried_ten_times_through_the_faces(self):
        # by a uniform flow: 120 um in x, as much backwards in y
        steps, speed = 250, 0.0048
        for ranks in (1, 4):
            with self.subTest(ranks=ranks):
                start, end = self.carried((6, 6, 6), ranks, steps, (speed, -speed), (speed, -speed))
                apart = (abs(end - start - speed * 100 * steps * np.array([1, -1, 0])).max() /
                         DIAMETER)
                print(f"\ncarried ten times through the box, {ranks} ranks: shape changes by "
                      f"{apart:.2g} diameters")
                self.assertLess(apart, TOLERANCE)

    def test_sheared_while_carried(self):
        # cells that start some grid cells apart meet the faces at other times
        steps, speed, shear = 260, 0.0048, 0.0006
        lower, upper = (speed - shear, -speed), (speed + shear, -speed)
        start, reference = self.carried((6, 6, 6), 1, steps, lower, upper)
        self.assertGreater((reference - start)[:, 0].min(), 115)
        for shift, ranks in (((5, 3, 0), 1), ((-6, 7, 0), 4), ((0, 0, 0), 4)):
            with self.subTest(shift, ranks=ranks):
                move = 0.75 * np.array(shift)
                _, end = self.carried(6 + move, ranks, steps, lower, upper)
                apart = abs(end - move - reference).max() / DIAMETER
                print(f"\nsheared and carried, {shift} cells apart, {ranks} ranks: {apart:.2g} "
                      "diameters")
                self.assertLess(apart, TOLERANCE)


if __name__ == "__main__":
    unittest.main()
