// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/common/execution.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

namespace footpoint
{
namespace
{

/// Of what is worth threads (some milliseconds), so many times make a block between two looks at
/// progress.
constexpr std::int64_t kBlock = 8;

/// The exception that comes first in the order of the work, not of time.
class FirstFailure
{
public:
  explicit FirstFailure(std::int64_t count)
    : Least(count)
  {
  }

  /// Whether something before or at a place has failed.
  bool is_before(std::int64_t at) const
  {
    return this->Least.load(std::memory_order_relaxed) <= at;
  }

  /// To be called where an exception is handled.
  void take(std::int64_t at)
  {
    const std::lock_guard<std::mutex> lock(this->Guard);
    if (at < this->Least)
    {
      this->Least = at;
      this->Failure = std::current_exception();
    }
  }

  void rethrow() const
  {
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
  }

private:
  std::mutex Guard;
  std::atomic<std::int64_t> Least;
  std::exception_ptr Failure;
};

} // namespace

Execution part_of(const Execution& execution, double first, double share)
{
  Execution part;
  part.parallel_for = execution.parallel_for;
  part.proceed = [proceed = execution.proceed, first, share](double fraction)
  { return proceed(first + share * fraction); };
  return part;
}

void for_ranges(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t, std::int64_t)>& body)
{
  if (count < fewest)
  {
    body(0, count);
    return;
  }
  const std::int64_t block = fewest > 0 ? kBlock * fewest : count;
  for (std::int64_t done = 0; done < count; done += block)
  {
    const std::int64_t size = std::min(block, count - done);
    FirstFailure failure(size);
    execution.parallel_for(size,
      [&](std::int64_t begin, std::int64_t end)
      {
        try
        {
          body(done + begin, done + end);
        }
        catch (...)
        {
          failure.take(begin);
        }
      });
    failure.rethrow();
    const double part = static_cast<double>(done + size) / static_cast<double>(count);
    if (block < count && !execution.proceed(part))
    {
      throw Cancelled();
    }
  }
}

void for_each_index(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t)>& visit)
{
  FirstFailure failure(count);
  const auto visit_range = [&](std::int64_t begin, std::int64_t end)
  {
    for (std::int64_t k = begin; k < end && !failure.is_before(k); ++k)
    {
      try
      {
        visit(k);
      }
      catch (...)
      {
        failure.take(k);
      }
    }
  };
  try
  {
    for_ranges(execution, count, fewest, visit_range);
  }
  catch (const Cancelled&)
  {
    failure.rethrow(); // what is wrong tells more
    throw;
  }
  failure.rethrow();
}

} // namespace footpoint
