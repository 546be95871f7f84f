// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  /// The part of the face that its trim loops keep; such a face is one patch, a Surface. Null: all
  /// of it.
  std::shared_ptr<const TrimRegion> region;
  /// How far the face may be from its neighbours: borders that are no farther apart are one (model
  /// units; at least kSewing of the model's size).
  double tolerance = 0.0;
};

/// Faces in the order of their FaceId.
using Model = std::vector<Face>;

} // namespace footpoint
