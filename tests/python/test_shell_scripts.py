"""Scripts that build say what a machine lacks, as sudo, home, network or Debian, and leave
nothing."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
TOOLS = ("bash", "dirname", "basename", "grep", "awk", "nproc", "mktemp", "mkdir", "rm", "rmdir",
         "cat", "md5sum", "cut", "env", "find", "mv", "tar", "touch", "gzip")
ARCHIVE = "http://archive.invalid/debian"


def run(script, *words, **options):
    return subprocess.run(["bash", script, *words], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False, timeout=60, **options)


class Machine(unittest.TestCase):
    """A PATH with little on it."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        for name in ("bin", "tmp"):
            (self.folder / name).mkdir()
        for name in TOOLS:
            (self.folder / "bin" / name).symlink_to(shutil.which(name))

    def tool(self, name, script):
        path = self.folder / "bin" / name
        path.unlink(missing_ok=True)    # never write through a link to the machine's own tool
        path.write_text(f"#!/bin/bash\n{script}\n")
        path.chmod(0o755)

    def apt_get(self, case):
        """All packages are there, and apt-get knows an archive."""
        self.tool("dpkg-query", 'echo "install ok installed"')
        self.tool("apt-get", 'case $1 in indextargets) . /etc/os-release && '
                             f'echo "main {ARCHIVE} $VERSION_CODENAME" ;; {case} esac')

    def fails(self, script, *words, **environment):
        """What a script says that ends with an error."""
        variables = {"PATH": str(self.folder / "bin"), "TMPDIR": str(self.folder / "tmp"),
                     "USER_RBC_CACHE": str(self.folder / "cache"), **environment}
        done = run(SCRIPTS / script, *words,
                   env={name: value for name, value in variables.items() if value})
        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["bin", "tmp"])
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])
        return done.stdout

    def test_without_a_home(self):
        for script in ("build.sh", "html.sh", "lammps.sh", "python.sh", "test.sh"):
            self.assertIn(f"{script}: HOME is not set: set USER_RBC_CACHE",
                          self.fails(script, USER_RBC_CACHE=""))

    def test_python_gets_the_folders_of_what_is_built(self):
        environment = {**os.environ, "USER_RBC_CACHE": str(self.folder / "cache"),
                       "USER_RBC_BUILD": str(self.folder / "build"), "LAMMPS_PLUGIN_PATH": "/mine"}
        done = run("-c", '. "$0/common.sh"; . "$0/lammps_version.sh" 4Feb2025; '
                   'echo "$LAMMPS_HOME $LAMMPS_BUILD"', SCRIPTS, env=environment)
        home, lammps = map(Path, done.stdout.split())
        (home / "source").mkdir(parents=True)
        (self.folder / "build").mkdir()
        (self.folder / "build" / "rbcplugin.so").touch()
        done = run(SCRIPTS / "python.sh", "-c", "import os, sys, rbc.tables; print(sys.argv[1:], "
                   "os.environ['LD_LIBRARY_PATH'].split(':')[0], "
                   "os.environ['LAMMPS_PLUGIN_PATH'], sys.path[2])", "a b", env=environment)
        self.assertEqual(done.stdout, f"['a b'] {lammps} {self.folder}/build:/mine "
                                      f"{home}/source/python\n")

    def test_of_an_unknown_version(self):
        self.assertIn("build.sh: LAMMPS version 'old' is not known; use 4Feb2025 or newest",
                      self.fails("build.sh", "old"))

    def test_without_root_and_sudo(self):
        self.tool("id", "echo 1000")
        self.tool("apt-get", "exit 1")
        self.tool("dpkg-query", '[ "${@: -1}" = cmake ] || echo "install ok installed"')
        message = ("dependencies.sh: these Debian packages are missing: cmake; "
                   "install them as root: apt-get install ")
        self.assertIn(message, self.fails("build.sh"))
        self.tool("sudo", "exit 1")    # would ask for a password
        self.assertIn(message, self.fails("build.sh"))

    def test_without_debian(self):
        self.assertIn("(there is no apt-get here", self.fails("build.sh"))

    def test_without_a_network(self):
        self.apt_get('*) echo "E: Could not resolve archive.invalid" >&2; exit 100 ;;')
        printed = self.fails("build.sh")
        self.assertIn("lammps.sh: the LAMMPS 4Feb2025 source could not be fetched from " + ARCHIVE,
                      printed)
        self.assertIn("is there a network?", printed)

    def test_with_many_archives(self):
        """The first that fits counts, and apt-get can print all others behind it."""
        self.tool("apt-get", 'for ((n = 0; n < 20000; ++n)); do printf "main %s/$n trixie\\n" '
                             f"{ARCHIVE} || exit 100; done")
        done = run("-c", '. "$0/common.sh"; archive_of trixie', SCRIPTS,
                   env={"PATH": str(self.folder / "bin"), "USER_RBC_CACHE": str(self.folder)})
        self.assertEqual((done.stdout, done.returncode), (f"{ARCHIVE}/0\n", 0))

    def test_with_an_archive_that_is_cut_off(self):
        self.apt_get("source) echo cut off > lammps_1.orig.tar.gz ;;")
        self.fails("build.sh", USER_RBC_CACHE=str(self.folder / "tmp"))

    def source_of(self, archive):
        """Debian has a LAMMPS of this archive, which lammps.sh newest then has the source of."""
        tree = self.folder / archive / "src"
        tree.mkdir(parents=True)
        (tree / "lammps.h").write_text(archive)
        self.apt_get(f"source) case $* in *--print-uris*) echo \"'http' {archive} 1 SHA256:0\" ;; "
                     f"*) tar -czf {archive} -C {self.folder / archive} . ;; esac ;;")
        self.tool("cmake", 'for word; do [ "$last" != -B ] || mkdir -p "$word"; last=$word; done')
        done = run(SCRIPTS / "lammps.sh", "newest", env={
            "PATH": str(self.folder / "bin"), "TMPDIR": str(self.folder / "tmp"),
            "USER_RBC_CACHE": str(self.folder / "cache"), "USER_RBC_OWN_LAMMPS": "1"})
        self.assertEqual(done.returncode, 0, done.stdout)
        shutil.rmtree(self.folder / archive)
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])
        header = self.folder / "cache" / "lammps-newest" / "source" / "src" / "lammps.h"
        return header.read_text(), done.stdout

    def test_the_newest_is_fetched_when_debian_has_another(self):
        first, second = "lammps_1.orig.tar.gz", "lammps_2.orig.tar.gz"
        for archive, fetched in ((first, True), (first, False), (second, True)):
            there, printed = self.source_of(archive)
            self.assertEqual(there, archive)
            self.assertEqual("fetching the LAMMPS newest" in printed, fetched, printed)
            self.assertEqual("building LAMMPS newest" in printed, fetched, printed)


class Syntax(unittest.TestCase):
    def test_of_all_scripts(self):
        scripts = [path for folder in ("bench", "scripts")
                   for path in sorted((SCRIPTS.parent / folder).glob("*.sh"))]
        self.assertGreater(len(scripts), 30)
        for script in scripts:
            with self.subTest(script.name):
                done = run("-n", script)
                self.assertEqual((done.stdout, done.returncode), ("", 0))


class Benchmarks(unittest.TestCase):
    def test_ask_where_results_go_before_they_build(self):
        scripts = sorted((SCRIPTS.parent / "bench").glob("*.sh"))
        self.assertGreater(len(scripts), 12)
        for script in scripts:
            with self.subTest(script.name):
                done = run(script)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("path of the other lmp_rbc" if script.name == "compare_builds.sh" else
                              f"{script.name}: say where results go: --output FOLDER", done.stdout)


if __name__ == "__main__":
    unittest.main()
