// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/point_inversion.h"

#include "footpoint/model/evaluation.h"
#include "footpoint/model/certified_feet.h"
#include "footpoint/model/shared_borders.h"
#include "footpoint/search/better_foot.h"
#include "footpoint/solvers/foot_conditions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace footpoint
{
namespace
{

/// Cells of all patches together, and the limits for one patch: close boxes on a single surface,
/// bounded memory on a model of thousands.
constexpr std::size_t kCellsOfModel = 65536;
constexpr std::size_t kMaximumCells = 1024;
constexpr std::size_t kMinimumCells = 16;

/// A patch prepared for queries.
struct PreparedPatch
{
  const Patch* patch;
  int face;
  SharedBorders shared; ///< its borders that other patches of the face continue
  std::unique_ptr<PatchSearch> search;
};

struct Candidate
{
  std::size_t patch;
  PatchFoot foot;
};

bool valid(const Vector3& point)
{
  return point.allFinite();
}

} // namespace

struct PointInverter::Workspace::Memory
{
  SearchWorkspace search;
  CertifiedAnswer answer;
};

PointInverter::Workspace::Workspace()
  : Data(std::make_unique<Memory>())
{
}

PointInverter::Workspace::~Workspace() = default;

struct PointInverter::Implementation
{
  Model Faces;
  InversionOptions Options;
  std::vector<PreparedPatch> Patches; ///< in the order of faces
  double Size = 0.0;
  std::optional<CertifiedFeet> Certified; ///< for the nearest point, Search::Global

  Implementation(Model model, const InversionOptions& options);

  bool lower(const Candidate& a, const Candidate& b) const;
  bool better(const Candidate& a, const Candidate& b) const;
  bool same(const Candidate& a, const Candidate& b) const;
  PatchQuery query(const Vector3& point, const Start& start, std::size_t patch) const;
  std::vector<std::size_t> by_bound(const PatchQuery& query, double limit) const;
  std::vector<Candidate> nearest(const Vector3& point, const Start& start, Sought sought) const;
  void put_best_first(std::vector<Candidate>& feet) const;
  void add_uncertified(const Vector3& point, std::vector<Candidate>& feet) const;
  Foot nearest_certified(const Vector3& point, PointInverter::Workspace::Memory& memory) const;
  std::vector<Candidate> every(const Vector3& point, const Start& start) const;
  void thin_out_continua(const Vector3& point, std::vector<Candidate>& feet) const;
  Foot finish(
    const Vector3& point, const Candidate& candidate, const std::vector<Candidate>& others) const;
  Vector3 direction(const Candidate& candidate) const;
  void settle_shared_border(Foot& foot, const Vector3& point, const Candidate& candidate,
    const std::vector<Candidate>& others) const;
};

PointInverter::Implementation::Implementation(Model model, const InversionOptions& options)
  : Faces(std::move(model))
  , Options(options)
{
  if (!options.fixed_direction.isZero(0.0))
  {
    this->Options.fixed_direction.stableNormalize(); // whatever its length
  }
  std::size_t count = 0;
  for (const Face& face : this->Faces)
  {
    count += face.patches.size();
  }
  const bool certify =
    options.search == Search::Global && this->Options.fixed_direction.isZero(0.0);
  const int cells = certify && !options.orthogonal_only && !options.all_feet
    ? 0
    : static_cast<int>(
        std::clamp(kCellsOfModel / std::max<std::size_t>(count, 1), kMinimumCells, kMaximumCells));
  Box box;
  for (std::size_t k = 0; k < this->Faces.size(); ++k)
  {
    const std::vector<SharedBorders> shared = find_shared_borders(this->Faces[k]);
    for (std::size_t i = 0; i < this->Faces[k].patches.size(); ++i)
    {
      const Patch& patch = this->Faces[k].patches[i];
      if (patch.surface)
      {
        make_step<2>(options.solver.method); // throws here, not in the middle of a query
      }
      PreparedPatch prepared{ &patch, static_cast<int>(k), shared[i], nullptr };
      prepared.search = patch.curve
        ? make_patch_search<1>(patch.curve, options.solver, options.seeding, cells)
        : make_patch_search<2>(patch.surface, options.solver, options.seeding, cells);
      box.add(prepared.search->box());
      this->Patches.push_back(std::move(prepared));
    }
  }
  this->Size = count == 0 ? 0.0 : (box.upper - box.lower).stableNorm();
  if (certify && count > 0)
  {
    std::vector<CertifiedFeet::Member> members;
    for (const PreparedPatch& prepared : this->Patches)
    {
      members.push_back({ prepared.patch, prepared.face, this->Faces[prepared.face].reversed,
        prepared.shared });
    }
    const Patch& first = *this->Patches.front().patch;
    const Vector3 own = first.curve ? first.curve->centre() : first.surface->centre();
    const Vector3 middle = box.lower + 0.5 * (box.upper - box.lower);
    this->Certified.emplace(
      std::move(members), count == 1 ? own : middle, this->Size, options.certificate_tolerance);
  }
}

/// Order of face, u, v: the rule for ties.
bool PointInverter::Implementation::lower(const Candidate& a, const Candidate& b) const
{
  if (a.patch == b.patch)
  {
    return this->Patches[a.patch].search->lower(a.foot, b.foot);
  }
  const int face_a = this->Patches[a.patch].face;
  const int face_b = this->Patches[b.patch].face;
  if (face_a != face_b)
  {
    return face_a < face_b;
  }
  for (int i = 0; i < 2; ++i)
  {
    const double u = a.foot.parameter(i);
    const double v = b.foot.parameter(i);
    if (std::abs(u - v) > kSameParameter * std::max(std::abs(u), std::abs(v)))
    {
      return u < v;
    }
  }
  return a.patch < b.patch;
}

/// Nearer; at equal distance the converged one, then lower face, u, v.
bool PointInverter::Implementation::better(const Candidate& a, const Candidate& b) const
{
  if (std::abs(a.foot.distance - b.foot.distance) > tie_tolerance(b.foot.distance, this->Size))
  {
    return a.foot.distance < b.foot.distance;
  }
  return a.foot.converged != b.foot.converged ? a.foot.converged : this->lower(a, b);
}

/// One foot found twice: on one patch by its parameters, on two patches of a face by the point.
bool PointInverter::Implementation::same(const Candidate& a, const Candidate& b) const
{
  if (a.patch == b.patch)
  {
    return this->Patches[a.patch].search->same(a.foot, b.foot);
  }
  return this->Patches[a.patch].face == this->Patches[b.patch].face &&
    (a.foot.offset - b.foot.offset).norm() <= kSamePoint * this->Size;
}

PatchQuery PointInverter::Implementation::query(
  const Vector3& point, const Start& start, std::size_t patch) const
{
  PatchQuery query;
  query.point = point;
  query.search = this->Options.search;
  query.line = this->Options.fixed_direction;
  if (start.face < 0 || start.face == this->Patches[patch].face)
  {
    query.start = start.parameter;
    query.start(1) = this->Patches[patch].patch->curve ? 0.0 : query.start(1);
  }
  return query;
}

/// The patches whose bound is within the limit, nearest first.
std::vector<std::size_t> PointInverter::Implementation::by_bound(
  const PatchQuery& query, double limit) const
{
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < this->Patches.size(); ++k)
  {
    const double bound = this->Patches[k].search->bound(query);
    if (bound <= limit)
    {
      order.emplace_back(bound, k);
    }
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> result;
  for (const auto& entry : order)
  {
    result.push_back(entry.second);
  }
  return result;
}

/// The best foot first, then those that tie with it.
std::vector<Candidate> PointInverter::Implementation::nearest(
  const Vector3& point, const Start& start, Sought sought) const
{
  std::vector<Candidate> kept;
  double best = this->Options.maximum_distance;
  auto limit = [&] { return best + tie_tolerance(best, this->Size); };
  PatchQuery bounds;
  bounds.point = point;
  for (const std::size_t k : this->by_bound(bounds, best))
  {
    PatchQuery query = this->query(point, start, k);
    query.sought = sought;
    if (this->Patches[k].search->bound(query) > limit())
    {
      continue;
    }
    this->Patches[k].search->search(query, limit,
      [&](const PatchFoot& foot)
      {
        if (foot.distance > limit() || foot.distance > this->Options.maximum_distance)
        {
          return;
        }
        best = std::min(best, foot.distance);
        kept.push_back({ k, foot });
      });
  }
  kept.erase(std::remove_if(kept.begin(), kept.end(),
               [&](const Candidate& candidate) { return candidate.foot.distance > limit(); }),
    kept.end());
  this->put_best_first(kept);
  return kept;
}

/// Not a strict order where parameters are nearly equal, so no sort: one pass for the best.
void PointInverter::Implementation::put_best_first(std::vector<Candidate>& feet) const
{
  for (std::size_t k = 1; k < feet.size(); ++k)
  {
    if (this->better(feet[k], feet[0]))
    {
      std::swap(feet[0], feet[k]);
    }
  }
}

/// The nearest point, with a certificate where the model is made of splines only.
Foot PointInverter::Implementation::nearest_certified(
  const Vector3& point, PointInverter::Workspace::Memory& memory) const
{
  const CertifiedFeet& certified = *this->Certified;
  CertifiedAnswer& answer = memory.answer;
  certified.find(point, this->Options.maximum_distance, memory.search, answer);
  Foot foot;
  foot.status = answer.certified ? Status::Certified : Status::Converged;
  if (answer.count == 1 && certified.complete() && certified.plain_foot(answer.feet[0], foot))
  {
    return foot;
  }
  // A foot on the border of a piece need not be a minimum of the whole patch.
  std::vector<Candidate> feet;
  for (int k = 0; k < answer.count; ++k)
  {
    const std::size_t patch = certified.member(answer.feet[k]);
    feet.push_back(
      { patch, this->Patches[patch].search->refine(point, certified.patch_foot(answer.feet[k])) });
  }
  bool is_certified = answer.certified;
  if (!certified.complete())
  {
    is_certified = false;
    this->add_uncertified(point, feet);
  }
  if (feet.empty())
  {
    foot.status = Status::BeyondMaximumDistance;
    return foot;
  }
  this->put_best_first(feet);
  foot = this->finish(point, feet.front(), feet);
  foot.status = is_certified ? Status::Certified : foot.status;
  return foot;
}

/// Adds the feet on patches that are no splines, as far as they are as near as what there is.
void PointInverter::Implementation::add_uncertified(
  const Vector3& point, std::vector<Candidate>& feet) const
{
  double best = feet.empty() ? this->Options.maximum_distance : feet.front().foot.distance;
  auto limit = [&] { return best + tie_tolerance(best, this->Size); };
  for (std::size_t k = 0; k < this->Patches.size(); ++k)
  {
    if (this->Certified->takes_part(k))
    {
      continue;
    }
    this->Patches[k].search->search(this->query(point, {}, k), limit,
      [&](const PatchFoot& foot)
      {
        if (foot.distance <= limit() && foot.distance <= this->Options.maximum_distance)
        {
          best = std::min(best, foot.distance);
          feet.push_back({ k, foot });
        }
      });
  }
  feet.erase(std::remove_if(feet.begin(), feet.end(),
               [&](const Candidate& candidate) { return candidate.foot.distance > limit(); }),
    feet.end());
}

/// All feet, one of each, nearest first.
std::vector<Candidate> PointInverter::Implementation::every(
  const Vector3& point, const Start& start) const
{
  std::vector<Candidate> kept;
  const double limit = this->Options.maximum_distance;
  const bool lines = !this->Options.fixed_direction.isZero();
  PatchQuery bounds;
  bounds.point = point;
  for (const std::size_t k : this->by_bound(bounds, limit))
  {
    PatchQuery query = this->query(point, start, k);
    query.sought = lines ? Sought::Intersection
                         : (this->Options.orthogonal_only ? Sought::Orthogonal : Sought::Minimum);
    this->Patches[k].search->search(
      query, [limit] { return limit; },
      [&](const PatchFoot& foot)
      {
        if (!foot.converged || foot.distance > limit)
        {
          return;
        }
        const Candidate candidate{ k, foot };
        auto known = std::find_if(kept.begin(), kept.end(),
          [&](const Candidate& other)
          {
            return this->same(candidate, other) ||
              (!lines && other.patch == k &&
                this->Patches[k].search->level(point, foot, other.foot));
          });
        if (known == kept.end())
        {
          kept.push_back(candidate);
        }
        else if (this->better(candidate, *known))
        {
          *known = candidate;
        }
      });
  }
  std::stable_sort(kept.begin(), kept.end(),
    [](const Candidate& a, const Candidate& b) { return a.foot.distance < b.foot.distance; });
  // Equal distances by face, u, v: neighbours in the list are exchanged until they are in order.
  for (std::size_t k = 1; k < kept.size(); ++k)
  {
    for (std::size_t i = k; i > 0 && this->better(kept[i], kept[i - 1]); --i)
    {
      std::swap(kept[i], kept[i - 1]);
    }
  }
  this->thin_out_continua(point, kept);
  return kept;
}

/// A continuum of feet counts once a patch and distance, by its lowest parameter.
void PointInverter::Implementation::thin_out_continua(
  const Vector3& point, std::vector<Candidate>& feet) const
{
  std::vector<Candidate> kept;
  bool continuum = false;
  for (const Candidate& candidate : feet)
  {
    const bool tie = !kept.empty() && kept.back().patch == candidate.patch &&
      std::abs(candidate.foot.distance - kept.back().foot.distance) <=
        tie_tolerance(candidate.foot.distance, this->Size);
    const PatchSearch& search = *this->Patches[candidate.patch].search;
    if (tie && !search.isolated(point, candidate.foot) &&
      (continuum || !search.isolated(point, kept.back().foot)))
    {
      continuum = true;
      continue;
    }
    continuum = false;
    kept.push_back(candidate);
  }
  feet = std::move(kept);
}

Vector3 PointInverter::Implementation::direction(const Candidate& candidate) const
{
  const PreparedPatch& prepared = this->Patches[candidate.patch];
  const Patch& patch = *prepared.patch;
  if (patch.curve)
  {
    return unit_tangent(
      *patch.curve, candidate.foot.local.head<1>(), candidate.foot.sides.head<1>());
  }
  const Vector3 normal = mean_normal(*patch.surface, candidate.foot.local, candidate.foot.sides);
  return this->Faces[prepared.face].reversed ? Vector3(-normal) : normal;
}

/// A foot on borders that other patches of the face continue is interior, or on a kink, and its
/// normal is the mean of theirs.
void PointInverter::Implementation::settle_shared_border(Foot& foot, const Vector3& point,
  const Candidate& candidate, const std::vector<Candidate>& others) const
{
  const PreparedPatch& prepared = this->Patches[candidate.patch];
  if ((foot.type != FootType::Edge && foot.type != FootType::Vertex) ||
    !prepared.shared.cover(*prepared.patch, candidate.foot.local))
  {
    return;
  }
  bool orthogonal = prepared.search->orthogonal(point, candidate.foot);
  std::vector<std::size_t> seen{ candidate.patch };
  for (const Candidate& other : others)
  {
    if (this->same(candidate, other) &&
      std::find(seen.begin(), seen.end(), other.patch) == seen.end())
    {
      seen.push_back(other.patch);
      orthogonal = orthogonal && this->Patches[other.patch].search->orthogonal(point, other.foot);
      foot.direction += foot.on_curve ? Vector3(Vector3::Zero()) : this->direction(other);
    }
  }
  if (!foot.direction.isZero())
  {
    foot.direction.normalize();
  }
  foot.type = orthogonal ? FootType::Interior : FootType::Kink;
}

Foot PointInverter::Implementation::finish(
  const Vector3& point, const Candidate& candidate, const std::vector<Candidate>& others) const
{
  const PreparedPatch& prepared = this->Patches[candidate.patch];
  const PatchFoot& found = candidate.foot;
  Foot foot;
  foot.status = found.converged ? Status::Converged : Status::NotConverged;
  foot.type = found.type;
  foot.iterations = found.iterations;
  foot.face = prepared.face;
  foot.on_curve = prepared.patch->curve != nullptr;
  foot.parameter = found.parameter;
  foot.point = found.point;
  foot.distance = found.distance;
  foot.direction = this->direction(candidate);
  this->settle_shared_border(foot, point, candidate, others);
  foot.isolated =
    !this->Options.fixed_direction.isZero() || prepared.search->isolated(point, found);
  if (!foot.on_curve)
  {
    const bool below = -found.offset.dot(foot.direction) < 0.0;
    foot.signed_distance = below ? -foot.distance : foot.distance;
  }
  return foot;
}

PointInverter::PointInverter(Model model, const InversionOptions& options)
  : Data(std::make_unique<Implementation>(std::move(model), options))
{
}

PointInverter::~PointInverter() = default;
PointInverter::PointInverter(PointInverter&&) noexcept = default;
PointInverter& PointInverter::operator=(PointInverter&&) noexcept = default;

const Model& PointInverter::model() const
{
  return this->Data->Faces;
}

const InversionOptions& PointInverter::options() const
{
  return this->Data->Options;
}

double PointInverter::size() const
{
  return this->Data->Size;
}

Foot PointInverter::find(const Vector3& point, const Start& start) const
{
  Workspace workspace;
  return this->find(point, start, workspace);
}

Foot PointInverter::find(const Vector3& point, const Start& start, Workspace& workspace) const
{
  const InversionOptions& options = this->Data->Options;
  Foot none;
  if (!valid(point))
  {
    none.status = Status::InvalidPoint;
    return none;
  }
  none.status = Status::BeyondMaximumDistance;
  if (!options.fixed_direction.isZero())
  {
    const std::vector<Candidate> all = this->Data->every(point, start);
    return all.empty() ? none : this->Data->finish(point, all.front(), {});
  }
  if (options.orthogonal_only)
  {
    const std::vector<Candidate> feet = this->Data->nearest(point, start, Sought::Orthogonal);
    if (!feet.empty())
    {
      return this->Data->finish(point, feet.front(), feet);
    }
  }
  Foot foot = none;
  if (this->Data->Certified)
  {
    foot = this->Data->nearest_certified(point, *workspace.Data);
  }
  else
  {
    const std::vector<Candidate> feet = this->Data->nearest(point, start, Sought::Minimum);
    foot = feet.empty() ? none : this->Data->finish(point, feet.front(), feet);
  }
  if (options.orthogonal_only && foot.status != Status::BeyondMaximumDistance)
  {
    foot.status = Status::NoOrthogonalFoot;
  }
  return foot;
}

std::vector<Foot> PointInverter::find_all(const Vector3& point, const Start& start) const
{
  const InversionOptions& options = this->Data->Options;
  std::vector<Foot> result;
  if (options.all_feet || !options.fixed_direction.isZero())
  {
    const std::vector<Candidate> all =
      valid(point) ? this->Data->every(point, start) : std::vector<Candidate>{};
    for (const Candidate& candidate : all)
    {
      result.push_back(this->Data->finish(point, candidate, {}));
    }
    return result;
  }
  const Foot foot = this->find(point, start);
  if (foot.status != Status::InvalidPoint && foot.status != Status::BeyondMaximumDistance)
  {
    result.push_back(foot);
  }
  return result;
}

} // namespace footpoint
