"""The example's files tell the same of the cells, and the script that reads them."""

import contextlib
import io
import sys
import unittest

import numpy as np

from lammps_case import ROOT
from scene_case import run_example

sys.path.insert(0, str(ROOT / "scripts"))
from rbc.aggregates import mean_classes  # noqa: E402
from rbc.commands import statistics  # noqa: E402
from rbc.tables import read_ave_time, read_table  # noqa: E402


class CellStatistics(unittest.TestCase):
    def test_files_agree(self):
        result = run_example("cell-statistics", 2, strain=0.6, frames=6, gap=0.5)
        cells, classes, sizes = (result.path(f"{name}.dat")
                                 for name in ("cell", "classes", "sizes"))
        members = read_ave_time(result.path("member.dat"))
        table = read_table(sizes)
        counts = [np.unique(frame[:, 0], return_counts=True)[1] for frame in members.data]
        np.testing.assert_allclose(table["c_agg[1]"], [len(sizes) for sizes in counts])
        np.testing.assert_allclose(table["c_agg[3]"], [np.median(sizes) for sizes in counts])
        found = mean_classes(classes)
        expected = [np.histogram(sizes, np.append(found.edges, np.inf))[0] for sizes in counts[1:]]
        # as printed
        np.testing.assert_allclose(found.aggregates, np.mean(expected, axis=0), rtol=1e-5)

        # two stacks of six at the start, each with five pairs of parallel neighbours
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            statistics.main([str(cells), "--aggregates", str(result.path("member.dat")), "--box",
                             *"0 24 0 24 0 24".split(), "--boundary", *"ppf", "-o",
                             str(result.path("statistics"))])
        start, *later = printed.getvalue().splitlines()
        self.assertEqual(start,
                         f"step 0: rouleau order 1.0000, {2 * 10 / 22:.3f} neighbours per cell")
        self.assertEqual(len(later), 6)
        history = read_ave_time(cells)
        paths = read_table(result.path("statistics-paths.dat"))
        for name, path in paths.items():
            if name != "time":
                row = int(name[2:]) - 1
                np.testing.assert_allclose(path, history.column(2 + "xyz".index(name[0]))[:, row],
                                           rtol=1e-6)


if __name__ == "__main__":
    unittest.main()
