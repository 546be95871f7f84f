// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace footpoint
{

/// The sign of the area of a triangle in the plane, exactly: 1 counter-clockwise, −1 clockwise, 0
/// where the three points lie on one line. A floating-point filter decides most; the rest is summed
/// in expansions without error (J. R. Shewchuk 1997). \pre no product of coordinates under- or
/// overflows
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// 1 where d is clearly inside the circle through a, b, c, counter-clockwise; 0 where it is outside
/// or too near to tell.
int in_circle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
  const Eigen::Vector2d& d);

} // namespace footpoint
