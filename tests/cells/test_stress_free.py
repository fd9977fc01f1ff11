"""stress-free of fix rbc/membrane: a sheet whose stress-free shape is not that of the cell."""

import unittest
from pathlib import Path

import numpy as np

from lammps_case import POTENTIALS, dump_line, make_template, read_template, run, scene

DISC = POTENTIALS / "rbc_162.mol"
SHEET = "neo-hookean 0.005 area 0.0 0.03 bending 2.0e-4 volume yes"


def spheroid(reduced_volume):
    """Path of a spheroid with area and triangles of the disc."""
    path = Path.cwd() / f"spheroid{reduced_volume}.mol"
    make_template("spheroid", "--reduced-volume", reduced_volume, "--like", DISC, "--output", path)
    return path


def stretched_energy(rest, x, triangles, shear, local):
    """Energy of a neo-Hookean sheet and the local area term, from stretches of the edges' Gram
    matrices."""
    def gram(points):
        edges = points[triangles[:, 1:]] - points[triangles[:, :1]]
        return edges @ edges.transpose(0, 2, 1)
    before, after = gram(rest), gram(x)
    squares = np.linalg.eigvals(np.linalg.solve(before, after)).real
    area = np.sqrt(np.linalg.det(before)) / 2
    J2 = squares.prod(axis=1)
    return ((area * shear / 2 * (squares.sum(axis=1) + 1 / J2 - 3)).sum(),
            (area * local / 2 * (np.sqrt(J2) - 1)**2).sum())


class StressFree(unittest.TestCase):
    def test_own_template_changes_nothing(self):
        membrane = f"fix mem all rbc/membrane rbc {SHEET}"
        lines = dict(dump=dump_line(10), run="run 30")
        for ranks in (1, 2):
            plain = run(scene(membrane=membrane, **lines), ranks)
            own = run(scene(membrane=membrane + " stress-free rbc", **lines), ranks)
            np.testing.assert_array_equal(own.dump().frames, plain.dump().frames)
            np.testing.assert_array_equal(own.thermo["f_mem"], plain.thermo["f_mem"])

    def test_energy_of_the_disc_is_that_of_its_stretches(self):
        x, triangles = read_template(DISC)
        for reduced_volume in (0.9, 1):
            path = spheroid(reduced_volume)
            rest, same = read_template(path)
            np.testing.assert_array_equal(same, triangles)
            sheet, area = stretched_energy(rest, x, triangles, 0.005, 0.03)
            for ranks in (1, 2):
                with self.subTest(reduced_volume, ranks=ranks):
                    thermo = run(scene(
                        before=f"molecule round {path}",
                        membrane=f"fix mem all rbc/membrane rbc {SHEET} stress-free round",
                        thermo="thermo_style custom step f_mem[1] f_mem[2] f_mem[3]"), ranks).thermo
                    np.testing.assert_allclose(thermo["f_mem[1]"], sheet, rtol=1e-10)
                    np.testing.assert_allclose(thermo["f_mem[3]"], area, rtol=1e-9)
                    self.assertLess(thermo["f_mem[2]"][0], 1e-12 * sheet)

    def test_restart_bit_for_bit(self):
        lines = dict(before=f"molecule round {spheroid(0.95)}",
                     membrane=f"fix mem all rbc/membrane rbc {SHEET} stress-free round",
                     dump=dump_line(20))
        whole = run(scene(
            **{**lines, "dump": None, "run": "run 20\nwrite_restart r.restart\n" + lines["dump"] +
               "\nrun 20"}), 2)
        again = run(scene(**lines, units=None, style=f"read_restart {whole.path('r.restart')}",
                          boundary=None, box=None, create_box=None, cells=None, run="run 20"), 2)
        np.testing.assert_array_equal(again.dump().frames, whole.dump().frames)


if __name__ == "__main__":
    unittest.main()
