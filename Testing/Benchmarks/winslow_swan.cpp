// SPDX-License-Identifier: BSD-3-Clause

/// How long Winslow smoothing takes from the transfinite grid of the swan, 257 × 257 points, to a
/// residual of 1e-10 of the start's; one thread. Counters: iterations, residual, folds left.

#include "GridShapes.h"

#include "footpoint/grids/smoothing.h"

#include <benchmark/benchmark.h>

namespace
{

void winslow_swan(benchmark::State& state)
{
  const int count = static_cast<int>(state.range(0));
  const footpoint::Grid grid = grid_shapes::transfinite(grid_shapes::swan(), count, count);
  footpoint::SmoothingOptions options;
  options.method = footpoint::Smoothing::Winslow;
  options.tolerance = 1e-10;
  footpoint::SmoothingResult result;
  for (auto turn : state)
  {
    (void)turn;
    result = footpoint::smooth(grid, options);
  }
  if (!result.converged)
  {
    state.SkipWithError("not converged");
  }
  state.counters["iterations"] = result.iterations;
  state.counters["residual"] = result.residual;
  state.counters["folds"] = static_cast<double>(result.folds_after);
}

BENCHMARK(winslow_swan)->Arg(257)->Iterations(3)->Unit(benchmark::kSecond);

} // namespace

BENCHMARK_MAIN();
