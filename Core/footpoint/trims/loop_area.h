// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/loop_chain.h"

namespace footpoint
{

/// ∫ (b − b0) da along a chain, a and b being the coordinates of these numbers.
double area_below(const LoopChain& chain, int a, int b, double b0);

} // namespace footpoint
