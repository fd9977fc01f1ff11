"""doc/ and the READMEs become HTML without a warning, and pages with mistakes do not."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = """A page
======

.. code-block:: LAMMPS

   fix ID all rbc/ib flow

:doc:`of LAMMPS <fix_ave_time>` and :doc:`not of LAMMPS <fix_ave_tune>`,
:ref:`a label <gone>`, :math:`x`, ``potentials/there.mol``, ``potentials/missing.mol``

.. image:: missing.png

`cut short <other.html#place>`_
"""
README = """# Another page

[page](doc/index.rst), [place](doc/index.rst#nowhere), [file](doc/there.csv),
[missing](missing.csv), [folder](examples/scene), [no folder](examples/none)
"""
# what warnings name
MISTAKES = ("fix_ave_tune", "'gone'", "doc/missing.png", "missing.csv", "examples/none", "nowhere",
            "other.html#place", "potentials/missing.mol")


class Pages(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def test_of_the_repository(self):
        done = subprocess.run(["bash", ROOT / "scripts" / "html.sh"], text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=500,
                              env={**os.environ, "USER_RBC_BUILD": str(self.folder)})
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(done.stdout.splitlines()[-1], f"== open {self.folder}/html/index.html")
        html = self.folder / "html"
        for name in ("index", "search", "README", "doc/index", "doc/fix_rbc_ib",
                     "examples/stretch/README"):
            self.assertTrue((html / f"{name}.html").is_file(), name)
        for source in ROOT.glob("doc/*.rst"):
            self.assertTrue((html / "doc" / f"{source.stem}.html").is_file(), source)
        page = (html / "doc" / "compute_rbc_cell.html").read_text(encoding="utf-8")
        self.assertIn('href="https://docs.lammps.org/fix_ave_time.html"', page)
        self.assertTrue((html / "_static" / "mathjax" / "MathJax.js").is_file())
        for path in html.rglob("*.html"):
            page = path.read_text(encoding="utf-8")
            self.assertNotRegex(page, r'<(script|link|img)[^>]*="https?:', f"{path}: online")

    def test_with_mistakes(self):
        top = self.folder / "top"
        shutil.copytree(ROOT / "doc" / "html", top / "doc" / "html",
                        ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "doc" / "conf.py", top / "doc")
        for name, text in (("doc/index.rst", PAGE), ("README.md", README), ("doc/there.csv", "1"),
                           ("examples/scene/README.md", "# A scene\n"),
                           ("potentials/there.mol", ""), ("lammps/doc/src/fix_ave_time.rst", "")):
            path = top / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run(
            ["/usr/bin/python3", "-m", "sphinx", "-W", "--keep-going", "-q", "-c", top / "doc", top,
             self.folder / "html"], text=True, check=False, timeout=200, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE, env={**os.environ, "LAMMPS_SOURCE_DIR": str(top / "lammps")})
        self.assertNotEqual(done.returncode, 0)
        warnings = [line for line in done.stderr.splitlines()
                    if "WARNING" in line and "any toctree" not in line]
        for mistake in MISTAKES:
            self.assertTrue(any(mistake in line for line in warnings), (mistake, done.stderr))
        for line in warnings:
            self.assertTrue(any(mistake in line for mistake in MISTAKES), line)


if __name__ == "__main__":
    unittest.main()
