"""The libFuzzer targets of readers without LAMMPS, for some seconds; scripts/fuzz.sh runs all of
them for longer."""

import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from lammps_case import ROOT

TARGETS = "stl", "template"
SECONDS = 10


def clang_links_libfuzzer():
    """Whether there is a clang with libFuzzer's and the sanitizers' runtime."""
    if not shutil.which("clang++"):
        return False
    source = Path("empty_fuzz.cpp")
    source.write_text('extern "C" int LLVMFuzzerTestOneInput(const unsigned char *, unsigned long) '
                      '{ return 0; }\n')
    done = subprocess.run(["clang++", "-fsanitize=fuzzer,address,undefined", source, "-o",
                           "empty_fuzz"],
                          capture_output=True, check=False)
    return done.returncode == 0


def ended_well(*command, **options):
    done = subprocess.run(list(map(str, command)), text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False, **options)
    if done.returncode:
        raise AssertionError(f"{command}:\n{done.stdout[-5000:]}")
    return done.stdout


class Fuzzers(unittest.TestCase):
    @unittest.skipUnless(clang_links_libfuzzer(),
                         "needs Debian's clang and libclang-rt-dev, which scripts/fuzz.sh installs")
    def test_nothing_is_found(self):
        build = Path.cwd() / "build"
        ended_well("cmake", "--preset", "fuzz", "-B", build, cwd=ROOT)
        ended_well("cmake", "--build", build, "--target", *(f"{target}_fuzz" for target in TARGETS))
        ended_well(sys.executable, ROOT / "tests" / "fuzz" / "seeds.py", "seeds")
        for target in TARGETS:
            with self.subTest(target):
                corpus = Path("corpus") / target
                shutil.rmtree(corpus, ignore_errors=True)
                corpus.mkdir(parents=True)
                printed = ended_well(build / f"{target}_fuzz", "-seed=18",
                                     f"-max_total_time={SECONDS}", "-timeout=120",
                                     f"-dict=seeds/{target}.dict", corpus, f"seeds/{target}")
                print(printed.strip().splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
