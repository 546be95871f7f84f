// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/common/execution.h"

#include <exception>
#include <mutex>

namespace footpoint
{

void for_ranges(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t, std::int64_t)>& body)
{
  if (count < fewest)
  {
    body(0, count);
    return;
  }
  execution.parallel_for(count, body);
}

void for_each_index(const Execution& execution, std::int64_t count, std::int64_t fewest,
  const std::function<void(std::int64_t)>& visit)
{
  std::mutex guard;
  std::int64_t least = count;
  std::exception_ptr failure;
  for_ranges(execution, count, fewest,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t k = begin; k < end; ++k)
      {
        try
        {
          visit(k);
        }
        catch (...)
        {
          const std::lock_guard<std::mutex> lock(guard);
          if (k < least)
          {
            least = k;
            failure = std::current_exception();
          }
        }
      }
    });
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

} // namespace footpoint
