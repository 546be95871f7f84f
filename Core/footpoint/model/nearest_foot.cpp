// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/inverter_implementation.h"

#include "footpoint/search/better_foot.h"

#include <algorithm>

namespace footpoint
{

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

bool PointInverter::Implementation::certifies() const
{
  return this->Prepared->certified() && this->Options.search == Search::Global &&
    !this->wants_lines();
}

/// The nearest point, with a certificate where the model is made of splines only.
Foot PointInverter::Implementation::nearest_certified(
  const Vector3& point, PointInverter::Workspace::Memory& memory) const
{
  const CertifiedFeet& certified = *this->Prepared->certified();
  CertifiedAnswer& answer = memory.answer;
  certified.find(point, this->Options.maximum_distance, this->Options.certificate_tolerance,
    memory.search, answer);
  Foot foot;
  foot.status = answer.certified ? Status::Certified : Status::Converged;
  if (answer.count == 1 && answer.certified && certified.complete() &&
    certified.plain_foot(answer.feet[0], foot))
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
  if (!answer.certified)
  {
    // No proof: descents on whole patches, from every cell that may hold something nearer.
    for (const Candidate& candidate : this->nearest(point, {}, Sought::Minimum))
    {
      feet.push_back(candidate);
    }
  }
  else if (!certified.complete())
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
    if (this->Prepared->certified()->takes_part(k))
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

} // namespace footpoint
