# SPDX-License-Identifier: BSD-3-Clause
"""nurbs_surface, nurbs_curve, trimmed_face and model: the VTK data they make, and what they refuse."""

from pathlib import Path
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataSetAttributes
from vtkmodules.vtkIOXML import (
    vtkXMLMultiBlockDataReader,
    vtkXMLMultiBlockDataWriter,
    vtkXMLStructuredGridReader,
    vtkXMLStructuredGridWriter,
)

import footpoint
from footpoint._pipeline import to_vtk
from shapes import OCTAGON, OCTAGON_WEIGHTS, QUARTERS, circle, sphere, square

equal = np.testing.assert_array_equal


def field(data, name):
    return vtk_to_numpy(data.GetFieldData().GetArray(name))


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


class Surfaces(unittest.TestCase):
    def setUp(self):
        generator = np.random.default_rng(5)
        self.points = generator.random((4, 3, 3))
        self.weights = generator.uniform(0.5, 2, (4, 3))
        self.knots_u, self.knots_v = [0, 0, 0, 0.5, 1, 1, 1], [0, 0, 1, 2, 2]

    def make(self, **changes):
        arguments = dict(control_points=self.points, knots_u=self.knots_u, knots_v=self.knots_v,
                         weights=self.weights)
        return footpoint.nurbs_surface(**{**arguments, **changes})

    def test_layout(self):
        net = self.make()
        self.assertEqual(net.GetClassName(), "vtkStructuredGrid")
        self.assertEqual(net.GetDimensions(), (4, 3, 1))
        for i in range(4):
            for j in range(3):
                equal(net.GetPoint(i + 4 * j), self.points[i, j], f"({i}, {j})")
                weights = net.GetPointData().GetArray("RationalWeights")
                self.assertEqual(weights.GetValue(i + 4 * j), self.weights[i, j])
        equal(field(net, "KnotsU"), self.knots_u)
        equal(field(net, "KnotsV"), self.knots_v)
        equal(field(net, "Degree"), [2, 1])
        self.assertEqual(field(net, "Degree").dtype, np.int32)
        active = net.GetPointData().GetAttribute(vtkDataSetAttributes.RATIONALWEIGHTS)
        self.assertEqual(active.GetName(), "RationalWeights")

    def test_values_are_copied(self):
        net, before = self.make(), self.points.copy()
        self.points[:] = 0
        self.weights[:] = 7
        equal(net.GetPoint(1 + 4 * 2), before[1, 2])
        self.assertNotEqual(net.GetPointData().GetArray("RationalWeights").GetValue(0), 7)

    def test_types(self):
        self.assertIsNone(self.make(weights=None).GetPointData().GetArray("RationalWeights"))
        equal(points_of(self.make(control_points=self.points.tolist())), points_of(self.make()))
        equal(points_of(self.make(control_points=np.asfortranarray(self.points))),
              points_of(self.make()))
        single = self.make(control_points=self.points.astype(np.float32))
        np.testing.assert_allclose(points_of(single), points_of(self.make()), rtol=1e-6)
        integers = self.make(control_points=np.arange(36).reshape(4, 3, 3) ** 2)
        equal(integers.GetPoint(1), [81, 100, 121])

    def test_wrong_shapes(self):
        for changes, text in (
            ({"control_points": self.points[0]}, r"control_points has shape \(3, 3\); \(nu, nv, 3\)"),
            ({"control_points": self.points[..., :2]}, r"\(4, 3, 2\)"),
            ({"control_points": self.points[:, :1]}, "two rows in v"),
            ({"control_points": "abc"}, "control_points is no array of real numbers"),
            ({"knots_u": [0, 0, 0.5, 1]}, r"knots_u has shape \(4,\).* at least \(6,\)"),
            ({"knots_v": [[0, 0, 1, 2, 2]]}, r"knots_v has shape \(1, 5\)"),
            ({"weights": self.weights.T}, r"weights has shape \(3, 4\); \(4, 3\) is needed"),
            ({"weights": np.ones(12)}, r"weights has shape \(12,\)"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                self.make(**changes)

    def test_file(self):
        """Through VTK's own writer and reader: knots to the bit, weights, the same feet."""
        net, queries = self.make(), np.random.default_rng(6).random((20, 3))
        with tempfile.TemporaryDirectory() as folder:
            path = str(Path(folder) / "net.vts")
            writer = vtkXMLStructuredGridWriter()
            writer.SetFileName(path)
            writer.SetInputData(net)
            self.assertEqual(writer.Write(), 1)
            reader = vtkXMLStructuredGridReader()
            reader.SetFileName(path)
            reader.Update()
        equal(field(reader.GetOutput(), "KnotsU"), self.knots_u)
        r, expected = footpoint.invert(queries, reader), footpoint.invert(queries, net)
        equal(r.parameters, expected.parameters)
        equal(r.distance, expected.distance)


class Curves(unittest.TestCase):
    def test_layout(self):
        curve = circle(2)
        self.assertEqual(curve.GetDimensions(), (9, 1, 1))
        equal(points_of(curve)[:, :2], 2 * OCTAGON)
        equal(points_of(curve)[:, 2], 0)
        equal(field(curve, "KnotsU"), QUARTERS)
        equal(field(curve, "Degree"), [2])
        self.assertFalse(curve.GetFieldData().HasArray("KnotsV"))
        equal(vtk_to_numpy(curve.GetPointData().GetArray("RationalWeights")), OCTAGON_WEIGHTS)

    def test_space(self):
        points = np.random.default_rng(0).random((5, 3))
        equal(points_of(footpoint.nurbs_curve(points, [0, 0, 0, 1, 2, 3, 3, 3])), points)

    def test_unclamped(self):
        """A closed uniform cubic: its ends meet though no control points coincide."""
        corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1.0)])
        curve = footpoint.nurbs_curve(corners[[0, 1, 2, 3, 0, 1, 2]], np.arange(11))
        ends = footpoint.evaluate(curve, [3, 7])
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-15)

    def test_wrong_shapes(self):
        for points, knots, weights, text in (
            (np.zeros((4, 4)), np.arange(8), None, r"\(4, 4\); \(n, 3\) or \(n, 2\) is needed"),
            (np.zeros(4), np.arange(8), None, r"control_points has shape \(4,\)"),
            (OCTAGON, QUARTERS[:9], None, r"knots has shape \(9,\)"),
            (OCTAGON, QUARTERS, np.ones((9, 1)), r"weights has shape \(9, 1\); \(9,\) is needed"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                footpoint.nurbs_curve(points, knots, weights)


def names(blocks):
    numbers = range(blocks.GetNumberOfBlocks())
    return [blocks.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) for i in numbers]


class Composites(unittest.TestCase):
    def test_trimmed_face(self):
        net, corners = square(), np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0.0)])
        hole = circle(0.25)
        face = footpoint.trimmed_face(net, [[corners[:3], corners[2:]], hole, corners[::-1]])
        self.assertEqual(names(face), ["Surface", "Loop 0", "Loop 1", "Loop 2"])
        self.assertIs(face.GetBlock(0), net)
        self.assertEqual([face.GetBlock(i).GetNumberOfBlocks() for i in (1, 2, 3)], [2, 1, 1])
        self.assertIs(face.GetBlock(2).GetBlock(0), hole)
        polyline = face.GetBlock(1).GetBlock(1)
        self.assertEqual(polyline.GetDimensions(), (3, 1, 1))
        equal(points_of(polyline), [[1, 1, 0], [0, 1, 0], [0, 0, 0]])
        self.assertFalse(polyline.GetFieldData().HasArray("KnotsU"))

    def test_polygons_are_closed(self):
        triangle = np.array([(0, 0), (1, 0), (0, 1.0)])
        for loop in (triangle, [triangle], np.append(triangle, triangle[:1], axis=0)):
            face = footpoint.trimmed_face(square(), [loop])
            equal(points_of(face.GetBlock(1).GetBlock(0))[:, :2], triangle[[0, 1, 2, 0]])
        face = footpoint.trimmed_face(square(), [[triangle, triangle[[2, 0]]]])
        self.assertEqual(face.GetBlock(1).GetBlock(0).GetNumberOfPoints(), 3, "one of several")

    def test_evaluation_is_of_the_surface(self):
        face = footpoint.trimmed_face(square(2), [circle(0.25)])
        parameters = [[0.9, 0.9], [0.0, 0.5]]
        equal(footpoint.evaluate(face, parameters), footpoint.evaluate(square(2), parameters))

    def test_trimmed_face_in_a_file(self):
        """Names, nesting, knots, weights and the surface's field data, to the bit."""
        net = square()
        for name, value in (("Tolerance", 1 / 3), ("Orientation", -1.0)):
            net.GetFieldData().AddArray(to_vtk(np.array([value]), name, copy=True))
        face = footpoint.trimmed_face(
            net, [np.random.default_rng(8).random((5, 2)), [circle(0.3)]])
        model = footpoint.model([None, face, circle(1)])
        with tempfile.TemporaryDirectory() as folder:
            path = str(Path(folder) / "model.vtm")
            writer = vtkXMLMultiBlockDataWriter()
            writer.SetFileName(path)
            writer.SetInputData(model)
            self.assertEqual(writer.Write(), 1)
            reader = vtkXMLMultiBlockDataReader()
            reader.SetFileName(path)
            reader.Update()
        self.compare(reader.GetOutput(), model)

    def compare(self, data, expected):
        if expected is None:
            self.assertIsNone(data)
        elif expected.IsA("vtkMultiBlockDataSet"):
            self.assertEqual(data.GetNumberOfBlocks(), expected.GetNumberOfBlocks())
            for i in range(expected.GetNumberOfBlocks()):
                if expected.HasMetaData(i):
                    self.assertEqual(names(data)[i], names(expected)[i])
                self.compare(data.GetBlock(i), expected.GetBlock(i))
        else:
            self.assertEqual(data.GetDimensions(), expected.GetDimensions())
            equal(points_of(data), points_of(expected))
            for of in ("GetFieldData", "GetPointData"):
                arrays, others = getattr(data, of)(), getattr(expected, of)()
                self.assertEqual(arrays.GetNumberOfArrays(), others.GetNumberOfArrays())
                for i in range(others.GetNumberOfArrays()):
                    array = others.GetArray(i)
                    found = arrays.GetArray(array.GetName())
                    self.assertEqual(found.GetDataType(), array.GetDataType())
                    equal(vtk_to_numpy(found), vtk_to_numpy(array))

    def test_wrong_trimmed_faces(self):
        for loops, text in (
            ([], "loops is empty"),
            ([[]], "loop 0 has no pieces"),
            ([np.zeros((3, 3))], r"piece 0 of loop 0 has shape \(3, 3\)"),
            ([[np.zeros((3, 2)), np.zeros((1, 2))]], r"piece 1 of loop 0 has shape \(1, 2\)"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                footpoint.trimmed_face(square(), loops)
        bent = footpoint.nurbs_curve([[0, 0, 0], [1, 0, 0.5]], [0, 0, 1, 1])
        for loops, text in (
            ([[np.zeros((3, 2))]], "Face 0: Loop 0, curve 0: the polyline has 1 distinct points"),
            ([circle(), [circle(), bent]], "Loop 1, curve 1: control point 1 has z = 0.5"),
            ([[np.array([[0, 0], [1, np.nan], [1, 1]])]], "Loop 0, curve 0: control point 1"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                footpoint.trimmed_face(square(), loops)
        with self.assertRaisesRegex(TypeError, "net is a list"):
            footpoint.trimmed_face([[0, 0, 0]], [np.zeros((3, 2))])

    def test_model(self):
        faces = [square(), None, sphere(), None]
        model = footpoint.model(faces)
        self.assertEqual(model.GetNumberOfBlocks(), 4)
        for i, face in enumerate(faces):
            self.assertIs(model.GetBlock(i), face)
        with self.assertRaisesRegex(TypeError, "face 1 is a ndarray"):
            footpoint.model([square(), np.zeros((2, 2, 3))])


if __name__ == "__main__":
    unittest.main()
