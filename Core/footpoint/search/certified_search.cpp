// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions; the best that the processor has is taken at run
// time. SSSE3 and the extensions of AVX-512 would add nothing to SSE4 and AVX-512 here.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "footpoint/search/certified_search.cpp"
#include <hwy/foreach_target.h>

#include "footpoint/search/better_foot.h"
#include "footpoint/search/certified_search.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Cells that one query may look at, and how often one of them may be halved.
constexpr int kMostCells = 20000;
constexpr int kMostHalvings = 100;

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

/// Which of up to 64 numbers are at most a limit, one bit each.
HWY_INLINE std::uint64_t at_most(const double* values, int count, double limit)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto wanted = hn::Set(tag, limit);
  std::uint64_t result = 0;
  for (int k = 0; k < count; k += lanes)
  {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Le(hn::LoadU(tag, values + k), wanted), bits);
    result |= static_cast<std::uint64_t>(bits[0]) << k;
  }
  return result;
}

/// Ranges of the first and second differences of the coefficients of F.
struct Differences
{
  double least_u, greatest_u, least_v, greatest_v;
  double least_uu, least_vv, greatest_uv;
  double greatest; ///< of all coefficients, by magnitude
};

/// All that one query needs, over all pieces.
class Finder
{
public:
  Finder(const DistanceForms& forms, const BoxTree& tree, const CertifiedQuery& query,
    SearchWorkspace& workspace, CertifiedAnswer& answer)
    : Forms(forms)
    , Tree(tree)
    , Query(query)
    , Workspace(workspace)
    , Answer(answer)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->P[k] = query.point(k);
    }
    this->Bound = query.limit;
    this->SquaredBound = query.limit * query.limit;
  }

  void run()
  {
    this->Answer.count = 0;
    this->Workspace.candidates.clear();
    this->Workspace.survivors.clear();
    if (!this->Tree.nodes().empty())
    {
      this->seed();
      this->collect();
      this->descend_on_candidates();
    }
    this->Answer.certified = this->prove_all();
  }

private:
  bool found() const { return this->Answer.count > 0; }
  const PieceFoot& best() const { return this->Answer.feet[0]; }

  double tie() const { return tie_tolerance(this->best().distance, this->Query.size); }

  /// Distance up to which feet are of interest.
  double reach() const
  {
    const double best = this->found() ? this->best().distance + this->tie() : kInfinity;
    return std::min(best, this->Bound);
  }

  PieceQuery at(std::int32_t index) const
  {
    PieceQuery query;
    query.piece = &this->Forms.pieces()[index];
    query.index = index;
    for (int k = 0; k < 3; ++k)
    {
      query.p[k] = this->P[k] - query.piece->origin[k];
    }
    return query;
  }

  // === The distance form ===

  /// |P|² − T for T the square of the best distance, without the cancellation of large numbers, and
  /// the bound of the error of any coefficient of F, over W2.
  struct Level
  {
    double constant;
    double margin;
    double level; ///< T
  };
  /// With the best foot's distance for √T, or any other.
  Level level_of(const PieceQuery& query) const;
  Level level_of(const PieceQuery& query, double distance) const;
  /// Level for dropping what is farther than reach().
  Level reach_of(const PieceQuery& query) const;

  /// Computes the coefficients of F into `target`; returns the smallest one.
  double form(const PieceQuery& query, double constant, double* target) const;
  static Pair start_of(const PieceShape& shape, const double* coefficients, double least);
  static Differences differences(const PieceShape& shape, const double* f);
  static double halve(const PieceShape& shape, const double* f, int direction, int end, double* to);

  // === The search ===

  void box_distances(const BoxTree::Node& node, double* squared) const;
  /// Goes to the piece whose box seems nearest, for a first bound.
  void seed();
  /// Finds the pieces that may hold something within reach.
  void collect();
  void descend_on_candidates();
  void collect(std::int32_t index);
  /// The nearest corner of a piece bounds the distance from above.
  void bound_by_corners(const PieceQuery& query, const double* f, double level, double margin);
  void descend_from(const PieceQuery& query, const Pair& start);
  PieceFoot foot_of(const PieceQuery& query, const Place& place, int iterations) const;
  /// Keeps a foot if it is of interest; true where it is nearer than all before by more than a tie.
  bool keep(const PieceFoot& foot);

  // === The proof ===

  bool prove_all();
  /// Differences of coefficients beyond these have their sign in exact numbers, and for T = d² as
  /// well as for T = d² − Slack. \param error of the coefficients, from halving
  double least_first_difference(double error) const
  {
    return 2.0 * (this->Margin + error) + this->Shift;
  }
  double least_second_difference(double error) const
  {
    return 4.0 * (this->Margin + error + this->Shift);
  }

  enum class Verdict
  {
    Proved,
    Open,
    Improved
  };
  Verdict prove(const PieceFoot& survivor);
  bool improves_at_corner(
    const PieceQuery& query, const SearchWorkspace::Cell& cell, const double* f);
  Verdict prove_side(const PieceQuery& query, const Range& cell, const double* f, double error,
    int i, int end);
  /// The tangent plane of F at the minimum of the range.
  Verdict support(const PieceQuery& query, const Range& range, const Pair& start);
  bool supports(const PieceQuery& query, const Range& range, const PieceFoot& place) const;

  double* coefficients(std::size_t k, int size)
  {
    const std::size_t needed = (k + 1) * size + 16;
    if (this->Workspace.coefficients.size() < needed)
    {
      this->Workspace.coefficients.resize(2 * needed);
    }
    return this->Workspace.coefficients.data() + k * size;
  }

  const DistanceForms& Forms;
  const BoxTree& Tree;
  const CertifiedQuery& Query;
  SearchWorkspace& Workspace;
  CertifiedAnswer& Answer;
  double P[3];
  double Bound = kInfinity;  ///< a point as near as this is known, or nothing farther is sought
  double SquaredBound = kInfinity;
  /// The way that seed() went down the tree.
  struct Visit
  {
    HWY_ALIGN double squared[BoxTree::kWidth];
    std::int32_t node;
    int followed;
  };
  Visit Path[16];
  int Depth = 0;
  std::int32_t Nearest = -1; ///< the piece whose corner gave Bound, and the corner
  Pair Corner{ { 0.0, 0.0 } };
  int Cells = 0;
  // Of the piece that is being proved:
  double Slack = 0.0;   ///< d² − (d − tolerance)²
  double Margin = 0.0;  ///< bound of the error of a coefficient of the piece
  double Shift = 0.0;   ///< bound of what Slack adds to a coefficient beyond a constant
  const PieceFoot* Known = nullptr;
};

Finder::Level Finder::level_of(const PieceQuery& query) const
{
  const Piece& piece = *query.piece;
  const PieceFoot& foot = this->best();
  const double far = bound_of_length(query.p);
  double f[3];
  Level level{ 0.0, 0.0, foot.distance * foot.distance };
  for (int k = 0; k < 3; ++k)
  {
    f[k] = foot.position[k] - piece.origin[k];
    level.constant += f[k] * (2.0 * query.p[k] - f[k]);
  }
  const double reach = bound_of_length(f);
  level.margin = piece.shape->roundings * kRounding *
    (piece.reach * (piece.reach + 4.0 * far) + reach * (reach + 4.0 * far));
  return level;
}

Finder::Level Finder::level_of(const PieceQuery& query, double distance) const
{
  const Piece& piece = *query.piece;
  const double squared = dot(query.p, query.p);
  const double level = distance * distance;
  return { squared - level,
    piece.shape->roundings * kRounding *
      (piece.reach * (piece.reach + 4.0 * bound_of_length(query.p)) + squared + level),
    level };
}

Finder::Level Finder::reach_of(const PieceQuery& query) const
{
  if (!this->found() || this->Bound < this->best().distance)
  {
    return this->level_of(query, this->Bound < kInfinity ? this->Bound : 0.0);
  }
  Level level = this->level_of(query);
  const double tie = this->tie() * (2.0 * this->best().distance + this->tie());
  level.constant -= tie;
  level.level += tie;
  return level;
}

double Finder::form(const PieceQuery& query, double constant, double* target) const
{
  const PieceShape& shape = *query.piece->shape;
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto x = hn::Set(tag, -2.0 * query.p[0]);
  const auto y = hn::Set(tag, -2.0 * query.p[1]);
  const auto z = hn::Set(tag, -2.0 * query.p[2]);
  const auto c = hn::Set(tag, constant);
  const int size = shape.form_size;
  const double* q = query.piece->forms;
  auto least = hn::Set(tag, kInfinity);
  if (shape.rational)
  {
    for (int k = 0; k < size; k += lanes)
    {
      auto f = hn::MulAdd(c, hn::LoadU(tag, q + 4 * size + k), hn::LoadU(tag, q + k));
      f = hn::MulAdd(x, hn::LoadU(tag, q + size + k), f);
      f = hn::MulAdd(y, hn::LoadU(tag, q + 2 * size + k), f);
      f = hn::MulAdd(z, hn::LoadU(tag, q + 3 * size + k), f);
      hn::StoreU(f, tag, target + k);
      least = hn::Min(least, f);
    }
  }
  else
  {
    for (int k = 0; k < size; k += lanes)
    {
      auto f = hn::Add(c, hn::LoadU(tag, q + k));
      f = hn::MulAdd(x, hn::LoadU(tag, q + size + k), f);
      f = hn::MulAdd(y, hn::LoadU(tag, q + 2 * size + k), f);
      f = hn::MulAdd(z, hn::LoadU(tag, q + 3 * size + k), f);
      hn::StoreU(f, tag, target + k);
      least = hn::Min(least, f);
    }
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
}

/// Near the minimum: the control points of a parabola c(t − t0)² are those of a parabola themselves,
/// with its vertex at t0 (n − 1) + ½ (from raising its degree to n).
HWY_INLINE double parabola_start(double before, double here, double after, int at, int n)
{
  const double bend = before - 2.0 * here + after;
  const double vertex = bend > 0.0 ? at + 0.5 * (before - after) / bend : at;
  return std::min(std::max((vertex - 0.5) / (n - 1), 0.0), 1.0);
}

/// Where to start from, near the smallest coefficient.
Pair Finder::start_of(const PieceShape& shape, const double* coefficients, double least)
{
  int k = 0;
  std::uint64_t bits = 0;
  for (; bits == 0 && k < shape.form_size; k += 64)
  {
    bits = at_most(coefficients + k, std::min(64, shape.form_size - k), least);
  }
  k = bits == 0 ? 0 : k - 64 + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
  const int row = k / shape.stride;
  const int column = std::min(k % shape.stride, shape.columns - 1);
  Pair start{ { 0.0, 0.0 } };
  if (shape.rows > 1)
  {
    const int at = std::clamp(row, 1, shape.rows - 2);
    const double* f = coefficients + column;
    start[0] = parabola_start(f[(at - 1) * shape.stride], f[at * shape.stride],
      f[(at + 1) * shape.stride], at, shape.rows - 1);
  }
  if (shape.columns > 1)
  {
    const int at = std::clamp(column, 1, shape.columns - 2);
    const double* f = coefficients + row * shape.stride;
    start[1] = parabola_start(f[at - 1], f[at], f[at + 1], at, shape.columns - 1);
  }
  return start;
}

Differences Finder::differences(const PieceShape& shape, const double* f)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto infinite = hn::Set(tag, kInfinity);
  const auto minus = hn::Set(tag, -kInfinity);
  auto least_u = infinite;
  auto greatest_u = minus;
  auto least_v = infinite;
  auto greatest_v = minus;
  auto least_uu = infinite;
  auto least_vv = infinite;
  auto greatest_uv = hn::Zero(tag);
  auto greatest = hn::Zero(tag);
  const int stride = shape.stride;
  for (int j = 0; j < shape.columns; j += lanes)
  {
    const auto has_next =
      hn::FirstN(tag, static_cast<std::size_t>(std::clamp(shape.columns - 1 - j, 0, lanes)));
    const auto has_second =
      hn::FirstN(tag, static_cast<std::size_t>(std::clamp(shape.columns - 2 - j, 0, lanes)));
    auto before_u = hn::Zero(tag);
    auto before_v = hn::Zero(tag);
    auto before = hn::Zero(tag);
    for (int i = 0; i < shape.rows; ++i)
    {
      const double* row = f + i * stride + j;
      const auto here = hn::LoadU(tag, row);
      const auto next = hn::LoadU(tag, row + 1);
      const auto second = hn::LoadU(tag, row + 2);
      greatest = hn::Max(greatest, hn::Abs(here));
      const auto v = hn::Sub(next, here);
      const auto vv = hn::Sub(hn::Sub(second, next), v);
      least_v = hn::Min(least_v, hn::IfThenElse(has_next, v, infinite));
      greatest_v = hn::Max(greatest_v, hn::IfThenElse(has_next, v, minus));
      least_vv = hn::Min(least_vv, hn::IfThenElse(has_second, vv, infinite));
      if (i > 0)
      {
        const auto u = hn::Sub(here, before);
        least_u = hn::Min(least_u, u);
        greatest_u = hn::Max(greatest_u, u);
        const auto uv = hn::Abs(hn::Sub(v, before_v));
        greatest_uv = hn::Max(greatest_uv, hn::IfThenElseZero(has_next, uv));
        if (i > 1)
        {
          least_uu = hn::Min(least_uu, hn::Sub(u, before_u));
        }
        before_u = u;
      }
      before = here;
      before_v = v;
    }
  }
  return { hn::GetLane(hn::MinOfLanes(tag, least_u)), hn::GetLane(hn::MaxOfLanes(tag, greatest_u)),
    hn::GetLane(hn::MinOfLanes(tag, least_v)), hn::GetLane(hn::MaxOfLanes(tag, greatest_v)),
    hn::GetLane(hn::MinOfLanes(tag, least_uu)), hn::GetLane(hn::MinOfLanes(tag, least_vv)),
    hn::GetLane(hn::MaxOfLanes(tag, greatest_uv)), hn::GetLane(hn::MaxOfLanes(tag, greatest)) };
}

/// The coefficients over one half of a cell; returns the smallest one.
double Finder::halve(const PieceShape& shape, const double* f, int direction, int end, double* to)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const std::vector<double>& weights = shape.halving[direction][end];
  auto least = hn::Set(tag, kInfinity);
  for (int i = 0; i < shape.rows; ++i)
  {
    for (int j = 0; j < shape.stride; j += lanes)
    {
      auto sum = hn::Zero(tag);
      if (direction == 0)
      {
        const int first = end == 0 ? 0 : i;
        const int last = end == 0 ? i : shape.rows - 1;
        for (int k = first; k <= last; ++k)
        {
          sum = hn::MulAdd(hn::Set(tag, weights[k * shape.rows + i]),
            hn::LoadU(tag, f + k * shape.stride + j), sum);
        }
      }
      else
      {
        for (int k = 0; k < shape.columns; ++k)
        {
          sum = hn::MulAdd(hn::Set(tag, f[i * shape.stride + k]),
            hn::LoadU(tag, weights.data() + k * shape.stride + j), sum);
        }
      }
      hn::StoreU(sum, tag, to + i * shape.stride + j);
      least = hn::Min(least, sum);
    }
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
}

// === The search ===

/// Squared distances of the boxes of a node from the query.
HWY_INLINE void Finder::box_distances(const BoxTree::Node& node, double* squared) const
{
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> single;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto zero = hn::Zero(tag);
  for (int k = 0; k < BoxTree::kWidth; k += lanes)
  {
    auto sum = zero;
    for (int i = 0; i < 3; ++i)
    {
      const auto p = hn::Set(tag, this->P[i]);
      const auto lower = hn::PromoteTo(tag, hn::LoadU(single, node.lower[i] + k));
      const auto upper = hn::PromoteTo(tag, hn::LoadU(single, node.upper[i] + k));
      const auto way = hn::Max(hn::Max(hn::Sub(lower, p), hn::Sub(p, upper)), zero);
      sum = hn::MulAdd(way, way, sum);
    }
    hn::StoreU(sum, tag, squared + k);
  }
}

void Finder::seed()
{
  const std::vector<BoxTree::Node>& nodes = this->Tree.nodes();
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> single;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  /// Weight of the distance of the box's middle: it decides between boxes that hold the point.
  const auto slight = hn::Set(tag, 1e-3);
  const auto half = hn::Set(tag, 0.5);
  std::int32_t child = 0;
  do
  {
    const BoxTree::Node& node = nodes[child];
    Visit& visit = this->Path[this->Depth++];
    visit.node = child;
    this->box_distances(node, visit.squared);
    HWY_ALIGN double score[BoxTree::kWidth];
    auto least = hn::Set(tag, kInfinity);
    for (int k = 0; k < BoxTree::kWidth; k += lanes)
    {
      auto middle = hn::Zero(tag);
      for (int i = 0; i < 3; ++i)
      {
        const auto lower = hn::PromoteTo(tag, hn::LoadU(single, node.lower[i] + k));
        const auto upper = hn::PromoteTo(tag, hn::LoadU(single, node.upper[i] + k));
        const auto way = hn::NegMulAdd(half, hn::Add(lower, upper), hn::Set(tag, this->P[i]));
        middle = hn::MulAdd(way, way, middle);
      }
      const auto value = hn::MulAdd(slight, middle, hn::LoadU(tag, visit.squared + k));
      hn::StoreU(value, tag, score + k);
      least = hn::Min(least, value);
    }
    const double value = hn::GetLane(hn::MinOfLanes(tag, least));
    // The first child where rounding to nothing comparable leaves no bit set.
    const std::uint64_t bits = at_most(score, BoxTree::kWidth, value) | 0x80;
    visit.followed = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
    child = node.child[visit.followed];
  } while (child >= 0);

  const std::int32_t index = -1 - child;
  const PieceQuery query = this->at(index);
  const PieceShape& shape = *query.piece->shape;
  const Level level = this->reach_of(query);
  double* f = this->coefficients(0, shape.form_size);
  const double least = this->form(query, level.constant - level.margin, f);
  if (this->Bound < kInfinity && least >= 0.0)
  {
    return;
  }
  this->bound_by_corners(query, f, level.level, level.margin);
  if (least + level.level < 0.25 * this->Bound * this->Bound)
  {
    this->descend_from(query, start_of(shape, f, least));
  }
  else
  {
    this->Workspace.candidates.push_back({ index, least + level.level });
  }
}

void Finder::bound_by_corners(
  const PieceQuery& query, const double* f, double level, double margin)
{
  const PieceShape& shape = *query.piece->shape;
  const double* weights = query.piece->forms + 4 * shape.form_size;
  for (int corner = 0; corner < 4; ++corner)
  {
    const int row = corner / 2 * (shape.rows - 1);
    const int column = corner % 2 * (shape.columns - 1);
    const int k = row * shape.stride + column;
    const double squared = (shape.rational ? f[k] / weights[k] : f[k]) + level + 2.0 * margin;
    if (squared < this->SquaredBound)
    {
      this->SquaredBound = squared;
      this->Bound = std::sqrt(std::max(squared, 0.0)) * (1.0 + 4.0 * kRounding);
      this->Nearest = query.index;
      this->Corner = { { corner / 2 * 1.0, corner % 2 * 1.0 } };
    }
  }
}

void Finder::collect()
{
  const std::vector<BoxTree::Node>& nodes = this->Tree.nodes();
  // Each level leaves at most seven siblings behind; 2^32 boxes are eleven levels.
  std::int32_t stack[BoxTree::kWidth * 16];
  int top = 0;
  auto take = [&](const BoxTree::Node& node, const double* squared, std::uint64_t except)
  {
    // The distance of a box is rounded a few times, in relative terms.
    constexpr double kOutward = 1.0 + 32.0 * kRounding;
    const double reach = this->reach();
    const double limit = std::min(reach * reach * kOutward, std::numeric_limits<double>::max());
    std::uint64_t hits = at_most(squared, BoxTree::kWidth, limit) & ~except;
    for (; hits != 0; hits &= hits - 1)
    {
      const std::int32_t child = node.child[hwy::Num0BitsBelowLS1Bit_Nonzero64(hits)];
      if (child >= 0)
      {
        stack[top++] = child;
      }
      else
      {
        this->collect(-1 - child);
      }
    }
  };
  // What seed() passed on its way, the nearest first.
  for (int k = this->Depth - 1; k >= 0; --k)
  {
    const Visit& visit = this->Path[k];
    take(nodes[visit.node], visit.squared, std::uint64_t(1) << visit.followed);
    while (top > 0)
    {
      const BoxTree::Node& node = nodes[stack[--top]];
      HWY_ALIGN double squared[BoxTree::kWidth];
      this->box_distances(node, squared);
      take(node, squared, 0);
    }
  }
}

void Finder::collect(std::int32_t index)
{
  const PieceQuery query = this->at(index);
  const PieceShape& shape = *query.piece->shape;
  const Level level = this->reach_of(query);
  double* f = this->coefficients(0, shape.form_size);
  const double least = this->form(query, level.constant - level.margin, f);
  if (this->Bound < kInfinity && least >= 0.0)
  {
    return;
  }
  this->Workspace.candidates.push_back({ index, least + level.level });
  this->bound_by_corners(query, f, level.level, level.margin);
}

void Finder::descend_on_candidates()
{
  std::vector<SearchWorkspace::Candidate>& candidates = this->Workspace.candidates;
  if (candidates.size() > 1)
  {
    std::sort(candidates.begin(), candidates.end(),
      [](const SearchWorkspace::Candidate& a, const SearchWorkspace::Candidate& b)
      { return a.bound != b.bound ? a.bound < b.bound : a.piece < b.piece; });
  }
  for (const SearchWorkspace::Candidate& candidate : candidates)
  {
    const PieceQuery query = this->at(candidate.piece);
    const PieceShape& shape = *query.piece->shape;
    const Level level = this->reach_of(query);
    if (!shape.rational && candidate.bound >= level.level + 2.0 * level.margin)
    {
      continue;
    }
    double* f = this->coefficients(0, shape.form_size);
    const double least = this->form(query, level.constant - level.margin, f);
    if (this->Bound < kInfinity && least >= 0.0)
    {
      continue;
    }
    this->descend_from(query, start_of(shape, f, least));
  }
  if (!this->found() && this->Nearest >= 0)
  {
    // No descent came as near as that corner.
    this->descend_from(this->at(this->Nearest), this->Corner);
  }
}

void Finder::descend_from(const PieceQuery& query, const Pair& start)
{
  Place place;
  place.t = start;
  const int iterations = descend(query, kWholePiece, place);
  this->Workspace.survivors.push_back(this->foot_of(query, place, iterations));
  this->keep(this->Workspace.survivors.back());
}

PieceFoot Finder::foot_of(const PieceQuery& query, const Place& place, int iterations) const
{
  PieceFoot foot;
  foot.piece = query.index;
  foot.t = place.t;
  for (int k = 0; k < 3; ++k)
  {
    foot.position[k] = query.piece->origin[k] + place.jet[k][0];
    foot.offset[k] = place.r[k];
    foot.first[0][k] = place.jet[k][1];
    foot.first[1][k] = place.jet[k][2];
  }
  foot.distance = std::sqrt(place.squared);
  foot.gradient = place.gradient;
  foot.hessian = place.hessian;
  foot.metric = { { place.metric[0], place.metric[1] } };
  const bool rational = query.piece->shape->rational;
  foot.weight = { { rational ? place.jet[3][0] : 1.0, rational ? place.jet[3][1] : 0.0,
    rational ? place.jet[3][2] : 0.0 } };
  foot.iterations = iterations;
  return foot;
}

bool Finder::keep(const PieceFoot& foot)
{
  if (!(foot.distance <= this->reach()))
  {
    return false;
  }
  CertifiedAnswer& answer = this->Answer;
  // By how much it is nearer than another foot, without the rounding of large distances.
  auto gain = [&foot](const PieceFoot& other)
  {
    double difference = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      difference +=
        (other.position[k] - foot.position[k]) * (other.offset[k] + foot.offset[k]);
    }
    const double sum = other.distance + foot.distance;
    return sum > 0.0 ? difference / sum : 0.0;
  };
  const double tie = tie_tolerance(0.0, this->Query.size);
  const double nearer = answer.count > 0 ? gain(answer.feet[0]) : kInfinity;
  if (nearer < -tie)
  {
    return false;
  }
  for (int k = 0; k < answer.count; ++k)
  {
    const PieceFoot& other = answer.feet[k];
    if (other.piece == foot.piece && nearer <= tie && std::abs(other.t[0] - foot.t[0]) < 1e-9 &&
      std::abs(other.t[1] - foot.t[1]) < 1e-9)
    {
      return false;
    }
  }
  if (nearer > 0.0)
  {
    // The nearest comes first; what no longer ties with it is dropped.
    int count = 0;
    for (int k = 0; k < answer.count; ++k)
    {
      if (gain(answer.feet[k]) <= tie)
      {
        answer.feet[count++] = answer.feet[k];
      }
    }
    count = std::min(count, CertifiedAnswer::kMost - 1);
    std::copy_backward(
      answer.feet.begin(), answer.feet.begin() + count, answer.feet.begin() + count + 1);
    answer.feet[0] = foot;
    answer.count = count + 1;
  }
  else if (answer.count < CertifiedAnswer::kMost)
  {
    answer.feet[answer.count++] = foot;
  }
  return nearer > tie;
}

// === The proof ===

bool Finder::prove_all()
{
  if (this->found() && this->best().distance <= this->Query.tolerance)
  {
    return true; // no distance is negative
  }
  bool proved = true;
  for (std::size_t k = 0; k < this->Workspace.survivors.size(); ++k)
  {
    const PieceFoot survivor = this->Workspace.survivors[k];
    Verdict verdict = Verdict::Improved;
    while (verdict == Verdict::Improved)
    {
      verdict = this->prove(survivor);
    }
    proved = proved && verdict == Verdict::Proved;
  }
  return proved;
}

Finder::Verdict Finder::prove(const PieceFoot& survivor)
{
  const PieceQuery query = this->at(survivor.piece);
  const Piece& piece = *query.piece;
  const PieceShape& shape = *piece.shape;
  const Level level =
    this->found() ? this->level_of(query) : this->level_of(query, this->Query.limit);
  const double distance = this->found() ? this->best().distance : this->Query.limit;
  const double tolerance = std::min(this->Query.tolerance, distance);
  this->Slack = this->found() ? tolerance * (2.0 * distance - tolerance) : 0.0;
  this->Margin = level.margin * piece.greatest_weight;
  this->Shift = shape.rational ? this->Slack * piece.greatest_weight : 0.0;
  this->Known = &survivor;
  const int size = shape.form_size;
  const bool has_u = shape.rows > 1;
  const bool has_v = shape.columns > 1;
  const double n = shape.rows - 1;
  const double m = shape.columns - 1;
  std::vector<SearchWorkspace::Cell>& cells = this->Workspace.cells;
  cells.clear();
  const double least = this->form(
    query, level.constant + this->Slack - level.margin, this->coefficients(0, size));
  cells.push_back({ { { 0.0, 0.0 } }, { { 1.0, 1.0 } }, least, 0.0, 0 });
  bool open = false;
  while (!cells.empty())
  {
    const SearchWorkspace::Cell cell = cells.back();
    const std::size_t at = cells.size() - 1;
    if (cell.least >= cell.error)
    {
      cells.pop_back();
      continue;
    }
    if (++this->Cells > kMostCells)
    {
      return Verdict::Open;
    }
    double* f = this->coefficients(at, size);
    if (this->improves_at_corner(query, cell, f))
    {
      return Verdict::Improved;
    }
    const Differences d = differences(shape, f);
    const double first = this->least_first_difference(cell.error);
    const double second = this->least_second_difference(cell.error);
    const Range range{ cell.lower, cell.upper };
    Verdict verdict = Verdict::Open;
    const double uv = d.greatest_uv + second;
    const bool convex = (!has_u || d.least_uu > second) && (!has_v || d.least_vv > second) &&
      (!has_u || !has_v ||
        // (n(n−1) uu)(m(m−1) vv) > (n m uv)²
        (d.least_uu - second) * (d.least_vv - second) * (n - 1.0) * (m - 1.0) > n * m * uv * uv);
    if (convex)
    {
      verdict = this->support(query, range, this->Known->t);
    }
    for (int i = 0; i < 2 && verdict == Verdict::Open; ++i)
    {
      // Monotone: only one side matters.
      const double lowest = i == 0 ? d.least_u : d.least_v;
      const double highest = i == 0 ? d.greatest_u : d.greatest_v;
      if (shape.degree[i] > 0 && (lowest > first || highest < -first))
      {
        verdict = this->prove_side(query, range, f, cell.error, i, lowest > first ? 0 : 1);
        break;
      }
    }
    if (verdict == Verdict::Improved)
    {
      return verdict;
    }
    if (verdict == Verdict::Proved)
    {
      cells.pop_back();
      continue;
    }
    if (cell.depth >= kMostHalvings)
    {
      // Not proved; but nothing that a descent from here can find is passed over.
      if (this->support(query, range, cell.lower) == Verdict::Improved)
      {
        return Verdict::Improved;
      }
      open = true;
      cells.pop_back();
      continue;
    }
    // Halved where the slope changes more.
    const double change_u = has_u ? (d.greatest_u - d.least_u) * n : -1.0;
    const double change_v = has_v ? (d.greatest_v - d.least_v) * m : -1.0;
    const int cut = change_u > change_v ? 0 : 1;
    const int terms = cut == 0 ? shape.rows : shape.columns;
    const double middle = 0.5 * (cell.lower[cut] + cell.upper[cut]);
    SearchWorkspace::Cell low = cell;
    SearchWorkspace::Cell high = cell;
    low.error = high.error = cell.error + terms * kRounding * d.greatest;
    low.depth = high.depth = cell.depth + 1;
    low.upper[cut] = middle;
    high.lower[cut] = middle;
    // The upper half goes on top of the lower one, which takes the place of the whole.
    double* scratch = this->coefficients(at + 2, size); // the last one first: it may move the others
    double* upper = this->coefficients(at + 1, size);
    f = this->coefficients(at, size);
    high.least = halve(shape, f, cut, 1, upper);
    low.least = halve(shape, f, cut, 0, scratch);
    std::copy(scratch, scratch + size, f);
    cells.back() = low;
    cells.push_back(high);
  }
  return open ? Verdict::Open : Verdict::Proved;
}

/// The coefficients at the corners are values of F: where one is negative the corner itself is nearer
/// than the best foot, and a descent from there finds what is nearer still.
bool Finder::improves_at_corner(
  const PieceQuery& query, const SearchWorkspace::Cell& cell, const double* f)
{
  const PieceShape& shape = *query.piece->shape;
  double least = -2.0 * (this->Margin + cell.error);
  int found = -1;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double value =
      f[corner / 2 * (shape.rows - 1) * shape.stride + corner % 2 * (shape.columns - 1)];
    if (value < least)
    {
      least = value;
      found = corner;
    }
  }
  if (found < 0)
  {
    return false;
  }
  Place place;
  place.t = { { (found / 2 == 0 ? cell.lower : cell.upper)[0],
    (found % 2 == 0 ? cell.lower : cell.upper)[1] } };
  const int iterations = descend(query, kWholePiece, place);
  return this->keep(this->foot_of(query, place, iterations));
}

/// The same along one side of a cell, at one end of direction i.
Finder::Verdict Finder::prove_side(const PieceQuery& query, const Range& cell, const double* f,
  double error, int i, int end)
{
  const PieceShape& shape = *query.piece->shape;
  const int direction = 1 - i;
  const int n = direction == 0 ? shape.rows - 1 : shape.columns - 1;
  Range range = cell;
  (end == 0 ? range.upper : range.lower)[i] = (end == 0 ? range.lower : range.upper)[i];
  struct Line
  {
    double f[64];
    double lower, upper, error;
  };
  Line stack[kMostHalvings + 2];
  int top = 0;
  for (int k = 0; k <= n; ++k)
  {
    const int row = direction == 0 ? k : end * (shape.rows - 1);
    const int column = direction == 1 ? k : end * (shape.columns - 1);
    stack[0].f[k] = f[row * shape.stride + column];
  }
  stack[0].lower = range.lower[direction];
  stack[0].upper = range.upper[direction];
  stack[0].error = error;
  ++top;
  bool open = false;
  while (top > 0)
  {
    Line& line = stack[top - 1];
    double least = line.f[0];
    double least_first = kInfinity;
    double greatest_first = -kInfinity;
    double least_second = kInfinity;
    double greatest = std::abs(line.f[0]);
    for (int k = 1; k <= n; ++k)
    {
      const double step = line.f[k] - line.f[k - 1];
      least = std::min(least, line.f[k]);
      greatest = std::max(greatest, std::abs(line.f[k]));
      least_first = std::min(least_first, step);
      greatest_first = std::max(greatest_first, step);
      if (k > 1)
      {
        least_second = std::min(least_second, step - (line.f[k - 1] - line.f[k - 2]));
      }
    }
    if (least >= line.error)
    {
      --top;
      continue;
    }
    if (++this->Cells > kMostCells)
    {
      return Verdict::Open;
    }
    Range here = range;
    here.lower[direction] = line.lower;
    here.upper[direction] = line.upper;
    const double first = this->least_first_difference(line.error);
    const double second = this->least_second_difference(line.error);
    Verdict verdict = Verdict::Open;
    if (n == 0 || least_first > first || greatest_first < -first)
    {
      here.lower[direction] = here.upper[direction] =
        least_first > first ? line.lower : line.upper;
      verdict = this->support(query, here, here.lower);
    }
    else if (n == 1 || least_second > second)
    {
      verdict = this->support(query, here, this->Known->t);
    }
    if (verdict == Verdict::Improved)
    {
      return verdict;
    }
    if (verdict == Verdict::Proved)
    {
      --top;
      continue;
    }
    if (top > kMostHalvings)
    {
      open = true;
      --top;
      continue;
    }
    Line& upper = stack[top];
    const double middle = 0.5 * (line.lower + line.upper);
    upper.lower = middle;
    upper.upper = line.upper;
    line.upper = middle;
    upper.error = line.error = line.error + n * kRounding * greatest;
    std::copy(line.f, line.f + n + 1, upper.f);
    for (int level = 1; level <= n; ++level)
    {
      // upper.f becomes the upper half, its first entries are those of the lower one.
      for (int k = 0; k <= n - level; ++k)
      {
        upper.f[k] = 0.5 * (upper.f[k] + upper.f[k + 1]);
      }
      line.f[level] = upper.f[0];
    }
    ++top;
  }
  return open ? Verdict::Open : Verdict::Proved;
}

/// \pre F is convex over the range, or the range is a point.
Finder::Verdict Finder::support(const PieceQuery& query, const Range& range, const Pair& start)
{
  const PieceFoot& known = *this->Known;
  bool inside = true;
  Place place;
  for (int i = 0; i < 2; ++i)
  {
    place.t[i] = std::min(std::max(start[i], range.lower[i]), range.upper[i]);
    inside = inside && place.t[i] == known.t[i];
  }
  if (inside && this->supports(query, range, known))
  {
    return Verdict::Proved;
  }
  const int iterations = descend(query, range, place);
  const PieceFoot foot = this->foot_of(query, place, iterations);
  if (!inside && foot.distance <= this->reach())
  {
    Place whole;
    whole.t = place.t;
    const int more = descend(query, kWholePiece, whole);
    if (this->keep(this->foot_of(query, whole, iterations + more)))
    {
      return Verdict::Improved;
    }
  }
  return this->supports(query, range, foot) ? Verdict::Proved : Verdict::Open;
}

/// Whether the tangent plane of F = w² (|S − P|² − d²) at a place stays above what is allowed.
bool Finder::supports(const PieceQuery& query, const Range& range, const PieceFoot& place) const
{
  const Piece& piece = *query.piece;
  double excess;
  if (this->found())
  {
    // Without the cancellation of large numbers: (S − f)·(S + f − 2P).
    const PieceFoot& foot = this->best();
    excess = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      excess += (place.position[k] - foot.position[k]) * (place.offset[k] + foot.offset[k]);
    }
  }
  else
  {
    excess = place.distance * place.distance - this->Query.limit * this->Query.limit;
  }
  const double w = place.weight[0];
  double value = w * w * excess;
  for (int i = 0; i < 2; ++i)
  {
    const double slope =
      2.0 * (w * w * place.gradient[i] + w * place.weight[1 + i] * excess);
    const double way = slope > 0.0 ? range.lower[i] - place.t[i] : range.upper[i] - place.t[i];
    value += way == 0.0 ? 0.0 : slope * way;
  }
  return value >= -this->Slack * piece.least_weight;
}

} // namespace

void find_nearest(const DistanceForms& forms, const BoxTree& tree, const CertifiedQuery& query,
  SearchWorkspace& workspace, CertifiedAnswer& answer)
{
  Finder(forms, tree, query, workspace, answer).run();
}

} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace footpoint
{
namespace
{
HWY_EXPORT(find_nearest);
}

CertifiedSearch::CertifiedSearch(DistanceForms forms)
  : Forms(std::move(forms))
  , Tree(this->Forms.boxes())
{
}

void CertifiedSearch::find(
  const CertifiedQuery& query, SearchWorkspace& workspace, CertifiedAnswer& answer) const
{
  HWY_DYNAMIC_DISPATCH(find_nearest)(this->Forms, this->Tree, query, workspace, answer);
}

} // namespace footpoint

#endif
