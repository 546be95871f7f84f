// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/patch_search.h"

#include "footpoint/search/better_foot.h"
#include "footpoint/search/flattened_geometry.h"
#include "footpoint/search/stationary_search.h"
#include "footpoint/solvers/domain_walk.h"
#include "footpoint/solvers/foot_conditions.h"

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <optional>

namespace footpoint
{
namespace
{

/// Geometry that is no spline has no boxes: a dense grid takes the place of the cells.
constexpr SeedOptions kDenseSeeds{ 31, 16 };

/// Scaled eigenvalue of the Hessian below which a foot may be one of a continuum, how far off (as a
/// fraction of the size) another one is looked for, and how equal its distance has to be.
constexpr double kFlat = 1e-6;
constexpr double kProbe = 1e-2;
constexpr double kEqualDistance = 1e-12;

/// Above this part of what it is summed from an eigenvalue is no rounding, and above kCurved descents from
/// beside the foot come back: at kProbe the slope is a hundredth of it.
constexpr double kNoRounding = 64.0 * std::numeric_limits<double>::epsilon();
constexpr double kCurved = 1e-10;

/// Scaled eigenvalue of the Hessian below which two minima near each other differ by less than a
/// tie in their distance: E = ¼s⁴ − ½λs² has depth ¼λ².
constexpr double kFlatToRounding = 1e-7;

/// Sine between a line and the geometry below which it touches: it then is closer than kMeets to
/// the geometry over as long a way.
constexpr double kTouching = 3e-5;

/// A meeting that many probes away is another point of the line; no probe is a longer part of the
/// domain.
constexpr double kApart = 0.05;
constexpr double kLongestStep = 0.1;

/// Where on the way between two feet the distance is looked at: three places at no simple ratio, so
/// that equally spaced minima of equal distance do not pass for one.
constexpr double kBetween[] = { 0.17, 0.5, 0.79 };

Box box_around(const Points& points)
{
  return { points.rowwise().minCoeff(), points.rowwise().maxCoeff() };
}

/// The box of the control points of a geometry that is a spline; an empty one of another.
Box control_box(const ParametricCurve& geometry)
{
  const auto* curve = dynamic_cast<const Curve*>(&geometry);
  return curve ? box_around(curve->local_control_points()) : Box{};
}

Box control_box(const ParametricSurface& geometry)
{
  const auto* surface = dynamic_cast<const Surface*>(&geometry);
  return surface ? box_around(surface->local_control_points()) : Box{};
}

/// What queries with any options share.
template <int N>
struct PatchParts
{
  PatchParts(std::shared_ptr<const ParametricGeometry<N>> geometry, int seed_resolution,
    const Box& bounds)
    : Shared(std::move(geometry))
    , Bounds(bounds.empty() ? control_box(*this->Shared) : bounds)
    , Spline(!this->Bounds.empty())
    , Seeds(*this->Shared, SeedOptions{ seed_resolution, 1 })
    , Dense(*this->Shared, this->Spline ? SeedOptions{ 2, 1 } : kDenseSeeds)
  {
    if (!this->Spline)
    {
      this->Bounds = this->Dense.box();
    }
  }

  std::shared_ptr<const ParametricGeometry<N>> Shared;
  Box Bounds;  ///< of the control points, of samples where there are none
  bool Spline; ///< Bounds holds the geometry
  SeededSearch<N> Seeds;
  SeededSearch<N> Dense;
};

template <int N>
class PatchSearchOf : public PatchSearch
{
public:
  PatchSearchOf(
    std::shared_ptr<const PatchParts<N>> parts, const SolverOptions& solver, int number_of_seeds)
    : Parts(std::move(parts))
    , Geometry(*this->Parts->Shared)
    , Solver(solver)
    , NumberOfSeeds(number_of_seeds)
    , Bounds(this->Parts->Bounds)
    , Spline(this->Parts->Spline)
    , Seeds(this->Parts->Seeds)
    , Dense(this->Parts->Dense)
  {
  }

  std::unique_ptr<PatchSearch> with(const SolverOptions& solver, int number_of_seeds) const override
  {
    return std::make_unique<PatchSearchOf<N>>(this->Parts, solver, number_of_seeds);
  }

  double bound(const PatchQuery& query) const override
  {
    if (!this->Spline)
    {
      return 0.0;
    }
    const Vector3 at = this->local(query.point);
    return query.sought == Sought::Intersection ? this->distance_of_line(at, query.line)
                                                : this->Bounds.distance(at);
  }

  void search(
    const PatchQuery& query, const std::function<void(const PatchFoot&)>& found) const override;

  void search_from(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const override
  {
    switch (query.sought)
    {
      case Sought::Minimum:
        return this->minimum(query, start, found);
      case Sought::Orthogonal:
        return this->orthogonal_foot(query, start, found);
      case Sought::Intersection:
        return this->intersection(query, start, found);
    }
  }

  bool isolated(const Vector3& point, const PatchFoot& foot) const override;

  bool flat(const Vector3& point, const PatchFoot& foot) const override;

  PatchFoot refine(const Vector3& point, const PatchFoot& foot) const override
  {
    SolverOptions solver = this->Solver;
    solver.safeguards = true;
    solver.method = Method::Newton;
    const LocalFoot<N> found = find_local_foot<N>(
      this->Geometry, this->local(point), Parameter<N>(foot.local.head<N>()), solver);
    const Vector3 query = this->local(point);
    const FootConditions<N> conditions(this->Geometry, this->Solver);
    const Frame<N> here =
      make_frame<N>(this->Geometry, query, foot.local.head<N>(), foot.sides.head<N>());
    const Frame<N> there = make_frame<N>(this->Geometry, query, found.parameter, found.sides);
    const double tie = tie_tolerance(foot.distance, this->Geometry.size());
    if (found.distance < foot.distance ||
      (found.distance <= foot.distance + tie && conditions.excess(there) < conditions.excess(here)))
    {
      PatchFoot result = this->lift(point, found);
      result.iterations += foot.iterations;
      return result;
    }
    PatchFoot result = foot;
    result.type = conditions.classify(here, query);
    return result;
  }

  PatchFoot classified(const Vector3& point, const PatchFoot& foot) const override
  {
    const Vector3 query = this->local(point);
    const FootConditions<N> conditions(this->Geometry, this->Solver);
    PatchFoot result = foot;
    result.type = conditions.classify(
      make_frame<N>(this->Geometry, query, foot.local.head<N>(), foot.sides.head<N>()), query);
    return result;
  }

  bool orthogonal(const Vector3& point, const PatchFoot& foot) const override
  {
    LocalFoot<N> local;
    local.parameter = foot.local.head<N>();
    local.sides = foot.sides.head<N>();
    return is_orthogonal<N>(this->Geometry, this->local(point), local, this->Solver);
  }

  Box box() const override
  {
    Box box = this->Bounds;
    box.lower += this->Geometry.centre();
    box.upper += this->Geometry.centre();
    return box;
  }

  double size() const override { return this->Geometry.size(); }

  bool near(const PatchFoot& foot, const PatchStart& start, const Parameter<2>& lower,
    const Parameter<2>& upper) const override;

  bool same(const PatchFoot& a, const PatchFoot& b) const override;

  bool level(const Vector3& point, const PatchFoot& a, const PatchFoot& b) const override;

  bool lower(const PatchFoot& a, const PatchFoot& b) const override
  {
    const Parameter<N> at_a = a.local.head<N>();
    const Parameter<N> at_b = b.local.head<N>();
    if (is_lower_parameter<N>(at_a, at_b, this->Geometry))
    {
      return true;
    }
    return !is_lower_parameter<N>(at_b, at_a, this->Geometry) && this->is_left_of_gap(a, b);
  }

private:
  Vector3 local(const Vector3& point) const { return point - this->Geometry.centre(); }

  /// Whether two feet with the same parameter lie on two sides of a gap, a on the left one.
  bool is_left_of_gap(const PatchFoot& a, const PatchFoot& b) const
  {
    const bool apart = (a.offset - b.offset).norm() > kSamePoint * this->Geometry.size();
    bool left = false;
    for (int i = N - 1; i >= 0 && apart; --i)
    {
      if (a.local(i) == b.local(i) && a.sides(i) != b.sides(i))
      {
        left = a.sides(i) == Side::Left;
      }
    }
    return left;
  }

  /// From the sphere around the box.
  double distance_of_line(const Vector3& point, const Vector3& line) const
  {
    const Vector3 to_middle = 0.5 * (this->Bounds.lower + this->Bounds.upper) - point;
    const double across = (to_middle - line * line.dot(to_middle)).norm();
    return std::max(0.0, across - 0.5 * (this->Bounds.upper - this->Bounds.lower).norm());
  }

  /// The solver's options for a start that stands for a cell of a given reach.
  SolverOptions nearby(const PatchStart& start) const
  {
    SolverOptions result = this->Solver;
    if (std::isfinite(start.reach) && !start.pole && this->Geometry.size() > 0.0)
    {
      result.first_trust_radius = start.reach / this->Geometry.size();
      result.stop_at_borders = true;
    }
    return result;
  }

  PatchFoot lift(const Vector3& point, const LocalFoot<N>& foot) const
  {
    PatchFoot result;
    result.local.template head<N>() = foot.parameter;
    result.sides.template head<N>() = foot.sides;
    result.parameter.template head<N>() = this->Geometry.to_domain(foot.parameter);
    result.offset = foot.point - this->local(point);
    result.point = this->Geometry.centre() + foot.point;
    result.distance = foot.distance;
    result.converged = foot.converged;
    result.type = foot.type;
    result.iterations = foot.iterations;
    return result;
  }

  void minimum(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const
  {
    found(this->lift(query.point,
      this->Seeds.find_from(
        this->local(query.point), Parameter<N>(start.local.head<N>()), this->nearby(start))));
  }

  void orthogonal_foot(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const
  {
    const Vector3 at = this->local(query.point);
    const Parameter<N> t = start.local.head<N>();
    if (!start.simple)
    {
      const LocalFoot<N> minimum = this->Seeds.find_from(at, t, this->nearby(start));
      if (is_orthogonal<N>(this->Geometry, at, minimum, this->Solver))
      {
        found(this->lift(query.point, minimum));
      }
    }
    if (const auto foot = find_orthogonal_foot<N>(this->Geometry, at, t, this->Solver))
    {
      found(this->lift(query.point, *foot));
    }
  }

  void intersection(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const;

  /// A point of the geometry as a meeting, where the line passes through it.
  std::optional<PatchFoot> meeting(const PatchQuery& query, LocalFoot<N> foot) const;

  /// Sets whether a line touches the geometry at a meeting, and whether it lies in it near there:
  /// it runs along it, and meets it again a little way off.
  void look_along(const PatchQuery& query, const FlattenedGeometry<N>& flat, PatchFoot& foot) const;
  bool meets_again(const PatchQuery& query, const FlattenedGeometry<N>& flat, const PatchFoot& foot,
    const Parameter<N>& step) const;

  /// The Hessian of E at a foot, in units of |S_i|: directions that a border holds, or in which S
  /// stands still, count 1.
  struct Curvatures
  {
    Parameter<N> values;
    Eigen::Matrix<double, N, N> directions;
    Parameter<N> scale; ///< 1 / |S_i|, 0 where S stands still
    Jet<N> jet;
  };
  Curvatures curvatures(const Vector3& point, const PatchFoot& foot) const;

  std::shared_ptr<const PatchParts<N>> Parts;
  const ParametricGeometry<N>& Geometry;
  SolverOptions Solver;
  int NumberOfSeeds;
  Box Bounds;
  bool Spline;
  const SeededSearch<N>& Seeds;
  const SeededSearch<N>& Dense;
};

/// From the given start, then from samples.
template <int N>
void PatchSearchOf<N>::search(
  const PatchQuery& query, const std::function<void(const PatchFoot&)>& found) const
{
  auto from = [&](const Parameter<N>& t)
  {
    PatchStart start{ Parameter<2>::Zero() };
    start.local.template head<N>() = t;
    this->search_from(query, start, found);
  };
  const Parameter<N> given = this->Geometry.to_local(query.start.head<N>());
  const bool has_start = given.allFinite();
  if (has_start)
  {
    from(given);
  }
  if (query.search == Search::Local && has_start)
  {
    return;
  }
  const bool dense = query.search == Search::Global;
  const SeededSearch<N>& seeds = dense ? this->Dense : this->Seeds;
  if (query.sought != Sought::Minimum && query.search != Search::Local)
  {
    // Maxima and intersections need not be near a sampled minimum.
    for (Eigen::Index k = 0; k < seeds.number_of_samples(); ++k)
    {
      from(seeds.parameter(k));
    }
    return;
  }
  const int count =
    query.search == Search::Local ? 1 : (dense ? kDenseSeeds.number_of_seeds : this->NumberOfSeeds);
  for (const Parameter<N>& seed : seeds.seeds(this->local(query.point), count))
  {
    from(seed);
  }
}

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

template <int N>
bool PatchSearchOf<N>::near(const PatchFoot& foot, const PatchStart& start,
  const Parameter<2>& lower, const Parameter<2>& upper) const
{
  if (foot.type == FootType::Degenerate)
  {
    const Vector3 from = this->Geometry.point(Parameter<N>(start.local.head<N>()));
    return (foot.point - this->Geometry.centre() - from).norm() <= start.reach;
  }
  bool result = true;
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    const double apart = std::abs(foot.local(i) - 0.5 * (lower(i) + upper(i)));
    const double across = direction.closed ? direction.length - apart : apart;
    result = result && std::min(apart, across) <= upper(i) - lower(i);
  }
  return result;
}

template <int N>
bool PatchSearchOf<N>::same(const PatchFoot& a, const PatchFoot& b) const
{
  const double apart = (a.offset - b.offset).norm();
  // A pole has many parameters, and a gap one parameter for two points.
  const bool poles = a.type == FootType::Degenerate && b.type == FootType::Degenerate;
  if (poles && apart <= kSamePoint * this->Geometry.size())
  {
    return true;
  }
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    const double difference = std::abs(a.local(i) - b.local(i));
    const double across = direction.closed ? direction.length - difference : difference;
    if (std::min(difference, across) > kSameParameter * direction.length)
    {
      return false;
    }
  }
  return !this->is_left_of_gap(a, b) && !this->is_left_of_gap(b, a);
}

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
  result.jet = frame.jet;
  return result;
}

/// A minimum about which E curves upwards is isolated. Where E is flat to second order along a direction, a
/// descent is started a little way off on either side: on a continuum it stays there, at an isolated
/// minimum it comes back (or ends farther away). It need not be made where there is no slope but rounding.
template <int N>
bool PatchSearchOf<N>::isolated(const Vector3& point, const PatchFoot& foot) const
{
  const Curvatures here = this->curvatures(point, foot);
  const Parameter<N> t = foot.local.head<N>();
  const Vector3 query = this->local(point);
  const FootConditions<N> conditions(this->Geometry, this->Solver);
  const double size = this->Geometry.size();
  double summed = 1.0;
  for (int i = 0; i < N; ++i)
  {
    for (int j = i; j < N; ++j)
    {
      const double second = here.jet.second.col(i + j).norm();
      summed = std::max(summed, here.scale(i) * here.scale(j) * second * (size + foot.distance));
    }
  }
  const double flat = std::clamp(kNoRounding * summed, kCurved, kFlat);
  const auto is_as_near_beside = [&](const Vector3& at, double distance)
  {
    const double apart = (at - here.jet.point).norm();
    return apart > 0.5 * kProbe * size && apart < 2.0 * kProbe * size &&
      std::abs(distance - foot.distance) <= kEqualDistance * size;
  };
  for (int k = 0; k < N; ++k)
  {
    if (here.values(k) > flat)
    {
      continue;
    }
    // As long in space as the probe; S_u and S_v need not be orthogonal.
    Parameter<N> step = here.scale.cwiseProduct(here.directions.col(k));
    const double length = (here.jet.first * step).norm();
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

} // namespace

template <int N>
std::unique_ptr<PatchSearch> make_patch_search(
  std::shared_ptr<const ParametricGeometry<N>> geometry, const SolverOptions& solver,
  const SeedOptions& seeding, const Box& bounds)
{
  auto parts =
    std::make_shared<const PatchParts<N>>(std::move(geometry), seeding.resolution, bounds);
  return std::make_unique<PatchSearchOf<N>>(std::move(parts), solver, seeding.number_of_seeds);
}

template std::unique_ptr<PatchSearch> make_patch_search<1>(
  std::shared_ptr<const ParametricCurve>, const SolverOptions&, const SeedOptions&, const Box&);
template std::unique_ptr<PatchSearch> make_patch_search<2>(
  std::shared_ptr<const ParametricSurface>, const SolverOptions&, const SeedOptions&, const Box&);

} // namespace footpoint
