// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "comparison.h"

namespace inversion_benchmark
{

/// Ours, all points in one call, on 40 x 40 control points with each set of vector instructions
/// that the processor has, by turns: part "vectors", the set's name as program, from the oldest to
/// the newest.
Records measure_vector_targets(const Settings& settings, std::ostream& progress);

} // namespace inversion_benchmark
