// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

#include <vector>

namespace footpoint
{

/// A grid point of a side, corners excepted, that slides along the side's polyline.
struct SlidingPoint
{
  Eigen::Index point; ///< in the grid
  Eigen::Index inner; ///< its neighbour off the side
  int side;           ///< 0 bottom, 1 right, 2 top, 3 left
  Eigen::Index place; ///< on the side, 1 to #side − 2
};

/// The four sides of a grid as polylines, and places on them by arc length.
class SlidingSides
{
public:
  explicit SlidingSides(const Grid& grid);

  const std::vector<SlidingPoint>& points() const { return this->Sliding; }

  /// Arc lengths at which the grid's own points lie, one per sliding point.
  const Eigen::VectorXd& start() const { return this->Start; }

  /// The point at an arc length, which at a vertex is the vertex bit for bit.
  Vector3 point(const SlidingPoint& which, double at) const;

  /// Unit tangent, turning evenly from one middle direction at a vertex to the next: a grid line
  /// can then be orthogonal to a side anywhere.
  Vector3 tangent(const SlidingPoint& which, double at) const;

  /// Derivatives by the arc length of point() and of tangent(), at a vertex from above.
  Vector3 point_derivative(const SlidingPoint& which, double at) const;
  Vector3 tangent_derivative(const SlidingPoint& which, double at) const;

  /// Part of a move, at most 1, that keeps each point within its half of the way to its neighbours,
  /// so that the order along the side stays.
  double allowed(const Eigen::VectorXd& at, const Eigen::VectorXd& move) const;

  /// The farthest that a point may move, down and up, for the same reason.
  std::array<double, 2> limits(const Eigen::VectorXd& at, Eigen::Index number) const;

private:
  struct Line
  {
    Points vertices;
    Eigen::VectorXd lengths; ///< arc length at each vertex
    Points tangents;         ///< middle directions at the vertices
  };
  static Line make_line(Points vertices);
  Eigen::Index segment(const Line& line, double at) const;

  std::array<Line, 4> Lines;
  std::vector<SlidingPoint> Sliding; ///< side after side, in order along each
  Eigen::VectorXd Start;
};

} // namespace footpoint
