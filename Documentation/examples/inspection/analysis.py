# SPDX-License-Identifier: BSD-3-Clause
"""What an inspector asks of signed distances on a surface: outliers, damage, statistics."""

from dataclasses import dataclass
from typing import Optional

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator

NEIGHBOURS = 25  # that have to agree with a point
OUTLIER_LIMIT = 8.0  # times the noise, away from the neighbours' median
DEFECT_RADIUS = 12.0  # mm, what counts as one defect
CORE_RADIUS = 3.0  # mm, where its height is measured


@dataclass
class Defect:
    position: np.ndarray  # (3,), mm, on the nominal surface
    height: float  # mm, negative for a dent
    points: int  # beyond the tolerance around it


@dataclass
class Inspection:
    points: np.ndarray  # (m, 3), mm
    result: object  # of footpoint.invert
    tolerance: float  # mm
    outliers: np.ndarray  # (m,) bool, points that their neighbours do not agree with
    defect: Optional[Defect]  # where neighbours agree on the largest deviation, if out of tolerance


def neighbours_medians(feet, distances, which):
    """The median distance of the nearest points around some of them.

    feet: (m, 3) foot points, distances: (m,), which: (k,) indices. Returns (k,).
    """
    points = vtkPoints()
    points.SetData(numpy_to_vtk(feet))
    cloud = vtkPolyData()
    cloud.SetPoints(points)
    locator = vtkStaticPointLocator()
    locator.SetDataSet(cloud)
    locator.BuildLocator()
    ids = vtkIdList()
    medians = np.empty(len(which))
    for i, point in enumerate(which):
        locator.FindClosestNPoints(NEIGHBOURS, feet[point], ids)
        medians[i] = np.median(distances[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]])
    return medians


def inspect(points, result, tolerance):
    """Divides the points that are out of tolerance into outliers and damage.

    points: (m, 3); result: of footpoint.invert; tolerance: mm. Returns an Inspection.
    """
    feet, distances = result.closest_points, result.signed_distance
    noise = 1.4826 * np.median(np.abs(distances - np.median(distances)))  # robust
    suspects = np.flatnonzero(np.abs(distances) > tolerance)
    medians = neighbours_medians(feet, distances, suspects)
    outliers = np.zeros(len(distances), dtype=bool)
    outliers[suspects] = np.abs(distances[suspects] - medians) > OUTLIER_LIMIT * noise

    agreed = np.where(outliers[suspects], 0.0, medians)
    worst = int(np.argmax(np.abs(agreed))) if len(agreed) else None
    if worst is None or abs(agreed[worst]) <= tolerance:
        return Inspection(points, result, tolerance, outliers, None)
    sign = np.sign(agreed[worst])
    heights = np.where(outliers, 0.0, sign * distances)
    defect = measure_defect(feet, heights, suspects[worst], sign, tolerance)
    return Inspection(points, result, tolerance, outliers, defect)


def measure_defect(feet, heights, start, sign, tolerance):
    """The Defect around a point; heights: (m,) mm, positive where damaged, 0 for outliers."""
    # The centre: mean of the feet out of tolerance around it, by their excess.
    position = feet[start]
    for _ in range(10):
        near = (heights > tolerance) & (np.linalg.norm(feet - position, axis=1) < DEFECT_RADIUS)
        position = np.average(feet[near], axis=0, weights=heights[near] - tolerance)

    # The height: of a paraboloid through the points of the core.
    radius = np.linalg.norm(feet - position, axis=1)
    core = (radius < CORE_RADIUS) & (heights > tolerance)
    terms = np.column_stack([np.ones(core.sum()), radius[core] ** 2])
    height = np.linalg.lstsq(terms, heights[core], rcond=None)[0][0]
    return Defect(position, sign * height, int(near.sum()))


def statistics(distances, tolerance):
    """Figures of signed distances in mm, named like those of footpoint.invert."""
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
