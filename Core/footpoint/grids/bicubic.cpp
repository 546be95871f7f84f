// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/bicubic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{

namespace
{

/// Derivative at the first (last) of evenly spaced samples over [0, 1], from up to four of them:
/// exact for cubics where there are as many.
Vector3 end_derivative(const Points& samples, bool last)
{
  static const std::array<std::array<double, 4>, 4> weights{ { { { 0.0, 0.0, 0.0, 0.0 } },
    { { -1.0, 1.0, 0.0, 0.0 } }, { { -1.5, 2.0, -0.5, 0.0 } },
    { { -11.0 / 6.0, 3.0, -1.5, 1.0 / 3.0 } } } };
  const Eigen::Index used = std::min<Eigen::Index>(samples.cols(), 4);
  const auto at = [&](Eigen::Index k) { return last ? samples.cols() - 1 - k : k; };
  const Vector3 origin = samples.col(at(0));
  Vector3 sum = Vector3::Zero(); // of differences, so that far from the origin nothing is lost
  for (Eigen::Index k = 1; k < used; ++k)
  {
    sum += weights[used - 1][k] * (samples.col(at(k)) - origin);
  }
  return (last ? -1.0 : 1.0) * static_cast<double>(samples.cols() - 1) * sum;
}

/// The tangents of the bilinear patch across a side: what the two sides that start on it do, less
/// what the corners do already.
/// \param near, far the side and the facing one; first, second those that lead from near to far
/// \param at_far    the tangents are taken at the far side
Points bilinear_tangents(
  const Points& near, const Points& far, const Points& first, const Points& second, bool at_far)
{
  const Eigen::Index count = near.cols();
  const Vector3 start =
    end_derivative(first, at_far) - (first.col(first.cols() - 1) - first.col(0));
  const Vector3 end =
    end_derivative(second, at_far) - (second.col(second.cols() - 1) - second.col(0));
  Points tangents(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const double s = static_cast<double>(i) / static_cast<double>(count - 1);
    tangents.col(i) = (far.col(i) - near.col(i)) + start + s * (end - start);
  }
  return tangents;
}

/// Hermite's cubics: value at 0, value at 1, slope at 0, slope at 1.
Eigen::Vector4d hermite(double t)
{
  const double square = t * t;
  const double cube = square * t;
  return { 1.0 - 3.0 * square + 2.0 * cube, 3.0 * square - 2.0 * cube, t - 2.0 * square + cube,
    cube - square };
}

/// J. A. Gregory's twist: the one of left or right where t is on the side, the one of bottom or top
/// where s is.
/// \param s, t distances from the corner
Vector3 blended_twist(const std::array<Vector3, 2>& twists, double s, double t)
{
  if (twists[0] == twists[1] || !(s + t > 0.0))
  {
    return twists[0];
  }
  return (t * twists[0] + s * twists[1]) / (s + t);
}

} // namespace

BicubicBoundary complete_ribbons(const std::array<Points, 4>& sides, const Ribbons* ribbons)
{
  BicubicBoundary boundary;
  boundary.sides = sides;

  // === Tangents
  for (int role = 0; role < 4; ++role)
  {
    if (ribbons != nullptr && ribbons->tangents[role].cols() > 0)
    {
      if (ribbons->tangents[role].cols() != sides[role].cols())
      {
        throw BoundaryError(BoundaryDefect::Count,
          "the side with role " + std::to_string(role) + " has " +
            std::to_string(ribbons->tangents[role].cols()) + " tangents; the grid has " +
            std::to_string(sides[role].cols()) + " points there");
      }
      boundary.tangents[role] = ribbons->tangents[role];
      continue;
    }
    const bool along_u = role == kBottom || role == kTop;
    boundary.tangents[role] = along_u
      ? bilinear_tangents(sides[kBottom], sides[kTop], sides[kLeft], sides[kRight], role == kTop)
      : bilinear_tangents(sides[kLeft], sides[kRight], sides[kBottom], sides[kTop], role == kRight);
  }

  // === Twists that they imply
  double size = 0.0;
  for (const Points& side : sides)
  {
    const Points relative = side.colwise() - sides[kBottom].col(0);
    size = std::max(size, relative.colwise().norm().maxCoeff());
  }
  const std::array<std::array<Role, 2>, 4> meeting{ { { { kBottom, kLeft } },
    { { kBottom, kRight } }, { { kTop, kRight } }, { { kTop, kLeft } } } };
  const std::array<std::array<bool, 2>, 4> at_last{ { { { false, false } }, { { true, false } },
    { { true, true } }, { { false, true } } } };
  for (int corner = 0; corner < 4; ++corner)
  {
    auto& twists = boundary.twists[corner];
    for (int k = 0; k < 2; ++k)
    {
      twists[k] = end_derivative(boundary.tangents[meeting[corner][k]], at_last[corner][k]);
    }
    const double larger = std::max({ twists[0].norm(), twists[1].norm(), size });
    if (larger > 0.0)
    {
      boundary.twist_incompatibility =
        std::max(boundary.twist_incompatibility, (twists[0] - twists[1]).norm() / larger);
    }
    if (ribbons != nullptr && ribbons->given_twists)
    {
      twists = { { ribbons->twists[corner], ribbons->twists[corner] } };
    }
  }
  return boundary;
}

Vector3 bicubic_point(const BicubicBoundary& b, Eigen::Index i, Eigen::Index j, double s, double t)
{
  const Eigen::Vector4d along_s = hermite(s);
  const Eigen::Vector4d along_t = hermite(t);
  const Eigen::Index last_u = b.sides[kBottom].cols() - 1;
  const Eigen::Index last_v = b.sides[kLeft].cols() - 1;
  const Vector3 origin = b.sides[kBottom].col(0);

  // === From bottom to top, and from left to right
  const Vector3 rising = along_t[0] * (b.sides[kBottom].col(i) - origin) +
    along_t[1] * (b.sides[kTop].col(i) - origin) + along_t[2] * b.tangents[kBottom].col(i) +
    along_t[3] * b.tangents[kTop].col(i);
  const Vector3 across = along_s[0] * (b.sides[kLeft].col(j) - origin) +
    along_s[1] * (b.sides[kRight].col(j) - origin) + along_s[2] * b.tangents[kLeft].col(j) +
    along_s[3] * b.tangents[kRight].col(j);

  // === What both hold: positions, tangents and twists of the corners
  Vector3 common = Vector3::Zero();
  for (int v = 0; v < 2; ++v)
  {
    const Points& side = b.sides[v == 0 ? kBottom : kTop];
    const Points& upwards = b.tangents[v == 0 ? kBottom : kTop];
    for (int u = 0; u < 2; ++u)
    {
      const Eigen::Index column = u == 0 ? 0 : last_u;
      const Points& rightwards = b.tangents[u == 0 ? kLeft : kRight];
      const int corner = v == 0 ? u : 3 - u;
      const Vector3 twist =
        blended_twist(b.twists[corner], u == 0 ? s : 1.0 - s, v == 0 ? t : 1.0 - t);
      common += along_s[u] * along_t[v] * (side.col(column) - origin) +
        along_s[2 + u] * along_t[v] * rightwards.col(v == 0 ? 0 : last_v) +
        along_s[u] * along_t[2 + v] * upwards.col(column) + along_s[2 + u] * along_t[2 + v] * twist;
    }
  }
  return origin + ((rising + across) - common);
}

} // namespace footpoint
