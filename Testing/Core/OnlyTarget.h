// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hwy/targets.h>

#include <cstdint>

/// Runs with one set of vector instructions only, and puts things back at the end.
class OnlyTarget
{
public:
  explicit OnlyTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~OnlyTarget() { hwy::SetSupportedTargetsForTest(0); }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;
};
