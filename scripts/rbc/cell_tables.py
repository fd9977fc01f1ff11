"""Cells over time from the array of compute rbc/cell: columns by name, and as CSV."""
import csv
import re
from typing import NamedTuple

import numpy as np

from rbc.errors import InputError
from rbc.tables import overview, read_blocks
from rbc.text_files import Columns

# of compute rbc/cell, from its first column on
CELL_COLUMNS = ("molecule", "x", "y", "z", "area", "volume", "deformation",
                "long", "middle", "short", "long_x", "long_y", "long_z",
                "short_x", "short_y", "short_z", "vx", "vy", "vz")


class Cells(NamedTuple):
    """Columns by name, each (steps, cells)."""
    steps: np.ndarray
    columns: dict
    timestep: float = None    # of the run, if it was given

    def __repr__(self):
        return overview(self.steps, len(next(iter(self.columns.values()))[0]), "cell", self.columns)

    def __getitem__(self, name):
        return self.columns[name]

    @property
    def time(self):
        """Of the steps."""
        if self.timestep is None:
            raise InputError("no timestep was given: read_cell_table(path, timestep=...)")
        return self.timestep * self.steps

    @property
    def molecules(self):
        """IDs of the cells, in the order of the rows."""
        return self.columns["molecule"][0].astype(int)

    def vectors(self, *names):
        """Columns as (steps, cells, number of names)."""
        return np.stack([self.columns[name] for name in names], axis=-1)


def named(names, path):
    """Names of columns such as c_cell[7]."""
    numbers = [re.fullmatch(r".*\[(\d+)\]|(\d+)", name) for name in names]
    if not all(numbers):
        raise InputError(f"{path} is not of compute rbc/cell: it has {' '.join(names)}")
    numbers = [int(number[1] or number[2]) for number in numbers]
    sources = {name.partition("[")[0] for name in names if "[" in name}
    if len(sources) > 1 or max(numbers) > len(CELL_COLUMNS):
        raise InputError(f"{path} is not of one compute rbc/cell: it has {' '.join(names)}")
    return [CELL_COLUMNS[number - 1] for number in numbers]


def read_cell_table(path, timestep=None):
    """Cells of a file of `fix ave/time ... c_cell[*] mode vector`, some of the columns or all. With
    the timestep of the run they have a `time`."""
    history = read_blocks(path)
    names = named(history.names, path)
    return Cells(history.steps, Columns(zip(names, np.moveaxis(history.data, 2, 0))), timestep)


def cells_of_array(step, array):
    """Cells at one step, of all columns as a program that drives LAMMPS reads them."""
    if array.shape[1] != len(CELL_COLUMNS):
        raise InputError(f"compute rbc/cell has {len(CELL_COLUMNS)} columns, this array "
                         f"{array.shape[1]}")
    return Cells(np.array([step]), Columns(zip(CELL_COLUMNS, np.array(array).T[:, None])))


def write_rows(stream, columns):
    """CSV of {name: values of all rows}."""
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*(np.ravel(values).tolist() for values in columns.values())):
        writer.writerow([value if isinstance(value, int) else f"{value:.10g}" for value in row])


def rows_of_history(steps, columns):
    """{name: values}, a row for each step and row of the blocks."""
    shape = next(iter(columns.values())).shape
    return {"step": np.broadcast_to(steps[:, None], shape), **columns}
