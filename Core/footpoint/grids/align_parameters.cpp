// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/curve_network.h"

#include "footpoint/splines/interpolation.h"
#include "footpoint/splines/validation.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Points a span of the original that a reparametrized curve is refitted through.
constexpr int kSamplesPerSpan = 12;
constexpr int kLeastSamples = 101;

/// A monotone piecewise cubic through (x, y) (F. N. Fritsch and R. E. Carlson 1980).
class MonotoneCubic
{
public:
  MonotoneCubic(std::vector<double> x, std::vector<double> y)
    : X(std::move(x))
    , Y(std::move(y))
    , Slope(this->X.size())
  {
    const std::size_t n = this->X.size();
    for (std::size_t k = 1; k + 1 < n; ++k)
    {
      const double before = this->secant(k - 1);
      const double after = this->secant(k);
      this->Slope[k] = 2.0 * before * after / (before + after); // rising data: both are positive
    }
    this->Slope[0] = this->secant(0);
    this->Slope[n - 1] = this->secant(n - 2);
  }

  double operator()(double at) const
  {
    const auto above = std::upper_bound(this->X.begin(), this->X.end(), at);
    const auto k = std::clamp<std::ptrdiff_t>(
      above - this->X.begin() - 1, 0, static_cast<std::ptrdiff_t>(this->X.size()) - 2);
    const double length = this->X[k + 1] - this->X[k];
    const double t = (at - this->X[k]) / length;
    const double s = 1.0 - t;
    return this->Y[k] * s * s * (1.0 + 2.0 * t) + this->Y[k + 1] * t * t * (1.0 + 2.0 * s) +
      length * (this->Slope[k] * t * s * s - this->Slope[k + 1] * t * t * s);
  }

private:
  double secant(std::size_t k) const
  {
    return (this->Y[k + 1] - this->Y[k]) / (this->X[k + 1] - this->X[k]);
  }

  std::vector<double> X;
  std::vector<double> Y;
  std::vector<double> Slope;
};

/// The curve with its parameter t replaced by change(t), refitted; the largest change of its
/// points, seen between the samples, goes into `error`.
PiecewisePolynomial reparametrized(const PiecewisePolynomial& curve, const MonotoneCubic& change,
  const std::vector<double>& keep, double& error)
{
  const int spans = static_cast<int>(curve.breakpoints().size()) - 1;
  const int count = std::max(kLeastSamples, kSamplesPerSpan * spans);
  std::vector<double> at;
  for (int k = 0; k < count; ++k)
  {
    at.push_back(k / (count - 1.0));
  }
  at.insert(at.end(), keep.begin(), keep.end());
  std::sort(at.begin(), at.end());
  // Samples next to a meeting give way to it.
  const double near = 0.25 / (count - 1.0);
  std::vector<double> thinned;
  for (const double t : at)
  {
    const bool kept = t == 0.0 || t == 1.0 || std::find(keep.begin(), keep.end(), t) != keep.end();
    const bool crowded =
      std::any_of(keep.begin(), keep.end(), [&](double k) { return std::abs(k - t) < near; });
    if ((kept || !crowded) && (thinned.empty() || t > thinned.back()))
    {
      thinned.push_back(t);
    }
  }
  Eigen::MatrixXd points(3, thinned.size());
  for (std::size_t k = 0; k < thinned.size(); ++k)
  {
    points.col(k) = curve.value(change(thinned[k]));
  }
  const KnotVector knots = averaged_knots(thinned, 3);
  const PiecewisePolynomial result =
    PiecewisePolynomial::spline(knots, interpolate(knots, thinned, points));
  for (std::size_t k = 0; k + 1 < thinned.size(); ++k)
  {
    const double middle = 0.5 * (thinned[k] + thinned[k + 1]);
    error = std::max(error, (result.value(middle) - curve.value(change(middle))).norm());
  }
  return result;
}

} // namespace

std::vector<double> align_parameters(CurveFamily& family, const std::string& name, double size,
  const GordonOptions& options, double& error)
{
  const Eigen::Index count = family.meetings.rows();
  std::vector<double> common;
  for (Eigen::Index j = 0; j < family.meetings.cols(); ++j)
  {
    const double mean = family.meetings.col(j).mean();
    // The ends of curves are ends of the surface.
    const bool end = (family.meetings.col(j).array() - std::round(mean)).abs().maxCoeff() < 1e-9;
    common.push_back(end ? std::round(mean) : mean);
  }
  double worst = 0.0;
  Eigen::Index worst_curve = 0;
  for (Eigen::Index k = 0; k < count; ++k)
  {
    for (std::size_t j = 0; j < common.size(); ++j)
    {
      const double off =
        (family.curves[k].value(family.meetings(k, j)) - family.curves[k].value(common[j])).norm();
      worst_curve = off > worst ? k : worst_curve;
      worst = std::max(worst, off);
    }
  }
  if (worst <= 1e-9 * size)
  {
    return common;
  }
  if (!options.reparametrize)
  {
    throw BoundaryError(BoundaryDefect::Branch,
      "the parameters at which the " + name + "s are met differ between them, on " + name + " " +
        std::to_string(worst_curve) + " (in order) by " + to_text(worst) +
        " in space; reparametrization is off");
  }
  for (Eigen::Index k = 0; k < count; ++k)
  {
    std::vector<double> from{ 0.0 };
    std::vector<double> to{ 0.0 };
    for (std::size_t j = 0; j < common.size(); ++j)
    {
      if (common[j] > 0.0 && common[j] < 1.0)
      {
        from.push_back(common[j]);
        to.push_back(family.meetings(k, j));
      }
    }
    from.push_back(1.0);
    to.push_back(1.0);
    family.curves[k] = reparametrized(family.curves[k], MonotoneCubic(from, to), common, error);
  }
  if (error > options.reparametrization_tolerance * size)
  {
    throw BoundaryError(BoundaryDefect::Branch,
      "reparametrization changes the " + name + "s by " + to_text(error) + "; allowed is " +
        to_text(options.reparametrization_tolerance * size));
  }
  return common;
}

} // namespace footpoint
