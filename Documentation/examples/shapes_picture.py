# SPDX-License-Identifier: BSD-3-Clause
"""The picture of all shapes, drawn from their Bézier cells.

    shapes_picture.py <output folder>

Writes shapes.png, which stands in Documentation/images/gallery.
"""

import pathlib
import sys

import footpoint
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTubeFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderWindow

from inspection.drawing import add_text
from inspection.picture import SIZE, add_renderer, write_small_png

PANELS = [  # label, options, direction to the eye, zoom
    ("sphere", {}, (2, -3, 1.5), 1.35),
    ("cylinder", {"capping": True}, (2, -3, 1.5), 1.3),
    ("cone", {"capping": True}, (2, -3, 1.5), 1.3),
    ("torus", {}, (2, -3, 2.5), 1.2),
    ("circle", {}, (2, -3, 2.5), 1.15),
    ("wing", {"capping": True, "airfoil_digits": "4415"}, (-2.2, -4.5, 2.4), 1.4),
    ("ship_hull", {"capping": True, "beam": 2.0, "draft": 1.0}, (8, -5, -3.5), 1.25),
    ("teapot", {}, (1.5, -5, 2.5), 1.15),
    ("bumpy", {}, (2, -3, 2.5), 0.95),
    ("helix", {}, (2, -3, 1.5), 1.25),
]
CURVES = {"circle", "helix"}
PARTS = [(0.36, 0.55, 0.70), (0.80, 0.52, 0.28), (0.45, 0.64, 0.45), (0.62, 0.47, 0.62)]


def part_actor(cells, curve, colour):
    """Drawn by VTK's nonlinear subdivision; curves as tubes."""
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(cells)
    surface.SetNonlinearSubdivisionLevel(5)
    if curve:
        last = vtkTubeFilter()
        last.SetRadius(0.03)
        last.SetNumberOfSides(16)
    else:
        last = vtkPolyDataNormals()
        last.SetFeatureAngle(40.0)
    last.SetInputConnection(surface.GetOutputPort())
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(last.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(colour)
    look.SetAmbient(0.25)
    look.SetDiffuse(0.75)
    look.SetSpecular(0.25)
    look.SetSpecularPower(30)
    return actor


def add_panel(window, number, name, options, eye, zoom):
    width, height = SIZE[0] // 5, SIZE[1] // 2
    left, low = number % 5 * width, (1 - number // 5) * height
    view = add_renderer(window, (left, low, left + width, low + height))
    shape = footpoint.nurbs_shape(name, **options)
    faces = ([shape.GetBlock(i) for i in range(shape.GetNumberOfBlocks())]
             if shape.IsA("vtkMultiBlockDataSet") else [shape])
    for i, face in enumerate(faces):
        cells = footpoint.bezier_cells(face)
        view.AddActor(part_actor(cells, name in CURVES, PARTS[i]))
    camera = view.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*eye)
    camera.SetViewUp(0, 0, 1)
    view.ResetCamera()
    camera.Zoom(zoom)
    view.ResetCameraClippingRange()
    label = name.replace("_", " ").capitalize()
    add_text(view, label, width // 2, 24, size=30, justify="Centered")


def main(folder):
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    for number, panel in enumerate(PANELS):
        add_panel(window, number, *panel)
    window.Render()
    write_small_png(window, folder / "shapes.png", 1000, 128)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
