# SPDX-License-Identifier: BSD-3-Clause
"""Data/blade.vts and scan.vtp are what Data/make_blade.py makes, and what its formulas describe."""

import pathlib
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLStructuredGridReader

DATA = pathlib.Path(__file__).resolve().parents[2] / "Data"
sys.path.insert(0, str(DATA))
import make_blade

reader = vtkXMLStructuredGridReader()
reader.SetFileName(str(DATA / "blade.vts"))
reader.Update()
stored = reader.GetOutput()
net, knots_u, knots_v = make_blade.blade_net()


def check(condition, message):
    if not condition:
        sys.exit(f"TestData: {message}")


# === The files
check(stored.GetDimensions() == net.shape[:2] + (1,), f"dimensions {stored.GetDimensions()}")
stored_net = vtk_to_numpy(stored.GetPoints().GetData()).reshape(net.shape[1], net.shape[0], 3)
error = np.abs(stored_net.transpose(1, 0, 2) - net).max()
check(error < 1e-10, f"a control point differs by {error} mm; run Data/make_blade.py")
field = stored.GetFieldData()
for name, knots in (("KnotsU", knots_u), ("KnotsV", knots_v)):
    error = np.abs(vtk_to_numpy(field.GetArray(name)) - knots).max()
    check(error < 1e-14, f"a knot of {name} differs by {error}")
check(list(vtk_to_numpy(field.GetArray("Degree"))) == [3, 3], "Degree is not 3, 3")
check(field.GetAbstractArray("LengthUnit").GetValue(0) == "mm", "LengthUnit is not mm")
reader = vtkXMLPolyDataReader()
reader.SetFileName(str(DATA / "scan.vtp"))
reader.Update()
error = np.abs(vtk_to_numpy(reader.GetOutput().GetPoints().GetData()) - make_blade.scan_points())
check(error.max() < 1e-4, f"a point of the scan differs by {error.max()} mm")

# === The shape: within 0.3 µm of the closed form, closed, normals outwards
random = np.random.default_rng(1)
u, v = random.random(5000), random.random(5000)
basis_u = make_blade.collocation_matrix(knots_u, u)
basis_v = make_blade.collocation_matrix(knots_v, v)
surface = np.einsum("mi,mj,ijk->mk", basis_u, basis_v, net)
error = np.linalg.norm(surface - make_blade.blade_point(u, v), axis=1).max()
check(error < 3e-4, f"{error} mm from the closed form")
check(np.array_equal(net[0], net[-1]), "not closed around the section")
step = 1e-6
suction, pressure = np.full(9, 0.3), np.full(9, 0.7)
heights = np.linspace(0.05, 0.95, 9)
for u, other in ((suction, pressure), (pressure, suction)):
    here = make_blade.blade_point(u, heights)
    normal = np.cross(make_blade.blade_point(u + step, heights) - here,
                      make_blade.blade_point(u, heights + step) - here)
    across = here - make_blade.blade_point(other, heights)
    check((np.einsum("ij,ij->i", normal, across) > 0.0).all(), "a normal points inwards")
print("TestData: blade.vts and scan.vtp are as made")
