// SPDX-License-Identifier: BSD-3-Clause

#include "Oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oracle
{

template <int N>
Spline<N>::Spline(const std::array<int, N>& degrees,
  const std::array<std::vector<double>, N>& knots,
  const Eigen::Matrix<double, 3, Eigen::Dynamic>& control_points, const Eigen::VectorXd& weights)
  : Degrees(degrees)
  , Positions(control_points.cast<Real>())
  , Weights(Eigen::Matrix<Real, Eigen::Dynamic, 1>::Ones(control_points.cols()))
{
  for (int i = 0; i < N; ++i)
  {
    this->Knots[i].assign(knots[i].begin(), knots[i].end());
  }
  if (weights.size() > 0)
  {
    this->Weights = weights.cast<Real>();
  }
}

template <int N>
Eigen::Matrix<Real, 4, 1> Spline<N>::homogeneous(Eigen::Index k) const
{
  const Real w = this->Weights[k];
  return { w * this->Positions(0, k), w * this->Positions(1, k), w * this->Positions(2, k), w };
}

template <int N>
Real Spline<N>::size() const
{
  return (this->Positions.rowwise().maxCoeff() - this->Positions.rowwise().minCoeff()).norm();
}

template <int N>
std::vector<int> Spline<N>::spans(int i) const
{
  std::vector<int> all;
  for (int k = this->Degrees[i]; k < this->count(i); ++k)
  {
    if (this->Knots[i][k] < this->Knots[i][k + 1])
    {
      all.push_back(k);
    }
  }
  return all;
}

template <int N>
int Spline<N>::span(int i, Real t, bool left) const
{
  const std::vector<int> all = this->spans(i);
  int found = all.front();
  for (const int k : all)
  {
    if (left ? this->Knots[i][k] < t : this->Knots[i][k] <= t)
    {
      found = k;
    }
  }
  return found;
}

template <int N>
Vector Spline<N>::evaluate(const Spans& span, const Parameters& t) const
{
  const std::vector<Real> u = this->basis(0, span[0], t[0]);
  const std::vector<Real> v =
    N == 1 ? std::vector<Real>{ 1.0L } : this->basis(N - 1, span[N - 1], t[N - 1]);
  const int row = N == 1 ? 0 : span[N - 1] - this->Degrees[N - 1];
  Vector sum = Vector::Zero();
  Real weight = 0.0L;
  for (std::size_t j = 0; j < v.size(); ++j)
  {
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      const Eigen::Index at = (row + static_cast<int>(j)) * this->count(0) + span[0] -
        this->Degrees[0] + static_cast<int>(i);
      const Real factor = u[i] * v[j] * this->Weights[at];
      sum += factor * this->Positions.col(at);
      weight += factor;
    }
  }
  return sum / weight;
}

template <int N>
Vector Spline<N>::point(const Parameters& t, const std::array<bool, N>& left) const
{
  Spans spans;
  for (int i = 0; i < N; ++i)
  {
    spans[i] = this->span(i, t[i], left[i]);
  }
  return this->evaluate(spans, t);
}

template <int N>
std::vector<Real> Spline<N>::basis(int direction, int k, Real t) const
{
  const std::vector<Real>& knots = this->Knots[direction];
  const int p = this->Degrees[direction];
  std::vector<Real> values(p + 2, 0.0L); // entry j is N_{k − p + j, q}
  values[p] = 1.0L;
  for (int q = 1; q <= p; ++q)
  {
    for (int j = p - q; j <= p; ++j)
    {
      const int i = k - p + j;
      Real value = 0.0L;
      if (values[j] != 0.0L)
      {
        value += (t - knots[i]) / (knots[i + q] - knots[i]) * values[j];
      }
      if (values[j + 1] != 0.0L)
      {
        value += (knots[i + q + 1] - t) / (knots[i + q + 1] - knots[i + 1]) * values[j + 1];
      }
      values[j] = value;
    }
  }
  values.pop_back();
  return values;
}

Vector extrapolated(const std::function<Vector(Real)>& difference, Real step)
{
  constexpr int kLevels = 8;
  std::array<std::array<Vector, kLevels>, kLevels> table;
  Vector best = Vector::Zero();
  Real error = std::numeric_limits<Real>::infinity();
  for (int i = 0; i < kLevels; ++i, step /= 2.0L)
  {
    table[i][0] = difference(step);
    Real factor = 4.0L;
    for (int j = 1; j <= i; ++j, factor *= 4.0L)
    {
      table[i][j] = (factor * table[i][j - 1] - table[i - 1][j - 1]) / (factor - 1.0L);
      const Real change = std::max(
        (table[i][j] - table[i][j - 1]).norm(), (table[i][j] - table[i - 1][j - 1]).norm());
      if (change < error)
      {
        error = change;
        best = table[i][j];
      }
    }
  }
  return best;
}

template <int N>
Vector derivative(const Spline<N>& geometry, const typename Spline<N>::Spans& spans,
  const typename Spline<N>::Parameters& t, const std::array<int, N>& orders, Real step)
{
  static const std::array<std::vector<Real>, 4> stencils{ { { 0, 1, 0 }, { -0.5L, 0, 0.5L },
    { 1, -2, 1 }, { -0.5L, 1, 0, -1, 0.5L } } };
  const auto difference = [&](Real fraction)
  {
    std::array<Real, N> h;
    Real scale = 1.0L;
    for (int i = 0; i < N; ++i)
    {
      h[i] = fraction * (geometry.knot(i, spans[i] + 1) - geometry.knot(i, spans[i]));
      scale *= std::pow(h[i], static_cast<Real>(orders[i]));
    }
    const std::vector<Real>& su = stencils[orders[0]];
    const std::vector<Real>& sv = N == 1 ? std::vector<Real>{ 1 } : stencils[orders[N - 1]];
    Vector sum = Vector::Zero();
    for (std::size_t b = 0; b < sv.size(); ++b)
    {
      for (std::size_t a = 0; a < su.size(); ++a)
      {
        auto place = t;
        if (N > 1)
        {
          place[N - 1] += (static_cast<Real>(b) - static_cast<Real>(sv.size() / 2)) * h[N - 1];
        }
        place[0] += (static_cast<Real>(a) - static_cast<Real>(su.size() / 2)) * h[0];
        const Real factor = su[a] * sv[b];
        if (factor != 0.0L)
        {
          sum += factor * geometry.evaluate(spans, place);
        }
      }
    }
    return Vector(sum / scale);
  };
  return extrapolated(difference, step);
}

template class Spline<1>;
template class Spline<2>;
template Vector derivative<1>(const Spline<1>&, const Spline<1>::Spans&,
  const Spline<1>::Parameters&, const std::array<int, 1>&, Real);
template Vector derivative<2>(const Spline<2>&, const Spline<2>::Spans&,
  const Spline<2>::Parameters&, const std::array<int, 2>&, Real);

} // namespace oracle
