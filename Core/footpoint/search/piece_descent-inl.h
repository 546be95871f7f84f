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
  auto raise = [s, t](int to, double* values)
  {
    values[to] = t * values[to - 1];
    for (int k = to - 1; k > 0; --k)
    {
      values[k] = s * values[k] + t * values[k - 1];
    }
    values[0] *= s;
  };
  b[0] = 1.0;
  for (int k = 1; k <= n - 2; ++k)
  {
    raise(k, b);
  }
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

/// Order of the numbers in a jet: S, S_u, S_v, S_uu, S_uv, S_vv and two that are not used.
constexpr int kJet = 8;

/// A point of a piece as a query sees it; coordinates are relative to the piece's origin.
struct Place
{
  Pair t;
  HWY_ALIGN double jet[4][kJet]; ///< x, y, z, and w with its derivatives
  double r[3];                   ///< S − P
  double squared;                ///< |S − P|²
  Pair gradient;                 ///< of E = ½|S − P|²
  Triple hessian;
  double metric[2]; ///< |S_u|², |S_v|²
};

/// Powers of t times these are the Bernstein polynomials of degree 1 … 3 and their derivatives, in
/// the order of a jet: weights of row i (u) and of column i (v) of the net. In higher degrees the
/// coefficients grow too large for this.
constexpr int kMostTabulated = 3;
struct PowerTable
{
  HWY_ALIGN double row[kMostTabulated + 1][kMostTabulated + 1][kJet];
  HWY_ALIGN double column[kMostTabulated + 1][kMostTabulated + 1][kJet];
};

constexpr PowerTable make_power_table(int n)
{
  constexpr double kBinomial[4][4] = { { 1, 0, 0, 0 }, { 1, 1, 0, 0 }, { 1, 2, 1, 0 },
    { 1, 3, 3, 1 } };
  constexpr int kOrderOfU[kJet] = { 0, 1, 0, 2, 1, 0, 0, 0 };
  constexpr int kOrderOfV[kJet] = { 0, 0, 1, 0, 1, 2, 0, 0 };
  PowerTable table{};
  for (int i = 0; i <= n; ++i)
  {
    double derivative[3][6] = {};
    for (int k = i; k <= n; ++k)
    {
      const double sign = (k - i) % 2 == 0 ? 1.0 : -1.0;
      derivative[0][k] = sign * kBinomial[n][i] * kBinomial[n - i][k - i];
    }
    for (int order = 1; order < 3; ++order)
    {
      for (int k = 0; k + 1 <= n; ++k)
      {
        derivative[order][k] = (k + 1) * derivative[order - 1][k + 1];
      }
    }
    for (int k = 0; k <= n; ++k)
    {
      for (int lane = 0; lane < 6; ++lane)
      {
        table.row[i][k][lane] = derivative[kOrderOfU[lane]][k];
        table.column[i][k][lane] = derivative[kOrderOfV[lane]][k];
      }
    }
  }
  return table;
}

constexpr PowerTable kPowers[kMostTabulated + 1] = { make_power_table(0), make_power_table(1),
  make_power_table(2), make_power_table(3) };

/// The weights of all rows (or columns) of the net, in the order of a jet.
template <int Degree>
HWY_INLINE void net_weights(int degree, double t, bool columns, double (*weights)[kJet])
{
  if (Degree >= 0)
  {
    const hn::CappedTag<double, kJet> tag;
    const int lanes = static_cast<int>(hn::Lanes(tag));
    constexpr int n = Degree >= 0 ? Degree : 0;
    const auto& table = columns ? kPowers[n].column : kPowers[n].row;
    const auto at = hn::Set(tag, t);
    for (int i = 0; i <= n; ++i)
    {
      for (int h = 0; h < kJet; h += lanes)
      {
        auto value = hn::LoadU(tag, table[i][n] + h);
        for (int k = n - 1; k >= 0; --k)
        {
          value = hn::MulAdd(value, at, hn::LoadU(tag, table[i][k] + h));
        }
        hn::StoreU(value, tag, weights[i] + h);
      }
    }
    return;
  }
  double b[32];
  double d[32];
  double dd[32];
  bernstein(degree, t, b, d, dd);
  for (int i = 0; i <= degree; ++i)
  {
    double* w = weights[i];
    w[0] = b[i];
    w[1] = columns ? b[i] : d[i];
    w[2] = columns ? d[i] : b[i];
    w[3] = columns ? b[i] : dd[i];
    w[4] = d[i];
    w[5] = columns ? dd[i] : b[i];
    w[6] = w[7] = 0.0;
  }
}

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
  const double* x = place.jet[0];
  const double* y = place.jet[1];
  const double* z = place.jet[2];
  const double rx = x[0] - query.p[0];
  const double ry = y[0] - query.p[1];
  const double rz = z[0] - query.p[2];
  place.r[0] = rx;
  place.r[1] = ry;
  place.r[2] = rz;
  auto along = [&](int k) { return rx * x[k] + ry * y[k] + rz * z[k]; };
  auto product = [&](int i, int k) { return x[i] * x[k] + y[i] * y[k] + z[i] * z[k]; };
  place.squared = rx * rx + ry * ry + rz * rz;
  place.gradient = { { along(1), along(2) } };
  place.metric[0] = product(1, 1);
  place.metric[1] = product(2, 2);
  place.hessian = { { place.metric[0] + along(3), product(1, 2) + along(4),
    place.metric[1] + along(5) } };
}

/// Solves the product rule for w·S (L. Piegl and W. Tiller 1997, A4.4).
HWY_INLINE void divide_by_weight(Place& place)
{
  const double* w = place.jet[3];
  const double inverse = 1.0 / w[0];
  for (int k = 0; k < 3; ++k)
  {
    double* x = place.jet[k];
    x[0] *= inverse;
    x[1] = (x[1] - w[1] * x[0]) * inverse;
    x[2] = (x[2] - w[2] * x[0]) * inverse;
    x[3] = (x[3] - 2.0 * w[1] * x[1] - w[3] * x[0]) * inverse;
    x[4] = (x[4] - w[1] * x[2] - w[2] * x[1] - w[4] * x[0]) * inverse;
    x[5] = (x[5] - 2.0 * w[2] * x[2] - w[5] * x[0]) * inverse;
  }
}

/// Evaluates at place.t.
template <int P, int Q, bool Rational>
HWY_INLINE void evaluate(const PieceQuery& query, Place& place)
{
  constexpr int kRows = P >= 0 ? P + 1 : 32;
  constexpr int kColumns = Q >= 0 ? Q + 1 : 32;
  const Piece& piece = *query.piece;
  const int p = P >= 0 ? P : piece.shape->degree[0];
  const int q = Q >= 0 ? Q : piece.shape->degree[1];
  HWY_ALIGN double row[kRows][kJet];
  HWY_ALIGN double column[kColumns][kJet];
  net_weights<P>(p, place.t[0], false, row);
  net_weights<Q>(q, place.t[1], true, column);
  const hn::CappedTag<double, kJet> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  for (int h = 0; h < kJet; h += lanes)
  {
    auto x = hn::Zero(tag);
    auto y = x;
    auto z = x;
    auto w = x;
    for (int j = 0; j <= q; ++j)
    {
      auto cx = hn::Zero(tag);
      auto cy = cx;
      auto cz = cx;
      auto cw = cx;
      for (int i = 0; i <= p; ++i)
      {
        const auto weight = hn::LoadU(tag, row[i] + h);
        const double* control = piece.net + 4 * (i * (q + 1) + j);
        cx = hn::MulAdd(weight, hn::Set(tag, control[0]), cx);
        cy = hn::MulAdd(weight, hn::Set(tag, control[1]), cy);
        cz = hn::MulAdd(weight, hn::Set(tag, control[2]), cz);
        if (Rational)
        {
          cw = hn::MulAdd(weight, hn::Set(tag, control[3]), cw);
        }
      }
      const auto weight = hn::LoadU(tag, column[j] + h);
      x = hn::MulAdd(weight, cx, x);
      y = hn::MulAdd(weight, cy, y);
      z = hn::MulAdd(weight, cz, z);
      if (Rational)
      {
        w = hn::MulAdd(weight, cw, w);
      }
    }
    hn::StoreU(x, tag, place.jet[0] + h);
    hn::StoreU(y, tag, place.jet[1] + h);
    hn::StoreU(z, tag, place.jet[2] + h);
    if (Rational)
    {
      hn::StoreU(w, tag, place.jet[3] + h);
    }
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

HWY_INLINE double slope(const Place& place, const std::array<bool, 2>& free)
{
  return std::max(free[0] ? std::abs(place.gradient[0]) : 0.0,
    free[1] ? std::abs(place.gradient[1]) : 0.0);
}

/// S and its derivatives a short step on, by Taylor's expansion about the place.
HWY_INLINE void expand(const PieceQuery& query, const Pair& target, Place& place)
{
  const double du = target[0] - place.t[0];
  const double dv = target[1] - place.t[1];
  for (int k = 0; k < 3; ++k)
  {
    double* x = place.jet[k];
    const double by_u = x[3] * du + x[4] * dv;
    const double by_v = x[4] * du + x[5] * dv;
    x[0] += x[1] * du + x[2] * dv + 0.5 * (by_u * du + by_v * dv);
    x[1] += by_u;
    x[2] += by_v;
  }
  place.t = target;
  complete(query, place);
}

/// Plain Newton steps from place.t for as long as they stay inside the range, the Hessian is well
/// positive definite and the point comes nearer: what most descents are. Returns the number of
/// evaluations; `done` says whether the minimum is reached.
template <int P, int Q, bool Rational>
HWY_INLINE int iterate(const PieceQuery& query, const Range& range, Place& place, bool& done)
{
  constexpr int kMostSteps = 8;
  constexpr double kWellDefinite = 1e-6;
  double before = 1.0;
  double squared = kInfinity;
  Pair last = place.t;
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
    const Pair target{ { place.t[0] + step[0], place.t[1] + step[1] } };
    const double longest = std::max(std::abs(step[0]), std::abs(step[1]));
    const bool inside = target[1] > range.lower[1] && target[1] < range.upper[1] &&
      (P == 0 || (target[0] > range.lower[0] && target[0] < range.upper[0]));
    if (!definite || !inside || count >= kMostSteps)
    {
      return count;
    }
    if (longest <= kShortStep && longest <= kFastDecrease * before)
    {
      expand(query, target, place);
      done = true;
      return count;
    }
    before = longest;
    squared = place.squared;
    last = place.t;
    place.t = target;
  }
}

/// Newton's method in a range of a piece, from place.t. Returns the number of evaluations.
template <int P, int Q, bool Rational>
HWY_NOINLINE int descend_on(const PieceQuery& query, const Range& range, Place& result)
{
  const PieceShape& shape = *query.piece->shape;
  bool done = false;
  int count = iterate<P, Q, Rational>(query, range, result, done);
  if (done)
  {
    return count;
  }
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

int descend(const PieceQuery& query, const Range& range, Place& place)
{
  const PieceShape& shape = *query.piece->shape;
  const int p = shape.degree[0];
  const int q = shape.degree[1];
  if (!shape.rational)
  {
    return p == 3 && q == 3 ? descend_on<3, 3, false>(query, range, place)
      : p == 0 && q == 3    ? descend_on<0, 3, false>(query, range, place)
      : p == 0              ? descend_on<0, -1, false>(query, range, place)
                            : descend_on<-1, -1, false>(query, range, place);
  }
  return p == 2 && q == 2 ? descend_on<2, 2, true>(query, range, place)
    : p == 0              ? descend_on<0, -1, true>(query, range, place)
                          : descend_on<-1, -1, true>(query, range, place);
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
