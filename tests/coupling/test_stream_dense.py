"""fix rbc/stream where cells are dense: a periodic stretch at 40 percent. Copies and how they are
led, counts, volumes, restart, tasks, errors."""

import unittest

import numpy as np

import test_stream
from error_case import BadInput
from lammps_case import POTENTIALS, attempt, dump_line, in_parallel, run
from rbc.surface_distances import pair_distances
from test_ports import MARGIN
from test_stream import (COLUMNS, DT, DUMP, FLOW, GAP, LAST, RADIUS, SHAPE, SIDE, STREAM, TRIANGLES,
                         VOLUME, cells_of, stream, stream_fix)

H = 0.4
FEED = (MARGIN + 13, MARGIN + 30)    # along x
LEAD = 2 * (np.linalg.norm(SHAPE, axis=1).max() + GAP)
FASTEST = 2 * FLOW * DT / (np.pi * RADIUS**2)    # way of the fluid in a step


def dense(words="periodic x", feed=FEED, filled=0.36):
    """Lines of a stream of 40 percent from a stretch that is filled at first, as the tube behind
    it is."""
    fill = (f"region filled cylinder x {SIDE / 2} {SIDE / 2} {RADIUS - 0.3} {feed[0]} {LAST}\n"
            f"rbc/create rbc hematocrit {filled} seed 3 region filled overlap {GAP}")
    ib = stream_fix(f"{STREAM} {words}").replace(f"hematocrit {test_stream.H}", f"hematocrit {H}")
    old = f"{test_stream.FEED[0]} {test_stream.FEED[1]}"
    return dict(more=f"molecule rbc {POTENTIALS}/rbc_162.mol\n{fill}",
                ib=ib.replace(old, f"{feed[0]} {feed[1]}"))


def led(frame):
    """Copy -> the cell that it has the shape of, and how far behind that it is."""
    found = {}
    for copy, x in frame.items():
        for cell, there in frame.items():
            shift = there - x
            if shift[0, 0] > 1 and abs(shift - shift[0]).max() < 1e-9:
                found[copy] = (cell, shift[0])
    return found


class Stretch(unittest.TestCase):
    STEPS = 90

    @classmethod
    def setUpClass(cls):
        more = ("\ncompute cell cells rbc/cell\nvariable least equal min(c_cell[6])\n"
                "variable most equal max(c_cell[6])")
        lines = dense()
        lines["ib"] += more
        names = [*COLUMNS, "f_stream[12]", "v_least", "v_most"]
        result = run(stream(
            **lines, run=f"run {cls.STEPS}", thermo=f"thermo_style custom step {' '.join(names)}",
            dump=dump_line(1, columns=DUMP).replace("dump atoms all", "dump atoms cells")))
        cls.table = result.thermo
        cls.loops = cls.table["f_stream[12]"]
        cls.entered, cls.left, cls.inside, cls.owed = (cls.table[name] for name in COLUMNS[:4])
        cls.frames = [cells_of(frame) for frame in result.dump().frames]
        cls.led = [led(frame) for frame in cls.frames]

    def test_the_hematocrit_that_enters(self):
        wanted = H * FLOW * DT * self.table["Step"] / VOLUME
        np.testing.assert_allclose(self.owed, wanted - self.entered, atol=1e-6)
        print(f"\nentered {self.entered[-1]:.0f}, owed {self.owed.min():.2f} to "
              f"{self.owed.max():.2f}, loop {self.loops.min():.2f} to {self.loops.max():.2f}")
        self.assertGreater(self.entered[-1], 10)
        self.assertLess(abs(self.owed).max(), 2.5)

    def test_no_cell_is_lost_or_cut(self):
        np.testing.assert_array_equal(self.inside - self.inside[0], self.entered - self.left)
        for frame, copies, inside in zip(self.frames, self.led, self.inside):
            near = sum(cell[:, 0].mean() < FEED[0] + FASTEST for cell in frame.values())
            self.assertLessEqual(len(copies), len(frame) - inside)
            self.assertLessEqual(len(frame) - inside, near)
            self.assertEqual({len(cell) for cell in frame.values()}, {len(SHAPE)})
        for before, now in zip(self.frames, self.frames[1:]):
            for gone in set(before) - set(now):
                self.assertGreater(before[gone][:, 0].mean(), LAST - FASTEST)
            for kept in set(before) & set(now):
                self.assertLess(abs(now[kept] - before[kept]).max(), 1)
        self.assertLess(abs(self.table["v_least"] / VOLUME - 1).max(), 2e-3)
        self.assertLess(abs(self.table["v_most"] / VOLUME - 1).max(), 2e-3)

    def test_new_cells_are_copies_a_loop_or_up_to_a_lead_more_behind(self):
        count = 0
        for before, now, copies, loop in zip(self.frames, self.frames[1:], self.led[1:],
                                             self.loops[1:]):
            for new in set(now) - set(before):
                count += 1
                cell, shift = copies[new]
                self.assertIn(cell, before)
                np.testing.assert_allclose(shift[1:], 0, atol=1e-9)
                self.assertGreater(shift[0], loop - 1e-6)
                self.assertLess(shift[0], loop + 2 * LEAD)
                self.assertGreater(now[new][:, 0].mean(), FEED[0] - LEAD)
                self.assertLess(now[new][:, 0].mean(), FEED[0])
        print(f"\n{count} copies")
        self.assertGreaterEqual(count, self.entered[-1])

    def test_copies_are_led_to_the_beginning(self):
        """They keep their shift, and few are let go before."""
        early = 0
        for before, now, loops in zip(self.led, self.led[1:], zip(self.loops, self.loops[1:])):
            for copy in before:
                if copy in now:
                    self.assertEqual(now[copy][0], before[copy][0])
                    more = [shift[copy][1][0] - loop for shift, loop in zip((before, now), loops)]
                    self.assertAlmostEqual(more[0], more[1], delta=1e-5)
        for before, now, frame in zip(self.led, self.led[1:], self.frames[1:]):
            early += sum(frame[copy][:, 0].mean() < FEED[0] - FASTEST
                         for copy in set(before) - set(now))
        print(f"\n{early} of {self.entered[-1]:.0f} let go before")
        self.assertLess(early, self.entered[-1] / 2)

    def test_copies_are_apart_from_others(self):
        nearest = 1
        for now, copies in zip(self.frames, self.led):
            for copy in copies:
                x = now[copy]
                for cell, there in now.items():
                    if cell in copies or abs(there.mean(axis=0) - x.mean(axis=0)).max() > 9:
                        continue
                    gaps = pair_distances([(x, TRIANGLES), (there, TRIANGLES)], np.full(3, 1e3),
                                          [False] * 3, 1.0)
                    nearest = min(nearest, gaps.min(initial=1))
        self.assertGreater(nearest, GAP / 4 - 1e-9)
        self.assertLess(nearest, 1)


class Pieces(unittest.TestCase):
    def test_a_run_in_pieces_is_that_of_one_piece(self):
        test_stream.check_pieces(self, 20, (1, 2), **dense())


class Tasks(unittest.TestCase):
    STEPS = 25

    def test_any_number_of_them(self):
        test_stream.check_tasks(self, self.STEPS, **dense())


class Errors(BadInput):
    CASES = {
        "short": (dense(feed=(FEED[0], FEED[0] + 12)),
                  ["Fix rbc/stream stream periodic: region feed is 12 long", "or more"]),
        "near the end of the vessel": (
            dense(feed=(MARGIN + 9, MARGIN + 30)),
            ["Fix rbc/stream stream periodic: the vessel must go on straight for",
             "before region feed"])}

    def test_where_the_stretch_lies(self):
        def attempt_one(name):
            return attempt(stream(**self.CASES[name][0], thermo="thermo_style one"))
        results = in_parallel(attempt_one, [(name,) for name in self.CASES])
        for name, result in zip(self.CASES, results):
            with self.subTest(name):
                self.refused(result, self.CASES[name][1])


if __name__ == "__main__":
    unittest.main()
