// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

namespace footpoint
{

/// Quality of the cells of a grid, one number a cell, i fastest.
template <int N>
struct GridQuality
{
  /// Minimum over the corners of the scaled Jacobian: the determinant of the edge vectors, each divided
  /// by its length, in [−1, 1]; 0 at a corner with an edge without length (a collapsed side), which
  /// alone does not make a fold.
  Eigen::VectorXd scaled_jacobian;
  Eigen::VectorXd measure;      ///< area (N = 2, of the two triangles about the shorter diagonal), volume
  Eigen::VectorXd skew;         ///< largest |cosine| between the principal axes of a cell, 0 best
  Eigen::VectorXd aspect_ratio; ///< longest edge / shortest edge, infinity where one has no length
  Eigen::Array<bool, Eigen::Dynamic, 1> folded; ///< a corner's Jacobian is negative
  std::int64_t folded_count = 0;
  double minimum_scaled_jacobian = 1.0; ///< over cells and over corners with edges of positive length
};

/// \param grid in the plane or in space: signs are taken against the mean surface normal near the cell
///             (a local average of the corner normals), so that curved grids do not count as folded; on a
///             planar grid against the grid's normal, oriented by the boundary's sense.
GridQuality<2> grid_quality(const Grid& grid);

/// Hexahedra by corner determinants; a grid that is left-handed throughout shows as folded everywhere.
GridQuality<3> grid_quality(const VolumeGrid& grid);

/// Whether all points lie in a plane (to 1e-9 of the size), and its unit normal.
struct Plane
{
  bool planar = false;
  Vector3 normal = Vector3::UnitZ();
};
Plane fit_plane(const Points& points);

} // namespace footpoint
