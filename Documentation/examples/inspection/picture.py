# SPDX-License-Identifier: BSD-3-Clause
"""The deviation picture: both sides of the blade in colour, a legend, a histogram and the figures."""

import numpy as np
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401, draws the chart
import vtkmodules.vtkRenderingFreeType  # noqa: F401, draws text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkActor2D, vtkColorTransferFunction, vtkCoordinate, vtkPolyDataMapper,
    vtkPolyDataMapper2D, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from . import histogram
from .tessellation import tessellate

SIZE = (1600, 900)
DARK, GREY = (0.13, 0.15, 0.18), (0.42, 0.45, 0.49)
SIDES = (  # title, viewport in pixels, sign of the viewing direction
    ("Suction side", (20, 425, 960, 800), 1.0),
    ("Pressure side", (20, 30, 960, 405), -1.0))
PIXELS_PER_MM = 5.7


def diverging_colours(limit):
    """Blue below zero, light grey at zero, red above (K. Moreland 2009); limits in mm."""
    colours = vtkColorTransferFunction()
    colours.SetColorSpaceToDiverging()
    colours.AddRGBPoint(-limit, 0.085, 0.245, 0.700)
    colours.AddRGBPoint(0.0, 0.865, 0.865, 0.865)
    colours.AddRGBPoint(limit, 0.720, 0.040, 0.120)
    return colours


def add_text(renderer, text, x, y, size=20, colour=DARK, bold=False, justify="Left"):
    """Text whose baseline is near (x, y), in pixels of the renderer's viewport."""
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(size)
    style.SetColor(colour)
    style.SetBold(bold)
    getattr(style, f"SetJustificationTo{justify}")()
    renderer.AddActor2D(actor)
    return actor


def add_line(renderer, points, colour=DARK, width=1.5):
    """A polyline through points in pixels of the renderer's viewport."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.AllocateExact(1, len(points))
    ids = [data.GetPoints().InsertNextPoint(x, y, 0.0) for x, y in points]
    data.InsertNextCell(4, len(ids), ids)  # VTK_POLY_LINE
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(data)
    pixels = vtkCoordinate()
    pixels.SetCoordinateSystemToViewport()
    mapper.SetTransformCoordinate(pixels)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetLineWidth(width)
    renderer.AddActor2D(actor)


def add_renderer(window, viewport, layer=0):
    """A renderer with a viewport (x0, y0, x1, y1) in pixels of the picture."""
    renderer = vtkRenderer()
    renderer.SetViewport(viewport[0] / SIZE[0], viewport[1] / SIZE[1],
                         viewport[2] / SIZE[0], viewport[3] / SIZE[1])
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.SetLayer(layer)
    window.AddRenderer(renderer)
    return renderer


def surface_actor(surface):
    """The nominal surface in light grey."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(tessellate(surface))
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.72, 0.74, 0.77)
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetDiffuse(0.75)
    return actor


def points_actor(positions, normals, deviations, colours):
    """Points in the colour of their deviation, lit by the normal of the surface under them."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(positions, deep=True))
    data.GetPointData().SetScalars(numpy_to_vtk(deviations, deep=True))
    data.GetPointData().SetNormals(numpy_to_vtk(normals, deep=True))
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(vertices.GetOutputPort())
    mapper.SetLookupTable(colours)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetPointSize(3.0)
    actor.GetProperty().SetAmbient(0.45)
    actor.GetProperty().SetDiffuse(0.55)
    return actor


def aim_camera(renderer, viewport, feet, normals, sign):
    """Looks at one side, root on the left on the suction side, at the same scale in both views."""
    span = np.array([0.0, 0.0, 1.0])
    chordwise = np.array([np.cos(np.radians(38.0)), np.sin(np.radians(38.0)), 0.0])  # at mid-span
    toward = sign * np.cross(span, chordwise)
    centre = 0.5 * (feet.min(axis=0) + feet.max(axis=0))
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(centre)
    camera.SetPosition(centre + 500.0 * toward)
    camera.SetViewUp(chordwise)
    camera.SetParallelScale(0.5 * (viewport[3] - viewport[1]) / PIXELS_PER_MM)
    renderer.ResetCameraClippingRange()
    return toward


def add_callout(renderer, defect):
    """Points at the defect and says what was measured."""
    renderer.SetWorldPoint(*defect.position, 1.0)
    renderer.WorldToDisplay()
    x, y = renderer.GetDisplayPoint()[:2]
    origin = renderer.GetOrigin()
    x, y = x - origin[0], y - origin[1]
    kind = "Dent" if defect.height < 0.0 else "Bump"
    corner = (x + 120.0, y + 128.0)
    add_line(renderer, [(x, y), corner, (corner[0] + 22.0, corner[1])], width=2.0)
    add_text(renderer, f"{kind}: {defect.height:+.3f} mm".replace("-", "\u2212"),
             corner[0] + 28.0, corner[1] - 7.0, size=20, bold=True)


def add_side(window, side, scan_points, result, surface, colours, defect):
    title, viewport, sign = side
    renderer = add_renderer(window, viewport)
    feet, normals = result.closest_points, result.normals
    toward = aim_camera(renderer, viewport, feet, normals, sign)
    seen = normals @ toward > 0.0
    renderer.AddActor(surface_actor(surface))
    # Drawn half a millimetre towards the eye, so that the surface hides none that lies below it.
    renderer.AddActor(points_actor(
        scan_points[seen] + 0.5 * toward, normals[seen], result.signed_distance[seen], colours))
    renderer.ResetCameraClippingRange()
    height = viewport[3] - viewport[1]
    add_text(renderer, title, 8, height - 28, size=22, bold=True)
    length = 20.0 * PIXELS_PER_MM
    add_line(renderer, [(10, 22), (10, 14), (10 + length, 14), (10 + length, 22)])
    add_text(renderer, "20 mm", 10 + 0.5 * length, 22, size=16, justify="Centered")
    if defect is not None and renderer.GetActiveCamera().GetDirectionOfProjection() @ \
            result.normals[np.argmin(np.linalg.norm(feet - defect.position, axis=1))] < 0.0:
        add_callout(renderer, defect)


def add_legend(window, colours):
    renderer = add_renderer(window, (965, 60, 1105, 800))
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle("Deviation [mm]")
    bar.SetNumberOfLabels(7)
    bar.SetLabelFormat("%+.2f")
    bar.SetMaximumNumberOfColors(256)
    bar.UnconstrainedFontSizeOn()
    bar.SetVerticalTitleSeparation(14)
    bar.SetBarRatio(0.3)
    bar.SetPosition(0.0, 0.0)
    bar.SetPosition2(1.0, 1.0)
    for style, size in ((bar.GetTitleTextProperty(), 19), (bar.GetLabelTextProperty(), 18)):
        style.SetFontFamilyToArial()
        style.SetFontSize(size)
        style.SetColor(DARK)
        style.ItalicOff()
        style.ShadowOff()
        style.SetBold(0)
    renderer.AddActor2D(bar)


def add_figures(renderer, rows):
    """A table of (name, value) below the histogram."""
    for i, (name, value) in enumerate(rows):
        y = 292 - 29 * i
        add_text(renderer, name, 1150, y, size=19)
        add_text(renderer, value.replace("-", "\u2212"), 1570, y, size=19, justify="Right")
        add_line(renderer, [(1150, y - 8), (1570, y - 8)], colour=(0.86, 0.87, 0.89), width=1.0)


def make_picture(scan_points, result, surface, defect, rows, limit, tolerance, title):
    """Renders the picture. rows: pairs of strings for the table; limit of the colours in mm.

    Returns the vtkRenderWindow, whose objects live as long as it.
    """
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    page = add_renderer(window, (0, 0, *SIZE))
    colours = diverging_colours(limit)
    for side in SIDES:
        add_side(window, side, scan_points, result, surface, colours, defect)
    add_legend(window, colours)
    histogram.add_histogram(
        add_renderer(window, (1115, 325, 1590, 815)), result.signed_distance, colours, limit,
        tolerance)
    add_text(page, title, 28, 848, size=28, bold=True)
    add_figures(page, rows)
    window.Render()
    return window


def write_png(window, path, width=SIZE[0]):
    """Writes the rendered picture, made smaller where a smaller width is given."""
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    resize = vtkImageResize()
    resize.SetInputConnection(picture.GetOutputPort())
    resize.SetOutputDimensions(width, width * SIZE[1] // SIZE[0], 1)
    writer = vtkPNGWriter()
    writer.SetInputConnection(resize.GetOutputPort())
    writer.SetCompressionLevel(9)
    writer.SetFileName(str(path))
    writer.Write()
