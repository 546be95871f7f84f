// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

namespace footpoint
{

/// Quality of the cells of a grid, one number a cell, i fastest.
template <int N>
struct GridQuality
{
  /// Minimum over the corners of the scaled Jacobian: the determinant of the edge vectors, each
  /// divided by its length, in [−1, 1]; 0 at a corner with an edge without length (a collapsed
  /// side), which alone does not make a fold.
  Eigen::VectorXd scaled_jacobian;
  /// Area (N = 2, of the two triangles about the shorter diagonal) or volume (of the trilinear
  /// cell); negative where most of the cell is turned over.
  Eigen::VectorXd measure;
  Eigen::VectorXd skew;         ///< largest |cosine| between the principal axes of a cell, 0 best
  Eigen::VectorXd aspect_ratio; ///< longest edge / shortest edge, infinity where one has no length
  /// A corner's Jacobian is negative by more than the rounding of its points.
  Eigen::Array<bool, Eigen::Dynamic, 1> folded;
  std::int64_t folded_count = 0;
  double minimum_scaled_jacobian =
    1.0; ///< over cells and over corners with edges of positive length
};

/// \param grid in the plane or in space: signs are taken against `reference_normals`, so that
/// curved grids
///             do not count as folded. Fewer than two points along a direction: no cells.
GridQuality<2> grid_quality(const GridView& grid);

/// What `grid_quality` says of folds alone, in memory of the caller's.
struct Folds
{
  std::int64_t count = 0;
  double minimum_scaled_jacobian = 1.0;
};
/// Memory besides the caller's is that of a few rows; in space, where normals of neighbouring cells
/// disagree or a cell has no area, the tree of `reference_normals` takes some tens of bytes a cell.
/// \param scaled_jacobian receives one number a cell, i fastest; null: not wanted
/// \param folded          receives 1 or 0 a cell; null: not wanted
Folds find_folds(const GridView& grid, double* scaled_jacobian = nullptr, int* folded = nullptr);

/// One unit normal a cell, i fastest, that folds do not turn over: on a planar grid the plane's,
/// oriented by the boundary's sense; in space the mean over the cell and its neighbours, after the
/// cells' normals were made to agree across their borders along the tree of most parallel
/// neighbours (H. Hoppe et al., "Surface reconstruction from unorganized points", 1992), the
/// whole oriented by the boundary's sense. \bug A crease of more than 90° between neighbouring
/// cells cannot be told from a fold.
Points reference_normals(const GridView& grid);

/// Hexahedra by corner determinants; a grid that is left-handed throughout shows as folded
/// everywhere.
GridQuality<3> grid_quality(const VolumeGrid& grid);

/// Whether all points lie in a plane (to 1e-9 of the size), and its unit normal.
struct Plane
{
  bool planar = false;
  Vector3 normal = Vector3::UnitZ();
};
Plane fit_plane(const Eigen::Ref<const Points>& points);

} // namespace footpoint
