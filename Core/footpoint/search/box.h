// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/types.h"

#include <limits>

namespace footpoint
{

/// An axis-parallel box; empty until something is added.
struct Box
{
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = Vector3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return !(this->lower.array() <= this->upper.array()).all(); }

  void add(const Box& other)
  {
    this->lower = this->lower.cwiseMin(other.lower);
    this->upper = this->upper.cwiseMax(other.upper);
  }

  /// Distance of a point from the box, 0 inside.
  double distance(const Vector3& point) const
  {
    return (this->lower - point).cwiseMax(point - this->upper).cwiseMax(0.0).norm();
  }
};

} // namespace footpoint
