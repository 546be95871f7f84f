// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/inverter_implementation.h"

#include "footpoint/search/better_foot.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{

/// All feet, one of each, nearest first.
std::vector<Candidate> PointInverter::Implementation::every(
  const Vector3& point, const Start& start) const
{
  std::vector<Candidate> kept;
  const double limit = this->Options.maximum_distance;
  const bool lines = this->wants_lines();
  const Sought sought = lines
    ? Sought::Intersection
    : (this->Options.orthogonal_only ? Sought::Orthogonal : Sought::Minimum);
  this->search(
    this->query(point, sought), start, [limit] { return limit; },
    [&](const Candidate& candidate)
    {
      const PatchFoot& foot = candidate.foot;
      if (!foot.converged || foot.distance > limit)
      {
        return;
      }
      const auto known = std::find_if(kept.begin(), kept.end(),
        [&](const Candidate& other)
        {
          return this->same(candidate, other) ||
            (lines ? this->same_touch(candidate, other)
                   : other.patch == candidate.patch &&
                  this->Patches[other.patch].search->level(point, foot, other.foot));
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
  if (lines)
  {
    this->thin_out_lines(kept);
  }
  else
  {
    this->thin_out_continua(point, kept);
  }
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

/// Where the line lies in a patch, the nearest of the points found there stands for all.
void PointInverter::Implementation::thin_out_lines(std::vector<Candidate>& feet) const
{
  std::vector<std::size_t> seen;
  std::vector<Candidate> kept;
  for (const Candidate& candidate : feet)
  {
    const bool known = std::find(seen.begin(), seen.end(), candidate.patch) != seen.end();
    if (candidate.foot.isolated || !known)
    {
      kept.push_back(candidate);
    }
    if (!candidate.foot.isolated)
    {
      seen.push_back(candidate.patch);
    }
  }
  feet = std::move(kept);
}

/// The nearest foot and those of the list come from two searches. Of a continuum the list gets the
/// same foot, and where the nearest is missing it is put in.
void PointInverter::Implementation::put_nearest_in(std::vector<Foot>& feet, Foot nearest) const
{
  const bool certified = nearest.status == Status::Certified;
  nearest.status = certified ? Status::Converged : nearest.status; // nothing is proved of a list
  const double tie = tie_tolerance(nearest.distance, this->Size);
  auto continuum = feet.end();
  for (auto foot = feet.begin(); foot != feet.end() && foot->distance <= nearest.distance + tie;
       ++foot)
  {
    if (foot->face != nearest.face || foot->distance < nearest.distance - tie)
    {
      continue;
    }
    const bool is_continuum = !foot->isolated && !nearest.isolated;
    if ((foot->point - nearest.point).norm() <= kSamePoint * this->Size)
    {
      *foot = is_continuum ? nearest : *foot;
      return;
    }
    if (continuum == feet.end() && is_continuum)
    {
      continuum = foot;
    }
  }
  if (continuum != feet.end())
  {
    *continuum = nearest;
  }
  else if (certified && (feet.empty() || nearest.distance < feet.front().distance - tie))
  {
    feet.insert(feet.begin(), nearest);
  }
}

} // namespace footpoint
