"""Read the tables of a run: LAMMPS `fix ave/time`, whitespace tables and reference CSV files."""
import re
from typing import NamedTuple

import numpy as np

from rbc.errors import InputError
from rbc.text_files import Columns, as_numbers, kind_of, read_head, refuse_others


class History(NamedTuple):
    """Blocks of `fix ave/time ... mode vector`, in the units of the run."""
    steps: np.ndarray  # (nsteps,)
    data: np.ndarray   # (nsteps, nrows, ncols)
    names: tuple       # of the columns, for example "c_cell[7]"

    def __repr__(self):
        return overview(self.steps, self.data.shape[1], "row", self.names)

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
            raise InputError(f"column {number} is not in the file, which has "
                             f"{' '.join(self.names)}")
        return self.data[:, :, matches[0]]

    def columns(self, first, last):
        """Columns first to last as (nsteps, nrows, last - first + 1)."""
        return np.stack([self.column(i) for i in range(first, last + 1)], axis=2)


def overview(steps, count, what, names):
    """Two lines on a table of blocks."""
    some = f"{count} {what}" if count == 1 else f"{count} {what}s"
    when = f"{len(steps)} steps {steps[0]} to {steps[-1]}" if len(steps) > 1 else f"step {steps[0]}"
    return f"{when}, {some}\ncolumns {' '.join(names)}"


def read_ave_time(path):
    """History of a file of fix ave/time in mode vector, or the columns of one in mode scalar."""
    return read_table(path) if kind_of(read_head(path)) == "table" else read_blocks(path)


def read_blocks(path):
    """Read a `fix ave/time ... mode vector file` output; a block cut short at the end is left out.

    Files that were appended to are read as one: a step that ends one run and begins the next counts
    once. The number of rows must not change.
    """
    with open(path, encoding="utf-8", errors="replace") as stream:
        text = stream.read()
    refuse_others(path, text, "blocks")
    lines = text.rpartition("\n")[0].splitlines()
    header = next((line.split()[2:] for line in lines if line.startswith("# Row")), None)
    lines = [line for line in lines if line.strip() and not line.startswith("#")]
    if len(lines) < 2:
        raise InputError(f"{path} holds no complete block")
    columns, second = len(lines[1].split()) - 1, lines[0].split()[1:2]
    names = tuple(header or (str(i + 1) for i in range(columns)))
    rows = int(second[0]) if second and second[0].isdigit() else 0
    if rows < 1 or len(names) != columns:
        raise InputError(f"{path} is not a fix ave/time file in vector mode; read_table reads "
                         "tables with a line of names")
    blocks = len(lines) // (rows + 1)
    values = as_numbers(path, " ".join(lines[:blocks * (rows + 1)]).split())
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
    with open(path, encoding="utf-8", errors="replace") as stream:
        text = stream.read()
    refuse_others(path, text, "table")
    lines = [line.split() for line in text.splitlines() if line.strip()]
    rows = [line for line in lines if not line[0].startswith("#")]
    comments = [line for line in lines[:lines.index(rows[0])] if line != ["#"]] if rows else []
    if not comments:
        raise InputError(f"{path} needs a line '# name name ...' above its numbers")
    names = " ".join(comments[-1]).lstrip("# ").split()
    values = as_numbers(path, rows)
    if values.shape[1] != len(names):
        raise InputError(f"{path}: {len(names)} names but {values.shape[1]} columns")
    return Columns(zip(names, values.T))


def read_csv(path):
    """Rows (name -> text) of a CSV file with `#` comments; commas in parentheses do not split."""
    with open(path, encoding="utf-8", errors="replace") as stream:
        rows = [re.split(r",(?![^(]*\))", line.strip()) for line in stream
                if line.strip() and not line.startswith("#")]
    if not rows:
        raise InputError(f"{path} holds no line with names of columns")
    names, *rows = rows
    return [Columns(zip(names, row)) for row in rows]
