// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Built without optimization or with a sanitizer, tests of many cases or large sizes take fewer or
/// smaller ones: in the flavour of VTK they run in full.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
constexpr bool kSlowBuild = true;
#else
constexpr bool kSlowBuild = false;
#endif
