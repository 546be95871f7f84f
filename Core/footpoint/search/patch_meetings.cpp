// SPDX-License-Identifier: BSD-3-Clause

// The members of PatchSearchOf that find where a line meets a patch: its feet, seen along the line.
#include "footpoint/search/patch_search_of.h"

#include "footpoint/solvers/domain_walk.h"
#include "footpoint/solvers/foot_conditions.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace footpoint
{
namespace
{

/// Sine between a line and the geometry below which it touches: it then is closer than kMeets to
/// the geometry over as long a way.
constexpr double kTouching = 3e-5;

/// A meeting that many probes away is another point of the line; no probe is a longer part of the
/// domain.
constexpr double kApart = 0.05;
constexpr double kLongestStep = 0.1;

} // namespace

template <int N>
void PatchSearchOf<N>::intersection(const PatchQuery& query, const PatchStart& start,
  const std::function<void(const PatchFoot&)>& found) const
{
  const FlattenedGeometry<N> flat(this->Geometry, query.line);
  const Vector3 at = flat.flatten(this->local(query.point));
  const LocalFoot<N> foot =
    find_local_foot<N>(flat, at, Parameter<N>(start.local.head<N>()), this->nearby(start));
  std::optional<PatchFoot> met = this->meeting(query, foot);
  if (!met)
  {
    return;
  }
  this->look_along(query, flat, *met);
  found(*met);
  if (!met->isolated)
  {
    // Of the line's part in the geometry the point nearest to the query.
    const LocalFoot<N> nearest =
      find_local_foot<N>(this->Geometry, this->local(query.point), foot.parameter, this->Solver);
    if ((met = this->meeting(query, nearest)))
    {
      met->isolated = false;
      found(*met);
    }
  }
}

template <int N>
std::optional<PatchFoot> PatchSearchOf<N>::meeting(const PatchQuery& query, LocalFoot<N> foot) const
{
  const Vector3 at = this->local(query.point);
  foot.point = this->Geometry.jet(foot.parameter, foot.sides, 0).point;
  const double along = (foot.point - at).dot(query.line);
  if ((foot.point - at - along * query.line).norm() > kMeets * this->Geometry.size())
  {
    return std::nullopt;
  }
  foot.distance = std::abs(along);
  foot.converged = true;
  // Of the geometry itself; the flattened one stands still wherever the line touches it.
  const FootConditions<N> conditions(this->Geometry, this->Solver);
  foot.type = conditions.classify(
    make_frame<N>(this->Geometry, foot.point, foot.parameter, foot.sides), foot.point);
  return this->lift(query.point, foot);
}

template <int N>
void PatchSearchOf<N>::look_along(
  const PatchQuery& query, const FlattenedGeometry<N>& flat, PatchFoot& foot) const
{
  const DomainWalk<N> walk(this->Geometry);
  const typename DomainWalk<N>::Place place{ foot.local.head<N>(), foot.sides.head<N>() };
  std::vector<typename DomainWalk<N>::Place> places = walk.neighbours(place);
  places.push_back(place);
  for (const auto& here : places)
  {
    const Jet<N> jet = this->Geometry.jet(here.t, here.sides, 1);
    const Jet<N> seen = flat.jet(here.t, here.sides, 1);
    Parameter<N> scale;
    for (int i = 0; i < N; ++i)
    {
      // Where S_i vanishes, a step is a part of the domain.
      const double longest = kLongestStep * this->Geometry.direction(i).length;
      scale(i) = 1.0 / std::max(jet.first.col(i).norm(), kProbe * this->Geometry.size() / longest);
    }
    const Eigen::Matrix<double, 3, N> tangents = seen.first * scale.asDiagonal();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen;
    eigen.computeDirect(tangents.transpose() * tangents);
    const double sine = eigen.eigenvalues()(0);
    foot.touches = foot.touches || sine <= kTouching * kTouching;
    if (sine <= kFlat)
    {
      const Parameter<N> step = scale.cwiseProduct(eigen.eigenvectors().col(0));
      foot.isolated = foot.isolated && !this->meets_again(query, flat, foot, step);
    }
  }
}

template <int N>
bool PatchSearchOf<N>::meets_again(const PatchQuery& query, const FlattenedGeometry<N>& flat,
  const PatchFoot& foot, const Parameter<N>& step) const
{
  const double size = this->Geometry.size();
  const Vector3 at = flat.flatten(this->local(query.point));
  const Parameter<N> t = foot.local.head<N>();
  for (const double way : { -kProbe * size, kProbe * size })
  {
    const LocalFoot<N> other =
      find_local_foot<N>(flat, at, Parameter<N>(t + way * step), this->Solver);
    const Vector3 there = this->Geometry.jet(other.parameter, other.sides, 0).point;
    const double apart = (there - foot.offset - this->local(query.point)).norm();
    if (other.distance <= kMeets * size && apart > kApart * kProbe * size &&
      apart < 2.0 * kProbe * size)
    {
      return true;
    }
  }
  return false;
}

template void PatchSearchOf<1>::intersection(
  const PatchQuery&, const PatchStart&, const std::function<void(const PatchFoot&)>&) const;
template void PatchSearchOf<2>::intersection(
  const PatchQuery&, const PatchStart&, const std::function<void(const PatchFoot&)>&) const;

} // namespace footpoint
