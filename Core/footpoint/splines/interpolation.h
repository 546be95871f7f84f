// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/knot_vector.h"

#include <vector>

namespace footpoint
{

/// A clamped knot vector over [0, 1] in whose space data at the given parameters can be
/// interpolated: each inner knot is the mean of `degree` neighbouring parameters (C. de Boor 1978;
/// Piegl and Tiller, eq. 9.8), so that the collocation matrix is regular (I. J. Schoenberg and A.
/// Whitney 1953). \param parameters ascending, in [0, 1]; at least two \param degree     lowered to
/// one less than their number
KnotVector averaged_knots(const std::vector<double>& parameters, int degree);

/// Control points of the spline that takes given values at given parameters.
/// \param values a row for each component, a column for each parameter
/// \pre the knot vector comes from averaged_knots
Eigen::MatrixXd interpolate(
  const KnotVector& knots, const std::vector<double>& parameters, const Eigen::MatrixXd& values);

} // namespace footpoint
