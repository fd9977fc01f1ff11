"""Lines of D and of angles, of one file of cells and of several."""
import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np
from rbc import CELL_COLUMNS
from rbc.commands import plot
from rbc.shear_plot import cell_lines, compared_lines


class Lines(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def write(self, name, *deformations):
        """A file of cells with such D at steps 0, 10, ..., long along x and short along z."""
        names = " ".join(f"c_cell[{n + 1}]" for n in range(len(CELL_COLUMNS)))
        text = f"# fix\n# TimeStep Number-of-rows\n# Row {names}\n"
        for step, frame in enumerate(np.transpose(deformations)):
            text += f"{10 * step} {len(frame)}\n"
            for row, value in enumerate(frame, 1):
                columns = dict.fromkeys(CELL_COLUMNS, 0.0)
                columns.update(molecule=row, deformation=value, long_x=1, short_z=1)
                text += f"{row} {' '.join(map(str, columns.values()))}\n"
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        return str(path)

    def test_of_one_file(self):
        shapes, angles = cell_lines(self.write("cell.dat", [0.1, 0.2], [0.3, 0.4]), 2)
        self.assertEqual([(label, x.tolist(), y.tolist()) for label, x, y in shapes],
                         [("cell 1", [0, 20], [0.1, 0.2]), ("cell 2", [0, 20], [0.3, 0.4])])
        self.assertEqual([(kind, y.tolist()) for kind, _, y in angles],
                         [("long axis", [0, 0])] * 2 + [("short axis", [90, 90])] * 2)

    def test_of_several_files_that_are_compared(self):
        paths = [self.write("a.dat", [0.1, 0.2], [0.3, 0.6]), self.write("b.dat", [0.5, 0.6, 0.7])]
        shapes, angles = compared_lines(paths, [2, 1])
        self.assertEqual([(label, x.tolist()) for label, x, _ in shapes],
                         [("a, mean of 2 cells", [0, 20]), ("b", [0, 10, 20])])
        np.testing.assert_allclose(shapes[0][2], [0.2, 0.4])
        self.assertEqual(angles, [])

    def test_of_files_with_one_cell_and_the_same_name(self):
        paths = [self.write("low/cell.dat", [0.1]), self.write("high/cell.dat", [0.2])]
        shapes, angles = compared_lines(paths, [1, 1])
        self.assertEqual([label for label, *_ in shapes], paths)
        self.assertEqual([kind for kind, *_ in angles], ["long axis"] * 2 + ["short axis"] * 2)

    def test_command(self):
        paths = [self.write(f"{name}.dat", [0.1, 0.2, 0.3]) for name in "abc"]
        output = self.folder / "D.png"
        plot.main(["--cells", *paths, "--timestep", "1", "2", "4", "-o", str(output)])
        self.assertGreater(output.stat().st_size, 5000)
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as said:
            plot.main(["--cells", *paths, "--timestep", "1", "2", "-o", str(output)])
        self.assertIn("2 values of --timestep for 3 files", said.getvalue())

    def test_command_with_a_column_of_a_table(self):
        (self.folder / "visc.dat").write_text("# fix\n# TimeStep v_strain v_relative\n"
                                              "0 0 3\n9 1 2\n")
        output = self.folder / "viscosity.png"
        plot.main([str(self.folder / "visc.dat"), "--x", "v_strain", "--y", "v_relative", "-o",
                   str(output)])
        self.assertGreater(output.stat().st_size, 5000)


if __name__ == "__main__":
    unittest.main()
