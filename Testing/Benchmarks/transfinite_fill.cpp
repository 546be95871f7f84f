// SPDX-License-Identifier: BSD-3-Clause

/// How fast the points of a patch are made against filling the same memory with zeros, the two by
/// turns in one run: into fresh memory (each turn maps its pages anew) and into memory that was
/// written before; and how much faster two threads are than one. Counters are of medians:
///   of_zeros  time for the zeros (one thread) / time for the patch
///   speedup   time on one thread / time on two

#include "two_threads.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/transfinite_kernel.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

namespace
{

using footpoint::Execution;
using footpoint::OutputMemory;

constexpr int kPoints = 4096; // a side
constexpr int kTurns = 15;
constexpr std::size_t kBytes = sizeof(double) * 3 * kPoints * kPoints;

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

std::array<footpoint::Points, 4> wavy_sides()
{
  std::array<footpoint::Points, 4> sides;
  for (int side = 0; side < 4; ++side)
  {
    sides[side].resize(3, kPoints);
    for (int k = 0; k < kPoints; ++k)
    {
      const double t = static_cast<double>(k) / (kPoints - 1);
      const double wave = 0.1 * std::sin(6.0 * t) * t * (1.0 - t);
      const double across = side == footpoint::kTop || side == footpoint::kRight ? 1.0 : 0.0;
      const bool along_u = side == footpoint::kBottom || side == footpoint::kTop;
      sides[side].col(k) << (along_u ? t : across + wave), (along_u ? across + wave : t), wave;
    }
  }
  return sides;
}

using Work = std::function<void(double* output)>;

/// Seconds that the work takes into memory of a kind.
double timed(const Work& work, OutputMemory memory)
{
  using Block = std::unique_ptr<double, decltype(&std::free)>;
  const auto allocate = [] { return Block(static_cast<double*>(std::malloc(kBytes)), &std::free); };
  static const Block written = [&]
  {
    Block block = allocate();
    std::memset(block.get(), 1, kBytes);
    return block;
  }();
  const Block fresh = memory == OutputMemory::Fresh ? allocate() : Block(nullptr, &std::free);
  double* const output = fresh ? fresh.get() : written.get();
  const double time = seconds([&] { work(output); });
  benchmark::DoNotOptimize(output[kBytes / sizeof(double) / 2]);
  return time;
}

/// Times the patch and, by turns with it, what it is compared with.
void compare(benchmark::State& state, OutputMemory memory, const Work& patch, const Work& other,
  const char* counter)
{
  std::vector<double> patch_times;
  std::vector<double> other_times;
  for (auto turn : state)
  {
    (void)turn;
    other_times.push_back(timed(other, memory));
    patch_times.push_back(timed(patch, memory));
    state.SetIterationTime(patch_times.back());
  }
  state.counters["median_s"] = median(patch_times);
  state.counters[counter] = median(other_times) / median(patch_times);
}

Work patch(OutputMemory memory, const Execution& execution)
{
  return [sides = wavy_sides(), memory, execution](double* output)
  { footpoint::transfinite_kernel(sides, output, memory, execution); };
}

void one_thread(benchmark::State& state, OutputMemory memory)
{
  const Work zeros = [](double* output) { std::memset(output, 0, kBytes); };
  compare(state, memory, patch(memory, {}), zeros, "of_zeros");
}

void two_threads(benchmark::State& state, OutputMemory memory)
{
  compare(state, memory, patch(memory, inversion_benchmark::on_two_threads()), patch(memory, {}),
    "speedup");
}

BENCHMARK_CAPTURE(one_thread, fresh, OutputMemory::Fresh)
  ->UseManualTime()
  ->Iterations(kTurns)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_thread, written, OutputMemory::Written)
  ->UseManualTime()
  ->Iterations(kTurns)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_threads, fresh, OutputMemory::Fresh)
  ->UseManualTime()
  ->Iterations(kTurns)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_threads, written, OutputMemory::Written)
  ->UseManualTime()
  ->Iterations(kTurns)
  ->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
