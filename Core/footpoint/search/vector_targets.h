// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Which sets of vector instructions the kernels are compiled for; included before Highway's
/// headers. The best one that the processor has is taken at run time: SSE4, AVX2 or AVX-512 on
/// x86-64, NEON on ARM, plain C++ where there is none of them. SSSE3 and what there is beyond
/// AVX-512's first would add nothing here; vectors whose length is not known when this compiles
/// have no place in arrays.

#ifndef FOOTPOINT_TARGETS_LEFT_OUT // a build's own
#define FOOTPOINT_TARGETS_LEFT_OUT 0
#endif
#define HWY_DISABLED_TARGETS                                                                       \
  (FOOTPOINT_TARGETS_LEFT_OUT | HWY_SSSE3 | (HWY_AVX3 - 1) | HWY_SVE | HWY_SVE2 | HWY_SVE_256 |    \
    HWY_SVE2_128 | HWY_RVV)
