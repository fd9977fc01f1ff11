"""Runs that are killed, and files that cannot be written: no hang, and no broken file is taken for
a whole one.

A file under way is a pipe that is read no further: what writes it waits in the middle.
"""

import fcntl
import os
import signal
import struct
import subprocess
import termios
import time
import unittest
from pathlib import Path

import numpy as np

from lammps_case import SHEAR, Job, attempt, dump_line, in_parallel, run, scene

PIPE_BYTES = 4096       # the least that a pipe holds
COLUMNS = "id xu yu zu vx vy vz"
BOX = dict.fromkeys(("units", "style", "newton", "boundary", "processors", "box", "create_box",
                     "cells"))
# A flow with a history, which goes into restart files, too. A restart builds lists of neighbours
# anew.
CASE = dict(neighbor=SHEAR["neighbor"] + "\nneigh_modify every 1 delay 0 check no",
            fluid=SHEAR["fluid"].replace("inertia none", "inertia unsteady"), timestep="timestep 1")
GOOD, BAD = "good.restart", "bad.restart"


def written(**changes):
    """The script of a run that writes GOOD at step 5 and BAD at step 10."""
    return scene(**{**CASE, "run": f"restart 5 {GOOD} {BAD}\nrun 15", **changes})


def continued(file, **changes):
    return scene(**{**CASE, **BOX, "style": f"read_restart {file}", "run": "run 15 upto",
                    "dump": dump_line(15, columns=COLUMNS), **changes})


def children(pid):
    """Process IDs of the MPI tasks of an mpiexec."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except (OSError, IndexError):
            continue
        if entry.name.isdigit() and int(fields[1]) == pid:
            found.append(int(entry.name))
    return sorted(found)


class Pipe:
    """A pipe under the name of a file; what is written to it stops after some bytes."""

    def __init__(self, path):
        os.mkfifo(path)
        self.descriptor = os.open(path, os.O_RDWR | os.O_NONBLOCK)
        fcntl.fcntl(self.descriptor, fcntl.F_SETPIPE_SZ, PIPE_BYTES)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.descriptor)

    def waiting(self):
        count = fcntl.ioctl(self.descriptor, termios.FIONREAD, struct.pack("i", 0))
        return struct.unpack("i", count)[0]

    def wait_until_full(self, process, seconds=60):
        end = time.monotonic() + seconds
        while self.waiting() < PIPE_BYTES:
            if process.poll() is not None or time.monotonic() > end:
                raise AssertionError("no file was written")
            time.sleep(0.01)

    def content(self):
        return os.read(self.descriptor, PIPE_BYTES)


class Killed(unittest.TestCase):
    def broken_off(self, ranks, number, targets):
        """Ends tasks of a run while it writes BAD; returns its folder, where BAD is what there was
        of it."""
        pipes = []

        def prepare(folder):
            pipes.append(Pipe(folder / BAD))
        with Job(written(), ranks, prepare=prepare) as job, pipes[0] as pipe:
            pipe.wait_until_full(job.process)
            tasks = children(job.process.pid) if ranks > 1 else [job.process.pid]
            self.assertEqual(len(tasks), ranks)
            for pid in targets(job.process.pid, tasks):
                os.kill(pid, number)
            code = job.process.wait(60)
            content = pipe.content()
        self.assertNotEqual(code, 0)
        (job.folder / BAD).unlink()
        (job.folder / BAD).write_bytes(content)
        return job.folder

    def test_a_restart_goes_on_from_the_last_whole_file(self):
        whole = {ranks: run(written(dump=dump_line(15, columns=COLUMNS)), ranks).dump().frames[-1]
                 for ranks in (1, 2)}
        everyone, one, last = ((lambda _, tasks: tasks), (lambda _, tasks: tasks[:1]),
                               (lambda _, tasks: tasks[-1:]))
        cases = {"kill the only task": (1, signal.SIGKILL, everyone),
                 "kill all": (2, signal.SIGKILL, everyone),
                 "kill one": (2, signal.SIGKILL, one), "kill another": (2, signal.SIGKILL, last),
                 "kill mpiexec and all": (2, signal.SIGKILL,
                                          lambda launcher, tasks: [*tasks, launcher]),
                 "terminate the only task": (1, signal.SIGTERM, everyone),
                 "terminate mpiexec": (2, signal.SIGTERM, lambda launcher, tasks: [launcher]),
                 "terminate one": (2, signal.SIGTERM, one)}
        folders = dict(zip(cases, in_parallel(self.broken_off, cases.values())))
        for name, folder in folders.items():
            with self.subTest(name):
                ranks = cases[name][0]
                refused = attempt(continued(folder / BAD), ranks)
                self.assertNotEqual(refused.code, 0)
                self.assertTrue(refused.error, refused.printed)
                after = run(continued(folder / GOOD), ranks).dump()
                self.assertEqual(after.steps[-1], 15)
                np.testing.assert_array_equal(after.frames[-1], whole[ranks])

    def test_a_file_cut_anywhere_is_refused(self):
        folder = run(scene(**CASE, run=f"run 5\nwrite_restart {GOOD}")).folder
        content = (folder / GOOD).read_bytes()
        places = [0, 1, 20, 500, *(len(content) * n // 8 for n in range(1, 8)), len(content) - 1]
        for place in places:
            (folder / f"cut.{place}").write_bytes(content[:place])
        results = in_parallel(lambda place: attempt(continued(folder / f"cut.{place}")),
                              [(place,) for place in places])
        for place, result in zip(places, results):
            with self.subTest(bytes=place, of=len(content)):
                # LAMMPS 4Feb2025 crashes after its error if names of groups are cut
                self.assertNotEqual(result.code, 0, result.printed)
                self.assertTrue(result.error, result.printed)


VTK = "fix surfaces all rbc/vtk 1 {}"
OUTPUTS = {    # name -> (lines before the run, file of step 1)
    "fix rbc/vtk": (dict(dump=VTK.format("{}cells.*.vtp")), "cells.1.vtp"),
    "fix rbc/vtk, pieces": (dict(dump=VTK.format("{}cells.*.pvtp")), "cells.1_0.vtp"),
    "dump": (dict(dump="dump atoms all custom 1 {}atoms.*.dump id xu yu zu vx vy vz fx fy fz\n"
                  "dump_modify atoms format float %.17g"), "atoms.1.dump"),
    "restart": (dict(dump="restart 1 {}r.*"), "r.1"),
}


class NotWritten(unittest.TestCase):
    """A run whose output cannot be written ends with an error of LAMMPS that says so."""

    def outputs(self, folder=""):
        for name, (lines, file) in OUTPUTS.items():
            script = scene(**{**CASE, **{line: text.format(folder) for line, text in lines.items()},
                              "run": "run 2"})
            for ranks in (1, 2):
                yield name, ranks, script, file

    def check(self, result, words):
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertGreater(result.code, 0, result.printed)
        self.assertNotIn("exited on signal", result.printed)
        self.assertRegex(result.error, words, result.printed)

    def check_all(self, words, folder="", prepare=None):
        """prepare(path): of the file of step 1, before the start."""
        cases = list(self.outputs(folder))
        results = in_parallel(lambda name, ranks, script, file: attempt(
            script, ranks, prepare=prepare and (lambda folder: prepare(folder / file))), cases)
        for (name, ranks, *_), result in zip(cases, results):
            with self.subTest(name, ranks=ranks):
                self.check(result, words)

    def test_full_disk(self):
        self.check_all(r"(?i)error writing|cannot write|I/O error|no space",
                       prepare=lambda path: path.symlink_to("/dev/full"))

    def test_no_such_folder(self):
        self.check_all("(?i)cannot open", "none/")

    def test_a_folder_of_that_name(self):
        self.check_all("(?i)cannot open", prepare=Path.mkdir)


if __name__ == "__main__":
    unittest.main()
