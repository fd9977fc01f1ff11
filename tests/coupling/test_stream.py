"""fix rbc/stream through LAMMPS: cells enter a closed tube and leave it. Counts, volumes, places of
new cells, other styles, restart, tasks, errors."""

import re
import unittest

import numpy as np

from error_case import BadInput
from lammps_case import POTENTIALS, attempt, dump_line, in_parallel, read_template, run
from rbc.surface_distances import pair_distances
from test_ports import MARGIN, TUBE, tube

RADIUS, LENGTH = 6, 52
H, FLOW, DT, GAP = 0.2, 0.3, 100, 0.2
SHAPE, TRIANGLES = read_template(POTENTIALS / "rbc_162.mol")
CORNERS = SHAPE[TRIANGLES]
VOLUME = np.einsum("ij,ij->", CORNERS[:, 0], np.cross(CORNERS[:, 1], CORNERS[:, 2])) / 6
FEED = (MARGIN + 2 * RADIUS, MARGIN + 4 * RADIUS)    # along x
LAST = MARGIN + LENGTH - 2 * RADIUS - 4
SIDE = 2 * (RADIUS + MARGIN)

MEMBRANE = ("fix mem cells rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
            "crease 0.04 45 stretch 0.02 2.5 area 0.5 0.5 volume yes")
CONTACT = ("pair_style rbc/jkr 0.9 walls tube\npair_coeff * * none\n"
           "pair_coeff 1 1 repulsive 0.5 0.8")
REGIONS = (f"region feed cylinder x {SIDE / 2} {SIDE / 2} {RADIUS - 0.3} {FEED[0]} {FEED[1]}\n"
           f"region last block {LAST} INF INF INF INF INF")
STREAM = (f"fix stream cells rbc/stream in region feed hematocrit {H} molecule rbc seed 5 "
          f"outlet out last overlap {GAP}")
NAMES = ("in", "out", "inside", "owed", "H in", "H out", "V in", "V out", "out 1", "H 1", "V 1")
COLUMNS = [f"f_stream[{n + 1}]" for n in range(len(NAMES))]
DUMP = "id mol xu yu zu"


def stream_fix(line):
    return f"fix ib cells rbc/ib flow integrator rkc auto\n{REGIONS}\n{line}"


def stream(**changes):
    """A tube with a cell in the middle, and one that is about to leave."""
    ports = {name: TUBE[name].replace("flow 1.0", f"flow {FLOW}") for name in ("inlet", "outlet")}
    more = (f"molecule rbc {POTENTIALS}/rbc_162.mol\n"
            f"rbc/create rbc single {LAST - 8} {SIDE / 2} {SIDE / 2} rotate 90 0 1 0\n"
            f"rbc/create rbc single {LAST - 1} {SIDE / 2} {SIDE / 2} rotate 90 0 1 0")
    return tube(RADIUS, LENGTH, **{
        "more": more, "wall": f"{TUBE['wall']}\n{MEMBRANE}\n{CONTACT}", **ports,
        "neighbor": f"{TUBE['neighbor']}\natom_modify sort 0 0.0", "ib": stream_fix(STREAM),
        "thermo": "thermo_style custom step atoms " + " ".join(COLUMNS),
        "timestep": f"timestep {DT}", **changes})


EMPTY = dict(more=f"molecule rbc {POTENTIALS}/rbc_162.mol",
             groups="group wall type 2\ngroup cells empty")


def cells_of(frame):
    """Molecule ID -> positions in the order of atom IDs, of rows as in DUMP of the cells."""
    return {int(m): frame[frame[:, 1] == m][:, 2:] for m in np.unique(frame[:, 1])}


class Stream(unittest.TestCase):
    STEPS = 130

    @classmethod
    def setUpClass(cls):
        more = ("compute cell cells rbc/cell\ncompute agg cells rbc/aggregate 0.5\n"
                "variable least equal min(c_cell[6])\nvariable most equal max(c_cell[6])\n"
                "fix vtk cells rbc/vtk 40 cells.*.vtp")
        dump = dump_line(1, columns=DUMP).replace("dump atoms all", "dump atoms cells")
        cls.result = run(stream(
            ib=f"{stream_fix(STREAM)}\n{more}", dump=dump, run=f"run {cls.STEPS}",
            thermo=f"thermo_style custom step atoms {' '.join(COLUMNS)} v_least v_most c_agg[1]"))
        cls.table = cls.result.thermo
        cls.number = dict(zip(NAMES, (cls.table[column] for column in COLUMNS)))
        dump = cls.result.dump()
        cls.steps, cls.frames = dump.steps, [cells_of(frame) for frame in dump.frames]

    def test_the_hematocrit_that_enters(self):
        step = self.table["Step"]
        np.testing.assert_allclose(self.number["V in"], FLOW * DT * step, rtol=1e-12)
        wanted = H * self.number["V in"] / VOLUME
        np.testing.assert_allclose(self.number["owed"], wanted - self.number["in"], atol=1e-6)
        print(f"\nentered {self.number['in'][-1]:.0f}, left {self.number['out'][-1]:.0f}, "
              f"owed at most {self.number['owed'].max():.3f}")
        # half a cell, a step, and what waits for room
        self.assertLess(abs(self.number["owed"]).max(), 1)
        self.assertGreaterEqual(self.number["in"][-1], 5)
        self.assertGreaterEqual(self.number["out"][-1], 2)

    def test_counts_and_volumes_belong_together(self):
        number = self.number
        np.testing.assert_array_equal(number["inside"] - number["inside"][0],
                                      number["in"] - number["out"])
        wall = self.table["Atoms"][0] - 2 * len(SHAPE)
        np.testing.assert_array_equal(self.table["Atoms"], wall + len(SHAPE) * number["inside"])
        for name in ("in", "out"):
            with self.subTest(name):
                last = [number[f"{what} {name}"][-1] for what in ("H", "V")]
                self.assertAlmostEqual(last[0] * last[1] / VOLUME, number[name][-1], delta=1e-6)
        np.testing.assert_array_equal(number["out"], number["out 1"])
        np.testing.assert_allclose(number["V out"], number["V in"], rtol=1e-12)
        self.assertLess(abs(self.table["v_least"] / VOLUME - 1).max(), 1e-3)
        self.assertLess(abs(self.table["v_most"] / VOLUME - 1).max(), 1e-3)

    def test_no_cell_is_lost_or_cut(self):
        self.assertEqual(self.steps, list(range(self.STEPS + 1)))
        seen = set()
        for before, now in zip(self.frames, self.frames[1:]):
            seen |= set(before)
            for cell in now.values():
                self.assertEqual(len(cell), len(SHAPE))
            for gone in set(before) - set(now):
                # in a step the centre moves by less than the fastest fluid
                move = 2 * FLOW * DT / (np.pi * RADIUS**2)
                self.assertGreater(before[gone][:, 0].mean(), LAST - move)
            for kept in set(before) & set(now):
                self.assertLess(now[kept][:, 0].mean(), LAST)
                self.assertLess(abs(now[kept] - before[kept]).max(), 1)
            self.assertFalse((set(now) - set(before)) & seen, "an ID was given twice")

    def test_new_cells_fit(self):
        own = np.linalg.norm(SHAPE[:, None] - SHAPE[None], axis=2)
        turns = []
        for before, now in zip(self.frames, self.frames[1:]):
            for new in set(now) - set(before):
                x = now[new]
                apart = np.linalg.norm(x[:, None] - x[None], axis=2)
                np.testing.assert_allclose(apart, own, atol=1e-9)
                turns.append(np.linalg.lstsq(SHAPE, x - x.mean(axis=0), rcond=None)[0])
                self.assertGreaterEqual(x[:, 0].min(), FEED[0] + GAP / 2)
                self.assertLessEqual(x[:, 0].max(), FEED[1] - GAP / 2)
                r = np.hypot(x[:, 1] - SIDE / 2, x[:, 2] - SIDE / 2)
                self.assertLess(r.max(), RADIUS - 0.3 - GAP / 2 + 1e-9)
                for other in set(now) - {new}:
                    gaps = np.linalg.norm(x[:, None] - now[other][None], axis=2)
                    self.assertGreater(gaps.min(), GAP)
        self.assertEqual(len(turns), self.number["in"][-1])
        self.assertGreater(abs(turns[0] - turns[1]).max(), 0.1)

    def test_surfaces_of_the_cells_that_are_there(self):
        for step in (0, 40, 80, 120):
            text = self.result.path(f"cells.{step}.vtp").read_bytes()
            polygons = int(re.search(rb'NumberOfPolys="(\d+)"', text).group(1))
            self.assertEqual(polygons, len(TRIANGLES) * self.number["inside"][step])


class Empty(unittest.TestCase):
    RANKS = (1, 4)

    def test_a_tube_that_fills_and_one_that_drains(self):
        for ranks in self.RANKS:
            table = run(stream(**EMPTY, run="run 40"), ranks).thermo
            inside = table["f_stream[3]"]
            self.assertEqual(inside[0], 0)
            self.assertEqual(inside[-1], table["f_stream[1]"][-1])
            self.assertGreaterEqual(inside[-1], 2)
        drained = run(stream(ib=stream_line(hematocrit=1e-6), run="run 130")).thermo
        self.assertEqual(list(drained["f_stream[3]"][[0, -1]]), [2, 0])


def stream_line(**words):
    """The fixes of STREAM with the value of some keywords changed."""
    line = STREAM
    for word, value in words.items():
        line = re.sub(rf"\b{word} \S+", f"{word} {value}", line)
    return stream_fix(line)


class Flow(unittest.TestCase):
    def test_only_what_enters_counts(self):
        """A flow that goes to and fro, with steps short beside its period."""
        table = run(stream(**EMPTY, variables="variable Q equal 0.4*sin(2*PI*step/40)",
                           inlet=TUBE["inlet"].replace("1.0", "v_Q"), run="run 50")).thermo
        t = np.arange(51)
        forwards = 0.4 * np.maximum(np.sin(2 * np.pi * t / 40), 0)
        volume = DT * np.concatenate([[0], np.cumsum((forwards[1:] + forwards[:-1]) / 2)])
        np.testing.assert_allclose(table["f_stream[7]"], volume, rtol=1e-6, atol=1e-9)

    def test_without_room(self):
        result = run(stream(**EMPTY, ib=stream_line(hematocrit=0.95), run="run 60"))
        self.assertEqual(result.printed.count("there is no room in region feed"), 1)
        self.assertIn("are owed at the end of the run", result.printed)
        table = result.thermo
        owed = table["f_stream[4]"][-1]
        self.assertGreater(owed, 3)
        self.assertAlmostEqual(table["f_stream[1]"][-1] + owed,
                               0.95 * table["f_stream[7]"][-1] / VOLUME, delta=1e-6)
        self.assertLess(table["f_stream[5]"][-1], 0.95)


class Two(unittest.TestCase):
    """Two fixes that fill one region: of each, the cells are due in the same steps."""

    def test_their_cells_are_apart(self):
        line = f"{stream_fix(STREAM)}\n" + STREAM.replace("fix stream", "fix other").replace(
            "seed 5", "seed 9")
        dump = dump_line(1, columns=DUMP).replace("dump atoms all", "dump atoms cells")
        result = run(stream(**EMPTY, ib=line, dump=dump, run="run 45",
                            thermo="thermo_style custom step f_stream[1] f_other[1]"))
        entered = np.array([result.thermo["f_stream[1]"], result.thermo["f_other[1]"]])
        together = np.flatnonzero((np.diff(entered) > 0).all(axis=0)) + 1
        self.assertGreater(len(together), 0)
        for step in together:
            cells = [(x, TRIANGLES) for x in cells_of(result.dump().frames[step]).values()]
            gaps = pair_distances(cells, np.full(3, 1e3), [False] * 3, 1.0)
            self.assertGreater(gaps.min(initial=1), GAP - 1e-9)


def check_pieces(test, steps, all_ranks, **changes):
    """A run in pieces, or continued from a restart file, is that of one piece, in which cells enter
    all the time."""
    columns = "id mol xu yu zu vx vy vz"
    begin = stream(every=f"thermo {steps}", run="", dump="", **changes)
    after = after_restart(begin)
    script = (f"{begin}{dump_line(2 * steps, 'whole', columns)}\nrun {2 * steps}\nclear\n"
              f"{begin}{dump_line(2 * steps, 'pieces', columns)}\n"
              f"run {steps}\nwrite_restart r\nrun {steps}\nclear\n"
              f"read_restart r\n{after}\n{dump_line(2 * steps, 'after', columns)}\n"
              f"run {steps}\n")
    for ranks in all_ranks:
        result = run(script, ranks)
        tables = result.tables()
        test.assertGreater(tables[0][COLUMNS[0]][-1], tables[1][COLUMNS[0]][-1])
        test.assertGreater(tables[1][COLUMNS[0]][-1], 0)
        whole = result.dump("whole").frames[-1]
        for name, table in (("pieces", tables[2]), ("after", tables[3])):
            with test.subTest(name, ranks=ranks):
                np.testing.assert_array_equal(result.dump(name).frames[-1], whole)
                for column in COLUMNS:
                    test.assertEqual(table[column][-1], tables[0][column][-1])


class Restart(unittest.TestCase):
    STEPS, RANKS = 30, (1, 2)

    def test_a_run_in_pieces_is_that_of_one_piece(self):
        check_pieces(self, self.STEPS, self.RANKS)

    def test_other_outlets(self):
        begin = stream(run="", dump="")
        result = attempt(f"{begin}\nrun 0\nwrite_restart r\nunfix stream\nclear\nread_restart r\n"
                         f"{after_restart(begin).replace(' outlet out last', '')}\nrun 0")
        self.assertIn("is of one with another number of outlets than 0", result.error)


def after_restart(script):
    created = ("units", "atom_style", "boundary", "region box", "create_box", "rbc/create",
               "rbc/surface", "mass")
    return "\n".join(line for line in script.splitlines() if not line.startswith(created))


def check_tasks(test, steps, **changes):
    """The same cells come and go on any number of tasks."""
    wall = f"{TUBE['wall'].replace('tol 1e-4', 'tol 1e-11')}\n{MEMBRANE}\n{CONTACT}"
    dump = dump_line(steps, columns=DUMP)
    results = [run(stream(wall=wall, dump=dump, run=f"run {steps}", **changes), ranks)
               for ranks in (1, 2, 4)]
    test.assertGreater(results[0].thermo[COLUMNS[0]][-1], 0)
    test.assertGreater(results[0].thermo[COLUMNS[1]][-1], 0)
    for result in results[1:]:
        for column in COLUMNS:
            np.testing.assert_allclose(result.thermo[column], results[0].thermo[column],
                                       rtol=1e-9, atol=1e-9)
        frames = [one.dump().frames[-1] for one in (result, results[0])]
        np.testing.assert_array_equal(frames[0][:, :2], frames[1][:, :2])
        apart = abs(frames[0] - frames[1]).max()
        print(f"\napart {apart:.2g}")
        test.assertLess(apart, 1e-6)


class Tasks(unittest.TestCase):
    def test_any_number_of_them(self):
        check_tasks(self, 30)


class OtherStyles(unittest.TestCase):
    def test_rows_of_cells_cannot_be_averaged(self):
        result = attempt(stream(
            dump="compute cell cells rbc/cell\n"
                 "fix mean cells ave/time 10 3 30 c_cell[6] mode vector file rows ave running",
            run="run 60"))
        self.assertIn("while fix mean averages them over steps", result.error)

    def test_the_count_outlives_the_membranes(self):
        lines = ["run 1", "print 'inside $(f_stream[3])'", "unfix mem",
                 "print 'then $(f_stream[3])'"]
        result = run(stream(run="\n".join(lines), thermo="thermo_style one"))
        self.assertIn("inside 2\n", result.printed)
        self.assertIn("then 0\n", result.printed)

    def test_bonds_go_with_the_cells(self):
        box = ("create_box 2 box bond/types 1 angle/types 1 extra/bond/per/atom 2 "
               "extra/special/per/atom 4")
        bond = ("bond_style zero\nbond_coeff 1\nvariable first equal count(wall)+1\n"
                "variable second equal count(wall)+163")
        result = run(stream(
            create_box=box, dump=bond,
            thermo="thermo_style custom step atoms bonds f_stream[2]",
            run="create_bonds single/bond 1 $(v_first:%.0f) $(v_first+1:%.0f)\n"
                "create_bonds single/bond 1 $(v_second:%.0f) $(v_second+1:%.0f)\n"
                "run 15")).thermo
        self.assertEqual(list(result["Bonds"][[0, -1]]), [2, 1])


ERRORS = {
    "port missing": ("fix stream cells rbc/stream", ["rbc/stream", "missing"]),
    "no such port": (STREAM.replace("stream in", "stream there"),
                     ["Fix rbc/stream stream: there is no fix rbc/port with ID there"]),
    "no port but a fix": (STREAM.replace("stream in", "stream flow"),
                          ["Fix rbc/stream stream: there is no fix rbc/port with ID flow"]),
    "no such outlet": (STREAM.replace("outlet out", "outlet there"),
                       ["Fix rbc/stream stream: there is no fix rbc/port with ID there"]),
    "inlet and outlet in one": (STREAM.replace("outlet out", "outlet in"),
                                ["fix rbc/port in is named twice"]),
    "no region": (STREAM.replace("region feed ", ""), ["Fix rbc/stream stream needs region"]),
    "no hematocrit": (STREAM.replace(f"hematocrit {H} ", ""),
                      ["Fix rbc/stream stream needs hematocrit"]),
    "no molecule": (STREAM.replace("molecule rbc ", ""), ["Fix rbc/stream stream needs molecule"]),
    "no seed": (STREAM.replace("seed 5 ", ""), ["Fix rbc/stream stream needs seed"]),
    "hematocrit of 1": (STREAM.replace(f"hematocrit {H}", "hematocrit 1"),
                        ["fix rbc/stream hematocrit", "1", "between 0 and 1"]),
    "seed 0": (STREAM.replace("seed 5", "seed 0"), ["fix rbc/stream seed", "0", "> 0"]),
    "unknown keyword": (STREAM + " speed 1", ["fix rbc/stream", "speed", "region, hematocrit"]),
    "outlet without a region": (STREAM.replace(f"outlet out last overlap {GAP}", "outlet out"),
                                ["fix rbc/stream outlet", "missing"]),
    "overlap 0": (STREAM.replace(f"overlap {GAP}", "overlap 0"),
                  ["fix rbc/stream overlap", "0", "> 0"]),
    "no attempts": (STREAM + " attempts 0", ["fix rbc/stream attempts", "0", "> 0"]),
    "periodic along no side": (STREAM + " periodic w",
                               ["fix rbc/stream periodic", "w", "x, y, z, -x, -y, -z"]),
    "every 0": (STREAM + " every 0", ["fix rbc/stream every", "0", "> 0"]),
    "type 3": (STREAM + " type 3", ["fix rbc/stream type", "3"]),
    "group all": (STREAM.replace("stream cells", "stream all"),
                  ["Fix rbc/stream stream cannot use group all"]),
    "another group": ("group some id 1:5\n" + STREAM.replace("stream cells", "stream some"),
                      ["there is no fix rbc/membrane of its group, some"]),
    "cells of another template": (
        f"molecule fine {POTENTIALS}/rbc_642.mol\n"
        + STREAM.replace("molecule rbc", "molecule fine"),
        ["its molecule must have the triangles of that of fix rbc/membrane mem"]),
    "no such template": (STREAM.replace("molecule rbc", "molecule cell"),
                         ["Molecule template ID cell for fix rbc/stream molecule does not exist"]),
    "no such region": (STREAM.replace("region feed", "region there"),
                       ["Region ID there for fix rbc/stream stream does not exist"]),
    "no such region of an outlet": (
        STREAM.replace("outlet out last", "outlet out there"),
        ["Region ID there for fix rbc/stream stream outlet does not exist"]),
    "region outside of the vessel": (
        f"region beside block {FEED[0]} {FEED[1]} 0 2 0 2\n" + STREAM.replace("feed", "beside"),
        ["Region beside for fix rbc/stream stream lies outside of the vessel, region tube of fix "
         "rbc/fluid flow"]),
    "empty region": ("region none block -9 -8 0 1 0 1\n" + STREAM.replace("feed", "none"),
                     ["Region none for fix rbc/stream stream holds nothing"]),
    "region that moves": (
        "variable z equal 0\nregion moving block 20 30 8 12 8 12 move v_z v_z v_z\n"
        + STREAM.replace("region feed", "region moving"),
        ["Region moving for fix rbc/stream stream must not move"]),
}


class Errors(BadInput):
    def test_bad_input(self):
        def attempt_one(name):
            return attempt(stream(ib=stream_fix(ERRORS[name][0]), thermo="thermo_style one"))
        for name, result in zip(ERRORS, in_parallel(attempt_one, [(name,) for name in ERRORS])):
            with self.subTest(name):
                self.refused(result, ERRORS[name][1])

    def test_cells_that_nothing_moves(self):
        line = "\n".join(stream_fix(STREAM).splitlines()[1:])
        self.refused(attempt(stream(ib=line)),
                     ["new cells would not be moved: there is no fix rbc/ib of fix rbc/fluid flow"])

    def test_a_group_that_changes(self):
        line = stream_fix(STREAM).replace(
            "fix ib cells", "group moved dynamic all region tube\nfix ib moved")
        self.refused(attempt(stream(**EMPTY, ib=line)),
                     ["group moved of fix rbc/ib ib must not be dynamic"])

    def test_before_the_flow_is_known(self):
        first, *others = stream_fix(STREAM).splitlines()
        line = "\n".join([*others, first])
        self.refused(attempt(stream(ib=line)), ["must be defined after fix rbc/ib ib"])

    def test_minimize(self):
        self.refused(attempt(stream(run="minimize 0 0 1 1")), ["minimize"])


if __name__ == "__main__":
    unittest.main()
