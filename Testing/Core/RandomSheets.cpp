// SPDX-License-Identifier: BSD-3-Clause

#include "RandomSheets.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace shapes
{

std::vector<double> knots_of(Random& random, int degree, int spans)
{
  std::vector<double> knots(degree + 1, 0.0);
  double at = 0.0;
  for (int k = 1; k <= spans; ++k)
  {
    at += random.magnitude(random.integer(0, 3) == 0 ? 1.0 : 0.2);
    const int multiplicity = random.integer(0, 3) == 0 ? random.integer(1, degree) : 1;
    knots.insert(knots.end(), k < spans ? multiplicity : degree + 1, at);
  }
  return knots;
}

Arrays<2> random_sheet(Random& random, std::string& description)
{
  Arrays<2> arrays;
  std::array<int, 2> count{};
  for (int i = 0; i < 2; ++i)
  {
    arrays.degrees[i] = random.integer(1, 5);
    arrays.knots[i] = knots_of(random, arrays.degrees[i], random.integer(1, 6));
    count[i] = static_cast<int>(arrays.knots[i].size()) - arrays.degrees[i] - 1;
  }
  const std::vector<std::string> kinds{ "smooth", "smooth", "rough", "folded", "collapsed",
    "bowl" };
  const std::string kind = kinds[random.integer(0, static_cast<int>(kinds.size()) - 1)];
  const double shake = kind == "rough" ? 1.5 : 0.03 * random.magnitude(1.0);
  const double stretch = random.integer(0, 3) > 0 ? 1.0 : random.magnitude(2.0);
  const double shear = random.integer(0, 1) == 0 ? 0.0 : random.uniform(-2.0, 2.0);
  arrays.points.resize(3, count[0] * count[1]);
  for (int j = 0; j < count[1]; ++j)
  {
    for (int i = 0; i < count[0]; ++i)
    {
      Vector3 shaken = shake * random.vector(-1.0, 1.0);
      const double x = i + shaken[0];
      const double y = j + shaken[1];
      Vector3 point(x, y, shaken[2]);
      if (kind == "folded" && 2 * i > count[0])
      {
        point[0] = count[0] - x;
      }
      if (kind == "collapsed" && j == 0)
      {
        point = Vector3::Zero();
      }
      if (kind == "bowl")
      {
        point[2] += 0.1 * (x * x + y * y);
      }
      arrays.points.col(j * count[0] + i) =
        Vector3(stretch * (point[0] + shear * point[1]), point[1], point[2]);
    }
  }
  const double decades = random.integer(0, 1) == 0 ? 0.0 : random.magnitude(1.0) * 0.2;
  if (decades > 0.0)
  {
    arrays.weights.resize(arrays.points.cols());
    for (double& weight : arrays.weights)
    {
      weight = random.magnitude(std::min(decades, 2.0));
    }
  }
  std::ostringstream text;
  text << kind << ", degrees " << arrays.degrees[0] << " and " << arrays.degrees[1]
       << ", shaken by " << shake << ", stretched by " << stretch << ", weights of " << decades
       << " decades";
  description = text.str();
  return arrays;
}

Surface paraboloid()
{
  Points net(3, 9);
  for (int k = 0; k < 9; ++k)
  {
    const double x = 0.05 * (k % 3 - 1);
    const double y = 0.05 * (k / 3 - 1);
    // Of x²: −1, 0, 1 has the polar form of t² as control points.
    net.col(k) << x, y, 0.5 * 0.0025 * ((k % 3 == 1 ? -1.0 : 1.0) + (k / 3 == 1 ? -1.0 : 1.0));
  }
  return Surface(KnotVector(2, { 0, 0, 0, 1, 1, 1 }), KnotVector(2, { 0, 0, 0, 1, 1, 1 }), net);
}

Curve random_curve(Random& random)
{
  const int degree = random.integer(2, 5);
  const std::vector<double> knots = knots_of(random, degree, random.integer(2, 8));
  const auto count = static_cast<int>(knots.size()) - degree - 1;
  Points net(3, count);
  Eigen::VectorXd weights(count);
  const double decades = random.uniform(0.0, 1.0);
  for (int k = 0; k < count; ++k)
  {
    net.col(k) = Vector3(k, 0.0, 0.0) + 0.3 * random.vector(-1.0, 1.0);
    weights[k] = random.magnitude(decades);
  }
  return Curve(
    KnotVector(degree, knots), net, random.integer(0, 1) == 0 ? weights : Eigen::VectorXd());
}

} // namespace shapes
