// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmark_shapes.h"

namespace inversion_benchmark
{

/// vtkPointInversionFilter on a surface without weights, with everything a user waits for: the
/// search structure is built, the points are inverted, all output arrays are filled.
class FilterTiming
{
public:
  FilterTiming(const Shape& shape, const Points& points);
  ~FilterTiming();

  struct Times
  {
    double wall; ///< seconds
    double cpu;  ///< seconds, of all threads together
  };

  /// Runs a new filter on `threads` threads.
  /// \throw std::runtime_error where the output is not complete
  Times run(int threads) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Data;
};

} // namespace inversion_benchmark
