"""Small files as fix rbc/vtk and dump grid write them, of shapes known in closed form."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

# of a cuboid, right-handed seen from outside; corners in the order of numpy's ndindex
QUADS = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                  (1, 5, 7, 3)])


def cuboid(sides, centre=(0, 0, 0), rotation=np.eye(3)):
    """Vertices and triangles."""
    corners = np.array(list(np.ndindex(2, 2, 2))) - 0.5
    triangles = np.concatenate([QUADS[:, [0, 1, 2]], QUADS[:, [0, 2, 3]]])
    return (corners * sides) @ np.transpose(rotation) + centre, triangles


def sphere(radius, centre=(0, 0, 0), resolution=40):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(2 * resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    polygons = source.GetOutput()
    return (vtk_to_numpy(polygons.GetPoints().GetData()).astype(float) + centre,
            vtk_to_numpy(polygons.GetPolys().GetConnectivityArray()).reshape(-1, 3))


def write_surfaces(path, meshes, time=None, **data):
    """A .vtp file of {molecule ID: (vertices, triangles)} in the order given."""
    starts = np.cumsum([0] + [len(vertices) for vertices, _ in meshes.values()])
    points, polygons = vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(np.concatenate([mesh[0] for mesh in meshes.values()]), deep=True))
    for start, (_, triangles) in zip(starts, meshes.values()):
        for triangle in triangles + start:
            polygons.InsertNextCell(3, triangle.tolist())
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    data["molecule"] = np.repeat(list(meshes), np.diff(starts))
    for name, values in data.items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        surface.GetPointData().AddArray(array)
    if time is not None:
        array = numpy_to_vtk(np.array([time]), deep=True)
        array.SetName("TimeValue")
        surface.GetFieldData().AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface)
    writer.SetFileName(str(path))
    writer.Write()


def write_grid(path, edges, name, values):
    """A .vtr file as dump grid/vtk writes it: values [x, y, z, ...] in the cells."""
    counts = [len(side) - 1 for side in edges]
    extent = " ".join(f"0 {count}" for count in counts)
    columns = values.shape[3] if values.ndim == 4 else 1
    rows = np.swapaxes(values, 0, 2).reshape(-1, columns)
    sides = "".join('<DataArray type="Float32" format="ascii">\n'
                    f'{" ".join(f"{place:g}" for place in side)}\n</DataArray>\n' for side in edges)
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="RectilinearGrid">\n'
        f'<RectilinearGrid WholeExtent="{extent}">\n<Piece Extent="{extent}">\n'
        f"<Coordinates>\n{sides}</Coordinates>\n<CellData>\n"
        f'<DataArray type="Float32" Name="{name}" NumberOfComponents="{columns}" format="ascii">\n'
        + "".join(" ".join(f"{value:.9g}" for value in row) + "\n" for row in rows)
        + "</DataArray>\n</CellData>\n</Piece>\n</RectilinearGrid>\n</VTKFile>\n", encoding="utf-8")
