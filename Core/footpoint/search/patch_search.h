// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/box.h"
#include "footpoint/search/seeded_search.h"

#include <functional>
#include <limits>
#include <memory>

namespace footpoint
{

/// How the starts of the local solver are found.
enum class Search
{
  Global, ///< splines: in all Bézier pieces; other geometry: from a dense grid of samples
  Seeded, ///< from the best samples of a coarse grid on every face
  Local   ///< from one start: the given one, else the best sample
};

/// What is sought on a patch.
enum class Sought
{
  Minimum,     ///< minima of the distance, found by descent
  Orthogonal,  ///< feet where r is orthogonal to the geometry
  Intersection ///< where a line through the point meets the geometry
};

/// A question to a patch, in model coordinates.
struct PatchQuery
{
  Vector3 point;
  Sought sought = Sought::Minimum;
  Search search = Search::Global;
  Vector3 line = Vector3::Zero();                   ///< unit vector, for Intersection
  Parameter<2> start = Parameter<2>::Constant(NAN); ///< in the geometry's domain; NaN: automatic
};

/// A foot on one patch; curves have v = 0.
struct PatchFoot
{
  Parameter<2> local = Parameter<2>::Zero(); ///< local parameters
  Sides<2> sides = Sides<2>::Constant(Side::Right);
  Parameter<2> parameter = Parameter<2>::Zero(); ///< the geometry's own domain
  Vector3 offset;        ///< foot − P, without the rounding of far origins
  Vector3 point;         ///< model coordinates
  double distance = 0.0; ///< |offset|
  bool converged = false;
  FootType type = FootType::Interior;
  int iterations = 0;
  bool isolated = true; ///< of a meeting: false where the line lies in the geometry …
  bool touches = false; ///< … and true where it is tangent to it, as far as can be told
};

/// Where to look for a foot on a patch.
struct PatchStart
{
  Parameter<2> local; ///< local parameters; curves have v = 0
  /// How far what the start stands for reaches.
  double reach = std::numeric_limits<double>::infinity();
  bool simple = false; ///< the start is what is sought, up to rounding
  double part = 1.0;   ///< of the piece, by parameters, that it stands for
  bool pole = false;   ///< at a collapsed side, where the way down may lead through any column
};

/// One curve or surface prepared for queries. Built once; const and thread-safe.
class PatchSearch
{
public:
  virtual ~PatchSearch() = default;

  /// The same patch for other queries; shares what was built.
  virtual std::unique_ptr<PatchSearch> with(
    const SolverOptions& solver, int number_of_seeds) const = 0;

  /// A lower bound of the distance from a point (from a line, where the query has one).
  virtual double bound(const PatchQuery& query) const = 0;

  /// Calls found(foot) for the feet that descents from the given start and from samples end in (the
  /// same foot more than once).
  virtual void search(
    const PatchQuery& query, const std::function<void(const PatchFoot&)>& found) const = 0;

  /// The same from one start.
  virtual void search_from(const PatchQuery& query, const PatchStart& start,
    const std::function<void(const PatchFoot&)>& found) const = 0;

  /// Whether the foot is the only one near it: false on a continuum of equally near points.
  virtual bool isolated(const Vector3& point, const PatchFoot& foot) const = 0;

  /// Whether the distance is so flat near the foot, or the geometry so degenerate, that no other
  /// foot near it can be told from it.
  virtual bool flat(const Vector3& point, const PatchFoot& foot) const = 0;

  /// Whether r is orthogonal to the geometry on all sides of the foot.
  virtual bool orthogonal(const Vector3& point, const PatchFoot& foot) const = 0;

  /// The minimum that a guarded descent from a foot ends in, over all borders inside the patch; the
  /// foot itself, with its type, where that is no nearer.
  virtual PatchFoot refine(const Vector3& point, const PatchFoot& foot) const = 0;

  /// A foot with its type, where it is known to be a minimum.
  virtual PatchFoot classified(const Vector3& point, const PatchFoot& foot) const = 0;

  /// A box around the geometry (of its control points where it has some), in model coordinates.
  virtual Box box() const = 0;

  /// Diagonal of the bounding box of the control points.
  virtual double size() const = 0;

  /// Whether a foot lies in a part of the patch or no farther beside it than half its width; at a
  /// pole, whether it is no farther from the start than this reaches.
  virtual bool near(const PatchFoot& foot, const PatchStart& start, const Parameter<2>& lower,
    const Parameter<2>& upper) const = 0;

  /// Whether two feet are one, by their parameters.
  virtual bool same(const PatchFoot& a, const PatchFoot& b) const = 0;

  /// Whether the distance stays the same on the way between two feet: one minimum that is flat to
  /// rounding, one pole, or one continuum, found twice.
  virtual bool level(const Vector3& point, const PatchFoot& a, const PatchFoot& b) const = 0;

  /// Lexicographic order of the parameters, equal ones (kSameParameter) being equal.
  virtual bool lower(const PatchFoot& a, const PatchFoot& b) const = 0;
};

/// \param bounds a box around the geometry, relative to its centre; empty: of its control points,
///               or where it has none of samples
template <int N>
std::unique_ptr<PatchSearch> make_patch_search(
  std::shared_ptr<const ParametricGeometry<N>> geometry, const SolverOptions& solver,
  const SeedOptions& seeding, const Box& bounds = {});

} // namespace footpoint
