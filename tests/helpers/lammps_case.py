"""Runs an input script through lmp_rbc (or stock lmp with the plugin) and reads what it wrote.

The executables come from the environment, as ctest sets them: LMP_RBC, RBC_PLUGIN, LMP, MPIEXEC.
Every run has a folder of its own, case<n>, in the current folder.
"""

import itertools
import os
import re
import shutil
import subprocess
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
POTENTIALS = ROOT / "potentials"

# As in scripts/common.sh, for a bare `python3 -m unittest`.
ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none", "OMP_NUM_THREADS": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
    "PRTE_MCA_hwloc_default_binding_policy": "none", "HWLOC_COMPONENTS": "-gl"}

# One red blood cell in shear between plates, in the order of the lines of an input script.
SHEAR = {
    "units": "units micro",
    "newton": "",
    "style": "atom_style molecular",
    "boundary": "boundary p p f",
    "processors": "",
    "box": "region box block 0 12 0 12 0 12",
    "create_box": "create_box 1 box angle/types 1",
    "molecule": f"molecule rbc {POTENTIALS}/rbc_162.mol",
    "cells": "rbc/create rbc single 6 6 6 rotate 30 1 0 0",
    "neighbor": "neighbor 1.0 bin",
    "before": "",
    "membrane": "fix mem all rbc/membrane rbc mooney-rivlin 0.257 0.0257 0.01 bending 2.0e-4 "
                "volume yes",
    "fluid": "fix flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 inertia none"
             " wall zlo 0 0 0 wall zhi 0.0012 0 0",
    "ib": "fix ib all rbc/ib flow kernel peskin4 integrator midpoint",
    "compute": "",
    "thermo": "thermo_style custom step f_mem f_flow[11]",
    "thermo_modify": "thermo_modify format float %.17g",
    "every": "thermo 10",
    "timestep": "timestep 200",
    "dump": "",
    "last": "",
    "run": "run 0"}


def write_plain_numbers():
    """Scripts hold the repr() of numbers: in this thread that of NumPy 2 is the number alone."""
    if not np.__version__.startswith("1."):
        np.set_printoptions(legacy="1.25")


write_plain_numbers()


def version():
    """Of the package, as CMakeLists.txt says it."""
    return re.search(r"^project\(\S+ VERSION (\S+) ", (ROOT / "CMakeLists.txt").read_text(),
                     re.MULTILINE).group(1)


def scene(base=SHEAR, **changes):
    """The script of `base` with some lines changed, dropped (None) or filled in, by the names of
    the lines."""
    unknown = changes.keys() - base.keys()
    if unknown:
        raise KeyError(f"no such line: {unknown}")
    return "\n".join(line for line in {**base, **changes}.values() if line) + "\n"


def push(forces):
    """Lines of a script that add these forces, a row for each atom, and the files that they
    need."""
    columns = {f"f{axis}": forces[:, d].tolist() for d, axis in enumerate("xyz")}
    lines = [f"variable {name} atomfile {name}.txt" for name in columns]
    files = {f"{name}.txt": f"{len(values)}\n" +
             "".join(f"{n} {value!r}\n" for n, value in enumerate(values, 1))
             for name, values in columns.items()}
    return "\n".join([*lines, "fix push all addforce v_fx v_fy v_fz"]), files


class Failed(Exception):
    """The run ended with an error; what() is the text after ERROR."""

    def __init__(self, result):
        super().__init__(result.printed)
        self.result = result


class Result:
    """What a run left in its folder."""

    def __init__(self, folder, code, printed):
        self.folder, self.code, self.printed = folder, code, printed

    @property
    def error(self):
        """The error message with its line of the script, in one line."""
        found = re.search(r"^ERROR(?: on proc \d+)?: (.*\n(?:Last input line:.*)?)", self.printed,
                          re.MULTILINE)
        return " ".join(found.group(1).split()) if found else ""

    def tables(self):
        """One dictionary of columns for each run of the script."""
        found = []
        for text in re.findall(r"^ +(Step .*?)^(?:Loop time|\n|ERROR|WARNING)", self.printed,
                               re.MULTILINE | re.DOTALL):
            head, *rows = text.strip().splitlines()
            names = head.split()
            rows = [row.split() for row in rows if len(row.split()) == len(names)]
            data = np.array([[float(word) for word in row] for row in rows]).reshape(-1, len(names))
            found.append(dict(zip(names, data.T)))
        return found

    @property
    def thermo(self):
        """All runs' tables in one; a step at which a run ends and the next begins comes twice."""
        tables = self.tables()
        return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}

    def path(self, name):
        return self.folder / name

    def dump(self, name="atoms.dump"):
        return Dump(self.path(name))


class Dump:
    """A text dump of atoms, sorted by atom ID, or of a grid, in LAMMPS's order (x fastest)."""

    def __init__(self, path):
        self.steps, self.columns, frames = [], [], []
        blocks = Path(path).read_text().split("ITEM: TIMESTEP\n")[1:]
        for block in blocks:
            head, body = re.split(r"^ITEM: (?=ATOMS|GRID CELLS)", block, flags=re.MULTILINE)
            self.steps.append(int(head.split()[0]))
            count = int(np.prod([int(word) for word in
                                 re.search(r"ITEM: (?:NUMBER OF ATOMS|GRID SIZE.*)\n(.*)", head)
                                 .group(1).split()]))
            names, *rows = body.splitlines()
            self.columns = names.split()[2 if names.startswith("GRID") else 1:]
            data = np.array(" ".join(rows).split(), dtype=float)
            if data.size != count * len(self.columns):
                raise ValueError(f"{path}: step {self.steps[-1]} is cut off")
            data = data.reshape(count, len(self.columns))
            if "id" in self.columns:
                data = data[np.argsort(data[:, self.columns.index("id")], kind="stable")]
            frames.append(data)
        self.frames = frames

    def __call__(self, *columns, frame=-1):
        data = self.frames[frame][:, [self.columns.index(column) for column in columns]]
        return data[:, 0] if len(columns) == 1 else data

    def positions(self, frame=-1):
        return self("xu", "yu", "zu", frame=frame)

    def forces(self, frame=-1):
        return self("fx", "fy", "fz", frame=frame)


def read_template(path):
    """Coordinates and triangles (from 0) of a molecule file."""
    sections, rows = {}, None
    for line in Path(path).read_text().splitlines()[1:]:
        words = line.split()
        if words and words[0].isalpha():
            rows = sections.setdefault(words[0], [])
        elif words and rows is not None:
            rows.append([float(word) for word in words])
    return np.array(sections["Coords"])[:, 1:], np.array(sections["Angles"])[:, 2:].astype(int) - 1


def make_template(*words):
    """Runs potentials/make_template.py."""
    done = subprocess.run([sys.executable, POTENTIALS / "make_template.py", *map(str, words)],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode:
        raise AssertionError(done.stdout)


def dump_line(every, name="atoms.dump", columns="id mol type xu yu zu fx fy fz"):
    return (f"dump atoms all custom {every} {name} {columns}\n"
            "dump_modify atoms sort id format float %.17g")


_numbers = itertools.count(1)


class Job:
    """A run that has been started; its end is that of the block it is used in.

    files: name -> text, written beside the script first. prepare(folder) is called before the
    start, before() in the process that is started.
    """

    def __init__(self, script, ranks=1, plugin=False, files=None, prepare=None, before=None):
        if plugin and os.environ.get("RBC_SANITIZE"):
            raise unittest.SkipTest(
                "the runtime of the sanitizers is in lmp_rbc, not in stock LAMMPS")
        self.folder = Path.cwd() / f"case{next(_numbers)}"
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()
        for name, text in (files or {}).items():
            (self.folder / name).write_text(text)
        executable = os.environ["LMP"] if plugin else os.environ["LMP_RBC"]
        if plugin:
            script = f"plugin load {os.environ['RBC_PLUGIN']}\n" + script
        (self.folder / "in.case").write_text(script)
        if prepare:
            prepare(self.folder)
        command = [executable, "-in", "in.case", "-log", "log.case"]
        if ranks > 1:    # one rank starts faster by itself
            command = [os.environ["MPIEXEC"], "-np", str(ranks), *command]
        # A run that ends removes the folder of Open MPI's sessions, which another may be about to
        # use.
        self._session = TemporaryDirectory()
        with open(self.folder / "printed", "w") as output:
            self.process = subprocess.Popen(
                command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, preexec_fn=before, restore_signals=before is None,
                env={**os.environ, **ENVIRONMENT, "OMPI_MCA_orte_tmpdir_base": self._session.name,
                     "PRTE_MCA_prte_tmpdir_base": self._session.name})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.wait()
        self._session.cleanup()

    def end(self, timeout=120):
        try:
            code = self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"{self.folder}: no end after {timeout} s") from None
        return Result(self.folder, code, (self.folder / "printed").read_text(errors="replace"))


def attempt(script, ranks=1, timeout=120, **options):
    with Job(script, ranks, **options) as job:
        return job.end(timeout)


def run(script, ranks=1, **options):
    result = attempt(script, ranks, **options)
    if result.code:
        raise Failed(result)
    return result


def in_parallel(function, arguments, workers=2):
    """[function(*argument) for argument in arguments], some at a time."""
    with ThreadPoolExecutor(workers, initializer=write_plain_numbers) as pool:
        return list(pool.map(lambda argument: function(*argument), arguments))
