# SPDX-License-Identifier: BSD-3-Clause
"""Splines as VTK's own cells: drawn by VTK, and geometry for feet as before."""

import footpoint
import numpy as np
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

# The paraboloid z = x² - y² on [-1, 1]², with a knot line at x = 0.
saddle = footpoint.nurbs_surface(
    [[(x, y, xx - yy) for y, yy in ((-1, 1), (0, -1), (1, 1))]
     for x, xx in ((-1, 1), (-0.5, 0), (0.5, 0), (1, 1))],
    knots_u=[-1, -1, -1, 0, 1, 1, 1], knots_v=[-1, -1, -1, 1, 1, 1])
cells = footpoint.bezier_cells(saddle)
assert cells.GetNumberOfCells() == 2

# VTK's triangles have their corners on the surface. More of them come nearer to it.
drawn = vtkDataSetSurfaceFilter()
drawn.SetInputData(cells)
drawn.SetNonlinearSubdivisionLevel(4)
drawn.Update()
x, y, z = np.array([drawn.GetOutput().GetPoint(i)
                    for i in range(drawn.GetOutput().GetNumberOfPoints())]).T
assert np.allclose(z, x**2 - y**2, atol=1e-6)

# Feet on the cells are feet on the surface, with the same parameters.
points = [[0.3, 0.2, 1.0], [-0.7, 0.4, -0.5]]
on_cells, on_saddle = footpoint.invert(points, cells), footpoint.invert(points, saddle)
assert np.allclose(on_cells.parameters, on_saddle.parameters, atol=1e-13)
assert np.allclose(on_cells.closest_points, on_saddle.closest_points, atol=1e-15)
