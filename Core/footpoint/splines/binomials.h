// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/knot_vector.h"

#include <vector>

namespace footpoint
{

/// The binomial coefficients C(n, 0) … C(n, n): exact while they are small, then to a few
/// roundings.
inline std::vector<double> binomials(int n)
{
  std::vector<double> row{ 1.0 };
  for (int k = 1; k <= n; ++k)
  {
    row.push_back(row.back() * (n - k + 1) / k);
  }
  return row;
}

/// The same for all degrees of splines, without memory of its own.
struct BinomialTable
{
  double value[kMaximumDegree + 1][kMaximumDegree + 1] = {};

  constexpr BinomialTable()
  {
    for (int n = 0; n <= kMaximumDegree; ++n)
    {
      this->value[n][0] = 1.0;
      for (int k = 1; k <= n; ++k)
      {
        this->value[n][k] = this->value[n - 1][k - 1] + this->value[n - 1][k];
      }
    }
  }
};
inline constexpr BinomialTable kBinomials;

} // namespace footpoint
