// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What must hold for the arcs of every trim region.

#include "TrimOracle.h"

#include <gtest/gtest.h>

#include <vector>

namespace trims
{

/// Monotone, between two knot lines, head to tail (on closed surfaces up to whole periods), points
/// of the curves that they are parts of, and as many starts and ends of curves as there are curves.
void check_arcs(
  const footpoint::TrimRegion& region, const std::vector<TrimLoop>& loops, const Surface& surface);

} // namespace trims
