// SPDX-License-Identifier: BSD-3-Clause

// What an inverter is built from, by several threads: the same bits as by one, and the same errors.

#include "ClosedSolids.h"
#include "InThreads.h"
#include "Inversion.h"

#include "footpoint/search/box_tree.h"
#include "footpoint/search/distance_forms.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>

using namespace inversion;
using footpoint::BoxTree;
using footpoint::Execution;
using footpoint::Points;

namespace
{

std::vector<Execution> executions()
{
  return { in_small_ranges(), in_threads(3) };
}

/// Three rows of blocks, neighbours with a wall in common, and some that are round or have a hole.
Model many_faces()
{
  Model model;
  for (int k = 0; k < 12; ++k)
  {
    const double x = k / 3;
    const double y = k % 3;
    const std::vector<solids::Point2> corners{ { x, y }, { x + 1, y }, { x + 1, y + 1 },
      { x, y + 1 } };
    for (const footpoint::Face& face : solids::prism(corners, 1.0 + 0.1 * k))
    {
      model.push_back(face);
    }
  }
  for (const solids::Solid& solid : { solids::box_with_hole(), solids::cone() })
  {
    model.insert(model.end(), solid.faces.begin(), solid.faces.end());
  }
  return model;
}

/// Feet of points about a model and on its edges.
void expect_the_same(const Model& model, const Points& points)
{
  const PointInverter alone(model);
  for (const Execution& execution : executions())
  {
    const PointInverter shared(model, {}, execution);
    EXPECT_EQ(shared.size(), alone.size());
    EXPECT_EQ(shared.number_of_open_edges(), alone.number_of_open_edges());
    for (Eigen::Index k = 0; k < points.cols(); ++k)
    {
      EXPECT_TRUE(identical(shared.find(points.col(k)), alone.find(points.col(k)))) << k;
    }
  }
}

/// A face of the model whose second curve begins away from where the first one ends.
void break_open(footpoint::Face& face, double gap)
{
  face.loops = { { { trims::polyline({ { 0, 0 }, { 1, 0 } }),
    trims::polyline({ { 1 + gap, 0 }, { 0, 1 } }) } } };
  face.region.reset();
}

} // namespace

TEST(BuildInThreads, SheetsOfManyPiecesHaveTheSameFeet)
{
  const Model model =
    model_of(shapes::bumpy(60, 5, 0.3), shapes::torus(0.5, 0.2), shapes::bumpy(30, 7, 0.2));
  ASSERT_GT(57 * 57, footpoint::kPiecesForThreads);
  expect_the_same(model, random_points(400, 6, -0.5, 1.5));
}

TEST(BuildInThreads, ManyTrimmedFacesHaveTheSameFeetAndSigns)
{
  const Model model = many_faces();
  ASSERT_GT(static_cast<std::int64_t>(model.size()), footpoint::kFacesForThreads);
  Points points = random_points(300, 8, -2.0, 5.0);
  for (Eigen::Index k = 0; k < 100; ++k)
  {
    points(0, k) = std::round(points(0, k)); // above edges and corners
    points(1, k) = k % 2 == 0 ? std::round(points(1, k)) : points(1, k);
  }
  expect_the_same(model, points);
}

TEST(BuildInThreads, OptionsThatAskForMoreAreBuiltTheSame)
{
  footpoint::InversionOptions seeded;
  seeded.search = footpoint::Search::Seeded;
  const PointInverter first(many_faces(), seeded);
  const PointInverter alone = first.with_options({});
  const PointInverter shared = first.with_options({}, in_threads(2));
  const Points points = random_points(100, 9, -2.0, 5.0);
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    EXPECT_TRUE(identical(shared.find(points.col(k)), alone.find(points.col(k)))) << k;
  }
}

TEST(BuildInThreads, TreeIsTheSame)
{
  footpoint::AlignedVector<footpoint::Corners> boxes;
  const Points points = random_points(20000, 10, -1.0, 1.0);
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    boxes.push_back({ { points.col(k), points.col(k) + Vector3::Constant(0.01) } });
  }
  const BoxTree alone(boxes);
  for (const Execution& execution : executions())
  {
    const BoxTree shared(boxes, execution);
    ASSERT_EQ(shared.nodes().size(), alone.nodes().size());
    for (std::size_t k = 0; k < alone.nodes().size(); ++k)
    {
      const BoxTree::Node& a = alone.nodes()[k];
      const BoxTree::Node& b = shared.nodes()[k];
      EXPECT_EQ(a.present, b.present);
      EXPECT_TRUE(std::equal(a.child, a.child + BoxTree::kWidth, b.child));
      EXPECT_TRUE(std::equal(a.lower[0], a.lower[0] + 3 * BoxTree::kWidth, b.lower[0]));
      EXPECT_TRUE(std::equal(a.upper[0], a.upper[0] + 3 * BoxTree::kWidth, b.upper[0]));
    }
  }
}

TEST(BuildInThreads, TellsOfTheFirstBrokenFace)
{
  const auto error_of = [](const Model& model, const Execution& execution) -> std::string
  {
    try
    {
      const PointInverter inverter(model, {}, execution);
    }
    catch (const footpoint::GeometryError& error)
    {
      return error.what();
    }
    return "";
  };
  Model model = many_faces();
  break_open(model[9], 0.25);
  const std::string message = error_of(model, {});
  EXPECT_NE(message, "");
  break_open(model[21], 0.5);
  EXPECT_EQ(error_of(model, {}), message);
  for (const Execution& execution : executions())
  {
    EXPECT_EQ(error_of(model, execution), message);
  }
  break_open(model[9], 0.5);
  EXPECT_NE(error_of(model, {}), message);
}

TEST(BuildInThreads, IndicesAreVisitedOnceAndTheLeastFailureComesOut)
{
  for (const Execution& execution : executions())
  {
    std::vector<std::atomic<int>> visits(50);
    const auto visit = [&visits](std::int64_t k)
    {
      ++visits[k];
      if (k == 31 || k == 12 || k == 44)
      {
        throw std::runtime_error(std::to_string(k));
      }
    };
    try
    {
      footpoint::for_each_index(execution, 50, 2, visit);
      ADD_FAILURE() << "nothing came out";
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_STREQ(error.what(), "12");
    }
    for (const std::atomic<int>& count : visits)
    {
      EXPECT_EQ(count, 1);
    }
  }
}

TEST(BuildInThreads, FewItemsStayOnTheCallingThread)
{
  Execution never;
  never.parallel_for = [](std::int64_t, const std::function<void(std::int64_t, std::int64_t)>&)
  { ADD_FAILURE() << "threads for few items"; };
  int visited = 0;
  footpoint::for_each_index(never, 9, 10, [&visited](std::int64_t) { ++visited; });
  EXPECT_EQ(visited, 9);
  const PointInverter small(model_of(shapes::bumpy(12, 5, 0.3)), {}, never);
  EXPECT_EQ(small.find(Vector3(0.5, 0.5, 0.5)).status, footpoint::Status::Certified);
}
