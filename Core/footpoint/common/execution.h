// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

namespace footpoint
{

/// How long work is run: Core starts no thread and prints nothing of its own, the caller injects
/// both.
struct Execution
{
  /// Calls `body(begin, end)` for disjoint ranges that cover [0, count), perhaps concurrently, and
  /// returns when all are done. Default: one range on the calling thread.
  std::function<void(
    std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)>
    parallel_for =
      [](std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)
  { body(0, count); };

  /// Told the finished fraction in [0, 1] from the calling thread, between blocks of work; returns
  /// false to cancel. Default: never cancels.
  std::function<bool(double fraction)> proceed = [](double) { return true; };
};

/// Calls `body(begin, end)` for disjoint ranges that cover [0, count): where there are `fewest` items at
/// least by parallel_for, else, as starting threads would take longer, one range on the calling thread.
void for_ranges(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t begin, std::int64_t end)>& body);

/// Calls `visit(k)` for each k of [0, count), in the same way. If some of them throw, the others are visited
/// all the same and the exception of the least k comes out, so that errors do not depend on threads.
void for_each_index(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t k)>& visit);

} // namespace footpoint
