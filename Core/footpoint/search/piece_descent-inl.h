// SPDX-License-Identifier: BSD-3-Clause

// Evaluation of Bézier pieces and Newton's method on one of them, compiled once for each set of vector
// instructions: included again by every file that is (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PIECE_DESCENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_DESCENT_INL_H
#undef FOOTPOINT_PIECE_DESCENT_INL_H
#else
#define FOOTPOINT_PIECE_DESCENT_INL_H
#endif

#include "footpoint/search/distance_forms.h"
#include "footpoint/search/search_structure.h"
#include "footpoint/splines/binomials.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;

/// Half a unit in the last place of 1: the bound of one rounding.
constexpr double kRounding = 0x1p-53;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

using Pair = std::array<double, 2>;
using Triple = std::array<double, 3>;

HWY_INLINE double dot(const double* a, const double* b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Not smaller than the length of a vector.
HWY_INLINE double bound_of_length(const double* a)
{
  return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
}

/// Bernstein polynomials of degree n and their first two derivatives.
HWY_INLINE void bernstein(int n, double t, double* b, double* d, double* dd)
{
  const double s = 1.0 - t;
  if (n == 3)
  {
    const double ss = s * s;
    const double tt = t * t;
    const double st = s * t;
    b[0] = ss * s;
    b[1] = 3.0 * ss * t;
    b[2] = 3.0 * s * tt;
    b[3] = tt * t;
    d[0] = -3.0 * ss;
    d[1] = 3.0 * ss - 6.0 * st;
    d[2] = 6.0 * st - 3.0 * tt;
    d[3] = 3.0 * tt;
    dd[0] = 6.0 * s;
    dd[1] = 6.0 * t - 12.0 * s;
    dd[2] = 6.0 * s - 12.0 * t;
    dd[3] = 6.0 * t;
    return;
  }
  if (n < 2)
  {
    b[0] = n == 0 ? 1.0 : s;
    d[0] = n == 0 ? 0.0 : -1.0;
    dd[0] = 0.0;
    if (n == 1)
    {
      b[1] = t;
      d[1] = 1.0;
      dd[1] = 0.0;
    }
    return;
  }
  // Degree n − 2 by powers, then twice one degree more.
  b[0] = 1.0;
  double power = 1.0;
  for (int k = 1; k <= n - 2; ++k)
  {
    power *= t;
    b[k] = kBinomials.value[n - 2][k] * power;
  }
  power = 1.0;
  for (int k = n - 3; k >= 0; --k)
  {
    power *= s;
    b[k] *= power;
  }
  auto raise = [s, t](int to, double* values)
  {
    values[to] = t * values[to - 1];
    for (int k = to - 1; k > 0; --k)
    {
      values[k] = s * values[k] + t * values[k - 1];
    }
    values[0] *= s;
  };
  for (int k = 0; k <= n; ++k)
  {
    const double left = k >= 2 ? b[k - 2] : 0.0;
    const double middle = k >= 1 && k <= n - 1 ? b[k - 1] : 0.0;
    const double right = k <= n - 2 ? b[k] : 0.0;
    dd[k] = n * (n - 1) * (left - 2.0 * middle + right);
  }
  raise(n - 1, b);
  for (int k = 0; k <= n; ++k)
  {
    d[k] = n * ((k >= 1 ? b[k - 1] : 0.0) - (k <= n - 1 ? b[k] : 0.0));
  }
  raise(n, b);
}

/// Order of the derivatives in a jet.
enum JetEntry : int
{
  kS,
  kSu,
  kSv,
  kSuu,
  kSuv,
  kSvv,
  kJet
};

/// A point of a piece as a query sees it; coordinates are relative to the piece's origin.
struct Place
{
  Pair t;
  HWY_ALIGN double jet[kJet][4]; ///< of S, and in the last column of w
  double r[3];                   ///< S − P
  double squared;                ///< |S − P|²
  Pair gradient;                 ///< of E = ½|S − P|²
  Triple hessian;
  double metric[2]; ///< |S_u|², |S_v|²
};

/// The part of a query that belongs to one piece.
struct PieceQuery
{
  const Piece* piece;
  std::int32_t index;
  double p[3]; ///< P, relative to the piece's origin
};

/// The rest of an evaluation, from the jet.
HWY_INLINE void complete(const PieceQuery& query, Place& place)
{
  const auto& jet = place.jet;
  for (int k = 0; k < 3; ++k)
  {
    place.r[k] = jet[kS][k] - query.p[k];
  }
  place.squared = dot(place.r, place.r);
  place.gradient = { { dot(place.r, jet[kSu]), dot(place.r, jet[kSv]) } };
  place.metric[0] = dot(jet[kSu], jet[kSu]);
  place.metric[1] = dot(jet[kSv], jet[kSv]);
  place.hessian = { { place.metric[0] + dot(place.r, jet[kSuu]),
    dot(jet[kSu], jet[kSv]) + dot(place.r, jet[kSuv]),
    place.metric[1] + dot(place.r, jet[kSvv]) } };
}

/// Solves the product rule for w·S (L. Piegl and W. Tiller 1997, A4.4).
HWY_INLINE void divide_by_weight(Place& place)
{
  auto& jet = place.jet;
  const double inverse = 1.0 / jet[kS][3];
  const double wu = jet[kSu][3];
  const double wv = jet[kSv][3];
  for (int k = 0; k < 3; ++k)
  {
    const double s = jet[kS][k] * inverse;
    const double su = (jet[kSu][k] - wu * s) * inverse;
    const double sv = (jet[kSv][k] - wv * s) * inverse;
    jet[kS][k] = s;
    jet[kSu][k] = su;
    jet[kSv][k] = sv;
    jet[kSuu][k] = (jet[kSuu][k] - 2.0 * wu * su - jet[kSuu][3] * s) * inverse;
    jet[kSuv][k] = (jet[kSuv][k] - wu * sv - wv * su - jet[kSuv][3] * s) * inverse;
    jet[kSvv][k] = (jet[kSvv][k] - 2.0 * wv * sv - jet[kSvv][3] * s) * inverse;
  }
}

/// Weights for the columns of the net that one vector covers: two columns where it holds eight
/// numbers, otherwise one or a part of it.
template <class D>
HWY_INLINE hn::Vec<D> of_columns(D tag, const double* weights)
{
#if HWY_MAX_BYTES >= 64
  return hn::ConcatLowerLower(tag, hn::Set(tag, weights[1]), hn::Set(tag, weights[0]));
#else
  return hn::Set(tag, weights[0]);
#endif
}

/// Stores an entry of the jet, or one part of its coordinates: the sum over a vector's columns.
template <class D>
HWY_INLINE void store_entry(D tag, hn::Vec<D> value, double* entry)
{
#if HWY_MAX_BYTES >= 64
  const hn::Half<D> half;
  hn::StoreU(hn::Add(hn::LowerHalf(half, value), hn::UpperHalf(half, value)), half, entry);
#else
  hn::StoreU(value, tag, entry);
#endif
}

/// Evaluates at place.t: rows of the net are summed first, then its columns.
template <int P, int Q, bool Rational>
HWY_INLINE void evaluate(const PieceQuery& query, Place& place)
{
  constexpr int kMostRows = P >= 0 ? P + 1 : kMaximumDegree + 1;
  constexpr int kMostColumns = (Q >= 0 ? Q + 1 : kMaximumDegree + 1) + 1;
  const Piece& piece = *query.piece;
  const int p = P >= 0 ? P : piece.shape->degree[0];
  const int q = Q >= 0 ? Q : piece.shape->degree[1];
  double row[3][kMostRows];
  double column[3][kMostColumns];
  bernstein(p, place.t[0], row[0], row[1], row[2]);
  bernstein(q, place.t[1], column[0], column[1], column[2]);
  column[0][q + 1] = column[1][q + 1] = column[2][q + 1] = 0.0; // for vectors of two columns
  const hn::CappedTag<double, 8> tag;
  constexpr int kLanes = hn::MaxLanes(tag);
  constexpr int kColumns = kLanes == 8 ? 2 : 1; // that one vector covers
  for (int part = 0; part < 4; part += kLanes)
  {
    auto s = hn::Zero(tag);
    auto su = s;
    auto sv = s;
    auto suu = s;
    auto suv = s;
    auto svv = s;
    for (int j = 0; j <= q; j += kColumns)
    {
      auto c = hn::Zero(tag);
      auto cu = c;
      auto cuu = c;
      for (int i = 0; i <= p; ++i)
      {
        const auto control = hn::LoadU(tag, piece.net + 4 * (i * (q + 1) + j) + part);
        c = hn::MulAdd(hn::Set(tag, row[0][i]), control, c);
        cu = hn::MulAdd(hn::Set(tag, row[1][i]), control, cu);
        cuu = hn::MulAdd(hn::Set(tag, row[2][i]), control, cuu);
      }
      const auto b = of_columns(tag, column[0] + j);
      const auto bv = of_columns(tag, column[1] + j);
      const auto bvv = of_columns(tag, column[2] + j);
      s = hn::MulAdd(b, c, s);
      su = hn::MulAdd(b, cu, su);
      suu = hn::MulAdd(b, cuu, suu);
      sv = hn::MulAdd(bv, c, sv);
      suv = hn::MulAdd(bv, cu, suv);
      svv = hn::MulAdd(bvv, c, svv);
    }
    store_entry(tag, s, place.jet[kS] + part);
    store_entry(tag, su, place.jet[kSu] + part);
    store_entry(tag, sv, place.jet[kSv] + part);
    store_entry(tag, suu, place.jet[kSuu] + part);
    store_entry(tag, suv, place.jet[kSuv] + part);
    store_entry(tag, svv, place.jet[kSvv] + part);
  }
  if (Rational)
  {
    divide_by_weight(place);
  }
  complete(query, place);
}

/// Newton's step in units in which both derivatives have length 1; where the Hessian is not positive
/// definite, with its eigenvalues by magnitude (Y. Dauphin et al. 2014).
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

/// S, w and their derivatives a short step on, by Taylor's expansion about the place.
HWY_INLINE void expand(const PieceQuery& query, const Pair& target, Place& place)
{
  const double du = target[0] - place.t[0];
  const double dv = target[1] - place.t[1];
  auto& jet = place.jet;
  for (int k = 0; k < 4; ++k)
  {
    const double by_u = jet[kSuu][k] * du + jet[kSuv][k] * dv;
    const double by_v = jet[kSuv][k] * du + jet[kSvv][k] * dv;
    jet[kS][k] += jet[kSu][k] * du + jet[kSv][k] * dv + 0.5 * (by_u * du + by_v * dv);
    jet[kSu][k] += by_u;
    jet[kSv][k] += by_v;
  }
  place.t = target;
  complete(query, place);
}

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
  constexpr int kMostSteps = 8;
  constexpr double kWellDefinite = 1e-6;
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
    const Triple& h = place.hessian;
    const Pair& g = place.gradient;
    Pair step;
    bool definite;
    if (P == 0)
    {
      definite = h[2] > kWellDefinite * place.metric[1];
      step = { { 0.0, -g[1] / h[2] } };
    }
    else
    {
      const double determinant = h[0] * h[2] - h[1] * h[1];
      const double inverse = 1.0 / determinant;
      definite = h[0] > 0.0 && determinant > kWellDefinite * h[0] * h[2];
      step = { { (h[1] * g[1] - h[2] * g[0]) * inverse, (h[1] * g[0] - h[0] * g[1]) * inverse } };
    }
    target = { { place.t[0] + step[0], place.t[1] + step[1] } };
    const double longest = std::max(std::abs(step[0]), std::abs(step[1]));
    const bool inside = target[1] > range.lower[1] && target[1] < range.upper[1] &&
      (P == 0 || (target[0] > range.lower[0] && target[0] < range.upper[0]));
    if (!definite || !inside || count >= kMostSteps)
    {
      steps = definite && !inside ? Steps::Left : Steps::Stuck;
      return count;
    }
    if (longest <= kShortStep && longest <= kFastDecrease * before)
    {
      expand(query, target, place);
      steps = Steps::Done;
      return count;
    }
    before = longest;
    squared = place.squared;
    last = place.t;
    place.t = target;
  }
}

/// The rest of a descent, where plain steps do not get any further. \param count of evaluations so far
template <int P, int Q, bool Rational>
HWY_NOINLINE int go_on(const PieceQuery& query, const Range& range, int count, Place& result)
{
  const PieceShape& shape = *query.piece->shape;
  Place places[2] = { result, Place{} };
  Place* place = &places[0];
  Place* next = &places[1];
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
        expand(query, target, *place);
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
  result = *place;
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
HWY_INLINE PieceQuery query_at(const SearchStructure& structure, const double* p, std::int32_t index)
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

/// The piece to which a step leads that leaves its own, −1: none that goes on smoothly. The target is
/// moved on to that piece.
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

/// Newton's method on a piece and, where it leads out of that, on the smooth ones beside it. The query
/// moves with it. Returns the number of evaluations.
template <int P, int Q, bool Rational>
HWY_NOINLINE int walk_on(
  const SearchStructure& structure, const double* p, PieceQuery& query, Place& place)
{
  constexpr int kMostPieces = 4;
  int count = 0;
  for (int visited = 1;; ++visited)
  {
    Steps steps;
    Pair target;
    count += iterate<P, Q, Rational>(query, kWholePiece, place, steps, target);
    if (steps == Steps::Done)
    {
      return count;
    }
    const std::int32_t next = steps == Steps::Left && visited < kMostPieces
      ? piece_beyond(structure, query, target)
      : -1;
    if (next < 0)
    {
      return go_on<P, Q, Rational>(query, kWholePiece, count, place);
    }
    query = query_at(structure, p, next);
    place.t = target;
  }
}

/// Calls a function with the degrees of a piece, as far as they have code of their own, and with
/// whether it is rational.
template <class Function>
HWY_INLINE auto with_shape(const PieceShape& shape, const Function& function)
{
  using std::false_type;
  using std::true_type;
  const int p = shape.degree[0];
  const int q = shape.degree[1];
  using Any = std::integral_constant<int, -1>;
  using One = std::integral_constant<int, 1>;
  using Two = std::integral_constant<int, 2>;
  using Three = std::integral_constant<int, 3>;
  using None = std::integral_constant<int, 0>;
  if (!shape.rational)
  {
    return p == 3 && q == 3 ? function(Three(), Three(), false_type())
      : p == 0 && q == 3    ? function(None(), Three(), false_type())
      : p == 0              ? function(None(), Any(), false_type())
      : p == 1 && q == 1    ? function(One(), One(), false_type())
      : p == 2 && q == 2    ? function(Two(), Two(), false_type())
                            : function(Any(), Any(), false_type());
  }
  return p == 2 && q == 2 ? function(Two(), Two(), true_type())
    : p == 2 && q == 1    ? function(Two(), One(), true_type())
    : p == 1 && q == 2    ? function(One(), Two(), true_type())
    : p == 3 && q == 3    ? function(Three(), Three(), true_type())
    : p == 0              ? function(None(), Any(), true_type())
                          : function(Any(), Any(), true_type());
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

int walk(const SearchStructure& structure, const double* p, PieceQuery& query, Place& place)
{
  return with_shape(*query.piece->shape, [&](auto p_degree, auto q_degree, auto rational)
    { return walk_on<p_degree(), q_degree(), rational()>(structure, p, query, place); });
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
