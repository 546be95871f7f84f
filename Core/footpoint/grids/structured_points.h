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

/// A grid to read, whose points belong to somebody else.
struct GridView
{
  std::array<int, 2> count{};
  Eigen::Map<const Points> points;

  /// Implicit: a Grid may stand wherever one is read.
  GridView(const Grid& grid)
    : count(grid.count)
    , points(grid.points.data(), 3, grid.points.cols())
  {
  }
  /// \param coordinates 3·count[0]·count[1] numbers, the first index fastest
  GridView(const std::array<int, 2>& count_, const double* coordinates)
    : count(count_)
    , points(coordinates, 3, Eigen::Index(count_[0]) * count_[1])
  {
  }

  Eigen::Index index(int i, int j) const { return i + Eigen::Index(this->count[0]) * j; }
};

} // namespace footpoint
