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

/// Up to so many arcs one bucket is faster than several.
constexpr std::size_t kOneBucket = 12;

/// Arcs that are compared with a box before it is given up as crossed: about 200 ns of work, as
/// most are told apart by their boxes.
constexpr int kMostComparisons = 128;

struct Sums
{
  double x;
  double y;
  double weight;
};

/// The sums over Bernstein polynomials, all of positive products in the weight: nothing cancels.
Sums evaluate(const double* coefficients, int degree, double t)
{
  const double s = 1.0 - t;
  double power = 1.0;
  Sums sums{ coefficients[0], coefficients[1], coefficients[2] };
  for (int i = 1; i <= degree; ++i)
  {
    power *= t;
    sums.x = sums.x * s + power * coefficients[3 * i];
    sums.y = sums.y * s + power * coefficients[3 * i + 1];
    sums.weight = sums.weight * s + power * coefficients[3 * i + 2];
  }
  return sums;
}

std::uint32_t bucket_of(double a, double buckets_per_length, std::uint32_t last)
{
  const double scaled = a * buckets_per_length;
  return scaled >= last ? last : static_cast<std::uint32_t>(std::max(scaled, 0.0));
}

} // namespace

WindingIndex::WindingIndex(const std::vector<IndexedArc>& arcs, const std::array<double, 2>& length,
  const std::array<double, 2>& margin, int base)
  : Length(length)
  , Margin(margin)
  , Base(base)
{
  std::vector<RayBox> boxes;
  for (const IndexedArc& arc : arcs)
  {
    const auto [low_a, high_a] = std::minmax(arc.end[0][0], arc.end[1][0]);
    const bool met = low_a < length[0] || (low_a == length[0] && high_a == low_a);
    if (met && high_a >= 0.0 && std::min(arc.end[0][1], arc.end[1][1]) <= length[1])
    {
      boxes.push_back(this->add_arc(arc));
    }
  }
  this->fill_buckets(boxes);
}

WindingIndex::RayBox WindingIndex::add_arc(const IndexedArc& source)
{
  const bool forward = source.end[0][0] <= source.end[1][0];
  const Eigen::Vector2d& left = source.end[forward ? 0 : 1];
  const Eigen::Vector2d& right = source.end[forward ? 1 : 0];
  Arc arc;
  arc.width = right[0] - left[0];
  arc.height = right[1] - left[1];
  arc.low_a = left[0];
  arc.low_b = std::min(left[1], right[1]);
  arc.high_b = std::max(left[1], right[1]);
  arc.on_border = (arc.width == 0.0 && (left[0] == 0.0 || left[0] == this->Length[0])) ||
    (arc.height == 0.0 && (left[1] == 0.0 || left[1] == this->Length[1]));
  arc.degree = static_cast<std::int16_t>(source.control.cols() - 1);
  arc.first = static_cast<std::uint32_t>(this->Coefficients.size());
  if (arc.width == 0.0 || arc.height == 0.0)
  {
    arc.degree = 1;
  }
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
  const bool last = right[0] == this->Length[0] && arc.width > 0.0;
  const bool at_start = arc.height == 0.0 && left[1] == 0.0;
  const RayBox box{ left[0], last ? kInfinity : right[0], at_start ? -kInfinity : arc.low_b,
    at_start ? -kInfinity : arc.high_b, forward ? source.sign : -source.sign,
    static_cast<std::uint32_t>(this->Arcs.size()) };
  this->Arcs.push_back(arc);
  return box;
}

int WindingIndex::level_of(const Arc& arc, int levels) const
{
  const double buckets = this->Length[0] / arc.width; // infinite where a is constant
  return buckets < 2.0 ? 0 : std::ilogb(std::min(buckets, std::ldexp(1.0, levels - 1)));
}

void WindingIndex::fill_buckets(const std::vector<RayBox>& boxes)
{
  int levels = 1;
  while (this->Arcs.size() > kOneBucket && (std::size_t(1) << (levels - 1)) < this->Arcs.size())
  {
    ++levels;
  }
  std::vector<std::vector<std::uint32_t>> arcs_of_level(levels);
  for (std::size_t k = 0; k < this->Arcs.size(); ++k)
  {
    arcs_of_level[this->level_of(this->Arcs[k], levels)].push_back(static_cast<std::uint32_t>(k));
  }
  for (int l = 0; l < levels; ++l)
  {
    if (arcs_of_level[l].empty())
    {
      continue;
    }
    const std::uint32_t count = std::uint32_t(1) << l;
    const Level level{ count / this->Length[0], count - 1,
      static_cast<std::uint32_t>(this->BucketStart.size()) };
    std::vector<std::array<std::uint32_t, 2>> placed; // bucket, arc
    for (const std::uint32_t k : arcs_of_level[l])
    {
      const Arc& arc = this->Arcs[k];
      const std::uint32_t first = bucket_of(arc.low_a, level.buckets_per_length, level.last);
      const std::uint32_t last =
        bucket_of(arc.low_a + arc.width, level.buckets_per_length, level.last);
      for (std::uint32_t bucket = first; bucket <= last; ++bucket)
      {
        placed.push_back({ { bucket, k } });
      }
    }
    std::sort(placed.begin(), placed.end());
    std::size_t next = 0;
    for (std::uint32_t bucket = 0; bucket < count; ++bucket)
    {
      this->BucketStart.push_back(static_cast<std::uint32_t>(this->Entries.size()));
      for (; next < placed.size() && placed[next][0] == bucket; ++next)
      {
        this->Entries.push_back(boxes[placed[next][1]]);
      }
    }
    this->BucketStart.push_back(static_cast<std::uint32_t>(this->Entries.size()));
    this->Levels.push_back(level);
  }
}

Eigen::Vector2d WindingIndex::point(std::size_t k, double t) const
{
  const Arc& arc = this->Arcs[k];
  const double left_b = arc.height < 0.0 ? arc.high_b : arc.low_b;
  if (arc.degree == 1)
  {
    return { arc.low_a + t * arc.width, left_b + t * arc.height };
  }
  const Sums sums = evaluate(this->Coefficients.data() + arc.first, arc.degree, t);
  return { arc.low_a + sums.x / sums.weight, left_b + sums.y / sums.weight };
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
  if (x <= 0.0 || x >= arc.width)
  {
    return y > (x <= 0.0 ? 0.0 : arc.height);
  }
  // The zero of arc less point in a: secants in a bracket (Illinois variant, M. Dowell and P.
  // Jarratt 1971) that is halved every third step; most points are told apart long before it is
  // found.
  double low = 0.0;
  double high = 1.0;
  double below = -x;
  double above = arc.width - x;
  double t = x / arc.width;
  int last_side = 0;
  bool is_over = false;
  t = t > low && t < high ? t : 0.5;
  for (int step = 0; step < kMostSteps && t > low && t < high; ++step)
  {
    const Sums sums = evaluate(this->Coefficients.data() + arc.first, arc.degree, t);
    const double to_arc = sums.x - x * sums.weight;
    is_over = sums.y < y * sums.weight;
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
      below = to_arc / sums.weight;
      above *= last_side == -1 ? 0.5 : 1.0;
      last_side = -1;
    }
    else
    {
      high = t;
      above = to_arc / sums.weight;
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
  int count = this->Base;
  for (const Level& level : this->Levels)
  {
    const std::uint32_t bucket = bucket_of(a, level.buckets_per_length, level.last);
    const std::uint32_t* start = this->BucketStart.data() + level.first + bucket;
    for (std::uint32_t entry = start[0]; entry < start[1]; ++entry)
    {
      // Without a branch between the comparisons: which of them fails cannot be foretold.
      const RayBox& box = this->Entries[entry];
      const bool met = (a >= box.low_a) & (a < box.high_a) & (b > box.low_b);
      if (met && (b > box.high_b || this->is_above(this->Arcs[box.arc], a, b)))
      {
        count += box.sign;
      }
    }
  }
  return count;
}

/// A box lies above a rising arc where its corner of large a and small b does, and so on.
bool WindingIndex::passes(
  const Arc& arc, const std::array<double, 2>& lower, const std::array<double, 2>& upper) const
{
  const double right = arc.low_a + arc.width;
  if (arc.on_border || lower[0] > right || upper[0] < arc.low_a || lower[1] > arc.high_b ||
    upper[1] < arc.low_b)
  {
    return false;
  }
  if (arc.width == 0.0 || arc.height == 0.0)
  {
    return true;
  }
  const bool rising = arc.height > 0.0;
  const double a_of_low_corner = rising ? upper[0] : lower[0];
  const double a_of_high_corner = rising ? lower[0] : upper[0];
  const bool box_above = a_of_low_corner > arc.low_a && a_of_low_corner < right &&
    lower[1] > arc.low_b && this->is_above(arc, a_of_low_corner, lower[1]);
  const bool box_below = a_of_high_corner > arc.low_a && a_of_high_corner < right &&
    upper[1] < arc.high_b && !this->is_above(arc, a_of_high_corner, upper[1]);
  return !box_above && !box_below;
}

bool WindingIndex::crossed(
  const std::array<double, 2>& lower, const std::array<double, 2>& upper) const
{
  const std::array<double, 2> low{ { lower[0] - this->Margin[0], lower[1] - this->Margin[1] } };
  const std::array<double, 2> high{ { upper[0] + this->Margin[0], upper[1] + this->Margin[1] } };
  int comparisons = 0;
  for (const Level& level : this->Levels)
  {
    const std::uint32_t first = bucket_of(low[0], level.buckets_per_length, level.last);
    const std::uint32_t last = bucket_of(high[0], level.buckets_per_length, level.last);
    const std::uint32_t* start = this->BucketStart.data() + level.first;
    const std::uint32_t end = start[last + 1];
    for (std::uint32_t entry = start[first]; entry < end; ++entry)
    {
      const RayBox& box = this->Entries[entry];
      const bool near = (low[0] <= box.high_a) & (high[0] >= box.low_a) & (low[1] <= box.high_b) &
        (high[1] >= box.low_b);
      if (++comparisons > kMostComparisons ||
        (near && this->passes(this->Arcs[box.arc], low, high)))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace footpoint
