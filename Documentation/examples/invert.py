# SPDX-License-Identifier: BSD-3-Clause
import footpoint
import numpy as np

# A quarter of a cylinder of radius 10 and height 20, exact by its weights.
w = np.sqrt(0.5)
cylinder = footpoint.nurbs_surface(
    [[[10, 0, 0], [10, 0, 20]], [[10, 10, 0], [10, 10, 20]], [[0, 10, 0], [0, 10, 20]]],
    knots_u=[0, 0, 0, 1, 1, 1], knots_v=[0, 0, 1, 1], weights=[[1, 1], [w, w], [1, 1]])

r = footpoint.invert([[9, 12, 5], [3, 4, 15], [10, -3, 24]], cylinder)
print(r.closest_points)   # (6, 8, 5), (6, 8, 15), and the corner (10, 0, 20)
print(r.signed_distance)  # 5 outside, -5 inside, and 5 for the corner
print(r.parameters)       # (u, v) of the feet, which evaluate() takes back:
assert np.allclose(footpoint.evaluate(cylinder, r.parameters), r.closest_points)
assert np.allclose(r.signed_distance, [5, -5, 5])
