// SPDX-License-Identifier: BSD-3-Clause

// Random geometry and random queries against the judge's brute force. FOOTPOINT_FUZZ_QUERIES sets
// how many queries, FOOTPOINT_FUZZ_SEED another start; a failure names the seed of its geometry.

#include "Inversion.h"

#include <cstdlib>
#include <iostream>
#include <set>

using namespace inversion;
using footpoint::Curve;
using footpoint::Sides;
using footpoint::Surface;

namespace
{

#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
constexpr int kQueries = 60;
#else
constexpr int kQueries = 800;
#endif
constexpr int kQueriesPerGeometry = 8;

std::uint64_t number_from(const char* variable, std::uint64_t otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// === Geometry

/// Index in the net of a pole by its index along direction i and the other one.
template <int N>
Eigen::Index pole(int i, Eigen::Index along, Eigen::Index across, Eigen::Index count_u)
{
  return N == 1 || i == 0 ? across * count_u + along : along * count_u + across;
}

template <int N>
std::array<Eigen::Index, 2> counts(const shapes::Arrays<N>& arrays)
{
  std::array<Eigen::Index, 2> result{ { 1, 1 } };
  for (int i = 0; i < N; ++i)
  {
    result[i] = static_cast<Eigen::Index>(arrays.knots[i].size()) - arrays.degrees[i] - 1;
  }
  return result;
}

/// Makes the ends of a clamped direction the same, or one of them (surfaces) a point.
template <int N>
void close_or_collapse(shapes::Random& random, shapes::Arrays<N>& arrays, int i)
{
  const std::array<Eigen::Index, 2> count = counts<N>(arrays);
  const bool collapse = N == 2 && random.integer(0, 1) == 0;
  for (Eigen::Index k = 0; k < count[1 - i]; ++k)
  {
    const Eigen::Index first = pole<N>(i, 0, k, count[0]);
    const Eigen::Index target = collapse ? pole<N>(i, 0, 0, count[0]) : first;
    const Eigen::Index changed = collapse ? first : pole<N>(i, count[i] - 1, k, count[0]);
    arrays.points.col(changed) = arrays.points.col(target);
    if (arrays.weights.size() > 0 && !collapse)
    {
      arrays.weights[changed] = arrays.weights[target];
    }
  }
}

template <int N>
shapes::Arrays<N> random_geometry(shapes::Random& random)
{
  std::array<int, N> degrees;
  for (int& degree : degrees)
  {
    degree = random.integer(1, random.integer(0, 3) == 0 ? 9 : 4);
  }
  const bool clamped = random.integer(0, 3) != 0;
  const double decades = random.integer(0, 1) == 0 ? 0.0 : random.uniform(0.1, 3.0);
  const int spans = random.integer(1, N == 1 ? 6 : 3);
  shapes::Arrays<N> arrays = shapes::random_arrays<N>(random, degrees, spans, clamped, decades);
  if (random.integer(0, 1) == 0)
  {
    // Not wild but like something that was designed: a net near a plane.
    const std::array<Eigen::Index, 2> count = counts<N>(arrays);
    for (Eigen::Index k = 0; k < arrays.points.cols(); ++k)
    {
      const Vector3 at((k % count[0]) / double(count[0]), (k / count[0]) / double(count[1]), 0.0);
      arrays.points.col(k) = at + 0.2 * arrays.points.col(k);
    }
  }
  if (clamped && random.integer(0, 2) == 0)
  {
    close_or_collapse<N>(random, arrays, random.integer(0, N - 1));
  }
  if (random.integer(0, 4) == 0)
  {
    arrays.points.colwise() += 1e6 * random.vector(-1, 1);
  }
  return arrays;
}

// === Queries

/// A parameter anywhere, on a knot, or on an end.
template <int N>
Parameter<N> random_parameter(
  shapes::Random& random, const footpoint::ParametricGeometry<N>& geometry, bool on_knots)
{
  Parameter<N> t;
  for (int i = 0; i < N; ++i)
  {
    const std::vector<double>& spans = geometry.direction(i).spans;
    const int last = static_cast<int>(spans.size()) - 1;
    const bool on_knot = on_knots && random.integer(0, 1) == 0;
    t(i) = on_knot ? spans[random.integer(0, last)] : random.uniform(0, spans.back());
  }
  return t;
}

/// A unit vector across the geometry, and the radius of curvature along the first direction there.
template <int N>
std::pair<Vector3, double> across(
  shapes::Random& random, const footpoint::ParametricGeometry<N>& geometry, const Parameter<N>& t)
{
  const footpoint::Jet<N> jet = geometry.jet(t, Sides<N>::Constant(footpoint::Side::Right), 2);
  const Vector3 first = jet.first.col(0);
  const Vector3 other = N == 2 ? Vector3(jet.first.col(N - 1)) : random.vector(-1, 1);
  const Vector3 normal = first.cross(other).stableNormalized();
  const double bend = jet.second.col(0).dot(normal) / std::max(first.squaredNorm(), 1e-30);
  const double radius = std::abs(bend) > 0.0 ? 1.0 / bend : 0.0;
  return { normal, std::abs(radius) < 10.0 * geometry.size() ? radius : 0.0 };
}

template <int N>
Vector3 random_query(
  shapes::Random& random, const footpoint::ParametricGeometry<N>& geometry, std::string& kind)
{
  static const std::vector<std::string> kinds{ "on", "on a knot", "near", "off", "far",
    "centre of curvature", "a little off", "very far" };
  const int choice = random.integer(0, static_cast<int>(kinds.size()) - 1);
  kind = kinds[choice];
  const Parameter<N> t =
    random_parameter<N>(random, geometry, choice == 1 || random.integer(0, 3) == 0);
  const Vector3 point = geometry.centre() + geometry.point(t);
  const double size = geometry.size();
  const auto [normal, radius] = across<N>(random, geometry, t);
  const Vector3 direction = random.integer(0, 1) == 0 ? normal : Vector3(random.vector(-1, 1));
  const std::array<double, 8> distances{ { 0.0, 0.0, 1e-3 * size, 0.1 * size, 3.0 * size, radius,
    size * std::pow(10.0, random.uniform(-13, -6)), 1e6 * size } };
  return point + distances[choice] * (choice == 5 ? normal : direction);
}

// === Verdict

struct Tally
{
  int queries = 0;
  int not_converged = 0;
  int too_far = 0;
  double excess = -1.0; ///< largest of (ours − judge's) / allowed
  double error = -1.0;  ///< largest of |distance − judge's evaluation at our parameter| / allowed
};

/// Distance of the judge's point at our parameter; on a gap the side that fits better.
template <int N>
oracle::Real evaluated_distance(
  const oracle::Spline<N>& spline, const Foot& foot, const oracle::Vector& query)
{
  oracle::Real best = std::numeric_limits<oracle::Real>::infinity();
  for (int sides = 0; sides < (1 << N); ++sides)
  {
    std::array<oracle::Real, N> t;
    std::array<bool, N> left;
    for (int i = 0; i < N; ++i)
    {
      t[i] = foot.parameter(i);
      left[i] = (sides >> i & 1) != 0;
    }
    const oracle::Real distance = (spline.point(t, left) - query).norm();
    best = std::abs(distance - foot.distance) < std::abs(best - foot.distance) ? distance : best;
  }
  return best;
}

template <int N>
void fuzz_geometry(std::uint64_t seed, Tally& tally)
{
  shapes::Random random(seed);
  const shapes::Arrays<N> arrays = random_geometry<N>(random);
  const auto geometry = arrays.geometry();
  const PointInverter inverter(model_of(geometry));
  // In coordinates relative to the centre: that subtraction is exact, evaluation far off is not.
  const oracle::Spline<N> spline = shapes::local_spline_of(geometry);
  const oracle::Nearest<N> nearest(spline);
  const double size = inverter.size();
  for (int k = 0; k < kQueriesPerGeometry; ++k)
  {
    std::string kind;
    const Vector3 query = random_query<N>(random, geometry, kind);
    const oracle::Vector local =
      query.cast<oracle::Real>() - geometry.centre().template cast<oracle::Real>();
    const Foot foot = inverter.find(query);
    const double judge = static_cast<double>(nearest(local).distance);
    ++tally.queries;
    tally.not_converged += foot.status == Status::NotConverged;
    SCOPED_TRACE(
      ::testing::Message() << N << "-D, seed " << seed << ", query " << k << " (" << kind << ")");
    EXPECT_LE(foot.status, Status::NotConverged);
    // Distances that differ by sixteen roundings tie.
    const double allowed = 1e-12 * size + 4e-15 * judge;
    tally.excess = std::max(tally.excess, (foot.distance - judge) / allowed);
    tally.too_far += foot.distance > judge + allowed;
    EXPECT_LE(foot.distance, judge + allowed)
      << "by " << foot.distance - judge << ", size " << size;
    // Shorter than the judge's is right if the point is where we say; parameters far from 0 are
    // rounded.
    double rounding = 0.0;
    for (int i = 0; i < N; ++i)
    {
      const footpoint::Direction& direction = geometry.direction(i);
      rounding += 1e-16 * std::abs(foot.parameter(i)) / direction.length;
    }
    const double error =
      std::abs(foot.distance - static_cast<double>(evaluated_distance<N>(spline, foot, local)));
    const double allowed_error = allowed + 100.0 * rounding * size;
    tally.error = std::max(tally.error, error / allowed_error);
    EXPECT_LE(error, allowed_error);
    // The point in model coordinates has the rounding of those.
    EXPECT_NEAR((foot.point - query).norm(), foot.distance, allowed + 1e-15 * query.norm());
    if (foot.status == Status::NotConverged)
    {
      std::cout << "not converged: " << N << "-D, seed " << seed << ", query " << k << " (" << kind
                << ")\n";
    }
  }
}

template <int N>
void fuzz(std::uint64_t offset)
{
  const std::uint64_t queries = number_from("FOOTPOINT_FUZZ_QUERIES", kQueries);
  const std::uint64_t first = number_from("FOOTPOINT_FUZZ_SEED", 1) * 1000000 + offset;
  Tally tally;
  for (std::uint64_t k = 0; k < queries / kQueriesPerGeometry + 1; ++k)
  {
    fuzz_geometry<N>(first + k, tally);
  }
  std::cout << tally.queries << " queries, " << tally.too_far << " too far, " << tally.not_converged
            << " not converged, largest excess " << tally.excess << " and error " << tally.error
            << " of what is allowed\n";
  // Steep weights may leave a foot whose residual is above its floor; that must stay rare.
  EXPECT_LE(tally.not_converged, tally.queries / 100);
}

} // namespace

TEST(OracleFuzz, Curves)
{
  fuzz<1>(0);
}

TEST(OracleFuzz, Surfaces)
{
  fuzz<2>(500000);
}
