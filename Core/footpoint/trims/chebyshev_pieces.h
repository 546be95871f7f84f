// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/bezier.h"
#include "footpoint/trims/arc_patch.h"

#include <vector>

namespace footpoint
{

/// Approximates S(c(t)) over an arc by polynomial Bézier pieces and appends them.
///
/// Each piece is a Chebyshev series, cut off at the lowest degree that will do, of the arc or of a
/// part of it found by halving. The bound is proved: S(c(t)) = A / w with polynomials of a known
/// degree m, so the residual A − q w of a piece q of degree d has degree m + d at most, and its
/// values at m + d + 1 Chebyshev nodes give all its Chebyshev coefficients. The sum of their
/// magnitudes over a lower bound of w, found likewise, bounds the error.
///
/// \param start, end local parameters of the edge over the arc
/// \param tolerance  of the error (model units); that of rounding where it is smaller
/// \return bound of the error of the pieces appended, rounding not included
double append_chebyshev_pieces(const ArcPatch& patch, double start, double end, double tolerance,
  std::vector<BezierPiece<1>>& pieces);

} // namespace footpoint
