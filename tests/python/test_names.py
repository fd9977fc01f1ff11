"""Names that the Python of the repository uses are defined: a script may fail long after it was
started, in a line that no test reaches."""

import builtins
import symtable
import unittest

from lammps_case import ROOT

FOLDERS = "bench", "examples", "potentials", "scripts", "tests"
GIVEN = {*dir(builtins), "__file__", "__name__", "__doc__"}


def tables(table):
    """A scope and all within it."""
    yield table
    for inner in table.get_children():
        yield from tables(inner)


def undefined(source, name):
    """Names that are looked up in the module, and that nothing there defines."""
    module = symtable.symtable(source, name, "exec")
    defined = {symbol.get_name() for table in tables(module) for symbol in table.get_symbols()
               if (table is module or symbol.is_declared_global())
               and (symbol.is_assigned() or symbol.is_imported())}
    used = {symbol.get_name() for table in tables(module) for symbol in table.get_symbols()
            if symbol.is_referenced() and (table is module or symbol.is_global())}
    return sorted(used - defined - GIVEN)


class Names(unittest.TestCase):
    def test_of_the_repository(self):
        listed = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")]
        self.assertGreater(len(listed), 100)
        for path in listed:
            with self.subTest(path.relative_to(ROOT)):
                self.assertEqual(undefined(path.read_text(encoding="utf-8"), path.name), [])

    def test_what_is_undefined(self):
        source = "import a\nB = 1\ndef f(c):\n    d = c + B + e\n    return [d + g for h in a.x]\n"
        self.assertEqual(undefined(source, "sample"), ["e", "g"])


if __name__ == "__main__":
    unittest.main()
