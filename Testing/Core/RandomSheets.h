// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Random sheets and curves of several pieces: smooth, rough, folded, collapsed.

#include "Shapes.h"

#include <string>
#include <vector>

namespace shapes
{

/// Clamped; knots inside are repeated up to `degree` times, spans up to a hundred times as long as
/// others.
std::vector<double> knots_of(Random& random, int degree, int spans);

/// A sheet, stretched and sheared, whose points are shaken by a part of their spacing.
Arrays<2> random_sheet(Random& random, std::string& description);

/// A parabola or a paraboloid of curvature 1 in its middle, and nearly so around.
Surface paraboloid();

Curve random_curve(Random& random);

} // namespace shapes
