// SPDX-License-Identifier: BSD-3-Clause

// Loops that cross, touch or overlap each other or themselves: only what bounds the kept region is
// an edge. Closed forms, and an oracle by brute force. Set in the environment
//   FOOTPOINT_TRIM_QUERIES  how many queries are made of random faces (3000 by default, 1000 in
//   slow
//                           builds)
//   FOOTPOINT_TRIM_SEED     other faces: any number, 1 by default

#include "FootJudge.h"
#include "RandomFaces.h"
#include "SlowBuild.h"
#include "TrimArcChecks.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace
{

using namespace inversion;
using footpoint::ArcBounds;
using footpoint::Curve;
using footpoint::KnotVector;
using footpoint::Points;
using footpoint::Surface;
using footpoint::TrimLoop;
using footpoint::TrimRegion;
using trims::circle;
using trims::polygon;
using trims::rectangle;
using trims::reversed;

Face trimmed(const Surface& surface, std::vector<TrimLoop> loops)
{
  Face face = face_of(surface);
  face.loops = std::move(loops);
  footpoint::trim(face);
  trims::check_arcs(*face.region, face.loops, surface);
  return face;
}

PointInverter flat_with(std::vector<TrimLoop> loops)
{
  return PointInverter({ trimmed(trims::flat(), std::move(loops)) });
}

void expect_foot(const Foot& foot, const Vector3& point, FootType type, Status status)
{
  EXPECT_EQ(foot.status, status);
  EXPECT_EQ(foot.type, type);
  EXPECT_NEAR((foot.point - point).norm(), 0.0, 1e-12) << foot.point.transpose();
}

/// The arcs of a region that bound a face, the length of all of them in (u, v), and what is
/// undecided.
struct Boundary
{
  double length = 0.0;
  int undecided = 0;
};

Boundary boundary(const Face& face)
{
  Boundary result;
  for (const footpoint::TrimArc& arc : face.region->arcs())
  {
    result.undecided += arc.bounds == ArcBounds::Undecided;
    constexpr int kChords = 2000;
    for (int k = 0; k < kChords && arc.bounds == ArcBounds::Face; ++k)
    {
      const trims::RealPoint from = trims::on_arc(arc, k / trims::Real(kChords));
      const trims::RealPoint to = trims::on_arc(arc, (k + 1) / trims::Real(kChords));
      result.length += static_cast<double>(std::hypot(to[0] - from[0], to[1] - from[1]));
    }
  }
  return result;
}

/// \param length of the boundary of what is kept
void expect_boundary(const std::vector<TrimLoop>& loops, double length)
{
  const Boundary found = boundary(trimmed(trims::flat(), loops));
  EXPECT_NEAR(found.length, length, 1e-6);
  EXPECT_EQ(found.undecided, 0);
}

const double kPi = std::acos(-1.0);

TEST(TrimCrossings, HoleAcrossTheOuterLoop)
{
  // The circle around (0.8, 0.5): its left half is a border, its right half bounds nothing.
  const std::vector<TrimLoop> loops{ rectangle(0.2, 0.2, 0.8, 0.8),
    reversed(circle(0.8, 0.5, 0.1)) };
  expect_boundary(loops, 2.4 - 0.2 + 0.1 * kPi);
  const PointInverter inverter = flat_with(loops);
  const Foot foot = inverter.find({ 0.95, 0.5, 0 });
  EXPECT_NEAR(foot.distance, std::hypot(0.15, 0.1), 1e-13);
  EXPECT_EQ(foot.status, Status::Certified);
  EXPECT_EQ(foot.type, FootType::Vertex);
  expect_foot(inverter.find({ 0.75, 0.5, 0 }), { 0.7, 0.5, 0 }, FootType::Edge, Status::Certified);
  expect_foot(inverter.find({ 0.9, 0.7, 0 }), { 0.8, 0.7, 0 }, FootType::Edge, Status::Certified);
  expect_foot(
    inverter.find({ 0.6, 0.5, 1 }), { 0.6, 0.5, 0 }, FootType::Interior, Status::Certified);
  EXPECT_EQ(inverter.number_of_open_edges(), 6); // four sides, one in two parts, and the arc's
}

TEST(TrimCrossings, IslandAcrossTheOuterLoop)
{
  // Both keep what they surround: no edge inside the other one.
  const std::vector<TrimLoop> loops{ rectangle(0.2, 0.2, 0.8, 0.8), circle(0.8, 0.5, 0.1) };
  expect_boundary(loops, 2.4 - 0.2 + 0.1 * kPi);
  const PointInverter inverter = flat_with(loops);
  const Vector3 out(std::cos(0.3), std::sin(0.3), 0.0);
  const Vector3 centre(0.8, 0.5, 0.0);
  expect_foot(inverter.find(centre + 0.15 * out), centre + 0.1 * out, FootType::Edge,
    Status::Certified);
  for (const Vector3& inside : { Vector3(0.8, 0.45, 0), Vector3(0.7, 0.5, 0) })
  {
    expect_foot(
      inverter.find(inside + Vector3(0, 0, 1)), inside, FootType::Interior, Status::Certified);
  }
}

TEST(TrimCrossings, LoopsThatCrossThemselves)
{
  // A bow tie: the left triangle runs counter-clockwise and is kept, the right one clockwise.
  const std::vector<TrimLoop> bow{ polygon(
    { { 0.1, 0.2 }, { 0.9, 0.8 }, { 0.9, 0.2 }, { 0.1, 0.8 } }) };
  expect_boundary(bow, 0.6 + 1.0);
  const PointInverter inverter = flat_with(bow);
  expect_foot(inverter.find({ 0.9, 0.5, 0 }), { 0.5, 0.5, 0 }, FootType::Vertex, Status::Certified);
  expect_foot(inverter.find({ 0.0, 0.5, 0 }), { 0.1, 0.5, 0 }, FootType::Edge, Status::Certified);
  // A pentagram: winding number 2 in the middle, all of it kept.
  std::vector<trims::Point2> corners;
  for (int k = 0; k < 5; ++k)
  {
    const double angle = 0.5 * kPi + 4.0 * kPi * k / 5.0;
    corners.push_back({ 0.5 + 0.4 * std::cos(angle), 0.5 + 0.4 * std::sin(angle) });
  }
  const double inner = 0.4 * std::cos(0.4 * kPi) / std::cos(0.2 * kPi);
  const double side = std::sqrt(0.16 + inner * inner - 0.8 * inner * std::cos(0.2 * kPi));
  expect_boundary({ polygon(corners) }, 10.0 * side);
  const PointInverter star = flat_with({ polygon(corners) });
  expect_foot(star.find({ 0.5, 0.5, 0.5 }), { 0.5, 0.5, 0 }, FootType::Interior, Status::Certified);
}

/// A closed cubic that crosses itself once: (t³ − t, t²) has its double point at t = ±1.
TEST(TrimCrossings, ACurveThatCrossesItself)
{
  Points points(3, 4); // for t in [−1.5, 1.5]
  points << -1.875, 3.875, -3.875, 1.875, /**/ 2.25, -0.75, -0.75, 2.25, /**/ 0, 0, 0, 0;
  TrimLoop loop;
  loop.curves = { std::make_shared<Curve>(KnotVector(3, { 0, 0, 0, 0, 1, 1, 1, 1 }), points),
    trims::polyline({ { 1.875, 2.25 }, { -1.875, 2.25 } }) };
  // Around the double point the loop keeps what is above it, or what is below. The larger part is
  // above it; where that is a hole, all around it is kept.
  const Surface surface = trims::flat(-3, 3, -3, 3);
  const bool above = TrimRegion({ loop }, surface, 0.0).contains(3, 5);
  const Face kept_above = trimmed(surface, { above ? loop : reversed(loop) });
  EXPECT_EQ(boundary(kept_above).undecided, 0);
  EXPECT_TRUE(kept_above.region->contains(3, 5));
  EXPECT_FALSE(kept_above.region->contains(3, 3.5));
  expect_foot(PointInverter({ kept_above }).find({ 0, 0.5, 0 }), { 0, 1, 0 }, FootType::Vertex,
    Status::Certified);
  const Face kept_below = trimmed(surface, { above ? reversed(loop) : loop });
  EXPECT_EQ(boundary(kept_below).undecided, 0);
  EXPECT_FALSE(kept_below.region->contains(3, 5));
  expect_foot(PointInverter({ kept_below }).find({ 0, 0, 0.1 }), { 0, 0, 0 }, FootType::Interior,
    Status::Certified);
}

TEST(TrimCrossings, SharedStretches)
{
  const TrimLoop all = rectangle(0.1, 0.1, 0.9, 0.9);
  // Two holes side by side: what they share bounds nothing.
  const std::vector<TrimLoop> holes{ all, reversed(rectangle(0.3, 0.3, 0.5, 0.7)),
    reversed(rectangle(0.5, 0.2, 0.7, 0.6)) };
  expect_boundary(holes, 3.2 + 2.0 * 1.2 - 2.0 * 0.3);
  expect_foot(flat_with(holes).find({ 0.5, 0.44, 0 }), { 0.5, 0.3, 0 }, FootType::Vertex,
    Status::Certified);
  // Two islands: the face goes on from one to the other.
  const std::vector<TrimLoop> islands{ rectangle(0.3, 0.3, 0.5, 0.7),
    rectangle(0.5, 0.2, 0.7, 0.6) };
  expect_boundary(islands, 2.0 * 1.2 - 2.0 * 0.3);
  expect_foot(flat_with(islands).find({ 0.5, 0.45, 1 }), { 0.5, 0.45, 0 }, FootType::Interior,
    Status::Certified);
  // An island that begins at the border of the hole, along half a circle.
  const TrimLoop disc = circle(0.5, 0.5, 0.3);
  TrimLoop half;
  const double w = std::sqrt(0.5);
  Points arc = Points::Zero(3, 5);
  arc.topRows<2>() << 0.5, 0.2, 0.2, 0.2, 0.5, 0.8, 0.8, 0.5, 0.2, 0.2;
  half.curves = { std::make_shared<Curve>(KnotVector(2, { 0, 0, 0, 1, 1, 2, 2, 2 }), arc,
                    Eigen::Matrix<double, 5, 1>(1.0, w, 1.0, w, 1.0)),
    trims::polyline({ { 0.5, 0.2 }, { 0.5, 0.8 } }) };
  const std::vector<TrimLoop> filled{ all, reversed(disc), half };
  expect_boundary(filled, 3.2 + 0.3 * kPi + 0.6);
  const PointInverter inverter = flat_with(filled);
  expect_foot(
    inverter.find({ 0.2, 0.5, 1 }), { 0.2, 0.5, 0 }, FootType::Interior, Status::Certified);
  expect_foot(inverter.find({ 0.6, 0.5, 0 }), { 0.5, 0.5, 0 }, FootType::Edge, Status::Certified);
}

/// The same circle as four quadratics, and turned by an eighth: other arcs along the same curve.
TEST(TrimCrossings, RepeatedLoops)
{
  const TrimLoop all = rectangle(0.1, 0.1, 0.9, 0.9);
  const TrimLoop disc = circle(0.5, 0.5, 0.25);
  TrimLoop turned = disc;
  {
    Points points = disc.curves[0]->local_control_points().colwise() + disc.curves[0]->centre();
    for (Eigen::Index k = 0; k < points.cols(); ++k)
    {
      const double x = points(0, k) - 0.5;
      const double y = points(1, k) - 0.5;
      points.col(k).head<2>() << 0.5 + std::sqrt(0.5) * (x - y), 0.5 + std::sqrt(0.5) * (x + y);
    }
    turned.curves = { std::make_shared<Curve>(
      disc.curves[0]->knots(), points, disc.curves[0]->weights()) };
  }
  for (const TrimLoop& second : { disc, turned })
  {
    // A hole twice, an island twice; an island that fills its hole.
    expect_boundary({ all, reversed(disc), reversed(second) }, 3.2 + 0.5 * kPi);
    expect_boundary({ disc, second }, 0.5 * kPi);
    expect_boundary({ all, reversed(disc), second }, 3.2);
    const Foot filled = flat_with({ all, reversed(disc), second }).find({ 0.75, 0.5, 1 });
    expect_foot(filled, { 0.75, 0.5, 0 }, FootType::Interior, Status::Certified);
    EXPECT_EQ(flat_with({ disc, second }).number_of_open_edges(), 1);
  }
}

TEST(TrimCrossings, LoopsThatBoundNothing)
{
  const TrimLoop all = rectangle(0.1, 0.1, 0.5, 0.9);
  // A hole beside the face, an island on it, a slit, and a line that leads away from it and back.
  expect_boundary({ all, reversed(circle(0.8, 0.5, 0.1)) }, 2.4);
  expect_boundary({ all, circle(0.3, 0.5, 0.1) }, 2.4);
  expect_boundary({ polygon({ { 0.1, 0.1 }, { 0.3, 0.1 }, { 0.3, 0.5 }, { 0.3, 0.1 }, { 0.5, 0.1 },
                    { 0.5, 0.9 }, { 0.1, 0.9 } }) },
    2.4);
  const std::vector<TrimLoop> led{ polygon({ { 0.1, 0.1 }, { 0.5, 0.1 }, { 0.5, 0.4 }, { 0.9, 0.4 },
    { 0.5, 0.4 }, { 0.5, 0.9 }, { 0.1, 0.9 } }) };
  expect_boundary(led, 2.4);
  expect_foot(flat_with(led).find({ 0.9, 0.4, 0 }), { 0.5, 0.4, 0 }, FootType::Vertex,
    Status::Certified);
  expect_foot(flat_with({ all, reversed(circle(0.8, 0.5, 0.1)) }).find({ 0.8, 0.5, 0 }),
    { 0.5, 0.5, 0 }, FootType::Edge, Status::Certified);
  expect_foot(flat_with({ all, circle(0.3, 0.5, 0.1) }).find({ 0.4, 0.5, 1 }), { 0.4, 0.5, 0 },
    FootType::Interior, Status::Certified);
  // A hole that is joined with the border by a line there and back.
  expect_boundary({ polygon({ { 0.1, 0.1 }, { 0.9, 0.1 }, { 0.9, 0.9 }, { 0.1, 0.9 }, { 0.1, 0.5 },
                    { 0.3, 0.5 }, { 0.3, 0.6 }, { 0.6, 0.6 }, { 0.6, 0.4 }, { 0.3, 0.4 },
                    { 0.3, 0.5 }, { 0.1, 0.5 } }) },
    3.2 + 1.0);
}

/// What touches without crossing bounds the face as it did.
TEST(TrimCrossings, LoopsThatTouch)
{
  const TrimLoop all = rectangle(0.0, 0.0, 1.0, 1.0);
  expect_boundary({ all, reversed(circle(0.25, 0.5, 0.25)), reversed(circle(0.625, 0.5, 0.125)) },
    4.0 + 0.75 * kPi);
  const std::vector<TrimLoop> inside{ circle(0.5, 0.5, 0.4), reversed(circle(0.6, 0.5, 0.3)) };
  expect_boundary(inside, 1.4 * kPi);
  const PointInverter inverter = flat_with(inside);
  expect_foot(inverter.find({ 0.95, 0.5, 0 }), { 0.9, 0.5, 0 }, FootType::Edge, Status::Certified);
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  expect_boundary({ circle(0.5, 0.5, 0.4), reversed(circle(0.5 + 0.1 * c, 0.5 + 0.1 * s, 0.3)) },
    1.4 * kPi);
}

/// Strips between two holes, down to what rounding leaves: there, nothing is proved.
TEST(TrimCrossings, StripsAsThinAsRounding)
{
  for (const double width : { 1e-6, 1e-9, 1e-12, 1e-13, 2e-15 })
  {
    SCOPED_TRACE(width);
    const Face face = trimmed(trims::flat(),
      { rectangle(0, 0, 1, 1), reversed(rectangle(0.3, 0.3, 0.5, 0.7)),
        reversed(rectangle(0.5 + width, 0.3, 0.7, 0.7)) });
    const bool thin = width < 1e-14;
    EXPECT_EQ(boundary(face).undecided, thin ? 2 : 0);
    const Foot foot = PointInverter({ face }).find({ 0.5 - 1e-4, 0.5, 0 });
    EXPECT_EQ(foot.status, thin ? Status::Converged : Status::Certified);
    EXPECT_NEAR(foot.distance, 1e-4, 1e-12);
    // Nothing of this matters where the foot lies elsewhere.
    EXPECT_EQ(PointInverter({ face }).find({ 0.35, 0.5, 0 }).status, Status::Certified);
  }
}

/// Lines over gaps of a few roundings have no sides of their own: they are edges where their
/// neighbours are.
TEST(TrimCrossings, GapsAsSmallAsRounding)
{
  for (const double gap : { 8e-15, 1.2e-14, 2e-14, 5e-14, 1e-12 })
  {
    SCOPED_TRACE(gap);
    TrimLoop loop;
    loop.curves = { trims::polyline({ { 0.1, 0.1 }, { 0.9 + gap, 0.1 } }),
      trims::polyline({ { 0.9, 0.1 }, { 0.9, 0.8 - gap } }),
      trims::polyline({ { 0.9 - gap, 0.8 }, { 0.1, 0.8 } }),
      trims::polyline({ { 0.1, 0.8 }, { 0.1, 0.1 } }) };
    const Face face = trimmed(trims::flat(), { loop });
    EXPECT_EQ(boundary(face).undecided, 0);
    const PointInverter inverter({ face });
    for (const double v : { 0.1, 0.8 })
    {
      const Foot foot = inverter.find({ 0.95, v < 0.5 ? 0.05 : 0.85, 0 });
      EXPECT_EQ(foot.status, Status::Certified);
      EXPECT_NEAR((foot.point - Vector3(0.9, v, 0)).norm(), 0.0, 1e-12 + 2.0 * gap);
    }
  }
}

// === Random faces

int number_from(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

trims::Point2 any_point(shapes::Random& random, double low, double high)
{
  return { random.uniform(low, high), random.uniform(low, high) };
}

/// One of several loops that cross themselves and, as likely as not, all others.
TrimLoop any_loop(shapes::Random& random)
{
  const trims::Point2 centre = any_point(random, 0.3, 0.7);
  const double radius = random.uniform(0.05, 0.3);
  switch (random.integer(0, 5))
  {
    case 0:
      return circle(centre[0], centre[1], radius);
    case 1:
      return trims::wave(
        centre[0], centre[1], 0.8 * radius, random.integer(1, 6), random.uniform(0.0, 0.2));
    case 2: // sides at the same few places as those of other loops
    {
      const auto place = [&] { return 0.125 * random.integer(1, 3); };
      const double u = place();
      const double v = place();
      return rectangle(u, v, u + place(), v + place());
    }
    case 3: // a polygon that may cross itself
    {
      std::vector<trims::Point2> corners;
      for (int k = random.integer(3, 7); k > 0; --k)
      {
        corners.push_back(any_point(random, 0.1, 0.9));
      }
      return polygon(corners);
    }
    case 4: // a smooth curve that may
    {
      const int count = random.integer(4, 8);
      Points points = Points::Zero(3, count + 3);
      for (int k = 0; k < count; ++k)
      {
        points.col(k).head<2>() = any_point(random, 0.1, 0.9);
      }
      points.rightCols(3) = points.leftCols(3).eval();
      TrimLoop loop;
      loop.curves = { std::make_shared<Curve>(
        KnotVector(3, shapes::uniform_knots(3, count)), points) };
      return loop;
    }
    default:
      return rectangle(centre[0] - radius, centre[1] - radius, centre[0] + radius, centre[1] + 0.2);
  }
}

std::vector<TrimLoop> any_loops(shapes::Random& random)
{
  std::vector<TrimLoop> loops;
  if (random.integer(0, 2) == 0)
  {
    loops.push_back(rectangle(0, 0, 1, 1));
  }
  for (int k = random.integer(1, 4); k > 0; --k)
  {
    const bool again = !loops.empty() && random.integer(0, 9) == 0;
    const TrimLoop loop = again ? loops.back() : any_loop(random);
    loops.push_back(random.integer(0, 1) == 0 ? loop : reversed(loop));
  }
  return loops;
}

TEST(TrimCrossings, RandomLoops)
{
  const int queries = number_from("FOOTPOINT_TRIM_QUERIES", kSlowBuild ? 1000 : 3000);
  shapes::Random random(static_cast<std::uint64_t>(number_from("FOOTPOINT_TRIM_SEED", 1)));
  judge::Tally tally;
  int faces = 0;
  int undecided = 0;
  constexpr int kOfFace = 25;
  for (int number = 0; static_cast<int>(tally.queries) < queries; ++number)
  {
    const std::vector<Surface> surfaces{ trims::flat(), shapes::bumpy(6, number), shapes::saddle(),
      trims::flat(0, 1, 0, 1, 3) };
    const Surface& surface = surfaces[static_cast<std::size_t>(random.integer(0, 3))];
    std::vector<TrimLoop> loops;
    for (const TrimLoop& loop : any_loops(random))
    {
      loops.push_back(trims::moved(surface, loop));
    }
    // A clockwise loop around all others would keep what is outside of it, as no winding number
    // says. Which loop is the largest may be a near tie: many corners tell.
    double largest = 0.0;
    for (const TrimLoop& loop : loops)
    {
      const double area = static_cast<double>(trims::area(trims::polygon_of(loop, 512)));
      largest = std::abs(area) > std::abs(largest) ? area : largest;
    }
    if (largest < 0.0)
    {
      loops.push_back(trims::moved(surface, rectangle(0, 0, 1, 1)));
    }
    try
    {
      const Face face = trimmed(surface, loops);
      undecided += boundary(face).undecided > 0;
      judge::Judge("loops " + std::to_string(number), { face }).ask(kOfFace, random, tally);
      ++faces;
    }
    catch (const footpoint::GeometryError& error)
    {
      EXPECT_NE(std::string(error.what()).find("keep nothing"), std::string::npos) << error.what();
    }
  }
  std::cout << faces << " faces, " << undecided
            << " of them with arcs that are undecided: " << tally << "\n";
  EXPECT_EQ(tally.wrong(), 0u);
  EXPECT_LE(static_cast<double>(tally.uncertified), 1.0 + 2e-3 * queries);
  EXPECT_LE(undecided, 1 + faces / 50);
}

} // namespace
