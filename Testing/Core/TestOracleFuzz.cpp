// SPDX-License-Identifier: BSD-3-Clause

// Random geometry and random queries against the judge's brute force. A failure names the seed of
// its geometry. Set in the environment
//   FOOTPOINT_FUZZ_QUERIES   how many queries each test makes
//   FOOTPOINT_FUZZ_SEED      other geometry: any number, 1 by default
//   FOOTPOINT_FUZZ_GEOMETRY  only the geometry of this seed, from a failure's message

#include "FormerFailures.h"
#include "FuzzGeometry.h"
#include "Inversion.h"
#include "Oracle.h"
#include "SlowBuild.h"

#include <cstdlib>
#include <ctime>
#include <functional>
#include <iomanip>
#include <iostream>
#include <thread>

using namespace inversion;
using fuzz::Judge;
using fuzz::Query;
using oracle::Real;
using oracle::Vector;

namespace
{

/// 8 shards of 12,500 and 3 of 10,000 around centres and ties.
constexpr int kShards = 8;
constexpr std::uint64_t kQueries = kSlowBuild ? 120 : 12500;
constexpr int kTieShards = 3;
constexpr std::uint64_t kTieQueries = kSlowBuild ? 60 : 10000;
constexpr std::uint64_t kQueriesPerGeometry = kSlowBuild ? 6 : 100;

/// A known shortfall: bilinear strips and collapsed sides with weights that alternate by 10⁶ leave
/// pieces so steep that descents stall and the work runs out before there is a proof; the search
/// says so, and of those queries a few feet are not the nearest. Usual are 0.2 % unproved (one
/// geometry of a shard may hold most of them), and of 760,000 queries eleven too far by at most
/// 2e-8. At most this part of the queries may be unproved, this part of them all too far, and by no
/// more than this part of the size. What is certified is never wrong.
constexpr double kUncertified = 0.01;
constexpr double kUncertifiedTooFar = 0.001;
constexpr double kUncertifiedExcess = 1e-7;

/// Feet this much of the size farther than the nearest point are wrong.
constexpr double kWrong = 1e-12;
/// Rounding of a distance d in double, u = 2^−53: P − centre and S − (P − centre) move r by u·d
/// each, the norm costs 3u (three squares, two sums, a root), together 5u; of two feet compared
/// either may be off. Ten u, for queries so far away that this is more than kWrong.
constexpr double kRounding = 10.0 * 0x1p-53;
/// Processor time of one query that counts as hanging (s); the usual is below a millisecond.
constexpr double kHanging = kSlowBuild ? 60.0 : 4.0;
/// Wrong feet that a test prints in full; of the others a line.
constexpr int kPrinted = 25;

std::uint64_t number_from(const char* variable, std::uint64_t otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// === Verdict

struct Tally
{
  std::uint64_t queries = 0;
  std::uint64_t too_far = 0;
  std::uint64_t unproved_too_far = 0;
  std::uint64_t misplaced = 0;
  std::uint64_t wrongly_certified = 0;
  std::uint64_t certified = 0;
  std::uint64_t not_converged = 0;
  std::uint64_t hanging = 0;
  std::uint64_t oracle_beaten = 0; ///< our foot is nearer, which is right if it is where we say
  double excess = -1.0;            ///< largest of (ours − judge's) / allowed
  double error = 0.0;              ///< largest distance of our point from the judge's / allowed
  double seconds = 0.0;
  double slowest = 0.0;
  std::string slowest_query;
  int printed = 0;
};

template <int N>
struct Subject
{
  Subject(const shapes::Arrays<N>& arrays, const std::string& what)
    : judge(arrays)
    , inverter(model_of(arrays.geometry()))
    , description(what)
  {
  }

  Judge<N> judge;
  PointInverter inverter;
  std::string description;
};

/// How far one rounding of its parameters moves a point: by one unit in the last place of the
/// domain's ends, inwards, since there is nothing beyond a span.
template <int N>
Real parameter_rounding(const oracle::Spline<N>& spline,
  const typename oracle::Spline<N>::Spans& spans, const typename oracle::Spline<N>::Parameters& t)
{
  const Vector at = spline.evaluate(spans, t);
  Real rounding = 0.0L;
  for (int i = 0; i < N; ++i)
  {
    const Real first = std::abs(spline.knot(i, spline.degree(i)));
    const Real unit = 0x1p-52L * std::max(first, std::abs(spline.knot(i, spline.count(i))));
    const Real middle = (spline.knot(i, spans[i]) + spline.knot(i, spans[i] + 1)) / 2.0L;
    auto beside = t;
    beside[i] += t[i] < middle ? unit : -unit;
    rounding += (spline.evaluate(spans, beside) - at).norm();
  }
  return rounding;
}

/// How far the foot's point is from the judge's point at the foot's parameters (on a gap from the
/// nearest limit), less what the rounding of those parameters moves it.
template <int N>
double misplacement(const Judge<N>& judge, const Foot& foot)
{
  const oracle::Spline<N>& spline = judge.nearest.spline();
  typename oracle::Spline<N>::Parameters t;
  for (int i = 0; i < N; ++i)
  {
    t[i] = foot.parameter(i);
  }
  Real best = std::numeric_limits<Real>::infinity();
  for (int sides = 0; sides < (1 << N); ++sides)
  {
    typename oracle::Spline<N>::Spans spans;
    for (int i = 0; i < N; ++i)
    {
      spans[i] = spline.span(i, t[i], (sides >> i & 1) != 0);
    }
    const Real error = (spline.evaluate(spans, t) - judge.to_local(foot.point)).norm();
    best = std::min(best, error - parameter_rounding<N>(spline, spans, t));
  }
  return static_cast<double>(best);
}

/// The same for the judge's foot.
template <int N>
double parameter_rounding(const Judge<N>& judge, const oracle::Foot<N>& foot)
{
  const oracle::Spline<N>& spline = judge.nearest.spline();
  Real most = 0.0L;
  for (int sides = 0; sides < (1 << N); ++sides)
  {
    typename oracle::Spline<N>::Spans spans;
    for (int i = 0; i < N; ++i)
    {
      spans[i] = spline.span(i, foot.parameter[i], (sides >> i & 1) != 0);
    }
    most = std::max(most, parameter_rounding<N>(spline, spans, foot.parameter));
  }
  return static_cast<double>(most);
}

std::string text(const Vector3& point)
{
  std::ostringstream all;
  all << std::setprecision(17) << '(' << point[0] << ", " << point[1] << ", " << point[2] << ')';
  return all.str();
}

/// \return our foot
template <int N>
Foot check(const Subject<N>& subject, const std::string& name, const Query& query, Tally& tally)
{
  const std::clock_t before = std::clock();
  const Foot foot = subject.inverter.find(query.point);
  const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  ++tally.queries;
  tally.seconds += seconds;
  const std::string where = name + " (" + query.kind + ")";
  if (seconds > tally.slowest)
  {
    tally.slowest = seconds;
    tally.slowest_query = where;
  }
  const Judge<N>& judge = subject.judge;
  const oracle::Foot<N> nearest = judge.nearest(judge.to_local(query.point));
  const double distance = static_cast<double>(nearest.distance);
  // A foot is at parameters in double; where the geometry is so fast that their rounding shows, no
  // search comes nearer.
  const double rounding = parameter_rounding<N>(judge, nearest);
  const double allowed = kWrong * judge.size + kRounding * distance + rounding;
  const double excess = foot.distance - distance;
  // The point in model coordinates has the rounding of those.
  const double coordinates = 0x1p-52 * (foot.point.norm() + query.point.norm());
  const double error = std::max(misplacement<N>(judge, foot),
                         std::abs((foot.point - query.point).norm() - foot.distance)) -
    coordinates;
  tally.excess = std::max(tally.excess, excess / allowed);
  tally.error = std::max(tally.error, error / allowed);
  // Negated: what is not a number is wrong.
  const bool too_far = !(excess <= allowed);
  const bool misplaced = !(error <= allowed);
  const bool known_shortfall = too_far && foot.status != Status::Certified &&
    excess <= kUncertifiedExcess * judge.size;
  tally.too_far += too_far && !known_shortfall;
  tally.unproved_too_far += known_shortfall;
  tally.misplaced += misplaced;
  tally.oracle_beaten += excess < -allowed;
  // What the certificate says: nothing is nearer by more than the tolerance, whatever the
  // parameters' rounding.
  const bool certified = foot.status == Status::Certified;
  const double proved = subject.inverter.options().certificate_tolerance * judge.size;
  const bool disproved =
    certified && (misplaced || !(excess <= proved + kRounding * (distance + judge.size)));
  tally.certified += certified;
  tally.wrongly_certified += disproved;
  tally.not_converged += foot.status == Status::NotConverged;
  tally.hanging += seconds > kHanging;
  const bool known_status = foot.status == Status::Certified || foot.status == Status::Converged ||
    foot.status == Status::NotConverged;
  if (too_far || misplaced || disproved)
  {
    std::cout << "wrong: " << where << ", excess " << excess / judge.size << " of the size, status "
              << static_cast<int>(foot.status) << '\n';
  }
  if (((too_far && !known_shortfall) || misplaced || disproved || !known_status ||
        seconds > kHanging) &&
    tally.printed++ < kPrinted)
  {
    ADD_FAILURE() << (too_far        ? "too far"
                         : misplaced ? "misplaced"
                         : disproved ? "wrongly certified"
                                     : "status or time")
                  << ": " << where << "\n  " << subject.description << "\n  query "
                  << text(query.point) << "\n  distance " << foot.distance << " of " << distance
                  << ", excess " << excess / judge.size << " and error " << error / judge.size
                  << " of the size (rounding of the parameters there " << rounding / judge.size
                  << "), status " << static_cast<int>(foot.status) << " at "
                  << foot.parameter.transpose() << ", " << seconds << " s";
  }
  return foot;
}

void conclude(const Tally& tally)
{
  const double queries = static_cast<double>(tally.queries);
  const double uncertified = static_cast<double>(tally.queries - tally.certified) / queries;
  std::cout << tally.queries << " queries: " << tally.too_far << " too far, "
            << tally.unproved_too_far << " unproved and a little too far, " << tally.misplaced
            << " misplaced, " << tally.wrongly_certified << " wrongly certified; "
            << tally.not_converged << " not converged, " << 100.0 * uncertified
            << " % not certified, " << tally.oracle_beaten
            << " nearer than the judge's; largest excess " << tally.excess << " and error "
            << tally.error << " of what is allowed; " << 1e3 * tally.seconds / queries
            << " ms a query, slowest " << tally.slowest << " s: " << tally.slowest_query << '\n';
  const auto record = [](const std::string& key, double value)
  { ::testing::Test::RecordProperty(key, ::testing::PrintToString(value)); };
  record("Queries", queries);
  record("FractionNotCertified", uncertified);
  record("WorstExcess", tally.excess);
  record("WorstError", tally.error);
  record("SlowestQuerySeconds", tally.slowest);
  EXPECT_EQ(tally.too_far, 0u);
  EXPECT_EQ(tally.misplaced, 0u);
  EXPECT_EQ(tally.wrongly_certified, 0u);
  EXPECT_EQ(tally.hanging, 0u);
  // Steep weights may leave a foot whose residual is above its floor; that must stay rare.
  EXPECT_LE(static_cast<double>(tally.not_converged), std::max(5.0, 0.01 * queries));
  EXPECT_LE(
    static_cast<double>(tally.unproved_too_far), std::max(5.0, kUncertifiedTooFar * queries));
  EXPECT_LE(static_cast<double>(tally.queries - tally.certified),
    std::max(100.0, kUncertified * queries));
}

// === Runs

template <int N>
void fuzz_geometry(std::uint64_t seed, std::uint64_t queries, Tally& tally)
{
  shapes::Random random(seed);
  const fuzz::Geometry<N> geometry = fuzz::random_geometry<N>(random);
  const Subject<N> subject(geometry.arrays, geometry.description);
  for (std::uint64_t k = 0; k < queries; ++k)
  {
    const Query query = fuzz::random_query<N>(random, subject.judge);
    check<N>(
      subject, "seed " + std::to_string(seed) + ", query " + std::to_string(k), query, tally);
  }
}

/// Every fourth seed is a curve's.
void fuzz_seed(std::uint64_t seed, Tally& tally)
{
  if (seed % 4 == 3)
  {
    fuzz_geometry<1>(seed, kQueriesPerGeometry, tally);
  }
  else
  {
    fuzz_geometry<2>(seed, kQueriesPerGeometry, tally);
  }
}

/// Runs seeds from `first` on until there are enough queries; or the one that is asked for.
template <class Run>
void run_seeds(std::uint64_t first, std::uint64_t queries, const Run& run)
{
  Tally tally;
  const std::uint64_t only = number_from("FOOTPOINT_FUZZ_GEOMETRY", 0);
  queries = number_from("FOOTPOINT_FUZZ_QUERIES", queries);
  first += number_from("FOOTPOINT_FUZZ_SEED", 1) * 100000000;
  if (only > 0)
  {
    run(only, tally);
  }
  for (std::uint64_t seed = first; only == 0 && tally.queries < queries; ++seed)
  {
    run(seed, tally);
  }
  conclude(tally);
}

class OracleFuzz : public ::testing::TestWithParam<int>
{
};

class OracleFuzzTies : public ::testing::TestWithParam<int>
{
};

// === Centres, axes and ties

/// A named shape turned and scaled at random, and a place on its focal set or medial axis; where it
/// is a whole sphere or torus the distance in closed form from there.
struct Symmetric
{
  shapes::Arrays<2> arrays;
  std::string name;
  std::function<Vector3(shapes::Random&)> centre;
  /// Of the distance; empty where there is none.
  std::function<double(const Vector3&)> distance;
};

shapes::Arrays<2> arrays_of(const footpoint::Surface& surface)
{
  return { { { surface.knots(0).degree(), surface.knots(1).degree() } },
    { { surface.knots(0).knots(), surface.knots(1).knots() } },
    surface.local_control_points().colwise() + surface.centre(), surface.weights() };
}

Symmetric symmetric_shape(shapes::Random& random)
{
  const double turn = 2.0 * std::acos(-1.0);
  const std::string name =
    fuzz::pick(random, { "sphere", "torus", "torus", "cylinder", "ellipsoid", "part of a torus" });
  if (name == "torus" || name == "part of a torus")
  {
    const double minor = random.uniform(0.1, 2.9);
    const footpoint::Surface whole = shapes::torus(3.0, minor);
    // A part has a quarter less of the tube, and so borders.
    shapes::Arrays<2> arrays = arrays_of(whole);
    const bool part = name != "torus";
    if (part)
    {
      const Eigen::Index count = 9 * 7;
      arrays.knots[1].resize(10);
      arrays.knots[1].back() = arrays.knots[1][8];
      arrays.points.conservativeResize(3, count);
      arrays.weights.conservativeResize(count);
    }
    const bool axis = fuzz::one_in(random, 2);
    return { arrays, name,
      [=](shapes::Random& r)
      {
        const double angle = r.uniform(0, turn);
        return axis ? Vector3(0, 0, r.uniform(-2, 2))
                    : Vector3(3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0);
      },
      part ? std::function<double(const Vector3&)>()
           : [=](const Vector3& p)
        { return std::abs(std::hypot(std::hypot(p[0], p[1]) - 3.0, p[2]) - minor); } };
  }
  if (name == "cylinder")
  {
    const bool whole = fuzz::one_in(random, 2);
    return { arrays_of(whole ? shapes::cylinder(2.0, 360.0, 4) : shapes::cylinder(2.0)), name,
      [](shapes::Random& r) { return Vector3(0, 0, r.uniform(-12, 12)); }, {} };
  }
  shapes::Arrays<2> arrays = arrays_of(shapes::sphere());
  if (name == "sphere")
  {
    return { arrays, name, [](shapes::Random&) { return Vector3(0, 0, 0); },
      [](const Vector3& p) { return std::abs(p.norm() - 1.0); } };
  }
  // Spheroids and general ellipsoids, with their medial disk.
  const double flat = random.uniform(0.2, 0.9);
  const double broad = fuzz::one_in(random, 2) ? 1.0 : random.uniform(1.0, 2.0);
  arrays.points.row(0) *= broad;
  arrays.points.row(2) *= flat;
  return { arrays, name,
    [=](shapes::Random& r)
    {
      const double angle = r.uniform(0, turn);
      const double radius = r.uniform(0, 1.0 - flat * flat);
      return Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    },
    {} };
}

void fuzz_symmetric(std::uint64_t seed, Tally& tally)
{
  shapes::Random random(seed);
  Symmetric shape = symmetric_shape(random);
  const Vector3 axis = random.vector(-1, 1).normalized();
  const Eigen::Matrix3d rotation = fuzz::one_in(random, 3)
    ? Eigen::Matrix3d::Identity()
    : Eigen::AngleAxisd(random.uniform(0, 6), axis).toRotationMatrix();
  const double scale = fuzz::one_in(random, 3) ? random.magnitude(3) : 1.0;
  const Vector3 origin = fuzz::one_in(random, 3) ? Vector3(1e6 * scale * axis) : Vector3::Zero();
  shape.arrays.points = ((scale * rotation) * shape.arrays.points).colwise() + origin;
  const Subject<2> subject(shape.arrays, shape.name);
  for (std::uint64_t k = 0; k < kQueriesPerGeometry; ++k)
  {
    const double off = fuzz::one_in(random, 10) ? 0.0 : std::pow(10.0, random.uniform(-9, -2));
    const Vector3 local = shape.centre(random) + off * random.vector(-1, 1);
    const Vector3 query = scale * (rotation * local) + origin;
    const std::string name = "seed " + std::to_string(seed) + ", query " + std::to_string(k);
    const Foot foot = check<2>(subject, name, { "near the centre or axis", query }, tally);
    if (shape.distance)
    {
      // Rounding of the poles far away moves the shape.
      const double allowed = kWrong * subject.judge.size + 1e-15 * origin.norm();
      EXPECT_NEAR(foot.distance, scale * shape.distance(local), allowed)
        << shape.name << ", " << name << ", query " << text(query);
    }
  }
}

/// Medial axes and centres of curvature of any geometry.
template <int N>
void fuzz_ties(std::uint64_t seed, Tally& tally)
{
  shapes::Random random(seed);
  const fuzz::Geometry<N> geometry = fuzz::random_geometry<N>(random);
  const Subject<N> subject(geometry.arrays, geometry.description);
  for (std::uint64_t k = 0; k < kQueriesPerGeometry; ++k)
  {
    const std::string kind = fuzz::pick(random,
      { "medial axis", "near the medial axis", "near the medial axis", "centre of curvature",
        "near a centre of curvature" });
    check<N>(subject, "seed " + std::to_string(seed) + ", query " + std::to_string(k),
      fuzz::random_query<N>(random, subject.judge, kind), tally);
  }
}

} // namespace

TEST_P(OracleFuzz, FindsTheNearestPoint)
{
  run_seeds(1000000 * static_cast<std::uint64_t>(GetParam()), kQueries, fuzz_seed);
}

INSTANTIATE_TEST_SUITE_P(Shard, OracleFuzz, ::testing::Range(0, kShards));

TEST_P(OracleFuzzTies, FindsTheNearestPointAtCentresAndTies)
{
  run_seeds(50000000 + 1000000 * static_cast<std::uint64_t>(GetParam()), kTieQueries,
    [](std::uint64_t seed, Tally& tally)
    {
      if (seed % 4 < 2)
      {
        fuzz_symmetric(seed, tally);
      }
      else if (seed % 4 == 2)
      {
        fuzz_ties<2>(seed, tally);
      }
      else
      {
        fuzz_ties<1>(seed, tally);
      }
    });
}

INSTANTIATE_TEST_SUITE_P(Shard, OracleFuzzTies, ::testing::Range(0, kTieShards));

TEST(OracleFuzzFixed, FormerFailures)
{
  Tally tally;
  for (const former_failures::Failure& failure : former_failures::all())
  {
    const Subject<2> subject(failure.arrays, failure.what);
    check<2>(subject, "former failure", { "fixed", failure.query }, tally);
  }
  conclude(tally);
}

TEST(OracleFuzzThreads, ShareOneInverter)
{
  shapes::Random random(1);
  for (int k = 0; k < (kSlowBuild ? 3 : 20); ++k)
  {
    const fuzz::Geometry<2> geometry = fuzz::random_geometry<2>(random);
    const Subject<2> subject(geometry.arrays, geometry.description);
    std::vector<Vector3> queries;
    for (int q = 0; q < (kSlowBuild ? 20 : 50); ++q)
    {
      queries.push_back(fuzz::random_query<2>(random, subject.judge).point);
    }
    // The first query ever is made by both at once.
    std::array<std::vector<Foot>, 2> feet;
    const auto run = [&](std::vector<Foot>& found)
    {
      for (const Vector3& query : queries)
      {
        found.push_back(subject.inverter.find(query));
      }
    };
    std::thread other(run, std::ref(feet[1]));
    run(feet[0]);
    other.join();
    for (std::size_t q = 0; q < queries.size(); ++q)
    {
      SCOPED_TRACE(geometry.description + ", query " + text(queries[q]));
      EXPECT_EQ(feet[0][q].distance, feet[1][q].distance);
      EXPECT_EQ(feet[0][q].parameter, feet[1][q].parameter);
      EXPECT_EQ(feet[0][q].status, feet[1][q].status);
    }
  }
}
