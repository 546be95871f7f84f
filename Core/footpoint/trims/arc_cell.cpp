// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/arc_cell.h"

#include "footpoint/splines/binomials.h"

namespace footpoint
{

ArcCell arc_cell(const Surface& surface, const TrimArc& arc)
{
  ArcCell cell;
  for (int i = 0; i < 2; ++i)
  {
    const KnotVector& knots = surface.knots(i);
    const auto coordinates = arc.control.row(i).array() / arc.control.row(2).array();
    const double middle = 0.5 * (coordinates.minCoeff() + coordinates.maxCoeff());
    cell.span[i] = knots.find_span(middle, Side::Right);
    cell.lower[i] = knots.local_knots()[cell.span[i]];
    cell.upper[i] = knots.local_knots()[cell.span[i] + 1];
  }
  return cell;
}

CellPlace place_in(const ArcCell& cell, const Parameter<2>& t)
{
  CellPlace place{ t.cwiseMax(cell.lower).cwiseMin(cell.upper), {} };
  for (int i = 0; i < 2; ++i)
  {
    place.sides[i] = place.t[i] == cell.upper[i] ? Side::Left : Side::Right;
  }
  return place;
}

void keep_inside(const ArcCell& cell, TrimArc& arc)
{
  for (Eigen::Index j = 0; j < arc.control.cols(); ++j)
  {
    const double w = arc.control(2, j);
    for (int i = 0; i < 2; ++i)
    {
      const double at = arc.control(i, j) / w;
      if (at < cell.lower[i] || at > cell.upper[i])
      {
        arc.control(i, j) = w * (at < cell.lower[i] ? cell.lower[i] : cell.upper[i]);
      }
    }
  }
}

Eigen::Matrix<double, 2, 4> arc_jet(const TrimArc& arc, double fraction, int order)
{
  // de Casteljau; the last order + 1 levels hold the derivatives as differences.
  const int degree = static_cast<int>(arc.control.cols()) - 1;
  Eigen::Matrix<double, 3, kMaximumDegree + 1> level;
  level.leftCols(degree + 1) = arc.control;
  Eigen::Vector3d sums[4];
  for (int remaining = degree; remaining >= 0; --remaining)
  {
    if (remaining <= order)
    {
      // Degree `remaining` is left: its forward difference of that order is the derivative.
      double factor = 1.0; // degree! / (degree − remaining)!
      sums[remaining].setZero();
      for (int j = 0; j <= remaining; ++j)
      {
        const double sign = (remaining - j) % 2 == 0 ? 1.0 : -1.0;
        sums[remaining] += sign * kBinomials.value[remaining][j] * level.col(j);
        factor *= j < remaining ? degree - j : 1.0;
      }
      sums[remaining] *= factor;
    }
    for (int j = 0; j < remaining; ++j)
    {
      level.col(j) = (1.0 - fraction) * level.col(j) + fraction * level.col(j + 1);
    }
  }
  for (int k = degree + 1; k <= order; ++k)
  {
    sums[k].setZero();
  }

  // Leibniz: (w·c)^(k) = Σ binomial(k, i) w^(i) c^(k−i), solved for c^(k).
  Eigen::Matrix<double, 2, 4> jet = Eigen::Matrix<double, 2, 4>::Zero();
  for (int k = 0; k <= order; ++k)
  {
    Eigen::Vector2d c = sums[k].head<2>();
    for (int i = 1; i <= k; ++i)
    {
      c -= kBinomials.value[k][i] * sums[i][2] * jet.col(k - i);
    }
    jet.col(k) = c / sums[0][2];
  }
  return jet;
}

} // namespace footpoint
