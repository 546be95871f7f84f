// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/common/execution.h"

#include <atomic>
#include <exception>
#include <mutex>

namespace footpoint
{
namespace
{

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

void for_ranges(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t, std::int64_t)>& body)
{
  if (count < fewest)
  {
    body(0, count);
    return;
  }
  FirstFailure failure(count);
  execution.parallel_for(count,
    [&](std::int64_t begin, std::int64_t end)
    {
      try
      {
        body(begin, end);
      }
      catch (...)
      {
        failure.take(begin);
      }
    });
  failure.rethrow();
}

void for_each_index(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t)>& visit)
{
  FirstFailure failure(count);
  for_ranges(execution, count, fewest,
    [&](std::int64_t begin, std::int64_t end)
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
    });
  failure.rethrow();
}

} // namespace footpoint
