# SPDX-License-Identifier: BSD-3-Clause
"""Triangles for drawing a spline surface. For drawing only: nothing is measured on them."""

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter


def tessellate(surface, samples=(200, 120)):
    """A surface with domain [0, 1]² as vtkPolyData with normals, which turn at sharp edges."""
    u, v = (np.linspace(0.0, 1.0, count) for count in samples)
    vv, uu = np.meshgrid(v, u, indexing="ij")  # u fastest
    parameters = np.column_stack([uu.ravel(), vv.ravel()])
    grid = vtkStructuredGrid()
    grid.SetDimensions(*samples, 1)
    grid.SetPoints(vtkPoints())
    grid.GetPoints().SetData(numpy_to_vtk(footpoint.evaluate(surface, parameters), deep=True))
    quads = vtkGeometryFilter()
    quads.SetInputData(grid)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(quads.GetOutputPort())
    normals.SetFeatureAngle(60.0)
    normals.Update()
    return normals.GetOutput()
