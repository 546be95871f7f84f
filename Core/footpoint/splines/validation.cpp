// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/validation.h"

#include <charconv>
#include <cmath>

namespace footpoint
{

std::string to_text(double number)
{
  if (std::isnan(number))
  {
    return "nan"; // never "-nan": the sign of a NaN says nothing
  }
  char text[32];
  return { text, std::to_chars(text, text + sizeof text, number).ptr };
}

void check_control_points(const Points& control_points)
{
  for (Eigen::Index i = 0; i < control_points.cols(); ++i)
  {
    for (const double coordinate :
      { control_points(0, i), control_points(1, i), control_points(2, i) })
    {
      if (!std::isfinite(coordinate))
      {
        throw GeometryError(GeometryDefect::NotFinite,
          "control point " + std::to_string(i) + " has the coordinate " + to_text(coordinate));
      }
    }
  }
}

Eigen::VectorXd check_weights(Eigen::VectorXd weights, Eigen::Index number_of_control_points)
{
  if (weights.size() == 0)
  {
    return weights;
  }
  if (weights.size() != number_of_control_points)
  {
    throw GeometryError(GeometryDefect::Count,
      "RationalWeights holds " + std::to_string(weights.size()) + " values; there are " +
        std::to_string(number_of_control_points) + " control points");
  }
  for (Eigen::Index i = 0; i < weights.size(); ++i)
  {
    if (std::isfinite(weights[i]) && weights[i] > 0.0)
    {
      continue;
    }
    const std::string entry = "RationalWeights[" + std::to_string(i) + "] = " + to_text(weights[i]);
    if (!std::isfinite(weights[i]))
    {
      throw GeometryError(GeometryDefect::NotFinite, entry + " is not finite");
    }
    throw GeometryError(GeometryDefect::Weight, entry + " is not positive");
  }
  return (weights.array() == weights[0]).all() ? Eigen::VectorXd() : weights;
}

Eigen::Matrix<double, 4, Eigen::Dynamic> homogeneous(
  const Points& control_points, const Eigen::VectorXd& weights)
{
  Eigen::Matrix<double, 4, Eigen::Dynamic> columns(4, control_points.cols());
  columns.topRows<3>() = control_points;
  columns.row(3).setOnes();
  if (weights.size() > 0)
  {
    columns *= weights.asDiagonal();
  }
  return columns;
}

Direction make_direction(const KnotVector& knots)
{
  Direction direction;
  direction.origin = knots.domain_start();
  direction.length = knots.length();
  const double last = knots.distinct_knots().back().at;
  for (const DistinctKnot& knot : knots.distinct_knots())
  {
    direction.spans.push_back(knot.at);
    direction.knots.push_back(knot.parameter);
    const bool end = knot.at == 0.0 || knot.at == last;
    if (end || knot.multiplicity >= knots.degree())
    {
      // The ends of the domain bound it; what lies beyond is no part of the geometry: no gap.
      direction.breaks.push_back({ knot.at, !end && knot.multiplicity > knots.degree() });
    }
  }
  return direction;
}

} // namespace footpoint
