# SPDX-License-Identifier: BSD-3-Clause
"""Point inversion in NumPy terms, over vtkPointInversionFilter."""

from dataclasses import dataclass, fields
from enum import IntEnum
from typing import Optional

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ._options import set_options, snake_case
from ._pipeline import as_integers, as_numbers, run, set_geometry, to_numpy, to_vtk
from .vtkFootpointFilters import vtkPointInversionFilter


def _enumeration(name, doc):
    """An IntEnum with the members of one of the filter's wrapped enumerations."""
    wrapped = getattr(vtkPointInversionFilter, name + "Enum")
    members = vars(vtkPointInversionFilter).items()
    values = {key: int(value) for key, value in members if isinstance(value, wrapped)}
    result = IntEnum(name, sorted(values.items(), key=lambda item: item[1]), module=__name__)
    result.__doc__ = doc
    return result


Status = _enumeration(
    "Status",
    """What is known about a foot, the numbers of `status`.

    CERTIFIED (proved: no point is nearer by more than certificate_tolerance), CONVERGED (a local
    minimum of the distance, or where a line along fixed_direction meets the geometry),
    NOT_CONVERGED (the best point found), BEYOND_MAXIMUM_DISTANCE (no foot within
    maximum_distance, or a line that meets nothing), INVALID_POINT (a coordinate is NaN or infinite), NO_ORTHOGONAL_FOOT (with
    orthogonal_only: there is none, the closest point is given).
    """,
)
FootType = _enumeration(
    "FootType",
    """Where a foot lies, the numbers of `foot_type`.

    INTERIOR (orthogonal), EDGE (boundary), VERTEX (corner or end of a curve), KINK (C0 line or
    point inside), DEGENERATE (pole or collapsed edge).
    """,
)


@dataclass(frozen=True, eq=False, repr=False)
class Feet:
    """Foot points, a row for each. An array is None where the geometry has no such thing or its
    generate_... option is off. Feet that do not exist (status 3 and 4) have NaN, integers -1.
    """

    #: (m, 2) (u, v) in the geometry's own domain, v = 0 on curves; (m, 1) in models of curves alone
    parameters: Optional[np.ndarray]
    #: (m, 3) the foot points, model units
    closest_points: Optional[np.ndarray]
    #: (m,) distance from point to foot, model units, never negative
    distance: Optional[np.ndarray]
    #: (m,) the same, positive on the side of the normal; NaN on curves, None without surfaces
    signed_distance: Optional[np.ndarray]
    #: (m, 3) unit surface normals at the feet; NaN on curves, None without surfaces
    normals: Optional[np.ndarray]
    #: (m, 3) unit tangents of curves at the feet; NaN on surfaces, None without curves
    tangents: Optional[np.ndarray]
    #: (m,) see `Status`
    status: Optional[np.ndarray]
    #: (m,) see `FootType`
    foot_type: Optional[np.ndarray]
    #: (m,) 0 where a continuum of points is equally near (the axis of a cylinder), else 1
    isolated: Optional[np.ndarray]
    #: (m,) of the local solver
    iterations: Optional[np.ndarray]
    #: (m,) the face of the foot, counted from 0
    face: Optional[np.ndarray]

    def __repr__(self):
        arrays = [f.name for f in fields(Feet) if getattr(self, f.name) is not None]
        count = len(getattr(self, arrays[0])) if arrays else 0
        text = f"{count} feet: {', '.join(arrays)}"
        if self.status is not None:
            numbers = [f"{np.sum(self.status == s)} {s.name}" for s in Status if s in self.status]
            text += "; status " + (", ".join(numbers) or "none")
        return f"<{type(self).__name__} of {text}>"


@dataclass(frozen=True, eq=False, repr=False)
class TaggedFeet(Feet):
    """Several feet a point, the points in order, the feet of each nearest first."""

    #: (k,) row of `points` that each foot belongs to
    point: np.ndarray


@dataclass(frozen=True, eq=False, repr=False)
class InversionResult(Feet):
    """What `invert` returns: the nearest foot of every point, row i for points[i], and more."""

    #: statistics of signed_distance (of distance in models of curves alone) in model units: count,
    #: minimum, maximum, mean, rms, standard_deviation, percentile95 (of the absolute distance),
    #: status_counts (6,), out_of_tolerance_fraction (of count); open_edges, the number of borders of
    #: faces without a neighbour (0: closed)
    statistics: dict
    #: a row for each face: face_id, name, count, minimum, maximum, maximum_absolute, mean, rms,
    #: standard_deviation, percentile95, out_of_tolerance_fraction, tolerance, largest_gap
    face_statistics: dict
    #: every foot, with all_feet=True or a fixed_direction; else None
    all_feet: Optional[TaggedFeet]
    #: the filter's second output: the feet as vertices (or segments) with the arrays
    foot_points: vtkPolyData


def invert(points, geometry, *, seed_parameters=None, seed_face_id=None, **options):
    """Foot points (nearest points) of given points on exact spline geometry, with parameters.

    Parameters
    ----------
    points : (m, 3) or (m, 2) array
        Query points in model units; z = 0 where there are two columns. float32 and float64 are
        taken without a copy; computation and results are float64. NaN and infinite points get
        status 4 and disturb no other.
    geometry
        VTK data: a surface or curve (see `nurbs_surface`, `nurbs_curve`), Bézier cells in a
        vtkUnstructuredGrid, or a composite data set of those; or an algorithm that makes it; or a
        list of faces, numbered in order; or a vtkParametricFunction.
    seed_parameters : (m, 2) or, for curves, (m, 1) or (m,) array, optional
        Starting parameters of each point, tried besides those of the search (with search="Local"
        instead of them). NaN: automatic. The certified nearest point of search="Global" depends on
        no start. Not together with warm_start.
    seed_face_id : (m,) array of integers or one integer, optional
        Face that seed_parameters belongs to; without it or at -1 every face is tried.

    Options
    -------
    The filter's own, a keyword for each. An enumeration is given by name or number. Lengths called
    "relative" are fractions of the geometry's size, the diagonal of its control points' bounding
    box: the same numbers do for a screw and for a ship.

    search : Global, Seeded or Local, default Global
        How the foot is sought: in every piece of the geometry that may hold a nearer point, by
        descents from the best samples of a coarse grid, or by one descent. Global proves that the
        foot is the nearest point of splines (status 0). It has starts and steps of its own: method,
        trust_radius and seeds act only in the other searches, on parametric functions, and with
        all_feet, orthogonal_only and fixed_direction.
    method : Newton, GaussNewton, LevenbergMarquardt, SecondOrder, default Newton
        Step of the local solver; on curves also FirstOrder, CurvatureCircle, SecondOrder1,
        SecondOrder2, SecondOrder3. Newton converges quadratically also far from the geometry. Does
        not act on the plain nearest point of search="Global".
    point_tolerance : float, default 1e-14
        Relative distance below which a point lies on the geometry; ten times the rounding.
    cosine_tolerance : float, default 1e-12
        Cosine between P - Q and the tangents below which a foot is orthogonal; the error of the
        distance goes with its square.
    step_tolerance : float, default 1e-15
        Relative length of a step that ends the iteration.
    maximum_iterations : int, default 100
        Of a local search; ten are usual. Acts as method does, and on feet at borders, kinks, poles.
    trust_radius : float, default 0.5
        Longest step, relative. Acts as maximum_iterations does.
    column_scaling : bool, default True
        Normalise the columns of the Jacobian, for speeds that differ by powers of ten.
    isocurve_fallback : bool, default True
        Surfaces: steps along u, then v, where the step in both is rejected.
    seed_resolution : int, default 7
        Seeded and Local: samples in each direction of the coarse grid.
    number_of_seeds : int, default 4
        Seeded: samples of the grid that are descended from.
    certificate_tolerance : float, default 1e-12
        What status 0 proves, relative: no point is nearer than distance - certificate_tolerance *
        size. With 0 none is certified; the feet are the same to rounding, and take longer, since
        further descents are tried where nothing is proved. Global only.
    maximum_distance : float, default 1e299
        Points farther away get status 3, in model units. The default means no limit, as does inf.
    orthogonal_only : bool, default False
        The nearest foot where P - Q is orthogonal to the geometry, be it a minimum or not.
    all_feet : bool, default False
        Every local minimum of the distance, in `all_feet` of the result.
    fixed_direction : 3 floats, default (0, 0, 0)
        If not zero: where the line through P along this vector meets the geometry. Distances are
        measured along the line; all intersections are in `all_feet` of the result. A line that meets
        nothing has status 3. Not together with all_feet or orthogonal_only.
    warm_start : bool, default False
        Start each point from the foot of the one before, for points along a path. The only mode in
        which the order of points counts. Acts in the searches Seeded and Local; not together with
        seed_parameters, all_feet or fixed_direction.
    flip_normals : bool, default False
        Reverse the normals of surfaces, and with them the sign of signed_distance.
    deviation_tolerance : float, default 1e299
        Absolute distance above which a point counts in out_of_tolerance_fraction.
    foot_segments : bool, default False
        Segments from point to foot in `foot_points` of the result instead of vertices.
    array_name_prefix : str, default ''
        Before the names of the arrays in `foot_points` of the result.
    generate_... : bool, default True
        A switch for each array, which is None when off: generate_parameters, generate_distance,
        generate_signed_distance, generate_closest_point, generate_normal, generate_tangent,
        generate_face_id, generate_status, generate_foot_type, generate_isolated,
        generate_iterations.

    Returns
    -------
    InversionResult
        Row i of its arrays belongs to points[i]; see `Feet` for them, and `Status`, `FootType`.

    Raises
    ------
    ValueError
        Bad geometry, in the filter's words: array, index and value are named. Also a shape that
        does not fit and a value out of an option's range.
    TypeError
        An unknown option, an option's value or a geometry of the wrong type.

    Where a model has good faces besides bad ones, the bad ones are left out with a RuntimeWarning.
    """
    inverter = vtkPointInversionFilter()
    set_options(inverter, options, "invert")
    if inverter.GetWarmStart() and seed_parameters is not None:
        raise ValueError(
            "warm_start takes no seed_parameters: each point starts from the foot of the one before"
        )
    inverter.SetInputData(_point_data(points, seed_parameters, seed_face_id))
    set_geometry(inverter, geometry)
    run(inverter)

    prefix = inverter.GetArrayNamePrefix() or ""
    output = inverter.GetOutputDataObject(0)
    foot_points = inverter.GetFootPointsOutput()
    several = inverter.GetAllFeet() or any(inverter.GetFixedDirection())
    return InversionResult(
        **_arrays(output.GetPointData(), prefix),
        statistics=_statistics(output.GetFieldData(), prefix),
        face_statistics=_columns(inverter.GetFaceStatisticsOutput()),
        all_feet=_all_feet(foot_points, prefix, inverter.GetFootSegments()) if several else None,
        foot_points=foot_points,
    )


#: Fields of Feet whose arrays have another name than the field in CamelCase.
_ARRAYS = {
    "closest_points": "ClosestPoint",
    "normals": "Normal",
    "tangents": "Tangent",
    "face": "FaceId",
}


def _point_data(points, seed_parameters, seed_face_id):
    points = as_numbers(points, "points")
    if points.shape == (0,):
        points = points.reshape(0, 3)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"points has shape {points.shape}; (m, 3) or (m, 2) is needed")
    if points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    data = vtkPolyData()
    coordinates = vtkPoints()
    coordinates.SetData(to_vtk(points))
    data.SetPoints(coordinates)

    if seed_parameters is not None:
        seeds = as_numbers(seed_parameters, "seed_parameters")
        seeds = seeds[:, None] if seeds.ndim == 1 else seeds
        if seeds.ndim != 2 or seeds.shape[1] not in (1, 2) or len(seeds) != len(points):
            raise ValueError(
                f"seed_parameters has shape {seeds.shape}; ({len(points)}, 2) is needed, or "
                f"({len(points)}, 1) for curves"
            )
        data.GetPointData().AddArray(to_vtk(seeds, "SeedParameters"))
    elif seed_face_id is not None:
        raise ValueError("seed_face_id says nothing without seed_parameters")
    if seed_face_id is not None:
        faces = as_integers(seed_face_id, "seed_face_id", len(points))
        data.GetPointData().AddArray(to_vtk(faces, "SeedFaceId"))
    return data


def _arrays(attributes, prefix, rows=slice(None)):
    """Keyword arguments for Feet."""
    result = {}
    for field in fields(Feet):
        name = _ARRAYS.get(field.name, field.name.title().replace("_", ""))
        array = to_numpy(attributes, prefix + name)
        result[field.name] = None if array is None else array[rows]
    if result["parameters"] is not None and result["parameters"].ndim == 1:
        result["parameters"] = result["parameters"][:, None]
    return result


def _all_feet(foot_points, prefix, segments):
    rows = slice(1, None, 2) if segments else slice(None)  # a segment's end is the foot
    attributes = foot_points.GetPointData()
    point = to_numpy(attributes, prefix + "PointId")[rows]
    return TaggedFeet(**_arrays(attributes, prefix, rows), point=point)


def _statistics(data, prefix):
    result = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        name = array.GetName()[len(prefix):]
        values = vtk_to_numpy(array)
        key = snake_case(name[len("Distance"):] if name.startswith("Distance") else name)
        result[key] = values.copy() if len(values) > 1 else values[0].item()
    return result


def _columns(table):
    """The columns of a table as arrays, texts as a list."""
    result = {}
    for i in range(table.GetNumberOfColumns()):
        column = table.GetColumn(i)
        if column.IsNumeric():
            values = vtk_to_numpy(column)
        else:
            values = [column.GetValue(row) for row in range(column.GetNumberOfValues())]
        result[snake_case(column.GetName())] = values
    return result
