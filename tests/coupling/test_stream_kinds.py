"""fix rbc/stream: cells of two kinds enter a tube; a region that is wider than the vessel."""

import unittest

import numpy as np

from lammps_case import dump_line, run
from test_ports import TUBE
from test_stream import (CONTACT, DUMP, EMPTY, GAP, MEMBRANE, RADIUS, SIDE, STREAM, cells_of,
                         stream, stream_fix)


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


if __name__ == "__main__":
    unittest.main()
