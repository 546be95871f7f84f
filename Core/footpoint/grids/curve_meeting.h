// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/curve.h"

namespace footpoint
{

/// Where two curves come nearest to each other.
struct CurveMeeting
{
  double first = 0.0;  ///< local parameter on the first curve
  double second = 0.0; ///< and on the second
  double gap = 0.0;    ///< distance of the two points
};

/// Found as a point inversion: the foot of the origin on the surface A(u) − B(v).
CurveMeeting find_meeting(const ParametricCurve& first, const ParametricCurve& second);

} // namespace footpoint
