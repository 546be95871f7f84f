# SPDX-License-Identifier: BSD-3-Clause
import footpoint
import numpy as np

# A link rod that comes with Debian's Open CASCADE: a solid of 37 trimmed faces, in mm.
rod = footpoint.read_cad("/usr/share/opencascade/data/step/linkrods.step")
scan = np.array([[5.5, 3.2, 1.0], [5.6, 3.0, 0.7], [4.0, 3.25, 1.0]])

r = footpoint.invert(scan, rod)
print(r.signed_distance)     # -0.20 inside the arm, 0.02 before it, 0.39 in the large bore
print(r.face, r.parameters)  # the face of each foot, and (u, v) there
assert np.allclose(r.signed_distance, [-0.2015, 0.0174, 0.3922], atol=1e-4)
assert (r.status == footpoint.Status.CERTIFIED).all()  # proved: no point of the rod is nearer
assert r.statistics["open_edges"] == 0                 # closed, so negative is inside
