// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/inverter_implementation.h"

#include "footpoint/model/edge_feet.h"
#include "footpoint/search/better_foot.h"

#include <algorithm>

namespace footpoint
{

PatchQuery PointInverter::Implementation::query(const Vector3& point, Sought sought) const
{
  PatchQuery query;
  query.point = point;
  query.sought = sought;
  query.search = this->Options.search;
  query.line = this->Options.fixed_direction;
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

/// Whether a foot settles a part of its patch: it lies there or beside it, and is one of a
/// continuum, or the part is small, and another one near the foot could not be told from it.
bool PointInverter::Implementation::settles(const PatchQuery& query, const Candidate& candidate,
  const PatchStart& start, const Parameter<2>& lower, const Parameter<2>& upper) const
{
  /// A cell of 1/256 × 1/256 of a piece.
  constexpr double kSmall = 0x1p-16;
  const PatchFoot& foot = candidate.foot;
  const PatchSearch& search = *this->Patches[candidate.patch].search;
  if (!search.near(foot, start, lower, upper))
  {
    return false;
  }
  if (query.sought == Sought::Intersection)
  {
    return !foot.isolated || (start.part <= kSmall && foot.touches);
  }
  return (start.part <= kSmall && search.flat(query.point, foot)) ||
    !search.isolated(query.point, foot);
}

/// Whether a foot on a patch is one on its face: no trim loop leaves it out, and where it lies on
/// an edge it is the nearest point near it, in the face as well.
bool PointInverter::Implementation::counts(
  const PatchQuery& query, const Candidate& candidate) const
{
  const PreparedPatch& patch = this->Patches[candidate.patch];
  if (patch.region)
  {
    return patch.region->contains(candidate.foot.local(0), candidate.foot.local(1));
  }
  if (!patch.edge)
  {
    return true;
  }
  // Feet where r is orthogonal to the surface, and meetings, are found on the surface.
  return query.sought == Sought::Minimum &&
    (!this->Options.all_feet ||
      is_minimum_on_face(
        *patch.edge, *this->Prepared->model()[patch.face].region, candidate.foot));
}

/// Calls found(candidate) for what is sought, as far as it is no farther than limit(); the same
/// foot more than once. In global search splines are searched piece by piece; all else from starts.
void PointInverter::Implementation::search(const PatchQuery& query, const Start& start,
  const std::function<double()>& limit, const std::function<void(const Candidate&)>& found) const
{
  const CertifiedFeet* splines =
    this->Options.search == Search::Global ? this->Prepared->certified() : nullptr;
  const auto take = [&](const Candidate& candidate)
  {
    if (this->counts(query, candidate))
    {
      found(candidate);
    }
  };
  if (splines)
  {
    splines->visit_starts(query, limit,
      [&](
        std::size_t k, const PatchStart& from, const Parameter<2>& lower, const Parameter<2>& upper)
      {
        bool settled = false;
        this->Patches[k].search->search_from(query, from,
          [&](const PatchFoot& foot)
          {
            const Candidate candidate{ k, foot };
            take(candidate);
            settled =
              settled || (!from.simple && this->settles(query, candidate, from, lower, upper));
          });
        return settled;
      });
  }
  if (splines && splines->complete())
  {
    return;
  }
  for (const std::size_t k : this->by_bound(query, limit()))
  {
    if ((splines && splines->takes_part(k)) || this->Patches[k].search->bound(query) > limit())
    {
      continue;
    }
    PatchQuery here = query;
    if (start.face < 0 || start.face == this->Patches[k].face)
    {
      here.start = start.parameter;
      here.start(1) = this->Patches[k].patch->curve ? 0.0 : here.start(1);
    }
    this->Patches[k].search->search(here, [&](const PatchFoot& foot) { take({ k, foot }); });
  }
}

/// The best foot first, then those that tie with it.
std::vector<Candidate> PointInverter::Implementation::nearest(
  const Vector3& point, const Start& start, Sought sought) const
{
  std::vector<Candidate> kept;
  double best = this->Options.maximum_distance;
  auto limit = [&] { return best + tie_tolerance(best, this->Size); };
  this->search(this->query(point, sought), start, limit,
    [&](const Candidate& candidate)
    {
      const double distance = candidate.foot.distance;
      if (distance <= limit() && distance <= this->Options.maximum_distance)
      {
        best = std::min(best, distance);
        kept.push_back(candidate);
      }
    });
  kept.erase(std::remove_if(kept.begin(), kept.end(),
               [&](const Candidate& candidate) { return candidate.foot.distance > limit(); }),
    kept.end());
  this->put_best_first(kept);
  return kept;
}

bool PointInverter::Implementation::certifies() const
{
  return this->Prepared->certified() && this->Options.search == Search::Global &&
    !this->wants_lines();
}

/// Whether feet on a patch are points of its face for certain: not on edges where loops meet in a
/// way that does not tell what is kept.
bool PointInverter::Implementation::is_known(std::size_t patch) const
{
  const EdgeCurve* edge = this->Patches[patch].edge;
  return !edge || edge->decided();
}

/// The nearest point, with a certificate where the model is made of splines only.
Foot PointInverter::Implementation::nearest_certified(
  const Vector3& point, PointInverter::Workspace::Memory& memory) const
{
  this->Prepared->certified()->find(point, this->Options.maximum_distance,
    this->Options.certificate_tolerance, memory.search, memory.answers[0]);
  return this->certified_foot(point, memory.answers[0]);
}

Foot PointInverter::Implementation::certified_foot(
  const Vector3& point, const CertifiedAnswer& answer) const
{
  const CertifiedFeet& certified = *this->Prepared->certified();
  Foot foot;
  const bool is_plain = answer.certified && certified.complete() &&
    ((answer.count == 1 && certified.plain_foot(answer.feet[0], foot)) ||
      (answer.count == 2 && certified.plain_kink_foot(answer.feet[0], answer.feet[1], foot)));
  if (is_plain)
  {
    foot.status = this->is_known(certified.member(answer.feet[0])) ? Status::Certified
                                                                    : Status::Converged;
    this->settle_sign(foot, point);
    return foot;
  }
  // Of the feet at a pole, one from each piece, the first in u and v stands for all.
  std::vector<int> distinct;
  for (int k = 0; k < answer.count; ++k)
  {
    const auto same = std::find_if(distinct.begin(), distinct.end(),
      [&](int i) { return certified.at_one_pole(answer.feet[i], answer.feet[k]); });
    if (same == distinct.end())
    {
      distinct.push_back(k);
      continue;
    }
    const Parameter<2> a = certified.patch_foot(answer.feet[k]).parameter;
    const Parameter<2> b = certified.patch_foot(answer.feet[*same]).parameter;
    *same = a(0) < b(0) || (a(0) == b(0) && a(1) < b(1)) ? k : *same;
  }
  const bool is_certified = answer.certified && certified.complete();
  const bool is_held = is_certified && certified.is_held(answer);
  std::vector<Candidate> feet;
  for (const int k : distinct)
  {
    const std::size_t patch = certified.member(answer.feet[k]);
    const PatchFoot found = certified.patch_foot(answer.feet[k]);
    // A foot on the border of a piece need not be a minimum of the whole patch, unless it is held.
    const PatchSearch& search = *this->Patches[patch].search;
    Candidate refined{ patch,
      is_held ? search.classified(point, found) : search.refine(point, found) };
    if (this->Patches[patch].region && !this->counts(this->query(point, Sought::Minimum), refined))
    {
      refined.foot = found; // the way down led out of the face
    }
    feet.push_back(refined);
  }
  if (!is_certified)
  {
    this->add_uncertified(point, !answer.certified, feet);
  }
  if (feet.empty())
  {
    foot.status = Status::BeyondMaximumDistance;
    return foot;
  }
  this->put_best_first(feet);
  foot = this->finish(point, feet.front(), feet);
  // Of feet that tie one is enough, as where an edge ends beside an arc that is undecided.
  const bool is_of_face = std::any_of(feet.begin(), feet.end(),
    [this](const Candidate& candidate) { return this->is_known(candidate.patch); });
  foot.status = is_certified && is_of_face ? Status::Certified : foot.status;
  return foot;
}

/// Adds feet where nothing is proved, as far as they are as near as what there is: on patches that
/// are no splines and, if asked for, on splines by descents on whole patches from all over the
/// pieces that may hold something nearer.
void PointInverter::Implementation::add_uncertified(
  const Vector3& point, bool on_splines, std::vector<Candidate>& feet) const
{
  const CertifiedFeet& certified = *this->Prepared->certified();
  double best = feet.empty() ? this->Options.maximum_distance : feet.front().foot.distance;
  const auto limit = [&] { return best + tie_tolerance(best, this->Size); };
  const PatchQuery query = this->query(point, Sought::Minimum);
  const auto found = [&](std::size_t k, const PatchFoot& foot)
  {
    if (this->counts(query, { k, foot }) && foot.distance <= limit() &&
      foot.distance <= this->Options.maximum_distance)
    {
      best = std::min(best, foot.distance);
      feet.push_back({ k, foot });
    }
  };
  if (on_splines)
  {
    certified.visit_pieces(point, limit,
      [&](std::size_t k, const PatchStart& start)
      {
        this->Patches[k].search->search_from(
          query, start, [&](const PatchFoot& foot) { found(k, foot); });
      });
  }
  for (std::size_t k = 0; k < this->Patches.size(); ++k)
  {
    if (!certified.takes_part(k))
    {
      this->Patches[k].search->search(query, [&](const PatchFoot& foot) { found(k, foot); });
    }
  }
  feet.erase(std::remove_if(feet.begin(), feet.end(),
               [&](const Candidate& candidate) { return candidate.foot.distance > limit(); }),
    feet.end());
}

} // namespace footpoint
