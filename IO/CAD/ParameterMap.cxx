// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterMap.h"

#include <algorithm>
#include <cmath>

namespace footpoint::cad
{

namespace
{

/// A quarter turn may come out larger by rounding.
constexpr double kLongestArc = 1.5707963267948966 * (1.0 + 1e-9);

} // namespace

double ParameterMap::operator()(double parameter) const
{
  if (this->is_identity())
  {
    return parameter;
  }
  const auto after = std::upper_bound(this->Knots.begin() + 1, this->Knots.end() - 1, parameter);
  const double first = *(after - 1);
  const double half = 0.5 * (*after - first);
  const double middle = first + half;
  const double offset = 0.5 * (parameter - middle);
  const double ratio = this->What == Kind::Arcs ? std::tan(offset) / std::tan(0.5 * half)
                                                : std::tanh(offset) / std::tanh(0.5 * half);
  // Exact at the arc's ends, so that curves that meet there still do.
  return parameter == first ? first : parameter == *after ? *after : middle + half * ratio;
}

std::vector<double> ParameterMap::kinks() const
{
  if (this->Knots.size() < 3)
  {
    return {};
  }
  return std::vector<double>(this->Knots.begin() + 1, this->Knots.end() - 1);
}

std::vector<double> arc_knots(double first, double last)
{
  const int arcs = std::max(1, static_cast<int>(std::ceil((last - first) / kLongestArc)));
  std::vector<double> knots(static_cast<std::size_t>(arcs) + 1);
  for (int i = 0; i <= arcs; ++i)
  {
    knots[static_cast<std::size_t>(i)] = first + (last - first) * i / arcs;
  }
  knots.back() = last;
  return knots;
}

} // namespace footpoint::cad
