"""Surfaces in STL, PLY and VTP files, through VTK, and in ascii OFF files. Needs python3-vtk9."""
import codecs
import contextlib
import tempfile
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkIOGeometry import vtkSTLReader, vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

MERGE = 1e-6  # points closer than this, in sizes of the surface, are one

READERS = {".stl": vtkSTLReader, ".ply": vtkPLYReader, ".vtp": vtkXMLPolyDataReader}
WRITERS = {".stl": vtkSTLWriter, ".ply": vtkPLYWriter, ".vtp": vtkXMLPolyDataWriter}
FORMATS = (".stl", ".ply", ".off", ".vtp")


def _format(path):
    if path.suffix.lower() not in FORMATS:
        raise ValueError(
            f"unknown format {path.suffix or '(no suffix)'}; allowed: {', '.join(FORMATS)}")
    return path.suffix.lower()


def _polydata(points, polygons):
    coordinates = np.array(points, dtype=float).reshape(-1, 3)
    nodes, cells, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    nodes.SetDataTypeToDouble()
    nodes.SetData(numpy_to_vtk(coordinates, deep=True))
    for polygon in polygons:
        cells.InsertNextCell(len(polygon), [int(v) for v in polygon])
    surface.SetPoints(nodes)
    surface.SetPolys(cells)
    return surface


def _arrays(surface):
    """Points and triangles of polydata that has no other polygons."""
    return (vtk_to_numpy(surface.GetPoints().GetData()).astype(float),
            vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(int))


def _filtered(kind, surface, **settings):
    stage = kind()
    stage.SetInputData(surface)
    for name, value in settings.items():
        getattr(stage, "Set" + name)(value)
    stage.Update()
    return stage.GetOutput()


def _read_off(path):
    """Polygons of an ascii OFF file; colours at the end of their lines are left out."""
    rows = [line.split("#")[0].split()
            for line in path.read_text(encoding="utf-8-sig").splitlines()]
    if not any(rows) or next(filter(None, rows))[0] != "OFF":
        raise ValueError("does not begin with OFF (COFF, NOFF, binary OFF and others are not read)")
    rows = [row for row in ([word for word in row if word != "OFF"] for row in rows) if row]
    if not rows or len(rows[0]) < 2:
        raise ValueError("has no numbers of vertices and faces")
    vertices, faces = (int(word) for word in rows[0][:2])
    rows = rows[1:1 + vertices + faces]
    if len(rows) < vertices + faces:
        raise ValueError(f"ends before its {vertices} vertices and {faces} faces")
    polygons = [[int(word) for word in row[1:1 + int(row[0])]] for row in rows[vertices:]]
    if any(not 0 <= v < vertices for polygon in polygons for v in polygon):
        raise ValueError("a face names a vertex that does not exist")
    return _polydata([[float(word) for word in row[:3]] for row in rows[:vertices]], polygons)


@contextlib.contextmanager
def _without_mark(path):
    """Path of the same file without the byte-order mark that some editors put before a text."""
    content = path.read_bytes()
    if not content.startswith(codecs.BOM_UTF8):
        yield path
        return
    with tempfile.NamedTemporaryFile(suffix=path.suffix) as file:
        file.write(content[len(codecs.BOM_UTF8):])
        file.flush()
        yield file.name


def read_surface(path):
    """Points and triangles of a file: polygons are cut into triangles, points at one place merged,
    others dropped.

    Raises ValueError, saying why, if the file holds no triangles or some of them are no triangles.
    """
    path = Path(path)
    kind = _format(path)
    if not path.is_file():
        raise ValueError("no such file")
    if kind == ".off":
        surface = _read_off(path)
    else:
        vtkObject.GlobalWarningDisplayOff()  # what is wrong is said below
        reader = READERS[kind]()
        if kind == ".stl":
            reader.MergingOff()  # it would drop degenerate triangles without a word
        with _without_mark(path) as plain:
            reader.SetFileName(str(plain))
            reader.Update()
        surface = reader.GetOutput()
    if not surface.GetNumberOfPolys():
        raise ValueError(f"no polygons could be read as {kind[1:].upper()}")
    if not np.isfinite(vtk_to_numpy(surface.GetPoints().GetData())).all():
        raise ValueError("a coordinate is not a number")
    surface = _filtered(vtkTriangleFilter, surface, PassVerts=False, PassLines=False)
    count = surface.GetNumberOfPolys()
    surface = _filtered(vtkCleanPolyData, surface, ToleranceIsAbsolute=True,
                        AbsoluteTolerance=MERGE * surface.GetLength())
    if surface.GetNumberOfPolys() < count:
        raise ValueError(
            f"{count - surface.GetNumberOfPolys()} triangles have two corners at one place")
    return _arrays(surface)


def write_surface(path, points, triangles):
    """Write triangles in the format that the suffix names; STL and PLY hold single precision."""
    path = Path(path)
    kind = _format(path)
    if kind == ".off":
        lines = ["OFF", f"{len(points)} {len(triangles)} {len(triangles) * 3 // 2}"]
        lines += ["{!r} {!r} {!r}".format(*map(float, point)) for point in points]
        lines += ["3 {} {} {}".format(*triangle) for triangle in triangles]
        path.write_text("\n".join(lines) + "\n", encoding="ascii")
        return
    writer = WRITERS[kind]()
    writer.SetFileName(str(path))
    writer.SetInputData(_polydata(points, triangles))
    if kind != ".vtp":
        writer.SetFileTypeToBinary()
    if not writer.Write():
        raise OSError(f"cannot write {path}")
