// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace footpoint
{

/// A point or a vector in space, in model units.
using Vector3 = Eigen::Vector3d;

/// N parameters: (u) on a curve, (u, v) on a surface.
template <int N>
using Parameter = Eigen::Matrix<double, N, 1>;

/// Points in space, one a column.
using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Which one-sided limit is meant where a parameter sits on a knot.
enum class Side
{
  Left, ///< the limit from smaller parameters
  Right ///< the limit from larger parameters
};

/// One side per parametric direction.
template <int N>
using Sides = Eigen::Matrix<Side, N, 1>;

} // namespace footpoint
