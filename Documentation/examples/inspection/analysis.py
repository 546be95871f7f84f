# SPDX-License-Identifier: BSD-3-Clause
"""What an inspector asks of signed distances: outliers, regions out of tolerance, statistics."""

from dataclasses import dataclass, field

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersPoints import vtkConnectedPointsFilter, vtkRadiusOutlierRemoval

NEIGHBOURHOOD = 3.0  # radius, times the mean distance between points: about 28 neighbours
NEIGHBOURS = 4  # that have to agree with a point
AGREEMENT = 8.0  # times the noise: how far neighbours' deviations may differ
SMALLEST_REGION = 30  # points
PEAK = 0.02  # the part of a region that its height and place are taken from
MOVED = 0.25  # a region is moved, not dented, if a motion leaves at most this part of its deviation


@dataclass
class Motion:
    """The rigid motion that explains the deviations of a region best."""

    shift: np.ndarray  # (3,) at the region's position
    tilt: float  # degrees
    explains: bool  # whether it leaves little


@dataclass
class Region:
    """Points out of tolerance that hang together."""

    position: np.ndarray  # (3,) on the nominal part, where the deviation is largest
    normal: np.ndarray  # (3,) there
    height: float  # deviation there, negative inwards
    points: int
    faces: list  # number of the face there, then of at most two others with most of its points
    motion: Motion


@dataclass
class Inspection:
    points: np.ndarray  # (m, 3)
    result: object  # of footpoint.invert
    tolerance: float
    noise: float  # standard deviation, robust
    outliers: np.ndarray  # (m,) bool, points that their neighbours do not agree with
    regions: list = field(default_factory=list)  # out of tolerance, the highest first

    @property
    def good(self):
        """(m,) bool: points that have a foot and are no outliers."""
        return np.isfinite(self.result.signed_distance) & ~self.outliers


def point_data(points, **arrays):
    """(m, 3) points as vtkPolyData, with point arrays."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    for name, array in arrays.items():
        column = numpy_to_vtk(np.ascontiguousarray(array), deep=True)
        column.SetName(name)
        data.GetPointData().AddArray(column)
    return data


def lonely(positions, radius):
    """(m,) bool: points with less than NEIGHBOURS others in a radius."""
    removal = vtkRadiusOutlierRemoval()
    removal.SetInputData(point_data(positions, Row=np.arange(len(positions))))
    removal.SetRadius(radius)
    removal.SetNumberOfNeighbors(NEIGHBOURS)
    removal.GenerateOutliersOn()
    removal.Update()
    found = np.zeros(len(positions), dtype=bool)
    rows = removal.GetOutput(1).GetPointData().GetArray("Row")
    if rows is not None and rows.GetNumberOfTuples() > 0:
        found[vtk_to_numpy(rows)] = True
    return found


def connected(positions, radius):
    """(m,) numbers of the groups in which points are nearer to each other than a radius."""
    groups = vtkConnectedPointsFilter()
    groups.SetInputData(point_data(positions, Row=np.arange(len(positions))))
    groups.SetRadius(radius)
    groups.SetExtractionModeToAllRegions()
    groups.Update()
    data = groups.GetOutput().GetPointData()
    labels = np.empty(len(positions), dtype=int)
    labels[vtk_to_numpy(data.GetArray("Row"))] = vtk_to_numpy(data.GetArray("RegionLabels"))
    return labels


def inspect(points, result, tolerance, area):
    """Divides points that are out of tolerance into outliers and regions.

    points: (m, 3); result: of footpoint.invert; area: of the part. Returns an Inspection.
    """
    distances, feet = result.signed_distance, result.closest_points
    found = np.isfinite(distances)
    noise = 1.4826 * np.median(np.abs(distances[found] - np.median(distances[found])))
    radius = NEIGHBOURHOOD * np.sqrt(area / max(found.sum(), 1))
    inspection = Inspection(points, result, tolerance, noise, np.zeros(len(points), dtype=bool))

    # Deviations drawn so large that points which do not agree are a radius apart.
    agreement = AGREEMENT * max(noise, 1e-3 * tolerance)
    drawn = feet[found] + (radius / agreement * distances[found])[:, None] * result.normals[found]
    inspection.outliers[found] = lonely(drawn, radius) & (np.abs(distances[found]) > tolerance)
    # Drawn so, a far point may come to lie on another side of the part: again without good points.
    beyond = np.abs(distances[found]) > tolerance
    far = np.abs(distances[found][beyond]) > tolerance + agreement
    inspection.outliers[np.flatnonzero(found)[beyond]] |= lonely(drawn[beyond], radius) & far

    for sign in (-1.0, 1.0):
        beyond = np.flatnonzero(inspection.good & (sign * distances > tolerance))
        if len(beyond) < SMALLEST_REGION:
            continue
        labels = connected(feet[beyond], radius)
        for label in np.flatnonzero(np.bincount(labels) >= SMALLEST_REGION):
            inspection.regions.append(measure(inspection, beyond[labels == label]))
    inspection.regions.sort(key=lambda region: -abs(region.height))
    return inspection


def measure(inspection, rows):
    """The Region of those points."""
    result = inspection.result
    distances, feet = result.signed_distance, result.closest_points
    highest = rows[np.argsort(-np.abs(distances[rows]))][:max(10, round(PEAK * len(rows)))]
    centre = np.median(feet[highest], axis=0)
    peak = highest[np.linalg.norm(feet[highest] - centre, axis=1).argmin()]
    faces, counts = np.unique(result.face[rows], return_counts=True)
    others = [face for face in faces[np.argsort(-counts)] if face != result.face[peak]]
    return Region(
        feet[peak], result.normals[peak], np.median(distances[highest]), len(rows),
        [int(face) for face in (result.face[peak], *others[:2])],
        fit_motion(result.normals[rows], feet[rows] - feet[peak], distances[rows]))


def fit_motion(normals, offsets, deviations):
    """The Motion of points of a region by least squares: N · (shift + turn × offset) = deviation.

    normals, offsets from the region's position: (k, 3); deviations: (k,).
    """
    radius = np.linalg.norm(offsets, axis=1).max()
    terms = np.hstack([normals, np.cross(offsets / radius, normals)])
    motion = np.linalg.lstsq(terms, deviations, rcond=1e-3)[0]
    left = deviations - terms @ motion
    explains = np.sqrt(np.mean(left**2)) < MOVED * np.sqrt(np.mean(deviations**2))
    return Motion(motion[:3], np.degrees(np.linalg.norm(motion[3:]) / radius), bool(explains))


def statistics(distances, tolerance):
    """Figures of signed distances, named like those of footpoint.invert."""
    magnitude = np.sort(np.abs(distances))
    return {
        "count": len(distances),
        "minimum": distances.min(),
        "maximum": distances.max(),
        "mean": distances.mean(),
        "rms": np.sqrt(np.mean(distances**2)),
        "standard_deviation": distances.std(),
        "percentile95": magnitude[int(np.ceil(0.95 * len(magnitude))) - 1],  # nearest rank
        "out_of_tolerance_fraction": np.mean(magnitude > tolerance),
    }


def face_rows(inspection, number_of_faces):
    """Statistics of the good points of every face, None for faces without any."""
    distances = inspection.result.signed_distance[inspection.good]
    faces = inspection.result.face[inspection.good]
    order = np.argsort(faces, kind="stable")
    limits = np.searchsorted(faces[order], np.arange(number_of_faces + 1))
    return [statistics(distances[order[a:b]], inspection.tolerance) if b > a else None
            for a, b in zip(limits[:-1], limits[1:])]
