// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/loop_area.h"

namespace footpoint
{
namespace
{

/// Gauss–Legendre nodes and weights on [0, 1] of order 16: exact for u·v' of polynomial arcs up to
/// degree 16.
constexpr int kNodes = 8;
constexpr double kNode[kNodes] = { 0.0950125098376374, 0.2816035507792589, 0.4580167776572274,
  0.6178762444026438, 0.7554044083550030, 0.8656312023878318, 0.9445750230732326,
  0.9894009349916499 };
constexpr double kWeight[kNodes] = { 0.1894506104550685, 0.1826034150449236, 0.1691565193950025,
  0.1495959888165767, 0.1246289712555339, 0.0951585116824928, 0.0622535239386479,
  0.0271524594117541 };

/// ∫ (b − b0) da along an arc.
double area_below(const ChainArc& arc, int a, int b, double b0)
{
  const auto& control = arc.arc.control;
  double sum = 0.0;
  Eigen::Matrix<double, 3, Eigen::Dynamic> points;
  for (int k = 0; k < 2 * kNodes; ++k)
  {
    const double t = 0.5 + (k % 2 == 0 ? 0.5 : -0.5) * kNode[k / 2];
    points = control;
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    for (Eigen::Index last = control.cols() - 1; last > 0; --last)
    {
      if (last == 1)
      {
        slope = (control.cols() - 1) * (points.col(1) - points.col(0));
      }
      for (Eigen::Index j = 0; j < last; ++j)
      {
        points.col(j) = (1.0 - t) * points.col(j) + t * points.col(j + 1);
      }
    }
    const Eigen::Vector3d point = points.col(0);
    const double da = (slope[a] - point[a] / point[2] * slope[2]) / point[2];
    sum += 0.5 * kWeight[k / 2] * (point[b] / point[2] - b0) * da;
  }
  return sum;
}

} // namespace

double area_below(const LoopChain& chain, int a, int b, double b0)
{
  double sum = 0.0;
  for (const ChainArc& arc : chain.arcs)
  {
    sum += area_below(arc, a, b, b0);
  }
  return sum;
}

} // namespace footpoint
