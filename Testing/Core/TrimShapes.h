// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Trim loops and the surfaces that they lie on, for the tests of trimmed faces.

#include "Shapes.h"

#include "footpoint/trims/trim_loop.h"
#include "footpoint/trims/trim_region.h"

#include <memory>
#include <vector>

namespace trims
{

using footpoint::Curve;
using footpoint::KnotVector;
using footpoint::Points;
using footpoint::Surface;
using footpoint::TrimLoop;
using CurvePointer = std::shared_ptr<const Curve>;
using Point2 = Eigen::Vector2d;

/// A plane face whose points are its parameters: x = u, y = v.
Surface flat(double u0 = 0.0, double u1 = 1.0, double v0 = 0.0, double v1 = 1.0, int spans = 1);

/// Straight from one point to the next.
CurvePointer polyline(const std::vector<Point2>& corners);

/// One line for each side, from the first corner around.
TrimLoop polygon(const std::vector<Point2>& corners);

TrimLoop rectangle(double u0, double v0, double u1, double v1);

/// The same loop run through backwards.
CurvePointer reversed(const Curve& curve);

TrimLoop reversed(const TrimLoop& loop);

/// A circle of four rational quadratics, counter-clockwise, as one curve.
TrimLoop circle(double u, double v, double radius);

} // namespace trims
