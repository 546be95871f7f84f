// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "comparison.h"

namespace inversion_benchmark
{

/// The filter by classes of queries, and time against number of pieces, points and threads.
Records measure_scaling(const Settings& settings, std::ostream& progress);

} // namespace inversion_benchmark
