// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The judge's splines, evaluated without allocation: for oracles that evaluate millions of times.
/// Shares no line with the core. (L. Piegl and W. Tiller, The NURBS Book, algorithm A2.2.)

#include "Oracle.h"

#include <array>
#include <vector>

namespace oracle
{

template <int N>
class FastSpline
{
public:
  using Parameters = std::array<Real, N>;
  using Sides = std::array<bool, N>;

  explicit FastSpline(const Spline<N>& spline);

  Real lower(int i) const { return this->Knots[i][this->Degrees[i]]; }
  Real upper(int i) const { return this->Knots[i][this->Counts[i]]; }
  int degree(int i) const { return this->Degrees[i]; }

  /// Ends of all spans in the domain, ascending.
  std::vector<Real> breaks(int i) const;

  /// On knots the limit from the left where asked for, else from the right; continued outside.
  Vector point(const Parameters& t, const Sides& left = {}) const;

private:
  static constexpr int kMost = 31; ///< highest degree

  int span(int i, Real t, bool left) const;
  void evaluate_basis(int i, int k, Real t, std::array<Real, kMost + 1>& values) const;

  std::array<int, N> Degrees;
  std::array<int, N> Counts;
  std::array<std::vector<Real>, N> Knots;
  std::array<std::vector<int>, N> Spans; ///< numbers of spans of positive length
  std::vector<Eigen::Matrix<Real, 4, 1>, Eigen::aligned_allocator<Eigen::Matrix<Real, 4, 1>>>
    Control;
};

} // namespace oracle
