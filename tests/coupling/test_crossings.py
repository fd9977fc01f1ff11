"""Steps in which surfaces of cells pass through each other are taken again, or end the run."""

import re
import unittest

import numpy as np

from lammps_case import (POTENTIALS, SHEAR, attempt, dump_line, in_parallel, read_template, run,
                         scene)

TRIANGLES = np.array(read_template(POTENTIALS / "rbc_162.mol")[1])
VERTICES = 162
CROSSED = (r"surfaces of the cells with molecule IDs 1 and 2 passed through each other near "
           r"\(([-\d.e]+), ([-\d.e]+), ([-\d.e]+)\) at step (\d+)")
REMEDIES = ("likeliest first: smaller forces of fix addforce up, fix addforce down; "
            "a stronger repulsion")
TAKEN_AGAIN = (r"^Pair rbc/jkr: (\d+) steps? (?:was|were) taken again because surfaces of cells "
               "passed")


def pushes(force):
    return (f"group lower molecule 1\ngroup upper molecule 2\n"
            f"fix up lower addforce 0 0 {force}\nfix down upper addforce 0 0 -{force}")


def pressed(stiffness, force=0.002, gap=0.02, **changes):
    """Two cells above each other, pressed together and sheared, with a repulsion of range 0.3."""
    apart = (2.55 + gap) / 2
    lines = dict(
        cells=f"rbc/create rbc single 6 6 {6 - apart}\n"
              f"rbc/create rbc single 6 6 {6 + apart} rotate 175 0 0 1",
        before=f"pair_style rbc/jkr 0.4\npair_coeff * * repulsive {stiffness} 0.3\n" +
        pushes(force), membrane=SHEAR["membrane"].replace("volume yes", "area 1.0 0.05 volume yes"),
        fluid=SHEAR["fluid"].replace("zlo 0 0 0", "zlo -0.003 0 0").replace("0.0012", "0.003"),
        ib="fix ib all rbc/ib flow integrator rkc auto", timestep="timestep 100", run="run 40",
        thermo="thermo_style custom step f_ib[8] f_ib[10]", dump=dump_line(1))
    lines.update(changes)
    return scene(**lines)


def pierced(x, y):
    """How many edges of the cell x pass through a triangle of the cell y, from the signs of the
    volumes of tetrahedra (Segura and Feito 2001)."""
    edges = np.unique(
        np.sort(np.concatenate([TRIANGLES[:, [n, (n + 1) % 3]] for n in range(3)]), axis=1), axis=0)
    p, q = x[edges[:, 0]][:, None], x[edges[:, 1]][:, None]
    a, b, c = (y[TRIANGLES[:, n]][None] for n in range(3))

    def volume(o, u, v, w):
        return ((u - o) * np.cross(v - o, w - o)).sum(axis=-1)

    none = 1e-12    # of four points in a plane
    ends = np.stack([volume(p, a, b, c), -volume(q, a, b, c)])
    turns = np.stack([volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)])
    return sum(
        np.count_nonzero((sign * ends > none).all(axis=0) & (sign * turns > none).all(axis=0))
        for sign in (1, -1))


def crossings(dump):
    """Of both cells, for each frame."""
    frames = [dump.positions(frame) for frame in range(len(dump.frames))]
    cells = [(x[:VERTICES], x[VERTICES:]) for x in frames]
    return [pierced(lower, upper) + pierced(upper, lower) for lower, upper in cells]


class Crossings(unittest.TestCase):
    def test_ends_the_run(self):
        # next to no repulsion: no way of taking the step helps
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result = attempt(pressed(1e-6), ranks)
                self.assertEqual(result.code, 1)
                self.assertRegex(result.error, r"^Pair rbc/jkr: " + CROSSED +
                                 r" \(so also when the step was taken "
                                 f"again, 6 times, .*{REMEDIES} .*a timestep shorter than 100")
                *place, step = (float(word) for word in re.search(CROSSED, result.error).groups())
                last = result.dump().positions()
                self.assertLess(np.linalg.norm(last - place, axis=1).min(), 0.5)
                counts = crossings(result.dump())
                self.assertEqual(len(counts), step)    # of steps 0 to step - 1
                self.assertEqual(max(counts), 0)

    def test_without_a_second_way(self):
        for ib in ("integrator rkc 8", "integrator euler"):
            with self.subTest(ib):
                result = attempt(pressed(1e-6, ib=f"fix ib all rbc/ib flow {ib}",
                                         timestep="timestep 25",
                                         every="thermo 50", run="run 300", dump=dump_line(4)))
                self.assertEqual(result.code, 1)
                self.assertRegex(result.error, "^Pair rbc/jkr: " + CROSSED +
                                 rf"\. What may help, {REMEDIES}.*; integrator rkc auto; adapt")

    def test_taken_again(self):
        # a shorter step finds the repulsion in time
        case = pressed(0.01, force=0.004, gap=0.05,
                       ib="fix ib all rbc/ib flow integrator rkc auto adapt 0.02 100",
                       run="run 30\nthermo_style one\nunfix ib\nrun 0")
        for result in in_parallel(run, [(case, 1), (case, 2)]):
            again, = (int(number) for number in re.findall(TAKEN_AGAIN, result.printed,
                                                           re.MULTILINE))
            self.assertGreater(again, 0)
            self.assertGreaterEqual(result.tables()[0]["f_ib[10]"][-1], again)
            self.assertEqual(max(crossings(result.dump())), 0)

    def test_not_without_need(self):
        result = run(pressed(0.3))
        self.assertNotRegex(result.printed, "taken again|WARNING: Pair")
        self.assertEqual(result.thermo["f_ib[8]"][-1], 0)
        self.assertEqual(max(crossings(result.dump())), 0)

    def test_of_any_style_of_hybrid(self):
        for first, second in (("none", "repulsive 1e-6 0.3"), ("repulsive 1e-6 0.3", "none")):
            with self.subTest(first=first):
                styles = ("pair_style hybrid/overlay rbc/jkr 0.4 rbc/jkr 0.4\n"
                          f"pair_coeff * * rbc/jkr 1 {first}\npair_coeff * * rbc/jkr 2 {second}\n")
                result = attempt(pressed(0, before=styles + pushes(0.002)))
                self.assertEqual(result.code, 1)
                self.assertRegex(result.error, "^Pair rbc/jkr: " + CROSSED)
                self.assertEqual(max(crossings(result.dump())), 0)

    def test_by_one_of_equal_styles(self):
        styles = ("pair_style hybrid/overlay rbc/jkr 0.4 rbc/jkr 0.4\n"
                  "pair_coeff * * rbc/jkr 1 repulsive 0.01 0.3\n"
                  "pair_coeff * * rbc/jkr 2 repulsive 0.01 0.3\n")
        result = run(pressed(0, gap=-0.3, before=styles + pushes(0.002), run="run 1"))
        self.assertEqual(result.printed.count("surfaces of 1 pair of cells cross at the start"), 1)

    def test_cells_that_do_not_touch_may_cross(self):
        kinds = ("mass * 1.0\ngroup second id > 162\nset group second type 2\n"
                 "pair_style rbc/jkr 0.4\n"
                 "pair_coeff * * repulsive 1e-6 0.3\npair_coeff 1 2 none\n")
        case = pressed(1e-6, create_box="create_box 2 box angle/types 1", last=kinds)
        result = run(case)
        self.assertGreater(crossings(result.dump())[-1], 0)
        self.assertNotIn("taken again", result.printed)

    def test_cells_that_cross_at_the_start(self):
        for ranks in (1, 2):
            result = run(pressed(0.01, gap=-0.3, run="run 5"), ranks)
            self.assertRegex(
                result.printed,
                r"WARNING: Pair rbc/jkr: surfaces of 1 pair of cells cross at the start of "
                r"the run, first those of the cells with molecule IDs 1 and 2; ")
            self.assertGreater(crossings(result.dump())[0], 0)


if __name__ == "__main__":
    unittest.main()
