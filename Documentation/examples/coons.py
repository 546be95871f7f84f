# SPDX-License-Identifier: BSD-3-Clause
import footpoint
import numpy as np

# The swan: four curves between which plain transfinite interpolation folds.
s = np.linspace(0, 1, 101)
zero = 0 * s
bottom = np.c_[s, zero]
top = np.c_[s, 1 - 3 * s + 3 * s**2]
left = np.c_[zero, s]
right = np.c_[1 + 2 * s - 2 * s**2, s]

plain = footpoint.coons_patch(bottom, right, top, left)
mended = footpoint.coons_patch(top[::-1], left, bottom, right, smoothing="Auto")  # any order

for grid in (plain, mended):
    before = grid.GetFieldData().GetArray("FoldedCellsBefore").GetValue(0)
    after = grid.GetFieldData().GetArray("FoldedCellsAfter").GetValue(0)
    worst = grid.GetCellData().GetArray("Jacobian").GetRange()[0]
    print(f"{before} folded cells, then {after}; smallest scaled Jacobian {worst:.3f}")
assert after == 0
