// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/model/certified_feet.h"
#include "footpoint/model/face_neighbours.h"
#include "footpoint/model/point_inversion.h"
#include "footpoint/model/pole_normal.h"
#include "footpoint/model/shared_borders.h"

#include <memory>
#include <optional>
#include <vector>

namespace footpoint
{

/// A patch of a face, or an edge of a trimmed one as a curve, prepared for queries.
struct PreparedPatch
{
  const Patch* patch;
  int face;
  SharedBorders shared;     ///< its borders that other patches of the face continue
  const TrimRegion* region; ///< of a trimmed face, on its surface; else null
  const EdgeCurve* edge;    ///< the curve of the patch, where it is an edge; else null
  std::unique_ptr<PatchSearch> search;
};

/// Which structures queries with some options ask for.
struct PreparedParts
{
  int seed_resolution = SeedOptions{}.resolution;
  bool pieces = false; ///< the Bézier pieces of all splines and their tree, for Search::Global

  PreparedParts() = default;
  explicit PreparedParts(const InversionOptions& options);

  /// Whether these are enough for others.
  bool include(const PreparedParts& others) const;
  /// These and others, with the others' resolution.
  PreparedParts joined_with(const PreparedParts& others) const;
};

/// What a model is built into, whatever the other options of its queries. Immutable, and shared by
/// all inverters of the model.
class PreparedModel
{
public:
  /// \param execution whose threads share the work of building \throw Cancelled by its `proceed`
  PreparedModel(Model model, const PreparedParts& parts, const Execution& execution);
  // Patches point into the model.
  PreparedModel(const PreparedModel&) = delete;
  PreparedModel& operator=(const PreparedModel&) = delete;

  const Model& model() const { return this->Faces; }
  const PreparedParts& parts() const { return this->Parts; }
  /// Diagonal of the bounding box of all control points.
  double size() const { return this->Size; }
  /// Null where it was not asked for, or the model is empty.
  const CertifiedFeet* certified() const { return this->Certified ? &*this->Certified : nullptr; }

  const PoleNormals& pole_normals() const { return this->AtPoles; }

  /// Null where no two faces can meet.
  const FaceNeighbours* neighbours() const
  {
    return this->Neighbours ? &*this->Neighbours : nullptr;
  }

  /// The patches in the order of faces, searched with these options.
  std::vector<PreparedPatch> patches(const InversionOptions& options) const;

private:
  Box add_faces(const SeedOptions& seeding, const Execution& execution);
  std::vector<EdgePieces> add_edges(const SeedOptions& seeding, const Execution& execution);

  Model Faces;
  PreparedParts Parts;
  std::vector<std::unique_ptr<const Patch>> Edges; ///< of trimmed faces
  std::vector<PreparedPatch> Patches;
  double Size = 0.0;
  std::optional<CertifiedFeet> Certified;
  std::optional<FaceNeighbours> Neighbours;
  PoleNormals AtPoles;
};

/// Builds from the model what queries with the options ask for.
/// \throw std::invalid_argument where the model has surfaces and the method is for curves only
std::shared_ptr<const PreparedModel> prepare(
  Model model, const InversionOptions& options, const Execution& execution);

/// The same model for other options: itself where nothing is missing, else built anew with all that
/// it had and what is missing.
/// \throw std::invalid_argument as above
std::shared_ptr<const PreparedModel> prepare(
  const std::shared_ptr<const PreparedModel>& prepared, const InversionOptions& options,
  const Execution& execution);

} // namespace footpoint
