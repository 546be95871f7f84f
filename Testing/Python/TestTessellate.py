# SPDX-License-Identifier: BSD-3-Clause
"""tessellate() against closed forms, its options and errors, and on real solids."""

import os
from pathlib import Path
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFeatureEdges

import footpoint
from shapes import circle, sphere, square, torus

close = np.testing.assert_allclose


def points(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData())


def triangles(mesh):
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def array(mesh, name):
    return vtk_to_numpy(mesh.GetPointData().GetArray(name))


def open_edges(mesh):
    clean = vtkCleanPolyData()
    clean.SetInputData(mesh)
    clean.SetTolerance(0)
    edges = vtkFeatureEdges()
    edges.SetInputConnection(clean.GetOutputPort())
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


class ClosedForms(unittest.TestCase):
    def test_sphere(self):
        for tolerance in (1e-2, 1e-3):
            mesh = footpoint.tessellate(sphere(), chord_tolerance=tolerance)
            close(np.linalg.norm(points(mesh), axis=1), 1, rtol=1e-14)
            close(array(mesh, "Normals"), points(mesh), atol=1e-7)
            close(footpoint.evaluate(sphere(), array(mesh, "Parameters")), points(mesh), atol=1e-14)
            middles = points(mesh)[triangles(mesh)].mean(axis=1)
            self.assertLessEqual(1 - np.linalg.norm(middles, axis=1).min(), tolerance * 12**0.5)
            self.assertEqual(open_edges(mesh), 0)

    def test_torus(self):
        mesh = footpoint.tessellate(torus(), chord_tolerance=0.01, absolute_tolerance=True)
        x, y, z = points(mesh)[triangles(mesh)].mean(axis=1).T
        off = np.abs(np.hypot(np.hypot(x, y) - 3, z) - 1)
        self.assertLessEqual(off.max(), 0.01)
        self.assertEqual(open_edges(mesh), 0)

    def test_trimmed_face(self):
        hole = 0.5 + 0.25 * np.array([[0, 1], [1, 0], [0, -1], [-1, 0], [0, 1]])
        border = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]
        face = footpoint.trimmed_face(square(), [[border], [hole]])
        mesh = footpoint.tessellate(face)
        p = points(mesh)[triangles(mesh)]
        area = 0.5 * np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum()
        self.assertAlmostEqual(area, 1 - 0.125, places=12)

    def test_curve_and_model(self):
        mesh = footpoint.tessellate([circle(2), None, square()])
        self.assertEqual(mesh.GetNumberOfLines(), 1)
        faces = vtk_to_numpy(mesh.GetCellData().GetArray("FaceId"))
        self.assertEqual(list(faces), [0, 2, 2])
        alone = footpoint.tessellate(circle(2), mode="Fixed", resolution=5)
        self.assertEqual(alone.GetNumberOfPoints(), 21)
        self.assertIsNone(alone.GetPointData().GetArray("Normals"))


class Errors(unittest.TestCase):
    def test_options(self):
        with self.assertRaisesRegex(ValueError, "ChordTolerance = 0"):
            footpoint.tessellate(sphere(), chord_tolerance=0)
        with self.assertRaisesRegex(TypeError, "chord_tolerance"):
            footpoint.tessellate(sphere(), chord_tolerence=1)
        with self.assertRaisesRegex(TypeError, "geometry is a int"):
            footpoint.tessellate(5)

    def test_a_face_that_is_left_out(self):
        eight = footpoint.trimmed_face(square(1.0), [[[[0, 0], [1, 1], [1, 0], [0, 0.9], [0, 0]]]])
        with self.assertWarnsRegex(RuntimeWarning, "Face 1.*cross"):
            mesh = footpoint.tessellate([square(), eight])
        self.assertEqual(mesh.GetNumberOfPolys(), 2)


@unittest.skipUnless(hasattr(footpoint, "vtkCADReader"), "built without Open CASCADE")
class Solids(unittest.TestCase):
    def test_closed_solids_are_closed(self):
        folder = Path(os.environ.get("FOOTPOINT_SHARED_DATA", "")) / "cad"
        if not folder.is_absolute() or not folder.is_dir():
            self.skipTest("FOOTPOINT_SHARED_DATA has no folder cad")
        for name in ("nist_ctc_01.brep", "dm1-id-214.stp", "tigl_wing.igs"):
            model = footpoint.read_cad(folder / name)
            for tolerance in (3e-3, 1e-3, 3e-4):
                with self.subTest(file=name, tolerance=tolerance), warnings.catch_warnings():
                    warnings.simplefilter("error")
                    mesh = footpoint.tessellate(model, chord_tolerance=tolerance)
                    self.assertEqual(open_edges(mesh), 0)


if __name__ == "__main__":
    unittest.main()
