// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/curve.h"
#include "footpoint/tessellation/surface_cells.h"

#include <vector>

namespace footpoint
{

/// A place on a curve, and the side from which it is meant.
struct CurvePlace
{
  double t; ///< local parameter
  Side side;
};

/// The polylines along a curve, one for each part between gaps. Kinks are points of it.
std::vector<std::vector<CurvePlace>> curve_samples(const Curve& curve, const SamplingRule& rule);

} // namespace footpoint
