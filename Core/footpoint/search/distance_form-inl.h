// SPDX-License-Identifier: BSD-3-Clause

// The distance form of a piece for a query, and what its coefficients say. Compiled once for each
// set of vector instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_DISTANCE_FORM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_DISTANCE_FORM_INL_H
#undef FOOTPOINT_DISTANCE_FORM_INL_H
#else
#define FOOTPOINT_DISTANCE_FORM_INL_H
#endif

#include "footpoint/search/piece_evaluation-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// In a row of a form, with what pads it.
constexpr int kMostNumbers = (2 * kMaximumDegree + 8) / 8 * 8;

/// Adds −2 P·N, raised to the degree of F, to Q + constant: rows of the net first, along the second
/// direction, then along the first. \return the smallest coefficient
/// \tparam P, Q degrees; −1: any
template <int P, int Q>
HWY_NOINLINE double raised_form(const PieceQuery& query, double constant, double* target)
{
  const hn::CappedTag<double, kMostLanes> tag;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(tag)); // of one size wherever this compiles
  constexpr int kMostRows = (P >= 0 ? P : kMaximumDegree) + 1;
  constexpr int kMostColumns = Q >= 0 ? (2 * Q + 8) / 8 * 8 : kMostNumbers;
  const PieceShape& shape = *query.piece->shape;
  const int p = P >= 0 ? P : shape.degree[0];
  const int q = Q >= 0 ? Q : shape.degree[1];
  const int stride = Q >= 0 ? kMostColumns : shape.stride;
  HWY_ALIGN double rows[kMostRows * kMostColumns];
  const double x = -2.0 * query.p[0];
  const double y = -2.0 * query.p[1];
  const double z = -2.0 * query.p[2];
  const double* control = query.piece->net;
  for (int i = 0; i <= p; ++i)
  {
    double heights[(Q >= 0 ? Q : kMaximumDegree) + 1];
    for (int k = 0; k <= q; ++k, control += 4)
    {
      heights[k] = x * control[0] + (y * control[1] + z * control[2]);
    }
    for (int j = 0; j < stride; j += kLanes)
    {
      const double* raising = shape.raising[1].data() + j;
      auto sum = hn::Mul(hn::Set(tag, heights[0]), hn::LoadU(tag, raising));
      for (int k = 1; k <= q; ++k)
      {
        sum = hn::MulAdd(hn::Set(tag, heights[k]), hn::LoadU(tag, raising + k * stride), sum);
      }
      hn::Store(sum, tag, rows + i * stride + j);
    }
  }
  const double* raising = shape.raising[0].data();
  const double* forms = query.piece->forms;
  const auto c = hn::Set(tag, constant);
  auto least = hn::Set(tag, kInfinity);
  for (int i = 0; i <= 2 * p; ++i)
  {
    for (int j = 0; j < stride; j += kLanes)
    {
      auto sum = hn::Zero(tag);
      for (int k = std::max(0, i - p); k <= std::min(p, i); ++k)
      {
        sum = hn::MulAdd(hn::Set(tag, raising[k * (2 * p + 1) + i]),
          hn::Load(tag, rows + k * stride + j), sum);
      }
      const auto f = hn::Add(hn::Add(c, hn::LoadU(tag, forms + i * stride + j)), sum);
      hn::StoreU(f, tag, target + i * stride + j);
      least = hn::Min(least, f);
    }
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
}

/// The Bernstein coefficients of Q − 2 P·W + constant × W2, see DistanceForms.
/// \param constant |P|² − T, or less
/// \param target   receives rows of PieceShape::stride numbers, padded by the last coefficient
/// \return the smallest one
inline double distance_form(const PieceQuery& query, double constant, double* target)
{
  const PieceShape& shape = *query.piece->shape;
  if (!shape.rational)
  {
    return with_shape(shape,
      [&](auto p, auto q, auto) { return raised_form<p(), q()>(query, constant, target); });
  }
  const hn::CappedTag<double, kMostLanes> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto x = hn::Set(tag, -2.0 * query.p[0]);
  const auto y = hn::Set(tag, -2.0 * query.p[1]);
  const auto z = hn::Set(tag, -2.0 * query.p[2]);
  const auto c = hn::Set(tag, constant);
  const int size = shape.form_size;
  const double* q = query.piece->forms;
  auto least = hn::Set(tag, kInfinity);
  for (int k = 0; k < size; k += lanes)
  {
    auto f = hn::MulAdd(c, hn::LoadU(tag, q + 4 * size + k), hn::LoadU(tag, q + k));
    f = hn::MulAdd(x, hn::LoadU(tag, q + size + k), f);
    f = hn::MulAdd(y, hn::LoadU(tag, q + 2 * size + k), f);
    f = hn::MulAdd(z, hn::LoadU(tag, q + 3 * size + k), f);
    hn::StoreU(f, tag, target + k);
    least = hn::Min(least, f);
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
}

/// What the first differences of the coefficients of F say.
struct Slopes
{
  int monotone;    ///< the direction along which F is monotone, −1: none
  int end;         ///< where it is smallest then
  int cut;         ///< otherwise the direction along which the slope changes more
  double greatest; ///< and the greatest of the coefficients, by magnitude
};

/// \param error a first difference beyond this has its sign in exact numbers
inline Slopes slopes_of(const PieceShape& shape, const double* f, double error)
{
  const hn::CappedTag<double, kMostLanes> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto infinite = hn::Set(tag, kInfinity);
  const auto minus = hn::Set(tag, -kInfinity);
  auto least_u = infinite;
  auto greatest_u = minus;
  auto least_v = infinite;
  auto greatest_v = minus;
  auto greatest = hn::Zero(tag);
  for (int j = 0; j < shape.columns; j += lanes)
  {
    const auto has_next =
      hn::FirstN(tag, static_cast<std::size_t>(std::clamp(shape.columns - 1 - j, 0, lanes)));
    auto before = hn::Zero(tag);
    for (int i = 0; i < shape.rows; ++i)
    {
      const double* row = f + i * shape.stride + j;
      const auto here = hn::LoadU(tag, row);
      const auto v = hn::Sub(hn::LoadU(tag, row + 1), here);
      greatest = hn::Max(greatest, hn::Abs(here));
      least_v = hn::Min(least_v, hn::IfThenElse(has_next, v, infinite));
      greatest_v = hn::Max(greatest_v, hn::IfThenElse(has_next, v, minus));
      if (i > 0)
      {
        const auto u = hn::Sub(here, before);
        least_u = hn::Min(least_u, u);
        greatest_u = hn::Max(greatest_u, u);
      }
      before = here;
    }
  }
  const auto above = hn::Set(tag, error);
  const auto below = hn::Set(tag, -error);
  const bool has_u = shape.rows > 1;
  const bool rises_u = has_u && hn::AllTrue(tag, hn::Gt(least_u, above));
  if (rises_u || (has_u && hn::AllTrue(tag, hn::Lt(greatest_u, below))))
  {
    return { 0, rises_u ? 0 : 1, 0, 0.0 };
  }
  const bool rises_v = hn::AllTrue(tag, hn::Gt(least_v, above));
  if (rises_v || hn::AllTrue(tag, hn::Lt(greatest_v, below)))
  {
    return { 1, rises_v ? 0 : 1, 0, 0.0 };
  }
  const double change_v =
    hn::GetLane(hn::MaxOfLanes(tag, greatest_v)) - hn::GetLane(hn::MinOfLanes(tag, least_v));
  const double change_u = has_u
    ? hn::GetLane(hn::MaxOfLanes(tag, greatest_u)) - hn::GetLane(hn::MinOfLanes(tag, least_u))
    : 0.0;
  const bool along_u = change_u * (shape.rows - 1) > change_v * (shape.columns - 1);
  return { -1, 0, along_u ? 0 : 1, hn::GetLane(hn::MaxOfLanes(tag, greatest)) };
}

/// Whether the matrices of second derivatives are positive definite as coefficients of the common
/// degree (n, m): from raising the degrees of the second differences,
///   F_uu: i(i−1) D_{i−2} + 2 i(n−i) D_{i−1} + (n−i)(n−i−1) D_i  for each column, likewise F_vv;
///   F_uv: i j D_{i−1,j−1} + i(m−j) D_{i−1,j} + (n−i) j D_{i,j−1} + (n−i)(m−j) D_{ij}.
/// Positive definite matrices make a convex cone, so F is convex. Far less is lost than by
/// comparing the extremes of each, since where one of them is large the others are.
/// \param error of a second difference, and of the rounding here
inline bool is_convex(const PieceShape& shape, const double* f, double error)
{
  const hn::CappedTag<double, kMostLanes> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const int n = shape.rows - 1;
  const int m = shape.columns - 1;
  const int stride = shape.stride;
  const auto error_uu = hn::Set(tag, n * (n - 1.0) * error);
  const auto error_vv = hn::Set(tag, m * (m - 1.0) * error);
  const auto error_uv = hn::Set(tag, n * static_cast<double>(m) * error);
  const auto zero = hn::Zero(tag);
  for (int first = 0; first <= m; first += lanes)
  {
    const auto unused = hn::Not(
      hn::FirstN(tag, static_cast<std::size_t>(std::min(m + 1 - first, lanes))));
    // The factors of what lies beyond the ends of a row are zero; it only has to be finite.
    const auto j = hn::Iota(tag, static_cast<double>(first));
    const auto rest = hn::Sub(hn::Set(tag, static_cast<double>(m)), j);
    const auto one = hn::Set(tag, 1.0);
    const auto factor_before = hn::Mul(j, hn::Sub(j, one));
    const auto factor_here = hn::Mul(hn::Add(j, j), rest);
    const auto factor_after = hn::Mul(rest, hn::Sub(rest, one));
    // Of row i: its coefficients, and its slope along v, raised to degree m.
    auto level = [&](int i) { return hn::LoadU(tag, f + i * stride + first); };
    auto slope = [&](int i)
    {
      const double* row = f + i * stride + first;
      const auto here = hn::LoadU(tag, row);
      return hn::MulAdd(j, hn::Sub(here, hn::LoadU(tag, row - 1)),
        hn::Mul(rest, hn::Sub(hn::LoadU(tag, row + 1), here)));
    };
    auto here = level(0);
    auto step = n > 0 ? hn::Sub(level(1), here) : zero; // from row i to row i + 1
    auto second_before_that = zero; // second differences from row i − 2 and i − 1 on
    auto second_before = zero;
    auto twist_before = zero;
    auto slope_here = n > 0 ? slope(0) : zero;
    for (int i = 0; i <= n; ++i)
    {
      const double* row = f + i * stride + first;
      here = hn::LoadU(tag, row);
      const auto left = hn::LoadU(tag, row - 1);
      const auto right = hn::LoadU(tag, row + 1);
      const auto step_left = hn::Sub(here, left);
      const auto step_right = hn::Sub(right, here);
      auto vv = hn::Mul(
        factor_before, hn::Sub(step_left, hn::Sub(left, hn::LoadU(tag, row - 2))));
      vv = hn::MulAdd(factor_here, hn::Sub(step_right, step_left), vv);
      vv = hn::MulAdd(
        factor_after, hn::Sub(hn::Sub(hn::LoadU(tag, row + 2), right), step_right), vv);
      const auto c = hn::Sub(vv, error_vv);
      auto fine = hn::Gt(c, zero);
      if (n > 0)
      {
        auto second = zero;
        auto twist = zero;
        auto step_after = zero;
        if (i < n)
        {
          const auto slope_next = slope(i + 1);
          twist = hn::Sub(slope_next, slope_here);
          slope_here = slope_next;
        }
        if (i + 1 < n)
        {
          step_after = hn::Sub(level(i + 2), level(i + 1));
          second = hn::Sub(step_after, step);
        }
        auto uu = hn::Mul(hn::Set(tag, i * (i - 1.0)), second_before_that);
        uu = hn::MulAdd(hn::Set(tag, 2.0 * i * (n - i)), second_before, uu);
        uu = hn::MulAdd(hn::Set(tag, (n - i) * (n - i - 1.0)), second, uu);
        auto uv = hn::Mul(hn::Set(tag, static_cast<double>(i)), twist_before);
        uv = hn::MulAdd(hn::Set(tag, static_cast<double>(n - i)), twist, uv);
        second_before_that = second_before;
        second_before = second;
        twist_before = twist;
        step = step_after;
        const auto a = hn::Sub(uu, error_uu);
        const auto b = hn::Add(hn::Abs(uv), error_uv);
        fine = hn::And(fine, hn::And(hn::Gt(a, zero), hn::Gt(hn::Mul(a, c), hn::Mul(b, b))));
      }
      if (!hn::AllTrue(tag, hn::Or(fine, unused)))
      {
        return false;
      }
    }
  }
  return true;
}

/// Cuts a cell in the middle (de Casteljau 1959): its coefficients become those of the lower half.
/// \return the smallest coefficient of either half
inline Pair halve(const PieceShape& shape, double* f, int direction, double* upper)
{
  const hn::CappedTag<double, kMostLanes> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const int stride = shape.stride;
  auto least = hn::Set(tag, kInfinity);
  auto least_of_upper = least;
  if (direction == 0)
  {
    const auto half = hn::Set(tag, 0.5);
    const int last = shape.rows - 1;
    for (int j = 0; j < stride; j += lanes)
    {
      auto row = [&](double* of, int i) { return of + i * stride + j; };
      least = hn::Min(least, hn::LoadU(tag, row(f, 0)));
      for (int i = 0; i < last; ++i)
      {
        hn::StoreU(hn::Mul(half, hn::Add(hn::LoadU(tag, row(f, i)), hn::LoadU(tag, row(f, i + 1)))),
          tag, row(upper, i));
      }
      const auto end = hn::LoadU(tag, row(f, last));
      hn::StoreU(end, tag, row(upper, last));
      least_of_upper = hn::Min(least_of_upper, end);
      for (int level = 1; level <= last; ++level)
      {
        const auto first = hn::LoadU(tag, row(upper, 0));
        hn::StoreU(first, tag, row(f, level));
        least = hn::Min(least, first);
        auto here = first;
        for (int i = 0; i < last - level; ++i)
        {
          const auto next = hn::LoadU(tag, row(upper, i + 1));
          hn::StoreU(hn::Mul(half, hn::Add(here, next)), tag, row(upper, i));
          here = next;
        }
        least_of_upper = hn::Min(least_of_upper, here);
      }
    }
  }
  else
  {
    const double* lower_weights = shape.halving[1][0].data();
    const double* upper_weights = shape.halving[1][1].data();
    double whole[kMostNumbers];
    for (int i = 0; i < shape.rows; ++i)
    {
      std::copy(f + i * stride, f + (i + 1) * stride, whole);
      for (int j = 0; j < stride; j += lanes)
      {
        auto low = hn::Zero(tag);
        auto high = low;
        for (int k = 0; k < shape.columns; ++k)
        {
          const auto value = hn::Set(tag, whole[k]);
          low = hn::MulAdd(value, hn::LoadU(tag, lower_weights + k * stride + j), low);
          high = hn::MulAdd(value, hn::LoadU(tag, upper_weights + k * stride + j), high);
        }
        hn::StoreU(low, tag, f + i * stride + j);
        hn::StoreU(high, tag, upper + i * stride + j);
        least = hn::Min(least, low);
        least_of_upper = hn::Min(least_of_upper, high);
      }
    }
  }
  return { { hn::GetLane(hn::MinOfLanes(tag, least)),
    hn::GetLane(hn::MinOfLanes(tag, least_of_upper)) } };
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
