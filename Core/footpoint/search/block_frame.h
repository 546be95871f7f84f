// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/piece_derivatives.h"

#include <cmath>

namespace footpoint
{

/// What bounds of derivatives say about ways in the parameters of a block.
struct WaySpeed
{
  double speed; ///< lower bound of the length in space of a way of length 1, along that way
  double bend;  ///< and upper bound of the second derivative along it
};

/// The parameters of a block: mean derivatives are orthonormal in them.
struct BlockFrame
{
  /// Where the mean derivatives are more parallel than this sine there is no frame.
  static constexpr double kLeastSine = 1e-3;
  /// Nor where their lengths leave this range: products of four are far from the ends of double
  /// precision.
  static constexpr double kShortest = 0x1p-100;
  static constexpr double kLongest = 0x1p100;

  /// An orthonormal basis of the plane of the mean derivatives; curves: the second one alone. For
  /// each coordinate two times its value, then two times its magnitude, as PieceDerivatives::box is
  /// laid out.
  Eigen::Array4d axes[2][3];
  double rows[2][2]; ///< the inverse of (mean_u, mean_v) in that basis: Δt_i = rows[i] · Δ
  double inverse[2]; ///< lengths of these rows
  double cosine;     ///< of the angle between them, by magnitude
  bool curve;
  bool valid = false;

  /// \param mean of the derivatives, in the middles of the intervals
  BlockFrame(const PieceDerivatives::Box& mean, bool is_curve)
    : rows{ { 0.0, 0.0 }, { 0.0, 0.0 } }
    , inverse{ 0.0, 0.0 }
    , cosine(0.0)
    , curve(is_curve)
  {
    const Vector3 u(mean[0](0), mean[1](0), mean[2](0));
    const Vector3 v(mean[0](1), mean[1](1), mean[2](1));
    const double along_v = v.norm();
    if (!(along_v >= kShortest && along_v <= kLongest))
    {
      return;
    }
    this->rows[1][1] = this->inverse[1] = 1.0 / along_v;
    const Vector3 one = v * this->rows[1][1];
    Vector3 two = Vector3::Zero();
    if (!is_curve)
    {
      const double along_u = u.norm();
      const double shear = u.dot(one);
      const Vector3 across = u - shear * one;
      const double height = across.norm();
      if (!(height > kLeastSine * along_u && height >= kShortest && along_u <= kLongest))
      {
        return;
      }
      // (u, v) = axes · (height, 0; shear, along_v)
      this->rows[0][0] = this->inverse[0] = 1.0 / height;
      this->rows[1][0] = -shear * this->rows[0][0] * this->rows[1][1];
      this->inverse[1] = along_u * this->rows[0][0] * this->rows[1][1];
      two = across * this->rows[0][0];
      this->cosine = std::abs(shear) / along_u;
    }
    for (int k = 0; k < 3; ++k)
    {
      this->axes[0][k] << two(k), two(k), std::abs(two(k)), std::abs(two(k));
      this->axes[1][k] << one(k), one(k), std::abs(one(k)), std::abs(one(k));
    }
    this->valid = true;
  }

  /// The least length along itself of a way of length 1 in the parameters, where these are the
  /// derivatives.
  double least_speed(const Vector3& u, const Vector3& v) const
  {
    double part[2][2];
    for (int k = 0; k < 2; ++k)
    {
      const Vector3 axis(this->axes[k][0](0), this->axes[k][1](0), this->axes[k][2](0));
      const double along_u = axis.dot(u);
      const double along_v = axis.dot(v);
      part[k][0] = along_u * this->rows[0][0] + along_v * this->rows[1][0];
      part[k][1] = along_v * this->rows[1][1];
    }
    const double difference = part[0][0] - part[1][1];
    const double mixed = part[0][1] + part[1][0];
    return this->curve
      ? part[1][1]
      : 0.5 * (part[0][0] + part[1][1] - std::sqrt(difference * difference + mixed * mixed));
  }

  /// Bounds over a piece of the block.
  WaySpeed speed_of(const PieceDerivatives& bounds) const
  {
    // The first derivatives in the plane of the mean ones, by the block's parameters: the symmetric
    // part is what they leave of Δ along Δ.
    double middle[2][2];
    double half[2][2];
    for (int k = 0; k < 2; ++k)
    {
      // Middles of axes_k · S_u and axes_k · S_v, then half the widths.
      const Eigen::Array4d along = bounds.box[0] * this->axes[k][0] +
        bounds.box[1] * this->axes[k][1] + bounds.box[2] * this->axes[k][2];
      middle[k][0] = along(0) * this->rows[0][0] + along(1) * this->rows[1][0];
      half[k][0] = along(2) * this->rows[0][0] + along(3) * std::abs(this->rows[1][0]);
      middle[k][1] = along(1) * this->rows[1][1];
      half[k][1] = along(3) * this->rows[1][1];
    }
    const double uu = middle[0][0] - half[0][0];
    const double vv = middle[1][1] - half[1][1];
    const double uv = std::abs(middle[0][1] + middle[1][0]) + half[0][1] + half[1][0]; // twice
    const double a = bounds.second[0] * this->inverse[0] * this->inverse[0];
    const double b = bounds.second[1] * this->inverse[0] * this->inverse[1];
    const double c = bounds.second[2] * this->inverse[1] * this->inverse[1];
    // Eigenvalues of either matrix.
    const Eigen::Array2d difference(uu - vv, a - c);
    const Eigen::Array2d mixed(uv, 2.0 * b);
    const Eigen::Array2d root = (difference * difference + mixed * mixed).sqrt();
    return { this->curve ? vv : 0.5 * (uu + vv - root(0)),
      0.5 * (1.0 + this->cosine) * (a + c + root(1)) };
  }
};

} // namespace footpoint
