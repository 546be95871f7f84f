// SPDX-License-Identifier: BSD-3-Clause
#include "queries.h"

#include "peer.h"

#include "footpoint/model/evaluation.h"
#include "footpoint/model/point_inversion.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace inversion_benchmark
{
namespace
{

using footpoint::Side;
using footpoint::Sides;

constexpr std::array<const char*, 8> kNames{ { "on", "near", "off", "far", "centre", "core",
  "distant", "ties" } };

Vector3 unit_vector(Random& random)
{
  Vector3 direction;
  do
  {
    direction = random.vector(-1.0, 1.0);
  } while (direction.norm() > 1.0 || direction.norm() < 0.01);
  return direction.normalized();
}

/// A random place of the geometry and a unit vector normal to it.
struct Place
{
  Parameter<2> local; ///< curves: v = 0
  Vector3 point;
  Vector3 normal;
};

Place place_at(const Shape& shape, const Parameter<2>& fraction, Random& random)
{
  Place place;
  if (shape.surface)
  {
    const footpoint::Surface& s = *shape.surface;
    place.local =
      Parameter<2>(fraction(0) * s.direction(0).length, fraction(1) * s.direction(1).length);
    place.point = s.point(place.local) + s.centre();
    place.normal = footpoint::unit_normal(s, place.local, Sides<2>::Constant(Side::Right));
  }
  else
  {
    const footpoint::Curve& c = *shape.curve;
    place.local = Parameter<2>(fraction(0) * c.direction(0).length, 0.0);
    const Parameter<1> t(place.local(0));
    place.point = c.point(t) + c.centre();
    place.normal = footpoint::unit_tangent(c, t, Sides<1>(Side::Right)).cross(unit_vector(random));
    place.normal.normalize();
  }
  if (!(place.normal.norm() > 0.5)) // a pole that has no normal
  {
    place.normal = unit_vector(random);
  }
  return place;
}

Vector3 in_box(const Points& net, double times, Random& random)
{
  const Vector3 low = net.rowwise().minCoeff();
  const Vector3 high = net.rowwise().maxCoeff();
  const Vector3 margin = Vector3::Constant(0.05 * (high - low).norm()); // for flat boxes
  const Vector3 half = 0.5 * times * (high - low) + margin;
  return 0.5 * (low + high) + random.vector(-1.0, 1.0).cwiseProduct(half);
}

/// How many ties are looked for, at most; many queries are made around each.
constexpr int kTies = 300;
constexpr int kQueriesOfTie = 100;
/// Feet farther apart than this, by the size, are two.
constexpr double kApart = 0.02;

/// Points with two feet, found by halving the way between points whose feet are far apart. Our own
/// search says where to ask, not what is right.
std::vector<Vector3> find_ties(const Shape& shape, int attempts, Random& random)
{
  const footpoint::PointInverter inverter(model_of(shape));
  const Points net = shape.control_points();
  const auto foot = [&](const Vector3& p) { return inverter.find(p).point; };
  std::vector<Vector3> ties;
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    Vector3 a = in_box(net, 1.2, random);
    Vector3 b = a + 0.2 * shape.size() * unit_vector(random);
    Vector3 foot_a = foot(a);
    Vector3 foot_b = foot(b);
    for (int halving = 0; halving < 52; ++halving)
    {
      const Vector3 middle = 0.5 * (a + b);
      const Vector3 between = foot(middle);
      const bool nearer_a = (between - foot_a).norm() < (between - foot_b).norm();
      (nearer_a ? a : b) = middle;
      (nearer_a ? foot_a : foot_b) = between;
    }
    if ((foot_a - foot_b).norm() > kApart * shape.size())
    {
      ties.push_back(a);
    }
  }
  return ties;
}

/// The bits of i and j by turns.
std::uint64_t morton(std::uint32_t i, std::uint32_t j)
{
  std::uint64_t code = 0;
  for (int bit = 0; bit < 32; ++bit)
  {
    code |= static_cast<std::uint64_t>(i >> bit & 1U) << (2 * bit);
    code |= static_cast<std::uint64_t>(j >> bit & 1U) << (2 * bit + 1);
  }
  return code;
}

} // namespace

const char* name_of(QueryClass query_class)
{
  return kNames[static_cast<std::size_t>(query_class)];
}

QueryClass class_of(const std::string& name)
{
  const auto* const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end())
  {
    throw std::invalid_argument("there is no query class '" + name + "'");
  }
  return static_cast<QueryClass>(found - kNames.begin());
}

bool has_class(const Shape& shape, QueryClass query_class)
{
  const bool central = query_class == QueryClass::Centre || query_class == QueryClass::Core;
  return !central || shape.centre;
}

Queries make_queries(const Shape& shape, QueryClass query_class, int count)
{
  Random random(1000 + static_cast<std::uint64_t>(query_class));
  const Points net = shape.control_points();
  const double size = shape.size();
  const std::vector<Vector3> ties = query_class == QueryClass::Ties
    ? find_ties(shape, std::min(kTies, 3 + count / kQueriesOfTie), random)
    : std::vector<Vector3>();
  Queries queries;
  if (query_class == QueryClass::Ties && ties.empty())
  {
    return queries;
  }
  queries.points.resize(3, count);
  queries.bounds.assign(count, std::numeric_limits<long double>::infinity());
  for (int k = 0; k < count; ++k)
  {
    auto point = queries.points.col(k);
    switch (query_class)
    {
      case QueryClass::On:
      case QueryClass::Near:
      case QueryClass::Off:
      {
        const double u = random.uniform(0.0, 1.0);
        const Place place = place_at(shape, { u, random.uniform(0.0, 1.0) }, random);
        const double offset = query_class == QueryClass::On ? 0.0
          : query_class == QueryClass::Near                 ? 1e-3 * size
                                                            : 0.1 * size;
        point = place.point + (random.integer(0, 1) == 0 ? -offset : offset) * place.normal;
        queries.bounds[k] = (point.cast<long double>() - place.point.cast<long double>()).norm();
        break;
      }
      case QueryClass::Far:
        point = in_box(net, 3.0, random);
        break;
      case QueryClass::Centre:
      case QueryClass::Core:
      {
        const double exponent = query_class == QueryClass::Core ? -9.0 : random.uniform(-9.0, -2.0);
        const Vector3 centre = shape.centre(random);
        const Vector3 direction = unit_vector(random);
        const double share = query_class == QueryClass::Core ? random.uniform(0.0, 1.0) : 1.0;
        point = centre + share * size * std::pow(10.0, exponent) * direction;
        break;
      }
      case QueryClass::Distant:
        point = in_box(net, 1.0, random) + 1e6 * size * unit_vector(random);
        break;
      case QueryClass::Ties:
      {
        const double distance = size * std::pow(10.0, random.uniform(-16.0, -6.0));
        point = ties[random.integer(0, static_cast<int>(ties.size()) - 1)] +
          distance * unit_vector(random);
        break;
      }
    }
  }
  return queries;
}

Points ordered_queries(const Shape& shape, double distance, int count)
{
  Random random(2000);
  const int side = 1 << 12;
  std::vector<std::array<double, 2>> fractions(count);
  std::vector<std::uint64_t> codes(count);
  for (int k = 0; k < count; ++k)
  {
    fractions[k] = { random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) };
    codes[k] = morton(static_cast<std::uint32_t>(fractions[k][0] * side),
      static_cast<std::uint32_t>(fractions[k][1] * side));
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return codes[a] < codes[b]; });
  Points points(3, count);
  for (int k = 0; k < count; ++k)
  {
    const auto& fraction = fractions[order[k]];
    const Place place = place_at(shape, { fraction[0], fraction[1] }, random);
    points.col(k) = place.point + (random.integer(0, 1) == 0 ? -distance : distance) * place.normal;
  }
  return points;
}

} // namespace inversion_benchmark
