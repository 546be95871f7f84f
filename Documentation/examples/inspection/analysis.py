# SPDX-License-Identifier: BSD-3-Clause
"""What an inspector wants to know about signed distances on a surface: outliers, statistics, damage."""

from dataclasses import dataclass

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


def inspect(result, tolerance):
    """Divides the points that are out of tolerance into outliers and damage.

    result: of footpoint.invert; tolerance: mm.
    Returns (m,) bool, points that their neighbours do not agree with, and the Defect where
    neighbours agree on the largest distance, or None where all is in tolerance.
    """
    feet, distances = result.closest_points, result.signed_distance
    noise = 1.4826 * np.median(np.abs(distances - np.median(distances)))  # robust
    suspects = np.flatnonzero(np.abs(distances) > tolerance)
    medians = neighbours_medians(feet, distances, suspects)
    outliers = np.zeros(len(distances), dtype=bool)
    outliers[suspects] = np.abs(distances[suspects] - medians) > OUTLIER_LIMIT * noise

    agreed = np.where(outliers[suspects], 0.0, medians)
    if np.abs(agreed).max(initial=0.0) <= tolerance:
        return outliers, None
    worst = np.argmax(np.abs(agreed))
    return outliers, measure_defect(
        feet, np.where(outliers, 0.0, distances * np.sign(agreed[worst])), suspects[worst],
        np.sign(agreed[worst]), tolerance)


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
    """Names and values of the usual figures of signed distances in mm."""
    magnitude = np.sort(np.abs(distances))
    return {
        "Points": len(distances),
        "Minimum": distances.min(),
        "Maximum": distances.max(),
        "Mean": distances.mean(),
        "RMS": np.sqrt(np.mean(distances**2)),
        "Standard deviation": distances.std(),
        "95 % of |d| within": magnitude[int(np.ceil(0.95 * len(magnitude))) - 1],
        "Out of tolerance": np.mean(magnitude > tolerance),
    }
