// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/model/model.h"
#include "footpoint/search/patch_search.h"

#include <limits>

namespace footpoint
{

/// Outcome for one point; numbers are those of the array Status.
enum class Status
{
  Certified = 0,             ///< proved: no point of the geometry is closer than distance − gap
  Converged = 1,             ///< a local minimum of the distance
  NotConverged = 2,          ///< the best point found
  BeyondMaximumDistance = 3, ///< nothing found within the maximum distance
  InvalidPoint = 4,          ///< a coordinate is NaN or infinite
  NoOrthogonalFoot = 5       ///< the closest point is given, but r is orthogonal nowhere
};

struct InversionOptions
{
  Search search = Search::Global;
  SolverOptions solver;
  SeedOptions seeding;
  /// What Search::Global proves: gap ≤ this fraction of the model's size.
  double certificate_tolerance = 1e-12;
  /// Points farther than this get BeyondMaximumDistance (model units).
  double maximum_distance = std::numeric_limits<double>::infinity();
  /// The nearest foot where r is orthogonal to the geometry, minimum or not.
  bool orthogonal_only = false;
  /// Every local minimum of the distance, nearest first, instead of the nearest.
  bool all_feet = false;
  /// Not zero: instead of the nearest point, where the line through P along this vector meets the
  /// geometry, nearest first; `distance` is measured along the line.
  Vector3 fixed_direction = Vector3::Zero();
};

/// Where to start from, for one point: in Seeded and Local search tried besides, instead of, the
/// grid.
struct Start
{
  int face = -1;                                        ///< −1: every face
  Parameter<2> parameter = Parameter<2>::Constant(NAN); ///< domain of the geometry; NaN: automatic
};

/// The foot of one point, in model coordinates.
struct Foot
{
  Status status = Status::InvalidPoint;
  FootType type = FootType::Interior; ///< meaningless at status 3 and 4, as are the numbers below
  /// False: a continuum of feet is equally near; along a direction: the line lies in the geometry.
  bool isolated = true;
  int iterations = 0; ///< of the local solver, for the foot that was kept
  int face = -1;
  bool on_curve = false;
  Parameter<2> parameter = Parameter<2>::Constant(NAN); ///< geometry's own domain; curves: v = 0
  Vector3 point = Vector3::Constant(NAN);
  /// Surfaces: unit normal S_u × S_v (limit at poles, mean of both sides on kinks), reversed with
  /// the face. Curves: unit tangent.
  Vector3 direction = Vector3::Constant(NAN);
  double distance = NAN;
  /// Distance with the sign of (P − point)·normal, sign(0) = +1; NaN on curves.
  double signed_distance = NAN;
};

/// A model prepared for queries: built once, then const and thread-safe.
class PointInverter
{
public:
  /// Memory that the queries of one thread share; without one, a query may allocate its own.
  class Workspace;

  /// \param model      kept alive by shared pointers
  /// \param execution  its threads share the work of building large models; every foot has the same
  ///                   bits. Small models, which take some ten milliseconds, do not ask its
  ///                   `proceed`
  /// \throw Cancelled where `proceed` says so
  /// \throw std::invalid_argument where the model has surfaces and the method is for curves only
  /// \throw GeometryError where the loops of a face without a region make none
  explicit PointInverter(
    Model model, const InversionOptions& options = {}, const Execution& execution = {});
  ~PointInverter();
  PointInverter(PointInverter&&) noexcept;
  PointInverter& operator=(PointInverter&&) noexcept;

  /// The same model for queries with other options. Cheap: what the model was built into is shared,
  /// and built anew only where it does not serve the options, see `is_prepared_for`.
  /// \param execution as for the constructor
  /// \throw as the constructor
  PointInverter with_options(
    const InversionOptions& options, const Execution& execution = {}) const;
  /// Whether queries with these options find everything built: the seed resolution has to be the
  /// same, and the Bézier pieces there where they need them (Search::Global).
  bool is_prepared_for(const InversionOptions& options) const;

  const Model& model() const;
  const InversionOptions& options() const;
  /// Diagonal of the bounding box of all control points.
  double size() const;

  /// Borders of surfaces at which no other is found (see Face::tolerance): 0 where the model is
  /// closed, so that signed distances are negative inside if normals point outward.
  std::int64_t number_of_open_edges() const;

  /// The foot of one point.
  Foot find(const Vector3& point, const Start& start = {}) const;
  Foot find(const Vector3& point, const Start& start, Workspace& workspace) const;

  /// The feet of several points, the same bits as one by one: sooner where they are near each
  /// other.
  /// \param points one a column
  /// \param starts empty, or one for each point
  /// \param feet   receives one for each point
  void find(const Eigen::Ref<const Points>& points, const std::vector<Start>& starts,
    Workspace& workspace, Foot* feet) const;

  /// With all_feet or a fixed direction: all of them, nearest first; else the one foot.
  /// Empty where `find` gives status 3 or 4.
  std::vector<Foot> find_all(const Vector3& point, const Start& start = {}) const;

private:
  struct Implementation;
  explicit PointInverter(std::unique_ptr<Implementation> data);
  std::unique_ptr<Implementation> Data;
};

class PointInverter::Workspace
{
public:
  Workspace();
  ~Workspace();

private:
  friend class PointInverter;
  struct Memory;
  std::unique_ptr<Memory> Data;
};

/// Feet of many points, in their order.
struct InversionResult
{
  std::vector<Foot> feet;
  /// With all_feet or a fixed direction: every foot, and the point it belongs to; else empty.
  std::vector<Foot> all_feet;
  std::vector<std::int64_t> all_feet_point;
  bool cancelled = false; ///< feet that were not reached have status NotConverged and NaN
};

/// Runs the queries, neighbours in space one after the other. Every foot has the same bits whatever
/// the threads, the points beside it and their order. Looks at progress every tenth of a second.
/// \param points one a column
/// \param starts empty, or one for each point
InversionResult invert(const PointInverter& inverter, const Eigen::Ref<const Points>& points,
  const std::vector<Start>& starts = {}, const Execution& execution = {});

/// Is given the feet of the points from number `first` on. `all_feet_point` counts from the very
/// first point. The calling thread hands over some thousands at a time, in the order of the points.
using FeetTaker = std::function<void(std::int64_t first, const InversionResult& part)>;

/// The same for who turns feet into something else: they are still in the cache when they are
/// taken, and never all in memory. A part that is cancelled is the last.
void invert(const PointInverter& inverter, const Eigen::Ref<const Points>& points,
  const std::vector<Start>& starts, const Execution& execution, const FeetTaker& take);

/// The same one point after the other, each started from the foot of the one before (points along a
/// path). The only mode in which results depend on the order of points.
InversionResult invert_sequence(const PointInverter& inverter,
  const Eigen::Ref<const Points>& points, const Execution& execution = {});

} // namespace footpoint
