"""Scripts of the pages that have all from units to run do run, as they stand."""

import re
import textwrap
import unittest

import numpy as np
from lammps_case import ROOT, attempt

BLOCK = re.compile(r"^\.\. code-block:: LAMMPS\n\n((?:   .*\n|\n)+)", re.MULTILINE)


def complete_scripts():
    """[(page, script)]"""
    found = []
    for path in sorted(ROOT.glob("doc/*.rst")):
        for block in BLOCK.findall(path.read_text(encoding="utf-8")):
            script = textwrap.dedent(block)
            if {"units", "run"} <= {line.split(maxsplit=1)[0] for line in script.splitlines()
                                    if line.strip()}:
                found.append((path.stem, script))
    return found


class Scripts(unittest.TestCase):
    def test_those_that_are_called_complete_are_found(self):
        called = [path.stem for path in sorted(ROOT.glob("doc/*.rst"))
                  if "complete script" in path.read_text(encoding="utf-8")]
        self.assertEqual([page for page, _ in complete_scripts()], called)
        self.assertGreater(len(called), 3)

    def test_run(self):
        for page, script in complete_scripts():
            with self.subTest(page):
                result = attempt(script, timeout=300)
                self.assertEqual((result.error, result.code), ("", 0))
                last = int(re.search(r"^run +(\d+)", script, re.MULTILINE).group(1))
                self.assertEqual(result.thermo["Step"][-1], last)
                for name, column in result.thermo.items():
                    self.assertTrue(np.all(np.isfinite(column)), name)


if __name__ == "__main__":
    unittest.main()
