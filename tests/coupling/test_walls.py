"""fix rbc/wall through LAMMPS: planes and spheres of atoms against closed forms, moving walls."""

import unittest

import numpy as np

from lammps_case import dump_line
from wall_case import AT_REST, BASE, OFFSET, PLATES, VISCOSITY, plane, sphere, walls


def weights(s):
    """peskin4 at s cells from a layer of the grid: distances and weights."""
    r = s % 1
    root = np.sqrt(1 + 4 * r * (1 - r))
    return (np.arange(4) - 1 - r,
            np.array([3 - 2 * r - root, 3 - 2 * r + root, 1 + 2 * r + root, 1 + 2 * r - root]) / 8)


def offset(s):
    """Half the mean distance of two points."""
    x, w = weights(s)
    return 0.5 * (np.outer(w, w) * abs(np.subtract.outer(x, x))).sum()


def mean_square(s):
    x, w = weights(s)
    return w @ x**2


class Planes(unittest.TestCase):
    BOX = (16, 16, 24)

    def test_poiseuille_flow_on_both_sides(self):
        for z in (12.0, 12.3):
            result = walls(self.BOX, plane(self.BOX, z), drive=f"body 1e-4 0 0 {AT_REST}",
                           wall="tol 1e-8", **PLATES)
            # Of the difference equations: u = g / 8 + b y - g y^2 / 2 at y from a plate, in each
            # channel of height h, as the mean of u at -1/2 and 1/2 is 0. The plane feels
            # u(h) + (both shears) d - g r^2 / 2.
            d, spread, h, g = (offset(z - 0.5), mean_square(z - 0.5), np.array([z, 24 - z]),
                               1e-4 / VISCOSITY)
            u = (g / 2 * spread - d * (g * h / 2 + g / 8 / h).sum()) / (1 - d * (1 / h).sum())
            b = (u - g / 8) / h + g * h / 2
            shears = g * h - b
            # sums over cells are integrals but for the curvature, and for the spread of the kink
            flux = (g / 8 * h + b * h**2 / 2 - g * h**3 / 6 + g * h / 24 +
                    shears * (spread / 2 - 1 / 8)).sum()
            self.assertAlmostEqual(result.thermo["f_flow[7]"][0] / (flux / 24), 1, delta=1e-3)
            self.assertAlmostEqual(result.thermo["f_w[1]"][0] / (VISCOSITY * shears.sum() * 256), 1,
                                   delta=1e-3)

    def test_moves_with_a_variable_velocity(self):
        z, steps, dt, final = 11.8, 8, 100.0, 4e-3
        result = walls(self.BOX, plane(self.BOX, z), drive=AT_REST,
                       wall="velocity v_u v_v 0 tol 1e-8", run=f"run {steps}",
                       before=f"variable u equal {final}*step/{steps}\nvariable v equal 1e-3",
                       dump=dump_line(steps, columns="id xu yu zu vx vy vz"), **PLATES)
        start, end = (result.dump()("xu", "yu", "zu", frame=n) for n in (0, -1))
        expected = [final * steps * dt / 2, 1e-3 * steps * dt, 0]
        np.testing.assert_allclose(end - start, np.tile(expected, (256, 1)), atol=1e-12)
        np.testing.assert_allclose(result.dump()("vx", "vy", "vz"),
                                   np.tile([final, 1e-3, 0], (256, 1)))
        both, d = 1 / z + 1 / (24 - z), offset(z - 0.5)
        speeds = final * np.arange(steps + 1) / steps
        np.testing.assert_allclose(result.thermo["f_w[1]"],
                                   -VISCOSITY * speeds / (1 / both - d) * 256, rtol=1e-3, atol=1e-9)
        np.testing.assert_allclose(result.thermo["f_w[2]"],
                                   -VISCOSITY * 1e-3 / (1 / both - d) * 256, rtol=1e-3)

    def test_two_walls_shear_the_fluid_between_them(self):
        # and it carries that outside with it: no force is left in a periodic box
        box, apart = (16, 16, 32), 16
        result = walls(box, plane(box, 8.2), plane(box, 8.2 + apart),
                       groups="group w type 2\ngroup v type 3",
                       wall="tol 1e-8 velocity 1e-3 0 0\nfix v v rbc/wall flow kernel peskin4 "
                            "tol 1e-8 velocity -1e-3 0 0",
                       thermo=BASE["thermo"] + " f_v[1] f_v[8]")
        last = result.thermo
        d = offset(8.2 - 0.5)
        self.assertAlmostEqual(last["f_w[1]"][0], -last["f_v[1]"][0], delta=1e-9)
        # 16 cells to both sides: stress of both sides times 1 / (h / 2 (of two channels) - d)
        self.assertAlmostEqual(last["f_w[1]"][0] / (-VISCOSITY * 256 * 1e-3 / (apart / 4 - d)), 1,
                               delta=1e-3)
        self.assertEqual(last["f_w[8]"][0], last["f_v[8]"][0])


class Spheres(unittest.TestCase):
    def test_torque_in_shear_flow(self):
        # 4 pi eta a^3 times the shear rate in unbounded flow; with the offset of a plane, of second
        # order in 1 / a
        box, radius, rate = (54, 54, 54), 8.0, 1e-4
        u = rate * box[2] / 2
        result = walls(box, sphere((27.1, 27.2, 27.0), radius - OFFSET),
                       drive=f"wall zlo {-u} 0 0 wall zhi {u} 0 0", wall="tol 1e-5", **PLATES)
        expected = 4 * np.pi * VISCOSITY * radius**3 * rate
        self.assertAlmostEqual(result.thermo["f_w[5]"][0] / expected, 1, delta=0.03)
        for n in (1, 2, 3, 4, 6):
            self.assertLess(abs(result.thermo[f"f_w[{n}]"][0]), 0.01 * expected)

    def test_torque_beyond_the_last_image_flag(self):
        # across a side of the box; flags begin anew there once it has crossed 511 boxes
        box, u = (20, 16, 16), 1e-3
        torques = []
        for flags in ("-1*(x>10)", "511*(x>10)-512*(x<=10)"):
            result = walls(box, sphere((10, 8.1, 8.2), 3.5),
                           drive=f"wall zlo {-u} 0 0 wall zhi {u} 0 0", **PLATES,
                           before=f"displace_atoms w move -9 0 0\nvariable f atom {flags}\n"
                                  "set group w image v_f NULL NULL")
            torques.append([result.thermo[f"f_w[{n}]"][0] for n in (4, 5, 6)])
        self.assertGreater(torques[0][1], VISCOSITY * 3.5**3 * u / 8)
        np.testing.assert_allclose(torques[1], torques[0], rtol=1e-9, atol=1e-9 * torques[0][1])

    def test_drag_with_a_mean_velocity(self):
        # Zick & Homsy: 6 pi eta a K U, K = 4.292 at 12.5 %; with the offset of a plane, 2 % per (4
        # dx / a)^2 or so
        n, share = 32, 0.31017525
        radius, mean = share * n, 1e-3
        result = walls((n, n, n), sphere((16.1, 16.2, 16.3), radius - OFFSET),
                       drive=f"mean {mean} 0 0", wall="tol 1e-4")
        expected = 6 * np.pi * VISCOSITY * radius * 4.292 * mean
        self.assertAlmostEqual(result.thermo["f_w[1]"][0] / expected, 1, delta=0.045)
        self.assertAlmostEqual(result.thermo["f_flow[7]"][0] / mean, 1, delta=1e-12)

    def test_moves_through_the_box(self):
        # as often as it crosses a cell its drag is the same; its atoms change tasks and sides of
        # the box
        box, u = (20, 16, 16), 4e-3
        surface = sphere((10, 8.1, 8.2), 3.5)
        results = [walls(box, surface, drive="mean 0 0 0", wall=f"velocity {u} 0 0 tol 1e-6",
                         run="run 100", every="thermo 25", ranks=ranks, neighbor="neighbor 0.5 bin",
                         dump=dump_line(50, columns="id xu yu zu")) for ranks in (1, 2)]
        for result in results:
            moved = result.dump()("xu", frame=-1) - result.dump()("xu", frame=0)
            np.testing.assert_allclose(moved, 40, rtol=1e-12)
            force = result.thermo["f_w[1]"]
            np.testing.assert_allclose(force, force[0], rtol=1e-4)
        np.testing.assert_allclose(results[1].thermo["f_w[1]"], results[0].thermo["f_w[1]"],
                                   rtol=1e-5)


if __name__ == "__main__":
    unittest.main()
