// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/patch_search.h"

#include "footpoint/search/better_foot.h"
#include "footpoint/search/flattened_geometry.h"
#include "footpoint/search/stationary_search.h"
#include "footpoint/solvers/foot_conditions.h"

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <mutex>

namespace footpoint
{
namespace
{

/// Geometry that is no spline has no boxes: a dense grid takes the place of the cells.
constexpr SeedOptions kDenseSeeds{ 31, 16 };

/// A line meets the geometry where it passes closer than this fraction of the size: the square root
/// of rounding would be the limit where it only grazes, a transversal meeting is exact.
constexpr double kMeets = 1e-10;

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Scaled eigenvalue of the Hessian below which a foot may be one of a continuum, how far off (as a
/// fraction of the size) another one is looked for, and how equal its distance has to be.
constexpr double kFlat = 1e-6;
constexpr double kProbe = 1e-2;
constexpr double kEqualDistance = 1e-12;

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
  PatchParts(
    std::shared_ptr<const ParametricGeometry<N>> geometry, int seed_resolution, int minimum_cells)
    : Shared(std::move(geometry))
    , Bounds(control_box(*this->Shared))
    , Spline((this->Bounds.lower.array() <= this->Bounds.upper.array()).all())
    , MinimumCells(minimum_cells)
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
  int MinimumCells;
  SeededSearch<N> Seeds;
  SeededSearch<N> Dense;

  /// Built when a query first needs them: most never do.
  const CellTree<N>& cells() const
  {
    std::call_once(this->CellsOnce,
      [this] { this->Cells = std::make_unique<CellTree<N>>(*this->Shared, this->MinimumCells); });
    return *this->Cells;
  }

private:
  mutable std::once_flag CellsOnce;
  mutable std::unique_ptr<const CellTree<N>> Cells;
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
    return this->Spline ? this->cell_bound(this->local(query.point), query)(this->Bounds) : 0.0;
  }

  void search(const PatchQuery& query, const std::function<double()>& limit,
    const std::function<void(const PatchFoot&)>& found) const override
  {
    switch (query.sought)
    {
      case Sought::Minimum:
        return this->minima(query, limit, found);
      case Sought::Orthogonal:
        return this->orthogonal_feet(query, limit, found);
      case Sought::Intersection:
        return this->intersections(query, limit, found);
    }
  }

  bool isolated(const Vector3& point, const PatchFoot& foot) const override;

  PatchFoot refine(const Vector3& point, const PatchFoot& foot) const override
  {
    SolverOptions solver = this->Solver;
    solver.safeguards = true;
    solver.method = Method::Newton;
    const LocalFoot<N> found = find_local_foot<N>(
      this->Geometry, this->local(point), Parameter<N>(foot.local.head<N>()), solver);
    const Vector3 query = this->local(point);
    const FootConditions<N> conditions(this->Geometry, this->Solver);
    const Frame<N> here = make_frame<N>(
      this->Geometry, query, foot.local.head<N>(), foot.sides.head<N>());
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

  std::function<double(const Box&)> cell_bound(const Vector3& query, const PatchQuery& asked) const
  {
    if (asked.sought != Sought::Intersection)
    {
      return [query](const Box& box) { return box.distance(query); };
    }
    // The line's distance from the box, by the sphere around the box.
    const Vector3 line = asked.line;
    return [query, line](const Box& box)
    {
      const Vector3 to_middle = 0.5 * (box.lower + box.upper) - query;
      const double across = (to_middle - line * line.dot(to_middle)).norm();
      return std::max(0.0, across - 0.5 * (box.upper - box.lower).norm());
    };
  }

  /// The starts that a query is worth: the given one, then cells or samples by their bound. visit
  /// also gets the diagonal of what the start stands for, infinity where that is not known.
  void for_each_start(const PatchQuery& query, const std::function<double()>& limit,
    const std::function<void(const Parameter<N>&, double)>& visit) const
  {
    const Vector3 at = this->local(query.point);
    const Parameter<N> given = this->Geometry.to_local(query.start.head<N>());
    const bool has_start = given.allFinite();
    if (has_start)
    {
      visit(given, kUnknown);
    }
    if (query.search == Search::Local && has_start)
    {
      return;
    }
    if (query.search == Search::Global && this->Spline)
    {
      this->Parts->cells().traverse(this->cell_bound(at, query), limit, visit);
      return;
    }
    const bool dense = query.search == Search::Global;
    const SeededSearch<N>& seeds = dense ? this->Dense : this->Seeds;
    if (query.sought != Sought::Minimum && query.search != Search::Local)
    {
      // Maxima and intersections need not be near a sampled minimum.
      for (Eigen::Index k = 0; k < seeds.number_of_samples(); ++k)
      {
        visit(seeds.parameter(k), kUnknown);
      }
      return;
    }
    const int count = query.search == Search::Local
      ? 1
      : (dense ? kDenseSeeds.number_of_seeds : this->NumberOfSeeds);
    for (const Parameter<N>& seed : seeds.seeds(at, count))
    {
      visit(seed, kUnknown);
    }
  }

  /// The solver's options for a start that stands for a cell of a given diagonal.
  SolverOptions nearby(double reach) const
  {
    SolverOptions result = this->Solver;
    if (std::isfinite(reach) && this->Geometry.size() > 0.0)
    {
      result.first_trust_radius = reach / this->Geometry.size();
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

  void minima(const PatchQuery& query, const std::function<double()>& limit,
    const std::function<void(const PatchFoot&)>& found) const
  {
    const Vector3 at = this->local(query.point);
    this->for_each_start(query, limit,
      [&](const Parameter<N>& start, double reach)
      {
        const SolverOptions solver = this->nearby(reach);
        found(this->lift(query.point, this->Seeds.find_from(at, start, solver)));
      });
  }

  void orthogonal_feet(const PatchQuery& query, const std::function<double()>& limit,
    const std::function<void(const PatchFoot&)>& found) const
  {
    const Vector3 at = this->local(query.point);
    this->for_each_start(query, limit,
      [&](const Parameter<N>& start, double reach)
      {
        const LocalFoot<N> minimum = this->Seeds.find_from(at, start, this->nearby(reach));
        if (is_orthogonal<N>(this->Geometry, at, minimum, this->Solver))
        {
          found(this->lift(query.point, minimum));
        }
        if (const auto foot = find_orthogonal_foot<N>(this->Geometry, at, start, this->Solver))
        {
          found(this->lift(query.point, *foot));
        }
      });
  }

  void intersections(const PatchQuery& query, const std::function<double()>&,
    const std::function<void(const PatchFoot&)>& found) const
  {
    const FlattenedGeometry<N> flat(this->Geometry, query.line);
    const Vector3 at = flat.flatten(this->local(query.point));
    const double meets = kMeets * this->Geometry.size();
    this->for_each_start(
      query, [meets] { return meets; },
      [&](const Parameter<N>& start, double reach)
      {
        LocalFoot<N> foot = find_local_foot<N>(flat, at, start, this->nearby(reach));
        if (foot.distance > meets)
        {
          return;
        }
        foot.point = this->Geometry.jet(foot.parameter, foot.sides, 0).point;
        foot.distance = std::abs((foot.point - this->local(query.point)).dot(query.line));
        foot.converged = true;
        // Of the geometry itself; the flattened one stands still wherever the line touches it.
        const FootConditions<N> conditions(this->Geometry, this->Solver);
        foot.type = conditions.classify(
          make_frame<N>(this->Geometry, foot.point, foot.parameter, foot.sides), foot.point);
        found(this->lift(query.point, foot));
      });
  }

  std::shared_ptr<const PatchParts<N>> Parts;
  const ParametricGeometry<N>& Geometry;
  SolverOptions Solver;
  int NumberOfSeeds;
  Box Bounds;
  bool Spline;
  const SeededSearch<N>& Seeds;
  const SeededSearch<N>& Dense;
};

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

/// Where E is flat to second order along a direction, a descent is started a little way off on
/// either side: on a continuum it stays there, at an isolated minimum it comes back (or ends
/// farther away).
template <int N>
bool PatchSearchOf<N>::isolated(const Vector3& point, const PatchFoot& foot) const
{
  const Vector3 query = this->local(point);
  const Parameter<N> t = foot.local.head<N>();
  const Frame<N> frame = make_frame<N>(this->Geometry, query, t, foot.sides.head<N>());
  const FootConditions<N> conditions(this->Geometry, this->Solver);
  const Eigen::Matrix<bool, N, 1> free = conditions.free(frame);
  typename Frame<N>::Matrix scaled = frame.hessian();
  Parameter<N> scale = Parameter<N>::Zero();
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
  const double size = this->Geometry.size();
  for (int k = 0; k < N; ++k)
  {
    if (eigen.eigenvalues()(k) > kFlat)
    {
      continue;
    }
    // Scaled by 1 / |S_i|, so that the step has about the length of the probe in space.
    const Parameter<N> step = scale.cwiseProduct(eigen.eigenvectors().col(k)) * (kProbe * size);
    for (const double sign : { -1.0, 1.0 })
    {
      const LocalFoot<N> other =
        find_local_foot<N>(this->Geometry, query, Parameter<N>(t + sign * step), this->Solver);
      const bool elsewhere = (other.point - frame.jet.point).norm() > 0.5 * kProbe * size;
      const double difference = std::abs(other.distance - foot.distance);
      if (elsewhere && difference <= kEqualDistance * size && other.converged &&
        (other.point - frame.jet.point).norm() < 2.0 * kProbe * size)
      {
        return false;
      }
    }
  }
  return true;
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
  const SeedOptions& seeding, int minimum_cells)
{
  auto parts =
    std::make_shared<const PatchParts<N>>(std::move(geometry), seeding.resolution, minimum_cells);
  return std::make_unique<PatchSearchOf<N>>(std::move(parts), solver, seeding.number_of_seeds);
}

template std::unique_ptr<PatchSearch> make_patch_search<1>(
  std::shared_ptr<const ParametricCurve>, const SolverOptions&, const SeedOptions&, int);
template std::unique_ptr<PatchSearch> make_patch_search<2>(
  std::shared_ptr<const ParametricSurface>, const SolverOptions&, const SeedOptions&, int);

} // namespace footpoint
