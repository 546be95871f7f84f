// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/winding_index.h"

#include "footpoint/splines/binomials.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{

namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Steps that suffice for any bracket of doubles in [0, 1].
constexpr int kMostSteps = 200;

} // namespace

WindingIndex::WindingIndex(const std::vector<IndexedArc>& arcs,
  const std::array<double, 2>& length, const std::array<double, 2>& margin, int base)
  : Length(length)
  , Margin(margin)
  , Base(base)
{
  for (const IndexedArc& source : arcs)
  {
    const bool forward = source.end[0][0] <= source.end[1][0];
    const Eigen::Vector2d& left = source.end[forward ? 0 : 1];
    const Eigen::Vector2d& right = source.end[forward ? 1 : 0];
    Arc arc;
    arc.low_a = left[0];
    arc.high_a = right[0] == length[0] ? kInfinity : right[0];
    arc.low_b = std::min(left[1], right[1]);
    arc.high_b = std::max(left[1], right[1]);
    if (arc.high_b == 0.0 && arc.low_b == 0.0)
    {
      arc.low_b = -kInfinity;
      arc.high_b = -kInfinity;
    }
    arc.width = right[0] - left[0];
    arc.height = right[1] - left[1];
    arc.sign = forward ? source.sign : -source.sign;
    arc.degree = static_cast<std::int32_t>(source.control.cols()) - 1;
    arc.first = static_cast<std::uint32_t>(this->Coefficients.size());
    if (arc.degree > 1)
    {
      const std::vector<double> binomial = binomials(arc.degree);
      for (int i = 0; i <= arc.degree; ++i)
      {
        const auto point = source.control.col(forward ? i : arc.degree - i);
        this->Coefficients.push_back(binomial[i] * (point[0] - left[0] * point[2]));
        this->Coefficients.push_back(binomial[i] * (point[1] - left[1] * point[2]));
        this->Coefficients.push_back(binomial[i] * point[2]);
      }
    }
    this->Arcs.push_back(arc);
  }
}

bool WindingIndex::is_above(const Arc& arc, double a, double b) const
{
  const bool rising = arc.height >= 0.0;
  const double x = a - arc.low_a;
  const double y = b - (rising ? arc.low_b : arc.high_b);
  if (arc.degree == 1)
  {
    return y * arc.width > x * arc.height;
  }
  const double* const coefficients = this->Coefficients.data() + arc.first;
  double low = 0.0;
  double high = 1.0;
  double below = -x; // arc less point in a, at low and high
  double above = arc.width - x;
  double t = x / arc.width;
  int last_side = 0;
  bool is_over = false;
  for (int step = 0; step < kMostSteps && t > low && t < high; ++step)
  {
    const double s = 1.0 - t;
    double power = 1.0;
    double sum_x = coefficients[0];
    double sum_y = coefficients[1];
    double weight = coefficients[2];
    for (int i = 1; i <= arc.degree; ++i)
    {
      power *= t;
      sum_x = sum_x * s + power * coefficients[3 * i];
      sum_y = sum_y * s + power * coefficients[3 * i + 1];
      weight = weight * s + power * coefficients[3 * i + 2];
    }
    const double to_arc = sum_x - x * weight;
    is_over = sum_y < y * weight;
    if (to_arc == 0.0)
    {
      return is_over;
    }
    // The arc at the point's a lies beyond t: on a rising arc higher than at t, on a falling lower.
    const bool beyond = to_arc < 0.0;
    if (is_over != (beyond == rising))
    {
      return is_over;
    }
    if (beyond)
    {
      low = t;
      below = to_arc / weight;
      above *= last_side == -1 ? 0.5 : 1.0;
      last_side = -1;
    }
    else
    {
      high = t;
      above = to_arc / weight;
      below *= last_side == 1 ? 0.5 : 1.0;
      last_side = 1;
    }
    t = low + (high - low) * (below / (below - above));
    if (step % 3 == 2 || !(t > low && t < high))
    {
      t = low + 0.5 * (high - low);
    }
  }
  return is_over;
}

int WindingIndex::winding(double a, double b) const
{
  a = std::clamp(a, 0.0, this->Length[0]);
  b = std::clamp(b, 0.0, this->Length[1]);
  int count = this->Base;
  for (const Arc& arc : this->Arcs)
  {
    if (a >= arc.low_a && a < arc.high_a && b > arc.low_b && arc.width > 0.0 &&
      (b > arc.high_b || this->is_above(arc, a, b)))
    {
      count += arc.sign;
    }
  }
  return count;
}

bool WindingIndex::crossed(
  const std::array<double, 2>& lower, const std::array<double, 2>& upper) const
{
  for (const Arc& arc : this->Arcs)
  {
    const double high_a = arc.low_a + arc.width;
    if (lower[0] <= high_a + this->Margin[0] && upper[0] >= arc.low_a - this->Margin[0] &&
      lower[1] <= arc.high_b + this->Margin[1] && upper[1] >= arc.low_b - this->Margin[1])
    {
      return true;
    }
  }
  return false;
}

} // namespace footpoint
