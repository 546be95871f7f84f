// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/boundary_checks.h"

#include "footpoint/splines/validation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace footpoint
{

namespace
{

/// Neighbouring doubles at the largest coordinate differ by one epsilon of it; a corner that went
/// through a transformation is off by a few.
constexpr double kCoordinateRounding = 4.0 * std::numeric_limits<double>::epsilon();

} // namespace

BoundaryScale measure(const std::vector<Points>& polylines, const BoundaryOptions& options)
{
  Eigen::AlignedBox3d box;
  for (const Points& polyline : polylines)
  {
    for (Eigen::Index i = 0; i < polyline.cols(); ++i)
    {
      box.extend(Vector3(polyline.col(i)));
    }
  }
  BoundaryScale scale;
  if (box.isEmpty())
  {
    return scale;
  }
  scale.size = box.diagonal().norm();
  scale.centre = box.min() + 0.5 * box.diagonal();
  const double coordinate =
    std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  scale.merge = std::max(options.merge_tolerance * scale.size, kCoordinateRounding * coordinate);
  scale.largest = std::max(options.corner_tolerance * scale.size, scale.merge);
  return scale;
}

void check_polylines(
  const std::vector<Points>& polylines, Eigen::Index least_points, const std::string& noun)
{
  for (std::size_t index = 0; index < polylines.size(); ++index)
  {
    const Points& polyline = polylines[index];
    const std::string name = noun + " " + std::to_string(index);
    if (polyline.cols() < least_points)
    {
      throw BoundaryError(BoundaryDefect::Count,
        name + " has " + std::to_string(polyline.cols()) +
          (polyline.cols() == 1 ? " point; " : " points; ") + std::to_string(least_points) +
          " are needed");
    }
    for (Eigen::Index i = 0; i < polyline.cols(); ++i)
    {
      for (const double coordinate : { polyline(0, i), polyline(1, i), polyline(2, i) })
      {
        if (!std::isfinite(coordinate))
        {
          throw BoundaryError(BoundaryDefect::NotFinite,
            "point " + std::to_string(i) + " of " + name + " has the coordinate " +
              to_text(coordinate));
        }
      }
    }
  }
}

bool without_length(const Points& polyline, double distance)
{
  for (Eigen::Index i = 1; i < polyline.cols(); ++i)
  {
    if ((polyline.col(i) - polyline.col(0)).norm() > distance)
    {
      return false;
    }
  }
  return true;
}

std::string short_text(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

std::string distance_text(double distance, const BoundaryScale& scale)
{
  return short_text(distance) + " (" + short_text(distance / scale.size) + " of the size)";
}

int compare_points(const Vector3& a, const Vector3& b)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a[axis] != b[axis])
    {
      return a[axis] < b[axis] ? -1 : 1;
    }
  }
  return 0;
}

} // namespace footpoint
