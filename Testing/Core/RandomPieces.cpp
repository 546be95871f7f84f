// SPDX-License-Identifier: BSD-3-Clause

#include "RandomPieces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <sstream>
#include <utility>

namespace shapes
{

std::vector<double> bezier_knots(int degree)
{
  return clamped_knots(degree, 1);
}

namespace
{

Eigen::Matrix3d random_turn(Random& random)
{
  const Vector3 axis = random.vector(-1.0, 1.0);
  return Eigen::AngleAxisd(random.uniform(0.0, 6.0), axis.normalized()).toRotationMatrix();
}

/// \param degrees of a curve: the second one
/// \param decades of the size
template <int N>
Arrays<N> random_bezier(
  Random& random, const std::array<int, 2>& degrees, double decades, std::string& description)
{
  constexpr const char* kKinds[] = { "smooth", "bowl", "flat", "rough", "collapsed", "cuspidal" };
  const std::string kind = kKinds[random.integer(0, 5)];
  const double shake = kind == "flat" ? 0.0 : kind == "rough" ? 1.0 : 0.1 * random.magnitude(1.0);
  const double shear = random.integer(0, 1) == 0 ? 0.0 : random.uniform(-1.5, 1.5);
  const double stretch = random.magnitude(random.integer(0, 2) == 0 ? 1.0 : 0.2);
  const double weights = random.integer(0, 1) == 0 ? 0.0 : random.uniform(0.0, 3.0);
  const double size = random.integer(0, 2) == 0 ? random.magnitude(decades) : 1.0;
  const Eigen::Matrix3d turn = random_turn(random);
  const int nu = degrees[0] + 1;
  const int nv = degrees[1] + 1;
  Arrays<N> arrays;
  for (int i = 0; i < N; ++i)
  {
    arrays.degrees[i] = degrees[N == 1 ? 1 : i];
    arrays.knots[i] = bezier_knots(arrays.degrees[i]);
  }
  arrays.points.resize(3, nu * nv);
  arrays.weights.resize(weights > 0.0 ? nu * nv : 0);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      // A cusp has no derivative at its start.
      const double x = nu == 1 ? 0.0 : static_cast<double>(i) / (nu - 1);
      const double y = kind == "cuspidal" && j == 1 ? 0.0 : static_cast<double>(j) / (nv - 1);
      Vector3 point(stretch * (x + shear * y), y, 0.0);
      point += shake / std::max(nu, nv) * random.vector(-1.0, 1.0);
      point[2] += kind == "bowl" ? 0.3 * (x * x + y * y + shear * x * y) : 0.0;
      point = kind == "collapsed" && j == 0 ? Vector3::Zero() : point;
      const int k = j * nu + i;
      arrays.points.col(k) = size * (turn * point);
      if (weights > 0.0)
      {
        arrays.weights[k] = random.magnitude(weights);
      }
    }
  }
  std::ostringstream text;
  text << kind << ", degrees " << degrees[0] << " and " << degrees[1] << ", shaken by " << shake
       << ", sheared by " << shear << ", size " << size << ", weights of " << weights << " decades";
  description = text.str();
  return arrays;
}

} // namespace

footpoint::SearchStructure random_pieces(
  Random& random, const std::array<int, 2>& degrees, double decades, std::string& description)
{
  footpoint::DistanceForms forms(1);
  const std::array<std::array<bool, 2>, 2> none{};
  if (degrees[0] == 0)
  {
    forms.add(
      0, random_bezier<1>(random, degrees, decades, description).geometry(), Vector3::Zero(), none);
  }
  else
  {
    forms.add(
      0, random_bezier<2>(random, degrees, decades, description).geometry(), Vector3::Zero(), none);
  }
  return footpoint::SearchStructure(std::move(forms));
}

std::array<int, 2> random_degrees(Random& random)
{
  const int most = random.integer(0, 2) == 0 ? 9 : 4;
  return { { random.integer(0, 3) == 0 ? 0 : random.integer(1, most), random.integer(1, most) } };
}

footpoint::DistanceForms straight_piece(
  const std::array<int, 2>& degrees, const Vector3& corner, const Vector3& u, const Vector3& v)
{
  const auto [p, q] = degrees;
  Points net(3, (p + 1) * (q + 1));
  for (int k = 0; k < net.cols(); ++k)
  {
    const double s = p > 0 ? static_cast<double>(k % (p + 1)) / p : 0.0;
    net.col(k) = corner + s * u + static_cast<double>(k / (p + 1)) / q * v;
  }
  footpoint::DistanceForms forms(1);
  const KnotVector knots(q, bezier_knots(q));
  const std::array<std::array<bool, 2>, 2> none{};
  if (p == 0)
  {
    forms.add(0, Curve(knots, net), Vector3::Zero(), none);
  }
  else
  {
    forms.add(0, Surface(KnotVector(p, bezier_knots(p)), knots, net), Vector3::Zero(), none);
  }
  return forms;
}

std::array<double, 2> random_place(Random& random, const footpoint::Piece& piece)
{
  std::array<double, 2> t{ { 0.0, 0.0 } };
  for (int i = piece.shape->degree[0] == 0 ? 1 : 0; i < 2; ++i)
  {
    const int where = random.integer(0, 4);
    t[i] = where < 2 ? where : random.uniform(0.0, 1.0);
  }
  return t;
}

} // namespace shapes
