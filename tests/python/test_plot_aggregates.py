"""Histogram and median of aggregates' sizes from files as fix ave/time writes them."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from rbc.aggregates import (  # noqa: E402
    mean_classes, mean_median, sizes_figure, sizes_over_time)
from rbc.commands import aggregates  # noqa: E402
from rbc.errors import InputError  # noqa: E402

ROWS = 6


def write(folder, frames):
    """Files of the sizes of the aggregates at steps 0, 100, ..."""
    with open(folder / "classes.dat", "w") as classes, open(folder / "sizes.dat", "w") as sizes:
        classes.write("# Time-averaged data for fix c\n# TimeStep Number-of-rows\n"
                      "# Row c_a[1] c_a[2] c_a[3]\n")
        sizes.write("# Time-averaged data for fix s\n"
                    "# TimeStep c_a[1] c_a[2] c_a[3] c_a[4] c_a[5]\n")
        for n, frame in enumerate(np.array(sorted(frame)) for frame in frames):
            classes.write(f"{100 * n} {ROWS}\n")
            for row in range(ROWS):
                count = np.count_nonzero((frame >= 2**row) & (frame < 2**(row + 1)))
                classes.write(f"{row + 1} {2**row} {count} {count / len(frame)}\n")
            sizes.write(
                f"{100 * n} {len(frame)} {frame.mean()} {np.median(frame)} {frame.max()} 0\n")


class Aggregates(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)

    def test_geometric_sizes(self):
        # sizes of percolation on a line: 1 - p^(2 n - 1) of the aggregates have fewer than 2 n
        # cells
        p = 0.7
        random = np.random.default_rng(8)
        write(self.folder,
              [np.minimum(random.geometric(1 - p, 4000), 2**ROWS - 1) for _ in range(5)])
        edges = 2.0**np.arange(ROWS)
        for singles in (True, False):
            found = mean_classes(self.folder / "classes.dat").fractions(singles)
            expected = p**(edges - 1) - np.where(edges < edges[-1], p**(2 * edges - 1), 0)
            if not singles:
                expected[0] = 0
            expected /= expected.sum()
            np.testing.assert_allclose(found, expected, atol=5 * np.sqrt(0.25 / 10000))
        self.assertEqual(mean_median(self.folder / "sizes.dat"), (2, 0))    # 1 - p < 1/2 < 1 - p^2

    def test_frames_count_by_their_aggregates(self):
        write(self.folder, [[32], [1] * 30 + [2], [1] * 32])
        np.testing.assert_allclose(mean_classes(self.folder / "classes.dat").fractions(),
                                   np.array([62, 1, 0, 0, 0, 1]) / 64)
        np.testing.assert_allclose(mean_classes(self.folder / "classes.dat", 200).fractions(),
                                   [1, 0, 0, 0, 0, 0])
        np.testing.assert_allclose(mean_classes(self.folder / "classes.dat").fractions(False),
                                   [0, 0.5, 0, 0, 0, 0.5])
        np.testing.assert_array_equal(
            mean_classes(self.folder / "classes.dat", 200).fractions(False), np.zeros(ROWS))
        mean, deviation = mean_median(self.folder / "sizes.dat")
        self.assertAlmostEqual(mean, 34 / 3, delta=1e-12)
        self.assertAlmostEqual(deviation, np.std([32, 1, 1]), delta=1e-12)
        self.assertEqual(mean_median(self.folder / "sizes.dat", 100), (1, 0))

    def test_command(self):
        folders = [self.folder / name for name in ("low", "high")]
        for folder, frame in zip(folders, ([20, 24, 4], [1, 1, 2, 2, 3])):
            folder.mkdir()
            write(folder, [frame, frame])
        cases = [word for rate, folder in zip(("100", "10"), folders[::-1]) for word in
                 ("--case", rate, str(folder / "classes.dat"), str(folder / "sizes.dat"))]
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            aggregates.main([*cases, "-o", str(self.folder / "out.png")])
        self.assertIn("100 /s: median 2 +- 0 cells; % of aggregates from 1: 40.0, 2: 60.0, 4: 0.0",
                      printed.getvalue())
        self.assertIn("10 /s: median 20 +- 0 cells; % of aggregates from 1: 0.0, 2: 0.0, 4: 33.3",
                      printed.getvalue())
        self.assertGreater((self.folder / "out.png").stat().st_size, 5000)

    def test_sizes_over_time(self):
        write(self.folder, [[1] * 12, [1, 2, 2, 7], [12]])
        for start, rows in ((0, slice(0, 3)), (100, slice(1, 3))):
            name, steps, sizes = sizes_over_time(self.folder / "sizes.dat", start=start)
            self.assertEqual((name, steps.tolist()), ("TimeStep", [0, 100, 200][rows]))
            for what, expected in (("number", [12, 4, 1]), ("mean", [1, 3, 12]),
                                   ("median", [1, 2, 12]), ("largest", [1, 7, 12])):
                self.assertEqual(sizes[what].tolist(), expected[rows])
        aggregates.main(["--sizes", str(self.folder / "sizes.dat"), "--timestep", "0.5", "-o",
                         str(self.folder / "out.png")])
        self.assertGreater((self.folder / "out.png").stat().st_size, 5000)
        figure = sizes_figure("time", steps, sizes)
        for panel, largest in zip(figure.axes, (4, 12)):
            self.assertEqual(panel.get_ylim()[0], 0)
            self.assertGreater(panel.get_ylim()[1], largest)
        (self.folder / "some.dat").write_text("# TimeStep v_strain c_a[4]\n5 0.1 7\n10 0.2 8\n")
        name, strain, sizes = sizes_over_time(self.folder / "some.dat", "v_strain")
        self.assertEqual((strain.tolist(), list(sizes)), ([0.1, 0.2], ["largest"]))
        aggregates.main(["--sizes", str(self.folder / "some.dat"), "--x", "v_strain", "-o",
                         str(self.folder / "out.png")])
        with self.assertRaisesRegex(InputError, "there is no v_time; there are TimeStep, v_strain"):
            sizes_over_time(self.folder / "some.dat", "v_time")

    def test_frames_that_are_not_there(self):
        write(self.folder, [[1]])
        for read, name in ((mean_classes, "classes.dat"), (mean_median, "sizes.dat")):
            with self.assertRaisesRegex(InputError, "ends at step 0, before step 100"):
                read(self.folder / name, 100)


if __name__ == "__main__":
    unittest.main()
