# SPDX-License-Identifier: BSD-3-Clause
"""Points of spline geometry at given parameters, over vtkSplineEvaluator."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkTable

from ._pipeline import as_integers, as_numbers, run, set_geometry, to_numpy, to_vtk
from .vtkFootpointFilters import vtkSplineEvaluator


def evaluate(geometry, parameters, faces=None):
    """Points of a curve, a surface or a model at given parameters: the inverse of `invert`.

    Parameters
    ----------
    geometry
        As in `invert`.
    parameters : (m, 2) array, for curves also (m, 1) or (m,)
        A row (u, v) for every point, in the geometry's own domain; curves take u alone. Outside the
        domain they are wrapped in closed directions and moved to the border in open ones.
    faces : (m,) array of integers or one integer, optional
        On which face, counted from 0. A model of several faces needs it.

    Returns
    -------
    (m, 3) float64 array
        Row i is the point at parameters[i], in model units; NaN where a parameter is NaN or
        infinite or the face does not exist, as with the feet that `invert` does not find. So
        evaluate(g, r.parameters, r.face) gives r.closest_points, NaN where they are.

    Raises
    ------
    ValueError
        The geometry is bad, a shape does not fit, or faces are needed.
    TypeError
        `geometry` is of a type that is none of those.
    """
    parameters = as_numbers(parameters, "parameters")
    if parameters.ndim == 1:
        parameters = parameters[:, None]
    if parameters.ndim != 2 or parameters.shape[1] not in (1, 2):
        raise ValueError(f"parameters has shape {parameters.shape}; (m, 2) or (m, 1) is needed")
    count = len(parameters)

    evaluator = vtkSplineEvaluator()
    table = vtkTable()
    table.AddColumn(to_vtk(parameters, evaluator.GetParametersArrayName()))
    if faces is not None:
        faces = as_integers(faces, "faces", count)
        table.AddColumn(to_vtk(faces, evaluator.GetFaceIdArrayName()))
    evaluator.SetInputData(table)
    set_geometry(evaluator, geometry)
    run(evaluator)

    output = evaluator.GetOutput()
    points = np.full((count, 3), np.nan)
    if output.GetNumberOfPoints() > 0:
        rows = to_numpy(output.GetPointData(), "PointId")
        points[rows] = vtk_to_numpy(output.GetPoints().GetData())
    return points
