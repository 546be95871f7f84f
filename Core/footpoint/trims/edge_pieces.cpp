// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/arc_patch.h"
#include "footpoint/trims/chebyshev_pieces.h"
#include "footpoint/trims/edge_curve.h"

#include <algorithm>

namespace footpoint
{
namespace
{

/// Up to this degree the exact S(c(t)) is taken; above, pieces of lower degree take less memory.
constexpr int kExactDegree = 12;

/// Part of the tolerance that simplifications may use up.
constexpr double kSimplified = 0.125;

/// Part of the tolerance that interpolation has at least, however much rounding has used up.
constexpr double kLeft = 0.25;

/// Exact at any degree: affine images of the arc, and straight arcs along u or v.
bool is_exact(const ArcPatch& patch)
{
  const bool isocurve = patch.arc_degree() == 1 && (patch.degree[0] == 0 || patch.degree[1] == 0);
  return patch.affine || isocurve || patch.composed_degree() <= kExactDegree;
}

/// Bound of the rounding of control points and samples: products and sums one after the other, of
/// the extraction and of de Casteljau's algorithm; all terms are positive, so that each costs no
/// more than itself.
double rounding(const ArcPatch& patch)
{
  const int operations = 8 + 6 * (patch.degree[0] + patch.degree[1]) + 3 * patch.composed_degree();
  return 0x1p-53 * operations * patch.magnitude;
}

} // namespace

EdgePieces edge_pieces(const EdgeCurve& edge, double tolerance)
{
  EdgePieces result{ {}, 0.0 };
  const std::vector<double>& spans = edge.direction(0).spans;
  for (std::size_t k = 0; k < edge.arcs().size(); ++k)
  {
    const ArcPatch patch(edge.surface(), edge.arcs()[k], edge.cells()[k], kSimplified * tolerance);
    double error = patch.change + rounding(patch);
    if (is_exact(patch))
    {
      const int degree = std::max(patch.composed_degree(), 1);
      result.pieces.push_back(
        { { { degree } }, Parameter<1>(spans[k]), Parameter<1>(spans[k + 1]), patch.compose() });
    }
    else
    {
      error += append_chebyshev_pieces(patch, spans[k], spans[k + 1],
        std::max(tolerance - error, kLeft * tolerance), result.pieces);
    }
    result.error = std::max(result.error, error);
  }
  return result;
}

} // namespace footpoint
