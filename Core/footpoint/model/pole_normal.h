// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/model/model.h"

#include <vector>

namespace footpoint
{

/// The sides of a surface's knots on which it is evaluated: from inside at the ends of the domain.
Sides<2> sides_at(const Surface& surface, const Parameter<2>& at);

/// The normals of the fan in which a surface leaves a pole, each weighted by its angle.
/// \param from   local parameters on the collapsed side, where the fan begins
/// \param around the direction along the side \param way to the end of the fan, with its sign
Vector3 pole_fan(const Surface& surface, const Parameter<2>& from, int around, double way);

/// The same of the whole turn around each pole inside a face, as the apex of a cone, reversed with
/// the face. Built once for a model, whose faces are trimmed already.
class PoleNormals
{
public:
  PoleNormals() = default;
  explicit PoleNormals(const Model& model);

  /// Zero where the point is no pole, the face does not surround it or is not one surface.
  /// \param parameter the surface's own
  Vector3 at(int face, const Parameter<2>& parameter) const;

private:
  struct Pole
  {
    int face;
    int across; ///< the direction in which the pole is an end
    double at;  ///< its parameter there, …
    double tolerance; ///< … within this
    Vector3 normal;
  };
  std::vector<Pole> Poles; ///< in the order of faces
};

} // namespace footpoint
