// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"

#include <algorithm>
#include <thread>
#include <vector>

/// Work on the calling thread, backwards in ranges of seven.
inline footpoint::Execution in_small_ranges()
{
  footpoint::Execution execution;
  execution.parallel_for =
    [](std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    for (std::int64_t end = count; end > 0; end -= std::min<std::int64_t>(end, 7))
    {
      body(std::max<std::int64_t>(end - 7, 0), end);
    }
  };
  return execution;
}

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
