// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace footpoint
{

/// How numbers of all processes that share a job are put together: Core knows no message passing,
/// the caller injects it. Every process makes the same calls in the same order, each with as many
/// numbers as the others, and gets the same result. Default: there is one process.
struct Reduction
{
  /// Replaces every number by its sum over all processes.
  std::function<void(std::vector<std::int64_t>& numbers)> sum = [](std::vector<std::int64_t>&) {};
  /// Replaces every number by its maximum over all processes; no NaN comes in.
  std::function<void(std::vector<double>& numbers)> maximum = [](std::vector<double>&) {};
};

} // namespace footpoint
