// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/grid_quality.h"

#include <vector>

namespace footpoint
{

/// A place on a surface with what a step along it needs.
struct SurfacePlace
{
  Vector3 point;
  Eigen::Matrix<double, 3, 2> tangents; ///< orthonormal
  Eigen::Matrix2d curvature; ///< second fundamental form in these tangents, to their cross product
};

/// The surface that a grid in space samples, whether the grid folds on it or not: the moving least
/// squares surface of its points (D. Levin, "Mesh-independent surface interpolation", 2003),
/// quadratic, smooth, and independent of how the points are joined. Each sample reaches as far as a
/// few of its own cells. Third-order accurate in the spacing. Of a planar grid: the plane, exactly.
/// \bug Two sheets closer than the cells are long are taken for one.
class SampledSurface
{
public:
  explicit SampledSurface(const Grid& grid);

  bool planar() const { return this->Flat.planar; }

  /// Moves a point onto the surface along its normal; a point beyond the reach of all samples is
  /// first moved to the nearest sample.
  SurfacePlace project(const Vector3& point) const;

private:
  /// A range of indices of samples, in a tree of halves.
  struct Node
  {
    std::array<int, 4> range; ///< i from, i to, j from, j to (exclusive)
    Vector3 low, high;        ///< about the reach of its samples
    int children;             ///< index of the first of two, 0 in a leaf
  };
  struct Fit;

  void build(int node);
  bool fit(const Vector3& point, Fit& result) const;
  void gather(const Vector3& point, std::vector<Eigen::Index>& samples) const;
  Vector3 nearest_sample(const Vector3& point) const;

  Grid Samples;
  Plane Flat;
  Eigen::Matrix<double, 3, 2> FlatTangents;
  Eigen::VectorXd Reach;
  std::vector<Node> Nodes;
};

} // namespace footpoint
