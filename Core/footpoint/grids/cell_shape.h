// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace footpoint
{

/// Corners of cell (i, j) about its perimeter: (i, j), (i+1, j), (i+1, j+1), (i, j+1).
using QuadCorners = std::array<Vector3, 4>;

inline QuadCorners quad_corners(const GridView& grid, int i, int j)
{
  return { { grid.points.col(grid.index(i, j)), grid.points.col(grid.index(i + 1, j)),
    grid.points.col(grid.index(i + 1, j + 1)), grid.points.col(grid.index(i, j + 1)) } };
}

/// A Jacobian this small against the edges' lengths is a straight or collapsed corner, not a fold.
constexpr double kStraightCorner = 1e-12;

/// Uncertainty of a coordinate: half a unit in the last place of the largest one, and of its
/// difference.
inline double coordinate_noise(const Eigen::Ref<const Points>& points)
{
  return points.size() == 0 ? 0.0
                            : std::numeric_limits<double>::epsilon() * points.cwiseAbs().maxCoeff();
}

/// The worst corner of a cell.
struct CornerQuality
{
  double scaled_jacobian =
    std::numeric_limits<double>::infinity();                 ///< corners with both edges only
  double jacobian = std::numeric_limits<double>::infinity(); ///< least of all corners, not scaled
  bool collapsed = false; ///< a corner has an edge without length
  bool folded = false;
};

/// Takes one corner into account.
/// \param jacobian determinant of the edges there
/// \param lengths  product of the edges' lengths
/// \param noise    uncertainty of the determinant
inline void add_corner(CornerQuality& cell, double jacobian, double lengths, double noise)
{
  cell.jacobian = std::min(cell.jacobian, jacobian);
  if (!(lengths > 0.0))
  {
    cell.collapsed = true;
    return;
  }
  const double scaled = std::clamp(jacobian / lengths, -1.0, 1.0);
  cell.scaled_jacobian = std::min(cell.scaled_jacobian, scaled);
  cell.folded = cell.folded || (scaled < -kStraightCorner && jacobian < -noise);
}

/// \param noise that of `coordinate_noise`
inline CornerQuality corner_quality(const QuadCorners& p, const Vector3& normal, double noise)
{
  CornerQuality result;
  for (int k = 0; k < 4; ++k)
  {
    const Vector3 a = p[(k + 1) % 4] - p[k];
    const Vector3 b = p[(k + 3) % 4] - p[k];
    const double length_a = a.norm();
    const double length_b = b.norm();
    add_corner(result, a.cross(b).dot(normal), length_a * length_b, noise * (length_a + length_b));
  }
  return result;
}

/// The up to four cells about a grid point.
/// \param normals one a cell, as of `reference_normals`
inline std::vector<CornerQuality> cells_about(
  const Grid& grid, const Points& normals, double noise, Eigen::Index point)
{
  const int nu = grid.count[0];
  const int i = int(point % nu);
  const int j = int(point / nu);
  std::vector<CornerQuality> result;
  for (int n = std::max(0, j - 1); n <= std::min(grid.count[1] - 2, j); ++n)
  {
    for (int m = std::max(0, i - 1); m <= std::min(nu - 2, i); ++m)
    {
      const Eigen::Index cell = m + Eigen::Index(nu - 1) * n;
      result.push_back(corner_quality(quad_corners(grid, m, n), normals.col(cell), noise));
    }
  }
  return result;
}

} // namespace footpoint
