// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"

#include <thread>
#include <vector>

/// Work shared out evenly among so many threads.
inline footpoint::Execution in_threads(int threads)
{
  footpoint::Execution execution;
  execution.parallel_for =
    [threads](std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    std::vector<std::thread> pool;
    for (int k = 0; k < threads; ++k)
    {
      pool.emplace_back(body, count * k / threads, count * (k + 1) / threads);
    }
    for (std::thread& thread : pool)
    {
      thread.join();
    }
  };
  return execution;
}
