// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/trimmed_pieces.h"

#include "footpoint/search/piece_cutting.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

using Pair = std::array<double, 2>;

/// Along each direction of a box so many points are tried.
constexpr int kTries = 9;

Pair corner(const Parameter<2>& at)
{
  return { { at(0), at(1) } };
}

void drop_trimmed_away(const TrimRegion& region, std::vector<BezierPiece<2>>& pieces)
{
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                 [&region](const BezierPiece<2>& piece)
                 {
                   return region.cover(corner(piece.lower), corner(piece.upper)) ==
                     TrimRegion::Cover::Outside;
                 }),
    pieces.end());
}

/// The middle of an arc (de Casteljau 1959).
Pair middle_of(const TrimArc& arc)
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> points = arc.control;
  for (Eigen::Index left = points.cols() - 1; left > 0; --left)
  {
    for (Eigen::Index k = 0; k < left; ++k)
    {
      points.col(k) = 0.5 * (points.col(k) + points.col(k + 1));
    }
  }
  return { { points(0, 0) / points(2, 0), points(1, 0) / points(2, 0) } };
}

} // namespace

std::vector<BezierPiece<2>> kept_pieces(
  const Surface& surface, const TrimRegion& region, std::size_t few_pieces)
{
  std::vector<BezierPiece<2>> pieces;
  SurfacePieces(surface).for_each(
    [&](const BezierPiece<2>& piece)
    {
      if (region.cover(corner(piece.lower), corner(piece.upper)) != TrimRegion::Cover::Outside)
      {
        pieces.push_back(piece);
      }
    });
  pieces = cut_pieces<2>(std::move(pieces), few_pieces);
  drop_trimmed_away(region, pieces);
  return pieces;
}

bool keeps_all(const TrimRegion& region, const Pair& lower, const Pair& upper)
{
  return region.cover(lower, upper) == TrimRegion::Cover::Inside;
}

Pair kept_point(const TrimRegion& region, const Pair& lower, const Pair& upper)
{
  Pair best{ { NAN, NAN } };
  int nearest = 2 * kTries * kTries;
  for (int k = 0; k < kTries * kTries; ++k)
  {
    // Not on the border of the box, along which trims may run.
    const int i = k / kTries;
    const int j = k % kTries;
    const int off = std::abs(2 * i + 1 - kTries) + std::abs(2 * j + 1 - kTries);
    const Pair at{ { lower[0] + (i + 0.5) / kTries * (upper[0] - lower[0]),
      lower[1] + (j + 0.5) / kTries * (upper[1] - lower[1]) } };
    if (off < nearest && region.contains(at[0], at[1]))
    {
      best = at;
      nearest = off;
    }
  }
  for (const TrimArc& arc : region.arcs())
  {
    if (!std::isnan(best[0]))
    {
      break;
    }
    const Pair at = middle_of(arc);
    const bool inside = at[0] >= lower[0] && at[0] <= upper[0] && at[1] >= lower[1] &&
      at[1] <= upper[1];
    best = inside && arc.inside_domain && arc.bounds == ArcBounds::Face ? at : best;
  }
  return best;
}

} // namespace footpoint
