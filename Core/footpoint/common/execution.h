// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <exception>
#include <functional>

namespace footpoint
{

/// How long work is run: Core starts no thread and prints nothing of its own, the caller injects
/// both.
struct Execution
{
  /// Calls `body(begin, end)` for disjoint ranges that cover [0, count), perhaps concurrently, and
  /// returns when all are done. Exceptions are left to it: what a body throws on a thread of its
  /// own ends the program unless it is caught there. Default: one range on the calling thread.
  std::function<void(
    std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)>
    parallel_for =
      [](std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)
  { body(0, count); };

  /// Told the finished fraction in [0, 1] from the calling thread, between blocks of work; returns
  /// false to cancel. Default: never cancels.
  std::function<bool(double fraction)> proceed = [](double) { return true; };
};

/// Thrown where `Execution::proceed` cancels work that has no other result to tell of it.
class Cancelled : public std::exception
{
public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// The same threads for a part of a work, whose own fractions from 0 to 1 are told as those from
/// `first` to `first + share`.
Execution part_of(const Execution& execution, double first, double share);

/// Edges or faces, each a tenth of a millisecond of work to build something of, from which on they
/// are shared out among threads.
constexpr std::int64_t kFacesForThreads = 32;

/// Calls `body(begin, end)` for disjoint ranges that cover [0, count): by parallel_for where there
/// are `fewest` items at least, else, as starting threads would take longer, for one range on the
/// calling thread. More than eight times as many are taken in blocks of so many, after each of
/// which `proceed` is asked; where `fewest` is 0 all are one block, and it is not. Where bodies
/// throw, the exception of the range that begins first comes out, when all of its block are done.
/// \throw Cancelled where `proceed` says so
void for_ranges(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t begin, std::int64_t end)>& body);

/// Calls `visit(k)` for each k of [0, count), in the same way. Where some throw, the exception of
/// the least k comes out, whatever the threads; those after it may be left out.
/// \throw Cancelled likewise
void for_each_index(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t k)>& visit);

} // namespace footpoint
