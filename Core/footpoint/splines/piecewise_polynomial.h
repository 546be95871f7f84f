// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/curve.h"
#include "footpoint/splines/knot_vector.h"

#include <vector>

namespace footpoint
{

/// A vector-valued piecewise polynomial of one parameter in Bernstein form, the workbench on which
/// splines are brought to a common degree and knot vector, and multiplied. Everything is exact up
/// to rounding.
class PiecewisePolynomial
{
public:
  /// \param breakpoints m + 1 ascending numbers
  /// \param smoothness  per breakpoint (those at the ends do not count): derivatives that are
  /// continuous
  ///                    there, −1 for a jump
  /// \param pieces      m matrices of one size: a row for each component, degree + 1 columns
  PiecewisePolynomial(std::vector<double> breakpoints, std::vector<int> smoothness,
    std::vector<Eigen::MatrixXd> pieces);

  /// A spline with any number of components, its domain mapped to [0, 1].
  /// \param control a row for each component, a column for each control point
  static PiecewisePolynomial spline(const KnotVector& knots, const Eigen::MatrixXd& control);

  /// The homogeneous coordinates (w·x, w·y, w·z, w) of a curve, in space (not relative to its
  /// centre), with the domain mapped to [0, 1].
  static PiecewisePolynomial homogeneous(const Curve& curve);

  /// One polynomial on [0, 1]. \param control a row for each component, degree + 1 columns
  static PiecewisePolynomial single(const Eigen::MatrixXd& control);

  int degree() const { return static_cast<int>(this->Pieces.front().cols()) - 1; }
  const std::vector<double>& breakpoints() const { return this->Breakpoints; }

  /// The value at a parameter (at a jump that from the right).
  Eigen::VectorXd value(double t) const;
  /// The same function run through from its end.
  PiecewisePolynomial reversed() const;
  /// The same closed function run through from another parameter of [0, 1]. A start that is a
  /// breakpoint up to rounding becomes that one. Where the ends met, the derivatives that agree up
  /// to rounding count as continuous.
  /// \pre the domain is [0, 1]; value(0) = value(1)
  PiecewisePolynomial started_at(double start) const;
  /// The rows [first, first + count) alone.
  PiecewisePolynomial rows(int first, int count) const;
  PiecewisePolynomial scaled(double factor) const;
  PiecewisePolynomial elevated(int degree) const;
  /// Cut at further breakpoints (those that are there already may be among them).
  PiecewisePolynomial refined(const std::vector<double>& breakpoints) const;
  /// Each row times the one row of a scalar. \pre the factor has one row
  PiecewisePolynomial times(const PiecewisePolynomial& factor) const;

  /// Control points on a clamped knot vector whose space contains this polynomial: control point i
  /// is the blossom at the knots i + 1 … i + degree (L. Ramshaw 1989). \pre knots.degree() ≥
  /// degree(); every breakpoint is a knot
  Eigen::MatrixXd control_points(const KnotVector& knots) const;

  /// The least clamped knot vector over [0, 1] that holds both, with the larger degree at least
  /// `degree`.
  friend KnotVector common_knots(
    const PiecewisePolynomial& a, const PiecewisePolynomial& b, int degree);

private:
  std::size_t piece_at(double t) const;

  std::vector<double> Breakpoints;
  std::vector<int> Smoothness;
  std::vector<Eigen::MatrixXd> Pieces;
};

KnotVector common_knots(const PiecewisePolynomial& a, const PiecewisePolynomial& b, int degree);

} // namespace footpoint
