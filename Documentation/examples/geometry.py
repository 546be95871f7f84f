# SPDX-License-Identifier: BSD-3-Clause
"""Spline geometry is plain VTK data: a surface made by hand, a curve, and a model of both."""

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid

# A surface in nothing but VTK: z = x y on the unit square, degree 1 in u and v.
surface = vtkStructuredGrid()
surface.SetDimensions(2, 2, 1)  # (nu, nv, 1)
control_points = vtkPoints()
control_points.SetDataTypeToDouble()
for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 1)):  # u runs fastest
    control_points.InsertNextPoint(point)
surface.SetPoints(control_points)
for name in ("KnotsU", "KnotsV"):
    knots = numpy_to_vtk(np.array([0.0, 0.0, 1.0, 1.0]), deep=True)
    knots.SetName(name)
    surface.GetFieldData().AddArray(knots)

# A curve: a circle of radius 2 around the z axis, at z = 3, rational of degree 2.
w = np.sqrt(0.5)
corners = [(2, 0), (2, 2), (0, 2), (-2, 2), (-2, 0), (-2, -2), (0, -2), (2, -2), (2, 0)]
circle = footpoint.nurbs_curve(
    [(x, y, 3) for x, y in corners], [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4],
    weights=[1, w, 1, w, 1, w, 1, w, 1])

# A model: its faces are numbered in order. The first point is near face 0, the second near face 1.
r = footpoint.invert([[0.5, 0.5, 0.0], [5.0, 0.0, 3.0]], [surface, circle])
print(r.face, r.distance)
assert list(r.face) == [0, 1] and np.isclose(r.distance[1], 3.0)
# Distances from a curve have no sign.
assert np.isfinite(r.signed_distance[0]) and np.isnan(r.signed_distance[1])
