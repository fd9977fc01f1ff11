"""Scripts that users run refuse what they do not know, say what is missing, write where told to."""
import io
import os
import runpy
import stat
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path
from unittest.mock import patch

from rbc.__main__ import COMMANDS

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
BALLOON = EXAMPLES / "balloon"
SCRIPTS = sorted(path for pattern in ("scripts/*.py", "bench/*.py", "examples/*/*.py",
                                      "potentials/*.py", "tests/python/rooms.py")
                 for path in ROOT.glob(pattern) if "__main__" in path.read_text(encoding="utf-8"))
# what a script cannot do without
REQUIRED = {"cell_statistics.py": "cells --box 0 1 0 1 0 1", "make_vessel.py": "tube x.stl",
            "membrane_motion.py": "dump --timestep 1 --shear-rate 1",
            "plot_aggregates.py": "--case a b c -o x.png", "plot_shear.py": "cell.dat -o x.png",
            "render_cells.py": "cells.vtp -o x.png",
            "surface_gaps.py": "cells.vtp --box 1 1 1 -o x.csv",
            "compare_builds.py": "before now", "kernels.py": "1.json",
            "membrane.py": "membrane.json", "make_template.py": "sphere -f 2",
            "settling-sphere/draw.py": "run", "shear-cell/draw.py": "run",
            "throat/draw.py": "straight throat", "touching.py": "--run x",
            "scripts/converge.py": "in.scene --vary dx=2,1 --measure pe"}


def attempt(script, *words, python=(), **environment):
    done = subprocess.run([sys.executable, *python, script, *map(str, words)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
                          env={**os.environ, **environment}, timeout=200)
    return done.returncode, done.stdout


def required(script):
    here = f"{script.parent.name}/{script.name}"
    return REQUIRED.get(script.name, REQUIRED.get(here, "")).split()


def attempt_here(script, *words):
    """The same in this process, which need not import numpy again for each script."""
    path = [str(script.parent), *sys.path]
    with redirect_stderr(io.StringIO()) as printed, patch.object(sys, "path", path), \
            patch.object(sys, "argv", [str(script), *words]):
        try:
            runpy.run_path(str(script), run_name="__main__")
        except SystemExit as end:
            return end.code, printed.getvalue()
        finally:
            forget_modules_of(script.parent)
    return 0, printed.getvalue()


def forget_modules_of(folder):
    """Modules of other folders have the same names."""
    for name, module in list(sys.modules.items()):
        if Path(getattr(module, "__file__", None) or "").parent == folder:
            del sys.modules[name]


class Arguments(unittest.TestCase):
    def test_unknown_ones_are_refused(self):
        self.assertGreater(len(SCRIPTS), 35)
        for script in SCRIPTS:
            with self.subTest(script):
                code, printed = attempt_here(script, *required(script), "--nonsense")
                self.assertEqual(code, 2)
                self.assertIn("unrecognized arguments: --nonsense", printed)

    def test_a_series_that_does_not_exist_is_refused(self):
        code, printed = attempt(BALLOON / "study.py", "--output", "x", "--only", "laws")
        self.assertEqual(code, 2)
        self.assertIn("invalid choice: 'laws'", printed)
        self.assertFalse(Path("x").exists())


class Package(unittest.TestCase):
    """python3 -m rbc."""

    def attempt(self, *words, python=()):
        return attempt("-m", "rbc", *words, python=python, PYTHONPATH=str(ROOT / "scripts"))

    def test_lists_its_commands(self):
        files = {path.stem for path in (ROOT / "scripts" / "rbc" / "commands").glob("[!_]*.py")}
        self.assertEqual(files - {"look_options"}, set(COMMANDS))
        for words in ((), ("--help",)):
            code, printed = self.attempt(*words)
            self.assertEqual(code, 0)
            for name in COMMANDS:
                self.assertRegex(printed, f"\n  {name} ")

    def test_commands_say_what_they_are_and_refuse_what_they_do_not_know(self):
        for name in COMMANDS:
            with self.subTest(name):
                code, printed = self.attempt(name, "--help")
                self.assertEqual(code, 0)
                self.assertRegex(printed, f"^usage: python3 -m rbc {name} ")
                code, printed = self.attempt(name, "--nonsense")
                self.assertEqual(code, 2)
                code, printed = self.attempt(name, "--help", python=("-S",))
                self.assertRegex(printed, f"^python3 -m rbc {name}: needs the Python module ")
        code, printed = self.attempt("nonsense")
        self.assertEqual(code, 2)
        self.assertRegex(printed, "^python3 -m rbc: there is no command nonsense; there are ")

    def test_a_reader_that_ends_early_is_no_fault(self):
        code, printed = attempt("-c", "from rbc import command_line\nraise BrokenPipeError",
                                PYTHONPATH=str(ROOT / "scripts"))
        self.assertEqual((code, printed), (1, ""))


class Modules(unittest.TestCase):
    def test_one_that_is_missing_is_named(self):
        """Without Python's module site, nothing is found of what does not come with Python."""
        named = 0
        for script in SCRIPTS:
            with self.subTest(script):
                code, printed = attempt(script, "--help", python=("-S",))
                if code == 0:
                    continue
                self.assertRegex(printed, f"^{script.name}: needs the Python module "
                                          "(numpy|matplotlib|vtkmodules), .*python3-.*\n$")
                named += 1
        self.assertGreater(named, 30)

    def test_a_fault_of_a_script_keeps_its_traceback(self):
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder) / "script.py"
            script.write_text("import command_line\nimport a_module_of_nobody\n")
            code, printed = attempt(script, PYTHONPATH=str(ROOT / "scripts"))
        self.assertEqual(code, 1)
        self.assertIn("Traceback", printed)

    def test_a_file_that_cannot_be_read_or_written_is_named(self):
        for words in ("cell_statistics.py nothere --box 0 1 0 1 0 1",
                      "make_vessel.py tube nothere/x"):
            script, *arguments = words.split()
            code, printed = attempt(ROOT / "scripts" / script, *arguments)
            self.assertEqual(code, 1)
            self.assertRegex(printed, f"^{script}: nothere(/x)?: No such file or directory\n$")


class Results(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        before = self.repository()
        self.addCleanup(lambda: self.assertEqual(self.repository(), before))

    @staticmethod
    def repository():
        """Results that belong to the repository, and when they were written."""
        return {path: path.stat().st_mtime_ns for top in (EXAMPLES, ROOT / "bench")
                for path in top.rglob("*") if path.suffix in (".csv", ".png", ".npz", ".txt")}

    def executable(self, script):
        path = self.folder / "lmp"
        path.write_text("#!/bin/sh\n" + script)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def test_must_have_a_folder(self):
        new = self.folder / "x"
        for words, message in (((), "say where results go: --output FOLDER, or --update"),
                               (("-o", BALLOON), "of the repository: --update writes over them"),
                               (("-o", new, "--update"), "not allowed with argument"),
                               (("-o", "/proc/x"), "--output /proc/x: No such file"),
                               (("-o", new, "--lmp", "nothere"), "nothere is not an executable")):
            code, printed = attempt(BALLOON / "study.py", "--lmp", self.executable("exit 1"),
                                    *words)
            self.assertEqual(code, 2)
            self.assertIn(message, printed)
        self.assertFalse(new.exists())

    def test_go_there(self):
        """All cases are in the table that the folder holds, so that nothing is run."""
        table = self.folder / "balloon.csv"
        table.write_bytes((BALLOON / "balloon.csv").read_bytes())
        code, printed = attempt(BALLOON / "study.py", "-o", self.folder,
                                "--lmp", self.executable("exit 1"))
        self.assertEqual(code, 0, printed)
        self.assertTrue((self.folder / "balloon.png").exists())

    def test_of_the_repository_do_not_count_as_run(self):
        code, printed = attempt(BALLOON / "study.py", "-o", self.folder, "--lmp",
                                self.executable("echo ERROR: no such thing; exit 3"))
        self.assertEqual(code, 1)
        self.assertRegex(printed, "lmp ended with 3\nERROR: no such thing\n$")
        self.assertNotIn("Traceback", printed)

    def test_are_drawn_from_those_of_the_repository(self):
        code, printed = attempt(EXAMPLES / "relaxation" / "study.py", "-o", self.folder, "--draw")
        self.assertEqual(code, 0, printed)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["relaxation.png"])

    def test_of_a_benchmark_are_what_its_program_prints(self):
        table = (ROOT / "bench" / "splitting.csv").read_text()
        program = self.executable(f"cat <<END\n{table}END\n")
        code, printed = attempt(ROOT / "bench" / "splitting.py", "-o", self.folder,
                                "--program", program)
        self.assertEqual(code, 0, printed)
        self.assertEqual((self.folder / "splitting.csv").read_text(), table)
        self.assertTrue((self.folder / "splitting.png").exists())


if __name__ == "__main__":
    unittest.main()
