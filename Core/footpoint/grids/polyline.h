// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/types.h"

namespace footpoint
{

/// Arc length from the first point to each point, divided by the whole; of a polyline without
/// length: evenly spaced numbers.
/// \param polyline #n ≥ 2 points, one a column
/// \return #n numbers, the first 0 and the last 1, not decreasing
Eigen::VectorXd normalized_arc_length(const Points& polyline);

/// Points of a polyline at given normalized arc lengths (linear between its points); 0 and 1 give
/// the end points bit for bit.
/// \param at ascending numbers in [0, 1]
Points sample_by_arc_length(const Points& polyline, const Eigen::VectorXd& at);

/// Points at given *indices* scaled to [0, 1]: 0 is the first point, 1 the last, the points between
/// evenly spaced, whatever their distance (the parametrization that uniform grids use).
Points sample_by_index(const Points& polyline, const Eigen::VectorXd& at);

/// `count` ≥ 2 evenly spaced numbers from 0 to 1, both exact.
Eigen::VectorXd even_spacing(int count);

} // namespace footpoint
