// SPDX-License-Identifier: BSD-3-Clause

#include "FastSpline.h"

#include <algorithm>

namespace oracle
{

template <int N>
FastSpline<N>::FastSpline(const Spline<N>& spline)
{
  Eigen::Index total = 1;
  for (int i = 0; i < N; ++i)
  {
    this->Degrees[i] = spline.degree(i);
    this->Counts[i] = spline.count(i);
    total *= this->Counts[i];
    for (int k = 0; k < this->Counts[i] + this->Degrees[i] + 1; ++k)
    {
      this->Knots[i].push_back(spline.knot(i, k));
    }
    for (int k = this->Degrees[i]; k < this->Counts[i]; ++k)
    {
      if (this->Knots[i][k] < this->Knots[i][k + 1])
      {
        this->Spans[i].push_back(k);
      }
    }
  }
  for (Eigen::Index k = 0; k < total; ++k)
  {
    this->Control.push_back(spline.homogeneous(k));
  }
}

template <int N>
std::vector<Real> FastSpline<N>::breaks(int i) const
{
  std::vector<Real> all;
  for (const int k : this->Spans[i])
  {
    all.push_back(this->Knots[i][k]);
  }
  all.push_back(this->upper(i));
  return all;
}

template <int N>
Vector FastSpline<N>::point(const Parameters& t, const Sides& left) const
{
  std::array<int, N> span;
  std::array<std::array<Real, kMost + 1>, N> basis;
  for (int i = 0; i < N; ++i)
  {
    span[i] = this->span(i, t[i], left[i]);
    this->evaluate_basis(i, span[i], t[i], basis[i]);
  }
  Eigen::Matrix<Real, 4, 1> sum = Eigen::Matrix<Real, 4, 1>::Zero();
  for (int b = 0; b <= (N > 1 ? this->Degrees[N - 1] : 0); ++b)
  {
    Eigen::Index at = span[0] - this->Degrees[0];
    Real factor = 1.0L;
    if constexpr (N > 1)
    {
      at += static_cast<Eigen::Index>(span[1] - this->Degrees[1] + b) * this->Counts[0];
      factor = basis[1][b];
    }
    for (int a = 0; a <= this->Degrees[0]; ++a)
    {
      sum += factor * basis[0][a] * this->Control[at + a];
    }
  }
  return sum.template head<3>() / sum[3];
}

template <int N>
int FastSpline<N>::span(int i, Real t, bool left) const
{
  const std::vector<int>& all = this->Spans[i];
  const std::vector<Real>& knots = this->Knots[i];
  const auto after = left
    ? std::lower_bound(all.begin() + 1, all.end(), t, [&](int k, Real at) { return knots[k] < at; })
    : std::upper_bound(
        all.begin() + 1, all.end(), t, [&](Real at, int k) { return at < knots[k]; });
  return *(after - 1);
}

template <int N>
void FastSpline<N>::evaluate_basis(int i, int k, Real t, std::array<Real, kMost + 1>& values) const
{
  const std::vector<Real>& knots = this->Knots[i];
  std::array<Real, kMost + 1> left;
  std::array<Real, kMost + 1> right;
  values[0] = 1.0L;
  for (int q = 1; q <= this->Degrees[i]; ++q)
  {
    left[q] = t - knots[k + 1 - q];
    right[q] = knots[k + q] - t;
    Real saved = 0.0L;
    for (int r = 0; r < q; ++r)
    {
      const Real part = values[r] / (right[r + 1] + left[q - r]);
      values[r] = saved + right[r + 1] * part;
      saved = left[q - r] * part;
    }
    values[q] = saved;
  }
}

template class FastSpline<1>;
template class FastSpline<2>;

} // namespace oracle
