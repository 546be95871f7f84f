// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/curve_samples.h"

#include "footpoint/common/errors.h"
#include "footpoint/model/evaluation.h"
#include "footpoint/tessellation/derivative_bounds.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

constexpr int kDeepest = 50;
constexpr double kFewParts = 4.0;

/// A smooth part of a curve, of one or several knot spans.
class SmoothPart
{
public:
  SmoothPart(const Curve& curve, const SamplingRule& rule, std::vector<double> knots)
    : Base(curve)
    , Rule(rule)
    , Knots(std::move(knots))
  {
    for (std::size_t k = 0; k + 1 < this->Knots.size(); ++k)
    {
      this->Bounds.push_back(second_derivative_bound(curve, this->Knots[k], this->Knots[k + 1]));
      if (rule.adaptive && !std::isfinite(this->Bounds.back()))
      {
        throw GeometryError(GeometryDefect::Format, "its derivatives are too large for numbers");
      }
    }
  }

  /// Appends all but the first place.
  void sample(double from, double to, int depth, std::vector<CurvePlace>& places) const
  {
    const auto first = std::upper_bound(this->Knots.begin(), this->Knots.end(), from);
    const auto last = std::lower_bound(this->Knots.begin(), this->Knots.end(), to);
    const double chord = this->chord(from, to);
    const double angle = this->angle(from, to);
    // Not by their ratio: a curve that is a point has no size, and so a tolerance of 0.
    if (depth >= kDeepest || (chord <= this->Rule.tolerance && angle <= 1.0))
    {
      places.push_back({ to, Side::Left });
      return;
    }
    std::vector<double> cuts{ from };
    if (first < last) // a knot near the middle
    {
      const double middle = from + 0.5 * (to - from);
      auto knot = std::lower_bound(first, last, middle);
      knot =
        knot == last || (knot != first && middle - knot[-1] < *knot - middle) ? knot - 1 : knot;
      cuts.push_back(*knot);
    }
    else
    {
      const double wanted =
        std::max({ 2.0, std::ceil(std::sqrt(chord / this->Rule.tolerance)), std::ceil(angle) });
      const double parts = wanted <= kFewParts ? wanted : 2.0;
      for (double i = 1.0; i < parts; i += 1.0)
      {
        cuts.push_back(from + (to - from) * (i / parts));
      }
    }
    cuts.push_back(to);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      this->sample(cuts[k], cuts[k + 1], depth + 1, places);
    }
  }

private:
  /// Bound of the distance from a chord: of one span by its own part, of several by them all.
  double chord(double from, double to) const
  {
    const auto first = std::upper_bound(this->Knots.begin(), this->Knots.end(), from) - 1;
    const auto last = std::lower_bound(this->Knots.begin(), this->Knots.end(), to);
    double second = 0.0;
    if (last - first == 1)
    {
      second = second_derivative_bound(this->Base, from, to);
    }
    for (auto k = first; last - first > 1 && k != last; ++k)
    {
      second = std::max(second, this->Bounds[static_cast<std::size_t>(k - this->Knots.begin())]);
    }
    return second * (to - from) * (to - from) / 8.0;
  }

  /// Between the tangents at both ends, as a part of what is allowed.
  double angle(double from, double to) const
  {
    const Sides<1> right(Side::Right);
    const Sides<1> left(Side::Left);
    const Parameter<1> a(from);
    const Parameter<1> b(to);
    const bool counts = this->Rule.angle > 0.0 &&
      (this->Base.jet(a, right, 0).point - this->Base.jet(b, left, 0).point).norm() >
        this->Rule.tolerance;
    return counts
      ? angle_between(unit_tangent(this->Base, a, right), unit_tangent(this->Base, b, left)) /
        this->Rule.angle
      : 0.0;
  }

  const Curve& Base;
  const SamplingRule& Rule;
  std::vector<double> Knots;
  std::vector<double> Bounds;
};

} // namespace

std::vector<std::vector<CurvePlace>> curve_samples(const Curve& curve, const SamplingRule& rule)
{
  const std::vector<double>& spans = curve.direction(0).spans;
  const std::vector<Break>& breaks = curve.direction(0).breaks;
  std::vector<std::vector<CurvePlace>> lines(1);
  lines.back().push_back({ 0.0, Side::Right });
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
  {
    const auto first = std::lower_bound(spans.begin(), spans.end(), breaks[k].at);
    const auto last = std::upper_bound(spans.begin(), spans.end(), breaks[k + 1].at);
    const std::vector<double> knots(first, last);
    if (rule.adaptive)
    {
      SmoothPart(curve, rule, knots).sample(knots.front(), knots.back(), 0, lines.back());
    }
    for (std::size_t i = 0; !rule.adaptive && i + 1 < knots.size(); ++i)
    {
      for (int part = 1; part <= rule.resolution; ++part)
      {
        const double step = (knots[i + 1] - knots[i]) / rule.resolution;
        const double t = part == rule.resolution ? knots[i + 1] : knots[i] + part * step;
        lines.back().push_back({ t, Side::Left });
      }
    }
    if (breaks[k + 1].gap && k + 2 < breaks.size())
    {
      lines.push_back({ { breaks[k + 1].at, Side::Right } });
    }
  }
  return lines;
}

} // namespace footpoint
