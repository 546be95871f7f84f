// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"

#include <cstdint>
#include <thread>

namespace inversion_benchmark
{

/// Halves of all work, one on the calling thread.
inline footpoint::Execution on_two_threads()
{
  footpoint::Execution execution;
  execution.parallel_for = [](std::int64_t count, const auto& body)
  {
    std::thread other([&] { body(0, count / 2); });
    body(count / 2, count);
    other.join();
  };
  return execution;
}

} // namespace inversion_benchmark
