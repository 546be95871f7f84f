// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/shapes/shapes.h"
#include "footpoint/splines/validation.h"

#include <cmath>

namespace footpoint
{

/// \throw ShapeError unless a length is positive and finite
inline void check_length(const char* name, double value)
{
  if (!(value > 0.0 && std::isfinite(value)))
  {
    throw ShapeError(
      std::string(name) + " = " + to_text(value) + "; a positive, finite length is needed");
  }
}

/// \throw ShapeError unless a number is in a range
inline void check_range(const char* name, double value, double lowest, double highest)
{
  if (!(value >= lowest && value <= highest))
  {
    throw ShapeError(std::string(name) + " = " + to_text(value) + "; allowed is " +
      to_text(lowest) + " to " + to_text(highest));
  }
}

} // namespace footpoint
