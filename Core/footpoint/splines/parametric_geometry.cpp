// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/parametric_geometry.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{

namespace
{

/// Spans per direction that the mean speed looks at; more do not change it noticeably.
constexpr std::size_t kSpeedSpans = 16;

/// A parameter and the side it is approached from.
struct Sample
{
  double at;
  Side side;
};

/// `count` Chebyshev–Lobatto points of every span: what holds at them to a tolerance holds between
/// them to a small multiple of it, also at high degree (equidistant points would not do).
std::vector<Sample> chebyshev_samples(const std::vector<double>& spans, int count)
{
  const double pi = std::acos(-1.0);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i + 1 < spans.size(); ++i)
  {
    samples.push_back({ spans[i], Side::Right });
    for (int k = 1; k + 1 < count; ++k)
    {
      const double fraction = 0.5 - 0.5 * std::cos(pi * k / (count - 1));
      samples.push_back({ spans[i] + fraction * (spans[i + 1] - spans[i]), Side::Right });
    }
    samples.push_back({ spans[i + 1], Side::Left });
  }
  return samples;
}

/// Point of the side at the start (end = 0) or end (end = 1) of direction i.
template <int N>
Vector3 point_of_side(const ParametricGeometry<N>& geometry, int i, int end, const Sample& across)
{
  Parameter<N> t = Parameter<N>::Constant(across.at);
  Sides<N> sides = Sides<N>::Constant(across.side);
  t[i] = end == 0 ? 0.0 : geometry.direction(i).length;
  sides[i] = end == 0 ? Side::Right : Side::Left;
  return geometry.jet(t, sides, 0).point;
}

/// Gauss–Legendre points of order 3 in at most kSpeedSpans spans, and their weights.
std::vector<std::array<double, 2>> gauss_points(const std::vector<double>& spans)
{
  const double offset = std::sqrt(0.15);
  const std::array<std::array<double, 2>, 3> rule{ { { 0.5 - offset, 5.0 / 18.0 },
    { 0.5, 4.0 / 9.0 }, { 0.5 + offset, 5.0 / 18.0 } } };
  const std::size_t stride = (spans.size() - 2) / kSpeedSpans + 1;
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i + 1 < spans.size(); i += stride)
  {
    const double length = spans[i + 1] - spans[i];
    for (const auto& [fraction, weight] : rule)
    {
      points.push_back({ spans[i] + fraction * length, weight * length });
    }
  }
  return points;
}

/// Root mean squares of |S_i| over the domain.
template <int N>
std::array<double, N> mean_speeds(const ParametricGeometry<N>& geometry)
{
  const auto first = gauss_points(geometry.direction(0).spans);
  const auto second = N == 1 ? std::vector<std::array<double, 2>>{ { 0.0, 1.0 } }
                             : gauss_points(geometry.direction(N - 1).spans);
  // Squares are taken of numbers near 1, so that none over- or underflows.
  std::array<double, N> scale;
  for (int i = 0; i < N; ++i)
  {
    scale[i] = geometry.size() > 0.0 ? geometry.size() / geometry.direction(i).length : 1.0;
  }
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  double weight = 0.0;
  for (const auto& v : second)
  {
    for (const auto& u : first)
    {
      Parameter<N> t = Parameter<N>::Constant(v[0]);
      t[0] = u[0];
      const Jet<N> jet = geometry.jet(t, Sides<N>::Constant(Side::Right), 1);
      for (int i = 0; i < N; ++i)
      {
        sum[i] += u[1] * v[1] * (jet.first.col(i) / scale[i]).squaredNorm();
      }
      weight += u[1] * v[1];
    }
  }
  std::array<double, N> speeds;
  for (int i = 0; i < N; ++i)
  {
    speeds[i] = std::sqrt(sum[i] / weight) * scale[i];
  }
  return speeds;
}

} // namespace

template <int N>
Parameter<N> ParametricGeometry<N>::to_local(const Parameter<N>& parameter) const
{
  Parameter<N> local;
  for (int i = 0; i < N; ++i)
  {
    local[i] = parameter[i] - this->Directions[i].origin;
  }
  return local;
}

template <int N>
Parameter<N> ParametricGeometry<N>::to_domain(const Parameter<N>& local) const
{
  Parameter<N> parameter;
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Directions[i];
    // Subtracting and adding the origin rounds twice; on a gap the sum may lie on its other side.
    const auto knot = std::lower_bound(direction.spans.begin(), direction.spans.end(), local[i]);
    const bool on_knot =
      !direction.knots.empty() && knot != direction.spans.end() && *knot == local[i];
    parameter[i] =
      on_knot ? direction.knots[knot - direction.spans.begin()] : direction.origin + local[i];
  }
  return parameter;
}

template <int N>
Points ParametricGeometry<N>::recentre(const Points& points)
{
  const Vector3 lower = points.rowwise().minCoeff();
  const Vector3 extent = points.rowwise().maxCoeff() - lower;
  this->Size = extent.stableNorm();
  this->Centre = lower + 0.5 * extent;
  if (this->Size > 0.0)
  {
    // A centre with few digits, often 0, makes most of the subtractions exact.
    const double grain = std::ldexp(1.0, std::ilogb(this->Size) - 2);
    for (double& coordinate : this->Centre)
    {
      // Where the grain is below the coordinate's own rounding this changes nothing.
      coordinate = std::nearbyint(coordinate / grain) * grain;
    }
  }
  return points.colwise() - this->Centre;
}

template <int N>
void ParametricGeometry<N>::analyse(const std::array<int, N>& samples)
{
  const double tolerance = kClosureTolerance * this->Size;
  for (int i = 0; i < N; ++i)
  {
    Direction& direction = this->Directions[i];
    const int other = N - 1 - i;
    const std::vector<Sample> across = N == 1
      ? std::vector<Sample>{ { 0.0, Side::Right } }
      : chebyshev_samples(this->Directions[other].spans, samples[other]);

    direction.closed = std::all_of(across.begin(), across.end(),
      [&](const Sample& sample)
      {
        return (point_of_side(*this, i, 0, sample) - point_of_side(*this, i, 1, sample)).norm() <=
          tolerance;
      });
    for (int end = 0; end < 2 && N > 1; ++end)
    {
      const Vector3 first = point_of_side(*this, i, end, across.front());
      direction.collapsed[end] = std::all_of(across.begin(), across.end(),
        [&](const Sample& sample)
        { return (point_of_side(*this, i, end, sample) - first).norm() <= tolerance; });
    }
  }
  const std::array<double, N> speeds = mean_speeds(*this);
  for (int i = 0; i < N; ++i)
  {
    this->Directions[i].speed = speeds[i];
  }
}

template class ParametricGeometry<1>;
template class ParametricGeometry<2>;

} // namespace footpoint
