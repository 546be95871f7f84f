// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/index_transfer.h"

#include <algorithm>

namespace footpoint
{

Grid resampled(const Grid& grid, const std::array<int, 2>& count)
{
  Grid result{ count, Points(3, Eigen::Index(count[0]) * count[1]) };
  // Exact where an index is met: k (from − 1) / (to − 1) in whole numbers.
  auto place = [](int k, int from, int to)
  {
    const long long scaled = static_cast<long long>(k) * (from - 1);
    const int index = std::min(int(scaled / (to - 1)), from - 2);
    const double rest = double(scaled - static_cast<long long>(index) * (to - 1)) / (to - 1);
    return std::pair<int, double>(index, rest);
  };
  for (int j = 0; j < count[1]; ++j)
  {
    const auto [n, t] = place(j, grid.count[1], count[1]);
    for (int i = 0; i < count[0]; ++i)
    {
      const auto [m, s] = place(i, grid.count[0], count[0]);
      result.points.col(result.index(i, j)) =
        (1.0 - t) * ((1.0 - s) * grid.points.col(grid.index(m, n)) +
                      s * grid.points.col(grid.index(m + 1, n))) +
        t * ((1.0 - s) * grid.points.col(grid.index(m, n + 1)) +
              s * grid.points.col(grid.index(m + 1, n + 1)));
    }
  }
  return result;
}

} // namespace footpoint
