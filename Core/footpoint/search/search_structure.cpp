// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/search_structure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace footpoint
{
namespace
{

/// Below this fraction of the longer derivative's square, the other one tells nothing.
constexpr double kLeastGram = 1e-8;

/// Bernstein polynomials of one degree, and their derivatives, in the middle.
struct Middle
{
  std::vector<double> value;
  std::vector<double> slope;

  explicit Middle(int n)
    : value(n + 1)
    , slope(n + 1)
  {
    double binomial = std::ldexp(1.0, -n);
    for (int k = 0; k <= n; ++k)
    {
      this->value[k] = binomial;
      this->slope[k] = 2.0 * (2 * k - n) * binomial; // b'(t) = b(t) (k − n t) / (t (1 − t))
      binomial *= static_cast<double>(n - k) / (k + 1);
    }
  }
};

TangentPlane tangent_plane(const Piece& piece, const Middle& u, const Middle& v)
{
  const auto rows = static_cast<int>(u.value.size());
  const auto columns = static_cast<int>(v.value.size());
  Eigen::Vector4d s = Eigen::Vector4d::Zero();
  Eigen::Vector4d su = s;
  Eigen::Vector4d sv = s;
  const double* number = piece.net;
  for (int i = 0; i < rows; ++i)
  {
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    Eigen::Vector4d slope = row;
    for (int j = 0; j < columns; ++j, number += 4)
    {
      const Eigen::Map<const Eigen::Vector4d> control(number);
      row += v.value[j] * control;
      slope += v.slope[j] * control;
    }
    s += u.value[i] * row;
    su += u.slope[i] * row;
    sv += u.value[i] * slope;
  }
  const Vector3 point = s.head<3>() / s(3);
  const Vector3 by_u = (su.head<3>() - su(3) * point) / s(3);
  const Vector3 by_v = (sv.head<3>() - sv(3) * point) / s(3);
  // The pseudo-inverse of (S_u, S_v); each by itself where they are parallel.
  const double uu = by_u.squaredNorm();
  const double uv = by_u.dot(by_v);
  const double vv = by_v.squaredNorm();
  const double determinant = uu * vv - uv * uv;
  const double least = kLeastGram * std::max(uu, vv);
  Vector3 first = Vector3::Zero();
  Vector3 second = Vector3::Zero();
  if (determinant > kLeastGram * uu * vv)
  {
    first = (vv * by_u - uv * by_v) / determinant;
    second = (uu * by_v - uv * by_u) / determinant;
  }
  else
  {
    first = uu > least ? Vector3(by_u / uu) : first;
    second = vv > least ? Vector3(by_v / vv) : second;
  }
  TangentPlane plane;
  for (int k = 0; k < 3; ++k)
  {
    plane.point[k] = point(k);
    plane.rows[0][k] = first(k);
    plane.rows[1][k] = second(k);
  }
  return plane;
}

AlignedVector<TangentPlane> tangent_planes(
  const AlignedVector<Piece>& pieces, const Execution& execution)
{
  AlignedVector<TangentPlane> planes(pieces.size());
  for_ranges(execution, static_cast<std::int64_t>(pieces.size()), kPiecesForThreads,
    [&](std::int64_t begin, std::int64_t end)
    {
      const PieceShape* shape = nullptr;
      Middle u(0);
      Middle v(0);
      for (std::int64_t k = begin; k < end; ++k)
      {
        prefetch_net_after(pieces, k, end);
        const Piece& piece = pieces[k];
        if (piece.shape != shape)
        {
          shape = piece.shape;
          u = Middle(shape->degree[0]);
          v = Middle(shape->degree[1]);
        }
        planes[k] = tangent_plane(piece, u, v);
      }
    });
  return planes;
}

} // namespace

SearchStructure::SearchStructure(DistanceForms pieces, const Execution& execution)
  : forms(std::move(pieces))
  , tree(this->forms.boxes(), execution)
  , planes(tangent_planes(this->forms.pieces(), part_of(execution, 0.2, 0.1)))
  , neighbourhoods(find_neighbourhoods(this->forms.pieces(), part_of(execution, 0.3, 0.4)))
  , outlines(this->forms.pieces(), part_of(execution, 0.7, 0.3))
{
}

} // namespace footpoint
