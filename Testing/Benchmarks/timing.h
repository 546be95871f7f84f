// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace inversion_benchmark
{

/// Wall time of some work, in seconds.
template <class Work>
double seconds(const Work& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time of some work on one thread, in seconds: what other programs take from the machine
/// meanwhile does not count. To be used for milliseconds and more.
template <class Work>
double cpu_seconds(const Work& work)
{
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// \pre there is a number
inline double median(std::vector<double> numbers)
{
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

} // namespace inversion_benchmark
