"""Cells of a file of surfaces of fix rbc/vtk: which there are, and files with some of them."""
from typing import NamedTuple

import command_line    # noqa: F401  before numpy, which may be missing
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkFiltersExtraction import vtkExtractCells
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


class CellIds(NamedTuple):
    """A row for each cell, by molecule ID."""
    molecules: np.ndarray
    aggregates: np.ndarray
    centres: np.ndarray      # means of the vertices
    lowest: np.ndarray       # corners of the boxes around the cells
    highest: np.ndarray


def read_surfaces(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def ids(surface, name):
    return vtk_to_numpy(surface.GetPointData().GetArray(name))


def read_cell_ids(path):
    surface = read_surfaces(path)
    molecule = ids(surface, "molecule")
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    # vertices of a cell follow each other
    starts = np.flatnonzero(np.diff(molecule, prepend=molecule[0] - 1))
    order = np.argsort(molecule[starts])
    counts = np.diff(starts, append=len(molecule))[:, None]
    columns = (molecule[starts], ids(surface, "aggregate")[starts],
               np.add.reduceat(points, starts) / counts, np.minimum.reduceat(points, starts),
               np.maximum.reduceat(points, starts))
    return CellIds(*(column[order] for column in columns))


def write_cells(source, target, molecules):
    """A file of surfaces with some cells of another."""
    surface = read_surfaces(source)
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    chosen = vtkIdList()
    for triangle in np.flatnonzero(np.isin(ids(surface, "molecule")[corners[:, 0]], molecules)):
        chosen.InsertNextId(int(triangle))
    extract = vtkExtractCells()
    extract.SetInputData(surface)
    extract.SetCellList(chosen)
    polygons = vtkGeometryFilter()
    polygons.SetInputConnection(extract.GetOutputPort())
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(polygons.GetOutputPort())
    writer.SetFileName(str(target))
    writer.Write()
