# SPDX-License-Identifier: BSD-3-Clause
"""The results of an inspection as files for other programs, and as figures."""

import csv

import footpoint
import numpy as np
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from .analysis import face_rows, point_data, statistics

STATE = '''\
"""Opens an inspection in ParaView: File > Load State, or pvpython. The .vtp files lie beside it."""

import pathlib

from paraview import simple

folder = pathlib.Path(__file__).resolve().parent
files = [str(folder / name) for name in ("part.vtp", "deviation.vtp")]
part = simple.XMLPolyDataReader(registrationName="part", FileName=files[:1])
scan = simple.XMLPolyDataReader(registrationName="deviation", FileName=files[1:])
good = simple.Threshold(registrationName="without outliers", Input=scan)
good.Scalars = ["POINTS", "Outlier"]
good.LowerThreshold, good.UpperThreshold = 0.0, 0.0

view = simple.GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
nominal = simple.Show(part, view)
nominal.ColorArrayName = [None, ""]
nominal.AmbientColor = nominal.DiffuseColor = [0.96, 0.90, 0.62]
points = simple.Show(good, view)
points.SetRepresentationType("Surface")
points.PointSize = 4.0
points.Ambient, points.Diffuse = 0.45, 0.6
simple.ColorBy(points, ("POINTS", "SignedDistance"))
colours = simple.GetColorTransferFunction("SignedDistance")
colours.ColorSpace = "Diverging"
colours.RGBPoints = [
    {low}, 0.085, 0.245, 0.700, 0.0, 0.865, 0.865, 0.865, {high}, 0.720, 0.040, 0.120]
legend = simple.GetScalarBar(colours, view)
legend.Title, legend.ComponentTitle = "Deviation [{unit}]", ""
legend.LabelFormat = legend.RangeLabelFormat = "%+.3g"
legend.TitleColor = legend.LabelColor = [0.1, 0.1, 0.1]
points.SetScalarBarVisibility(view, True)
view.CameraPosition, view.CameraFocalPoint = {position}, {middle}
view.CameraViewUp = [0.0, 0.0, 1.0]
view.ResetCamera(True)
simple.SetActiveSource(good)
simple.Render(view)
'''


def write_vtp(path, data):
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    writer.Write()


def as_vertices(data):
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    vertices.Update()
    return vertices.GetOutput()


def write_scan(path, points):
    """Points as .ply, which keeps seven digits."""
    writer = vtkPLYWriter()
    writer.SetInputData(as_vertices(point_data(points)))
    writer.SetFileName(str(path))
    writer.Write()


def point_arrays(inspection):
    """The filter's arrays by name, and `Outlier`."""
    result = inspection.result
    return {
        "SignedDistance": result.signed_distance, "Distance": result.distance,
        "Parameters": result.parameters, "ClosestPoint": result.closest_points,
        "Normal": result.normals, "FaceId": result.face, "Status": result.status,
        "FootType": result.foot_type, "Isolated": result.isolated,
        "Iterations": result.iterations, "Outlier": inspection.outliers.astype(np.int32)}


def write_points(path, inspection):
    """The scanned points as vertices, with all arrays."""
    data = as_vertices(point_data(inspection.points, **point_arrays(inspection)))
    data.GetPointData().SetActiveScalars("SignedDistance")
    data.GetPointData().SetActiveNormals("Normal")
    write_vtp(path, data)


def write_points_csv(path, inspection):
    """A row for every point: coordinates and all arrays."""
    columns = {"Points": inspection.points, **point_arrays(inspection)}
    names, numbers = [], []
    for name, array in columns.items():
        parts = array.reshape(len(array), -1).T
        names += [name] if len(parts) == 1 else [f"{name}:{i}" for i in range(len(parts))]
        numbers += list(parts)
    with open(path, "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(names)
        rows.writerows(zip(*(column.tolist() for column in numbers)))


FACE_COLUMNS = ("count", "minimum", "maximum", "mean", "rms", "standard_deviation", "percentile95",
                "out_of_tolerance_fraction")


def write_faces_csv(path, part, inspection):
    """A row for every face, without outliers; faces without points have a count of 0 only."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["face_id", "name", *FACE_COLUMNS, "unit"])
        for face, row in enumerate(face_rows(inspection, len(part.names))):
            values = [row[key] for key in FACE_COLUMNS] if row else [0] + [""] * 7
            rows.writerow([face, part.names[face], *values, part.unit])


def write_state(path, part, lengths, eye):
    """A ParaView state in Python; eye: unit vector from the part to the camera."""
    middle = np.reshape(part.mesh.GetBounds(), (3, 2)).mean(axis=1)
    position = middle + 3.0 * part.size * eye
    path.write_text(STATE.format(
        low=-lengths.colour_limit, high=lengths.colour_limit, unit=lengths.unit,
        position=position.tolist(), middle=middle.tolist()), encoding="utf-8")


FIGURES = {  # of the statistics, in the order of tables: what they are called
    "count": "Points", "minimum": "Minimum", "maximum": "Maximum", "mean": "Mean", "rms": "RMS",
    "standard_deviation": "Standard deviation", "percentile95": "95% of points within",
    "out_of_tolerance_fraction": "Out of tolerance"}


def as_text(values, lengths):
    """The figures as strings, in order."""
    texts = {key: lengths.signed(values[key]) for key in ("minimum", "maximum", "mean")}
    texts |= {key: lengths.text(values[key]) for key in ("rms", "standard_deviation")}
    texts["count"] = f"{values['count']:,}"
    texts["percentile95"] = "\u00b1" + lengths.text(values["percentile95"])
    texts["out_of_tolerance_fraction"] = f"{values['out_of_tolerance_fraction']:.2%}"
    return [texts[key] for key in FIGURES]


def figures(inspection, lengths, seconds):
    """Rows for the picture's table: without the outliers, with proof and time."""
    result = inspection.result
    good = result.signed_distance[inspection.good]
    rows = list(zip(FIGURES.values(), as_text(statistics(good, inspection.tolerance), lengths)))
    rows[0] = ("Points without outliers", rows[0][1])
    certified = np.mean(result.status == footpoint.Status.CERTIFIED)
    rows.append(("Feet proved to be nearest", f"{100.0 * certified:.4g}%"))
    rows.append(("Time", f"{1e6 * seconds / len(good):.1f} \u00b5s a point"))
    return rows


def counts(values, names):
    """How often each value of an enumeration occurs."""
    return ", ".join(f"{np.sum(values == value):,} {value.name.lower().replace('_', ' ')}"
                     for value in names if (values == value).any())
