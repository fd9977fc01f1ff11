"""fix rbc/stream: cells of two kinds enter a tube; a region that is wider than the vessel, and one
that goes on through periodic sides."""

import unittest

import numpy as np

from lammps_case import dump_line, run, scene
from rbc.surface_distances import pair_distances
from test_ports import TUBE
from test_stream import (CONTACT, DUMP, EMPTY, GAP, MEMBRANE, RADIUS, SIDE, STREAM, TRIANGLES,
                         cells_of, stream, stream_fix)


class Kinds(unittest.TestCase):
    def test_two_of_them_enter(self):
        """One fix rbc/ib moves both, and no atoms of the wall."""
        groups = "\n".join(f"group {name} empty" for name in ("cells", "stiff", "moved"))
        other = (STREAM.replace("fix stream cells", "fix other stiff").replace("seed 5", "seed 9")
                 .replace(" outlet out last", ""))
        wall = (f"{TUBE['wall']}\n{MEMBRANE}\n" + MEMBRANE.replace("fix mem cells",
                                                                  "fix hard stiff"))
        ib = stream_fix(STREAM).replace("fix ib cells", "fix ib moved")
        columns = "id mol xu yu zu"
        result = run(stream(
            more=EMPTY["more"], groups=f"group wall type 2\n{groups}", wall=f"{wall}\n{CONTACT}",
            ib=f"{ib}\n{other}", run="run 40", thermo="thermo_style custom step f_stream[3] "
            "f_other[3]",
            dump="\n".join(f"dump {name} {name} custom 1 {name}.dump {columns}"
                           for name in ("cells", "stiff"))))
        for name, group in (("f_stream[3]", "cells"), ("f_other[3]", "stiff")):
            inside = result.thermo[name]
            self.assertGreaterEqual(inside[-1], 2)
            frames = [cells_of(frame) for frame in result.dump(f"{group}.dump").frames]
            self.assertEqual([len(frame) for frame in frames], list(inside))
            for before, now in zip(frames, frames[1:]):
                for cell in before:
                    self.assertGreater((now[cell] - before[cell])[:, 0].mean(), 0)


class Surfaces(unittest.TestCase):
    def test_a_region_wider_than_the_vessel(self):
        """The wall's surface keeps cells in, atoms or not: these lie a third of a cell apart."""
        ib = stream_fix(STREAM.replace("hematocrit 0.2", "hematocrit 0.6"))
        ib += "\nregion wide block 16 28 INF INF INF INF"
        result = run(stream(
            **{name: text.replace("rbc/surface tube type 2 spacing 1.2",
                                  "rbc/surface tube type 2 spacing 4") for name, text in
               EMPTY.items()},
            ib=ib.replace("region feed hem", "region wide hem"), run="run 20",
            dump=dump_line(1, columns=DUMP).replace("dump atoms all", "dump atoms cells")))
        frames = [cells_of(frame) for frame in result.dump().frames]
        count = 0
        for before, now in zip(frames, frames[1:]):
            for new in set(now) - set(before):
                x = now[new]
                count += 1
                self.assertLess(np.hypot(x[:, 1] - SIDE / 2, x[:, 2] - SIDE / 2).max(),
                                RADIUS - GAP + 1e-9)
        self.assertGreaterEqual(count, 3)


class Slit(unittest.TestCase):
    """Between walls across z, periodic along y."""
    SIZE = np.array([48.0, 16.0, 20.0])

    def test_new_cells_fit_through_periodic_sides(self):
        box = " ".join(f"0 {size}" for size in self.SIZE)
        stream = STREAM.replace("0.2 molecule", "0.5 molecule").replace(" outlet out last", "")
        lines = dict(
            TUBE, **{**EMPTY, "run": "run 20", "timestep": "timestep 100"},
            box=f"region box block {box}",
            vessel="region tube block 4 44 INF INF 4 16\n"
                   "rbc/surface tube type 2 spacing 1.4 mass 1.0",
            regions="region inlet block INF 12 INF INF INF INF\n"
                    "region outlet block 36 INF INF INF INF INF\n"
                    "region feed block 14 34 INF INF 4.3 15.7",
            inlet=TUBE["inlet"].replace("1.0", "1.2"),
            wall="fix wall wall rbc/wall flow tol 1e-2\nfix mem cells rbc/membrane rbc "
                 "mooney-rivlin 1e-3 1e-3 1e-3 bending 1e-7",
            ib=f"fix ib cells rbc/ib flow integrator midpoint\n{stream} attempts 2000",
            thermo="thermo_style custom step f_stream[1]",
            dump=dump_line(1, columns=DUMP).replace("dump atoms all", "dump atoms cells"))
        frames = [cells_of(frame) for frame in run(scene(lines)).dump().frames]
        images = 0
        for before, now in zip(frames, frames[1:]):
            for new in set(now) - set(before):
                for other in set(now) - {new}:
                    pair = [(now[number], TRIANGLES) for number in (new, other)]
                    gaps = [pair_distances(pair, self.SIZE, [False, wraps, False], 2.0)
                            .min(initial=2) for wraps in (False, True)]
                    self.assertGreater(gaps[1], GAP - 1e-9)
                    images += gaps[1] < gaps[0]
        self.assertGreater(images, 0)


if __name__ == "__main__":
    unittest.main()
