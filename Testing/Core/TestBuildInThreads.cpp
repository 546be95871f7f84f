// SPDX-License-Identifier: BSD-3-Clause

// What an inverter is built from, by several threads: the same bits as by one, and the same errors.

#include "ClosedSolids.h"
#include "InThreads.h"
#include "Inversion.h"

#include "footpoint/search/box_tree.h"
#include "footpoint/search/distance_forms.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

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
  for (footpoint::Face& face : model)
  {
    face.region.reset(); // the inverter trims them
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
  face.loops = {
    { { trims::polyline({ { 0, 0 }, { 1, 0 } }), trims::polyline({ { 1 + gap, 0 }, { 0, 1 } }) } }
  };
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
  ASSERT_FALSE(first.is_prepared_for({}));
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

TEST(BuildInThreads, TreeHasEveryBoxOnceWithinItsAncestors)
{
  footpoint::AlignedVector<footpoint::Corners> boxes;
  const Points points = random_points(10000, 11, -1.0, 1.0);
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    boxes.push_back({ { points.col(k), points.col(k) + Vector3::Constant(0.01) } });
  }
  const BoxTree tree(boxes, in_threads(3));
  std::vector<int> visits(boxes.size(), 0);
  // Nodes, and the box that their parents have for them.
  std::vector<std::pair<std::int32_t, footpoint::Corners>> stack{ { 0,
    { { Vector3::Constant(-2.0), Vector3::Constant(2.0) } } } };
  while (!stack.empty())
  {
    const auto [index, around] = stack.back();
    stack.pop_back();
    const BoxTree::Node& node = tree.nodes()[index];
    for (int k = 0; k < BoxTree::kWidth; ++k)
    {
      if ((node.present >> k & 1U) == 0)
      {
        EXPECT_EQ(node.child[k], 0);
        continue;
      }
      footpoint::Corners box;
      for (int i = 0; i < 3; ++i)
      {
        box[0](i) = node.lower[i][k];
        box[1](i) = node.upper[i][k];
      }
      EXPECT_TRUE((box[0].array() >= around[0].array()).all());
      EXPECT_TRUE((box[1].array() <= around[1].array()).all());
      if (node.child[k] > 0)
      {
        stack.push_back({ node.child[k], box });
        continue;
      }
      const std::int32_t leaf = -1 - node.child[k];
      ++visits[leaf];
      EXPECT_TRUE((box[0].array() <= boxes[leaf][0].array()).all());
      EXPECT_TRUE((box[1].array() >= boxes[leaf][1].array()).all());
    }
  }
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 10000);
}

TEST(BuildInThreads, ExceptionsOfThreadsComeOut)
{
  // Threads of their own would end the program.
  const auto body = [](std::int64_t begin, std::int64_t)
  { throw std::runtime_error(begin == 0 ? "first" : "later"); };
  for (const Execution& execution : executions())
  {
    try
    {
      footpoint::for_ranges(execution, 50, 2, body);
      ADD_FAILURE() << "nothing came out";
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_STREQ(error.what(), "first");
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
  break_open(model[40], 0.25);
  const std::string message = error_of(model, {});
  EXPECT_NE(message, "");
  break_open(model[70], 0.5);
  EXPECT_EQ(error_of(model, {}), message);
  for (const Execution& execution : executions())
  {
    EXPECT_EQ(error_of(model, execution), message);
  }
  break_open(model[40], 0.5);
  EXPECT_NE(error_of(model, {}), message);
}

TEST(BuildInThreads, TheLeastFailureComesOutAndAllBeforeItAreVisited)
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
      footpoint::for_each_index(execution, 50, 7, visit); // all in one block
      ADD_FAILURE() << "nothing came out";
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_STREQ(error.what(), "12");
    }
    for (std::size_t k = 0; k < visits.size(); ++k)
    {
      EXPECT_LE(visits[k], 1) << k;
      EXPECT_TRUE(visits[k] == 1 || k > 12) << k;
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

namespace
{

/// Fractions that building a model tells; at the last of `calls` it is cancelled.
std::vector<double> told_while_building(const Model& model, std::size_t calls, bool& cancelled)
{
  std::vector<double> told;
  Execution execution = in_small_ranges();
  execution.proceed = [&told, calls](double fraction)
  {
    told.push_back(fraction);
    return told.size() < calls;
  };
  cancelled = false;
  try
  {
    const PointInverter inverter(model, {}, execution);
  }
  catch (const footpoint::Cancelled&)
  {
    cancelled = true;
  }
  return told;
}

} // namespace

TEST(BuildInThreads, TellsProgressAndIsCancelled)
{
  Model many;
  while (many.size() <= 8 * footpoint::kFacesForThreads)
  {
    const Model some = many_faces();
    many.insert(many.end(), some.begin(), some.end());
  }
  const Model large = model_of(shapes::bumpy(140, 5, 0.3));
  for (const Model& model : { many, large })
  {
    bool cancelled = false;
    const std::vector<double> told = told_while_building(model, 1000, cancelled);
    EXPECT_FALSE(cancelled);
    ASSERT_GE(told.size(), 8u);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_GT(told.front(), 0.0);
    EXPECT_LT(told.front(), told.back());
    EXPECT_GE(told.back(), 0.8); // where there are few pieces they are no long work
    EXPECT_LE(told.back(), 1.0);
    for (const std::size_t calls : { std::size_t{ 1 }, told.size() / 2, told.size() })
    {
      EXPECT_EQ(told_while_building(model, calls, cancelled).size(), calls);
      EXPECT_TRUE(cancelled) << calls;
    }
  }
}

TEST(BuildInThreads, ManyItemsAreTakenInBlocks)
{
  Execution execution = in_small_ranges();
  std::vector<double> told;
  execution.proceed = [&told](double fraction)
  {
    told.push_back(fraction);
    return true;
  };
  std::vector<int> visits(100, 0);
  footpoint::for_ranges(execution, 100, 5,
    [&visits](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t k = begin; k < end; ++k)
      {
        ++visits[k];
      }
    });
  EXPECT_EQ(visits, std::vector<int>(100, 1));
  EXPECT_EQ(told, (std::vector<double>{ 0.4, 0.8, 1.0 }));

  // What comes after a failure is left out.
  std::fill(visits.begin(), visits.end(), 0);
  EXPECT_THROW(footpoint::for_each_index(execution, 100, 5,
                 [&visits](std::int64_t k)
                 {
                   ++visits[k];
                   if (k == 45)
                   {
                     throw std::runtime_error("45");
                   }
                 }),
    std::runtime_error);
  EXPECT_EQ(std::count(visits.begin(), visits.begin() + 46, 1), 46);
  EXPECT_EQ(std::count(visits.begin() + 80, visits.end(), 1), 0);
}
