# SPDX-License-Identifier: BSD-3-Clause
"""More than the nearest point: all feet, orthogonal feet, a direction, and points that have no foot."""

import footpoint
import numpy as np

# The parabola y = x² for x in [-2, 2].
parabola = footpoint.nurbs_curve([(-2, 4), (0, -4), (2, 4)], knots=[-2, -2, -2, 2, 2, 2])

# (0, 1) has two equally near feet, x = ±√½. Which is taken is no accident: the smaller parameter.
r = footpoint.invert([(0, 1)], parabola, all_feet=True)
assert np.allclose(r.parameters, -np.sqrt(0.5))
assert np.allclose(r.all_feet.parameters[:, 0], [-np.sqrt(0.5), np.sqrt(0.5)])
assert list(r.all_feet.point) == [0, 0]  # both belong to point 0

# The nearest point of (2.2, 4.5) is the end (2, 4), where the distance is not orthogonal.
r = footpoint.invert([(2.2, 4.5)], parabola)
assert r.foot_type[0] == footpoint.FootType.VERTEX and np.allclose(r.closest_points, [2, 4, 0])

# Along the y axis instead of to the nearest point; (3, 0) has nothing above or below it.
r = footpoint.invert([(1, 3), (3, 0)], parabola, fixed_direction=(0, 1, 0))
assert np.allclose(r.closest_points[0], [1, 1, 0]) and np.isclose(r.distance[0], 2.0)
assert r.status[1] == footpoint.Status.BEYOND_MAXIMUM_DISTANCE

# One bad point does not stop the others.
r = footpoint.invert([(np.nan, 0), (0, 0)], parabola)
print(r)
assert list(r.status) == [footpoint.Status.INVALID_POINT, footpoint.Status.CERTIFIED]

# Bad geometry is an error that names the array, the index and the value.
try:
    footpoint.nurbs_curve([(0, 0), (1, 0), (2, 0)], knots=[0, 0, 1, 0.5, 2])
except ValueError as error:
    print(error)
    assert "KnotsU[3]" in str(error)
