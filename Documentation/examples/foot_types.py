# SPDX-License-Identifier: BSD-3-Clause
"""The picture of the foot types: a folded sheet whose one side is collapsed to a point.

    foot_types.py <output folder>

Writes foot_types.png, which stands in Documentation/images.
"""

import pathlib
import sys

import footpoint
import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderWindow

from inspection.drawing import add_text
from inspection.picture import SIZE, add_renderer, surface_actor, write_small_png
from inspection.tessellation import tessellate

KINDS = {  # the point that shows each, where its label stands (pixels), its colour
    footpoint.FootType.INTERIOR: ((2.5, -0.95, 1.35), (145, -12), (0.15, 0.35, 0.75)),
    footpoint.FootType.EDGE: ((2.1, -2.0, 0.1), (0, -62), (0.85, 0.45, 0.05)),
    footpoint.FootType.VERTEX: ((4.6, -2.6, 0.2), (0, -62), (0.45, 0.20, 0.60)),
    footpoint.FootType.KINK: ((3.6, 0.1, 2.0), (0, 26), (0.10, 0.50, 0.25)),
    footpoint.FootType.DEGENERATE: ((-0.8, 0.0, 0.3), (0, 26), (0.72, 0.10, 0.12)),
}


def folded_sheet():
    """Degree 1: v = 0 is one point, u = 1/2 a sharp ridge."""
    return footpoint.nurbs_surface(
        [[[0, 0, 0], [4, -2, 0]], [[0, 0, 0], [4, 0, 1.2]], [[0, 0, 0], [4, 2, 0]]],
        knots_u=[0, 0, 0.5, 1, 1], knots_v=[0, 0, 1, 1])


def add_coloured(renderer, algorithm, colour):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(algorithm.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    renderer.AddActor(actor)


def add_ball(renderer, centre, radius, colour):
    ball = vtkSphereSource()
    ball.SetCenter(centre)
    ball.SetRadius(radius)
    ball.SetThetaResolution(32)
    ball.SetPhiResolution(32)
    add_coloured(renderer, ball, colour)


def add_foot(renderer, point, sheet, offset, colour, kind):
    """The point, its foot, the segment between them, and a label."""
    result = footpoint.invert([point], sheet, foot_segments=True)
    assert result.foot_type[0] == kind, f"{result.foot_type[0]} at the place for {kind.name}"
    segment = vtkPolyData()
    segment.SetPoints(result.foot_points.GetPoints())
    segment.SetLines(result.foot_points.GetLines())
    tube = vtkTubeFilter()
    tube.SetInputData(segment)
    tube.SetRadius(0.018)
    tube.SetNumberOfSides(16)
    add_coloured(renderer, tube, colour)
    add_ball(renderer, point, 0.07, colour)
    add_ball(renderer, result.closest_points[0], 0.045, (0.1, 0.1, 0.1))
    renderer.SetWorldPoint(*point, 1.0)
    renderer.WorldToDisplay()
    x, y = renderer.GetDisplayPoint()[:2] + np.array(offset)
    add_text(renderer, f"{int(kind)} {kind.name.capitalize()}", x, y, size=34, bold=True,
             colour=colour, justify="Centered")


def main(folder):
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    renderer = add_renderer(window, (0, 0, *SIZE))
    sheet = folded_sheet()
    renderer.AddActor(surface_actor(tessellate(sheet), (0.72, 0.74, 0.77)))
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(2.05, -0.15, 0.4)
    camera.SetPosition(-0.2, -7.0, 6.8)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(27.0)
    for kind, (point, offset, colour) in KINDS.items():
        add_foot(renderer, point, sheet, offset, colour, kind)
    renderer.ResetCameraClippingRange()
    window.Render()
    write_small_png(window, folder / "foot_types.png", 800, 128)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
