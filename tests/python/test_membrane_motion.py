"""Rates of tumbling and tank-treading from dumps, for motions known in closed form."""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from rbc.membrane_motion import after_half_turns, angles, read_dump, revolutions  # noqa: E402

LONG, SHORT, TILT = 5.0, 1.5, 0.35
STARTS = 2 * np.pi * np.arange(40) / 40


def cell(phase, angle):
    """Frames of points at `phase` on an ellipse in the x-z plane whose long axis is at `angle` to
    x."""
    x, z = LONG * np.cos(phase), SHORT * np.sin(phase)
    return np.stack([7 + x * np.cos(angle) - z * np.sin(angle), np.full_like(x, 2.0),
                     3 + x * np.sin(angle) + z * np.cos(angle)], axis=-1)


class Motion(unittest.TestCase):
    # of the membrane or the shape, backwards as in shear
    turned = np.linspace(0, 2 * np.pi, 401)[:, None]

    def test_tank_treading(self):
        positions = cell(STARTS - self.turned, TILT)
        shape, membrane = angles(positions)
        np.testing.assert_allclose(shape, TILT, atol=1e-12)
        np.testing.assert_allclose(revolutions(positions)[-1], -1, atol=1e-12)
        # Keller and Skalak's membrane (J. Fluid Mech. 120 (1982) 27) turns at 2 a b / (a^2 + b^2)
        # of its frequency; steps of 1/400 of a revolution leave an error of second order
        self.assertAlmostEqual(
            membrane[-1] / (-2 * np.pi) * (LONG**2 + SHORT**2) / (2 * LONG * SHORT), 1, delta=1e-4)

    def test_tumbling(self):
        positions = cell(STARTS + 0 * self.turned, TILT - self.turned)
        shape, membrane = angles(positions)
        for found in (shape[-1] - shape[0], membrane[-1],
                      *(2 * np.pi * revolutions(positions)[-1])):
            self.assertAlmostEqual(found, -2 * np.pi, delta=1e-11)

    def test_whole_half_turns(self):
        # Jeffery's spheroid (Proc. R. Soc. A 102 (1922) 161): tan angle = r tan(-t r / (1 + r^2));
        # half a turn is pi (r + 1/r)
        aspect, time = SHORT / LONG, np.linspace(0, 30, 3001)
        phase = -time * aspect / (1 + aspect**2)
        shape = np.unwrap(2 * np.arctan2(aspect * np.sin(phase), np.cos(phase))) / 2
        half = np.pi * (aspect + 1 / aspect)
        self.assertAlmostEqual(after_half_turns(time, shape), 2 * half, delta=1e-4)
        self.assertEqual(after_half_turns(time[time < half], shape[time < half]),
                         time[time < half][-1])
        self.assertEqual(after_half_turns(time, np.full_like(time, TILT)), time[-1])

    def test_points_near_the_axis_do_not_count(self):
        positions = np.concatenate(
            [cell(STARTS - self.turned, TILT), np.tile([7.1, 0, 3], (401, 1, 1))], axis=1)
        self.assertEqual(revolutions(positions).shape, (401, len(STARTS)))

    def test_dump(self):
        positions = cell(STARTS - self.turned[:2], TILT)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "vertices.dump"
            with open(path, "w") as stream:
                for step, frame in zip((0, 50), positions):
                    stream.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(frame)}\n"
                                 "ITEM: BOX BOUNDS pp pp ff\n0 9\n0 9\n0 9\n"
                                 "ITEM: ATOMS yu id zu xu\n")
                    for i in np.random.default_rng(1).permutation(len(frame)):
                        x, y, z = frame[i].tolist()
                        stream.write(f"{y!r} {i + 1} {z!r} {x!r}\n")
            steps, read = read_dump(path)
        np.testing.assert_array_equal(steps, (0, 50))
        np.testing.assert_array_equal(read, positions)


if __name__ == "__main__":
    unittest.main()
