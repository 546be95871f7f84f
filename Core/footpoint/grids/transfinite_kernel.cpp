// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/transfinite_kernel.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/polyline.h"

#include <algorithm>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace footpoint
{

namespace
{

/// Outputs from this many bytes on do not stay in the caches of one core anyway: they are written
/// past them, which saves reading each line before it is overwritten. (Not so in fresh memory: the
/// operating system has just cleared each page when it is first touched, in the cache.)
constexpr std::int64_t kStreamedBytes = std::int64_t(8) << 20;

/// Everything that does not change from row to row; numbers by coordinate, x y z x y z …
struct Columns
{
  std::int64_t length;       ///< 3·nu
  Eigen::VectorXd bottom;    ///< B
  Eigen::VectorXd rise;      ///< T − B
  Eigen::VectorXd parameter; ///< s, three times each
};

/// What a row adds: P = B + ((base + t·rise) + s·slope).
struct Row
{
  double t;
  Vector3 base;  ///< (L − C00) − t (C01 − C00)
  Vector3 slope; ///< (R − C10) − t (C11 − C10) − base
};

inline double coordinate(const Columns& columns, const Row& row, std::int64_t k)
{
  const auto axis = static_cast<Eigen::Index>(k % 3);
  return columns.bottom[k] +
    ((row.base[axis] + row.t * columns.rise[k]) + columns.parameter[k] * row.slope[axis]);
}

/// Fills output[3 … length − 4], the interior of a row.
void fill_plain(const Columns& columns, const Row& row, double* output)
{
  for (std::int64_t k = 3; k + 3 < columns.length; k += 3)
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      output[k + axis] = columns.bottom[k + axis] +
        ((row.base[axis] + row.t * columns.rise[k + axis]) +
          columns.parameter[k + axis] * row.slope[axis]);
    }
  }
}

#if defined(__SSE2__)
/// The same numbers, bit for bit, written past the caches: six at a time, as the pattern of the
/// three axes in pairs repeats after six.
void fill_streamed(const Columns& columns, const Row& row, double* output)
{
  std::int64_t k = 3;
  const std::int64_t end = columns.length - 3;
  if (reinterpret_cast<std::uintptr_t>(output + k) % 16 != 0 && k < end)
  {
    output[k] = coordinate(columns, row, k);
    ++k;
  }
  const __m128d t = _mm_set1_pd(row.t);
  __m128d base[3];
  __m128d slope[3];
  for (int pair = 0; pair < 3; ++pair)
  {
    const auto low = static_cast<Eigen::Index>((k + 2 * pair) % 3);
    const Eigen::Index high = (low + 1) % 3;
    base[pair] = _mm_set_pd(row.base[high], row.base[low]);
    slope[pair] = _mm_set_pd(row.slope[high], row.slope[low]);
  }
  const double* const bottom = columns.bottom.data();
  const double* const rise = columns.rise.data();
  const double* const parameter = columns.parameter.data();
  for (; k + 6 <= end; k += 6)
  {
    for (int pair = 0; pair < 3; ++pair)
    {
      const std::int64_t at = k + 2 * pair;
      const __m128d across = _mm_add_pd(base[pair], _mm_mul_pd(t, _mm_loadu_pd(rise + at)));
      const __m128d both =
        _mm_add_pd(across, _mm_mul_pd(_mm_loadu_pd(parameter + at), slope[pair]));
      _mm_stream_pd(output + at, _mm_add_pd(_mm_loadu_pd(bottom + at), both));
    }
  }
  for (; k < end; ++k)
  {
    output[k] = coordinate(columns, row, k);
  }
}
#endif

void fill_row(const Columns& columns, const Row& row, double* output, bool streamed)
{
#if defined(__SSE2__)
  if (streamed)
  {
    fill_streamed(columns, row, output);
    return;
  }
#else
  (void)streamed;
#endif
  fill_plain(columns, row, output);
}

void copy(const Points& side, double* output)
{
  std::copy(side.data(), side.data() + side.size(), output);
}

} // namespace

void transfinite_kernel(const std::array<Points, 4>& sides, double* output, OutputMemory memory,
  const Execution& execution)
{
  const Points& bottom = sides[kBottom];
  const Points& right = sides[kRight];
  const Points& top = sides[kTop];
  const Points& left = sides[kLeft];
  const Eigen::Index nu = bottom.cols();
  const Eigen::Index nv = left.cols();
  const Vector3 c00 = bottom.col(0);
  const Vector3 c10 = bottom.col(nu - 1);
  const Vector3 to_c01 = top.col(0) - c00;
  const Vector3 to_c11 = top.col(nu - 1) - c10;

  Columns columns{ 3 * nu, {}, {}, {} };
  columns.bottom = bottom.reshaped();
  columns.rise = (top - bottom).reshaped();
  columns.parameter = even_spacing(static_cast<int>(nu)).transpose().replicate(3, 1).reshaped();
  const Eigen::VectorXd v = even_spacing(static_cast<int>(nv));
  const bool streamed =
    memory == OutputMemory::Written && 8 * columns.length * nv >= kStreamedBytes;

  copy(bottom, output);
  copy(top, output + columns.length * (nv - 1));
  execution.parallel_for(nv - 2,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t j = begin + 1; j < end + 1; ++j)
      {
        Row row{ v[j], {}, {} };
        row.base = (left.col(j) - c00) - v[j] * to_c01;
        row.slope = ((right.col(j) - c10) - v[j] * to_c11) - row.base;
        double* const start = output + columns.length * j;
        fill_row(columns, row, start, streamed);
        Vector3::Map(start) = left.col(j);
        Vector3::Map(start + columns.length - 3) = right.col(j);
      }
#if defined(__SSE2__)
      if (streamed)
      {
        _mm_sfence(); // so that other threads see what was written past the caches
      }
#endif
    });
}

} // namespace footpoint
