// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The judge's splines, evaluated without allocation: for oracles that evaluate millions of times.
/// Shares no line with the core. (L. Piegl and W. Tiller, The NURBS Book, algorithm A2.2.)

#include "Oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace oracle
{

template <int N>
class FastSpline
{
public:
  using Parameters = std::array<Real, N>;
  using Sides = std::array<bool, N>;

  explicit FastSpline(const Spline<N>& spline)
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

  Real lower(int i) const { return this->Knots[i][this->Degrees[i]]; }
  Real upper(int i) const { return this->Knots[i][this->Counts[i]]; }
  int degree(int i) const { return this->Degrees[i]; }

  /// Ends of all spans in the domain, ascending.
  std::vector<Real> breaks(int i) const
  {
    std::vector<Real> all;
    for (const int k : this->Spans[i])
    {
      all.push_back(this->Knots[i][k]);
    }
    all.push_back(this->upper(i));
    return all;
  }

  /// On knots the limit from the left where asked for, else from the right; continued outside.
  Vector point(const Parameters& t, const Sides& left = {}) const
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

private:
  static constexpr int kMost = 31; ///< highest degree

  int span(int i, Real t, bool left) const
  {
    const std::vector<int>& all = this->Spans[i];
    const std::vector<Real>& knots = this->Knots[i];
    const auto after = left ? std::lower_bound(all.begin() + 1, all.end(), t,
                                [&](int k, Real at) { return knots[k] < at; })
                            : std::upper_bound(all.begin() + 1, all.end(), t,
                                [&](Real at, int k) { return at < knots[k]; });
    return *(after - 1);
  }

  void evaluate_basis(int i, int k, Real t, std::array<Real, kMost + 1>& values) const
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

  std::array<int, N> Degrees;
  std::array<int, N> Counts;
  std::array<std::vector<Real>, N> Knots;
  std::array<std::vector<int>, N> Spans; ///< numbers of spans of positive length
  std::vector<Eigen::Matrix<Real, 4, 1>, Eigen::aligned_allocator<Eigen::Matrix<Real, 4, 1>>>
    Control;
};

} // namespace oracle
