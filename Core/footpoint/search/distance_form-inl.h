// SPDX-License-Identifier: BSD-3-Clause

// The distance form of a piece for a query. Compiled once for each set of vector instructions (the guard of
// Highway's "-inl.h" headers).
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

/// Adds −2 P·N, raised to the degree of F, to Q + constant: rows of the net first, along the second
/// direction, then along the first. \return the smallest coefficient
/// \tparam P, Q degrees; −1: any
template <int P, int Q>
HWY_NOINLINE double raised_form(const PieceQuery& query, double constant, double* target)
{
  const hn::CappedTag<double, 8> tag;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(tag)); // of a fixed size on every target
  constexpr int kMostRows = (P >= 0 ? P : kMaximumDegree) + 1;
  constexpr int kMostColumns = (2 * (Q >= 0 ? Q : kMaximumDegree) + 8) / 8 * 8;
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
      auto f = hn::Add(c, hn::LoadU(tag, forms + i * stride + j));
      for (int k = std::max(0, i - p); k <= std::min(p, i); ++k)
      {
        f = hn::MulAdd(hn::Set(tag, raising[k * (2 * p + 1) + i]),
          hn::Load(tag, rows + k * stride + j), f);
      }
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
double distance_form(const PieceQuery& query, double constant, double* target)
{
  const PieceShape& shape = *query.piece->shape;
  if (!shape.rational)
  {
    return with_shape(shape,
      [&](auto p, auto q, auto) { return raised_form<p(), q()>(query, constant, target); });
  }
  const hn::CappedTag<double, 8> tag;
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

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
