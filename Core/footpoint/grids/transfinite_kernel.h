// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/common/types.h"

#include <array>

namespace footpoint
{

/// What a kernel may know of the memory that it fills: large outputs are written past the caches
/// into memory that has pages already, through them into memory that was only just allocated. The
/// numbers are the same.
enum class OutputMemory
{
  Fresh,  ///< allocated and never touched
  Written ///< written to before
};

/// The kernel: P = (1−t)B + tT + (1−s)L + sR − corners, bilinear and uniform, rows hoisted so that
/// each coordinate costs two multiplications and three additions. The sides come out bit for bit.
/// \param sides  bottom, right, top, left; facing ones of equal count nu, nv ≥ 2, meeting in the
///               corners
/// \param output receives 3·nu·nv numbers, u fastest
void transfinite_kernel(const std::array<Points, 4>& sides, double* output,
  OutputMemory memory = OutputMemory::Fresh, const Execution& execution = {});

} // namespace footpoint
