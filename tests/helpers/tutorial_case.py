"""Runs the commands that a tutorial shows, in a copy of its folder, and compares what they print.

In a page `.. code-block:: text` holds commands, and the `.. code-block:: none` that follows it
lines of what they print, in their order.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

from lammps_case import ENVIRONMENT, ROOT, Result

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
BLOCK = re.compile(r"^\.\. code-block:: (text|none)\n\n((?:   .*\n|\n)+)", re.MULTILINE)


def steps_of(page):
    """[(commands, lines that they print)] of a page."""
    text = (ROOT / "doc" / f"{page}.rst").read_text(encoding="utf-8")
    steps = []
    for language, block in BLOCK.findall(text):
        lines = [line.strip() for line in block.replace("\\\n", "").splitlines() if line.strip()]
        if language == "text":
            steps.append((lines, []))
        else:
            steps[-1][1].extend(lines)
    return steps


def workplace(page, example):
    """The folder of an example, copied, with all around it that commands of a page name."""
    top = Path.cwd() / page
    shutil.rmtree(top, ignore_errors=True)
    folder = top / "examples" / example
    folder.mkdir(parents=True)
    for pattern in ("in.*", "*.txt", "*.py"):
        for path in (ROOT / "examples" / example).glob(pattern):
            shutil.copy(path, folder)
    for name in ("scripts", "potentials"):
        (top / name).symlink_to(ROOT / name)
    for name, tool in (("build", "LMP_RBC"), ("bin", "MPIEXEC")):
        (top / name).mkdir()
        (top / name / ("lmp_rbc" if name == "build" else "mpirun")).symlink_to(os.environ[tool])
    return folder


def same(shown, printed, tolerance, timed):
    """Whether texts are the same and numbers nearly; where runs are timed the last one is free."""
    if NUMBER.sub("@", shown).split() != NUMBER.sub("@", printed).split():
        return False
    pairs = [(float(a), float(b))
             for a, b in zip(NUMBER.findall(shown), NUMBER.findall(printed))]
    return all(abs(a - b) <= tolerance * max(abs(a), abs(b))
               for a, b in pairs[:-1 if timed else None])


def follow(page, example, tolerance=0.01, timed=False, free=()):
    """Runs all commands of a page; (folder, the Result of each group of them). Lines that begin
    with a word of `free` may be missing: the machine decides what is in them."""
    folder = workplace(page, example)
    tools = folder.parents[1] / "bin"
    environment = {**os.environ, **ENVIRONMENT, "PATH": f"{tools}:{os.environ['PATH']}"}
    results, lmp = [], os.environ["LMP_RBC"]
    for commands, shown in steps_of(page):
        # which runs build/lmp_rbc of the repository unless told otherwise
        script = "\n".join(commands).replace("converge.py ", f"converge.py --lmp {lmp} ")
        done = subprocess.run(["bash", "-e", "-c", script], cwd=folder, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, timeout=500,
                              stderr=subprocess.STDOUT, check=False, env=environment)
        if done.returncode:
            raise AssertionError(f"{commands}\n{done.stdout}")
        printed = iter(done.stdout.splitlines())
        for line in shown:
            if not line.startswith(tuple(free)) and not any(
                    same(line, other, tolerance, timed) for other in printed):
                raise AssertionError(f"{page}: not printed here: {line}\n{done.stdout}")
        results.append(Result(folder, done.returncode, done.stdout))
    return folder, results
