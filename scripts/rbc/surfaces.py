"""Surfaces that fix rbc/vtk writes (.vtp, .pvtp): in numpy, cell by cell, and files with some of
the cells."""
import os
from typing import NamedTuple

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import (
    vtkXMLPolyDataReader, vtkXMLPolyDataWriter, vtkXMLPPolyDataReader)

from rbc.errors import InputError
from rbc.text_files import Columns, refuse_all_but_vtk

try:
    from vtkmodules.vtkFiltersCore import vtkExtractCells
except ImportError:    # in older versions of VTK
    from vtkmodules.vtkFiltersExtraction import vtkExtractCells


class Surfaces(NamedTuple):
    """All cells of a file."""
    points: np.ndarray       # (vertices, 3)
    triangles: np.ndarray    # (triangles, 3): numbers of vertices, from 0
    data: dict               # of the vertices, by name: velocity, force, tension, molecule, ...
    time: float              # of the run; NaN where the file has none

    def cells(self):
        """{molecule ID: (vertices, triangles) of the cell}, by molecule ID."""
        molecules = self.data["molecule"]
        order = np.argsort(molecules, kind="stable")
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        names, starts = np.unique(molecules[order], return_index=True)
        owners = molecules[self.triangles[:, 0]]
        by_owner = np.argsort(owners, kind="stable")
        pieces = np.split(place[self.triangles[by_owner]],
                          np.searchsorted(owners[by_owner], names[1:]))
        vertices = np.split(self.points[order], starts[1:])
        return {int(name): (own, piece - start)
                for name, own, piece, start in zip(names, vertices, pieces, starts)}


class CellIds(NamedTuple):
    """A row for each cell, by molecule ID."""
    molecules: np.ndarray
    aggregates: np.ndarray
    centres: np.ndarray      # means of the vertices
    lowest: np.ndarray       # corners of the boxes around the cells
    highest: np.ndarray


def read_polydata(path):
    """VTK's data set of a file."""
    path = os.fspath(path)
    refuse_all_but_vtk(path, "surfaces")
    reader = vtkXMLPPolyDataReader() if path.endswith(".pvtp") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    if not reader.GetOutput().GetNumberOfPolys():
        raise InputError(f"{path} holds no surface")
    return reader.GetOutput()


def read_surfaces(path):
    """Surfaces of a .vtp or .pvtp file."""
    dataset = read_polydata(path)
    connectivity = vtk_to_numpy(dataset.GetPolys().GetConnectivityArray())
    if len(connectivity) != 3 * dataset.GetNumberOfPolys():
        raise InputError(f"{path} has polygons that are not triangles")
    data = dataset.GetPointData()
    names = [data.GetArrayName(n) for n in range(data.GetNumberOfArrays())]
    time = dataset.GetFieldData().GetArray("TimeValue")
    return Surfaces(vtk_to_numpy(dataset.GetPoints().GetData()).astype(float),
                    connectivity.reshape(-1, 3),
                    Columns((name, vtk_to_numpy(data.GetArray(name))) for name in names),
                    time.GetValue(0) if time else np.nan)


def read_cells(path):
    """(vertices, triangles) of each cell of a file, in order of molecule ID."""
    return list(read_surfaces(path).cells().values())


def read_cell_ids(path):
    surfaces = read_surfaces(path)
    molecule, points = surfaces.data["molecule"], surfaces.points
    # vertices of a cell follow each other
    starts = np.flatnonzero(np.diff(molecule, prepend=molecule[0] - 1))
    order = np.argsort(molecule[starts])
    counts = np.diff(starts, append=len(molecule))[:, None]
    columns = (molecule[starts], surfaces.data["aggregate"][starts],
               np.add.reduceat(points, starts) / counts, np.minimum.reduceat(points, starts),
               np.maximum.reduceat(points, starts))
    return CellIds(*(column[order] for column in columns))


def write_cells(source, target, molecules):
    """A file of surfaces with some cells of another."""
    dataset, surfaces = read_polydata(source), read_surfaces(source)
    owners = surfaces.data["molecule"][surfaces.triangles[:, 0]]
    chosen = vtkIdList()
    for triangle in np.flatnonzero(np.isin(owners, molecules)):
        chosen.InsertNextId(int(triangle))
    extract = vtkExtractCells()
    extract.SetInputData(dataset)
    extract.SetCellList(chosen)
    polygons = vtkGeometryFilter()
    polygons.SetInputConnection(extract.GetOutputPort())
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(polygons.GetOutputPort())
    writer.SetFileName(str(target))
    writer.Write()
