// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/point_merging.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace footpoint
{

std::vector<int> merge_points(const Points& points, double distance)
{
  const auto count = static_cast<std::size_t>(points.cols());
  std::vector<int> merged(count);
  std::iota(merged.begin(), merged.end(), 0);

  // === Points in the order of a height in which near ones are near each other. Its direction is
  // none that drawings use, along which thousands of points would be equally high.
  const Vector3 direction = Vector3(0.6180339887, 0.4142135624, 0.6677).normalized();
  const Eigen::VectorXd height = points.transpose() * direction;
  std::vector<int> order = merged;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return height[a] < height[b]; });
  std::vector<std::size_t> rank(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    rank[order[k]] = k;
  }

  for (std::size_t i = 0; i < count; ++i)
  {
    const auto point = static_cast<int>(i);
    const auto near = [&](std::size_t k)
    { return std::abs(height[order[k]] - height[point]) <= 2.0 * distance; }; // rounding included
    const auto consider = [&](std::size_t k)
    {
      const int other = order[k];
      if (other < merged[i] && merged[other] == other &&
        (points.col(other) - points.col(point)).norm() <= distance)
      {
        merged[i] = other;
      }
    };
    for (std::size_t k = rank[i] + 1; k < count && near(k); ++k)
    {
      consider(k);
    }
    for (std::size_t k = rank[i]; k-- > 0 && near(k);)
    {
      consider(k);
    }
  }
  return merged;
}

} // namespace footpoint
