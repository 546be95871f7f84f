// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace footpoint
{

/// One column of the Cox–de Boor triangle, in place: the `degree` basis functions of degree − 1
/// that live on a span become the degree + 1 functions of `degree`.
///
/// Called for degree 1, 2, … with the same t it yields basis functions; with another t at each
/// step, the coefficients of the blossom (polar form) with these arguments (L. Ramshaw 1989).
///
/// Knot differences are taken directly and both fractions are divided out, so that for t inside the
/// span every value is a sum of positive terms, of full relative accuracy (which large ratios of
/// weights need), and exactly 0 or 1 at a knot of full multiplicity.
inline void raise_degree(const double* knots, int span, int degree, double t, double* values)
{
  double saved = 0.0;
  for (int r = 0; r < degree; ++r)
  {
    const double left = knots[span + 1 - degree + r];
    const double right = knots[span + 1 + r];
    const double length = right - left;
    const double value = values[r];
    values[r] = saved + (right - t) / length * value;
    saved = (t - left) / length * value;
  }
  values[degree] = saved;
}

} // namespace footpoint
