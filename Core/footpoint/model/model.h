// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/errors.h"
#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"
#include "footpoint/trims/trim_region.h"

#include <memory>
#include <string>
#include <vector>

namespace footpoint
{

/// A part of a face: one curve or one surface (exactly one pointer is set).
struct Patch
{
  std::shared_ptr<const ParametricCurve> curve;
  std::shared_ptr<const ParametricSurface> surface;
};

/// One face of a model: a curve, a surface, or several patches that count as one (Bézier cells with
/// the same FaceId); borders that its patches share are interior.
struct Face
{
  std::string name;           ///< for messages; may be empty
  std::vector<Patch> patches; ///< empty: a null block that uses up its number
  bool reversed = false;      ///< the normal is −S_u × S_v
  /// What trims the face, which then is one patch, a Surface; empty: nothing.
  std::vector<TrimLoop> loops;
  /// What the loops keep, see trim(); null where nothing trims the face.
  std::shared_ptr<const TrimRegion> region;
  /// How far the face may be from its neighbours: borders that are no farther apart are one (model
  /// units; at least kSewing of the model's size).
  double tolerance = 0.0;
};

/// Makes the region of a face with loops. \throw GeometryError where they do not make one
inline void trim(Face& face)
{
  const auto surface = face.patches.size() == 1
    ? std::dynamic_pointer_cast<const Surface>(face.patches.front().surface)
    : nullptr;
  if (!surface)
  {
    throw GeometryError(GeometryDefect::Format, "only a face that is one NURBS surface has loops");
  }
  face.region = std::make_shared<const TrimRegion>(face.loops, *surface, face.tolerance);
}

/// Faces in the order of their FaceId.
using Model = std::vector<Face>;

} // namespace footpoint
