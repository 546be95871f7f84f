// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Which sets of vector instructions the kernels are compiled for; included before Highway's
/// headers. The best one that the processor has is taken at run time: SSE4, AVX2 or AVX-512 on
/// x86-64 (those between and beyond would add nothing here), plain C++ where there is none of them.

#ifndef FOOTPOINT_TARGETS_LEFT_OUT // a build's own
#define FOOTPOINT_TARGETS_LEFT_OUT 0
#endif
#define HWY_DISABLED_TARGETS (FOOTPOINT_TARGETS_LEFT_OUT | HWY_SSSE3 | (HWY_AVX3 - 1))
