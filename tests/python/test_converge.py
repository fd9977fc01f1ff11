"""converge.py with a program in the place of LAMMPS, whose values have a known order and limit."""
import csv
import io
import os
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path
from unittest.mock import patch

import numpy as np

import converge
import run_measures
from rbc import mean_with_error, thermo_log
from scene_script import Script

MESHES = "shape=cell_100,cell_200,cell_400"
SCRIPT = Path(converge.__file__)
SCENE = """# a scene
variable  dx    index 0.5    # of the fluid
variable  shape index cell_100
variable  rows  index 100
variable  step  index 0
variable  noise index 0
variable  data  index ./folder
molecule  cell  template.mol
read_data cell add append
thermo_style custom step &
              temp
run       10
thermo_style custom step pe
run       100
"""
# value = 3 + 0.5 dx^1.5 + 4 / vertices; falls from 1 at a rate of 1; noise of a known size; or
# (1 + step^2 / 1000) sin(time), with a line every five steps
LMP = """#!{python}
import math, random, sys
words = sys.argv
values = {{words[n + 1]: words[n + 2] for n, word in enumerate(words) if word == "-var"}}
dx = float(values.get("dx", 0.5))
if values.get("dx") == "0.3":
    print("ERROR: no such thing\\nLast command: run 100")
    sys.exit(3)
vertices = float(values.get("shape", "cell_100").split("_")[1])
value = 3 + 0.5 * dx**1.5 + 4 / vertices
random.seed(dx)
step = float(values.get("step", 0))
print("Step PotEng Step Time v_x\\n0 1 0 0 7\\nLoop time of 1")
print("Step PotEng Step Time v_x")
rows = int(values.get("rows", 10 / step / 5 if step else 100))
for n in range(rows + 1):
    time = 10 * n / rows
    print(n, 1, n, time, value - math.exp(-5 * time) + float(values["noise"]) * random.gauss(0, 1)
          if "noise" in values else (1 + 1e-3 * step**2) * math.sin(time) if step else value)
print("Loop time of 2")
"""


class Converge(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        (self.folder / "in.scene").write_text(SCENE)
        (self.folder / "folder").mkdir()
        (self.folder / "template.mol").write_text("\n")
        lmp = self.folder / "lmp"
        lmp.write_text(LMP.format(python=sys.executable))
        lmp.chmod(0o755)

    def converge(self, *words, measure="v_x"):
        command = [sys.executable, SCRIPT, "in.scene", "--measure", measure, "-o", "out",
                   "--lmp", self.folder / "lmp", *words]
        done = subprocess.run(command, cwd=self.folder, text=True, check=False, timeout=200,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        return done.returncode, done.stdout

    def table(self):
        with open(self.folder / "out" / "converge.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_order_limit_and_errors(self):
        code, printed = self.converge("--vary", "dx=0.8,0.6,0.4", MESHES,
                                      "--within", "0.25")
        self.assertEqual(code, 0, printed)
        self.assertIn("dx: order 1.50\n", printed)
        self.assertIn("shape: order 2.00\n", printed)
        self.assertIn("limit 3, from the finest value 3.13649 with an error below", printed)
        self.assertIn("cheapest run with an error below 0.25: dx=0.4 ", printed)
        self.assertRegex(printed, r"most of the error bound of v_x at dx=0.4 shape=cell_\d+: dx\n")
        rows = self.table()
        self.assertEqual(len(rows), 5)
        for row in rows:
            error = float(row["value"]) - 3
            self.assertAlmostEqual(float(row["from_limit"]), error, places=4)
            self.assertTrue(1.2 * error < float(row["error_below"]) < 1.6 * error)
        self.assertTrue((self.folder / "out" / "converge.png").exists())

    def test_grid(self):
        code, printed = self.converge("--vary", "dx=0.8,0.6,0.4", MESHES,
                                      "--grid")
        self.assertEqual(code, 0, printed)
        self.assertEqual(len(self.table()), 9)

    def test_a_run_that_fails(self):
        """The others go on; without the finest the rest is compared."""
        code, printed = self.converge("--vary", "dx=0.8,0.6,0.4,0.3")
        self.assertEqual(code, 1)
        self.assertIn("dx=0.3 ... failed\n", printed)
        self.assertIn("lmp ended with 3\nERROR: no such thing\nLast command: run 100\n", printed)
        self.assertIn("dx: order 1.50\n", printed)
        code, printed = self.converge("--vary", "dx=0.4,0.3", "shape=cell_100,cell_200")
        self.assertEqual(code, 1)
        self.assertIn("there is no error to tell", printed)

    def test_runs_are_kept_until_something_changes(self):
        words = "--vary", "dx=0.8,0.6"
        self.converge(*words)
        record = self.folder / "out" / "dx-0.8" / "run.json"
        before = record.stat().st_mtime_ns
        self.converge(*words)
        self.assertEqual(record.stat().st_mtime_ns, before)
        self.converge(*words, "--set", "rows=50")
        self.assertNotEqual(record.stat().st_mtime_ns, before)

    def test_series_and_two_with_an_order(self):
        code, printed = self.converge("--vary", "dx=0.8,0.4", "--take", "series",
                                      "--order", "dx=1.5")
        self.assertEqual(code, 0, printed)
        self.assertIn("order 1.5 as given", printed)
        fine = [row for row in self.table() if row["dx"] == "0.4"]
        self.assertAlmostEqual(float(fine[0]["from_limit"]), 0.5 * 0.4**1.5, places=3)

    def test_series_of_lines_that_are_far_apart(self):
        """The error of the timestep, 1e-3 step^2 of the amplitude, is not that of the lines."""
        code, printed = self.converge("--vary", "step=0.2,0.1,0.05", "--take", "series")
        self.assertEqual(code, 0, printed)
        self.assertRegex(printed, "step: order (1.9|2.0)")
        self.assertNotIn("WARNING", printed)
        for row in self.table():
            error = 1e-3 * float(row["step"])**2
            self.assertTrue(error < float(row["error_below"]) / float(row["scale"]) < 2 * error)

    def test_series_between_lines(self):
        """Where the lines of one run are at times between those of others, it is said."""
        code, printed = self.converge("--vary", "step=0.17,0.11,0.05", "--take", "series")
        self.assertEqual(code, 0, printed)
        self.assertIn("step: order unknown, it is within the noise", printed)
        self.assertRegex(printed, r"would help: more lines of thermo output \(noise \d")
        self.assertIn("have the script print more often (thermo)", printed)

    def test_series_with_hardly_a_line(self):
        code, printed = self.converge("--vary", "step=0.4,0.2,0.1", "--take", "series")
        self.assertEqual(code, 1)
        self.assertIn("a run has 6 lines of thermo output in the time that all have, a series "
                      "needs 10 or more", printed)

    def test_without_an_order_there_is_no_limit(self):
        words = "--vary", "dx=0.8,0.75", "--take", "mean", "--set", "noise=0.1"
        code, printed = self.converge(*words, "--within", "0.1%")
        self.assertEqual(code, 0, printed)
        self.assertNotIn("\nlimit ", printed)
        self.assertEqual({row["from_limit"] for row in self.table()}, {"nan"})
        self.assertRegex(printed, r"dx=0.8 +3[.\d]+ \+- [.\d]+ +- +[.\d]+ % ")
        advice = r"longer runs \(noise [.\d]+ %\), a third value, a coarsest over finest of 2 or " \
            r"more \(now 1.1\), --order dx=P if the order P is known\n"
        self.assertRegex(printed, r"two settings show none\n  would help: " + advice)
        self.assertRegex(printed, r"below 0.1 %: none\n  would help for v_x: dx: " + advice)

    def test_what_has_no_order_may_be_a_small_part(self):
        words = "--vary", "dx=0.8,0.6,0.4", "shape=cell_100000,cell_200000"
        _, printed = self.converge(*words)
        self.assertIn("shape: order unknown, two settings show none\n  would help: ", printed)
        self.assertIn("limit 3.00002, from the finest value", printed)
        _, printed = self.converge("--vary", "dx=0.8,0.6,0.4", "shape=cell_10,cell_20")
        self.assertNotIn("\nlimit ", printed)

    def test_settings_have_folders_that_all_systems_take(self):
        self.converge("--vary", "dx:shape=0.8:cell_100,0.4:cell_200", "rows=50,100")
        self.assertEqual({path.name for path in (self.folder / "out").iterdir() if path.is_dir()},
                         {"dx-0.8_shape-cell_100_rows-100", "dx-0.4_shape-cell_200_rows-50",
                          "dx-0.4_shape-cell_200_rows-100"})
        self.assertEqual(self.table()[0]["dx:shape"], "0.8:cell_100")

    def test_values_that_are_all_the_same(self):
        code, printed = self.converge("--vary", "rows=50,100", "--within", "1%")
        self.assertEqual(code, 0, printed)
        self.assertNotIn("Warning", printed)
        self.assertIn("rows: order unknown, the values are the same", printed)
        self.assertRegex(printed, "cheapest run with an error below 1 %: rows=(50|100), ")

    def test_listed_from_fine_to_coarse(self):
        """Rising numbers are counts: their kind is printed."""
        _, printed = self.converge("--vary", "dx=0.4,0.6,0.8")
        self.assertIn("size: 1/value, as values rise", printed)

    def test_wrong_options(self):
        for words, message in (
                (("--vary", "dz=1,2"), "no index variable of that name, it has dx shape rows step "
                                       "noise data"),
                (("--vary", "dx=1"), "dx=1 has one value"),
                (("--vary", "dx"), "dx is not NAME=VALUE,VALUE,..."),
                (("--vary", "dx=1,3,2"), "does not go from coarse to fine"),
                (("--vary", "dx=1,0"), "has a value that is not positive"),
                (("--vary", "shape=a,b"), "value without a number: --size NAME=..."),
                (("--vary", "dx:rows=1:2,3"), "names 2 variables, but 3 has 1 values"),
                (("--vary", "dx=2,1", "--set", "dx=3"), "is given twice"),
                (("--vary", "dx=2,1", "--set", "rows"), "rows is not NAME=VALUE"),
                (("--vary", "dx=2,1", "--within=-1%"), "-1% is neither a positive number"),
                (("--vary", "dx=2,1", "--order", "dt=2"), "not one of those varied, dx"),
                (("--vary", "dx=2,1", "--order", "dx=1,2"), "has 2 numbers instead of one"),
                (("--vary", "dx=2,1", "--size", "dx=1"), "has 1 numbers for 2 values"),
                (("--vary", "dx=2,1", "--part", "2"), "2 is not a number above 0 and up to 1"),
                (("--vary", "dx=2,1", "--ranks", "0"), "0 is not 1 or more"),
                (("--vary", "dx=2,1", "--take", "median"), "invalid choice: 'median'"),
                (("--vary", "dx=2,1", "--lmp", "nothere"), "nothere is not an executable")):
            with self.subTest(words):
                command = ["converge.py", str(self.folder / "in.scene"), "--measure", "v_x",
                           "-o", str(self.folder / "out"), "--lmp", str(self.folder / "lmp"),
                           *words]
                with redirect_stderr(io.StringIO()) as printed, \
                        patch.object(sys, "argv", command), self.assertRaises(SystemExit) as end:
                    converge.main()
                self.assertEqual(end.exception.code, 2)
                self.assertIn(message, printed.getvalue())
        self.assertFalse((self.folder / "out").exists())

    def test_a_mean_needs_lines(self):
        code, printed = self.converge("--vary", "dx=0.8,0.6", "--take", "mean", "--set", "rows=6")
        self.assertEqual(code, 1)
        self.assertIn("a mean with its noise needs 10 or more", printed)


class Scripts(unittest.TestCase):
    def test_measures_are_the_last_columns(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "in.scene"
            path.write_text(SCENE)
            (Path(folder) / "template.mol").write_text("\n")
            (Path(folder) / "folder").mkdir()
            (Path(folder) / "cell").write_text("\n")
            script = Script(path)
            lines = script.measuring(["v_x"]).splitlines()
            self.assertEqual(list(script.variables()), ["dx", "shape", "rows", "step", "noise",
                                                        "data"])
            self.assertEqual(script.folders(), {"data": str(Path(folder).resolve() / "folder")})
        self.assertIn(f"molecule  cell  {Path(folder).resolve()}/template.mol", lines)
        self.assertIn(f"read_data {Path(folder).resolve()}/cell add append", lines)
        self.assertEqual(lines[-3:], ["thermo_style custom step pe step time v_x",
                                      "thermo_modify   line one format float %.12g",
                                      "run       100"])
        self.assertEqual(lines[9].split(), ["thermo_style", "custom", "step", "temp"])

    def test_a_series_has_lines(self):
        """As many as its steps, 200 or more, at steps that a power of two divides; no fewer than
        the script asks for, and none between the steps of what a fix averages."""
        for text, expected in (
                ("run $(round(v_a / (2*v_b))) upto # x", "($(round(v_a / (2*v_b))))-step"),
                ("run ${n}", "(${n})"), ("run 100 post no", "(100)")):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "in.scene"
                path.write_text(f"run 7\nthermo 20\n{text}\n")
                lines = Script(path).measuring(["pe"], series=True).splitlines()
            self.assertEqual(lines[5:-1], [
                f"variable        converge_steps equal {expected}",
                "variable        converge_every equal "
                "ceil(2^floor(ln((v_converge_steps+1)/200)/ln(2)))",
                "variable        converge_thermo equal "
                "ternary((20>0)&&((20)<v_converge_every),20,v_converge_every)",
                "thermo          ${converge_thermo}"])
            self.assertEqual(lines[-1], text)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "in.scene"
            path.write_text("fix a all ave/time 5 1 5 c_x\nfix b all nve\nvariable v equal f_b\n"
                            "run 9\n")
            script = Script(path)
            self.assertTrue(script.can_print_often(["v_v", "f_b[1]"]))
            self.assertFalse(script.can_print_often(["f_a"]))
            self.assertFalse(script.can_print_often(["f_of_an_included_file"]))

    def test_without_a_thermo_style(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "in.scene"
            path.write_text("timestep 1\nrun 1\nrun 2\n")
            lines = Script(path).measuring(["pe"]).splitlines()
        self.assertEqual([line.split()[0] for line in lines], [
            "timestep", "thermo_style", "thermo_modify", "run", "thermo_modify", "run"])


class Measures(unittest.TestCase):
    def test_tables_of_a_log(self):
        tables = thermo_log.tables("Step 100 is next\n  Step Temp\n 0 1.5\nWARNING: x\n 1 nan\n"
                                   "Loop time of 1\n 2 3\n Step Time\n 1 2.5\n 2 3")
        self.assertEqual([names for names, _ in tables], [["Step", "Temp"], ["Step", "Time"]])
        np.testing.assert_array_equal(tables[0][1], [[0, 1.5], [1, np.nan]])
        np.testing.assert_array_equal(tables[1][1], [[1, 2.5]])

    def test_mean_and_noise(self):
        """Of an Ornstein-Uhlenbeck process of unit variance: variance of a mean 2 tau / T."""
        random, step, tau, total = np.random.default_rng(3), 0.2, 1.0, 400.0
        times = np.arange(0, total, step)
        kick = np.sqrt(1 - np.exp(-2 * step / tau))
        errors, means = [], []
        for _ in range(40):
            x = [random.standard_normal()]
            for _ in times[1:]:
                x.append(x[-1] * np.exp(-step / tau) + kick * random.standard_normal())
            found, error = mean_with_error(times, 5 + np.array(x), 0.5)
            means.append(found)
            errors.append(error)
        exact = np.sqrt(2 * tau / (0.5 * total))
        self.assertTrue(0.9 < np.mean(errors) / exact < 1.6, np.mean(errors) / exact)
        self.assertGreater(np.mean(abs(np.array(means) - 5) < 2 * np.array(errors)), 0.85)

    def test_mean_of_a_line(self):
        """Exact, whatever the times of the lines are."""
        times = np.concatenate([np.linspace(0, 4, 9), np.linspace(4.1, 10, 80)])
        self.assertAlmostEqual(mean_with_error(times, 2 * times, 0.5)[0], 15)

    def test_ends_at_different_times(self):
        """Values are taken at the earliest end."""
        first = np.linspace(0, 10, 101), np.linspace(0, 10, 101)
        second = np.linspace(0, 10.2, 35), 3 * np.linspace(0, 10.2, 35)
        values, noise = run_measures.compared([first, second], "last", 0.5)
        np.testing.assert_allclose(values, [[10], [30]])
        self.assertFalse(noise.any())
        late = np.linspace(0, 10.2, 35), np.linspace(0, 10.2, 35)**2
        _, noise = run_measures.compared([first, late], "last", 0.5)
        np.testing.assert_allclose(noise, [0, 0.1 * 0.2])    # half f'' (t - a) (b - t)
        with self.assertRaisesRegex(run_measures.TooShort, "one has 2 lines"):
            run_measures.compared([first, (late[0][[0, -1]], late[1][[0, -1]])], "last", 0.5)
        with self.assertRaises(run_measures.TooShort):
            run_measures.compared([first, (np.array([20.0, 30.0]), np.zeros(2))], "series", 0.5)


if __name__ == "__main__":
    unittest.main()
