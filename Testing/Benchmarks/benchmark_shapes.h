// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The geometries of the benchmark: seeded, the same in every run.

#include "Shapes.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace inversion_benchmark
{

using footpoint::Parameter;
using footpoint::Points;
using footpoint::Vector3;
using shapes::Random;

/// Which figure of the comparison with other programs a shape counts for.
enum class Family
{
  Low,  ///< degree up to 3, or a rational quadric or torus
  High, ///< degree 4 and more
  Other ///< a curve
};

/// One curve or one surface (exactly one pointer is set).
struct Shape
{
  std::string name;
  Family family = Family::Low;
  std::shared_ptr<const footpoint::Surface> surface;
  std::shared_ptr<const footpoint::Curve> curve;
  /// A point that has a continuum of feet; empty where the shape has none.
  std::function<Vector3(Random&)> centre;
  /// The distance in closed form; empty where there is none.
  std::function<long double(const Vector3&)> distance;

  double size() const; ///< diagonal of the bounding box of the control points
  Points control_points() const;
  std::size_t pieces() const; ///< Bézier pieces
};

/// Everything the comparison runs over, surfaces first, then curves.
std::vector<Shape> all_shapes();

/// A bumpy bicubic sheet of n x n control points.
Shape bumpy_sheet(int n);

} // namespace inversion_benchmark
