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

template <class T>
HWY_INLINE T dot(const T* a, const T* b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Not smaller than the length of a vector.
HWY_INLINE double bound_of_length(const double* a)
{
  return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
}

// Arithmetic is written once for numbers and for lanes of numbers (packet_descent-inl.h), operation for
// operation, so that a descent does not depend on the company it is in.

/// Bernstein polynomials of degree n and their first two derivatives.
template <class T>
HWY_INLINE void bernstein(int n, T t, T* b, T* d, T* dd)
{
  const T s = T(1.0) - t;
  if (n == 3)
  {
    const T ss = s * s;
    const T tt = t * t;
    const T st = s * t;
    b[0] = ss * s;
    b[1] = T(3.0) * ss * t;
    b[2] = T(3.0) * s * tt;
    b[3] = tt * t;
    d[0] = T(-3.0) * ss;
    d[1] = T(3.0) * ss - T(6.0) * st;
    d[2] = T(6.0) * st - T(3.0) * tt;
    d[3] = T(3.0) * tt;
    dd[0] = T(6.0) * s;
    dd[1] = T(6.0) * t - T(12.0) * s;
    dd[2] = T(6.0) * s - T(12.0) * t;
    dd[3] = T(6.0) * t;
    return;
  }
  if (n < 2)
  {
    b[0] = n == 0 ? T(1.0) : s;
    d[0] = T(n == 0 ? 0.0 : -1.0);
    dd[0] = T(0.0);
    if (n == 1)
    {
      b[1] = t;
      d[1] = T(1.0);
      dd[1] = T(0.0);
    }
    return;
  }
  // Degree n − 2 by powers, then twice one degree more.
  b[0] = T(1.0);
  T power(1.0);
  for (int k = 1; k <= n - 2; ++k)
  {
    power = power * t;
    b[k] = T(kBinomials.value[n - 2][k]) * power;
  }
  power = T(1.0);
  for (int k = n - 3; k >= 0; --k)
  {
    power = power * s;
    b[k] = b[k] * power;
  }
  auto raise = [s, t](int to, T* values)
  {
    values[to] = t * values[to - 1];
    for (int k = to - 1; k > 0; --k)
    {
      values[k] = s * values[k] + t * values[k - 1];
    }
    values[0] = values[0] * s;
  };
  for (int k = 0; k <= n; ++k)
  {
    const T left = k >= 2 ? b[k - 2] : T(0.0);
    const T middle = k >= 1 && k <= n - 1 ? b[k - 1] : T(0.0);
    const T right = k <= n - 2 ? b[k] : T(0.0);
    dd[k] = T(n * (n - 1.0)) * (left - T(2.0) * middle + right);
  }
  raise(n - 1, b);
  for (int k = 0; k <= n; ++k)
  {
    d[k] = T(n) * ((k >= 1 ? b[k - 1] : T(0.0)) - (k <= n - 1 ? b[k] : T(0.0)));
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
template <class T>
struct PlaceOf
{
  std::array<T, 2> t;
  HWY_ALIGN T jet[kJet][4];  ///< of S, and in the last column of w
  T r[3];                    ///< S − P
  T squared;                 ///< |S − P|²
  std::array<T, 2> gradient; ///< of E = ½|S − P|²
  std::array<T, 3> hessian;
  T metric[2]; ///< |S_u|², |S_v|²
};

using Place = PlaceOf<double>;

/// The part of a query that belongs to one piece.
struct PieceQuery
{
  const Piece* piece;
  std::int32_t index;
  double p[3]; ///< P, relative to the piece's origin
};

/// The rest of an evaluation, from the jet. \param p the query, relative to the piece's origin
template <class T>
HWY_INLINE void complete(const T* p, PlaceOf<T>& place)
{
  const auto& jet = place.jet;
  for (int k = 0; k < 3; ++k)
  {
    place.r[k] = jet[kS][k] - p[k];
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
template <class T>
HWY_INLINE void divide_by_weight(PlaceOf<T>& place)
{
  auto& jet = place.jet;
  const T inverse = T(1.0) / jet[kS][3];
  const T wu = jet[kSu][3];
  const T wv = jet[kSv][3];
  for (int k = 0; k < 3; ++k)
  {
    const T s = jet[kS][k] * inverse;
    const T su = (jet[kSu][k] - wu * s) * inverse;
    const T sv = (jet[kSv][k] - wv * s) * inverse;
    jet[kS][k] = s;
    jet[kSu][k] = su;
    jet[kSv][k] = sv;
    jet[kSuu][k] = (jet[kSuu][k] - T(2.0) * wu * su - jet[kSuu][3] * s) * inverse;
    jet[kSuv][k] = (jet[kSuv][k] - wu * sv - wv * su - jet[kSuv][3] * s) * inverse;
    jet[kSvv][k] = (jet[kSvv][k] - T(2.0) * wv * sv - jet[kSvv][3] * s) * inverse;
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
  complete(query.p, place);
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

/// S and its derivatives a short step on, by Taylor's expansion about the place.
/// \tparam Columns of the jet: 4 with w, 3 without
template <int Columns, class T>
HWY_INLINE void expand(const T* p, const std::array<T, 2>& target, PlaceOf<T>& place)
{
  const T du = target[0] - place.t[0];
  const T dv = target[1] - place.t[1];
  auto& jet = place.jet;
  for (int k = 0; k < Columns; ++k)
  {
    const T by_u = jet[kSuu][k] * du + jet[kSuv][k] * dv;
    const T by_v = jet[kSuv][k] * du + jet[kSvv][k] * dv;
    jet[kS][k] = jet[kS][k] + (jet[kSu][k] * du + jet[kSv][k] * dv + T(0.5) * (by_u * du + by_v * dv));
    jet[kSu][k] = jet[kSu][k] + by_u;
    jet[kSv][k] = jet[kSv][k] + by_v;
  }
  place.t = target;
  complete(p, place);
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
    return { { { T(0.0), (T(0.0) - g[1]) / h[2] } }, h[2], h[2], T(kWellDefinite) * place.metric[1] };
  }
  const T determinant = h[0] * h[2] - h[1] * h[1];
  const T inverse = T(1.0) / determinant;
  return { { { (h[1] * g[1] - h[2] * g[0]) * inverse, (h[1] * g[0] - h[0] * g[1]) * inverse } }, h[0],
    determinant, T(kWellDefinite) * h[0] * h[2] };
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
      expand<Rational ? 4 : 3>(query.p, target, place);
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
        expand<4>(query.p, target, *place);
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

/// On to the minimum of the piece from where plain steps ended. Returns the number of all evaluations.
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
