// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Boundaries that several tests use.

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/polyline.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace boundaries
{

using footpoint::Points;
using footpoint::Vector3;

/// A curve over [0, 1] at even parameters.
Points sampled(int count, const std::function<Vector3(double)>& curve);

Points line(const Vector3& from, const Vector3& to, int count = 2);
Points reversed(const Points& points);

/// The border of the unit square's image under a map: bottom, right, top, left.
std::vector<Points> border(
  const std::function<Vector3(double, double)>& map, int nu = 21, int nv = 21);

/// Four straight edges of different lengths that lie in no plane, with different counts.
std::vector<Points> scalene_quad();

Points joined(const std::vector<Points>& parts);

/// bottom, right, top, left → one closed loop, counter-clockwise, the first point not repeated.
Points loop_of(const std::vector<Points>& sides);

std::vector<Points> unit_square(int count = 5);
void expect_same(const footpoint::Boundary& a, const footpoint::Boundary& b);

void expect_refused(const std::function<void()>& call, footpoint::BoundaryDefect defect,
  const std::string& message_part);

} // namespace boundaries
