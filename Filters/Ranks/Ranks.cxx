// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include <algorithm>

namespace footpoint::conversion
{

namespace
{

/// MPI counts in int; and no rank needs a second buffer as large as the geometry.
constexpr std::size_t kMostBytes = std::size_t{ 1 } << 28;

} // namespace

Ranks::Ranks(vtkMultiProcessController* controller)
  : Controller(controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr)
{
}

int Ranks::rank() const
{
  return this->Controller ? this->Controller->GetLocalProcessId() : 0;
}

int Ranks::count() const
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
}

std::vector<std::vector<std::uint64_t>> Ranks::gather(const std::vector<std::uint64_t>& own) const
{
  if (!this->Controller)
  {
    return { own };
  }
  const std::vector<unsigned long long> sent(own.begin(), own.end());
  std::vector<unsigned long long> all(own.size() * static_cast<std::size_t>(this->count()));
  this->Controller->AllGather(sent.data(), all.data(), static_cast<vtkIdType>(sent.size()));
  std::vector<std::vector<std::uint64_t>> result;
  for (auto next = all.cbegin(); next != all.cend();
       next += static_cast<std::ptrdiff_t>(own.size()))
  {
    result.emplace_back(next, next + static_cast<std::ptrdiff_t>(own.size()));
  }
  return result;
}

void Ranks::broadcast(std::vector<unsigned char>& bytes, int from) const
{
  if (!this->Controller)
  {
    return;
  }
  unsigned long long size = bytes.size();
  this->Controller->Broadcast(&size, 1, from);
  bytes.resize(size);
  for (std::size_t first = 0; first < bytes.size(); first += kMostBytes)
  {
    this->Controller->Broadcast(bytes.data() + first,
      static_cast<vtkIdType>(std::min(kMostBytes, bytes.size() - first)), from);
  }
}

std::string Ranks::first_error(const std::string& own) const
{
  const auto failed = this->gather({ own.empty() ? 0u : 1u });
  const auto first =
    std::find_if(failed.begin(), failed.end(), [](const auto& numbers) { return numbers[0] != 0; });
  if (first == failed.end())
  {
    return "";
  }
  const int rank = static_cast<int>(first - failed.begin());
  std::vector<unsigned char> text(own.begin(), own.end());
  this->broadcast(text, rank);
  return own.empty() ? "Rank " + std::to_string(rank) + ": " + std::string(text.begin(), text.end())
                     : own;
}

Reduction Ranks::reduction() const
{
  Reduction result;
  if (vtkMultiProcessController* const controller = this->Controller)
  {
    result.sum = [controller](std::vector<std::int64_t>& numbers)
    {
      const std::vector<long long> own(numbers.begin(), numbers.end());
      std::vector<long long> all(own.size());
      controller->AllReduce(
        own.data(), all.data(), static_cast<vtkIdType>(own.size()), vtkCommunicator::SUM_OP);
      std::copy(all.begin(), all.end(), numbers.begin());
    };
    result.maximum = [controller](std::vector<double>& numbers)
    {
      const std::vector<double> own = numbers;
      controller->AllReduce(
        own.data(), numbers.data(), static_cast<vtkIdType>(own.size()), vtkCommunicator::MAX_OP);
    };
  }
  return result;
}

} // namespace footpoint::conversion
