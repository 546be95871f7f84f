# SPDX-License-Identifier: BSD-3-Clause
"""Makes blade.vts, a twisted, tapered blade as an exact bicubic B-spline, and scan.vtp, a few points
of it with noise; both in millimetres.

    /usr/bin/python3 Data/make_blade.py [folder, default: its own]

The sections are NACA 4-digit profiles in closed form (E. N. Jacobs, K. E. Ward, R. M. Pinkerton, NACA
Report 460, 1933), with the crest of the camber line at half the chord, so that it is one parabola,
and with the trailing edge closed (last thickness coefficient 0.1036 in place of 0.1015). Points of
the closed form are interpolated by a tensor-product B-spline; u goes around the section, from the
trailing edge over the suction side, the leading edge and the pressure side back to the trailing
edge; v goes from root to tip. S_u × S_v points out of the blade.
"""

import pathlib
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLStructuredGridWriter

DEGREE = 3
POINTS_U = 97  # around the section
POINTS_V = 29  # root to tip
SPAN = 150.0  # mm
THICKNESS = (0.2969, -0.1260, -0.3516, 0.2843, -0.1036)  # of sqrt(x), x, x², x³, x⁴, times 5 t


def blade_point(u, v):
    """The blade in closed form.

    u: (m,) in [0, 1] around the section; the leading edge is at 1/2
    v: (m,) in [0, 1] from root to tip
    Returns (m, 3) in mm: x along the engine's axis, z along the span.
    """
    chord = 62.0 - 20.0 * v
    thickness = 0.11 - 0.05 * v  # of the chord
    camber = 0.08 - 0.05 * v  # of the chord
    stagger = np.radians(20.0 + 38.0 * v - 4.0 * v * v)

    # The square root in x = w² makes the round nose an odd analytic function of w.
    w = 1.0 - 2.0 * u
    x = w * w
    c0, c1, c2, c3, c4 = THICKNESS
    half = 5.0 * thickness * w * (c0 + np.abs(w) * (c1 + x * (c2 + x * (c3 + x * c4))))
    slope = 4.0 * camber * (1.0 - 2.0 * x)
    cosine = 1.0 / np.sqrt(1.0 + slope * slope)
    along = x - half * slope * cosine
    across = 4.0 * camber * x * (1.0 - x) + half * cosine

    # Stacked on 40 % of the chord, with a little lean and sweep.
    along = (along - 0.4) * chord
    across = (across - 2.0 * camber * 0.48) * chord
    return np.column_stack([
        np.cos(stagger) * along - np.sin(stagger) * across + 6.0 * v * v,
        np.sin(stagger) * along + np.cos(stagger) * across - 5.0 * v * (1.0 - v),
        SPAN * v,
    ])


def averaged_knots(parameters):
    """Clamped knots for interpolation at given parameters (L. Piegl, W. Tiller 1997, eq. 9.8)."""
    inner = [parameters[i:i + DEGREE].mean() for i in range(1, len(parameters) - DEGREE)]
    return np.concatenate([np.zeros(DEGREE + 1), inner, np.ones(DEGREE + 1)])


def collocation_matrix(knots, parameters):
    """(m, n) values of the n basis functions at m parameters (Cox-de Boor recursion)."""
    last_span = len(knots) - DEGREE - 2
    span = np.clip(np.searchsorted(knots, parameters, side="right") - 1, DEGREE, last_span)
    basis = np.zeros((len(parameters), len(knots) - 1))
    basis[np.arange(len(parameters)), span] = 1.0
    for p in range(1, DEGREE + 1):
        count = len(knots) - 1 - p
        higher = np.zeros((len(parameters), count))
        for i in range(count):
            left, right = knots[i + p] - knots[i], knots[i + p + 1] - knots[i + 1]
            if left > 0.0:
                higher[:, i] += (parameters - knots[i]) / left * basis[:, i]
            if right > 0.0:
                higher[:, i] += (knots[i + p + 1] - parameters) / right * basis[:, i + 1]
        basis = higher
    return basis


def blade_net():
    """The blade as control points (nu, nv, 3), knots in u and knots in v."""
    u, v = np.linspace(0.0, 1.0, POINTS_U), np.linspace(0.0, 1.0, POINTS_V)
    knots_u, knots_v = averaged_knots(u), averaged_knots(v)
    uu, vv = np.meshgrid(u, v, indexing="ij")
    points = blade_point(uu.ravel(), vv.ravel()).reshape(POINTS_U, POINTS_V, 3)
    net = np.linalg.solve(collocation_matrix(knots_u, u), points.reshape(POINTS_U, -1))
    net = net.reshape(POINTS_U, POINTS_V, 3).transpose(1, 0, 2).reshape(POINTS_V, -1)
    net = np.linalg.solve(collocation_matrix(knots_v, v), net)
    net = net.reshape(POINTS_V, POINTS_U, 3).transpose(1, 0, 2)
    net[-1] = net[0]  # differ by rounding only: closed to the last bit
    return net, knots_u, knots_v


def spline_grid(net, knots_u, knots_v):
    """The same as a vtkStructuredGrid in the project's format."""
    grid = vtkStructuredGrid()
    grid.SetDimensions(net.shape[0], net.shape[1], 1)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(net.transpose(1, 0, 2).reshape(-1, 3), deep=True))  # u fastest
    grid.SetPoints(points)
    for name, knots in (("KnotsU", knots_u), ("KnotsV", knots_v)):
        array = numpy_to_vtk(knots, deep=True)
        array.SetName(name)
        grid.GetFieldData().AddArray(array)
    degree = vtkIntArray()
    degree.SetName("Degree")
    degree.InsertNextValue(DEGREE)
    degree.InsertNextValue(DEGREE)
    grid.GetFieldData().AddArray(degree)
    for name, text in (("FaceName", "blade"), ("LengthUnit", "mm")):
        array = vtkStringArray()
        array.SetName(name)
        array.InsertNextValue(text)
        grid.GetFieldData().AddArray(array)
    return grid


def scan_points(count=2000, noise=0.02):
    """(count, 3) float32 points of the closed form with normal noise in every coordinate, in mm."""
    random = np.random.default_rng(7)
    parameters = random.random((2, count))
    return (blade_point(*parameters) + random.normal(0.0, noise, (count, 3))).astype(np.float32)


def cloud(points):
    """Points as vtkPolyData vertices."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    vertices.Update()
    return vertices.GetOutput()


def write(writer, data, path):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    writer.SetDataModeToBinary()
    if writer.Write() != 1:
        sys.exit(f"cannot write {path}")


def main(folder):
    write(vtkXMLStructuredGridWriter(), spline_grid(*blade_net()), folder / "blade.vts")
    write(vtkXMLPolyDataWriter(), cloud(scan_points()), folder / "scan.vtp")
    print(f"{folder}: blade.vts, {POINTS_U} x {POINTS_V} control points; scan.vtp")


if __name__ == "__main__":
    main(pathlib.Path(__file__).resolve().parent if len(sys.argv) < 2 else pathlib.Path(sys.argv[1]))
