// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/inverter_implementation.h"

#include "footpoint/model/edge_feet.h"
#include "footpoint/search/better_foot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace footpoint
{

/// In the domain of the face: of a foot on an edge, those of the surface.
Parameter<2> PointInverter::Implementation::parameter(const Candidate& candidate) const
{
  const EdgeCurve* edge = this->Patches[candidate.patch].edge;
  return edge ? on_surface(*edge, candidate.foot).parameter : candidate.foot.parameter;
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
  const Parameter<2> at_a = this->parameter(a);
  const Parameter<2> at_b = this->parameter(b);
  for (int i = 0; i < 2; ++i)
  {
    const double u = at_a(i);
    const double v = at_b(i);
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

/// Two meetings of a line that touches, on one face and no farther apart than the touch is long.
bool PointInverter::Implementation::same_touch(const Candidate& a, const Candidate& b) const
{
  /// About √(8 kMeets), twice as much.
  constexpr double kLengthOfTouch = 6e-5;
  return a.foot.touches && b.foot.touches &&
    this->Patches[a.patch].face == this->Patches[b.patch].face &&
    (a.foot.offset - b.foot.offset).norm() <= kLengthOfTouch * this->Size;
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

} // namespace footpoint
