// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/piece_derivatives.h"

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

/// The box of first differences of control points (x, y, z, 1), and the largest second ones by
/// magnitude.
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

} // namespace

PieceDerivatives piece_derivatives(const Piece& piece, const DerivativeUnits& units)
{
  const Differences differences(piece);
  const double reach = units.length * piece.reach;
  PieceDerivatives bounds;
  double factor[2]; // of differences, for derivatives by the units' parameters
  for (int i = 0; i < 2; ++i)
  {
    const int degree = piece.shape->degree[i];
    factor[i] = degree > 0 ? degree * units.width[i] / piece.width[i] : 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double scale = factor[i] * units.length;
      const double from = scale * differences.lower[i](k);
      const double to = scale * differences.upper[i](k);
      bounds.box[k](i) = 0.5 * (from + to);
      bounds.box[k](2 + i) = 0.5 * (to - from);
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    const int i = k / 2;
    const int j = (k + 1) / 2;
    const double degree = piece.shape->degree[i];
    const double part = i == j && degree > 0.0 ? (degree - 1.0) / degree : 1.0;
    const double longest = (units.length * differences.second[k].head<3>()).matrix().norm();
    bounds.second[k] = factor[i] * factor[j] * (part * longest + kRoundingOfSecond * reach);
  }
  return bounds;
}

} // namespace footpoint
