"""What a rank holds and sends does not grow with the cells of other ranks: a row of ranks, each
with as many cells, that is made longer. A list of all cells on every rank would grow with it."""

import os
import re
import unittest
from unittest import mock

import numpy as np

from lammps_case import POTENTIALS, SHEAR, run, scene

FEW, MANY = 4, 16         # ranks
SIDE, SPACING = 4, 3.2    # cells of a rank along each axis, and from one to the next
WIDTH = SIDE * SPACING
STEP = 0.3                # of all cells along the row: they pass from rank to rank
KINDS = "lammps", "shared_cells", "collective"    # of messages


def places(ranks):
    """Files with those of cells on a lattice, in an order in which neighbors have nothing in
    common."""
    axes = np.arange(SIDE * ranks), np.arange(SIDE), np.arange(SIDE)
    lattice = SPACING * (np.stack(np.meshgrid(*axes), -1).reshape(-1, 3) + 0.5)
    np.random.default_rng(1).shuffle(lattice)
    first, *others = (f"{x} {y} {z}\n" for x, y, z in lattice)
    return {"first.txt": first, "others.txt": "".join(others)}


def row(ranks, runs, more=""):
    """The script: cells that do not touch, with all that knows cells but computes with a row for
    each of them. Molecule IDs are 1 and high ones, as in a long stream that one cell has not
    left."""
    return scene(
        box=f"region box block 0 {WIDTH * ranks} 0 {WIDTH} 0 {WIDTH}", boundary="boundary p p p",
        style="atom_style molecular\natom_modify map hash",    # LAMMPS's other one is such a list
        processors="processors * 1 1", neighbor="neighbor 1.0 bin\nneigh_modify every 1 check no",
        create_box="create_box 1 box angle/types 1\nmass 1 1",
        molecule=f"molecule cell {POTENTIALS}/platelet_42.mol",
        cells="rbc/create cell file first.txt\nset group all mol 1000000\n"
              "group first molecule 1000000\nrbc/create cell file others.txt\n"
              f"set group first mol 1\nvelocity all set {STEP} 0 0",
        before="pair_style rbc/jkr 0.4\npair_coeff 1 1 repulsive 0.001 0.3\nfix move all nve",
        membrane="fix mem all rbc/membrane cell mooney-rivlin 1e-9 1e-10 1e-10", fluid=None,
        ib=None, compute=more, thermo="thermo_style custom step atoms", timestep="timestep 1",
        run="run 10\n" * runs)


def sent(ranks, runs, more=""):
    return counted(row(ranks, runs, more), ranks, places(ranks))


def counted(script, ranks, files=None):
    """Bytes by the rank that sends or gets most, of each kind."""
    with mock.patch.dict(os.environ, LD_PRELOAD=os.environ["COUNT_MESSAGES_LIBRARY"],
                         COUNT_MESSAGES="counted"):
        result = run(script, ranks, files=files)
    rows = [line.split() for line in result.path("counted").read_text().splitlines()]
    most = {words[0]: float(words[4]) for words in rows}
    return np.array([most[kind] for kind in KINDS])


class Row(unittest.TestCase):
    def test_messages_of_a_run(self):
        """The second run of a script, from its start to its end."""
        for name, more in (("cells", ""), ("pieces", "fix out all rbc/vtk 5 cells.*.pvtp")):
            with self.subTest(name):
                each = [sent(ranks, 2, more) - sent(ranks, 1, more)
                        for ranks in (FEW, MANY)]
                print(f"\n{name}: bytes {dict(zip(KINDS, np.transpose(each)))}")
                entry = 4    # bytes of a number for each cell that is more in the row
                cells = SIDE**3 * (MANY - FEW)
                self.assertLess((each[1] - each[0]).sum(), entry * cells)
                self.assertGreater(each[0][KINDS.index("shared_cells")], 0)

    def test_memory(self):
        each = []
        for ranks in FEW, MANY:
            printed = run(row(ranks, 1), ranks, files=places(ranks)).printed
            each.append(float(re.findall(r"memory allocation .* \| (\S+) Mbytes", printed)[-1]))
        print(f"\nMbytes of the largest rank: {each}")
        self.assertLess(abs(each[1] / each[0] - 1), 5e-4)


class OtherAtoms(unittest.TestCase):
    """Beside cells, 1000 for each rank: some of them begin inside a cell, which is looked for."""

    def sent(self, ranks):
        length = 12 * ranks
        return counted(scene(
            box=f"region box block 0 {length} 0 12 0 12", boundary="boundary p p p",
            create_box="create_box 2 box angle/types 1", processors="processors * 1 1",
            cells="\n".join(["mass * 1",
                             *(f"rbc/create rbc single {12 * n + 6} 6 6" for n in range(ranks)),
                             f"create_atoms 2 random {1000 * ranks} 5 box"]),
            before="group cells type 1", membrane=SHEAR["membrane"].replace("all", "cells"),
            fluid="fix flow all rbc/fluid dx 1.5 viscosity 1.5 density 1.025"), ranks)

    def test_collective_messages(self):
        few, many = (self.sent(ranks)[KINDS.index("collective")] for ranks in (2, 6))
        print(f"\nbytes in collective calls: {few:.0f} on 2 ranks, {many:.0f} on 6")
        atom = 24    # bytes of a position
        self.assertLess(many - few, 0.1 * 4000 * atom)


if __name__ == "__main__":
    unittest.main()
