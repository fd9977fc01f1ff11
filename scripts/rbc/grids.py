"""Fields on the grid of the fluid, as `dump grid/vtk` (.vtr) and `dump grid` (text) write them.

With several MPI tasks a text dump needs `dump_modify ID sort id`: the order of its cells is any
without.
"""
import os
import re
from typing import NamedTuple

import numpy as np

from rbc.errors import InputError
from rbc.text_files import Columns, as_numbers, refuse_all_but_vtk, refuse_others


class Grid(NamedTuple):
    """Values in the cells of a grid."""
    edges: tuple     # of the cells, in x, y and z
    data: dict       # by name: (nx, ny, nz) or (nx, ny, nz, 3)
    step: int        # of the run; None where the file does not say

    @property
    def centres(self):
        """Coordinates of the centres of the cells in x, y and z."""
        return tuple((edges[1:] + edges[:-1]) / 2 for edges in self.edges)

    def vector(self):
        """The only field with three components, or three columns that are called one."""
        vectors = [values for values in self.data.values() if values.ndim == 4]
        columns = [name for name in self.data if re.search(r":velocity\[[123]\]$", name)]
        if len(vectors) == 1:
            return vectors[0]
        if len(columns) == 3:
            return np.stack([self.data[name] for name in columns], axis=-1)
        raise InputError(f"no one vector among the fields {', '.join(self.data)}")


def read_grid(path):
    """The only grid of a .vtr file, or the last one of a text dump."""
    return read_grids(path)[-1]


def read_grids(path):
    """Grids of a .vtr file (one) or of a text dump, in order of the steps."""
    path = os.fspath(path)
    return [read_rectilinear(path)] if path.endswith(".vtr") else read_dump_grid(path)


def read_rectilinear(path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLRectilinearGridReader

    refuse_all_but_vtk(path, "vtr")
    reader = vtkXMLRectilinearGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    if not grid.GetNumberOfCells():
        raise InputError(f"{path} holds no grid")
    edges = tuple(vtk_to_numpy(side).astype(float) for side in
                  (grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates()))
    counts, cells = [len(side) - 1 for side in edges], grid.GetCellData()
    data = Columns((cells.GetArrayName(n), shaped(vtk_to_numpy(cells.GetArray(n)), counts))
                   for n in range(cells.GetNumberOfArrays()))
    step = re.search(r"\.(\d+)\.vtr$", path)
    return Grid(edges, data, int(step[1]) if step else None)


def shaped(values, counts):
    """As [x, y, z] or [x, y, z, component], of values with x fastest."""
    nx, ny, nz = counts
    return np.swapaxes(values.reshape(nz, ny, nx, *values.shape[1:]), 0, 2)


def read_dump_grid(path):
    with open(path, encoding="utf-8", errors="replace") as stream:
        text = stream.read()
    refuse_others(path, text, "grid")
    blocks = text.split("ITEM: TIMESTEP\n")[1:]
    if not blocks:
        raise InputError(f"{path} is neither a .vtr file nor a text dump of a grid")
    return [dumped(path, block) for block in blocks]


def dumped(path, block):
    step, *_ = block.split(maxsplit=1)
    sides = re.search(r"^ITEM: BOX BOUNDS.*\n(.*)\n(.*)\n(.*)\n", block, re.MULTILINE)
    size = re.search(r"^ITEM: GRID SIZE.*\n(.*)\n", block, re.MULTILINE)
    cells = re.search(r"^ITEM: GRID CELLS (.*)\n", block, re.MULTILINE)
    if not (sides and size and cells):
        raise InputError(f"{path}: step {step} is not one of dump grid")
    counts = [int(word) for word in size[1].split()]
    names = cells[1].split()
    values = as_numbers(path, block[cells.end():].split())
    if values.size != np.prod(counts) * len(names):
        raise InputError(f"{path}: step {step} is cut off")
    columns = values.reshape(-1, len(names)).T
    bounds = [[float(word) for word in side.split()[:2]] for side in sides.groups()]
    edges = tuple(np.linspace(*side, count + 1) for side, count in zip(bounds, counts))
    data = Columns((name, shaped(column, counts)) for name, column in zip(names, columns))
    return Grid(edges, data, int(step))
