// SPDX-License-Identifier: BSD-3-Clause

/// How fast a patch is made against filling the same array with zeros, one thread, the two by
/// turns: into fresh memory (each run maps its pages anew) and into memory that was written before.
/// Prints medians in seconds and the ratios zeros / patch. Usage: transfinite_fill [points a side]

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/transfinite_kernel.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

namespace
{

constexpr int kRuns = 15;

double seconds(const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  return numbers[numbers.size() / 2];
}

std::array<footpoint::Points, 4> wavy_sides(int count)
{
  std::array<footpoint::Points, 4> sides;
  for (int side = 0; side < 4; ++side)
  {
    sides[side].resize(3, count);
    for (int k = 0; k < count; ++k)
    {
      const double t = static_cast<double>(k) / (count - 1);
      const double wave = 0.1 * std::sin(6.0 * t) * t * (1.0 - t);
      const double across = side == footpoint::kTop || side == footpoint::kRight ? 1.0 : 0.0;
      const bool along_u = side == footpoint::kBottom || side == footpoint::kTop;
      sides[side].col(k) << (along_u ? t : across + wave), (along_u ? across + wave : t), wave;
    }
  }
  return sides;
}

using Memory = std::unique_ptr<double, decltype(&std::free)>;

Memory allocate(std::size_t bytes)
{
  return Memory(static_cast<double*>(std::malloc(bytes)), &std::free);
}

} // namespace

int main(int argc, char** argv)
{
  const int count = argc > 1 ? std::atoi(argv[1]) : 4096;
  const std::size_t bytes = sizeof(double) * 3 * static_cast<std::size_t>(count) * count;
  const auto sides = wavy_sides(count);
  const Memory reused = allocate(bytes);
  std::memset(reused.get(), 1, bytes);

  std::vector<double> fresh_zeros, fresh_patch, reused_zeros, reused_patch;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run)
  {
    {
      const Memory fresh = allocate(bytes);
      fresh_zeros.push_back(seconds([&] { std::memset(fresh.get(), 0, bytes); }));
      sum += fresh.get()[run];
    }
    {
      const Memory fresh = allocate(bytes);
      fresh_patch.push_back(seconds([&] { footpoint::transfinite_kernel(sides, fresh.get()); }));
      sum += fresh.get()[run];
    }
    reused_zeros.push_back(seconds([&] { std::memset(reused.get(), 0, bytes); }));
    sum += reused.get()[run];
    reused_patch.push_back(seconds([&]
      { footpoint::transfinite_kernel(sides, reused.get(), footpoint::OutputMemory::Written); }));
    sum += reused.get()[run];
  }
  std::printf("%d x %d points, %.0f MB, median of %d (checksum %g)\n", count, count, 1e-6 * bytes,
    kRuns, sum);
  std::printf("fresh memory:  zeros %.4f s, patch %.4f s, ratio %.3f\n", median(fresh_zeros),
    median(fresh_patch), median(fresh_zeros) / median(fresh_patch));
  std::printf("reused memory: zeros %.4f s, patch %.4f s, ratio %.3f\n", median(reused_zeros),
    median(reused_patch), median(reused_zeros) / median(reused_patch));
  return 0;
}
