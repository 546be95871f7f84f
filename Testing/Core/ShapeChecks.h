// SPDX-License-Identifier: BSD-3-Clause
// What the tests of shapes measure them with.
#pragma once

#include "footpoint/shapes/shapes.h"

namespace shape_checks
{

using footpoint::Curve;
using footpoint::Parameter;
using footpoint::Shape;
using footpoint::Side;
using footpoint::Sides;
using footpoint::Surface;
using footpoint::Vector3;

constexpr double kPi = 3.14159265358979323846;

/// A point in space at parameters of the domain.
Vector3 at(const Surface& surface, double u, double v);

Vector3 at(const Curve& curve, double u);

/// Calls check(u, v, point, S_u × S_v) on a grid over the domain, borders included.
template <class Check>
void for_points(const Surface& surface, const Check& check)
{
  constexpr int kSteps = 40;
  const footpoint::KnotVector& ku = surface.knots(0);
  const footpoint::KnotVector& kv = surface.knots(1);
  for (int i = 0; i <= kSteps; ++i)
  {
    for (int j = 0; j <= kSteps; ++j)
    {
      const Parameter<2> local(ku.length() * i / kSteps, kv.length() * j / kSteps);
      const auto jet = surface.jet(local, Sides<2>::Constant(Side::Right), 1);
      check(ku.domain_start() + local[0], kv.domain_start() + local[1],
        Vector3(jet.point + surface.centre()), Vector3(jet.first.col(0).cross(jet.first.col(1))));
    }
  }
}

/// Volume inside closed faces with outward normals, by the divergence theorem, with Gauss's rule of
/// 5 points on parts of the knot spans.
double volume(const Shape& shape);

} // namespace shape_checks
