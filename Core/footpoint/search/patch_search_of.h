// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/better_foot.h"
#include "footpoint/search/flattened_geometry.h"
#include "footpoint/search/patch_search.h"
#include "footpoint/search/stationary_search.h"
#include "footpoint/solvers/frame.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace footpoint
{

/// Scaled eigenvalue of the Hessian below which a foot, or sine of a line below which a meeting,
/// may be one of a continuum, and how far off (as a fraction of the size) another one is looked
/// for.
constexpr double kFlat = 1e-6;
constexpr double kProbe = 1e-2;

/// What queries with any options share.
template <int N>
struct PatchParts
{
  /// \param bounds of the geometry, relative to its centre; empty: to be found
  PatchParts(std::shared_ptr<const ParametricGeometry<N>> geometry, int seed_resolution,
    const Box& bounds);

  std::shared_ptr<const ParametricGeometry<N>> Shared;
  Box Bounds;  ///< of the control points, of samples where there are none
  bool Spline; ///< Bounds holds the geometry
  SeededSearch<N> Seeds;
  SeededSearch<N> Dense;
};

/// PatchSearch of a curve or a surface.
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

  PatchFoot refine(const Vector3& point, const PatchFoot& foot) const override;

  PatchFoot classified(const Vector3& point, const PatchFoot& foot) const override;

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

  // === What lies beside a foot, in patch_continua.cpp

  bool isolated(const Vector3& point, const PatchFoot& foot) const override;

  bool flat(const Vector3& point, const PatchFoot& foot) const override;

  bool level(const Vector3& point, const PatchFoot& a, const PatchFoot& b) const override;

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

  PatchFoot lift(const Vector3& point, const LocalFoot<N>& foot) const;

  void minimum(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const;

  void orthogonal_foot(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const;

  // === Where a line meets the geometry, in patch_meetings.cpp

  void intersection(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const;

  /// A point of the geometry as a meeting, where the line passes through it.
  std::optional<PatchFoot> meeting(const PatchQuery& query, LocalFoot<N> foot) const;

  /// Sets whether a line touches the geometry at a meeting, and whether it lies in it near there:
  /// it runs along it, and meets it again a little way off.
  void look_along(const PatchQuery& query, const FlattenedGeometry<N>& flat, PatchFoot& foot) const;
  bool meets_again(const PatchQuery& query, const FlattenedGeometry<N>& flat, const PatchFoot& foot,
    const Parameter<N>& step) const;

  // === In patch_continua.cpp

  /// The Hessian of E at a foot, in units of |S_i|: directions that a border holds, or in which S
  /// stands still, count 1.
  struct Curvatures
  {
    Parameter<N> values;
    Eigen::Matrix<double, N, N> directions;
    Parameter<N> scale; ///< 1 / |S_i|, 0 where S stands still
    Frame<N> frame;
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

} // namespace footpoint
