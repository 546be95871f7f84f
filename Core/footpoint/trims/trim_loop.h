// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/curve.h"

#include <memory>
#include <vector>

namespace footpoint
{

/// A closed chain of curves in the plane of a surface's parameters: x = u, y = v in the surface's
/// own domain, z = 0. Each begins where the one before it ends, the first where the last ends;
/// polylines are curves of degree 1. A counter-clockwise loop keeps its inside, a clockwise one is
/// a hole.
struct TrimLoop
{
  std::vector<std::shared_ptr<const Curve>> curves;
};

} // namespace footpoint
