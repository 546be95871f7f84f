// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/prepared_model.h"

#include "footpoint/solvers/step.h"

#include <algorithm>

namespace footpoint
{
namespace
{

/// To which edges of trimmed faces are known in space, as a fraction of the size: a tenth of the
/// default tolerance of certificates.
constexpr double kEdgeTolerance = 1e-13;

/// Progress when faces, edges and what meets at them are done: of the time that it takes to build
/// an assembly of trimmed faces.
constexpr double kAtEdges = 0.2;
constexpr double kAtNeighbours = 0.35;
constexpr double kAtPieces = 0.8;

std::size_t number_of_patches(const Model& model)
{
  std::size_t count = 0;
  for (const Face& face : model)
  {
    count += face.patches.size();
  }
  return count;
}

/// Whether there are two surfaces, or one that is trimmed and so may meet itself.
bool has_neighbours(const Model& model)
{
  const auto surfaces = std::count_if(model.begin(), model.end(),
    [](const Face& face) { return !face.patches.empty() && face.patches.front().surface; });
  return surfaces > 1 ||
    std::any_of(
      model.begin(), model.end(), [](const Face& face) { return face.region != nullptr; });
}

/// Throws here, not in the middle of a query.
void check_method(const Model& model, Method method)
{
  for (const Face& face : model)
  {
    for (const Patch& patch : face.patches)
    {
      if (patch.surface)
      {
        make_step<2>(method);
        return;
      }
    }
  }
}

} // namespace

PreparedParts::PreparedParts(const InversionOptions& options)
  : seed_resolution(options.seeding.resolution)
{
  this->pieces = options.search == Search::Global;
}

bool PreparedParts::include(const PreparedParts& others) const
{
  return this->seed_resolution == others.seed_resolution &&
    this->pieces >= others.pieces;
}

PreparedParts PreparedParts::joined_with(const PreparedParts& others) const
{
  PreparedParts result = others;
  result.pieces = this->pieces || others.pieces;
  return result;
}

PreparedModel::PreparedModel(
  Model model, const PreparedParts& parts, const Execution& execution)
  : Faces(std::move(model))
  , Parts(parts)
{
  const std::size_t count = number_of_patches(this->Faces);
  if (count == 0)
  {
    return;
  }
  SeedOptions seeding;
  seeding.resolution = parts.seed_resolution;
  const Box box = this->add_faces(seeding, part_of(execution, 0.0, kAtEdges));
  this->Size = (box.upper - box.lower).stableNorm();
  const std::vector<EdgePieces> edge_pieces =
    this->add_edges(seeding, part_of(execution, kAtEdges, kAtNeighbours - kAtEdges));
  std::vector<CertifiedFeet::Member> members;
  for (std::size_t k = 0; k < this->Patches.size(); ++k)
  {
    const PreparedPatch& patch = this->Patches[k];
    members.push_back({ patch.patch, patch.face, this->Faces[patch.face].reversed, patch.shared,
      patch.region, patch.edge, patch.edge ? &edge_pieces[k - count] : nullptr });
  }
  this->AtPoles = PoleNormals(this->Faces);
  if (has_neighbours(this->Faces))
  {
    this->Neighbours.emplace(this->Faces, this->Size,
      part_of(execution, kAtNeighbours, kAtPieces - kAtNeighbours));
  }
  if (parts.pieces)
  {
    const Patch& first = *this->Patches.front().patch;
    const Vector3 own = first.curve ? first.curve->centre() : first.surface->centre();
    const Vector3 middle = box.lower + 0.5 * (box.upper - box.lower);
    this->Certified.emplace(
      std::move(members), count == 1 ? own : middle, this->Size,
      part_of(execution, kAtPieces, 1.0 - kAtPieces));
  }
}

/// Adds the patches of all faces; returns the box around them.
Box PreparedModel::add_faces(const SeedOptions& seeding, const Execution& execution)
{
  std::vector<std::vector<PreparedPatch>> patches(this->Faces.size());
  for_each_index(execution, static_cast<std::int64_t>(this->Faces.size()), kFacesForThreads,
    [&](std::int64_t k)
    {
      Face& face = this->Faces[k];
      if (!face.loops.empty() && !face.region)
      {
        trim(face);
      }
      const std::vector<SharedBorders> shared = find_shared_borders(face);
      for (std::size_t i = 0; i < face.patches.size(); ++i)
      {
        const Patch& patch = face.patches[i];
        PreparedPatch prepared{ &patch, static_cast<int>(k), shared[i], face.region.get(),
          nullptr, nullptr };
        prepared.search = patch.curve
          ? make_patch_search<1>(patch.curve, SolverOptions{}, seeding)
          : make_patch_search<2>(patch.surface, SolverOptions{}, seeding);
        patches[k].push_back(std::move(prepared));
      }
    });
  Box box;
  for (std::vector<PreparedPatch>& of_face : patches)
  {
    for (PreparedPatch& patch : of_face)
    {
      box.add(patch.search->box());
      this->Patches.push_back(std::move(patch));
    }
  }
  return box;
}

/// Adds the edges of all trimmed faces behind the patches; returns their pieces in the same order.
std::vector<EdgePieces> PreparedModel::add_edges(
  const SeedOptions& seeding, const Execution& execution)
{
  struct Edge
  {
    std::unique_ptr<const Patch> patch;
    PreparedPatch prepared;
    EdgePieces pieces;
  };
  std::vector<std::vector<Edge>> edges(this->Faces.size());
  for_each_index(execution, static_cast<std::int64_t>(this->Faces.size()), kFacesForThreads,
    [&](std::int64_t k)
    {
      const Face& face = this->Faces[k];
      if (!face.region || face.patches.empty())
      {
        return;
      }
      const auto surface = std::dynamic_pointer_cast<const Surface>(face.patches.front().surface);
      for (const std::shared_ptr<const EdgeCurve>& edge :
        edge_curves(surface, *face.region, EdgeArcs::InsideDomain))
      {
        EdgePieces pieces = edge_pieces(*edge, kEdgeTolerance * this->Size);
        Box box;
        for (const BezierPiece<1>& piece : pieces.pieces)
        {
          const std::array<Vector3, 2> corners = bounding_box<1>(piece);
          box.add({ corners[0], corners[1] });
        }
        auto patch = std::make_unique<const Patch>(Patch{ edge, nullptr });
        PreparedPatch prepared{ patch.get(), static_cast<int>(k), {}, nullptr, edge.get(),
          make_patch_search<1>(edge, SolverOptions{}, seeding, box) };
        edges[k].push_back({ std::move(patch), std::move(prepared), std::move(pieces) });
      }
    });
  std::vector<EdgePieces> result;
  for (std::vector<Edge>& of_face : edges)
  {
    for (Edge& edge : of_face)
    {
      this->Edges.push_back(std::move(edge.patch));
      this->Patches.push_back(std::move(edge.prepared));
      result.push_back(std::move(edge.pieces));
    }
  }
  return result;
}

std::vector<PreparedPatch> PreparedModel::patches(const InversionOptions& options) const
{
  std::vector<PreparedPatch> result;
  result.reserve(this->Patches.size());
  for (const PreparedPatch& patch : this->Patches)
  {
    result.push_back({ patch.patch, patch.face, patch.shared, patch.region, patch.edge,
      patch.search->with(options.solver, options.seeding.number_of_seeds) });
  }
  return result;
}

std::shared_ptr<const PreparedModel> prepare(
  Model model, const InversionOptions& options, const Execution& execution)
{
  check_method(model, options.solver.method);
  return std::make_shared<const PreparedModel>(
    std::move(model), PreparedParts(options), execution);
}

std::shared_ptr<const PreparedModel> prepare(
  const std::shared_ptr<const PreparedModel>& prepared, const InversionOptions& options,
  const Execution& execution)
{
  check_method(prepared->model(), options.solver.method);
  const PreparedParts wanted(options);
  if (prepared->parts().include(wanted))
  {
    return prepared;
  }
  return std::make_shared<const PreparedModel>(
    prepared->model(), prepared->parts().joined_with(wanted), execution);
}

} // namespace footpoint
