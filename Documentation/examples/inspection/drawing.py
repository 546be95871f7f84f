# SPDX-License-Identifier: BSD-3-Clause
"""Text, lines and rectangles in pixels of a renderer's viewport."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_POLY_LINE, VTK_QUAD, vtkPolyData
from vtkmodules.vtkRenderingCore import (
    vtkActor2D, vtkCoordinate, vtkPolyDataMapper2D, vtkTextActor)

DARK, GREY, PALE = (0.13, 0.15, 0.18), (0.40, 0.43, 0.47), (0.87, 0.88, 0.90)
RED = (0.72, 0.20, 0.10)


def signed(value, digits):
    """A number with its sign and a true minus sign; zero has none."""
    text = f"{value:+.{digits}f}"
    return text[1:] if float(text) == 0.0 else text.replace("-", "\u2212")


def add_text(renderer, text, x, y, size=20, colour=DARK, bold=False, justify="Left", angle=0.0,
             veil=0.0):
    """Text whose baseline is at (x, y); veil: opacity of the white under it."""
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(size)
    style.SetColor(colour)
    style.SetBold(bold)
    style.SetOrientation(angle)
    style.SetBackgroundColor(1.0, 1.0, 1.0)
    style.SetBackgroundOpacity(veil)
    getattr(style, f"SetJustificationTo{justify}")()
    renderer.AddActor2D(actor)


def add_cells(renderer, cells, cell_type, colours, width=1.0):
    """Cells, each given by its corners (k, 2); one colour for all, or (n, 3) colours."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.AllocateExact(len(cells), 8)
    for corners in cells:
        ids = [data.GetPoints().InsertNextPoint(x, y, 0.0) for x, y in corners]
        data.InsertNextCell(cell_type, len(ids), ids)
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(data)
    pixels = vtkCoordinate()
    pixels.SetCoordinateSystemToViewport()
    mapper.SetTransformCoordinate(pixels)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetLineWidth(width)
    if np.ndim(colours) == 1:
        actor.GetProperty().SetColor(colours)
    else:
        rgb = np.round(255.0 * np.asarray(colours)).astype(np.uint8)
        data.GetCellData().SetScalars(numpy_to_vtk(rgb, deep=True))
    renderer.AddActor2D(actor)


def add_line(renderer, points, colour=DARK, width=1.5):
    """A polyline."""
    add_cells(renderer, [points], VTK_POLY_LINE, colour, width)


def add_rectangles(renderer, rectangles, colours):
    """Filled rectangles (x0, y0, x1, y1); one colour, or one for each."""
    corners = [((a, b), (c, b), (c, d), (a, d)) for a, b, c, d in rectangles]
    add_cells(renderer, corners, VTK_QUAD, colours)
