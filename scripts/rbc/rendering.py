"""Pictures of cells, without a display."""
import os
from typing import NamedTuple

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkLineSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor2D, vtkLight, vtkPolyDataMapper2D, vtkRenderer, vtkRenderWindow, vtkTextActor,
    vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkSSAOPass
import vtkmodules.vtkRenderingFreeType  # noqa: F401  registers the text backend

from rbc.actors import (INK, OVERSAMPLE, outline_actor, plate_actors, read_surface, refine,
                        slice_actor, surface_actor, wall_actor)
from rbc.display import display

BAR_WIDTH = 0.14


MICRON = "\u00b5m"
UNITS = {"velocity": f"{MICRON}/\u00b5s = m/s", "speed": f"{MICRON}/\u00b5s = m/s", "force": "nN",
         "tension": "mN/m"}    # of units micro


class Look(NamedTuple):
    """What a picture shows and how; lengths in the unit of the files."""
    color: str = None            # point data to color by: molecule, aggregate, velocity, ...
    range: tuple = None          # limits of the colors; of the data if None
    label: str = None            # title of the color bar; the name of the data if None
    size: tuple = (1280, 960)    # pixels
    box: tuple = None            # xlo, xhi, ylo, yhi, zlo, zhi: outline, which fills the view
    plates: bool = False         # the z faces of the box are walls
    walls: tuple = ()            # STL files of vessels
    wall_scale: float = 1.0      # of those, as of region rbc/mesh: scale first, then shift
    wall_shift: tuple = (0, 0, 0)
    flow: str = None             # file of dump grid/vtk or dump grid with the velocity
    slice: str = "y"             # the slice of the flow is normal to it
    slice_at: float = None       # in the middle if None
    flow_range: tuple = None     # limits of the colors of the flow; from 0 to the largest if None
    view: tuple = (25, 20)       # degrees: azimuth from -y towards +x, elevation
    zoom: float = 1.0
    parallel: bool = False       # no perspective
    scale_bar: float = None      # length of a bar; no perspective
    unit: str = MICRON           # of lengths; another one: no units at the color bar
    smooth: int = 1              # subdivisions of the triangles
    occlusion: bool = True       # shading of narrow gaps, where there is no flow


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
    size = min(height / 42, 1.7 * width / max(map(len, [*title.splitlines(), " "])))
    add_text(renderer, title, width / 2, 0.77 * height, round(size))


def title_of(name, unit):
    """Of a color bar, with the unit below if it is known."""
    return f"{name}\n({UNITS[name]})" if unit == MICRON and name in UNITS else name


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


def scenery(renderer, look, bounds):
    """Adds what is around the cells; returns the lookup table of the flow, or None."""
    if look.box is not None:
        renderer.AddActor(outline_actor(bounds))
        if look.plates:
            for plate in plate_actors(bounds):
                renderer.AddActor(plate)
    for path in look.walls:
        renderer.AddActor(wall_actor(path, look.wall_scale, look.wall_shift))
    if not look.flow:
        return None
    actor, table = slice_actor(look.flow, "xyz".index(look.slice), look.slice_at, look.flow_range)
    renderer.AddActor(actor)
    return table


def render(path, output, look=Look()):
    """Writes a PNG of the surfaces of a .vtp or .pvtp file."""
    surface = refine(read_surface(path), look.smooth)
    actor, table = surface_actor(surface, look.color, look.range)
    bounds = np.array(surface.GetBounds() if look.box is None else look.box)
    with display():
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(*(OVERSAMPLE * side for side in look.size))
        with_bar = table or look.flow
        renderer = add_renderer(window, 0, 1 - BAR_WIDTH if with_bar else 1)
        renderer.AddActor(actor)
        flow_table = scenery(renderer, look, bounds)
        light(renderer)
        aim(renderer, bounds, *look.view, bool(look.scale_bar) or look.parallel, look.zoom)
        if look.occlusion and not look.flow:    # of a flat slice it would shade parts
            ambient_occlusion(renderer, surface.GetBounds())
        if look.scale_bar:
            add_scale_bar(renderer, look.scale_bar, look.unit)
        if with_bar:
            title = look.label or title_of(look.color if table else "speed", look.unit)
            add_color_bar(add_renderer(window, 1 - BAR_WIDTH, 1), table or flow_table, title)
        window.Render()
        save(window, os.fspath(output))
        window.Finalize()
