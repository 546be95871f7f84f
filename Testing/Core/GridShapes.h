// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Closed-form domains for structured grids. Swan, half-annulus and horseshoe are those of P. Knupp
/// and S. Steinberg, "Fundamentals of Grid Generation" (1993).

#include "footpoint/grids/structured_points.h"

#include <cmath>
#include <functional>

namespace grid_shapes
{

using footpoint::Grid;
using footpoint::Points;
using footpoint::Vector3;

constexpr double kPi = 3.14159265358979323846;

/// Four sides as functions of [0, 1]; facing ones run the same way.
struct Domain
{
  using Side = std::function<Vector3(double)>;
  Side bottom, top, left, right;
};

inline Domain swan()
{
  return { [](double s) { return Vector3(s, 0, 0); },
    [](double s) { return Vector3(s, 1 - 3 * s + 3 * s * s, 0); },
    [](double t) { return Vector3(0, t, 0); },
    [](double t) { return Vector3(1 + 2 * t - 2 * t * t, t, 0); } };
}

/// Between half-ellipses with semi-axes (ax, ay) inside and (bx, by) outside.
inline Domain half_ring(double ax, double ay, double bx, double by)
{
  return { [=](double s) { return Vector3(-ax * std::cos(kPi * s), ay * std::sin(kPi * s), 0); },
    [=](double s) { return Vector3(-bx * std::cos(kPi * s), by * std::sin(kPi * s), 0); },
    [=](double t) { return Vector3(-ax - t * (bx - ax), 0, 0); },
    [=](double t) { return Vector3(ax + t * (bx - ax), 0, 0); } };
}

inline Domain half_annulus()
{
  return half_ring(1, 1, 2, 2);
}

inline Domain horseshoe(double rho = 4.5)
{
  return half_ring(1, rho, 2, 2 * rho);
}

/// The unit disk; the corners lie on the diagonals.
inline Domain disk()
{
  auto arc = [](double from, double sense)
  {
    return [=](double s)
    {
      const double angle = from + sense * 0.5 * kPi * s;
      return Vector3(std::cos(angle), std::sin(angle), 0);
    };
  };
  return { arc(-0.75 * kPi, 1), arc(0.75 * kPi, -1), arc(-0.75 * kPi, -1), arc(-0.25 * kPi, 1) };
}

/// Bilinearly blended transfinite interpolation, even in the sides' parameters.
inline Grid transfinite(const Domain& domain, int nu, int nv)
{
  Grid grid{ { nu, nv }, Points(3, Eigen::Index(nu) * nv) };
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const double s = i / double(nu - 1);
      const double t = j / double(nv - 1);
      grid.points.col(grid.index(i, j)) = (1 - t) * domain.bottom(s) + t * domain.top(s) +
        (1 - s) * domain.left(t) + s * domain.right(t) -
        ((1 - s) * ((1 - t) * domain.bottom(0) + t * domain.top(0)) +
          s * ((1 - t) * domain.bottom(1) + t * domain.top(1)));
    }
  }
  return grid;
}

/// The plane rolled on a cylinder of radius 2 about the y axis: lengths and angles stay.
inline Vector3 rolled(const Vector3& p)
{
  return Vector3(2 * std::sin(0.5 * p(0)), p(1), 2 * std::cos(0.5 * p(0)));
}

/// The grid with every point moved by a function.
template <class Map>
Grid mapped(Grid grid, const Map& map)
{
  for (Eigen::Index k = 0; k < grid.points.cols(); ++k)
  {
    grid.points.col(k) = map(Vector3(grid.points.col(k)));
  }
  return grid;
}

} // namespace grid_shapes
