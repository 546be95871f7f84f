// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/local_solver.h"

#include <limits>

namespace footpoint
{

/// Two distances that differ by less are one: the rounding of a distance, a few times over.
/// \param size of the geometry or model
inline double tie_tolerance(double distance, double size)
{
  return 1e-13 * size + 16.0 * std::numeric_limits<double>::epsilon() * distance;
}

/// Parameters that differ by less than this part of the domain are one: the square root of the tie
/// tolerance's rounding is what a minimum can be located to where it is flat.
constexpr double kSameParameter = 1e-7;

/// Points closer than this fraction of the size are one point, seen from two patches or two
/// parameters.
constexpr double kSamePoint = 1e-9;

/// A line meets a geometry where it passes closer than this fraction of the size: the square root
/// of rounding would be the limit where it only grazes, a transversal meeting is exact.
constexpr double kMeets = 1e-10;

/// Order of two local parameters, equal ones by the next direction.
template <int N>
bool is_lower_parameter(
  const Parameter<N>& a, const Parameter<N>& b, const ParametricGeometry<N>& geometry)
{
  for (int i = 0; i < N; ++i)
  {
    if (std::abs(a(i) - b(i)) > kSameParameter * geometry.direction(i).length)
    {
      return a(i) < b(i);
    }
  }
  return false;
}

/// Whether a foot is to be preferred: nearer; at equal distance the converged one, then lower u, v.
template <int N>
bool is_better(const LocalFoot<N>& a, const LocalFoot<N>& b, const ParametricGeometry<N>& geometry)
{
  if (std::abs(a.distance - b.distance) > tie_tolerance(b.distance, geometry.size()))
  {
    return a.distance < b.distance;
  }
  if (a.converged != b.converged)
  {
    return a.converged;
  }
  return is_lower_parameter<N>(a.parameter, b.parameter, geometry);
}

} // namespace footpoint
