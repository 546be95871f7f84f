# SPDX-License-Identifier: BSD-3-Clause
"""The results of an inspection as a .vtp file, as figures and as a report."""

import os
import platform

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from .analysis import statistics
from .drawing import signed
from .scan import DENT_DEPTH, NOISE


def point_data(points):
    """(m, 3) points as vtkPolyData."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    return data


def write_points(path, inspection):
    """The points as vertices, with the filter's arrays and `Outlier`."""
    result = inspection.result
    data = point_data(inspection.points)
    for name, array in {
        "SignedDistance": result.signed_distance, "Distance": result.distance,
        "Parameters": result.parameters, "ClosestPoint": result.closest_points,
        "Normal": result.normals, "FaceId": result.face, "Status": result.status,
        "FootType": result.foot_type, "Isolated": result.isolated,
        "Iterations": result.iterations, "Outlier": inspection.outliers.astype(np.int32),
    }.items():
        column = numpy_to_vtk(array, deep=True)
        column.SetName(name)
        data.GetPointData().AddArray(column)
    data.GetPointData().SetActiveScalars("SignedDistance")
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(vertices.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()


def largest_gain_of_samples(surface, points, distances, number_of_points=1000):
    """Brute force: by how much samples of the surface are nearer to points than their feet, in mm.

    1.2 million samples; a part of the points. At most rounding where all feet are nearest points.
    """
    u, v = np.meshgrid(np.linspace(0.0, 1.0, 1500), np.linspace(0.0, 1.0, 800))
    samples = footpoint.evaluate(surface, np.column_stack([u.ravel(), v.ravel()]))
    locator = vtkStaticPointLocator()
    cloud = point_data(samples)
    locator.SetDataSet(cloud)
    locator.BuildLocator()
    tested = np.linspace(0, len(points) - 1, number_of_points).astype(int)
    nearest = samples[[locator.FindClosestPoint(points[i]) for i in tested]]
    return (distances[tested] - np.linalg.norm(points[tested] - nearest, axis=1)).max()


FIGURES = {  # of the statistics, in the order of tables: what they are called and how written
    "count": ("Points", "{:,}"),
    "minimum": ("Minimum", "{:+.4f} mm"),
    "maximum": ("Maximum", "{:+.4f} mm"),
    "mean": ("Mean", "{:+.4f} mm"),
    "rms": ("RMS", "{:.4f} mm"),
    "standard_deviation": ("Standard deviation", "{:.4f} mm"),
    "percentile95": ("95 % of points within", "\u00b1{:.4f} mm"),
    "out_of_tolerance_fraction": ("Out of tolerance", "{:.2%}"),
}


def as_text(values):
    """The figures as strings, in order."""
    return [pattern.format(values[key]).replace("-", "\u2212")
            for key, (_, pattern) in FIGURES.items()]


def figures(inspection):
    """Rows for the picture's table: without the outliers, with two percentiles more."""
    good = inspection.result.signed_distance[~inspection.outliers]
    names = [name for name, _ in FIGURES.values()]
    rows = list(zip(names, as_text(statistics(good, inspection.tolerance))))
    rows[0] = ("Points without outliers", rows[0][1])
    low, high = np.percentile(good, (5, 95))
    rows.insert(-2, ("Percentiles P5, P95", f"{signed(low, 4)}, {signed(high, 4)} mm"))
    return rows


def counts(values, names):
    """How often each value of an enumeration occurs."""
    return ", ".join(f"{np.sum(values == value):,} {value.name}" for value in names
                     if (values == value).any())


def coordinates(point):
    return ("(" + ", ".join(f"{x:.2f}" for x in point) + ") mm").replace("-", "\u2212")


def write_report(path, inspection, scan, seconds):
    """A short report in Markdown."""
    result, outliers, defect = inspection.result, inspection.outliers, inspection.defect
    good = statistics(result.signed_distance[~outliers], inspection.tolerance)
    columns = ([name for name, _ in FIGURES.values()], as_text(result.statistics), as_text(good))
    table = "\n".join("| " + " | ".join(row) + " |" for row in zip(*columns))
    tangential = np.sum(scan.is_outlier & (result.distance < inspection.tolerance))
    damage = "none" if defect is None else (
        f"{signed(defect.height, 4)} mm at {coordinates(defect.position)}, "
        f"{np.linalg.norm(defect.position - scan.dent_centre):.2f} mm from the injected one")
    path.write_text(f"""\
# Deviation report: blade

A simulated scan against the nominal surface. Lengths in mm; deviations are positive outside the
blade; tolerance ±{inspection.tolerance} mm. Points: `deviation.vtp`. Picture: `deviation.png`.

| Deviation | all points | without outliers |
|---|---|---|
{table}

| | found | injected |
|---|---|---|
| Damage | {damage} | {signed(-DENT_DEPTH, 4)} mm at {coordinates(scan.dent_centre)} |
| Outliers | {outliers.sum()}, {np.sum(outliers & ~scan.is_outlier)} of them wrongly | \
{scan.is_outlier.sum()}, {tangential} of them still within tolerance of the surface |

- Noise of the scan: standard deviation {NOISE} mm, along the normal.
- Status: {counts(result.status, footpoint.Status)}.
- Foot type: {counts(result.foot_type, footpoint.FootType)}.
- Brute force: for 1,000 points, the nearest of 1.2 million samples of the surface was never nearer
  than the foot.
- Time: {1e6 * seconds / len(result.status):.1f} µs a point, {seconds:.2f} s in all, on \
{os.cpu_count()} processors.
- Footpoint {footpoint.__version__}, VTK {vtkVersion.GetVTKVersion()}, \
Python {platform.python_version()}.
""", encoding="utf-8")
