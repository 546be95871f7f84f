// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// A judge for the core, in long double, that shares no line with it: B-splines by the definition
/// of Cox and de Boor. Slow and plain on purpose.

#include <Eigen/Core>

#include <array>
#include <functional>
#include <vector>

namespace oracle
{

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

/// A NURBS curve (N = 1) or surface (N = 2) in its own domain and in space, nothing shifted.
template <int N>
class Spline
{
public:
  using Parameters = std::array<Real, N>;
  using Spans = std::array<int, N>;

  /// \param control_points one a column, first direction fastest; weights may be empty (all 1)
  Spline(const std::array<int, N>& degrees, const std::array<std::vector<double>, N>& knots,
    const Eigen::Matrix<double, 3, Eigen::Dynamic>& control_points,
    const Eigen::VectorXd& weights = {});

  /// Moves the origin of space: subtracts the same vector from all control points.
  void subtract(const Vector& origin) { this->Positions.colwise() -= origin; }

  int degree(int i) const { return this->Degrees[i]; }
  int count(int i) const { return static_cast<int>(this->Knots[i].size()) - this->Degrees[i] - 1; }
  Real knot(int i, int k) const { return this->Knots[i][k]; }

  /// A control point as (x·w, y·w, z·w, w).
  Eigen::Matrix<Real, 4, 1> homogeneous(Eigen::Index k) const;

  /// Diagonal of the box of the control points.
  Real size() const;

  /// Indices k of all spans [k, k + 1) of positive length in the domain.
  std::vector<int> spans(int i) const;

  /// The span that holds t, at a knot the one on the left or on the right of it.
  int span(int i, Real t, bool left) const;

  /// The polynomial or rational piece of the given spans, inside them or continued.
  Vector evaluate(const Spans& span, const Parameters& t) const;

  /// The point at t; on knots the limit from the left where asked for, else from the right.
  Vector point(const Parameters& t, const std::array<bool, N>& left = {}) const;

private:
  /// N_{i,p}(t) for i = k − p … k by its definition, where N_{i,0} is 1 for i = k alone.
  std::vector<Real> basis(int direction, int k, Real t) const;

  std::array<int, N> Degrees;
  std::array<std::vector<Real>, N> Knots;
  Eigen::Matrix<Real, 3, Eigen::Dynamic> Positions;
  Eigen::Matrix<Real, Eigen::Dynamic, 1> Weights;
};

/// The limit of central differences for a step that goes to zero, by Richardson extrapolation
/// (C. J. F. Ridders 1982) from several steps, the first one given.
Vector extrapolated(const std::function<Vector(Real)>& difference, Real step);

/// Derivatives of order a (in u) and b (in v; 0 on curves) of the piece on the given spans, by
/// extrapolated central differences; the continued piece is evaluated, so that one-sided
/// derivatives at knots are central ones here. \param step first step as a fraction of the span's
/// length
template <int N>
Vector derivative(const Spline<N>& geometry, const typename Spline<N>::Spans& spans,
  const typename Spline<N>::Parameters& t, const std::array<int, N>& orders, Real step = 0.02L);

} // namespace oracle
