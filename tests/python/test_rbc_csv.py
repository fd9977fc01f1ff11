"""`python3 -m rbc csv`: what it writes is what was in the files, as other programs read CSV."""
import contextlib
import csv
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np
from rbc import CELL_COLUMNS, InputError
from rbc.commands.csv import main
from vtk_files import cuboid, write_surfaces


class Tables(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def convert(self, text, *words):
        (self.folder / "file").write_text(text)
        return self.rows(self.folder / "file", *words)

    @staticmethod
    def rows(*words):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            main(list(map(str, words)))
        return list(csv.DictReader(io.StringIO(printed.getvalue())))

    def test_of_cells(self):
        values = np.random.default_rng(3).normal(size=(2, 3, 19)).round(6)
        values[:, :, 0] = 4, 8, 9
        header = " ".join(f"c_x[{n}]" for n in range(1, 20))
        text = f"# fix\n# TimeStep Number-of-rows\n# Row {header}\n"
        for step, block in zip((0, 1000), values):
            text += f"{step} 3\n" + "".join(f"{n} {' '.join(map(str, row.tolist()))}\n"
                                            for n, row in enumerate(block, 1))
        rows = self.convert(text, "--timestep", "0.5")
        self.assertEqual(list(rows[0]), ["step", "time", *CELL_COLUMNS])
        self.assertEqual([(row["step"], row["time"], row["molecule"]) for row in rows],
                         [(s, t, m) for s, t in (("0", "0"), ("1000", "500")) for m in "489"])
        found = np.array([[float(row[name]) for name in CELL_COLUMNS] for row in rows])
        np.testing.assert_array_equal(found, values.reshape(6, 19))

    def test_of_other_arrays_keep_their_names(self):
        rows = self.convert("# fix\n# TimeStep Number-of-rows\n# Row c_a[1] c_a[2]\n"
                            "5 2\n1 1 0.5\n2 2 1e-30\n")
        self.assertEqual(rows, [{"step": "5", "row": "1", "c_a[1]": "1", "c_a[2]": "0.5"},
                                {"step": "5", "row": "2", "c_a[1]": "2", "c_a[2]": "1e-30"}])

    def test_of_vectors(self):
        rows = self.convert("# Time-averaged data for fix s\n# TimeStep c_a[1] v_x\n0 1 2\n9 3 4\n")
        self.assertEqual(rows, [{"TimeStep": "0", "c_a[1]": "1", "v_x": "2"},
                                {"TimeStep": "9", "c_a[1]": "3", "v_x": "4"}])

    def test_of_logs(self):
        rows = self.convert("LAMMPS (4 Feb 2025)\nunits micro\nStep Time\n 0 0\n 9 18\n"
                            "Loop time of 1\nStep v_x\n 9 0.125\nLoop time of 1\n")
        self.assertEqual(rows, [{"Step": "0", "Time": "0", "v_x": "nan"},
                                {"Step": "9", "Time": "18", "v_x": "nan"},
                                {"Step": "9", "Time": "nan", "v_x": "0.125"}])

    def test_of_surfaces(self):
        for step, length in ((20, 4), (3, 2)):
            meshes = {7: cuboid((1, length, 1)), 5: cuboid((length, 1, 1), (3, 4, 5))}
            write_surfaces(self.folder / f"cells.{step}.vtp", meshes)
        output = self.folder / "shapes.csv"
        main([*map(str, self.folder.glob("cells.*.vtp")), "-o", str(output)])
        with open(output, encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([(row["step"], row["molecule"], float(row["volume"])) for row in rows],
                         [("3", "5", 2), ("3", "7", 2), ("20", "5", 4), ("20", "7", 4)])
        last = rows[2]
        self.assertAlmostEqual(float(last["deformation"]), 3 / 5, delta=1e-6)
        self.assertAlmostEqual(float(last["inclination"]), 0, delta=1e-5)
        self.assertIn("tilt", last)
        self.assertAlmostEqual(float(last["long"]), 4 * np.sqrt(5 / 12), delta=1e-6)
        self.assertEqual([float(last[d]) for d in "xyz"], [3, 4, 5])

    def test_of_nothing(self):
        with self.assertRaisesRegex(InputError, "needs a line '# name name"):
            self.convert("1 2 3\n")
        with self.assertRaisesRegex(InputError, "--timestep needs a column TimeStep"):
            self.convert("# time D\n1 2\n", "--timestep", "2")
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as said:
            main(["a.dat", "b.dat"])
        self.assertIn("several files must be surfaces", said.getvalue())


if __name__ == "__main__":
    unittest.main()
