"""CHANGELOG.md begins with the version that CMakeLists.txt has, and its dates run backwards."""
import re
import unittest
from datetime import datetime

from lammps_case import ROOT, version


class Changelog(unittest.TestCase):
    def test_versions_and_dates(self):
        heads = re.findall(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"),
                           re.MULTILINE)
        found = [re.fullmatch(r"(\d+)\.(\d+)\.(\d+) \((.*)\)", head).groups() for head in heads]
        self.assertEqual(".".join(found[0][:3]), version())
        numbers = [tuple(map(int, words[:3])) for words in found]
        dates = [datetime.strptime(words[3], "%d %B %Y") for words in found]
        self.assertEqual(numbers, sorted(set(numbers), reverse=True))
        self.assertEqual(dates, sorted(set(dates), reverse=True))


if __name__ == "__main__":
    unittest.main()
