"""`cmake --install` puts all that a user needs below a folder, which works after it was moved."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from lammps_case import ENVIRONMENT, POTENTIALS, ROOT, read_template, version

BUILD = Path(os.environ["LMP_RBC"]).parent
# as doc/build.rst says it
SCENE = """variable potentials getenv LAMMPS_POTENTIALS
print "potentials are in ${potentials}"
units micro
atom_style molecular
boundary p p f
region box block 0 12 0 12 0 12
create_box 1 box angle/types 1
include ${potentials}/healthy.material
molecule rbc ${potentials}/rbc_162.mol
rbc/create rbc single 6 6 6
neighbor 1.0 bin
fix mem all rbc/membrane rbc mooney-rivlin ${C1} ${C2} ${h} bending ${kappa}
fix flow all rbc/fluid dx 1.0 viscosity ${viscosity} wall zlo 0 0 0 wall zhi 0.0012 0 0
fix ib all rbc/ib flow
compute cell all rbc/cell
thermo_style custom step c_cell[1][6]
thermo_modify format float %.17g
timestep 50
run 2
"""


def template_volume():
    x, triangles = read_template(POTENTIALS / "rbc_162.mol")
    a, b, c = x[triangles].transpose(1, 0, 2)
    return np.sum(a * np.cross(b, c)) / 6


def output(command, folder, **variables):
    """What a command prints that ends well. LAMMPS_POTENTIALS and LAMMPS_PLUGIN_PATH are not set
    unless given."""
    environment = {name: value for name, value in {**os.environ, **ENVIRONMENT}.items()
                   if not name.startswith("LAMMPS_")}
    done = subprocess.run(command, cwd=folder, text=True, check=False, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=200, env={**environment, **variables})
    if done.returncode:
        raise AssertionError(done.stdout)
    return done.stdout


@unittest.skipUnless((BUILD / "cmake_install.cmake").exists(), "is not in its build folder")
class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = Path(scratch.name)
        cls.first = cls.folder / "first"
        cls.prefix = cls.folder / "moved" / "elsewhere"
        cls.prefix.parent.mkdir()
        output(["cmake", "--install", BUILD, "--prefix", cls.first], cls.folder)
        shutil.move(cls.first, cls.prefix)
        (cls.folder / "in.scene").write_text(SCENE)

    def run_scene(self, executable, **variables):
        """Prints the cell's volume, which is that of the template, and where potentials are."""
        printed = output([os.environ["MPIEXEC"], "-np", "2", executable, "-in", "in.scene"],
                         self.folder, **variables)
        volume = re.search(r"^ +Step .*\n +0 +(\S+)", printed, re.MULTILINE).group(1)
        np.testing.assert_allclose(float(volume), template_volume(), rtol=1e-6)
        self.assertIn(f"USER-RBC version {version()}\n", printed)
        return printed

    def test_executable_finds_its_own(self):
        printed = self.run_scene(self.prefix / "bin" / "lmp_rbc")
        self.assertIn(f"potentials are in {self.prefix}/share/user-rbc/potentials\n", printed)
        self.assertIn("rbc/membrane", output([self.prefix / "bin" / "lmp_rbc", "-h"], self.folder))

    def test_potentials_of_the_user_come_first(self):
        printed = self.run_scene(self.prefix / "bin" / "lmp_rbc", LAMMPS_POTENTIALS=str(POTENTIALS))
        self.assertIn(f"potentials are in {POTENTIALS}\n", printed)

    def test_plain_lammps_loads_the_plugin(self):
        self.run_scene(os.environ["LMP"], LAMMPS_PLUGIN_PATH=str(self.prefix / "lib" / "user-rbc"),
                       LAMMPS_POTENTIALS=str(self.prefix / "share" / "user-rbc" / "potentials"))

    def test_nothing_leads_to_where_it_was_built(self):
        files = [path for path in self.prefix.rglob("*") if path.is_file()]
        self.assertGreater(len(files), 50)
        for path in files:
            content = path.read_bytes()
            for folder in (ROOT, BUILD, self.first):
                self.assertNotIn(os.fsencode(folder) + b"/", content, path)
        libraries = output(["ldd", self.prefix / "bin" / "lmp_rbc"], self.folder)
        self.assertNotIn(f"{Path(os.environ['LMP']).parent}/", libraries)
        self.assertNotIn("not found", libraries)

    def test_has_what_the_repository_has(self):
        share = self.prefix / "share" / "user-rbc"
        for folder, names in (("potentials", ("*.mol", "*.material", "*.blood", "*.py")),
                              ("scripts", ("*.py",)),
                              ("examples", ("*/in.*", "*/cells.txt", "*/velocity.py",
                                            "*/seeds.py"))):
            for name in names:
                expected = [path.relative_to(ROOT) for path in (ROOT / folder).glob(name)
                            if not path.name.startswith("validation")]    # for the pages alone
                self.assertGreater(len(expected), 0)
                for path in expected:
                    self.assertEqual((share / path).read_bytes(), (ROOT / path).read_bytes())

    def test_python_tools_run(self):
        share = self.prefix / "share" / "user-rbc"
        tools = [path for path in [*share.glob("scripts/*.py"), *share.glob("potentials/*.py")]
                 if "__main__" in path.read_text(encoding="utf-8")]
        self.assertGreater(len(tools), 5)
        for tool in tools:
            self.assertIn("usage:", output(["/usr/bin/python3", tool, "--help"], self.folder))
        finds = "from rbc import command_line; print(command_line.default_executable())"
        self.assertEqual(output(["/usr/bin/python3", "-c", finds], share / "scripts").strip(),
                         str(self.prefix / "bin" / "lmp_rbc"))

    def test_the_python_package_is_found(self):
        modules = self.prefix / "lib" / "python3" / "dist-packages"
        found = output(["/usr/bin/python3", "-c", "import rbc; print(rbc.__file__)"], modules)
        self.assertEqual(Path(found.strip()), modules / "rbc" / "__init__.py")

    def run_in_python(self, path, imported, start, **variables):
        """What Python prints last, once it has run the scene and the cell's volume was right."""
        module = self.prefix / "share" / "user-rbc" / "python" / "lammps" / "__init__.py"
        if not module.exists():
            self.skipTest("Debian's liblammps loads no plugins")
        words = "'-screen', 'none', '-log', 'none'"
        program = (f"import os, {imported}; lmp = {start.format(words)}; lmp.file('in.scene'); "
                   "import lammps; print(lmp.extract_compute('cell', 0, 2)[0][5]); "
                   "print(lammps.__file__); print(os.environ['LAMMPS_POTENTIALS'])")
        volume, found, potentials = output(["/usr/bin/python3", "-c", program], self.folder,
                                           PYTHONPATH=str(path), **variables).splitlines()
        np.testing.assert_allclose(float(volume), template_volume(), rtol=1e-6)
        self.assertEqual(Path(found), module)
        return potentials

    def test_python_module_of_lammps_finds_its_library(self):
        share = self.prefix / "share" / "user-rbc"
        self.run_in_python(share / "python", "lammps", "lammps.lammps(cmdargs=[{}])",
                           LAMMPS_PLUGIN_PATH=str(self.prefix / "lib" / "user-rbc"),
                           LAMMPS_POTENTIALS=str(share / "potentials"))

    def test_python_package_starts_lammps_with_no_variable_set(self):
        modules = self.prefix / "lib" / "python3" / "dist-packages"
        potentials = self.run_in_python(modules, "rbc", "rbc.start_lammps({})")
        self.assertEqual(Path(potentials), self.prefix / "share" / "user-rbc" / "potentials")

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_manual_page_has_no_mistakes(self):
        page = self.prefix / "share" / "man" / "man1" / "lmp_rbc.1"
        self.assertEqual(output(["groff", "-man", "-ww", "-z", page], self.folder), "")
        self.assertIn(version(), page.read_text())


if __name__ == "__main__":
    unittest.main()
