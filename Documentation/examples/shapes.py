# SPDX-License-Identifier: BSD-3-Clause
"""Shapes that need no file, and whose answers are known."""

import footpoint
import numpy as np

# Distances from a torus, beside their closed form. They are positive outside.
torus = footpoint.nurbs_shape("torus", radius=2.0, cross_section_radius=0.5)
points = np.random.default_rng(1).uniform(-3.0, 3.0, (1000, 3))
r = footpoint.invert(points, torus)
x, y, z = points.T
assert np.allclose(r.signed_distance, np.hypot(np.hypot(x, y) - 2.0, z) - 0.5, atol=1e-14)
assert (r.status == footpoint.Status.CERTIFIED).all()

# A closed wing: its surface and both tips.
wing = footpoint.nurbs_shape("wing", airfoil_digits="4415", sweep_angle=25.0, capping=True)
r = footpoint.invert([[0.4, 0.0, 0.05], [0.4, 0.0, 0.5]], wing)
assert wing.GetNumberOfBlocks() == 3 and (np.sign(r.signed_distance) == [-1, 1]).all()
# u² is the fraction of the chord; u > 0 is the upper side.
print(f"nearest to the second point: {100 * r.parameters[1, 0] ** 2:.1f} % of the chord")
