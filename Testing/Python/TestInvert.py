# SPDX-License-Identifier: BSD-3-Clause
"""invert() against closed forms: circle, sphere, torus, bilinear patch, parabola; its inputs."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSetCollection, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer

import footpoint
from footpoint import FootType, Status
from footpoint._pipeline import as_numbers, to_vtk
from shapes import bilinear, circle, parabola, random_points, sphere, square, torus

close = np.testing.assert_allclose
equal = np.testing.assert_array_equal


class ClosedForms(unittest.TestCase):
    def check_consistency(self, points, geometry, r):
        """What holds for every foot on a surface, whatever the surface."""
        self.assertTrue((r.status <= Status.CONVERGED).all(), r.status)
        close(footpoint.evaluate(geometry, r.parameters, r.face), r.closest_points, atol=1e-12)
        close(np.linalg.norm(points - r.closest_points, axis=1), r.distance, atol=1e-12)
        close(np.abs(r.signed_distance), r.distance)
        close(np.linalg.norm(r.normals, axis=1), 1)

    def test_circle(self):
        points = random_points(500)
        points[:, 2] = 0
        r = footpoint.invert(points, circle())
        radius = np.linalg.norm(points, axis=1)
        close(r.distance, np.abs(radius - 1), atol=1e-12)
        close(r.closest_points, points / radius[:, None], atol=1e-12)
        close(np.sum(r.tangents * r.closest_points, axis=1), 0, atol=1e-12)
        close(np.linalg.norm(r.tangents, axis=1), 1)
        # Counter-clockwise from (1, 0), a quarter a unit of the parameter; no closed form between.
        angles = np.arctan2(points[:, 1], points[:, 0]) % (2 * np.pi)
        equal(np.floor(r.parameters[:, 0]), np.floor(angles / (np.pi / 2)))
        self.assertEqual(r.parameters.shape, (500, 1))
        self.assertIsNone(r.signed_distance, "a circle in space has no sides")
        self.assertIsNone(r.normals)
        close(r.statistics["mean"], np.mean(r.distance))

    def test_circle_centre(self):
        r = footpoint.invert([[0, 0, 0], [0.1, 0, 0]], circle(10))
        close(r.distance, [10, 9.9])
        equal(r.isolated, [0, 1])

    def test_sphere(self):
        points = random_points(500, 2)
        r = footpoint.invert(points, sphere())
        radius = np.linalg.norm(points, axis=1)
        close(r.signed_distance, radius - 1, atol=1e-12)
        close(r.normals, points / radius[:, None], atol=1e-7)
        self.check_consistency(points, sphere(), r)
        equal(r.isolated, 1)

    def test_sphere_poles_and_centre(self):
        r = footpoint.invert([[0, 0, 2], [0, 0, -3], [0, 0, 0], [1e-9, 0, 2]], sphere())
        close(r.signed_distance, [1, 2, -1, 1])
        close(r.parameters[:2, 1], [2, 0], atol=1e-12)
        equal(r.foot_type[:2], FootType.DEGENERATE)
        close(r.normals[:2], [[0, 0, 1], [0, 0, -1]], atol=1e-9)
        equal(r.isolated[[0, 1, 2]], [1, 1, 0])

    def test_torus(self):
        points = random_points(500, 3)
        r = footpoint.invert(points, torus())
        tube = np.hypot(np.linalg.norm(points[:, :2], axis=1) - 3, points[:, 2])
        close(r.signed_distance, tube - 1, atol=1e-12)
        self.check_consistency(points, torus(), r)
        r = footpoint.invert([[3, 0, 0], [0, 0, 0]], torus())
        close(r.distance, [1, 2])

    def test_bilinear(self):
        """S1 of the hard cases: above the saddle two feet, a tie that lower u decides."""
        r = footpoint.invert([[0, 0, 1.5]], bilinear(), all_feet=True)
        s = np.sqrt(0.5)
        close(r.distance, [np.sqrt(2)])
        close(r.parameters, [[-s, -s]], atol=1e-9)
        close(r.all_feet.parameters, [[-s, -s], [s, s]], atol=1e-9)
        equal(r.all_feet.point, [0, 0])
        points = random_points(300)
        r = footpoint.invert(points, bilinear())
        close(r.closest_points[:, 2], r.closest_points[:, 0] * r.closest_points[:, 1], atol=1e-12)
        close(r.parameters, r.closest_points[:, :2], atol=1e-12)
        self.check_consistency(points, bilinear(), r)

    def test_corner_edge_and_inside(self):
        r = footpoint.invert([[0.5, 0.5, 1], [-1, 0.5, 0], [2, 3, 0]], square())
        equal(r.foot_type, [FootType.INTERIOR, FootType.EDGE, FootType.VERTEX])
        close(r.closest_points, [[0.5, 0.5, 0], [0, 0.5, 0], [1, 1, 0]])


class Inputs(unittest.TestCase):
    def test_shapes_and_types(self):
        points = np.array([[0.25, 0.5, 1.0], [0.75, 0.5, -1.0]])
        expected = footpoint.invert(points, square())
        equal(expected.signed_distance, [1, -1])
        fortran = np.asfortranarray(points)
        strided = np.repeat(points, 2, axis=0)[::2]
        frozen = points.copy()
        frozen.flags.writeable = False
        for same in (points.tolist(), fortran, strided, frozen, points.astype(">f8")):
            equal(footpoint.invert(same, square()).closest_points, expected.closest_points)
        single = footpoint.invert(points.astype(np.float32), square())
        self.assertEqual(single.closest_points.dtype, np.float64)
        equal(single.closest_points, expected.closest_points)
        equal(footpoint.invert(np.array([[2, 3, 1]]), square()).closest_points, [[1, 1, 0]])
        close(footpoint.invert(points[:, :2], square()).distance, 0, atol=1e-15)

    def test_no_copies(self):
        for dtype in (np.float32, np.float64):
            points = np.ones((5, 3), dtype)
            self.assertTrue(np.shares_memory(vtk_to_numpy(to_vtk(as_numbers(points, ""))), points))
        parameters = footpoint.invert(points, square()).parameters
        self.assertFalse(parameters.flags.owndata, "a view of VTK's memory")

    def test_input_is_left_alone_and_results_outlive_it(self):
        points = random_points(50)
        before = points.copy()
        r = footpoint.invert(points, sphere())
        equal(points, before)
        copies = [r.distance.copy(), r.closest_points.copy(), r.normals.copy()]
        points[:] = 0
        del points
        equal(r.distance, copies[0])
        equal(r.closest_points, copies[1])
        equal(r.normals, copies[2])

    def test_wrong_shapes(self):
        for bad, text in (
            ([1.0, 2.0, 3.0], r"points has shape \(3,\)"),
            (np.zeros((4, 4)), r"points has shape \(4, 4\); \(m, 3\) or \(m, 2\) is needed"),
            (np.zeros((2, 2, 3)), r"\(2, 2, 3\)"),
            ([[1, 2, 3], [1, 2]], "points is no array of real numbers"),
            (["a"], "points is no array of real numbers"),
            (np.zeros((2, 3), complex), "complex128"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                footpoint.invert(bad, square())

    def test_empty(self):
        for empty in ([], np.empty((0, 3)), np.empty((0, 2), np.float32)):
            r = footpoint.invert(empty, square(), all_feet=True)
            self.assertEqual(r.parameters.shape, (0, 2))
            self.assertEqual(r.closest_points.shape, (0, 3))
            self.assertEqual(r.distance.shape, (0,))
            self.assertEqual(len(r.all_feet.point), 0)
            self.assertEqual(r.statistics["count"], 0)
            equal(r.statistics["status_counts"], np.zeros(6))

    def test_bad_points_disturb_no_other(self):
        points = random_points(20)
        expected = footpoint.invert(points, sphere())
        points[3, 1], points[7, 0] = np.nan, np.inf
        r = footpoint.invert(points, sphere())
        bad = np.isin(np.arange(20), [3, 7])
        equal(r.status == Status.INVALID_POINT, bad)
        self.assertTrue(np.isnan(r.parameters[bad]).all() and np.isnan(r.distance[bad]).all())
        equal(r.face[bad], -1)
        equal(r.closest_points[~bad], expected.closest_points[~bad])
        self.assertEqual(r.statistics["count"], 18)
        self.assertEqual(r.statistics["status_counts"][Status.INVALID_POINT], 2)


class Geometries(unittest.TestCase):
    def test_list_of_faces(self):
        points = [[0.5, 0.5, 0.1], [0.5, 0.5, 0.9], [0.2, 0.2, 0.5]]
        faces = [square(0), None, square(1)]
        r = footpoint.invert(points, faces)
        equal(r.face, [0, 2, 0])  # a tie: the lowest face
        equal(r.parameters[1], [0.5, 0.5])
        equal(r.face_statistics["count"], [2, 0, 1])
        same = footpoint.invert(points, footpoint.model(faces))
        equal(same.face, r.face)
        nested = footpoint.invert(points, [[square(0)], square(1)])
        equal(nested.face, [0, 1, 0])

    def test_surfaces_and_curves_together(self):
        r = footpoint.invert([[0.5, 0.5, 1], [5, 0, 0]], [square(), circle(5)])
        equal(r.face, [0, 1])
        close(r.distance, [1, 0], atol=1e-13)
        equal(np.isnan(r.signed_distance), [False, True])
        equal(np.isnan(r.normals[:, 0]), [False, True])
        equal(np.isnan(r.tangents[:, 0]), [True, False])
        self.assertEqual(r.parameters.shape, (2, 2))
        close(r.parameters[1], [0, 0], atol=1e-12)

    def test_collection_and_pipeline(self):
        collection = vtkPartitionedDataSetCollection()
        collection.SetPartition(0, 0, square(0))
        collection.SetPartition(1, 0, square(1))
        equal(footpoint.invert([[0.5, 0.5, 0.9]], collection).face, [1])
        producer = vtkTrivialProducer()
        producer.SetOutput(square())
        for source in (producer, producer.GetOutputPort()):
            equal(footpoint.invert([[0.5, 0.5, 3]], source).distance, [3])

    def test_parametric_function(self):
        function = vtkParametricTorus()
        function.SetRingRadius(3)
        function.SetCrossSectionRadius(1)
        points = random_points(100, 3)
        r = footpoint.invert(points, function)
        tube = np.hypot(np.linalg.norm(points[:, :2], axis=1) - 3, points[:, 2])
        close(r.distance, np.abs(tube - 1), atol=1e-8)
        equal(r.status, Status.CONVERGED)

    def test_wrong_types(self):
        for bad in (3, "net", np.zeros((2, 2, 3)), {"a": square()}):
            with self.assertRaisesRegex(TypeError, f"geometry is a {type(bad).__name__}"):
                footpoint.invert([[0, 0, 0]], bad)
        with self.assertRaisesRegex(TypeError, "face 1 is a vtkParametricTorus"):
            footpoint.invert([[0, 0, 0]], [square(), vtkParametricTorus()])
        with self.assertRaisesRegex(ValueError, "vtkPolyData"):
            footpoint.invert([[0, 0, 0]], vtkPolyData())
        with self.assertRaisesRegex(ValueError, "no faces"):
            footpoint.invert([[0, 0, 0]], [])


class Results(unittest.TestCase):
    def test_repr(self):
        r = footpoint.invert([[0, 0, 0], [np.nan, 0, 0]], square(), generate_normal=False)
        self.assertIn("2 feet", repr(r))
        self.assertIn("1 CERTIFIED, 1 INVALID_POINT", repr(r))
        self.assertNotIn("normals", repr(r))

    def test_statistics(self):
        points = np.column_stack([np.full(100, 0.5), np.full(100, 0.5), np.arange(-49, 51)])
        r = footpoint.invert(points, square(), deviation_tolerance=40)
        s = r.statistics
        heights = points[:, 2]
        self.assertEqual((s["count"], s["minimum"], s["maximum"]), (100, -49, 50))
        close([s["mean"], s["rms"]], [0.5, np.sqrt(np.mean(heights**2))])
        close(s["standard_deviation"], heights.std())
        self.assertEqual(s["percentile95"], np.sort(np.abs(heights))[94])
        close(s["out_of_tolerance_fraction"], np.mean(np.abs(heights) > 40))
        equal(s["status_counts"].sum(), 100)
        equal(r.face_statistics["maximum_absolute"], [50])

    def test_enumerations(self):
        names = ["CERTIFIED", "CONVERGED", "NOT_CONVERGED", "BEYOND_MAXIMUM_DISTANCE",
                 "INVALID_POINT", "NO_ORTHOGONAL_FOOT"]
        self.assertEqual([s.name for s in Status], names)
        self.assertEqual([int(s) for s in Status], list(range(6)))
        types = ["INTERIOR", "EDGE", "VERTEX", "KINK", "DEGENERATE"]
        self.assertEqual([t.name for t in FootType], types)

    def test_parabola(self):
        """C1 and C2 of the hard cases."""
        r = footpoint.invert([[0, 0.5], [0, 1]], parabola(), all_feet=True)
        close(r.distance, [0.5, np.sqrt(0.75)])
        close(r.parameters[0], 0, atol=1e-4)  # a quartic minimum
        equal(r.all_feet.point, [0, 1, 1])
        close(r.all_feet.parameters[1:, 0], [-np.sqrt(0.5), np.sqrt(0.5)])


if __name__ == "__main__":
    unittest.main()
