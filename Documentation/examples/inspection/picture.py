# SPDX-License-Identifier: BSD-3-Clause
"""The deviation picture: the part in colours from two sides, the worst region close up, a legend, a
histogram and the figures."""

import struct
from zlib import compress, crc32

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401, draws text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkImagingColor import vtkImageQuantizeRGBToIndex
from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkColorTransferFunction, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
    vtkWindowToImageFilter)

from .analysis import point_data
from .drawing import DARK, GREY, PALE, add_line, add_rectangles, add_text
from .histogram import add_histogram, colour_of
from .lengths import round_up

SIZE = (1600, 900)
FRONT, BACK, DETAIL = (15, 330, 955, 800), (15, 15, 480, 315), (490, 15, 955, 315)  # pixels
ELEVATION = 32.0  # degrees
NEARNESS = 0.5  # how much it counts that the worst region is on the near side
DETAIL_SIZE = 0.15  # what the close view shows at least, of the part's size
BLACK = (0.05, 0.05, 0.05)
NOMINAL = (0.96, 0.90, 0.62)


def diverging_colours(limit):
    """Blue below zero, light grey at zero, red above (K. Moreland 2009)."""
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


def surface_actor(mesh, colour):
    """Triangles in one colour."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetAmbient(0.45)
    actor.GetProperty().SetDiffuse(0.6)
    return actor


def edges_actor(mesh, shift):
    """The borders of the faces, drawn nearer to the eye by a vector."""
    edges = vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.FeatureEdgesOff()
    edges.NonManifoldEdgesOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.SetPosition(shift)
    actor.GetProperty().SetColor(DARK)
    actor.GetProperty().SetOpacity(0.35)
    actor.GetProperty().LightingOff()
    return actor


def points_actor(positions, size, normals=None, deviations=None, colours=None):
    """Points in the colour of their deviation, lit like the surface under them; or plain black."""
    data = point_data(positions)
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(vertices.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetPointSize(size)
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


def eyes(part, inspection):
    """Unit vectors towards the eye for both sides; the first sees most of the deviations."""
    rows = np.flatnonzero(inspection.good)
    rows = rows[np.linspace(0, len(rows) - 1, min(len(rows), 5000)).astype(int)]
    normals, weights = inspection.result.normals[rows], np.abs(inspection.result.distance[rows])
    closed = inspection.result.statistics["open_edges"] == 0  # else only the upper side is seen
    outward = np.zeros(3)
    if inspection.regions:
        middle = np.reshape(part.mesh.GetBounds(), (3, 2)).mean(axis=1)
        outward = (inspection.regions[0].position - middle) / part.size

    def eye(azimuth, height):
        return np.array([np.cos(azimuth) * np.cos(height), np.sin(azimuth) * np.cos(height),
                         np.sin(height)])

    def merit(angles):
        facing = np.maximum(0.0, normals @ eye(*angles))
        return (facing.mean() + np.average(facing, weights=weights + 1e-30)
                + NEARNESS * outward @ eye(*angles))

    heights = np.radians((ELEVATION, -ELEVATION) if closed else (ELEVATION,))
    azimuths = np.radians(np.arange(0.0, 360.0, 15.0))
    azimuth, height = max(((a, h) for h in heights for a in azimuths), key=merit)
    return eye(azimuth, height), eye(azimuth + np.pi, -height if closed else height)


class View:
    """A part of the picture that looks at the part from one side."""

    def __init__(self, window, viewport, toward, corners, closest=0.0):
        """toward: unit vector to the eye; corners: (k, 3) that are to be in sight."""
        self.width, self.height = viewport[2] - viewport[0], viewport[3] - viewport[1]
        self.renderer = add_renderer(window, viewport)
        self.toward = toward
        right = np.cross([0.0, 0.0, 1.0], toward)
        right /= np.linalg.norm(right)
        up = np.cross(toward, right)
        flat = np.column_stack([corners @ right, corners @ up])
        middle, extent = 0.5 * (flat.max(axis=0) + flat.min(axis=0)), np.ptp(flat, axis=0)
        extent = np.maximum(extent, closest)
        self.pixels = min((self.width - 50) / extent[0], (self.height - 70) / extent[1])  # a unit
        centre = middle[0] * right + middle[1] * up + corners.mean(axis=0) @ toward * toward
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(centre)
        camera.SetPosition(centre + 10.0 * extent.max() * toward)
        camera.SetViewUp(up)
        camera.SetParallelScale(0.5 * self.height / self.pixels)
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(-0.3, 0.5, 1.0)  # from above, on the left
        self.renderer.AddLight(light)

    def add_part(self, part, inspection, colours, spacing):
        """The nominal part and the points on this side of it; outliers are black."""
        result = inspection.result
        facing = result.normals @ self.toward > 0.0
        # Drawn towards the eye, so that the surface hides no point that lies below it.
        lift = max(2.0 * inspection.tolerance, 0.004 * part.size) * self.toward
        points = inspection.points + lift
        shown, outliers = inspection.good & facing, inspection.outliers & facing
        size = float(np.clip(1.7 * spacing * self.pixels, 3.0, 12.0))
        self.renderer.AddActor(surface_actor(part.mesh, NOMINAL))
        self.renderer.AddActor(edges_actor(part.mesh, 1.5 * lift))
        self.renderer.AddActor(points_actor(
            points[shown], size, result.normals[shown], result.signed_distance[shown], colours))
        self.renderer.AddActor(points_actor(points[outliers], 3.5))
        self.renderer.ResetCameraClippingRange()

    def add_title(self, title):
        add_text(self.renderer, title, 10, self.height - 24, size=20, bold=True, veil=0.8)

    def add_callout(self, region, number, lengths):
        """Points at a region and says what was measured there."""
        self.renderer.SetWorldPoint(*region.position, 1.0)
        self.renderer.WorldToDisplay()
        x, y = np.array(self.renderer.GetDisplayPoint()[:2]) - self.renderer.GetOrigin()
        leftward = 230 < x < 0.5 * self.width or x > self.width - 230
        side = -1 if leftward else 1
        corner = (x + 60 * side, min(y + 55, self.height - 60))
        end = (corner[0] + 16 * side, corner[1])
        add_line(self.renderer, [(x, y), corner, end], width=2.0)
        add_text(self.renderer, f"{number}:  {lengths.signed(region.height, 1)}",
                 end[0] + 6 * side, end[1] - 7, size=22, bold=True,
                 justify="Right" if leftward else "Left", veil=0.8)

    def add_scale_bar(self, unit):
        length = round_up(0.07 * self.width / self.pixels, (1.0, 2.0, 5.0, 10.0))
        pixels = length * self.pixels
        add_line(self.renderer, [(15, 21), (15, 13), (15 + pixels, 13), (15 + pixels, 21)])
        add_text(self.renderer, f"{length:g} {unit}", 15 + 0.5 * pixels, 21, size=16,
                 justify="Centered", veil=0.8)


def add_legend(page, frame, colours, lengths, outliers):
    """The colour bar with its labels, and what black and grey mean. frame: the bar in pixels."""
    left, bottom, right, top = frame
    limit = lengths.colour_limit
    edges = np.linspace(bottom, top, 257)
    values = np.linspace(-limit, limit, 256)
    add_rectangles(page, [(left, a, right, b) for a, b in zip(edges[:-1], edges[1:])],
                   [colour_of(colours, value) for value in values])
    for value in np.linspace(-limit, limit, 9):
        y = bottom + (value + limit) / (2.0 * limit) * (top - bottom)
        add_line(page, [(right, y), (right + 5, y)])
        add_text(page, lengths.tick(value, limit), right + 10, y - 6, size=17)
    add_text(page, f"Deviation [{lengths.unit}]", left - 8, top + 18, size=19, bold=True)
    add_rectangles(page, [(left + 6, bottom - 38, left + 12, bottom - 32)], BLACK)
    add_text(page, f"{outliers:,} outliers", left + 24, bottom - 42, size=16)
    add_rectangles(page, [(left + 2, bottom - 66, left + 16, bottom - 54)], NOMINAL)
    add_text(page, "not scanned", left + 24, bottom - 66, size=16)
    add_text(page, "+  outward", left + 1, bottom - 90, size=16)


def add_figures(page, rows, left, right, top):
    """A table of (name, value)."""
    for i, (name, value) in enumerate(rows):
        y = top - 27 * i
        add_text(page, name, left, y, size=17)
        add_text(page, value, right, y, size=17, justify="Right")
        add_line(page, [(left, y - 8), (right, y - 8)], colour=PALE, width=1.0)


def make_picture(part, inspection, lengths, title, subtitle, rows):
    """Renders the picture of an Inspection; rows: pairs of strings for the table.

    Returns the vtkRenderWindow.
    """
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    page = add_renderer(window, (0, 0, *SIZE))
    colours = diverging_colours(lengths.colour_limit)
    spacing = np.sqrt(part.area / max(1, inspection.good.sum()))
    corners = vtk_to_numpy(part.mesh.GetPoints().GetData())
    front, back = eyes(part, inspection)
    views = [View(window, FRONT, front, corners), View(window, BACK, back, corners)]
    views[0].add_title("Front")
    views[1].add_title("Back")
    worst = inspection.regions[0] if inspection.regions else None
    if worst:
        near = corners[np.linalg.norm(corners - worst.position, axis=1) < DETAIL_SIZE * part.size]
        on_front = worst.normal @ front > 0.0
        views.append(View(window, DETAIL, front if on_front else back,
                          np.vstack([near, worst.position]), DETAIL_SIZE * part.size))
        views[2].add_title("Region 1" + (
            f": moved by {lengths.text(np.linalg.norm(worst.motion.shift), 1)}, tilted by "
            f"{worst.motion.tilt:.1f}\u00b0" if worst.motion.explains else ""))
    for view in views:
        view.add_part(part, inspection, colours, spacing)
        view.add_scale_bar(lengths.unit)
    if worst:
        views[0 if on_front else 1].add_callout(worst, 1, lengths)
    add_text(page, title, 25, 852, size=28, bold=True)
    add_text(page, subtitle, 25, 818, size=18, colour=GREY)
    add_legend(page, (970, 130, 1005, 740), colours, lengths, int(inspection.outliers.sum()))
    add_histogram(page, (1195, 415, 1570, 740), inspection.result.signed_distance[inspection.good],
                  colours, lengths)
    add_figures(page, rows, 1125, 1570, 318)
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
