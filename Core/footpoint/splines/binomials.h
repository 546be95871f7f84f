// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace footpoint
{

/// The binomial coefficients C(n, 0) … C(n, n): exact while they are small, then to a few roundings.
inline std::vector<double> binomials(int n)
{
  std::vector<double> row{ 1.0 };
  for (int k = 1; k <= n; ++k)
  {
    row.push_back(row.back() * (n - k + 1) / k);
  }
  return row;
}

} // namespace footpoint
