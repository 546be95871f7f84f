// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/parametric_geometry.h"

#include <array>
#include <vector>

namespace footpoint
{

/// A part of a surface's domain that lies outside by at most this fraction of its length is moved
/// onto the border: what files with twelve digits and parameters scaled to another unit leave.
constexpr double kBorderRounding = 1e-12;

/// Coordinates that differ by at most this many roundings (2^−52) of the parameters' magnitude are
/// equal: curves are stored relative to their own centres and meet after a few operations.
constexpr double kParameterRoundings = 32.0;

/// The plane of a surface's local parameters as its trim curves see it.
class TrimPlane
{
public:
  explicit TrimPlane(const ParametricSurface& surface);

  double origin(int i) const { return this->Axes[i].origin; }
  double length(int i) const { return this->Axes[i].length; }
  bool closed(int i) const { return this->Axes[i].closed; }
  /// Differences of coordinate i up to this mean nothing.
  double rounding(int i) const { return this->Axes[i].rounding; }

  /// The coordinate itself, or that of the border or knot line that it lies on up to rounding. In
  /// a closed direction lines repeat with the period.
  double snapped(int i, double at) const;

  /// How far from a border of the domain an arc may run and still be on it.
  double border_rounding(int i) const;
  /// The border of the domain that a coordinate is within border_rounding() of, else NaN. In a
  /// closed direction borders repeat with the period.
  double border_near(int i, double at) const;

  /// The lines strictly between two coordinates, ascending.
  std::vector<double> lines_between(int i, double low, double high) const;

  /// Whether the coordinate lies in the domain, borders included.
  bool inside(int i, double at) const { return at >= 0.0 && at <= this->Axes[i].length; }

private:
  struct Axis
  {
    double origin;
    double length;
    bool closed;
    double rounding;
    std::vector<double> lines; ///< local parameters of the knot lines, borders included
  };

  std::array<Axis, 2> Axes;
};

} // namespace footpoint
