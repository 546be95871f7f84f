// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/orientation.h"

#include <cmath>

namespace footpoint
{
namespace
{

constexpr double kUnit = 0x1p-53;

/// J. R. Shewchuk (1997): what the rounding of the plain determinants can amount to.
constexpr double kOrientationError = (3.0 + 16.0 * kUnit) * kUnit;
constexpr double kCircleError = (10.0 + 96.0 * kUnit) * kUnit;

/// A sum of doubles that do not overlap, smallest first.
struct Expansion
{
  double part[12];
  int size = 0;

  void add(double x)
  {
    for (int i = 0; i < this->size; ++i)
    {
      const double sum = x + this->part[i];
      const double virtual_part = sum - x;
      this->part[i] = (x - (sum - virtual_part)) + (this->part[i] - virtual_part);
      x = sum;
    }
    this->part[this->size++] = x;
  }

  void add_product(double a, double b)
  {
    const double product = a * b;
    this->add(std::fma(a, b, -product));
    this->add(product);
  }

  int sign() const
  {
    for (int i = this->size - 1; i >= 0; --i)
    {
      if (this->part[i] != 0.0)
      {
        return this->part[i] > 0.0 ? 1 : -1;
      }
    }
    return 0;
  }
};

int exact_orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  Expansion sum;
  sum.add_product(a[0], b[1]);
  sum.add_product(-a[0], c[1]);
  sum.add_product(-c[0], b[1]);
  sum.add_product(-a[1], b[0]);
  sum.add_product(a[1], c[0]);
  sum.add_product(c[1], b[0]);
  return sum.sign();
}

} // namespace

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double area = left - right;
  if (std::abs(area) > kOrientationError * (std::abs(left) + std::abs(right)))
  {
    return area > 0.0 ? 1 : -1;
  }
  return exact_orientation(a, b, c);
}

int in_circle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
  const Eigen::Vector2d& d)
{
  const Eigen::Vector2d p = a - d;
  const Eigen::Vector2d q = b - d;
  const Eigen::Vector2d r = c - d;
  const double qr = q[0] * r[1];
  const double rq = r[0] * q[1];
  const double rp = r[0] * p[1];
  const double pr = p[0] * r[1];
  const double pq = p[0] * q[1];
  const double qp = q[0] * p[1];
  const double p2 = p.squaredNorm();
  const double q2 = q.squaredNorm();
  const double r2 = r.squaredNorm();
  const double value = p2 * (qr - rq) + q2 * (rp - pr) + r2 * (pq - qp);
  const double bound = kCircleError *
    (p2 * (std::abs(qr) + std::abs(rq)) + q2 * (std::abs(rp) + std::abs(pr)) +
      r2 * (std::abs(pq) + std::abs(qp)));
  return value > bound ? 1 : 0;
}

} // namespace footpoint
