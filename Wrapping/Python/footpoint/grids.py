# SPDX-License-Identifier: BSD-3-Clause
"""Transfinite interpolation in NumPy terms: patches, surfaces through curves, volumes, smoothing."""

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStructuredGrid

from ._options import set_options
from ._pipeline import as_numbers, run, to_vtk
from .vtkFootpointFilters import (
    vtkCoonsPatchSource,
    vtkCoonsSurface,
    vtkGordonSurface,
    vtkStructuredGridSmoother,
    vtkTransfiniteVolume,
)


def coons_patch(bottom, right, top, left, **options):
    """Structured grid between four boundary polylines (Coons patch).

    Parameters
    ----------
    bottom, right, top, left : (k, 3) or (k, 2) arrays
        The sides; z = 0 where there are two columns. Order and directions are repaired unless
        strict=True: any four polylines that meet do. One of them may be None: that side is the
        point where its neighbours meet.

    Options
    -------
    Those of vtkCoonsPatchSource. An enumeration is given by name or number.

    resolution : 2 ints, default (21, 21)
        Numbers of points along u and v; 0: as many as the longer of the two facing sides has.
    parametrization : Uniform, ArcLengthRecorded, ArcLengthResampled or ArcLengthBlended, default
        Uniform. Even in the samples' numbers; the same with recorded arc lengths; sides sampled
        evenly in arc length; interior parameters from the arc lengths of facing sides (Soni).
    blend : Bilinear or Bicubic, default Bilinear
        Bicubic: Hermite blending with estimated cross-boundary tangents.
    smoothing : None, Auto, Laplacian or Winslow (as text), default "None"
        Auto is Winslow, only where the grid has folds. Laplacian makes no new fold.
    maximum_smoothing_iterations : int, default 100
        Of the smoother.
    strict : bool, default False
        Take the sides as given and refuse those that do not fit.
    force_corner_match : bool, default False
        Close gaps at corners up to corner_tolerance by moving both ends to their middle.
    corner_tolerance : float, default 0.001
        Widest gap that is closed, as a fraction of the boundary's size.
    corner_angle : float, default 30.0
        Turn in degrees that may be a corner of a loop; not used with four sides.
    corner_ids : 4 ints, default (-1, -1, -1, -1)
        Corners of a loop; not used with four sides.
    generate_normals, generate_texture_coordinates : bool, default True
        Make the point arrays `Normals` and `TCoords`.
    cell_type : Quads or Triangles, default Quads
        Of the class's second output alone, as triangle_style (AlignLeft, AlignRight or UnionJack,
        default AlignLeft).

    Returns
    -------
    vtkStructuredGrid
        u along bottom, v along left; cell arrays `Jacobian` (scaled, minimum over corners) and
        `Folded`; field data `CornerGaps`, `EdgeOrder`, `EdgeReversed`, `SelfCrossing`,
        `FoldedCellsBefore`, `FoldedCellsAfter`, `SmoothingStatus`.

    Raises
    ------
    ValueError
        The boundary is bad; the text names the sides and says how far.
    TypeError
        An unknown option, or an option's value of the wrong type.
    """
    source = vtkCoonsPatchSource()
    set_options(source, options, "coons_patch")
    sides = {"bottom": bottom, "right": right, "top": top, "left": left}
    for name, side in sides.items():
        if side is not None:
            source.AddInputData(_polyline(side, name))
    run(source)
    return source.GetOutput()


def coons_surface(bottom, right, top, left, **options):
    """The Coons surface of four NURBS curves as a NURBS surface, exactly.

    Parameters
    ----------
    bottom, right, top, left : vtkStructuredGrid
        Curves as `nurbs_curve` makes them; order and directions are repaired unless strict=True.

    Options
    -------
    corner_tolerance : float, default 1e-08
        How far apart ends that should meet may be, as a fraction of the boundary's size.
    strict : bool, default False
        Take the curves as given.

    Returns
    -------
    vtkStructuredGrid
        The control net, as `nurbs_surface` makes it, with the field data `EdgeOrder`,
        `EdgeReversed` and `CornerGaps`.

    Raises
    ------
    ValueError
        A curve is bad, or curves do not meet.
    TypeError
        An unknown option, or an option's value of the wrong type.
    """
    surface = vtkCoonsSurface()
    set_options(surface, options, "coons_surface")
    for curve in (bottom, right, top, left):
        surface.AddInputData(curve)
    run(surface)
    return surface.GetOutput()


def gordon_surface(profiles, guides, **options):
    """NURBS surface through a network of curves (W. J. Gordon 1969).

    Parameters
    ----------
    profiles, guides : lists of vtkStructuredGrid
        At least two curves each, as `nurbs_curve` makes them, in any order and direction. Every
        profile meets every guide once. Weights only where all curves of a family have the same.
        Closed profiles make a surface that is closed along u, from the first guide (or the one that
        is given twice) around to it again; closed guides likewise along v.

    Options
    -------
    intersection_tolerance : float, default 0.001
        How far curves may pass each other, as a fraction of the network's size.
    reparametrize : bool, default False
        Change the parameters of curves that do not agree in where they are met.
    reparametrization_tolerance : float, default 0.0001
        Largest change of a curve by that, as a fraction of the network's size.

    Returns
    -------
    vtkStructuredGrid
        The control net, profiles along u, guides along v, with the field data `ParametersU`,
        `ParametersV`, `ProfileOrder`, `GuideOrder`, `ProfileReversed`, `GuideReversed`,
        `LargestGap` and `ReparametrizationError`.

    Raises
    ------
    ValueError
        A curve is bad, or the network cannot be put in order.
    TypeError
        An unknown option, or an option's value of the wrong type.
    """
    surface = vtkGordonSurface()
    set_options(surface, options, "gordon_surface")
    for curve in profiles:
        surface.AddInputData(curve)
    for curve in guides:
        surface.AddGuidesData(curve)
    run(surface)
    return surface.GetOutput()


def transfinite_volume(parts, **options):
    """Structured grid of the volume between six faces or twelve edges.

    Parameters
    ----------
    parts : list of 6 or of 12
        Six faces, (n, m, 3) arrays or vtkStructuredGrids: u = 0, u = 1 (over v, w), v = 0, v = 1
        (over u, w), w = 0, w = 1 (over u, v), the first index along the first named direction. Or
        twelve edges, (k, 3) arrays: four along u at (v, w) = 00, 10, 01, 11, four along v at
        (u, w), four along w at (u, v).

    Options
    -------
    corner_tolerance : float, default 1e-08
        How far apart faces may be along common edges, as a fraction of the size of all.

    Returns
    -------
    vtkStructuredGrid
        With the cell arrays `Jacobian` and `Folded` and the field data `Mirrored`, `LargestGap`
        and `FoldedCells`.

    Raises
    ------
    ValueError
        A shape is wrong or parts do not fit together.
    TypeError
        An unknown option, or an option's value of the wrong type.
    """
    volume = vtkTransfiniteVolume()
    set_options(volume, options, "transfinite_volume")
    for i, part in enumerate(parts):
        if len(parts) == 12:
            volume.AddInputData(_polyline(part, f"edge {i}"))
        else:
            volume.AddInputData(_grid(part, f"face {i}"))
    run(volume)
    return volume.GetOutput()


def smooth_grid(grid, **options):
    """Mends folds of a structured grid and evens it out; its sides stay.

    Parameters
    ----------
    grid : vtkStructuredGrid or (nu, nv, 3) array
        In the plane or in space.

    Options
    -------
    method : None, Auto, Laplacian or Winslow (as text), default Auto
        Auto is Winslow, only where the grid has folds. Laplacian makes no new fold. None measures
        alone.
    maximum_iterations : int, default 100
        At most so many.
    tolerance : float, default 1e-10
        Of the residual of Winslow's equations against that of the start.
    control_functions : NoControl or ThomasMiddlecoff, default NoControl
        Spacing that Winslow's equations keep: that of the sides.
    boundary : Fixed or Sliding, default Fixed
        Whether points of the sides may slide along them.

    Returns
    -------
    vtkStructuredGrid
        With the cell arrays `Jacobian` and `Folded` and the field data `FoldedCellsBefore`,
        `FoldedCellsAfter`, `SmoothingStatus`, `SmoothingIterations` and `SmoothingResidual`.

    Raises
    ------
    ValueError
        The grid has fewer than two points in a direction, or a point is not finite.
    TypeError
        An unknown option, or an option's value of the wrong type.
    """
    smoother = vtkStructuredGridSmoother()
    set_options(smoother, options, "smooth_grid")
    smoother.SetInputData(_grid(grid, "grid"))
    run(smoother)
    return smoother.GetOutput()


def _points(array):
    result = vtkPoints()
    result.SetData(to_vtk(np.asarray(array, dtype=np.float64), copy=True))
    return result


def _polyline(points, name):
    points = as_numbers(points, name)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"{name} has shape {points.shape}; (k, 3) or (k, 2) is needed")
    if points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    data = vtkPolyData()
    data.SetPoints(_points(points))
    line = vtkCellArray()
    line.InsertNextCell(len(points), range(len(points)))
    data.SetLines(line)
    return data


def _grid(grid, name):
    if isinstance(grid, vtkStructuredGrid):
        return grid
    points = as_numbers(grid, name)
    if points.ndim != 3 or points.shape[2] != 3:
        raise ValueError(f"{name} has shape {points.shape}; (n, m, 3) is needed")
    result = vtkStructuredGrid()
    result.SetDimensions(points.shape[0], points.shape[1], 1)
    result.SetPoints(_points(points.transpose(1, 0, 2).reshape(-1, 3)))
    return result
