"""What a picture shows, as actors of VTK: cells, box, plates, walls, a slice of the flow."""
import colorsys
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkButterflySubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkOutlineSource
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkDataSetMapper, vtkPolyDataMapper

from rbc.errors import InputError
from rbc.grids import read_grid
from rbc.surfaces import read_polydata

BLOOD = 0.80, 0.12, 0.10
INK = 0.15, 0.17, 0.20
GLASS = 0.62, 0.70, 0.78
IDENTITIES = "molecule", "aggregate"
SUBDIVIDE_BELOW = 400_000
OVERSAMPLE = 2
WARM = (0.99, 0.93, 0.80), (0.99, 0.68, 0.38), (0.85, 0.24, 0.17), (0.33, 0, 0.1)
COOL = (0.95, 0.97, 0.99), (0.66, 0.80, 0.91), (0.26, 0.53, 0.76), (0.05, 0.22, 0.45)


def read_surface(path):
    """Triangles of a .vtp or .pvtp file with their point data, for VTK."""
    triangles = vtkTriangleFilter()
    triangles.SetInputData(read_polydata(path))
    triangles.Update()
    return triangles.GetOutput()


def refine(surface, levels):
    """Interpolating subdivision, which rounds the silhouettes, and point normals."""
    if levels and surface.GetNumberOfPolys() * 4 ** levels <= SUBDIVIDE_BELOW:
        subdivide = vtkButterflySubdivisionFilter()
        subdivide.SetNumberOfSubdivisions(levels)
        subdivide.SetInputData(surface)
        subdivide.Update()
        if subdivide.GetOutput().GetNumberOfPolys():
            surface = subdivide.GetOutput()
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def palette(size):
    """Lookup table of distinct, soft colours for identities modulo its size."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(size)
    for i in range(size):
        hue, lightness = (0.02 + i * 0.381966) % 1, 0.48 + 0.14 * (i % 3) / 2
        table.SetTableValue(i, *colorsys.hls_to_rgb(hue, lightness, 0.45), 1)
    table.SetTableRange(-0.5, size - 0.5)
    return table


def ramp(low, high, colors=WARM, size=256):
    """Lookup table through colours from the palest to the darkest."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(size)
    where = np.linspace(0, 1, size)
    rgb = [np.interp(where, np.linspace(0, 1, len(colors)), channel) for channel in zip(*colors)]
    for i, color in enumerate(zip(*rgb)):
        table.SetTableValue(i, *color, 1)
    table.SetTableRange(low, high)
    return table


def round_limits(low, high):
    """Around a range: four round steps, for the five labels of a color bar."""
    if high <= low:
        return low, low + 1
    power = 10.0**np.floor(np.log10((high - low) / 4))
    for step in power * np.array([1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 20]):
        start = step * np.floor(low / step + 1e-9)
        if start + 4 * step >= high - 1e-9 * step:
            break
    return start, start + 4 * step


def limits_of(path, name):
    """Least and largest value of a point array of a file (of a vector, its length)."""
    values = point_values(read_surface(path), name)
    return values.min(), values.max()


def point_values(surface, name):
    array = surface.GetPointData().GetArray(name)
    if array is None:
        data = surface.GetPointData()
        names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
        raise InputError(f"no point data '{name}' in the file; there are: {', '.join(names)}")
    values = vtk_to_numpy(array)
    return np.linalg.norm(values, axis=1) if values.ndim == 2 else values


def color_by(surface, mapper, name, limits):
    """Color by a point array (a vector's length); returns the table of a continuous one."""
    values = point_values(surface, name)
    if name in IDENTITIES:
        table, values = palette(24), np.round(values) % 24
    else:
        table = ramp(*(limits or round_limits(values.min(), values.max())))
    scalars = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
    scalars.SetName("shown")
    surface.GetPointData().SetScalars(scalars)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    return None if name in IDENTITIES else table


def surface_actor(surface, name, limits):
    """Smoothly shaded actor of the cells, and the lookup table for a colour bar or None."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    table = None
    if name:
        mapper.ScalarVisibilityOn()
        table = color_by(surface, mapper, name, limits)
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(*BLOOD)
    look.SetInterpolationToPhong()
    look.SetAmbient(0.28)
    look.SetDiffuse(0.78)
    look.SetSpecular(0.18)
    look.SetSpecularPower(25)
    look.SetSpecularColor(1, 1, 1)
    return actor, table


def outline_actor(box):
    source = vtkOutlineSource()
    source.SetBounds(box)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*INK)
    actor.GetProperty().SetLineWidth(1.5 * OVERSAMPLE)
    actor.GetProperty().LightingOff()
    return actor


def plate_actors(box):
    """Thin slabs outside the z faces of the box."""
    for side, height in ((-1, box[4]), (1, box[5])):
        thickness = 0.02 * (box[5] - box[4])
        source = vtkCubeSource()
        source.SetBounds(*box[:4], *sorted((height, height + side * thickness)))
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*GLASS)
        actor.GetProperty().SetOpacity(0.35)
        actor.GetProperty().SetSpecular(0)
        yield actor


def wall_actor(path, scale=1.0, shift=(0, 0, 0)):
    """The far side of a vessel's surface (STL), seen through the near side; scaled and shifted as
    by region rbc/mesh. The triangles may be right- or left-handed seen from outside."""
    open(path, "rb").close()    # raises what is wrong, which VTK would only print
    reader = vtkSTLReader()
    reader.SetFileName(os.fspath(path))
    reader.Update()
    if not reader.GetOutput().GetNumberOfPolys():
        raise InputError(f"{path} holds no surface")
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(reader.GetOutputPort())
    normals.SetFeatureAngle(50)
    normals.ConsistencyOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(*GLASS)
    look.SetOpacity(0.55)
    if is_right_handed(reader.GetOutput()):
        look.FrontfaceCullingOn()
    else:
        look.BackfaceCullingOn()
    actor.SetScale(scale)
    actor.SetPosition(*shift)
    return actor


def is_right_handed(surface):
    """Whether most of the triangles' normals point away from the middle; the ends may be open."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = points[triangles].transpose(1, 0, 2)
    away = (a + b + c) / 3 - points.mean(axis=0)
    return np.einsum("ij,ij->", np.cross(b - a, c - a), away) > 0


def largest_speed(path):
    return np.linalg.norm(read_grid(path).vector(), axis=-1).max()


def slice_actor(path, axis, place=None, limits=None):
    """A plane through a grid, colored by the speed of the fluid, and its lookup table. `axis`: 0, 1
    or 2, which the plane is normal to, at `place` (the middle if None)."""
    grid = read_grid(path)
    speed = np.linalg.norm(grid.vector(), axis=-1)
    low, high = grid.edges[axis][0], grid.edges[axis][-1]
    place = (low + high) / 2 if place is None else place
    if not low <= place <= high:
        raise InputError(f"a slice at {place:g} is outside the grid, {low:g} to {high:g}")
    cell = np.clip(np.searchsorted(grid.edges[axis], place) - 1, 0, speed.shape[axis] - 1)
    # up to the sides of the box
    values = np.pad(np.take(speed, cell, axis=axis), 1, mode="edge")
    sides = [np.concatenate([edges[:1], centres, edges[-1:]])
             for edges, centres in zip(grid.edges, grid.centres)]
    sides[axis] = np.array([place])
    points = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1)
    plane = vtkStructuredGrid()
    plane.SetDimensions(*points.shape[:3])
    corners = vtkPoints()
    corners.SetData(numpy_to_vtk(points.transpose(2, 1, 0, 3).reshape(-1, 3), deep=True))
    plane.SetPoints(corners)
    plane.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(values.T).ravel(), deep=True))
    table = ramp(*(limits or round_limits(0, speed.max())), COOL)
    mapper = vtkDataSetMapper()
    mapper.SetInputData(plane)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    return actor, table
