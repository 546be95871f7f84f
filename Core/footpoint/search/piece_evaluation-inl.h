// SPDX-License-Identifier: BSD-3-Clause

// Evaluation of Bézier pieces, compiled once for each set of vector instructions: included again by
// every file that is (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PIECE_EVALUATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_EVALUATION_INL_H
#undef FOOTPOINT_PIECE_EVALUATION_INL_H
#else
#define FOOTPOINT_PIECE_EVALUATION_INL_H
#endif

#include "footpoint/search/distance_forms.h"
#include "footpoint/splines/binomials.h"

#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

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

/// Numbers in a vector of a form. Between forms a query is arithmetic on single numbers, which many
/// processors have a port less for as long as vectors of 512 bits are under way. Boxes, and several
/// queries at once (packet_descent-inl.h), are vectors alone, and take the widest.
constexpr int kMostLanes = 4;

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

// Arithmetic is written once for numbers and for lanes of numbers (packet_descent-inl.h), operation
// for operation, so that a descent does not depend on the company it is in.

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

// Curves have degree 0 in u: what is by u is zero, and known to be when compiled (P = 0).

/// The rest of an evaluation, from the jet. \param p the query, relative to the piece's origin
template <int P, class T>
HWY_INLINE void complete(const T* p, PlaceOf<T>& place)
{
  const auto& jet = place.jet;
  for (int k = 0; k < 3; ++k)
  {
    place.r[k] = jet[kS][k] - p[k];
  }
  place.squared = dot(place.r, place.r);
  if (P == 0)
  {
    const T zero(0.0);
    place.gradient = { { zero, dot(place.r, jet[kSv]) } };
    place.metric[0] = zero;
    place.metric[1] = dot(jet[kSv], jet[kSv]);
    place.hessian = { { zero, zero, place.metric[1] + dot(place.r, jet[kSvv]) } };
    return;
  }
  place.gradient = { { dot(place.r, jet[kSu]), dot(place.r, jet[kSv]) } };
  place.metric[0] = dot(jet[kSu], jet[kSu]);
  place.metric[1] = dot(jet[kSv], jet[kSv]);
  place.hessian = { { place.metric[0] + dot(place.r, jet[kSuu]),
    dot(jet[kSu], jet[kSv]) + dot(place.r, jet[kSuv]),
    place.metric[1] + dot(place.r, jet[kSvv]) } };
}

/// Solves the product rule for w·S (L. Piegl and W. Tiller 1997, A4.4).
template <int P, class T>
HWY_INLINE void divide_by_weight(PlaceOf<T>& place)
{
  auto& jet = place.jet;
  const T inverse = T(1.0) / jet[kS][3];
  const T wu = jet[kSu][3];
  const T wv = jet[kSv][3];
  for (int k = 0; k < 3; ++k)
  {
    const T s = jet[kS][k] * inverse;
    const T sv = (jet[kSv][k] - wv * s) * inverse;
    jet[kS][k] = s;
    jet[kSv][k] = sv;
    jet[kSvv][k] = (jet[kSvv][k] - T(2.0) * wv * sv - jet[kSvv][3] * s) * inverse;
    if (P != 0)
    {
      const T su = (jet[kSu][k] - wu * s) * inverse;
      jet[kSu][k] = su;
      jet[kSuu][k] = (jet[kSuu][k] - T(2.0) * wu * su - jet[kSuu][3] * s) * inverse;
      jet[kSuv][k] = (jet[kSuv][k] - wu * sv - wv * su - jet[kSuv][3] * s) * inverse;
    }
  }
}

/// Evaluates at place.t: rows of the net are summed first, then its columns. A vector holds one
/// control point; to hold two of them in wider ones takes longer.
template <int P, int Q, bool Rational>
HWY_INLINE void evaluate(const PieceQuery& query, Place& place)
{
  constexpr int kMostRows = P >= 0 ? P + 1 : kMaximumDegree + 1;
  constexpr int kMostColumns = Q >= 0 ? Q + 1 : kMaximumDegree + 1;
  const Piece& piece = *query.piece;
  const int p = P >= 0 ? P : piece.shape->degree[0];
  const int q = Q >= 0 ? Q : piece.shape->degree[1];
  double row[3][kMostRows];
  double column[3][kMostColumns];
  bernstein(p, place.t[0], row[0], row[1], row[2]);
  bernstein(q, place.t[1], column[0], column[1], column[2]);
  const hn::CappedTag<double, 4> tag;
  for (int part = 0; part < 4; part += static_cast<int>(hn::MaxLanes(tag)))
  {
    auto s = hn::Zero(tag);
    auto su = s;
    auto sv = s;
    auto suu = s;
    auto suv = s;
    auto svv = s;
    for (int j = 0; j <= q; ++j)
    {
      const auto b = hn::Set(tag, column[0][j]);
      const auto bv = hn::Set(tag, column[1][j]);
      const auto bvv = hn::Set(tag, column[2][j]);
      auto c = hn::Zero(tag);
      if (P == 0)
      {
        c = hn::LoadU(tag, piece.net + 4 * j + part);
      }
      else
      {
        auto cu = c;
        auto cuu = c;
        for (int i = 0; i <= p; ++i)
        {
          const auto control = hn::LoadU(tag, piece.net + 4 * (i * (q + 1) + j) + part);
          c = hn::MulAdd(hn::Set(tag, row[0][i]), control, c);
          cu = hn::MulAdd(hn::Set(tag, row[1][i]), control, cu);
          cuu = hn::MulAdd(hn::Set(tag, row[2][i]), control, cuu);
        }
        su = hn::MulAdd(b, cu, su);
        suu = hn::MulAdd(b, cuu, suu);
        suv = hn::MulAdd(bv, cu, suv);
      }
      s = hn::MulAdd(b, c, s);
      sv = hn::MulAdd(bv, c, sv);
      svv = hn::MulAdd(bvv, c, svv);
    }
    hn::StoreU(s, tag, place.jet[kS] + part);
    hn::StoreU(su, tag, place.jet[kSu] + part);
    hn::StoreU(sv, tag, place.jet[kSv] + part);
    hn::StoreU(suu, tag, place.jet[kSuu] + part);
    hn::StoreU(suv, tag, place.jet[kSuv] + part);
    hn::StoreU(svv, tag, place.jet[kSvv] + part);
  }
  if (Rational)
  {
    divide_by_weight<P>(place);
  }
  complete<P>(query.p, place);
}

/// S and its derivatives a short step on, by Taylor's expansion about the place.
/// \tparam Columns of the jet: 4 with w, 3 without
template <int P, int Columns, class T>
HWY_INLINE void expand(const T* p, const std::array<T, 2>& target, PlaceOf<T>& place)
{
  const T du = target[0] - place.t[0];
  const T dv = target[1] - place.t[1];
  auto& jet = place.jet;
  for (int k = 0; k < Columns; ++k)
  {
    if (P == 0)
    {
      const T by_v = jet[kSvv][k] * dv;
      jet[kS][k] = jet[kS][k] + (jet[kSv][k] * dv + T(0.5) * (by_v * dv));
      jet[kSv][k] = jet[kSv][k] + by_v;
      continue;
    }
    const T by_u = jet[kSuu][k] * du + jet[kSuv][k] * dv;
    const T by_v = jet[kSuv][k] * du + jet[kSvv][k] * dv;
    jet[kS][k] =
      jet[kS][k] + (jet[kSu][k] * du + jet[kSv][k] * dv + T(0.5) * (by_u * du + by_v * dv));
    jet[kSu][k] = jet[kSu][k] + by_u;
    jet[kSv][k] = jet[kSv][k] + by_v;
  }
  place.t = target;
  complete<P>(p, place);
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
      : p == 3 && q == 1    ? function(Three(), One(), false_type())
      : p == 1 && q == 3    ? function(One(), Three(), false_type())
                            : function(Any(), Any(), false_type());
  }
  return p == 2 && q == 2 ? function(Two(), Two(), true_type())
    : p == 2 && q == 1    ? function(Two(), One(), true_type())
    : p == 1 && q == 2    ? function(One(), Two(), true_type())
    : p == 3 && q == 3    ? function(Three(), Three(), true_type())
    : p == 0              ? function(None(), Any(), true_type())
                          : function(Any(), Any(), true_type());
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
