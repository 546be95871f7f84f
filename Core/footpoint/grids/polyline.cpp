// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/polyline.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{

namespace
{

/// An index that misses a whole number by no more than this came from rounding (i / n · m).
constexpr double kIndexRounding = 1e-12;

/// The point at `fraction` between two columns; both ends bit for bit.
Vector3 between(const Points& polyline, Eigen::Index first, double fraction)
{
  if (fraction <= 0.0)
  {
    return polyline.col(first);
  }
  if (fraction >= 1.0)
  {
    return polyline.col(first + 1);
  }
  return polyline.col(first) + fraction * (polyline.col(first + 1) - polyline.col(first));
}

} // namespace

Eigen::VectorXd even_spacing(int count)
{
  Eigen::VectorXd numbers(count);
  for (int i = 0; i < count; ++i)
  {
    numbers[i] = static_cast<double>(i) / (count - 1);
  }
  return numbers;
}

Eigen::VectorXd normalized_arc_length(const Points& polyline)
{
  const Eigen::Index count = polyline.cols();
  Eigen::VectorXd length(count);
  length[0] = 0.0;
  for (Eigen::Index i = 1; i < count; ++i)
  {
    length[i] = length[i - 1] + (polyline.col(i) - polyline.col(i - 1)).norm();
  }
  const double whole = length[count - 1];
  if (!(whole > 0.0))
  {
    return even_spacing(static_cast<int>(count));
  }
  return length / whole;
}

Points sample_by_arc_length(const Points& polyline, const Eigen::VectorXd& at)
{
  const Eigen::VectorXd length = normalized_arc_length(polyline);
  Points samples(3, at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k)
  {
    if (at[k] <= 0.0 || at[k] >= 1.0)
    {
      samples.col(k) = polyline.col(at[k] <= 0.0 ? 0 : polyline.cols() - 1);
      continue;
    }
    // The segment that ends behind `at`: it has a length, repeated points are passed over.
    const Eigen::Index next =
      std::upper_bound(length.begin(), length.end(), at[k]) - length.begin();
    const Eigen::Index first = std::min(next, polyline.cols() - 1) - 1;
    const double span = length[first + 1] - length[first];
    samples.col(k) = between(polyline, first, (at[k] - length[first]) / span);
  }
  return samples;
}

Points sample_by_index(const Points& polyline, const Eigen::VectorXd& at)
{
  const Eigen::Index segments = polyline.cols() - 1;
  Points samples(3, at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k)
  {
    double index = std::clamp(at[k], 0.0, 1.0) * static_cast<double>(segments);
    const double whole = std::round(index);
    if (std::abs(index - whole) <= kIndexRounding * static_cast<double>(segments))
    {
      index = whole;
    }
    const Eigen::Index first = std::min(static_cast<Eigen::Index>(index), segments - 1);
    samples.col(k) = between(polyline, first, index - static_cast<double>(first));
  }
  return samples;
}

} // namespace footpoint
