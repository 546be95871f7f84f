// SPDX-License-Identifier: BSD-3-Clause

#include "OracleShapes.h"

namespace shapes
{

template <int N>
oracle::Spline<N> Arrays<N>::spline() const
{
  return { degrees, knots, points, weights };
}

oracle::Spline<1> spline_of(const Curve& curve)
{
  return { { { curve.knots().degree() } }, { { curve.knots().knots() } },
    curve.local_control_points().colwise() + curve.centre(), curve.weights() };
}

oracle::Spline<2> spline_of(const Surface& surface)
{
  return { { { surface.knots(0).degree(), surface.knots(1).degree() } },
    { { surface.knots(0).knots(), surface.knots(1).knots() } },
    surface.local_control_points().colwise() + surface.centre(), surface.weights() };
}

oracle::Spline<1> local_spline_of(const Curve& curve)
{
  return { { { curve.knots().degree() } }, { { curve.knots().knots() } },
    curve.local_control_points(), curve.weights() };
}

oracle::Spline<2> local_spline_of(const Surface& surface)
{
  return { { { surface.knots(0).degree(), surface.knots(1).degree() } },
    { { surface.knots(0).knots(), surface.knots(1).knots() } }, surface.local_control_points(),
    surface.weights() };
}

template oracle::Spline<1> Arrays<1>::spline() const;
template oracle::Spline<2> Arrays<2>::spline() const;

} // namespace shapes
