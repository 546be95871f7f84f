# SPDX-License-Identifier: BSD-3-Clause
"""The deviation picture: both sides of the blade in colour, a legend, a histogram and the figures."""

import struct
from zlib import compress, crc32

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401, draws text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkImagingColor import vtkImageQuantizeRGBToIndex
from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkColorTransferFunction, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
    vtkWindowToImageFilter)

from .drawing import DARK, GREY, PALE, add_line, add_rectangles, add_text, signed
from .histogram import add_histogram, colour_of
from .tessellation import tessellate

SIZE = (1600, 900)
SIDES = (  # title, viewport in pixels, azimuth of the camera in degrees
    ("Suction side", (15, 415, 955, 795), 20.0),
    ("Pressure side", (15, 15, 955, 395), 160.0))
PIXELS_PER_MM = 5.9
CALLOUT = (600, 20)  # where the words on the defect begin, in pixels of the view, beside the blade
COLOUR_LIMIT, HISTOGRAM_LIMIT = 0.15, 0.20  # mm
BLACK = (0.05, 0.05, 0.05)


def diverging_colours(limit):
    """Blue below zero, light grey at zero, red above (K. Moreland 2009); limits in mm."""
    colours = vtkColorTransferFunction()
    colours.SetColorSpaceToDiverging()
    colours.AddRGBPoint(-limit, 0.085, 0.245, 0.700)
    colours.AddRGBPoint(0.0, 0.865, 0.865, 0.865)
    colours.AddRGBPoint(limit, 0.720, 0.040, 0.120)
    return colours


def add_renderer(window, viewport):
    """A white renderer with a viewport (x0, y0, x1, y1) in pixels of the picture."""
    renderer = vtkRenderer()
    renderer.SetViewport(viewport[0] / SIZE[0], viewport[1] / SIZE[1],
                         viewport[2] / SIZE[0], viewport[3] / SIZE[1])
    renderer.SetBackground(1.0, 1.0, 1.0)
    window.AddRenderer(renderer)
    return renderer


def surface_actor(surface):
    """The nominal surface in grey."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(tessellate(surface))
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.72, 0.74, 0.77)
    actor.GetProperty().SetAmbient(0.45)
    actor.GetProperty().SetDiffuse(0.6)
    return actor


def points_actor(positions, normals=None, deviations=None, colours=None):
    """Points in the colour of their deviation, lit like the surface under them; or plain black."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(positions, deep=True))
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(vertices.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetPointSize(4.0)
    if deviations is None:
        actor.GetProperty().SetColor(BLACK)
        actor.GetProperty().LightingOff()
    else:
        data.GetPointData().SetNormals(numpy_to_vtk(normals, deep=True))
        data.GetPointData().SetScalars(numpy_to_vtk(deviations, deep=True))
        mapper.SetLookupTable(colours)
        actor.GetProperty().SetAmbient(0.45)
        actor.GetProperty().SetDiffuse(0.6)
    return actor


def aim_camera(renderer, viewport, feet, azimuth):
    """Looks at the blade with its span horizontal; the scale is the same in every view.

    Returns the unit vector towards the camera.
    """
    chordwise = np.array([np.cos(np.radians(38.0)), np.sin(np.radians(38.0)), 0.0])  # at mid-span
    centre = 0.5 * (feet.min(axis=0) + feet.max(axis=0))
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(centre)
    camera.SetPosition(centre + 500.0 * np.cross([0.0, 0.0, 1.0], chordwise))
    camera.SetViewUp(chordwise)
    camera.Azimuth(azimuth)
    camera.SetParallelScale(0.5 * (viewport[3] - viewport[1]) / PIXELS_PER_MM)
    light = vtkLight()
    light.SetLightTypeToCameraLight()
    light.SetPosition(-0.3, 0.5, 1.0)  # from above, on the left
    renderer.AddLight(light)
    return -np.array(camera.GetDirectionOfProjection())


def add_callout(renderer, defect):
    """Points at the defect and says, beside the blade, what was measured."""
    renderer.SetWorldPoint(*defect.position, 1.0)
    renderer.WorldToDisplay()
    x, y = np.array(renderer.GetDisplayPoint()[:2]) - renderer.GetOrigin()
    corner = CALLOUT
    add_line(renderer, [(x, y), corner, (corner[0] + 20, corner[1])], width=2.0)
    kind = "Dent" if defect.height < 0.0 else "Bump"
    add_text(renderer, f"{kind} {signed(defect.height, 3)} mm", corner[0] + 28, corner[1] - 7,
             bold=True)


def add_side(window, side, inspection, surface, colours):
    """One side of the blade with its points; outliers are black."""
    title, viewport, azimuth = side
    renderer = add_renderer(window, viewport)
    result, outliers = inspection.result, inspection.outliers
    toward = aim_camera(renderer, viewport, result.closest_points, azimuth)
    facing = result.normals @ toward
    # Drawn half a millimetre towards the eye, so that the surface hides none that lies below it.
    points = inspection.points + 0.5 * toward
    shown = ~outliers & (facing > 0.0)
    renderer.AddActor(surface_actor(surface))
    renderer.AddActor(points_actor(
        points[shown], result.normals[shown], result.signed_distance[shown], colours))
    renderer.AddActor(points_actor(points[outliers & (facing > 0.0)]))
    renderer.ResetCameraClippingRange()
    add_text(renderer, title, 10, viewport[3] - viewport[1] - 24, size=22, bold=True)
    defect = inspection.defect
    if defect is not None:
        foot = np.argmin(np.linalg.norm(result.closest_points - defect.position, axis=1))
        if facing[foot] > 0.0:
            add_callout(renderer, defect)


def add_legend(page, frame, colours, outliers):
    """The colour bar with its labels, and what black means. frame: the bar in pixels."""
    left, bottom, right, top = frame
    edges = np.linspace(bottom, top, 257)
    values = np.linspace(-COLOUR_LIMIT, COLOUR_LIMIT, 256)
    add_rectangles(page, [(left, a, right, b) for a, b in zip(edges[:-1], edges[1:])],
                   [colour_of(colours, value) for value in values])
    for value in np.linspace(-COLOUR_LIMIT, COLOUR_LIMIT, 7):
        y = bottom + (value + COLOUR_LIMIT) / (2.0 * COLOUR_LIMIT) * (top - bottom)
        add_line(page, [(right, y), (right + 5, y)])
        add_text(page, signed(value, 2), right + 10, y - 6, size=17)
    add_text(page, "Deviation [mm]", left - 8, top + 18, size=19, bold=True)
    add_rectangles(page, [(left + 8, bottom - 42, left + 14, bottom - 36)], BLACK)
    add_text(page, f"outliers: {outliers}", left + 24, bottom - 46, size=16)


def add_figures(page, rows, left, right, top):
    """A table of (name, value)."""
    for i, (name, value) in enumerate(rows):
        y = top - 29 * i
        add_text(page, name, left, y, size=18)
        add_text(page, value, right, y, size=18, justify="Right")
        add_line(page, [(left, y - 9), (right, y - 9)], colour=PALE, width=1.0)


def make_picture(inspection, surface, title, subtitle, rows):
    """Renders the picture of an Inspection; rows: pairs of strings for the table.

    Returns the vtkRenderWindow.
    """
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    page = add_renderer(window, (0, 0, *SIZE))
    colours = diverging_colours(COLOUR_LIMIT)
    for side in SIDES:
        add_side(window, side, inspection, surface, colours)
    add_text(page, title, 25, 852, size=28, bold=True)
    add_text(page, subtitle, 25, 818, size=18, colour=GREY)
    add_legend(page, (970, 110, 1005, 740), colours, int(inspection.outliers.sum()))
    add_histogram(page, (1195, 395, 1570, 740), inspection.result.signed_distance, colours,
                  HISTOGRAM_LIMIT, inspection.tolerance)
    add_figures(page, rows, 1125, 1570, 300)
    length = 20.0 * PIXELS_PER_MM
    add_line(page, [(30, 36), (30, 28), (30 + length, 28), (30 + length, 36)])
    add_text(page, "20 mm", 30 + 0.5 * length, 36, size=16, justify="Centered")
    window.Render()
    return window


def rendered_image(window):
    """The picture as vtkImageData."""
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    return picture.GetOutput()


def write_png(window, path):
    """Writes the rendered picture."""
    writer = vtkPNGWriter()
    writer.SetInputData(rendered_image(window))
    writer.SetCompressionLevel(9)
    writer.SetFileName(str(path))
    writer.Write()


def write_small_png(window, path, width, number_of_colours):
    """Writes the picture smaller and with a palette, which vtkPNGWriter cannot."""
    resize = vtkImageResize()
    resize.SetInputData(rendered_image(window))
    resize.SetOutputDimensions(width, width * SIZE[1] // SIZE[0], 1)
    quantize = vtkImageQuantizeRGBToIndex()
    quantize.SetInputConnection(resize.GetOutputPort())
    quantize.SetNumberOfColors(number_of_colours)
    quantize.Update()
    image = quantize.GetOutput()
    height = image.GetDimensions()[1]
    rows = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width)[::-1]
    palette = np.array([quantize.GetLookupTable().GetTableValue(i)[:3]
                        for i in range(number_of_colours)])
    unfiltered = np.pad(rows.astype(np.uint8), ((0, 0), (1, 0)))  # each row begins with its filter

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", crc32(kind + data))

    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
        + chunk(b"PLTE", np.round(255.0 * palette).astype(np.uint8).tobytes())
        + chunk(b"IDAT", compress(unfiltered.tobytes(), 9))
        + chunk(b"IEND", b""))
