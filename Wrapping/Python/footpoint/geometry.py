# SPDX-License-Identifier: BSD-3-Clause
"""Spline geometry as VTK data, made from NumPy arrays."""

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet,
    vtkMultiBlockDataSet,
    vtkStructuredGrid,
    vtkTable,
)

from ._pipeline import as_numbers, run, set_geometry, to_model, to_vtk
from .vtkFootpointFilters import vtkSplineEvaluator


def nurbs_surface(control_points, knots_u, knots_v, weights=None):
    """A NURBS (B-spline) surface.

    Parameters
    ----------
    control_points : (nu, nv, 3) array
        Cartesian, not multiplied by the weights; control_points[i, j] belongs to the i-th basis
        function in u and the j-th in v.
    knots_u, knots_v : (nu + pu + 1,) and (nv + pv + 1,) arrays
        Full knot vectors, not decreasing; their lengths imply the degrees pu and pv. They may be
        clamped, unclamped or periodic. The domain is [knots[p], knots[n]] in each direction.
    weights : (nu, nv) array, optional
        Positive. Without it all weights are 1 (a polynomial surface).

    Returns
    -------
    vtkStructuredGrid
        Dimensions (nu, nv, 1), the control points as its points (u fastest), field data `KnotsU`,
        `KnotsV` and `Degree`, point data `RationalWeights` (active) where there are weights. A copy:
        later changes of the arrays do not show.

    Raises
    ------
    ValueError
        A shape does not fit; or what the filters refuse (decreasing knots, weights <= 0, NaN, no
        interior span), with their text, which names the array, the index and the value.
    """
    points = as_numbers(control_points, "control_points")
    if points.ndim != 3 or points.shape[2] != 3:
        raise ValueError(f"control_points has shape {points.shape}; (nu, nv, 3) is needed")
    if points.shape[1] < 2:
        raise ValueError(
            f"control_points has shape {points.shape}; a surface needs two rows in v at least"
        )
    return _net(points, [knots_u, knots_v], ["knots_u", "knots_v"], weights)


def nurbs_curve(control_points, knots, weights=None):
    """A NURBS (B-spline) curve in space or in the plane z = 0.

    Parameters
    ----------
    control_points : (n, 3) or (n, 2) array
        Cartesian, not multiplied by the weights.
    knots : (n + p + 1,) array
        Full knot vector, not decreasing; its length implies the degree p. It may be clamped,
        unclamped or periodic. The domain is [knots[p], knots[n]].
    weights : (n,) array, optional
        Positive. Without it all weights are 1.

    Returns
    -------
    vtkStructuredGrid
        Dimensions (n, 1, 1); like `nurbs_surface`, with `KnotsU` alone.

    Raises
    ------
    ValueError
        As `nurbs_surface`.
    """
    points = as_numbers(control_points, "control_points")
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"control_points has shape {points.shape}; (n, 3) or (n, 2) is needed")
    return _net(_in_space(points)[:, None, :], [knots], ["knots"], weights)


def trimmed_face(net, loops):
    """A surface with trim loops in its parameter domain.

    Parameters
    ----------
    net : vtkStructuredGrid
        The surface, as `nurbs_surface` makes it.
    loops : list
        Each loop is a list of pieces, head to tail: curves in the (u, v) plane (`nurbs_curve` of
        (n, 2) control points) or polylines, (k, 2) arrays with a row (u, v) for every corner.
        A piece alone stands for a list of one. A (k, 2) array that is a whole loop is a polygon:
        its first corner is appended where the last one differs. Counter-clockwise loops keep their
        inside, clockwise ones are holes.

    Returns
    -------
    vtkMultiBlockDataSet
        Blocks `Surface` (the net itself, no copy), `Loop 0`, `Loop 1`, ...; every loop is a
        vtkMultiBlockDataSet of its pieces; a polyline is a vtkStructuredGrid of dimensions
        (k, 1, 1) without `KnotsU`. Field data of the net belongs to the face: `Orientation` -1
        reverses its normal, `Tolerance` is up to which gap (in model units) loops are closed.

    Raises
    ------
    TypeError
        `net` or a piece is of another type.
    ValueError
        There is no loop, a loop has no piece, or a polyline has another shape; or what the filters
        refuse (a curve out of the plane, a polyline of one point, bad knots), with their text,
        which names the loop, the curve and the value.
    """
    if not isinstance(net, vtkStructuredGrid):
        raise TypeError(f"net is a {type(net).__name__}; a vtkStructuredGrid is needed")
    if len(loops) == 0:
        raise ValueError("loops is empty; the surface itself is the untrimmed face")
    face = vtkMultiBlockDataSet()
    _append_block(face, "Surface", net)
    for i, pieces in enumerate(loops):
        if isinstance(pieces, (np.ndarray, vtkStructuredGrid)):
            pieces = [pieces]
        if len(pieces) == 0:
            raise ValueError(f"loop {i} has no pieces")
        loop = vtkMultiBlockDataSet()
        for j, piece in enumerate(pieces):
            data = _loop_piece(piece, f"piece {j} of loop {i}", closed=len(pieces) == 1)
            _append_block(loop, f"Curve {j}", data)
        _append_block(face, f"Loop {i}", loop)
    _check(face)
    return face


def model(faces):
    """A model of several faces.

    Parameters
    ----------
    faces : list
        Surfaces, curves, Bézier cells, trimmed faces or models; None uses up its number.

    Returns
    -------
    vtkMultiBlockDataSet
        The faces in order. Their numbers (`face` of results, array `FaceId`) count from 0.

    Raises
    ------
    TypeError
        An entry is no VTK data.
    """
    return to_model(faces)


def _net(points, knots, names, weights):
    """The structured grid of (nu, nv, 3) control points; checked by the evaluator's own rules."""
    nu, nv = points.shape[:2]
    net = vtkStructuredGrid()
    net.SetDimensions(nu, nv, 1)
    coordinates = vtkPoints()
    u_fastest = points.transpose(1, 0, 2).reshape(-1, 3)
    coordinates.SetData(to_vtk(u_fastest, copy=True))
    net.SetPoints(coordinates)

    degrees = []
    for values, name, count, vtk_name in zip(knots, names, (nu, nv), ("KnotsU", "KnotsV")):
        values = as_numbers(values, name).astype(np.float64, copy=False)
        degree = values.size - count - 1
        if values.ndim != 1 or degree < 1:
            raise ValueError(
                f"{name} has shape {values.shape}; for {count} control points (n + degree + 1,) "
                f"is needed, at least ({count + 2},)"
            )
        degrees.append(degree)
        net.GetFieldData().AddArray(to_vtk(values, vtk_name, copy=True))
    degrees = np.asarray(degrees, dtype=np.int32)
    net.GetFieldData().AddArray(to_vtk(degrees, "Degree", copy=True))

    if weights is not None:
        weights = as_numbers(weights, "weights").astype(np.float64, copy=False)
        wanted = (nu, nv) if len(knots) == 2 else (nu,)
        if weights.shape != wanted:
            raise ValueError(f"weights has shape {weights.shape}; {wanted} is needed")
        array = to_vtk(weights.T.ravel(), "RationalWeights", copy=True)
        net.GetPointData().SetRationalWeights(array)
    _check(net)
    return net


def _check(geometry):
    """Lets the evaluator convert geometry, and so refuse it, without a point to evaluate."""
    evaluator = vtkSplineEvaluator()
    evaluator.SetInputData(vtkTable())
    set_geometry(evaluator, geometry)
    run(evaluator)


def _in_space(points):
    """(n, 2) points with z = 0; (n, 3) ones as they are."""
    return points if points.shape[1] == 3 else np.pad(points, ((0, 0), (0, 1)))


def _loop_piece(piece, name, closed):
    """A curve as it is, a (k, 2) array as a polyline, closed if wanted."""
    if isinstance(piece, vtkStructuredGrid):
        return piece
    corners = as_numbers(piece, name)
    if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 2:
        raise ValueError(f"{name} has shape {corners.shape}; (k, 2) with k >= 2 is needed")
    if closed and not np.array_equal(corners[0], corners[-1]):
        corners = np.concatenate([corners, corners[:1]])
    polyline = vtkStructuredGrid()
    polyline.SetDimensions(len(corners), 1, 1)
    points = vtkPoints()
    points.SetData(to_vtk(_in_space(corners), copy=True))
    polyline.SetPoints(points)
    return polyline


def _append_block(blocks, name, data):
    number = blocks.GetNumberOfBlocks()
    blocks.SetBlock(number, data)
    blocks.GetMetaData(number).Set(vtkCompositeDataSet.NAME(), name)
