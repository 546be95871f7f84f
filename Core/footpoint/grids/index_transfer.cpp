// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/index_transfer.h"

#include <algorithm>
#include <vector>

namespace footpoint
{
namespace
{

/// A point of a line of samples as a weighted sum of up to four of them.
struct Mixture
{
  int first;
  std::vector<double> weights;
};

/// Place k of `to` even places on a line of `from` samples, by Lagrange's cubic (less on shorter
/// lines).
Mixture mixture(int k, int from, int to)
{
  // Whole numbers, so that a sample that is met gets the weight 1 exactly.
  const long long numerator = static_cast<long long>(k) * (from - 1);
  const int interval = std::min(int(numerator / (to - 1)), from - 2);
  const int size = std::min(4, from);
  Mixture result{ std::clamp(interval - 1, 0, from - size),
    std::vector<double>(std::size_t(size)) };
  for (int m = 0; m < size; ++m)
  {
    double weight = 1.0;
    for (int other = 0; other < size; ++other)
    {
      if (other != m)
      {
        const long long sample = static_cast<long long>(result.first + other) * (to - 1);
        weight *= double(numerator - sample) / (double(to - 1) * (m - other));
      }
    }
    result.weights[std::size_t(m)] = weight;
  }
  return result;
}

} // namespace

Grid resampled(const Grid& grid, const std::array<int, 2>& count)
{
  std::vector<Mixture> across;
  for (int i = 0; i < count[0]; ++i)
  {
    across.push_back(mixture(i, grid.count[0], count[0]));
  }
  Grid result{ count, Points::Zero(3, Eigen::Index(count[0]) * count[1]) };
  for (int j = 0; j < count[1]; ++j)
  {
    const Mixture along = mixture(j, grid.count[1], count[1]);
    for (int i = 0; i < count[0]; ++i)
    {
      const Mixture& line = across[std::size_t(i)];
      for (std::size_t n = 0; n < along.weights.size(); ++n)
      {
        for (std::size_t m = 0; m < line.weights.size(); ++m)
        {
          result.points.col(result.index(i, j)) += along.weights[n] * line.weights[m] *
            grid.points.col(grid.index(line.first + int(m), along.first + int(n)));
        }
      }
    }
  }
  return result;
}

} // namespace footpoint
