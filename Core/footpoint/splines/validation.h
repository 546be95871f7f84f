// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/types.h"
#include "footpoint/splines/knot_vector.h"
#include "footpoint/splines/parametric_geometry.h"

#include <string>

namespace footpoint
{

/// The shortest decimal number that reads back as the same double, for messages.
std::string to_text(double number);

/// \throw GeometryError (NotFinite) naming the first control point with a bad coordinate
void check_control_points(const Points& control_points);

/// \return the weights, empty where all are equal: they cancel then
/// \throw GeometryError (Count, NotFinite, Weight) naming the first bad weight
Eigen::VectorXd check_weights(Eigen::VectorXd weights, Eigen::Index number_of_control_points);

/// Columns (w·x, w·y, w·z, w); w = 1 where there are no weights. Four rows also for polynomials, as
/// sums of four numbers vectorize.
Eigen::Matrix<double, 4, Eigen::Dynamic> homogeneous(
  const Points& control_points, const Eigen::VectorXd& weights);

/// Length, spans and breaks of the direction that a knot vector describes.
Direction make_direction(const KnotVector& knots);

/// Samples of a span at which agreement of two sides proves that they agree all along the span:
/// they differ by A1/w1 − A2/w2, whose numerator has twice the degree where weights play a role.
inline int closure_samples(int degree, bool rational)
{
  return (rational ? 2 : 1) * degree + 1;
}

} // namespace footpoint
