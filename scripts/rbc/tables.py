"""Read the tables of a run: LAMMPS `fix ave/time`, whitespace tables and reference CSV files."""
import re
from typing import NamedTuple

import numpy as np

from rbc.errors import InputError


class History(NamedTuple):
    """Blocks of `fix ave/time ... mode vector`, in the units of the run."""
    steps: np.ndarray  # (nsteps,)
    data: np.ndarray   # (nsteps, nrows, ncols)
    names: tuple       # of the columns, for example "c_cell[7]"

    def column(self, number):
        """Column `number` (from 1) of the array behind the file, as (nsteps, nrows).

        The header tells c_cell[7] apart wherever it stands; without brackets position counts.
        """
        indices = [re.findall(r"\[(\d+)\]$", name) for name in self.names]
        if all(indices):
            matches = [i for i, index in enumerate(indices) if int(index[-1]) == number]
        else:
            matches = [number - 1] if number <= len(self.names) else []
        if not matches:
            raise KeyError(f"column {number} is not in the file, which has {' '.join(self.names)}")
        return self.data[:, :, matches[0]]

    def columns(self, first, last):
        """Columns first to last as (nsteps, nrows, last - first + 1)."""
        return np.stack([self.column(i) for i in range(first, last + 1)], axis=2)


def read_ave_time(path):
    """Read a `fix ave/time ... mode vector file` output; a block cut short at the end is left out.

    Files that were appended to are read as one: a step that ends one run and begins the next counts
    once. The number of rows must not change.
    """
    with open(path, encoding="utf-8") as stream:
        lines = stream.read().rpartition("\n")[0].splitlines()
    header = next((line.split()[2:] for line in lines if line.startswith("# Row")), None)
    lines = [line for line in lines if line.strip() and not line.startswith("#")]
    if len(lines) < 2:
        raise InputError(f"{path} holds no complete block")
    rows, columns = int(lines[0].split()[1]), len(lines[1].split()) - 1
    names = tuple(header or (str(i + 1) for i in range(columns)))
    if rows < 1 or len(names) != columns:
        raise InputError(f"{path} is not a fix ave/time file in vector mode")
    blocks = len(lines) // (rows + 1)
    values = np.array(" ".join(lines[:blocks * (rows + 1)]).split(), dtype=float)
    if values.size != blocks * (2 + rows * (columns + 1)):
        raise InputError(f"{path}: the blocks differ in size")
    values = values.reshape(blocks, -1)
    table = values[:, 2:].reshape(blocks, rows, columns + 1)
    if np.any(values[:, 1] != rows) or np.any(table[:, :, 0] != np.arange(1, rows + 1)):
        raise InputError(f"{path}: the number of rows changes")
    steps = values[:, 0].astype(int)
    last = np.append(steps[1:] != steps[:-1], True)
    return History(steps[last], table[last, :, 1:], names)


def read_table(path):
    """Columns by name of a whitespace table; the last `#` line above the data names them."""
    with open(path, encoding="utf-8") as stream:
        lines = [line.split() for line in stream if line.strip()]
    rows = [line for line in lines if not line[0].startswith("#")]
    comments = [line for line in lines[:lines.index(rows[0])] if line != ["#"]] if rows else []
    if not comments:
        raise InputError(f"{path} needs a line '# name name ...' above its numbers")
    names = " ".join(comments[-1]).lstrip("# ").split()
    values = np.array(rows, dtype=float)
    if values.shape[1] != len(names):
        raise InputError(f"{path}: {len(names)} names but {values.shape[1]} columns")
    return dict(zip(names, values.T))


def read_csv(path):
    """Rows (name -> text) of a CSV file with `#` comments; commas in parentheses do not split."""
    with open(path, encoding="utf-8") as stream:
        rows = [re.split(r",(?![^(]*\))", line.strip()) for line in stream
                if line.strip() and not line.startswith("#")]
    names, *rows = rows
    return [dict(zip(names, row)) for row in rows]
