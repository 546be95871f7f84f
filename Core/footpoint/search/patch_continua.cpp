// SPDX-License-Identifier: BSD-3-Clause

// The members of PatchSearchOf that tell whether a foot is the only one near it.
#include "footpoint/search/patch_search_of.h"

#include "footpoint/solvers/foot_conditions.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace footpoint
{
namespace
{

/// How equal the distance of another foot of a continuum has to be, as a fraction of the size.
constexpr double kEqualDistance = 1e-12;

/// Rounding of a second derivative by the size over the square of a knot span: the differences of
/// positions that it is made of, to degree ten and more.
constexpr double kSecondRounding = 1024.0 * std::numeric_limits<double>::epsilon();

/// A slope that many times its floor is one.
constexpr double kClearSlope = 4.0;

/// Scaled eigenvalue of the Hessian below which two minima near each other differ by less than a
/// tie in their distance: E = ¼s⁴ − ½λs² has depth ¼λ².
constexpr double kFlatToRounding = 1e-7;

/// Where on the way between two feet the distance is looked at: three places at no simple ratio, so
/// that equally spaced minima of equal distance do not pass for one.
constexpr double kBetween[] = { 0.17, 0.5, 0.79 };

/// The shorter of the knot spans that meet at a local parameter.
double span_at(const Direction& direction, double t)
{
  const std::vector<double>& spans = direction.spans;
  if (spans.size() < 2)
  {
    return direction.length;
  }
  const auto next = std::upper_bound(spans.begin() + 1, spans.end() - 1, t);
  const double width = *next - *(next - 1);
  const bool is_on_line = *(next - 1) == t && next - 1 != spans.begin();
  return is_on_line ? std::min(width, *(next - 1) - *(next - 2)) : width;
}

/// A scaled eigenvalue of the Hessian above which E curves upwards for certain, and above which
/// descents from kProbe away come back, since the slope there is more than rounding.
template <int N>
double surely_curved(const ParametricGeometry<N>& geometry, const FootConditions<N>& conditions,
  const Frame<N>& frame)
{
  const double size = geometry.size();
  double result = 0.0;
  for (int i = 0; i < N; ++i)
  {
    // S_ii · r in units of |S_i|². Where S stands still nothing is certain.
    const double way = frame.speed(i) * span_at(geometry.direction(i), frame.t(i));
    const double rounding = kSecondRounding * size * (size + frame.distance) / (way * way);
    const double slope = kClearSlope * conditions.floor(frame, i) / (kProbe * size);
    result = std::max({ result, rounding, slope });
  }
  return result;
}

} // namespace

template <int N>
typename PatchSearchOf<N>::Curvatures PatchSearchOf<N>::curvatures(
  const Vector3& point, const PatchFoot& foot) const
{
  const Frame<N> frame =
    make_frame<N>(this->Geometry, this->local(point), foot.local.head<N>(), foot.sides.head<N>());
  const FootConditions<N> conditions(this->Geometry, this->Solver);
  const Eigen::Matrix<bool, N, 1> free = conditions.free(frame);
  typename Frame<N>::Matrix scaled = frame.hessian();
  Curvatures result;
  Parameter<N>& scale = result.scale;
  scale.setZero();
  for (int i = 0; i < N; ++i)
  {
    if (!conditions.stalled(frame, i))
    {
      scale(i) = 1.0 / frame.speed(i);
    }
  }
  scaled = scale.asDiagonal() * scaled * scale.asDiagonal();
  for (int i = 0; i < N; ++i)
  {
    // What a border holds only by rounding may go on, inside or beyond it.
    const bool held =
      !free(i) && std::abs(frame.gradient(i)) * scale(i) > conditions.floor(frame, i);
    if (held || scale(i) == 0.0)
    {
      scaled.row(i).setZero();
      scaled.col(i).setZero();
      scaled(i, i) = 1.0;
    }
  }
  Eigen::SelfAdjointEigenSolver<typename Frame<N>::Matrix> eigen;
  eigen.computeDirect(scaled);
  result.values = eigen.eigenvalues();
  result.directions = eigen.eigenvectors();
  result.frame = frame;
  return result;
}

/// Where E is flat to second order along a direction, a descent is started a little way off on
/// either side: on a continuum it stays there, at an isolated minimum it comes back (or ends
/// farther away). It need not be made where there is no slope but rounding, which it would stay at,
/// nor where E curves upwards for certain.
template <int N>
bool PatchSearchOf<N>::isolated(const Vector3& point, const PatchFoot& foot) const
{
  const Curvatures here = this->curvatures(point, foot);
  const Parameter<N> t = foot.local.head<N>();
  const Vector3 query = this->local(point);
  const FootConditions<N> conditions(this->Geometry, this->Solver);
  const double size = this->Geometry.size();
  const auto is_as_near_beside = [&](const Vector3& at, double distance)
  {
    const double apart = (at - here.frame.jet.point).norm();
    return apart > 0.5 * kProbe * size && apart < 2.0 * kProbe * size &&
      std::abs(distance - foot.distance) <= kEqualDistance * size;
  };
  const double curved = surely_curved(this->Geometry, conditions, here.frame);
  for (int k = 0; k < N; ++k)
  {
    if (here.values(k) > kFlat)
    {
      continue;
    }
    // As long in space as the probe; S_u and S_v need not be orthogonal.
    Parameter<N> step = here.scale.cwiseProduct(here.directions.col(k));
    const double length = (here.frame.jet.first * step).norm();
    step *= kProbe * size / (length > 0.0 ? length : 1.0);
    for (const double sign : { -1.0, 1.0 })
    {
      const Parameter<N> beside = t + sign * step;
      const auto place = conditions.walk().enter(beside);
      const Frame<N> frame = make_frame<N>(this->Geometry, query, place.t, place.sides);
      if (is_as_near_beside(frame.jet.point, frame.distance) && conditions.excess(frame) <= 1.0)
      {
        return false;
      }
      if (here.values(k) > curved)
      {
        continue;
      }
      const LocalFoot<N> other = find_local_foot<N>(this->Geometry, query, beside, this->Solver);
      if (other.converged && is_as_near_beside(other.point, other.distance))
      {
        return false;
      }
    }
  }
  return true;
}

template <int N>
bool PatchSearchOf<N>::flat(const Vector3& point, const PatchFoot& foot) const
{
  return foot.type == FootType::Degenerate ||
    this->curvatures(point, foot).values.cwiseAbs().minCoeff() <= kFlatToRounding;
}

template <int N>
bool PatchSearchOf<N>::level(const Vector3& point, const PatchFoot& a, const PatchFoot& b) const
{
  const double tolerance = tie_tolerance(a.distance, this->Geometry.size());
  if (std::abs(a.distance - b.distance) > tolerance)
  {
    return false;
  }
  const Vector3 query = this->local(point);
  for (const double fraction : kBetween)
  {
    Parameter<N> t;
    for (int i = 0; i < N; ++i)
    {
      const Direction& direction = this->Geometry.direction(i);
      double way = b.local(i) - a.local(i);
      if (direction.closed && std::abs(way) > 0.5 * direction.length)
      {
        way -= std::copysign(direction.length, way); // over the seam is shorter
      }
      t(i) = a.local(i) + fraction * way;
      t(i) += t(i) < 0.0 ? direction.length : (t(i) > direction.length ? -direction.length : 0.0);
    }
    if (std::abs((this->Geometry.point(t) - query).norm() - a.distance) > tolerance)
    {
      return false;
    }
  }
  return true;
}

template bool PatchSearchOf<1>::isolated(const Vector3&, const PatchFoot&) const;
template bool PatchSearchOf<2>::isolated(const Vector3&, const PatchFoot&) const;
template bool PatchSearchOf<1>::flat(const Vector3&, const PatchFoot&) const;
template bool PatchSearchOf<2>::flat(const Vector3&, const PatchFoot&) const;
template bool PatchSearchOf<1>::level(const Vector3&, const PatchFoot&, const PatchFoot&) const;
template bool PatchSearchOf<2>::level(const Vector3&, const PatchFoot&, const PatchFoot&) const;

} // namespace footpoint
