// SPDX-License-Identifier: BSD-3-Clause

// The members of Finder that say under which distance the form of a piece is taken, and by how much
// its coefficients are off. Compiled once for each set of vector instructions (the guard of
// Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PIECE_LEVEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_LEVEL_INL_H
#undef FOOTPOINT_PIECE_LEVEL_INL_H
#else
#define FOOTPOINT_PIECE_LEVEL_INL_H
#endif

#include "footpoint/search/finder-inl.h"

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

Finder::Level Finder::level_of(const PieceQuery& query) const
{
  const Piece& piece = *query.piece;
  const PieceFoot& foot = this->best();
  const double far = bound_of_length(query.p);
  double f[3];
  Level level{ 0.0, 0.0, foot.distance * foot.distance };
  for (int k = 0; k < 3; ++k)
  {
    f[k] = foot.position[k] - piece.origin[k];
    level.constant += f[k] * (2.0 * query.p[k] - f[k]);
  }
  const double reach = bound_of_length(f);
  level.margin = piece.shape->roundings * kRounding *
    (piece.reach * (piece.reach + 4.0 * far) + reach * (reach + 4.0 * far));
  return level;
}

Finder::Level Finder::level_of(const PieceQuery& query, double distance) const
{
  const Piece& piece = *query.piece;
  const double squared = dot(query.p, query.p);
  const double level = distance * distance;
  return { squared - level,
    piece.shape->roundings * kRounding *
      (piece.reach * (piece.reach + 4.0 * bound_of_length(query.p)) + squared + level),
    level };
}

Finder::Level Finder::reach_of(const PieceQuery& query) const
{
  const double error = query.piece->error;
  if (!this->found() || this->Bound < this->best().distance)
  {
    return this->level_of(query, this->Bound < kInfinity ? this->Bound + error : 0.0);
  }
  Level level = this->level_of(query);
  const double more = this->tie() + error;
  const double tie = more * (2.0 * this->best().distance + more);
  level.constant -= tie;
  level.level += tie;
  return level;
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
