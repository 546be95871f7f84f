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
/// quadratic, smooth. Each sample reaches over an ellipsoid as long and as wide as a few of its own
/// cells, so that as many serve on long cells as on square ones. Third-order accurate in the
/// spacing. Of a planar grid: the plane, exactly.
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
    Vector3 low, high;        ///< about the reach of its samples and the margin
    int children;             ///< index of the first of two, 0 in a leaf
  };
  struct Fit;
  struct Neighbourhood;

  void find_reach();
  void build(int node);
  void gather(const Vector3& point, Neighbourhood& near) const;
  Vector3 nearest_sample(const Vector3& point) const;

  Grid Samples;
  Plane Flat;
  Eigen::Matrix<double, 3, 2> FlatTangents;
  /// Per sample the matrix A of its ellipsoid |A d| < 1, its half extents along the axes, and its
  /// longest half axis.
  std::vector<Eigen::Matrix3d> Shape;
  Points Extent;
  Eigen::VectorXd Reach;
  double LeastReach = 0.0; ///< the shortest half axis of all
  std::vector<Node> Nodes;
};

} // namespace footpoint
