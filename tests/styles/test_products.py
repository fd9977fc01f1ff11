"""Both products offer every style whose header is in the package, before and after `clear`."""

import os
import re
import subprocess
import unittest
from pathlib import Path

from lammps_case import version

PACKAGE = Path(__file__).resolve().parents[2] / "src" / "USER-RBC"


def styles_in_headers():
    row = re.compile(r"^(Command|Compute|Fix|Pair|Region)Style\(([^,]+),", re.MULTILINE)
    return {match for header in PACKAGE.glob("*.h") for match in row.findall(header.read_text())}


def listings(executable, script):
    """One set of (kind, name) for each `info styles all` of the script; and all that was
    printed."""
    Path("in.products").write_text(script)
    run = subprocess.run(
        [os.environ["MPIEXEC"], "-np", "2", executable, "-log", "none", "-in", "in.products"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if run.returncode:
        raise AssertionError(run.stdout)
    found = []
    for listing in run.stdout.split("Styles information:")[1:]:
        listing = listing.split("Info-Info", 1)[0]
        sections = re.split(r"^(\w+) styles.*:$", listing, flags=re.MULTILINE)
        found.append({(kind, name) for kind, names in zip(sections[1::2], sections[2::2])
                      for name in names.split()})
    return found, run.stdout


class Products(unittest.TestCase):
    def test_executable_has_the_styles_from_the_start(self):
        found, printed = listings(os.environ["LMP_RBC"],
                                  "info styles all\nclear\ninfo styles all\n")
        self.assertEqual(len(found), 2)
        for styles in found:
            self.assertEqual(styles_in_headers() - styles, set())
        self.assertNotIn("plugin:", printed)

    def test_help_lists_the_styles(self):
        run = subprocess.run([os.environ["LMP_RBC"], "-h"], capture_output=True, text=True,
                             check=True)
        listed = re.findall(r"^  (\w+) +(\S+)$", run.stdout.split("Help of LAMMPS")[0],
                            re.MULTILINE)
        self.assertEqual({(kind.capitalize(), name) for kind, name in listed}, styles_in_headers())
        self.assertEqual(len(listed), len(set(listed)))
        self.assertIn("List of command-line options", run.stdout)
        self.assertEqual(run.stdout.splitlines()[0], f"Styles of USER-RBC {version()}:")

    def test_plugin_adds_exactly_the_package(self):
        load = f"plugin load {os.environ['RBC_PLUGIN']}\ninfo styles all\n"
        found, _ = listings(os.environ["LMP"], "info styles all\n" + load + "clear\n" + load)
        before, loaded, reloaded = found
        self.assertEqual(loaded - before, styles_in_headers())
        self.assertEqual(reloaded, loaded)


if __name__ == "__main__":
    unittest.main()
