"""bench/soak.py: dense blood in pieces and in processes that continue from restart files, here for
some seconds; whether it notices memory that grows and a process that begins elsewhere."""

import csv
import io
import os
import re
import subprocess
import sys
import unittest
from contextlib import redirect_stdout
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from lammps_case import ENVIRONMENT, ROOT

sys.path.insert(0, str(ROOT / "bench"))
import soak  # noqa: E402

OPTIONS = ("--seconds 16 --processes 2 --every 0.2 --steps 4 --frames 20 --length 12 --gap 12 "
           "--growth 2")


def state(step, energy=1.0, smallest=89.0):
    return soak.State([str(step), "2.5", str(smallest), "89.5", str(energy), "1", "0"])


class Short(unittest.TestCase):
    def test_goes_on_and_keeps_its_memory(self):
        folder = Path("short").resolve()
        done = subprocess.run(
            [sys.executable, ROOT / "bench" / "soak.py", "--output", folder, *OPTIONS.split()],
            env={**ENVIRONMENT, **os.environ}, text=True, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, check=False, timeout=300)
        print(f"\n{done.stdout}")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("processes: 2 of 2 ended well", done.stdout)
        self.assertIn("went on from restart files: 1 of 1", done.stdout)
        with open(folder / "soak.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["process"] for row in rows}, {"0", "1"})
        steps = [int(row["step"]) for row in rows]
        self.assertEqual(steps, sorted(steps))
        self.assertGreater(steps[-1], steps[0])
        for row in rows:
            self.assertGreater(min(float(row[f"rank_{rank}_MB"]) for rank in range(2)), 1)
            self.assertLess(float(row["volume_change"]), 1e-4)    # volume yes
        self.assertGreater(float(rows[-1]["output_MB"]), float(rows[0]["output_MB"]))


class Report(unittest.TestCase):
    def found(self, memory, second=state(200)):
        """Whether all is well and what is printed, for the memory of a rank at its samples."""
        arguments = SimpleNamespace(output=Path("report").resolve(), ranks=1, processes=2, growth=1)
        arguments.output.mkdir(exist_ok=True)
        found = soak.Soak(arguments)
        found.ends = [[state(0), state(200)], [second, state(400)]]
        found.rows = [[0, 36 * n, value, 2 * n] + [0] * 5 for n, value in enumerate(memory)]
        printed = io.StringIO()
        with redirect_stdout(printed):
            well = soak.report(found, 2)
        return well, printed.getvalue()

    def test_memory_that_grows(self):
        # 36 s apart, and the first quarter of the steps does not count
        for memory, well, hourly in (([20, 40, *[50] * 30], True, 0),
                                     ([40 + 0.1 * n for n in range(32)], False, 10),
                                     ([40 + 0.01 * n for n in range(32)], True, 1)):
            found, printed = self.found(memory)
            self.assertEqual(found, well, printed)
            numbers = re.search(r"by (\S+) MB per hour at most, by (\S+) MB", printed).groups()
            np.testing.assert_allclose([float(number) for number in numbers],
                                       [hourly, hourly * 23 / 100], atol=1e-9)

    def test_a_process_that_begins_elsewhere(self):
        for second, well in ((state(200), True), (state(201), False),
                             (state(200, energy=1 + 1e-8), False),
                             (state(200, smallest=89 * (1 - 1e-8)), False)):
            self.assertEqual(self.found([50] * 32, second)[0], well)


if __name__ == "__main__":
    unittest.main()
