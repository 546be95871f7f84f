// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The oracle's view of a geometry.

#include "Oracle.h"
#include "Shapes.h"

namespace shapes
{

oracle::Spline<1> spline_of(const Curve& curve);
oracle::Spline<2> spline_of(const Surface& surface);

/// The same in local coordinates of space (parameters stay the domain's): loses no digit far away.
oracle::Spline<1> local_spline_of(const Curve& curve);
oracle::Spline<2> local_spline_of(const Surface& surface);

} // namespace shapes
