// SPDX-License-Identifier: BSD-3-Clause

// The members of Finder that have to do with the distance form of a piece: its level, where it is least. Compiled once for each set
// of vector instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PIECE_FORMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_FORMS_INL_H
#undef FOOTPOINT_PIECE_FORMS_INL_H
#else
#define FOOTPOINT_PIECE_FORMS_INL_H
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

/// Near the minimum: the control points of a parabola c(t − t0)² are those of a parabola themselves,
/// with its vertex at t0 (n − 1) + ½ (from raising its degree to n).
HWY_INLINE double parabola_start(double before, double here, double after, int at, int n)
{
  const double bend = before - 2.0 * here + after;
  const double vertex = bend > 0.0 ? at + 0.5 * (before - after) / bend : at;
  return std::min(std::max((vertex - 0.5) / (n - 1), 0.0), 1.0);
}

/// Where to start from, near the smallest coefficient.
Pair Finder::start_of(const PieceShape& shape, const double* coefficients, double least)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  int k = 0;
  for (int i = 0; i < shape.form_size; i += lanes)
  {
    const auto is_least = hn::Eq(hn::LoadU(tag, coefficients + i), hn::Set(tag, least));
    const auto at = hn::FindFirstTrue(tag, is_least);
    if (at >= 0)
    {
      k = i + static_cast<int>(at);
      break;
    }
  }
  const int row = k / shape.stride;
  const int column = std::min(k % shape.stride, shape.columns - 1);
  Pair start{ { 0.0, 0.0 } };
  if (shape.rows > 1)
  {
    const int at = std::clamp(row, 1, shape.rows - 2);
    const double* f = coefficients + column;
    start[0] = parabola_start(f[(at - 1) * shape.stride], f[at * shape.stride],
      f[(at + 1) * shape.stride], at, shape.rows - 1);
  }
  if (shape.columns > 1)
  {
    const int at = std::clamp(column, 1, shape.columns - 2);
    const double* f = coefficients + row * shape.stride;
    start[1] = parabola_start(f[at - 1], f[at], f[at + 1], at, shape.columns - 1);
  }
  return start;
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
