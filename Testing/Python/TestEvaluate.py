# SPDX-License-Identifier: BSD-3-Clause
"""evaluate() against closed forms, its shapes, its errors, and as the inverse of invert()."""

import unittest

import numpy as np
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricEllipsoid, vtkParametricSpline

import footpoint
from shapes import bilinear, circle, parabola, random_points, sphere, square, torus

close = np.testing.assert_allclose
equal = np.testing.assert_array_equal


class ClosedForms(unittest.TestCase):
    def test_polynomials(self):
        t = np.linspace(-2, 2, 41)
        points = footpoint.evaluate(parabola(), t)
        close(points, np.column_stack([t, t**2, 0 * t]), atol=1e-14)
        u, v = random_points(50, 0.3)[:, :2].T.clip(-1, 1)
        close(footpoint.evaluate(bilinear(), np.column_stack([u, v])),
              np.column_stack([u, v, u * v]), atol=1e-15)

    def test_rational(self):
        close(np.linalg.norm(footpoint.evaluate(circle(10), np.linspace(0, 4, 101)), axis=1), 10,
              rtol=1e-15)
        uv = np.random.default_rng(0).uniform([0, 0], [4, 2], (200, 2))
        close(np.linalg.norm(footpoint.evaluate(sphere(), uv), axis=1), 1, rtol=1e-14)
        x, y, z = footpoint.evaluate(torus(), uv * [1, 2]).T
        close((np.hypot(x, y) - 3) ** 2 + z**2, 1, rtol=1e-13)

    def test_corners_of_the_domain(self):
        corners = [[-1, -1], [1, -1], [-1, 1], [1, 1]]
        equal(footpoint.evaluate(bilinear(), corners),
              [[-1, -1, 1], [1, -1, -1], [-1, 1, -1], [1, 1, 1]])

    def test_outside_the_domain(self):
        equal(footpoint.evaluate(square(), [[-3, 0.5], [0.25, 7]]), [[0, 0.5, 0], [0.25, 1, 0]])
        close(footpoint.evaluate(circle(), [4.5, -3.5]), footpoint.evaluate(circle(), [0.5, 0.5]))

    def test_inverse_of_invert(self):
        points = random_points(100, 2)
        for geometry in (sphere(), torus(), bilinear(), parabola(), [sphere(), circle(3)]):
            r = footpoint.invert(points, geometry)
            back = footpoint.evaluate(geometry, r.parameters, r.face)
            close(back, r.closest_points, atol=1e-13)

    def test_parametric_function(self):
        ellipsoid = vtkParametricEllipsoid()
        points = footpoint.evaluate(ellipsoid, [[0.3, 0.4], [2.0, 1.0]])
        close(np.linalg.norm(points, axis=1), 1, rtol=1e-12)


class Shapes(unittest.TestCase):
    def test_parameters(self):
        t = [0.5, 1.5]
        expected = footpoint.evaluate(circle(), t)
        self.assertEqual(expected.shape, (2, 3))
        equal(footpoint.evaluate(circle(), np.array(t)[:, None]), expected)
        equal(footpoint.evaluate(circle(), [[0.5, 9.0], [1.5, np.nan]]), expected)
        equal(footpoint.evaluate(circle(), np.array(t, np.float32)), expected)
        for empty in ([], np.empty((0, 1)), np.empty((0, 2))):
            self.assertEqual(footpoint.evaluate(circle(), empty).shape, (0, 3))
        for bad in (0.5, np.zeros((2, 3)), np.zeros((1, 1, 2))):
            with self.assertRaisesRegex(ValueError, "parameters has shape"):
                footpoint.evaluate(circle(), bad)
        with self.assertRaisesRegex(ValueError, "1 component; surfaces need 2"):
            footpoint.evaluate(square(), [0.5])

    def test_faces(self):
        faces = [square(0), square(1), circle()]
        uv = [[0.5, 0.5], [0.5, 0.5], [1.0, 0.0]]
        equal(footpoint.evaluate(faces, uv, [0, 1, 2])[:, 2], [0, 1, 0])
        equal(footpoint.evaluate(faces, uv[:2], faces=1)[:, 2], [1, 1])
        equal(footpoint.evaluate(faces, uv[:2], np.array([1, 0], np.int32))[:, 2], [1, 0])
        with self.assertRaisesRegex(ValueError, "several faces"):
            footpoint.evaluate(faces, uv)
        with self.assertRaisesRegex(ValueError, r"faces has shape \(2,\); \(3,\) is needed"):
            footpoint.evaluate(faces, uv, [0, 1])
        with self.assertRaisesRegex(ValueError, "faces is no array of integers"):
            footpoint.evaluate(faces, uv, [0.0, 1.0, 2.0])

    def test_rows_without_a_point(self):
        points = footpoint.evaluate(
            [square(), square(1)],
            [[0.5, 0.5], [np.nan, 0.5], [0.5, np.inf], [0.5, 0.5], [0.5, 0.5], [0.25, 0.5]],
            [0, 0, 0, -1, 2, 1],
        )
        equal(np.isnan(points[:, 0]), [False, True, True, True, True, False])
        equal(points[[0, 5]], [[0.5, 0.5, 0], [0.25, 0.5, 1]])

    def test_wrong_types(self):
        with self.assertRaisesRegex(TypeError, "geometry is a str"):
            footpoint.evaluate("net", [[0, 0]])
        with self.assertRaises(ValueError):
            footpoint.evaluate(vtkParametricSpline(), [["a", "b"]])


if __name__ == "__main__":
    unittest.main()
