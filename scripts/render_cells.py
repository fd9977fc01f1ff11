#!/usr/bin/python3
"""Render the closed surfaces of a .vtp or .pvtp file to a PNG, without a display.

  render_cells.py cells.1000.vtp -o cells.png --box 0 32 0 32 0 24 --plates --scale-bar 8
  render_cells.py cells.1000.pvtp -o cells.png --color tension --view 30 20

Lengths are in the unit of the file. The view is from azimuth A (degrees from -y towards +x) and
elevation E above the x-y plane: `--view 0 0` sees x to the right and z up.

Needs the Debian packages python3-vtk9, python3-numpy and xvfb: VTK draws through an X server, and
the script starts a private Xvfb for as long as it runs. Without Xvfb it uses $DISPLAY.
"""
import colorsys
import contextlib
import os
import select
import shutil
import subprocess

import command_line
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkButterflySubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkLineSource, vtkOutlineSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkActor2D, vtkLight, vtkPolyDataMapper, vtkPolyDataMapper2D, vtkRenderer,
    vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkSSAOPass
import vtkmodules.vtkRenderingFreeType  # noqa: F401  registers the text backend

BLOOD = 0.80, 0.12, 0.10
INK = 0.15, 0.17, 0.20
IDENTITIES = "molecule", "aggregate"
SUBDIVIDE_BELOW = 400_000
OVERSAMPLE = 2
BAR_WIDTH = 0.14


@contextlib.contextmanager
def display():
    """A private X server, if VTK is built for X and Xvfb is there; else what $DISPLAY names."""
    if not vtkRenderWindow().GetClassName().startswith("vtkX"):
        yield
        return
    if not shutil.which("Xvfb"):
        if not os.environ.get("DISPLAY"):
            raise SystemExit("neither Xvfb nor a display: install the Debian package xvfb")
        yield
        return
    reader, writer = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writer), "-screen", "0", "640x480x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writer)
    before = os.environ.get("DISPLAY")
    try:
        number = b""
        while not number.endswith(b"\n"):
            piece = os.read(reader, 16) if select.select([reader], [], [], 30)[0] else b""
            if not piece:
                raise SystemExit("Xvfb does not start")
            number += piece
        os.environ["DISPLAY"] = f":{number.decode().strip()}"
        os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")
        yield
    finally:
        os.close(reader)
        server.terminate()
        server.wait()
        if before is None:
            os.environ.pop("DISPLAY", None)
        else:
            os.environ["DISPLAY"] = before


def read_surface(path):
    """Point data and triangles of a .vtp or .pvtp file."""
    if not os.path.isfile(path):
        raise SystemExit(f"{path} does not exist")
    reader = vtkXMLPPolyDataReader() if path.endswith(".pvtp") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(reader.GetOutputPort())
    triangles.Update()
    if not triangles.GetOutput().GetNumberOfPolys():
        raise SystemExit(f"{path} holds no surface")
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


def ramp(low, high, size=256):
    """Lookup table from pale to dark red through orange."""
    stops = np.array([(0.99, 0.93, 0.80), (0.99, 0.68, 0.38), (0.85, 0.24, 0.17), (0.33, 0, 0.1)])
    table = vtkLookupTable()
    table.SetNumberOfTableValues(size)
    where = np.linspace(0, 1, size)
    rgb = [np.interp(where, np.linspace(0, 1, len(stops)), channel) for channel in stops.T]
    for i, color in enumerate(zip(*rgb)):
        table.SetTableValue(i, *color, 1)
    table.SetTableRange(low, high)
    return table


def color_by(surface, mapper, name, limits):
    """Color by a point array (a vector's length); returns the table of a continuous one."""
    array = surface.GetPointData().GetArray(name)
    if array is None:
        data = surface.GetPointData()
        names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
        raise SystemExit(f"no point data '{name}' in the file; there are: {', '.join(names)}")
    values = vtk_to_numpy(array)
    if values.ndim == 2:
        values = np.linalg.norm(values, axis=1)
    if name in IDENTITIES:
        table, values = palette(24), np.round(values) % 24
    else:
        low, high = limits or (values.min(), values.max())
        table = ramp(low, high if high > low else low + 1)
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
        actor.GetProperty().SetColor(0.62, 0.70, 0.78)
        actor.GetProperty().SetOpacity(0.35)
        actor.GetProperty().SetSpecular(0)
        yield actor


def aim(renderer, bounds, azimuth, elevation, parallel, zoom):
    """Point the camera at the centre of the bounds so that their corners fill the picture."""
    a, e = np.radians((azimuth, elevation))
    back = np.array((np.sin(a) * np.cos(e), -np.cos(a) * np.cos(e), np.sin(e)))
    right = np.array((np.cos(a), np.sin(a), 0))
    up = np.cross(back, right)
    low, high = np.array(bounds[::2]), np.array(bounds[1::2])
    corners = np.stack(np.meshgrid(*zip(low, high), indexing="ij"), axis=-1).reshape(-1, 3)
    center = (low + high) / 2
    width, height = renderer.GetSize()
    half_angle = np.radians(12)
    for _ in range(20):  # the near side looks larger: move until top and bottom margins agree
        across, along, depth = ((corners - center) @ np.stack([right, up, back], axis=1)).T
        reach = 1.06 / zoom * np.maximum(np.abs(across) * height / width, np.abs(along))
        distance = (depth + reach / np.tan(half_angle)).max()
        seen = along if parallel else along * distance / (distance - depth)
        center = center + (seen.max() + seen.min()) / 2 * up
    camera = renderer.GetActiveCamera()
    camera.SetParallelProjection(parallel)
    camera.SetParallelScale(reach.max())
    camera.SetViewAngle(2 * np.degrees(half_angle))
    camera.SetFocalPoint(*center)
    camera.SetPosition(*(center + distance * back))
    camera.SetViewUp(*up)
    renderer.ResetCameraClippingRange()


def add_text(renderer, text, x, y, size):
    """Text centred at x with its foot at y, in pixels."""
    actor = vtkTextActor()
    actor.SetInput(text)
    look = actor.GetTextProperty()
    look.SetFontSize(size)
    look.SetColor(*INK)
    look.SetJustificationToCentered()
    actor.SetPosition(x, y)
    renderer.AddViewProp(actor)


def add_scale_bar(renderer, length, unit):
    """Bar of a length at the lower left; exact in the parallel projection it comes with."""
    width, height = renderer.GetSize()
    pixels = length * height / (2 * renderer.GetActiveCamera().GetParallelScale())
    left, bottom = 0.04 * width, 0.04 * height
    line = vtkLineSource()
    line.SetPoint1(left, bottom, 0)
    line.SetPoint2(left + pixels, bottom, 0)
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputConnection(line.GetOutputPort())
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*INK)
    actor.GetProperty().SetLineWidth(height / 200)
    renderer.AddViewProp(actor)
    add_text(renderer, f"{length:g} {unit}", left + pixels / 2, bottom + height / 90,
             round(height / 36))


def add_color_bar(renderer, table, title):
    """Colour bar that fills a renderer of its own."""
    width, height = renderer.GetSize()
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetNumberOfLabels(5)
    bar.UnconstrainedFontSizeOn()
    look = bar.GetLabelTextProperty()
    look.SetFontSize(round(height / 48))
    look.SetColor(*INK)
    look.ItalicOff()
    look.BoldOff()
    look.ShadowOff()
    bar.SetLabelFormat("%.3g")
    bar.SetBarRatio(0.25)
    bar.SetPosition(0.2, 0.25)
    bar.SetWidth(0.7)
    bar.SetHeight(0.5)
    renderer.AddViewProp(bar)
    size = min(height / 42, 1.7 * width / max(len(title), 1))
    add_text(renderer, title, width / 2, 0.77 * height, round(size))


def light(renderer):
    """Key light from the upper left of the camera and a weak one from the right."""
    renderer.RemoveAllLights()
    for position, intensity in (((-0.7, 1.0, 1.2), 0.85), ((0.9, -0.9, 0.8), 0.35)):
        lamp = vtkLight()
        lamp.SetLightTypeToCameraLight()
        lamp.SetPosition(*position)
        lamp.SetIntensity(intensity)
        renderer.AddLight(lamp)


def ambient_occlusion(renderer, bounds):
    """Darken where cells come close to each other."""
    size = np.linalg.norm(np.subtract(bounds[1::2], bounds[::2]))
    steps = vtkRenderStepsPass()
    shade = vtkSSAOPass()
    shade.SetDelegatePass(steps)
    shade.SetRadius(0.06 * size)
    shade.SetBias(0.001 * size)
    shade.SetKernelSize(96)
    shade.BlurOn()
    renderer.SetPass(shade)


def add_renderer(window, left, right):
    """Renderer of the full height of the window, on a light background."""
    renderer = vtkRenderer()
    window.AddRenderer(renderer)
    renderer.SetViewport(left, 0, right, 1)
    renderer.SetBackground(0.93, 0.94, 0.95)
    renderer.SetBackground2(1, 1, 1)
    renderer.GradientBackgroundOn()
    return renderer


def save(window, path):
    """Average OVERSAMPLE^2 pixels into one and write the PNG."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height = (side // OVERSAMPLE for side in window.GetSize())
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())
    pixels = pixels.reshape(height, OVERSAMPLE, width, OVERSAMPLE, 3).mean(axis=(1, 3))
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(np.round(pixels).astype(np.uint8).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def render(args):
    """Draw the picture and write it."""
    surface = refine(read_surface(args.surface), args.smooth)
    actor, table = surface_actor(surface, args.color, args.range)
    bounds = np.array(args.box or surface.GetBounds())

    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*(OVERSAMPLE * side for side in args.size))
    renderer = add_renderer(window, 0, 1 - BAR_WIDTH if table else 1)
    renderer.AddActor(actor)
    if args.box:
        renderer.AddActor(outline_actor(bounds))
        if args.plates:
            for plate in plate_actors(bounds):
                renderer.AddActor(plate)
    light(renderer)
    aim(renderer, bounds, *args.view, bool(args.scale_bar) or args.parallel, args.zoom)
    if args.occlusion:
        ambient_occlusion(renderer, surface.GetBounds())
    if args.scale_bar:
        add_scale_bar(renderer, args.scale_bar, args.unit)
    if table:
        add_color_bar(add_renderer(window, 1 - BAR_WIDTH, 1), table, args.label or args.color)
    window.Render()
    save(window, args.output)
    window.Finalize()


def size(text):
    width, height = (int(side) for side in text.split("x"))
    if min(width, height) < 16:
        raise ValueError
    return width, height


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("surface", help=".vtp or .pvtp file")
    parser.add_argument("-o", "--output", required=True, help="PNG to write")
    parser.add_argument("--color", metavar="ARRAY",
                        help="point data to color by: molecule, aggregate, velocity, tension, ...")
    parser.add_argument("--range", type=float, nargs=2, metavar=("LOW", "HIGH"),
                        help="limits of the colours (default: of the data)")
    parser.add_argument("--label", help="title of the colour bar (default: the array's name)")
    parser.add_argument("--size", type=size, default=(1280, 960), metavar="WxH")
    parser.add_argument("--box", type=float, nargs=6,
                        metavar=("XLO", "XHI", "YLO", "YHI", "ZLO", "ZHI"),
                        help="draw this outline and fit the view to it")
    parser.add_argument("--plates", action="store_true", help="draw the z faces of --box as walls")
    parser.add_argument("--view", type=float, nargs=2, default=(25, 20),
                        metavar=("AZIMUTH", "ELEVATION"), help="degrees (default 25 20)")
    parser.add_argument("--zoom", type=float, default=1.0, help="size in the picture (default 1)")
    parser.add_argument("--parallel", action="store_true", help="no perspective")
    parser.add_argument("--scale-bar", type=float, metavar="LENGTH",
                        help="draw a bar of this length; no perspective")
    parser.add_argument("--unit", default="\u00b5m", help="unit at the scale bar (default um)")
    parser.add_argument("--smooth", type=int, default=1, metavar="N",
                        help=f"subdivisions for display, up to {SUBDIVIDE_BELOW} triangles")
    parser.add_argument("--no-occlusion", dest="occlusion", action="store_false",
                        help="no shading of narrow gaps (faster)")
    args = parser.parse_args(arguments)
    if args.plates and not args.box:
        parser.error("--plates needs --box")
    return args


def main(arguments=None):
    args = parse(arguments)
    with display():
        render(args)


if __name__ == "__main__":
    main()
