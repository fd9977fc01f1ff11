"""Files of code are short, and so are their lines and the functions of Python."""

import ast
import unittest

from lammps_case import ROOT

FOLDERS = "bench", "cmake", "doc", "examples", "fluid", "potentials", "scripts", "src", "tests"
COLUMNS, LINES, FUNCTION = 100, 450, 60


def sources(*suffixes):
    return [path for folder in FOLDERS for suffix in suffixes
            for path in sorted((ROOT / folder).rglob("*" + suffix))]


def wide_lines(text):
    return [n for n, line in enumerate(text.splitlines(), 1) if len(line) > COLUMNS]


def long_functions(text):
    return [node.name for node in ast.walk(ast.parse(text))
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
            and node.end_lineno - node.lineno >= FUNCTION]


class Style(unittest.TestCase):
    def test_lines_and_files(self):
        listed = sources(".py", ".cpp", ".h", ".sh")
        self.assertGreater(len(listed), 300)
        for path in listed:
            with self.subTest(path.relative_to(ROOT)):
                text = path.read_text(encoding="utf-8")
                self.assertEqual(wide_lines(text), [])
                self.assertLessEqual(len(text.splitlines()), LINES)

    def test_functions_of_python(self):
        for path in sources(".py"):
            with self.subTest(path.relative_to(ROOT)):
                self.assertEqual(long_functions(path.read_text(encoding="utf-8")), [])

    def test_what_is_too_long(self):
        rows = "    a = 1\n"
        self.assertEqual(wide_lines("x" * 100 + "\n" + "é" * 100 + "\n" + "x" * 101), [3])
        self.assertEqual(long_functions("def f():\n" + 59 * rows), [])
        method = "class C:\n    def f(self):\n" + 60 * ("    " + rows)
        self.assertEqual(long_functions(method), ["f"])


if __name__ == "__main__":
    unittest.main()
