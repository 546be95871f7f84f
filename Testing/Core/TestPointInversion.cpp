// SPDX-License-Identifier: BSD-3-Clause

// What PointInverter offers beyond the nearest foot of one point: all feet, directions, faces,
// patches, sequences, starts and searches.

#include "Inversion.h"

#include <cmath>

using namespace inversion;
using footpoint::InversionResult;
using footpoint::KnotVector;
using footpoint::Method;
using footpoint::Points;
using footpoint::Search;
using footpoint::Start;
using footpoint::Surface;

namespace
{

footpoint::Curve ellipse(double a, double b)
{
  const shapes::Arcs arcs = shapes::unit_arcs(360.0, 4);
  Points net = arcs.points;
  net.row(0) *= a;
  net.row(1) *= b;
  return footpoint::Curve(KnotVector(2, arcs.knots, "KnotsU"), net, arcs.weights);
}

} // namespace

// === All feet

TEST(AllFeet, MinimaOfAnEllipse)
{
  // Inside the evolute (2x)^(2/3) + y^(2/3) = 3^(2/3) of x²/4 + y² = 1 there are two minima,
  // outside one.
  const PointInverter inverter(model_of(ellipse(2.0, 1.0)), all_feet());
  expect_all(inverter, { 0, 0, 0 },
    { { 1.0, { 90, 0 }, FootType::Interior, true, { 0, 1, 0 } },
      { 1.0, { 270, 0 }, FootType::Interior, true, { 0, -1, 0 } } });
  shapes::Random random(1);
  for (int k = 0; k < 200; ++k)
  {
    const Vector3 query(random.uniform(-3, 3), random.uniform(-4, 4), 0.0);
    const double evolute =
      std::cbrt(4.0 * query.x() * query.x()) + std::cbrt(query.y() * query.y());
    if (std::abs(evolute - std::cbrt(9.0)) > 1e-3)
    {
      const std::size_t minima = evolute < std::cbrt(9.0) ? 2 : 1;
      EXPECT_EQ(inverter.find_all(query).size(), minima) << query.transpose();
    }
  }
}

TEST(AllFeet, OrthogonalFeetOfAnEllipseAndATorus)
{
  InversionOptions options = all_feet();
  options.orthogonal_only = true;
  const PointInverter inverter(model_of(ellipse(2.0, 1.0)), options);
  EXPECT_EQ(inverter.find_all({ 0.1, 0.05, 0 }).size(), 4u); // two minima, two maxima
  EXPECT_EQ(inverter.find_all({ 3, 1, 0 }).size(), 2u);
  // In general position a torus has a minimum, two saddles and a maximum.
  const PointInverter torus(model_of(shapes::torus()), options);
  const std::vector<Foot> feet = torus.find_all({ 5, 0.5, 0.25 });
  ASSERT_EQ(feet.size(), 4u);
  const double axis = std::hypot(5.0, 0.5);
  EXPECT_NEAR(feet[0].distance, std::hypot(axis - 3.0, 0.25) - 1.0, 1e-11);
  EXPECT_NEAR(feet[1].distance, std::hypot(axis - 3.0, 0.25) + 1.0, 1e-11);
  EXPECT_NEAR(feet[2].distance, std::hypot(axis + 3.0, 0.25) - 1.0, 1e-11);
  EXPECT_NEAR(feet[3].distance, std::hypot(axis + 3.0, 0.25) + 1.0, 1e-11);
}

TEST(AllFeet, OneMinimumOfATorus)
{
  const PointInverter inverter(model_of(shapes::torus()), all_feet());
  const Points points = random_points(50, 2, -5, 5);
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    EXPECT_EQ(inverter.find_all(points.col(k)).size(), 1u) << points.col(k).transpose();
  }
}

TEST(AllFeet, AContinuumCountsOnceByTheNearestFoot)
{
  const auto check = [](const PointInverter& inverter, const Vector3& query)
  {
    const std::vector<Foot> feet = inverter.find_all(query);
    ASSERT_EQ(feet.size(), 1u);
    EXPECT_FALSE(feet[0].isolated);
    EXPECT_EQ(feet[0].status, Status::Converged);
    Foot nearest = inverter.find(query);
    EXPECT_EQ(nearest.status, Status::Certified);
    nearest.status = Status::Converged;
    EXPECT_TRUE(identical(feet[0], nearest));
  };
  check(PointInverter(model_of(shapes::circle()), all_feet()), { 0, 0, 1 });
  check(PointInverter(model_of(shapes::torus()), all_feet()), { 0, 0, 0 });
}

TEST(AllFeet, AreThoseOfTheNearestFirstAndBelongToTheirPoint)
{
  const PointInverter inverter(model_of(ellipse(2.0, 1.0), plate(-1, 1, 3.0)), all_feet());
  const Points points = random_points(40, 3, -2, 2);
  const InversionResult result = footpoint::invert(inverter, points);
  ASSERT_EQ(result.all_feet.size(), result.all_feet_point.size());
  std::size_t at = 0;
  for (std::int64_t k = 0; k < points.cols(); ++k)
  {
    ASSERT_LT(at, result.all_feet.size());
    EXPECT_NEAR(result.all_feet[at].distance, result.feet[k].distance, 1e-14);
    double last = 0.0;
    for (; at < result.all_feet.size() && result.all_feet_point[at] == k; ++at)
    {
      EXPECT_GE(result.all_feet[at].distance, last - 1e-12);
      last = result.all_feet[at].distance;
    }
  }
  EXPECT_EQ(at, result.all_feet.size());
}

// === Along a direction

TEST(FixedDirection, LineThroughASphere)
{
  const PointInverter inverter(model_of(shapes::sphere()), along({ 0, 0, 2 }));
  const double height = std::sqrt(1.0 - 0.3 * 0.3 - 0.4 * 0.4);
  const std::vector<Foot> feet = inverter.find_all({ 0.3, 0.4, 2 });
  ASSERT_EQ(feet.size(), 2u);
  EXPECT_NEAR(feet[0].distance, 2.0 - height, 1e-12);
  EXPECT_NEAR(feet[1].distance, 2.0 + height, 1e-12);
  EXPECT_LE((feet[0].point - Vector3(0.3, 0.4, height)).norm(), 1e-12);
  EXPECT_GT(feet[0].signed_distance, 0.0);
  EXPECT_EQ(inverter.find({ 0.3, 0.4, 2 }).distance, feet[0].distance);
  // From inside both ways.
  EXPECT_EQ(inverter.find_all({ 0.3, 0.4, 0.1 }).size(), 2u);
  EXPECT_NEAR(inverter.find({ 0.3, 0.4, 0.1 }).distance, height - 0.1, 1e-12);
}

TEST(FixedDirection, AMissIsBeyondEverything)
{
  const PointInverter inverter(model_of(shapes::sphere()), along({ 0, 0, 1 }));
  const Foot miss = inverter.find({ 2, 0, 0 });
  EXPECT_EQ(miss.status, Status::BeyondMaximumDistance);
  EXPECT_TRUE(std::isnan(miss.distance));
  EXPECT_TRUE(std::isnan(miss.signed_distance));
  EXPECT_TRUE(miss.point.array().isNaN().all());
  EXPECT_EQ(miss.face, -1);
  EXPECT_TRUE(inverter.find_all({ 2, 0, 0 }).empty());
}

TEST(FixedDirection, FacesAndFoldsAllCount)
{
  const PointInverter plates(
    model_of(plate(0, 1, 1.0), plate(0, 1, -2.0), plate(5, 6, 0.5)), along({ 0, 0, -1 }));
  const std::vector<Foot> feet = plates.find_all({ 0.25, 0.5, 0 });
  ASSERT_EQ(feet.size(), 2u);
  EXPECT_EQ(feet[0].face, 0);
  EXPECT_NEAR(feet[0].distance, 1.0, 1e-12);
  EXPECT_EQ(feet[1].face, 1);
  EXPECT_NEAR(feet[1].distance, 2.0, 1e-12);
  // The line through a torus meets it four times.
  const PointInverter torus(model_of(shapes::torus()), along({ 1, 0, 0 }));
  const std::vector<Foot> four = torus.find_all({ 0, 0, 0.5 });
  ASSERT_EQ(four.size(), 4u);
  EXPECT_NEAR(four[0].distance, 3.0 - std::sqrt(0.75), 1e-11);
  EXPECT_NEAR(four[3].distance, 3.0 + std::sqrt(0.75), 1e-11);
}

// === Limits and faces

TEST(MaximumDistance, CutsOff)
{
  InversionOptions options;
  options.maximum_distance = 1.0;
  const PointInverter inverter(model_of(shapes::sphere()), options);
  EXPECT_EQ(inverter.find({ 1.9, 0, 0 }).status, Status::Certified);
  EXPECT_EQ(inverter.find({ 2.1, 0, 0 }).status, Status::BeyondMaximumDistance);
  EXPECT_TRUE(std::isnan(inverter.find({ 2.1, 0, 0 }).distance));
  options.all_feet = true;
  const PointInverter every(model_of(shapes::saddle(), plate(10, 11)), options);
  for (const Foot& foot : every.find_all({ 0, 0, 0.9 }))
  {
    EXPECT_LE(foot.distance, 1.0);
    EXPECT_EQ(foot.face, 0);
  }
}

TEST(Faces, NearestLowestNullAndReversed)
{
  Model model = model_of(plate(0, 1), plate(0, 1, 1.0));
  model.insert(model.begin() + 1, Face{}); // a null block uses up its number
  model[2].reversed = true;
  const PointInverter inverter(model);
  expect_foot(inverter, { 0.5, 0.5, 0.4 }, { 0.4, { 0.5, 0.5 } });
  EXPECT_EQ(inverter.find({ 0.5, 0.5, 0.4 }).face, 0);
  EXPECT_NEAR(inverter.find({ 0.5, 0.5, 0.4 }).signed_distance, 0.4, 1e-14);
  EXPECT_EQ(inverter.find({ 0.5, 0.5, 0.6 }).face, 2);
  // Above 0 but below the upper plate, whose normal is turned downwards.
  EXPECT_NEAR(inverter.find({ 0.5, 0.5, 0.6 }).signed_distance, 0.4, 1e-14);
  EXPECT_NEAR(inverter.find({ 0.5, 0.5, 1.5 }).signed_distance, -0.5, 1e-14);
  EXPECT_EQ(inverter.find({ 0.5, 0.5, 1.5 }).direction, Vector3(0, 0, -1));
  EXPECT_EQ(inverter.find({ 0.5, 0.5, 0.5 }).face, 0); // a tie
}

TEST(Faces, CurvesAndSurfacesMix)
{
  const PointInverter inverter(model_of(shapes::circle(1.0, { 0, 0, 2 }), plate(-1, 1)));
  const Foot on_curve = inverter.find({ 2, 0, 2 });
  EXPECT_TRUE(on_curve.on_curve);
  EXPECT_NEAR(on_curve.distance, 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(on_curve.signed_distance));
  EXPECT_LE((on_curve.direction - Vector3(0, 1, 0)).norm(), 1e-12);
  EXPECT_FALSE(inverter.find({ 0.5, 0.5, 0.1 }).on_curve);
}

// === Faces of several patches

TEST(Patches, SharedBordersAreInterior)
{
  // Two coplanar cells and a third that rises behind them.
  const Model model{ face_of_patches(
    { patch_of(plate(0, 1)), patch_of(plate(1, 2)), patch_of(plate(2, 3, 0, 1.0)) }) };
  const PointInverter inverter(model);
  const Foot smooth = inverter.find({ 1, 0.5, 0.5 });
  EXPECT_EQ(smooth.type, FootType::Interior);
  EXPECT_NEAR(smooth.distance, 0.5, 1e-14);
  EXPECT_LE((smooth.direction - Vector3(0, 0, 1)).norm(), 1e-14);
  // On the ridge of the third: below it the foot is a kink, with the mean of both normals.
  const Foot kink = inverter.find({ 2.1, 0.5, -1 });
  EXPECT_EQ(kink.type, FootType::Kink);
  EXPECT_LE((kink.point - Vector3(2, 0.5, 0)).norm(), 1e-12);
  EXPECT_LE(
    (kink.direction - Vector3(-std::sin(std::acos(-1.0) / 8), 0, std::cos(std::acos(-1.0) / 8)))
      .norm(),
    1e-12);
  EXPECT_LT(kink.signed_distance, 0.0);
  // The outer border stays an edge, also where it meets the shared one.
  EXPECT_EQ(inverter.find({ 0.5, -1, 0 }).type, FootType::Edge);
  EXPECT_NE(inverter.find({ 1, -1, 0 }).type, FootType::Interior);
  EXPECT_EQ(inverter.find({ -1, -1, 0 }).type, FootType::Vertex);
  // As faces of their own the same borders are edges.
  const PointInverter apart(model_of(plate(0, 1), plate(1, 2)));
  EXPECT_EQ(apart.find({ 1, 0.5, 0.5 }).type, FootType::Edge);
  EXPECT_EQ(apart.find({ 1, 0.5, 0.5 }).face, 0);
}

TEST(Patches, AFootOnASharedBorderCountsOnce)
{
  const Model model{ face_of_patches({ patch_of(plate(0, 1)), patch_of(plate(1, 2)) }) };
  EXPECT_EQ(PointInverter(model, all_feet()).find_all({ 1, 0.5, 0.5 }).size(), 1u);
  EXPECT_EQ(PointInverter(model, along({ 0, 0, 1 })).find_all({ 1, 0.5, 0.5 }).size(), 1u);
}

// === Other options of the same model

TEST(OtherOptions, ShareWhatWasBuilt)
{
  const PointInverter first(model_of(shapes::bumpy(12, 5, 0.3), shapes::torus(0.5, 0.2)));
  const auto shares = [&](const auto& change)
  {
    InversionOptions options;
    change(options);
    return first.is_prepared_for(options);
  };
  EXPECT_TRUE(shares([](InversionOptions& o) { o.maximum_distance = 0.1; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.certificate_tolerance = 1e-6; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.solver.point_tolerance = 1e-6; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.solver.method = Method::GaussNewton; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.seeding.number_of_seeds = 9; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.search = Search::Seeded; }));
  EXPECT_FALSE(shares([](InversionOptions& o) { o.seeding.resolution = 9; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.all_feet = true; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.orthogonal_only = true; }));
  EXPECT_TRUE(shares([](InversionOptions& o) { o.fixed_direction = Vector3(0, 0, 1); }));
  EXPECT_TRUE(PointInverter(first.model(), along({ 0, 0, 1 })).is_prepared_for({}));
  // Seeds need no pieces; and nothing that was built is given up.
  const PointInverter seeded(first.model(), searching(Search::Seeded));
  EXPECT_FALSE(seeded.is_prepared_for({}));
  const PointInverter both = seeded.with_options({}).with_options(searching(Search::Seeded));
  EXPECT_TRUE(both.is_prepared_for({}));
}

TEST(OtherOptions, AnswerLikeAnInverterOfTheirOwn)
{
  const Model model = model_of(shapes::bumpy(12, 5, 0.3), shapes::torus(0.5, 0.2));
  std::vector<InversionOptions> various(9);
  various[1].maximum_distance = 0.2;
  various[2].certificate_tolerance = 0.0;
  various[3] = searching(Search::Seeded);
  various[4] = searching(Search::Local);
  various[4].solver.method = Method::GaussNewton;
  various[5].all_feet = true;
  various[6].orthogonal_only = true;
  various[7] = along({ 0, 0.1, 3 });
  various[8] = searching(Search::Seeded);
  various[8].seeding = { 4, 1 };
  const Points points = random_points(40, 13, -0.5, 1.5);
  PointInverter inverter(model);
  for (const InversionOptions& options : various)
  {
    inverter = inverter.with_options(options);
    const PointInverter fresh(model, options);
    EXPECT_EQ(inverter.size(), fresh.size());
    for (Eigen::Index k = 0; k < points.cols(); ++k)
    {
      EXPECT_TRUE(identical(inverter.find(points.col(k)), fresh.find(points.col(k)))) << k;
      const std::vector<Foot> all = inverter.find_all(points.col(k));
      const std::vector<Foot> expected = fresh.find_all(points.col(k));
      ASSERT_EQ(all.size(), expected.size()) << k;
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        EXPECT_TRUE(identical(all[i], expected[i])) << k;
      }
    }
  }
  InversionOptions of_curves;
  of_curves.solver.method = Method::FirstOrder;
  EXPECT_THROW(inverter.with_options(of_curves), std::invalid_argument);
}

/// The same to rounding: where nothing is proved, descents on whole patches are tried besides.
TEST(CertificateTolerance, ZeroLeavesTheSameFootUncertified)
{
  const PointInverter inverter(model_of(shapes::bumpy(12, 5, 0.3), shapes::torus(0.5, 0.2)));
  InversionOptions options;
  options.certificate_tolerance = 0.0;
  const PointInverter nothing = inverter.with_options(options);
  const Points points = random_points(200, 14, -0.5, 1.5);
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    const Foot certified = inverter.find(points.col(k));
    const Foot foot = nothing.find(points.col(k));
    EXPECT_EQ(certified.status, Status::Certified) << k;
    EXPECT_EQ(foot.status, Status::Converged) << k;
    EXPECT_EQ(foot.face, certified.face) << k;
    EXPECT_EQ(foot.type, certified.type) << k;
    EXPECT_NEAR(foot.distance, certified.distance, 1e-15 * inverter.size()) << k;
    EXPECT_LE((foot.point - certified.point).norm(), 1e-12 * inverter.size()) << k;
  }
}

// === Starts and searches

TEST(Searches, SequenceFollowsAPathThroughATie)
{
  // From one minimum of the saddle's axis to above the tie: a local search stays on its side.
  const PointInverter inverter(model_of(shapes::saddle()), searching(Search::Local));
  Points path(3, 11);
  for (int k = 0; k <= 10; ++k)
  {
    path.col(k) = Vector3(0.5 - 0.05 * k, 0.5 - 0.05 * k, 1.5);
  }
  const InversionResult result = footpoint::invert_sequence(inverter, path);
  EXPECT_NEAR(result.feet[10].parameter(0), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(result.feet[10].distance, std::sqrt(2.0), 1e-12);
}

TEST(Searches, StartsThatAreNotAnumberOrOutside)
{
  for (const Search search : { Search::Global, Search::Seeded, Search::Local })
  {
    const PointInverter inverter(model_of(shapes::torus()), searching(search));
    const Points points = random_points(20, 8, -5, 5);
    std::vector<Start> starts(20);
    for (int k = 0; k < 20; ++k)
    {
      starts[k].face = k % 2 - 1;
      starts[k].parameter =
        k % 4 < 2 ? Parameter<2>(NAN, 10.0 * k) : Parameter<2>(1e4 + 90.0 * k, -1e3);
    }
    const InversionResult result = footpoint::invert(inverter, points, starts);
    for (int k = 0; k < 20; ++k)
    {
      const Foot& foot = result.feet[k];
      EXPECT_EQ(foot.status, search == Search::Global ? Status::Certified : Status::Converged);
      EXPECT_GE(foot.parameter.minCoeff(), 0.0);
      EXPECT_LE(foot.parameter.maxCoeff(), 360.0);
    }
  }
  // Open domains are clamped.
  const PointInverter open(model_of(shapes::saddle()), searching(Search::Local));
  expect_foot(
    open, open.find({ 0, 0, 0.5 }, { 0, { 1e9, -1e9 } }), { 0.5, { 0, 0 } }, "clamped start");
}

TEST(Searches, SeededFindsWhatGlobalFindsOnGentleShapes)
{
  const Surface bumpy = shapes::bumpy(6, 9, 0.1);
  const PointInverter global(model_of(bumpy));
  const PointInverter seeded(model_of(bumpy), searching(Search::Seeded));
  const Points points = random_points(100, 10, 0, 1);
  int different = 0;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    const double best = global.find(points.col(k)).distance;
    const double found = seeded.find(points.col(k)).distance;
    EXPECT_GE(found, best - 1e-12);
    different += found > best + 1e-12;
  }
  EXPECT_LE(different, 2);
}

// === On the geometry

TEST(OnTheGeometry, ResidualsAndParameters)
{
  const auto check = [](const auto& geometry, const char* name)
  {
    constexpr int kDirections =
      std::is_base_of_v<footpoint::ParametricCurve, std::decay_t<decltype(geometry)>> ? 1 : 2;
    const PointInverter inverter(model_of(geometry));
    shapes::Random random(11);
    for (int k = 0; k < 100; ++k)
    {
      Parameter<kDirections> t;
      for (int i = 0; i < kDirections; ++i)
      {
        // Poles and seams are at the ends; regular places are asked for.
        t(i) = random.uniform(0.02, 0.98) * geometry.direction(i).length;
      }
      const Foot foot = inverter.find(geometry.centre() + geometry.point(t));
      EXPECT_LE(foot.distance, 1e-13 * inverter.size()) << name;
      EXPECT_EQ(foot.status, Status::Certified) << name;
      for (int i = 0; i < kDirections; ++i)
      {
        EXPECT_NEAR(foot.parameter(i), geometry.direction(i).origin + t(i),
          1e-10 * geometry.direction(i).length)
          << name << ", direction " << i;
      }
    }
  };
  check(shapes::parabola(), "parabola");
  check(shapes::tent(), "tent");
  check(shapes::closed_with_corner(), "closed curve with a corner");
  check(shapes::circle(), "circle");
  check(shapes::line_with_gap(), "line with a gap");
  check(shapes::periodic(), "periodic curve");
  check(shapes::open_with_matching_poles(), "open curve with matching poles");
  check(shapes::saddle(), "saddle");
  check(shapes::cylinder(), "cylinder");
  check(shapes::square(), "square");
  check(shapes::triangle(), "triangle");
  check(shapes::sphere(), "sphere");
  check(shapes::torus(), "torus");
  check(shapes::helical_ribbon(), "helical ribbon");
  check(shapes::bumpy(40, 12), "bumpy");
  check(shapes::bumpy(12, 13, 0.3), "very bumpy");
}
