// SPDX-License-Identifier: BSD-3-Clause

// Newton's method on Bézier pieces, compiled once for each set of vector instructions (the guard of
// Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PIECE_DESCENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_DESCENT_INL_H
#undef FOOTPOINT_PIECE_DESCENT_INL_H
#else
#define FOOTPOINT_PIECE_DESCENT_INL_H
#endif

#include "footpoint/search/piece_evaluation-inl.h"
#include "footpoint/search/search_structure.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// Evaluations of one descent.
constexpr int kMostEvaluations = 100;
/// After a step shorter than this part of a piece Taylor's expansion takes the place of another
/// evaluation: its error is the third power.
constexpr double kShortStep = 1e-7;
constexpr double kShortestStep = 1e-15;
/// Newton's steps decrease faster than by this factor where they converge quadratically.
constexpr double kFastDecrease = 1e-2;
/// A step shorter than this that brings nothing is not cut any further.
constexpr double kLevelStep = 1e-6;
/// So near an end of a piece the end itself is tried.
constexpr double kNearEnd = 1e-4;

/// Newton's step in units in which both derivatives have length 1; where the Hessian is not
/// positive definite, with its eigenvalues by magnitude (Y. Dauphin et al. 2014).
HWY_INLINE Pair newton_step(const Place& place, const std::array<bool, 2>& free)
{
  Pair step{ { 0.0, 0.0 } };
  const Triple& h = place.hessian;
  const Pair& g = place.gradient;
  if (!free[0] || !free[1])
  {
    const int i = free[0] ? 0 : 1;
    if (free[i])
    {
      const double speed = place.metric[i];
      const double curvature = std::max(std::abs(h[2 * i]), 1e-14 * speed);
      step[i] = curvature > 0.0 ? -g[i] / curvature : 0.0;
    }
    return step;
  }
  const double determinant = h[0] * h[2] - h[1] * h[1];
  if (h[0] > 0.0 && determinant > 1e-10 * h[0] * std::abs(h[2]))
  {
    const double inverse = 1.0 / determinant;
    step[0] = (h[1] * g[1] - h[2] * g[0]) * inverse;
    step[1] = (h[1] * g[0] - h[0] * g[1]) * inverse;
    return step;
  }
  const double speed_u = std::sqrt(place.metric[0]);
  const double speed_v = std::sqrt(place.metric[1]);
  const double floor = 1e-8 * std::max(speed_u, speed_v);
  if (floor == 0.0)
  {
    return step;
  }
  const double su = 1.0 / std::max(speed_u, floor);
  const double sv = 1.0 / std::max(speed_v, floor);
  const double a = h[0] * su * su;
  const double b = h[1] * su * sv;
  const double c = h[2] * sv * sv;
  const double mean = 0.5 * (a + c);
  const double half = 0.5 * (a - c);
  const double root = std::sqrt(half * half + b * b);
  // Unit eigenvector (x, y) of mean + root; (−y, x) belongs to mean − root.
  double x = half >= 0.0 ? half + root : b;
  double y = half >= 0.0 ? b : root - half;
  const double length = std::sqrt(x * x + y * y);
  x = length > 0.0 ? x / length : 1.0;
  y = length > 0.0 ? y / length : 0.0;
  const double gu = g[0] * su;
  const double gv = g[1] * sv;
  const double least = 1e-12 * (std::abs(mean) + root) + std::numeric_limits<double>::min();
  const double one = (x * gu + y * gv) / std::max(std::abs(mean + root), least);
  const double two = (x * gv - y * gu) / std::max(std::abs(mean - root), least);
  step[0] = -(x * one - y * two) * su;
  step[1] = -(y * one + x * two) * sv;
  return step;
}

/// A box of parameters of a piece.
struct Range
{
  Pair lower;
  Pair upper;
};

constexpr Range kWholePiece{ { { 0.0, 0.0 } }, { { 1.0, 1.0 } } };

HWY_INLINE std::array<bool, 2> free_directions(
  const PieceShape& shape, const Range& range, const Place& place)
{
  std::array<bool, 2> free;
  for (int i = 0; i < 2; ++i)
  {
    const double g = place.gradient[i];
    free[i] = shape.degree[i] > 0 && range.upper[i] > range.lower[i] &&
      !(place.t[i] <= range.lower[i] && g >= 0.0) && !(place.t[i] >= range.upper[i] && g <= 0.0);
  }
  return free;
}

/// Where a step leads, clamped to the range; if one direction is clamped the other is solved again.
HWY_INLINE Pair clamped_target(
  const Place& place, const Range& range, const std::array<bool, 2>& free, const Pair& step)
{
  Pair target;
  for (int i = 0; i < 2; ++i)
  {
    const double t = place.t[i] + (free[i] ? step[i] : 0.0);
    target[i] = std::min(std::max(t, range.lower[i]), range.upper[i]);
  }
  for (int i = 0; i < 2 && free[0] && free[1]; ++i)
  {
    const double wanted = place.t[i] + step[i];
    const double other_wanted = place.t[1 - i] + step[1 - i];
    const double curvature = place.hessian[2 - 2 * i];
    if (target[i] != wanted && target[1 - i] == other_wanted && curvature > 0.0)
    {
      const double along =
        -(place.gradient[1 - i] + place.hessian[1] * (target[i] - place.t[i])) / curvature;
      target[1 - i] =
        std::min(std::max(place.t[1 - i] + along, range.lower[1 - i]), range.upper[1 - i]);
      break;
    }
  }
  return target;
}

/// Where the steepest descent leads in units in which both derivatives have length 1, for as far as
/// the curvature along each direction lets it: nearer after a short part of the way even where the
/// range cuts it off.
HWY_INLINE Pair steepest_target(
  const Place& place, const Range& range, const std::array<bool, 2>& free)
{
  Pair target = place.t;
  for (int i = 0; i < 2; ++i)
  {
    const double curvature = std::max(place.metric[i], std::abs(place.hessian[2 * i]));
    if (free[i] && curvature > 0.0)
    {
      const double t = place.t[i] - place.gradient[i] / curvature;
      target[i] = std::min(std::max(t, range.lower[i]), range.upper[i]);
    }
  }
  return target;
}

HWY_INLINE double slope(const Place& place, const std::array<bool, 2>& free)
{
  return std::max(free[0] ? std::abs(place.gradient[0]) : 0.0,
    free[1] ? std::abs(place.gradient[1]) : 0.0);
}

/// Newton's step, to be taken where `definite` says that the Hessian is well positive definite:
/// positive > 0 and determinant > least.
template <class T>
struct PlainStep
{
  std::array<T, 2> way;
  T positive;
  T determinant;
  T least;
};

template <int P, class T>
HWY_INLINE PlainStep<T> plain_step(const PlaceOf<T>& place)
{
  constexpr double kWellDefinite = 1e-6;
  const std::array<T, 3>& h = place.hessian;
  const std::array<T, 2>& g = place.gradient;
  if (P == 0)
  {
    return { { { T(0.0), (T(0.0) - g[1]) / h[2] } }, h[2], h[2],
      T(kWellDefinite) * place.metric[1] };
  }
  const T determinant = h[0] * h[2] - h[1] * h[1];
  const T inverse = T(1.0) / determinant;
  return { { { (h[1] * g[1] - h[2] * g[0]) * inverse, (h[1] * g[0] - h[0] * g[1]) * inverse } },
    h[0], determinant, T(kWellDefinite) * h[0] * h[2] };
}

/// Plain Newton steps end after so many evaluations.
constexpr int kMostSteps = 8;

/// How plain Newton steps ended.
enum class Steps
{
  Done, ///< at the minimum
  Left, ///< the next one leads out of the range
  Stuck ///< the Hessian is not well positive definite, or nothing comes nearer
};

/// Plain Newton steps from place.t for as long as they stay inside the range, the Hessian is well
/// positive definite and the point comes nearer: what most descents are. Returns the number of
/// evaluations. \param target where the last step leads
template <int P, int Q, bool Rational>
HWY_INLINE int iterate(
  const PieceQuery& query, const Range& range, Place& place, Steps& steps, Pair& target)
{
  double before = 1.0;
  double squared = kInfinity;
  Pair last = place.t;
  steps = Steps::Stuck;
  for (int count = 1;; ++count)
  {
    evaluate<P, Q, Rational>(query, place);
    if (!(place.squared < squared))
    {
      place.t = last;
      evaluate<P, Q, Rational>(query, place);
      return count + 1;
    }
    const PlainStep<double> step = plain_step<P>(place);
    const bool definite = step.positive > 0.0 && step.determinant > step.least;
    target = { { place.t[0] + step.way[0], place.t[1] + step.way[1] } };
    const double longest = std::max(std::abs(step.way[0]), std::abs(step.way[1]));
    const bool inside = target[1] > range.lower[1] && target[1] < range.upper[1] &&
      (P == 0 || (target[0] > range.lower[0] && target[0] < range.upper[0]));
    if (!definite || !inside || count >= kMostSteps)
    {
      steps = definite && !inside ? Steps::Left : Steps::Stuck;
      return count;
    }
    if (longest <= kShortStep && longest <= kFastDecrease * before)
    {
      expand<P, Rational ? 4 : 3>(query.p, target, place);
      steps = Steps::Done;
      return count;
    }
    before = longest;
    squared = place.squared;
    last = place.t;
    place.t = target;
  }
}

/// The rest of a descent, where plain steps do not get any further.
/// \param count of evaluations so far
template <int P, int Q, bool Rational>
HWY_NOINLINE int go_on(const PieceQuery& query, const Range& range, int count, Place& result)
{
  const PieceShape& shape = *query.piece->shape;
  Place other;
  Place* place = &result;
  Place* next = &other;
  double before = 1.0;
  while (count < kMostEvaluations)
  {
    const std::array<bool, 2> free = free_directions(shape, range, *place);
    if (!free[0] && !free[1])
    {
      break;
    }
    Pair target = clamped_target(*place, range, free, newton_step(*place, free));
    if (!(place->gradient[0] * (target[0] - place->t[0]) +
          place->gradient[1] * (target[1] - place->t[1]) <
          0.0))
    {
      target = steepest_target(*place, range, free); // what is left of the step leads away
    }
    double longest = std::max(std::abs(target[0] - place->t[0]), std::abs(target[1] - place->t[1]));
    // Steps that shrink slowly have more of them to come: a minimum that is flat.
    const bool last = longest <= kShortStep && longest <= kFastDecrease * before;
    if (last || !(longest > kShortestStep))
    {
      if (longest > 0.0)
      {
        expand<P, 4>(query.p, target, *place);
      }
      break;
    }
    before = longest;
    bool taken = false;
    while (count < kMostEvaluations)
    {
      next->t = target;
      evaluate<P, Q, Rational>(query, *next);
      ++count;
      taken = next->squared < place->squared;
      if (!taken)
      {
        // Below the rounding of |S − P|² the gradient has to judge.
        const double level = 16.0 * kRounding *
          (place->squared + query.piece->reach * std::sqrt(place->squared));
        taken = next->squared <= place->squared + level &&
          slope(*next, free) < 0.9 * slope(*place, free);
      }
      if (taken || longest < kLevelStep)
      {
        break;
      }
      for (int i = 0; i < 2; ++i)
      {
        target[i] = place->t[i] + 0.25 * (target[i] - place->t[i]);
      }
      longest *= 0.25;
    }
    if (!taken)
    {
      break;
    }
    std::swap(place, next);
  }
  // Where the parametrization stands still the last steps are below rounding: the end itself, if
  // that is as near and as level.
  for (int i = 0; i < 2; ++i)
  {
    const double t = place->t[i];
    const double end = t < 0.5 ? range.lower[i] : range.upper[i];
    if (t != end && std::abs(t - end) < kNearEnd)
    {
      next->t = place->t;
      next->t[i] = end;
      evaluate<P, Q, Rational>(query, *next);
      ++count;
      if (next->squared <= place->squared &&
        std::abs(next->gradient[i]) <= std::abs(place->gradient[i]))
      {
        std::swap(place, next);
      }
    }
  }
  if (place != &result)
  {
    result = *place;
  }
  return count;
}

/// Newton's method in a range of a piece, from place.t. Returns the number of evaluations.
template <int P, int Q, bool Rational>
HWY_NOINLINE int descend_on(const PieceQuery& query, const Range& range, Place& place)
{
  Steps steps;
  Pair target;
  const int count = iterate<P, Q, Rational>(query, range, place, steps, target);
  return steps == Steps::Done ? count : go_on<P, Q, Rational>(query, range, count, place);
}

/// The part of a query that belongs to one piece. \param p in the model's centred coordinates
HWY_INLINE PieceQuery query_at(
  const SearchStructure& structure, const double* p, std::int32_t index)
{
  PieceQuery query;
  query.piece = &structure.forms.pieces()[index];
  query.index = index;
  for (int k = 0; k < 3; ++k)
  {
    query.p[k] = p[k] - query.piece->origin[k];
  }
  return query;
}

/// The piece to which a step leads that leaves its own, −1: none that goes on smoothly. The target
/// is moved on to that piece.
HWY_INLINE std::int32_t piece_beyond(
  const SearchStructure& structure, const PieceQuery& query, Pair& target)
{
  const PieceNeighbourhood& around = structure.neighbourhoods[query.index];
  int way[2];
  for (int i = 0; i < 2; ++i)
  {
    way[i] = target[i] > 1.0 ? 1 : (target[i] < 0.0 ? -1 : 0);
  }
  const auto at = [&](int i, int j) { return around.pieces[3 * (i + 1) + (j + 1)]; };
  std::int32_t next = at(way[0], way[1]);
  if (next < 0 && way[0] != 0 && way[1] != 0)
  {
    // No corner: over the side on which it is farther outside, if that goes on.
    const auto beyond = [&target](int i) { return std::max(-target[i], target[i] - 1.0); };
    const int first = beyond(0) > beyond(1) ? 0 : 1;
    const bool has_first = around.beside(first, way[first] > 0) >= 0;
    way[has_first ? 1 - first : first] = 0;
    next = at(way[0], way[1]);
  }
  if (next < 0 || next == query.index)
  {
    return -1;
  }
  const Piece& to = structure.forms.pieces()[next];
  for (int i = 0; i < 2; ++i)
  {
    if (way[i] != 0)
    {
      const double over = way[i] > 0 ? target[i] - 1.0 : target[i];
      target[i] = (way[i] > 0 ? 0.0 : 1.0) + over * query.piece->width[i] / to.width[i];
    }
    target[i] = std::min(std::max(target[i], 0.0), 1.0);
  }
  return next;
}

/// Evaluates at place.t.
void evaluate_at(const PieceQuery& query, Place& place)
{
  with_shape(*query.piece->shape,
    [&](auto p, auto q, auto rational) { evaluate<p(), q(), rational()>(query, place); });
}

int descend(const PieceQuery& query, const Range& range, Place& place)
{
  return with_shape(*query.piece->shape, [&](auto p, auto q, auto rational)
    { return descend_on<p(), q(), rational()>(query, range, place); });
}

/// Plain Newton steps that a query waits for: where from, and how they ended.
struct Descent
{
  PieceQuery query;
  Place place;
  Steps steps;
  Pair target; ///< where they lead, if they leave the piece
  int count;   ///< of evaluations
  bool stale;  ///< the place has to be evaluated again where it is
};

/// On the whole piece.
void take_plain_steps(Descent& descent)
{
  descent.stale = false;
  with_shape(*descent.query.piece->shape,
    [&](auto p, auto q, auto rational)
    {
      descent.count = iterate<p(), q(), rational()>(
        descent.query, kWholePiece, descent.place, descent.steps, descent.target);
    });
}

/// On to the minimum of the piece from where plain steps ended. Returns the number of all
/// evaluations.
int finish_descent(Descent& descent)
{
  if (descent.steps == Steps::Done)
  {
    return descent.count;
  }
  return with_shape(*descent.query.piece->shape,
    [&](auto p, auto q, auto rational)
    {
      if (descent.stale)
      {
        evaluate<p(), q(), rational()>(descent.query, descent.place);
      }
      return go_on<p(), q(), rational()>(
        descent.query, kWholePiece, descent.count, descent.place);
    });
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
