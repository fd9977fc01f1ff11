"""Pair statistics and paths of cells for arrangements known in closed form."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from rbc.cell_statistics import Box, pair_statistics, rouleau_order  # noqa: E402
from rbc.commands import statistics  # noqa: E402
from rbc.tables import read_table  # noqa: E402


def box_of(lengths, boundary="ppp"):
    lengths = np.asarray(lengths, dtype=float)
    return Box(np.zeros(3), lengths, np.array([side == "p" for side in boundary]))


def random_directions(shape, random):
    vectors = random.normal(size=(*shape, 3))
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def lattice(sites, number):
    """number^3 cells of side 1, each with the sites."""
    corners = np.stack(np.meshgrid(*3 * [np.arange(number)], indexing="ij"),
                       axis=-1).reshape(-1, 1, 3)
    return (corners + np.asarray(sites)).reshape(-1, 3)


class RadialDistribution(unittest.TestCase):
    def test_shells_of_lattices(self):
        # numbers of neighbours of simple and face-centred cubic lattices
        fcc = [(0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0)]
        for sites, shells in (([(0, 0, 0)], {1: 6, 2**0.5: 12, 3**0.5: 8, 2: 6}),
                              (fcc, {0.5**0.5: 12, 1: 6, 1.5**0.5: 24, 2**0.5: 12})):
            box = box_of([5, 5, 5])
            # wherever the lattice lies and whichever image of a cell is given
            points = lattice(sites, 5) + (0.3, -7.1, 2.2)
            points[::3] += (5, 0, -10)
            edges = np.sort([r + d for r in shells for d in (-0.01, 0.01)])
            axes = np.tile([0.0, 0.0, 1.0], (1, len(points), 1))
            found = pair_statistics(box, points[None], axes, np.append(0, edges))
            np.testing.assert_allclose(found.neighbours[1::2], np.cumsum(list(shells.values())),
                                       rtol=1e-12)
            np.testing.assert_array_equal(found.radial[::2], 0)
            volumes = 4 / 3 * np.pi * np.diff(np.append(0, edges)**3)[1::2]
            expected = np.array(list(shells.values())) / volumes / ((len(points) - 1) / 125)
            np.testing.assert_allclose(found.radial[1::2], expected, rtol=1e-12)

    def test_is_one_for_points_at_random(self):
        # the number of pairs in a shell scatters as its root does
        random = np.random.default_rng(5)
        frames, cells = 40, 200
        for boundary in ("ppp", "ppf", "fff"):
            lengths = np.array([10, 12, 7])
            box = box_of(lengths, boundary)
            points, axes = (random.uniform(0, lengths, (frames, cells, 3)),
                            random_directions((frames, cells), random))
            edges = np.linspace(0, box.longest_distance(), 12)
            found = pair_statistics(box, points, axes, edges)
            shells = (4 / 3 * np.pi * np.diff(edges**3) * box.share_inside(found.middles) /
                      lengths.prod())
            count = frames * cells * (cells - 1) / 2 * shells
            self.assertTrue((np.abs(found.radial - 1) < 5 / np.sqrt(count) + 2e-3).all(),
                            (boundary, found.radial))
            self.assertTrue((np.abs(found.order - 0.5) < 5 / np.sqrt(12 * count)).all(),
                            (boundary, found.order))

    def test_share_inside_a_slab(self):
        # the mean over directions of 1 - r |cos| / H where that is positive
        for height in (3.0, 7.0):
            r = np.array([0.5, 1.0, 3.0, 4.0, 7.0, 10.0])
            expected = np.where(r <= height, 1 - r / (2 * height), height / (2 * r))
            np.testing.assert_allclose(box_of([20, 20, height], "ppf").share_inside(r), expected,
                                       rtol=1e-6)

    def test_share_inside_a_cube(self):
        # covariogram of a cube, averaged over directions, up to its side (Santalo, Integral
        # Geometry): 1 - 3 r / 2 + 2 r^2 / pi - r^3 / (4 pi)
        r = np.array([0.1, 0.5, 1.0])
        np.testing.assert_allclose(box_of([1, 1, 1], "fff").share_inside(r),
                                   1 - 1.5 * r + 2 * r**2 / np.pi - r**3 / (4 * np.pi), atol=1e-3)


class RouleauOrder(unittest.TestCase):
    def stack(self, angles, spacing=2.5, sideways=0.0):
        """Cells one above the other across the side of the box, with short axes at these angles to
        z."""
        angles = np.asarray(angles)
        n = np.arange(len(angles))
        centres = np.column_stack([sideways + 0 * n, 5 + 0 * n, 11 + spacing * n])
        axes = np.column_stack([np.sin(angles), 0 * n, np.cos(angles)])
        return centres[None], axes[None]

    def test_of_stacks(self):
        box = box_of([40, 40, 40])
        for turn in (0, 0.3, np.pi / 3, np.pi / 2, np.pi):
            (cosine, neighbours), = rouleau_order(box, *self.stack(turn * np.arange(8)), 3)
            self.assertAlmostEqual(cosine, abs(np.cos(turn)), delta=1e-14)
            self.assertAlmostEqual(neighbours, 2 * 7 / 8, delta=1e-14)

    def test_across_a_periodic_side(self):
        # a stack that closes on itself has a pair more
        (cosine, neighbours), = rouleau_order(box_of([40, 40, 20]), *self.stack(np.zeros(8)), 3)
        self.assertEqual((cosine, neighbours), (1, 2))
        (_, neighbours), = rouleau_order(box_of([40, 40, 20], "ppf"), *self.stack(np.zeros(8)), 3)
        self.assertEqual(neighbours, 2 * 7 / 8)

    def test_counts_neighbours_of_one_aggregate(self):
        # two stacks side by side, at right angles to each other
        box = box_of([40, 40, 40])
        first, second = self.stack(np.zeros(4)), self.stack(np.full(4, np.pi / 2), sideways=2.0)
        centres, axes = (np.concatenate(both, axis=1) for both in zip(first, second))
        members = np.array([[1] * 4 + [5] * 4])
        self.assertAlmostEqual(rouleau_order(box, centres, axes, 3, members)[0, 0], 1, delta=1e-14)
        self.assertLess(rouleau_order(box, centres, axes, 3)[0, 0], 0.9)

    def test_without_neighbours_is_not_a_number(self):
        (cosine, neighbours), = rouleau_order(box_of([40, 40, 40]), *self.stack(np.zeros(3)), 1)
        self.assertTrue(np.isnan(cosine))
        self.assertEqual(neighbours, 0)


class Command(unittest.TestCase):
    steps = (0, 500, 1000)

    def write(self, folder, centres, axes):
        with open(folder / "cell.dat", "w") as stream:
            stream.write("# Time-averaged data for fix out\n# TimeStep Number-of-rows\n# Row " +
                         " ".join(f"c_cell[{n}]" for n in range(1, 20)) + "\n")
            for step, x, a in zip(self.steps, centres, axes):
                stream.write(f"{step} {len(x)}\n")
                for row, (position, axis) in enumerate(zip(x, a), 1):
                    numbers = [2 * row, *position, *[0] * 9, *axis, 0, 0, 0]
                    stream.write(f"{row} " + " ".join(map(repr, map(float, numbers))) + "\n")
        with open(folder / "member.dat", "w") as stream:
            stream.write("# Time-averaged data for fix m\n# TimeStep Number-of-rows\n"
                         "# Row c_member\n")
            for step in (*self.steps, 1500):
                stream.write(f"{step} {len(centres[0])}\n")
                stream.writelines(f"{row} {2 if row < 4 else 2 * row}\n"
                                  for row in range(1, len(centres[0]) + 1))

    def run_command(self, centres, axes, *options):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.write(folder, centres, axes)
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                statistics.main([str(folder / "cell.dat"), "--box", *"0 20 0 20 0 20".split(),
                                 "--boundary", *"ppf",
                                 "-o", str(folder / "out"), "--timestep", "0.1", *options])
            self.assertGreater((folder / "out.png").stat().st_size, 10000)
            return (printed.getvalue(), read_table(folder / "out-pairs.dat"),
                    read_table(folder / "out-paths.dat"))

    def test_paths_are_the_centres(self):
        random = np.random.default_rng(3)
        centres, axes = random.uniform(0, 20, (3, 10, 3)), random_directions((3, 10), random)
        printed, table, paths = self.run_command(centres, axes, "--molecules", "4", "20")
        self.assertEqual(list(paths), ["time", "x_4", "y_4", "z_4", "x_20", "y_20", "z_20"])
        np.testing.assert_allclose(paths["time"], (0, 50, 100))
        np.testing.assert_allclose(paths["y_4"], centres[:, 1, 1], rtol=1e-7)
        np.testing.assert_allclose(paths["z_20"], centres[:, 9, 2], rtol=1e-7)
        self.assertEqual(len(printed.splitlines()), 3)
        self.assertLess(table["r"][-1], 10)

    def test_samples_different_cells(self):
        random = np.random.default_rng(3)
        centres, axes = random.uniform(0, 20, (3, 30, 3)), random_directions((3, 30), random)
        *_, paths = self.run_command(centres, axes, "--sample", "5", "--from", "1000")
        names = [name for name in paths if name.startswith("z_")]
        self.assertEqual(len(set(names)), 5)
        for name in names:
            np.testing.assert_allclose(paths[name], centres[:, int(name[2:]) // 2 - 1, 2],
                                       rtol=1e-7)

    def test_frames_and_members(self):
        # three cells of one aggregate in a stack and two at right angles to it that are near but
        # not of it
        centres = np.array([[5, 5, 5], [5, 5, 7], [5, 5, 9], [6, 5, 6], [6, 5, 8]], dtype=float)
        axes = np.array([[0, 0, 1]] * 3 + [[1, 0, 0]] * 2, dtype=float)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.write(folder, [centres] * 3, [axes] * 3)
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                statistics.main([str(folder / "cell.dat"), "--box", *"0 20 0 20 0 20".split(),
                                 "--from", "500",
                                 "--neighbours", "2.1", "--aggregates", str(folder / "member.dat"),
                                 "-o", str(folder / "out")])
        self.assertEqual(printed.getvalue().splitlines(),
                         [f"step {step}: rouleau order 1.0000, 0.800 neighbours per cell"
                          for step in (500, 1000)])


if __name__ == "__main__":
    unittest.main()
