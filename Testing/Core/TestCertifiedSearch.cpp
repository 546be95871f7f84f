// SPDX-License-Identifier: BSD-3-Clause

/// The certified search for itself: vector instructions, order, certificates that must not be
/// given.

#include "Inversion.h"
#include "OnlyTarget.h"

#include <algorithm>

using footpoint::InversionOptions;
using footpoint::Points;
using footpoint::Surface;
using namespace inversion;

namespace
{

/// On, near, off and far from a surface.
Points queries_about(const Surface& surface, std::uint64_t seed)
{
  constexpr int kEach = 200;
  shapes::Random random(seed);
  Points points(3, 4 * kEach);
  for (int k = 0; k < points.cols(); ++k)
  {
    Parameter<2> t;
    for (int i = 0; i < 2; ++i)
    {
      t(i) = random.uniform(0.0, surface.direction(i).length);
    }
    const double reach[] = { 0.0, 1e-3, 0.1, 3.0 };
    points.col(k) = surface.centre() + surface.point(t) +
      reach[k / kEach] * surface.size() * random.vector(-1.0, 1.0);
  }
  return points;
}

} // namespace

TEST(CertifiedSearch, VectorInstructionsAgree)
{
  for (const Surface& surface : { shapes::bumpy(12, 3, 0.3), shapes::sphere(), shapes::torus() })
  {
    const Points points = queries_about(surface, 17);
    const PointInverter inverter(model_of(surface));
    const footpoint::InversionResult best = footpoint::invert(inverter, points);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    {
      SCOPED_TRACE(hwy::TargetName(target));
      const OnlyTarget only(target);
      const footpoint::InversionResult result = footpoint::invert(inverter, points);
      for (int k = 0; k < points.cols(); ++k)
      {
        EXPECT_EQ(result.feet[k].status, Status::Certified);
        EXPECT_NEAR(result.feet[k].distance, best.feet[k].distance,
          1e-14 * std::max(inverter.size(), best.feet[k].distance));
      }
    }
  }
}

TEST(CertifiedSearch, QueriesBesideTheCentreOfASphere)
{
  // The distance varies by 1e-9 … 1e-14 over the whole surface.
  const PointInverter inverter(model_of(shapes::sphere()));
  shapes::Random random(5);
  for (const double shift : { 1e-9, 1e-11, 1e-12, 1e-13, 1e-14 })
  {
    for (int k = 0; k < 20; ++k)
    {
      const Vector3 query = random.vector(-1.0, 1.0).normalized() * shift;
      const Foot foot = inverter.find(query);
      EXPECT_LE(foot.status, Status::Converged);
      EXPECT_NEAR(foot.distance, 1.0 - query.norm(), 1e-12 * inverter.size());
    }
  }
}

TEST(CertifiedSearch, NoToleranceNoCertificate)
{
  InversionOptions options;
  options.certificate_tolerance = 0.0;
  const Surface surface = shapes::bumpy(8, 3, 0.3);
  const PointInverter strict(model_of(surface), options);
  const PointInverter usual(model_of(surface));
  const Points points = queries_about(surface, 18);
  int certified = 0;
  for (int k = 0; k < points.cols(); k += 10)
  {
    const Foot foot = strict.find(points.col(k));
    // What is level to rounding is never proved to the last bit.
    certified += foot.status == Status::Certified;
    // Descents on whole patches end within rounding of where the pieces' ended.
    EXPECT_NEAR(foot.distance, usual.find(points.col(k)).distance, 1e-15 * usual.size());
  }
  // Far corners are proved without any tolerance; most others are not.
  EXPECT_LT(certified, 40);
}

TEST(CertifiedSearch, NothingWithinTheMaximumDistance)
{
  const Surface surface = shapes::torus();
  const Points points = queries_about(surface, 19);
  const PointInverter all(model_of(surface));
  InversionOptions options;
  options.maximum_distance = 0.05 * all.size();
  const PointInverter some(model_of(surface), options);
  for (int k = 0; k < points.cols(); ++k)
  {
    const Foot expected = all.find(points.col(k));
    const Foot foot = some.find(points.col(k));
    if (expected.distance > options.maximum_distance)
    {
      EXPECT_EQ(foot.status, Status::BeyondMaximumDistance);
      continue;
    }
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_NEAR(foot.distance, expected.distance, 1e-14 * all.size());
  }
}

/// Boxes of single precision are infinite beyond 3.4e38, and squares below 1e-308 are nothing.
/// Boxes of few pieces leave room in the nodes of the tree, and beyond 3.4e38 have no middles.
TEST(CertifiedSearch, OnePieceOfAnySize)
{
  for (const double scale : { 1e-150, 1e-39, 1.0, 1e38, 1e39, 1e100, 1e150 })
  {
    SCOPED_TRACE(scale);
    Points ends(3, 2);
    ends.col(0) = Vector3::Zero();
    ends.col(1) = scale * Vector3(1.0, 2.0, 3.0);
    const footpoint::Curve line(footpoint::KnotVector(1, { 0, 0, 1, 1 }, "KnotsU"), ends);
    const PointInverter inverter(model_of(line));
    const Foot foot = inverter.find(scale * Vector3(0.6, 1.4, 1.2));
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_NEAR(foot.parameter(0), 0.5, 1e-12);
    EXPECT_NEAR(foot.distance / scale, std::sqrt(0.26), 1e-12);
  }
}

/// Squares of single precision lose their digits, then all they are, far from the end of its own
/// range.
TEST(CertifiedSearch, BoxesWhoseSquaresAreTiny)
{
  constexpr int kFaces = 40;
  for (const double scale : { 1e-18, 1e-19, 1e-20, 1e-21, 1e-22, 3e-23, 1e-23, 1e-25, 1e-40 })
  {
    SCOPED_TRACE(scale);
    shapes::Random random(5);
    footpoint::Model model;
    std::vector<Vector3> corners;
    for (int k = 0; k < kFaces; ++k)
    {
      // The unit square itself, so that its box is exact.
      const Vector3 corner = random.vector(-3.0, 3.0);
      corners.push_back(scale * corner);
      Points net(3, 4);
      for (int i = 0; i < 4; ++i)
      {
        net.col(i) = scale * (corner + Vector3(i % 2, i / 2, 0.0));
      }
      footpoint::Face face;
      face.patches.push_back({ nullptr,
        std::make_shared<Surface>(footpoint::KnotVector(1, { 0, 0, 1, 1 }, "KnotsU"),
          footpoint::KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"), net) });
      model.push_back(face);
    }
    const PointInverter inverter(model);
    for (int k = 0; k < 500; ++k)
    {
      const Vector3 point = scale * random.vector(-4.0, 4.0);
      long double nearest = std::numeric_limits<long double>::infinity();
      for (const Vector3& corner : corners)
      {
        long double squared = 0.0L;
        for (int i = 0; i < 3; ++i)
        {
          const long double side = i < 2 ? scale : 0.0;
          const long double below = static_cast<long double>(corner(i)) - point(i);
          const long double away = std::max({ below, -below - side, 0.0L });
          squared += away * away;
        }
        nearest = std::min(nearest, std::sqrt(squared));
      }
      const footpoint::Foot foot = inverter.find(point);
      EXPECT_EQ(foot.status, Status::Certified);
      EXPECT_NEAR(foot.distance / scale, static_cast<double>(nearest / scale), 1e-10);
    }
  }
}

TEST(CertifiedSearch, HugeAndTinySizes)
{
  for (const Surface& surface : { shapes::bumpy(12, 3, 0.3), shapes::cylinder() })
  {
    const Points points = queries_about(surface, 18);
    const Points net = surface.local_control_points().colwise() + surface.centre();
    const footpoint::InversionResult right =
      footpoint::invert(PointInverter(model_of(surface)), points);
    for (const double scale :
      { 1e-150, 1e-100, 1e-20, 1e30, 1e38, 1e39, 1e100, 1e140, 1e150 })
    {
      SCOPED_TRACE(scale);
      const Surface scaled(
        surface.knots(0), surface.knots(1), scale * net, surface.weights());
      const footpoint::InversionResult result =
        footpoint::invert(PointInverter(model_of(scaled)), scale * points);
      for (int k = 0; k < points.cols(); ++k)
      {
        EXPECT_EQ(result.feet[k].status, Status::Certified);
        EXPECT_NEAR(result.feet[k].distance / scale, right.feet[k].distance,
          1e-12 * std::max(surface.size(), right.feet[k].distance));
      }
    }
  }
}
