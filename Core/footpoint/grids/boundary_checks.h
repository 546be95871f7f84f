// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/boundary.h"

namespace footpoint
{

/// The lengths against which a boundary is judged, in model units.
struct BoundaryScale
{
  double size = 0.0;    ///< diagonal of the bounding box
  double merge = 0.0;   ///< gaps up to this are rounding
  double largest = 0.0; ///< gaps beyond this are refused
  Vector3 centre = Vector3::Zero();
};

/// merge_tolerance of the size, but no less than what coordinates far from the origin can resolve.
BoundaryScale measure(const std::vector<Points>& polylines, const BoundaryOptions& options);

/// \param noun what the message calls them, with their index: "polyline"
/// \throw BoundaryError (Count, NotFinite)
void check_polylines(
  const std::vector<Points>& polylines, Eigen::Index least_points, const std::string& noun);

/// Whether all points lie within `distance` of the first.
bool without_length(const Points& polyline, double distance);

/// Three digits, for messages that say how far.
std::string short_text(double number);

/// "0.12 (0.034 of the size)"
std::string distance_text(double distance, const BoundaryScale& scale);

/// −1, 0 or 1 as `a` comes before, equals or comes behind `b` in the order of coordinates x, y, z.
int compare_points(const Vector3& a, const Vector3& b);

} // namespace footpoint
