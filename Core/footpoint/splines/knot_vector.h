// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/errors.h"
#include "footpoint/common/types.h"

#include <string>
#include <vector>

namespace footpoint
{

/// Highest polynomial degree that is accepted; bounds the stack arrays of evaluation.
constexpr int kMaximumDegree = 30;

/// A knot of the domain and how often it is repeated.
struct DistinctKnot
{
  double at;        ///< local parameter, see KnotVector
  int multiplicity; ///< 1 … degree + 1; degree means C0, degree + 1 a gap
  double parameter; ///< the same knot in the geometry's own domain
};

/// A validated knot vector with its degree: clamped, unclamped or periodic, any multiplicity up to
/// degree + 1 (inside: a gap).
///
/// The domain is [knots[degree], knots[n]], n = len(knots) − degree − 1 control points. All
/// evaluation takes *local parameters*, measured from the start of the domain, so that on a domain
/// such as [1e6, 1e6 + 1] no digit of the geometry is lost: local = parameter − domain_start().
class KnotVector
{
public:
  /// \param degree 1 … kMaximumDegree
  /// \param knots  the full knot vector, not decreasing
  /// \param name   the array's name in error messages, e.g. "KnotsU"
  /// \throw GeometryError (Degree, Count, NotFinite, Decreasing, Multiplicity, EmptyDomain)
  KnotVector(int degree, std::vector<double> knots, std::string name = "Knots");

  int degree() const { return this->Degree; }
  int number_of_control_points() const
  {
    return static_cast<int>(this->Knots.size()) - this->Degree - 1;
  }
  const std::vector<double>& knots() const { return this->Knots; }
  const std::string& name() const { return this->Name; }

  double domain_start() const { return this->Knots[this->Degree]; }
  double domain_end() const { return this->Knots[this->number_of_control_points()]; }
  /// Length of the domain; local parameters run over [0, length()].
  double length() const { return this->Local[this->number_of_control_points()]; }

  /// The knots as local parameters (all of them, those before the domain are negative).
  const std::vector<double>& local_knots() const { return this->Local; }

  /// The distinct knots in the closed domain, ascending; the first is 0, the last length().
  const std::vector<DistinctKnot>& distinct_knots() const { return this->Distinct; }

  /// Index k of the knot span [k, k+1) of positive length that holds t, clamped to the domain; at a
  /// knot the span on the given side (at the domain's ends the only one there is).
  int find_span(double t, Side side) const;

  /// Values and derivatives of the degree + 1 basis functions that live on a span.
  /// \param span   from find_span
  /// \param t      local parameter; may lie outside the span (the polynomial is continued)
  /// \param order  highest derivative wanted, 0 … 3
  /// \param values receives (order + 1) rows of degree + 1 numbers: row k, column j is the k-th
  ///               derivative of basis function span − degree + j. Derivatives above the degree are
  ///               0.
  /// Cox–de Boor recurrence; L. Piegl and W. Tiller, The NURBS Book (1997), algorithm A2.3
  /// (derivatives by repeated differences of lower degrees, equation 2.7). Allocates nothing.
  void basis(int span, double t, int order, double* values) const;

  /// Greville abscissa of a control point as local parameter: the mean of its inner knots.
  double greville(int control_point) const;

private:
  int Degree;
  std::vector<double> Knots;
  std::vector<double> Local;
  std::vector<DistinctKnot> Distinct;
  std::string Name;
};

} // namespace footpoint
