// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "comparison.h"

namespace inversion_benchmark
{

/// Processor, compiler and how it was measured, as a Markdown paragraph.
void print_machine(std::ostream& out, const Settings& settings);

/// Every shape and class: µs a point and errors of all programs, as Markdown tables.
void print_comparison(std::ostream& out, const Records& records);

} // namespace inversion_benchmark
