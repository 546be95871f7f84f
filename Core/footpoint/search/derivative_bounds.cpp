// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/derivative_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{
namespace
{

using Vector4 = Eigen::Array4d;
using Map4 = Eigen::Map<const Vector4, Eigen::Aligned16>;

/// Second differences of control points are off by a few roundings of the piece's reach.
constexpr double kRoundingOfSecond = 0x1p-48;

/// The box of first differences of control points (w·x, w·y, w·z, w), and the largest second ones
/// by magnitude.
struct Differences
{
  Vector4 lower[2];
  Vector4 upper[2];
  Vector4 second[3]; ///< uu, uv, vv

  explicit Differences(const Piece& piece)
  {
    const int p = piece.shape->degree[0];
    const int q = piece.shape->degree[1];
    const int row = 4 * (q + 1);
    this->along_u(piece.net, p, q, row);
    this->along_v(piece.net, p, q, row);
    Vector4 greatest = Vector4::Zero();
    for (int i = 2; i <= p; ++i)
    {
      for (const double* at = piece.net + i * row; at < piece.net + (i + 1) * row; at += 4)
      {
        const Vector4 middle = Map4(at - row);
        greatest = greatest.max(((Map4(at) - middle) - (middle - Map4(at - 2 * row))).abs());
      }
    }
    this->second[0] = greatest;
  }

private:
  void along_u(const double* net, int p, int q, int row)
  {
    Vector4 least = Vector4::Constant(p > 0 ? std::numeric_limits<double>::infinity() : 0.0);
    Vector4 most = -least;
    Vector4 twist = Vector4::Zero();
    for (int i = 0; i < p; ++i)
    {
      const double* at = net + i * row;
      Vector4 before = Map4(at + row) - Map4(at);
      least = least.min(before);
      most = most.max(before);
      for (int j = 1; j <= q; ++j)
      {
        at += 4;
        const Vector4 step = Map4(at + row) - Map4(at);
        least = least.min(step);
        most = most.max(step);
        twist = twist.max((step - before).abs());
        before = step;
      }
    }
    this->lower[0] = least;
    this->upper[0] = most;
    this->second[1] = twist;
  }

  void along_v(const double* net, int p, int q, int row)
  {
    Vector4 least = Vector4::Constant(std::numeric_limits<double>::infinity());
    Vector4 most = -least;
    Vector4 bend = Vector4::Zero();
    for (int i = 0; i <= p; ++i)
    {
      const double* at = net + i * row;
      Vector4 here = Map4(at + 4);
      Vector4 before = here - Map4(at);
      least = least.min(before);
      most = most.max(before);
      at += 4;
      for (int j = 2; j <= q; ++j)
      {
        at += 4;
        const Vector4 next = Map4(at);
        const Vector4 step = next - here;
        least = least.min(step);
        most = most.max(step);
        bend = bend.max((step - before).abs());
        here = next;
        before = step;
      }
    }
    this->lower[1] = least;
    this->upper[1] = most;
    this->second[2] = bend;
  }
};

/// The interval of a number divided by one in [least, greatest] > 0.
struct Quotient
{
  double over_least;    ///< 1 / least
  double over_greatest; ///< 1 / greatest

  double lower(double number) const
  {
    return number * (number > 0.0 ? this->over_greatest : this->over_least);
  }
  double upper(double number) const
  {
    return number * (number > 0.0 ? this->over_least : this->over_greatest);
  }
};

} // namespace

DerivativeBounds derivative_bounds(const Piece& piece, const DerivativeUnits& units)
{
  const Differences differences(piece);
  const bool rational = piece.shape->rational;
  // The coefficients of w² bound it (convex-hull property), so their roots bound w.
  const Quotient by_weight{ rational ? 1.0 / std::sqrt(piece.least_weight) : 1.0,
    rational ? 1.0 / std::sqrt(piece.greatest_weight) : 1.0 };
  const double reach = units.length * piece.reach;
  DerivativeBounds bounds;
  double factor[2]; // of differences, for derivatives by the units' parameters
  double length[2]; // of S_i and of w_i
  double weight[2];
  for (int i = 0; i < 2; ++i)
  {
    const int degree = piece.shape->degree[i];
    factor[i] = degree > 0 ? degree * units.width[i] / piece.width[i] : 0.0;
    // w S_i = N_i − w_i (S − origin)
    weight[i] =
      rational ? factor[i] * std::max(-differences.lower[i](3), differences.upper[i](3)) : 0.0;
    const double turn = weight[i] * reach;
    double squared = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double scale = factor[i] * units.length;
      const double from = by_weight.lower(scale * differences.lower[i](k) - turn);
      const double to = by_weight.upper(scale * differences.upper[i](k) + turn);
      bounds.box[k](i) = 0.5 * (from + to);
      bounds.box[k](2 + i) = 0.5 * (to - from);
      const double greatest = std::max(-from, to);
      squared += greatest * greatest;
    }
    length[i] = rational ? std::sqrt(squared) : 0.0;
  }
  // w S_ij = N_ij − w_i S_j − w_j S_i − w_ij (S − origin)
  for (int k = 0; k < 3; ++k)
  {
    const int i = k / 2;
    const int j = (k + 1) / 2;
    const double degree = piece.shape->degree[i];
    const double part = i == j && degree > 0.0 ? (degree - 1.0) / degree : 1.0;
    const Vector4& second = differences.second[k];
    const double longest = (units.length * second.head<3>()).matrix().norm();
    bounds.second[k] = by_weight.over_least *
      (factor[i] * factor[j] * (part * (longest + second(3) * reach) + kRoundingOfSecond * reach) +
        weight[i] * length[j] + weight[j] * length[i]);
  }
  return bounds;
}

} // namespace footpoint
