# SPDX-License-Identifier: BSD-3-Clause
"""Splines as Bézier cells from Python: what goes in, what comes out, what is refused."""

import unittest
import warnings

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonDataModel import VTK_BEZIER_CURVE, VTK_BEZIER_QUADRILATERAL

import shapes


class BezierCells(unittest.TestCase):
    def test_sphere(self):
        sphere = shapes.sphere()
        cells = footpoint.bezier_cells(sphere)
        kinds = {cells.GetCellType(i) for i in range(cells.GetNumberOfCells())}
        self.assertEqual(kinds, {VTK_BEZIER_QUADRILATERAL})
        points = np.random.default_rng(5).normal(size=(200, 3))
        r = footpoint.invert(points, cells)
        np.testing.assert_allclose(
            r.signed_distance, np.linalg.norm(points, axis=1) - 1, atol=1e-14)
        s = footpoint.invert(points, sphere)
        np.testing.assert_allclose(r.parameters, s.parameters, atol=1e-12)
        np.testing.assert_array_equal(r.status, s.status)

    def test_model_and_algorithm(self):
        line = footpoint.nurbs_curve([[0, 0, 5], [1, 0, 5]], [0, 0, 2, 2])
        cells = footpoint.bezier_cells([shapes.sphere(), None, line])
        self.assertEqual(cells.GetCellType(cells.GetNumberOfCells() - 1), VTK_BEZIER_CURVE)
        ids = vtk_to_numpy(cells.GetCellData().GetArray("FaceId"))
        self.assertEqual(set(ids), {0, 2})
        extraction = footpoint.vtkBezierExtraction()
        extraction.SetInputData(shapes.sphere())
        r = footpoint.invert([[0.0, 0.0, 3.0]], extraction)
        self.assertAlmostEqual(r.distance[0], 2.0, places=14)
        self.assertEqual(footpoint.bezier_cells(extraction).GetNumberOfCells(),
                         footpoint.bezier_cells(shapes.sphere()).GetNumberOfCells())

    def test_trims(self):
        square = footpoint.nurbs_surface(
            [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]], [0, 0, 1, 1], [0, 0, 1, 1])
        face = footpoint.trimmed_face(square, [np.array([(0, 0), (1, 0), (0, 1)])])
        with self.assertWarnsRegex(RuntimeWarning, "whole surfaces were extracted of: Face 0"):
            self.assertEqual(footpoint.bezier_cells(face).GetNumberOfCells(), 1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            cells = footpoint.bezier_cells([square, face], skip_trimmed_faces=True)
        self.assertEqual(cells.GetNumberOfCells(), 1)
        with self.assertRaisesRegex(ValueError, "all are trimmed and left out"):
            footpoint.bezier_cells(face, skip_trimmed_faces=True)

    def test_refusals(self):
        net = shapes.sphere()
        net.GetFieldData().GetArray("KnotsU").SetTuple1(3, -1.0)
        with self.assertRaisesRegex(ValueError, r"Face 0: KnotsU\[3\]"):
            footpoint.bezier_cells(net)
        with self.assertRaisesRegex(TypeError, "vtkParametricTorus"):
            footpoint.bezier_cells(vtkParametricTorus())
        with self.assertRaisesRegex(TypeError, "no option 'trimmed'"):
            footpoint.bezier_cells(shapes.sphere(), trimmed=True)


if __name__ == "__main__":
    unittest.main()
