# SPDX-License-Identifier: BSD-3-Clause
"""Triangles of a face with a hole, to a chord tolerance, for everything that takes polygons."""

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

# A quarter of a cylinder of radius 10 and height 10, from which a square window is cut out.
w = np.sqrt(0.5)
quarter = [(10, 0), (10, 10), (0, 10)]
cylinder = footpoint.nurbs_surface(
    [[(x, y, 0), (x, y, 10)] for x, y in quarter], [0, 0, 0, 1, 1, 1], [0, 0, 1, 1],
    weights=[[1, 1], [w, w], [1, 1]])
border = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)])
window = 0.3 + 0.4 * border[::-1]  # clockwise: a hole
face = footpoint.trimmed_face(cylinder, [[border], [window]])

mesh = footpoint.tessellate(face, chord_tolerance=0.001, absolute_tolerance=True)
points = vtk_to_numpy(mesh.GetPoints().GetData())
normals = vtk_to_numpy(mesh.GetPointData().GetNormals())    # of the cylinder, not of the triangles
parameters = vtk_to_numpy(mesh.GetPointData().GetTCoords())  # (u, v)
corners = points[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
depth = 10 - np.linalg.norm(corners.mean(axis=1)[:, :2], axis=1)
print(f"{mesh.GetNumberOfPolys()} triangles, at most {depth.max():.2g} below the cylinder")
assert depth.max() <= 0.001
assert np.allclose(normals[:, :2], points[:, :2] / 10)
assert np.allclose(footpoint.evaluate(cylinder, parameters), points)
