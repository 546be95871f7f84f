// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/types.h"

#include <array>

namespace footpoint
{

/// The points of a structured grid of N directions, the first index fastest.
template <int N>
struct StructuredPoints
{
  std::array<int, N> count{}; ///< points along each direction
  Points points;              ///< product(count) columns

  Eigen::Index index(int i, int j) const { return i + Eigen::Index(this->count[0]) * j; }
  Eigen::Index index(int i, int j, int k) const
  {
    return i + Eigen::Index(this->count[0]) * (j + Eigen::Index(this->count[1]) * k);
  }
};

using Grid = StructuredPoints<2>;
using VolumeGrid = StructuredPoints<3>;

} // namespace footpoint
