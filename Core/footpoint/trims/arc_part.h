// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/chain_arc.h"

#include <array>

namespace footpoint
{

/// Contacts that are nearer to each other than this, or to the end of an arc, are one.
constexpr double kOnePlace = 8.0;

/// Parts whose control points are farther apart do not meet.
constexpr double kApart = 1.5;

/// A part of an arc, for telling where it meets others. Lengths are in units of contact_unit().
struct ArcPart
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> control;
  double lower; ///< fractions of the arc
  double upper;
  Eigen::Matrix2Xd points; ///< control points
  double bulge; ///< the largest distance of a control point from the chord

  Eigen::Vector2d start() const { return this->points.col(0); }
  Eigen::Vector2d end() const { return this->points.col(this->points.cols() - 1); }
};

/// All of an arc. \param unit of u and of v
ArcPart whole_arc(const ChainArc& arc, const Eigen::Vector2d& unit);

/// Both halves of a part (de Casteljau 1959).
std::array<ArcPart, 2> halves(const ArcPart& part);

/// Whether the control points of two parts are farther apart than kApart, along u, along v or
/// across one of the chords.
bool are_apart(const ArcPart& a, const ArcPart& b);

/// Whether two arcs that begin in the same point meet nowhere else: seen from there, their control
/// points lie in angles that are apart. \param a, b control points, the common one first
bool only_join(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b);

/// The point of a part at a fraction of it.
Eigen::Vector2d point_at(const ArcPart& part, double t);

} // namespace footpoint
