// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/model/model.h"

namespace footpoint
{

/// The sides of a surface's knots on which it is evaluated: from inside at the ends of the domain.
Sides<2> sides_at(const Surface& surface, const Parameter<2>& at);

/// The normals of the fan in which a surface leaves a pole, each weighted by its angle.
/// \param from   local parameters on the collapsed side, where the fan begins
/// \param around the direction along the side \param way to the end of the fan, with its sign
Vector3 pole_fan(const Surface& surface, const Parameter<2>& from, int around, double way);

/// The same of the whole turn around a pole inside a face, as the apex of a cone, reversed with the
/// face; zero where the point is no pole, the face does not surround it or is not one surface.
/// \param parameter the surface's own
Vector3 pole_normal(const Face& face, const Parameter<2>& parameter);

} // namespace footpoint
