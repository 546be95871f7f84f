# SPDX-License-Identifier: BSD-3-Clause
"""Spline files: a surface goes from GoTools to G+Smo, a trimmed one into geomdl's JSON.

    files.py <output folder>
"""

import pathlib
import sys

import footpoint
import numpy as np

folder = pathlib.Path(sys.argv[1])
(folder / "sheet.g2").write_text("""200 1 0 0
3 0
2 2
0 0 1 1
3 3
0 0 0 1 1 1
0 0 0
1 0 0
0 1 0.5
1 1 0.5
0 2 0
1 2 0
""")
model = footpoint.read_splines(folder / "sheet.g2")  # a block for every spline of the file
footpoint.write_splines(model, folder / "sheet.xml")
r = footpoint.invert([[0.5, 1, 1]], footpoint.read_splines(folder / "sheet.xml"))
assert np.allclose(r.parameters, [0.5, 0.5]) and np.allclose(r.distance, 0.75)

# A hole in the sheet: the outer loop runs counter-clockwise, the hole clockwise, in (u, v).
border = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
hole = np.array([(0.25, 0.25), (0.25, 0.75), (0.75, 0.75), (0.75, 0.25)])
face = footpoint.trimmed_face(model.GetBlock(0), [border, hole])
footpoint.write_splines(face, folder / "sheet.json")
same = footpoint.read_splines(folder / "sheet.json").GetBlock(0)
assert same.GetNumberOfBlocks() == 3  # Surface, Loop 0, Loop 1
