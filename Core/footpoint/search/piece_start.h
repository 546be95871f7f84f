// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>

namespace footpoint
{

/// A place on a piece from which to look for a foot or a meeting.
struct PieceStart
{
  std::int32_t piece;
  std::array<double, 2> t;     ///< in the piece, [0, 1]²; curves: t[0] = 0
  std::array<double, 2> lower; ///< the part of the piece that it stands for
  std::array<double, 2> upper;
  bool simple; ///< the place itself is what is sought, up to rounding
};

/// Told each start; returns whether what it leads to settles the start's part of the piece, so that
/// this need not be looked at any closer. The answer does not matter where the start is simple.
using VisitStart = std::function<bool(const PieceStart&)>;

} // namespace footpoint
