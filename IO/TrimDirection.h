// SPDX-License-Identifier: BSD-3-Clause
// Private: which way trim loops run.

#ifndef TrimDirection_h
#define TrimDirection_h

#include "SplineFile.h"

namespace footpoint::files
{

/// Whether a loop runs counter-clockwise: by the area of a polygon with several corners on every
/// span. \throw GeometryError for bad curves
bool is_counter_clockwise(const std::vector<Spline>& loop);

/// The same loop run through from its end.
std::vector<Spline> reversed(const std::vector<Spline>& loop);

/// The border of a surface's domain, counter-clockwise, as a polyline.
std::vector<Spline> domain_border(const Spline& surface);

} // namespace footpoint::files

#endif
