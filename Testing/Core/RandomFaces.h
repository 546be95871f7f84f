// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Random trimmed faces on random NURBS surfaces.

#include "TrimShapes.h"

#include "footpoint/model/model.h"

#include <string>
#include <vector>

namespace trims
{

/// From the unit square to a part of the surface's domain, exactly where that is all of it.
CurvePointer moved(const Surface& surface, const Curve& curve);

TrimLoop moved(const Surface& surface, const TrimLoop& loop);

/// A closed smooth wave around (u, v).
TrimLoop wave(double u, double v, double radius, int waves, double depth);

class RandomFaces
{
public:
  explicit RandomFaces(std::uint64_t seed);

  /// \param name is told what was made
  footpoint::Face face(std::string& name);

private:
  enum class Kind
  {
    Open,
    Rational, ///< weights from 0.1 to 10
    Closed,   ///< in u
    Pole,     ///< the side v = 0 is a point
    Stretched ///< a domain far from 0, thin in space
  };

  Surface surface(Kind kind, std::string& name);

  double any(double low, double high) { return this->Random.uniform(low, high); }

  TrimLoop star(double u, double v, double radius);

  /// In the unit square.
  std::vector<TrimLoop> loops(Kind kind, std::string& name);

  using Vector3 = footpoint::Vector3;
  shapes::Random Random;
};

} // namespace trims
