"""doc/validation.rst is what scripts/validation.py makes of the tables, and its commands exist."""

import re
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest.mock import patch

import validation
import validation_figures
import validation_tables
from lammps_case import ROOT

EXAMPLES = ROOT / "examples"
TESTS = [f"{path.parent.name}/{path.stem}" for pattern in ("*/*_test.cpp", "*/test_*.py")
         for path in (ROOT / "tests").glob(pattern)]


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = validation.PAGE.read_text(encoding="utf-8")
        cls.template = validation.PAGE.with_suffix(".rst.in").read_text(encoding="utf-8")

    def test_is_what_the_tables_give(self):
        self.assertEqual(self.text, validation.written_page(),
                         "run scripts/validation.py --update")

    def test_has_the_figures_of_every_table(self):
        for function in validation_figures.FIGURES:
            self.assertRegex(self.template, rf"\{{{function.__name__}[.[]")

    def test_has_a_row_for_each_table_by_converge(self):
        for path in EXAMPLES.glob("*/converge.csv"):
            name = path.parent.name
            self.assertIn(f"<examples/{name}/README:Error against run time>`\n     - {{converge"
                          f"[{name}].setting}}\n", self.template)

    def test_the_cost_in_the_readme_is_that_of_the_table(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        self.assertIn(f"| [{validation_figures.cost().fine_cell:2} core s](doc/validation.rst) |",
                      text)

    def test_tests_that_it_names_exist(self):
        patterns = re.findall(r"``ctest -R '?([^'`]+)'?``", self.text)
        self.assertGreater(len(patterns), 10)
        for pattern in patterns:
            for one in pattern.split("|"):
                self.assertTrue(any(one in name for name in TESTS), one)

    def test_scripts_that_it_names_exist(self):
        named = re.findall(r"``(bench/\w+\.sh)``", self.text)
        of_examples = r":doc:`[\w/-]+\s</(examples/[\w-]+)/README>`:\s``([^`]+)``"
        for example, command in re.findall(of_examples, self.text):
            words = command.split()
            named.append(f"{example}/{words[2] if words[0] == 'bash' else words[0]}")
        self.assertGreater(len(named), 30)
        for path in named:
            self.assertTrue((ROOT / path).is_file(), path)


class Figures(unittest.TestCase):
    def test_numbers_have_as_many_digits_as_asked_for(self):
        for value, form, text in ((0.0123, "1", "0.01"), (6.0, "2", "6.0"), (17.4, "2", "17"),
                                  (1234.0, "2", "1200"), (-0.03, "+1", "-0.03"), (5, "+2", "+5.0"),
                                  (7.77e-15, "1", "8e-15"), (2.24e-5, "2", "2.2e-5"),
                                  (26, "2", "26"), (0, "1", "0")):
            self.assertEqual(f"{validation_tables.Number(value):{form}}", text)
        for form in ("", ".2f", "0", "12"):
            with self.assertRaises(ValueError):
                format(validation_tables.Number(1), form)

    def test_follow_their_table(self):
        """A sphere that is 5 % off is in the figures."""
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "bench").mkdir()
            table = Path(folder) / "bench" / "drag.csv"
            shutil.copy(ROOT / "bench" / "drag.csv", table)
            text = table.read_text(encoding="utf-8")
            with patch.object(validation_tables, "ROOT", Path(folder)):
                before = validation_figures.drag()
                table.write_text(text.replace("7.50052,7.44200,0.786", "7.81410,7.44200,5.000"),
                                 encoding="utf-8")
                after = validation_figures.drag()
        self.assertEqual(after.roma3[1], 5)
        self.assertLess(before.roma3[1], 1)
        self.assertEqual(after.peskin4, before.peskin4)

    def test_known_ones(self):
        """Of tables of which the README of the scene says what they come to."""
        self.assertEqual(f"{validation_figures.relaxation().here:3}", "0.117")
        self.assertEqual(f"{validation_figures.capsule_shear().slope:+1}", "-0.6")
        self.assertEqual(validation_figures.setting(
            {"measure": "pe", "dx:shape": "0.25:capsule_162", "step": 0.04, "value": 1}),
            "dx 0.25, capsule_162, step 0.04")

    def test_wrapped_cells(self):
        template = ("Head\n====\n\nLeft  as it is.\n\n.. list-table::\n\n   * - one {a:1} two\n"
                    "       three\n     - 25 %\n\nA {a:1}.\n")
        made = validation.page(template, {"a": validation_tables.Number(0.04)})
        self.assertEqual(made, template.replace("{a:1} two\n       three", "0.04 two three")
                         .replace("{a:1}", "0.04"))


if __name__ == "__main__":
    unittest.main()
