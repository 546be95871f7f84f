// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "results.h"

namespace inversion_benchmark
{

/// What is aimed at and what was measured, as a Markdown table.
/// \param records those of compare() and measure_scaling()
void print_figures(std::ostream& out, const Records& records);

} // namespace inversion_benchmark
