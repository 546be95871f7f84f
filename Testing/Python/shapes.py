# SPDX-License-Identifier: BSD-3-Clause
"""Geometry with closed forms for tests."""

import numpy as np

import footpoint

_S = np.sqrt(0.5)
#: Unit circle of four quarters, degree 2: corners of the octagon around it, and their weights.
OCTAGON = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)])
OCTAGON_WEIGHTS = np.array([1, _S, 1, _S, 1, _S, 1, _S, 1])
QUARTERS = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]


def circle(radius=1.0):
    """In z = 0 around the origin, from (radius, 0) counter-clockwise, domain [0, 4]."""
    return footpoint.nurbs_curve(radius * OCTAGON, QUARTERS, OCTAGON_WEIGHTS)


def revolved(profile, knots, weights):
    """Surface of revolution about z of a profile of (r, z) control points; u is the angle."""
    r, z = np.asarray(profile, float).T
    points = np.zeros((9, len(r), 3))
    points[..., 0] = np.outer(OCTAGON[:, 0], r)
    points[..., 1] = np.outer(OCTAGON[:, 1], r)
    points[..., 2] = z
    return footpoint.nurbs_surface(points, QUARTERS, knots, np.outer(OCTAGON_WEIGHTS, weights))


def sphere(radius=1.0):
    """Around the origin, from the south pole (v = 0) to the north pole (v = 2), normals outward."""
    half = radius * np.array([(0, -1), (1, -1), (1, 0), (1, 1), (0, 1)])
    return revolved(half, [0, 0, 0, 1, 1, 2, 2, 2], OCTAGON_WEIGHTS[:5])


def torus(major=3.0, minor=1.0):
    """Around z, normals outward."""
    profile = minor * OCTAGON + np.array([major, 0.0])
    return revolved(profile, QUARTERS, OCTAGON_WEIGHTS)


def bilinear():
    """z = x y on [-1, 1]^2 with u = x, v = y."""
    points = [[(-1, -1, 1), (-1, 1, -1)], [(1, -1, -1), (1, 1, 1)]]
    return footpoint.nurbs_surface(points, [-1, -1, 1, 1], [-1, -1, 1, 1])


def square(z=0.0):
    """Unit square at height z, u = x, v = y, normals along +z."""
    points = [[(0, 0, z), (0, 1, z)], [(1, 0, z), (1, 1, z)]]
    return footpoint.nurbs_surface(points, [0, 0, 1, 1], [0, 0, 1, 1])


def parabola():
    """(t, t^2) for t in [-2, 2]."""
    return footpoint.nurbs_curve([(-2, 4), (0, -4), (2, 4)], [-2, -2, -2, 2, 2, 2])


def random_points(count, scale=1.0, seed=0):
    return np.random.default_rng(seed).normal(scale=scale, size=(count, 3))
