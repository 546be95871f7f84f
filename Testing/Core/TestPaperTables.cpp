// SPDX-License-Identifier: BSD-3-Clause
//
// The tables and examples of the paper, iteration for iteration.

#include "PaperExamples.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>
#include <vector>

namespace
{

using namespace footpoint;
using namespace paper;

enum Column
{
  NR,
  Hu,
  First,
  M1,
  M2,
  M3
};

/// The number of parameters visited, or x where the foot was not reached.
std::string count(const Example& example, double start, const SolverOptions& options,
  const Step<1>& step, double* end = nullptr)
{
  const auto foot = find_local_foot<1>(
    example.curve, example.query - example.curve.centre(), Parameter<1>(start), options, step);
  if (end)
  {
    *end = foot.parameter(0);
  }
  const bool ended =
    foot.termination != Termination::IterationLimit && foot.termination != Termination::Stagnation;
  const bool there = std::abs(foot.parameter(0) - example.foot) < 1e-3;
  return ended && there ? std::to_string(foot.iterations) : "x";
}

std::string count(const Example& example, double start, Method method, double tolerance)
{
  return count(example, start, bare_options(method, tolerance), make_step<1>(method));
}

Step<1> printed_step(const Example& example, int column)
{
  switch (column)
  {
    case Hu:
      return printed_circle_step(example.curve, example.query);
    case First:
      return printed_first_order(example.curve, example.query);
    case M1:
      return printed_method_1(example.curve, example.query);
    default:
      return printed_method_3(example.curve, example.query);
  }
}

/// Why a cell may differ.
const char* reason(int column)
{
  switch (column)
  {
    case First:
      return "published step is divided by |c'| twice; undivided, |kappa Pn.n| = 1.26 > 1 repels";
    case Hu:
    case M1:
      return "published step cancels (Q - c under a root); ours is formed in the frame (t, n)";
    default:
      return "unexplained";
  }
}

void print_header(const char* corner, std::initializer_list<const char*> names, int width)
{
  std::printf("%s", corner);
  for (const char* name : names)
  {
    std::printf("%*s", width, name);
  }
  std::printf("\n");
}

TEST(PaperTables, FootOfTheFirstExample)
{
  const Example example = first_example();
  const auto foot =
    find_local_foot<1>(example.curve, example.query - example.curve.centre(), Parameter<1>(0.2));
  EXPECT_TRUE(foot.converged);
  EXPECT_NEAR(foot.parameter(0), 0.20301655993621742, 1e-15);
  EXPECT_NEAR(foot.distance, 1.7099863613486435, 1e-14);
}

/// Tables 1 to 3: every cell printed, every difference listed; N-R, M2 and M3 agree in all 99
/// cells, Hu and M1 in tables 1 and 2.
TEST(PaperTables, FirstExample)
{
  const Example example = first_example();
  for (std::size_t k = 0; k < kTolerances.size(); ++k)
  {
    const double tolerance = kTolerances[k];
    std::printf("\nTable %zu: tolerance %g. In each cell: published, ours\n", k + 1, tolerance);
    print_header("   t ", { "N-R", "Hu's", "1st", "M1", "M2", "M3" }, 9);
    std::vector<std::string> differences;
    for (int row = 0; row < kRows; ++row)
    {
      const double start = row / 10.0;
      std::printf("%4.1f ", start);
      for (int column = 0; column < kColumns; ++column)
      {
        const std::string published = kPublished[k][row][column];
        const std::string ours = count(example, start, kMethods[column], tolerance);
        std::printf("%5s%4s", published.c_str(), ours.c_str());
        const bool agrees =
          column == NR || column == M2 || column == M3 || (column != First && tolerance > 1e-12);
        if (agrees)
        {
          EXPECT_EQ(ours, published) << kNames[column] << " from " << start << " to " << tolerance;
        }
        if (ours != published)
        {
          differences.push_back(std::string(kNames[column]) + " from " +
            std::to_string(start).substr(0, 3) + ": published " + published + ", ours " + ours +
            ": " + reason(column));
        }
      }
      std::printf("\n");
    }
    std::printf("%zu of 66 cells differ\n", differences.size());
    for (const std::string& difference : differences)
    {
      std::printf("  %s\n", difference.c_str());
    }
  }
}

/// With the steps as printed the three other columns come out as well, x included; ours of Hu and
/// M1 converge from every start to every tolerance.
TEST(PaperTables, PrintedFormulas)
{
  const Example example = first_example();
  std::printf("\nIn each cell: published, printed formula in absolute coordinates, ours\n");
  print_header("tolerance   t", { "Hu's", "1st", "M1" }, 15);
  for (std::size_t k = 0; k < kTolerances.size(); ++k)
  {
    for (int row = 0; row < kRows; ++row)
    {
      const double start = row / 10.0;
      std::printf("%9g %3.1f", kTolerances[k], start);
      for (const int column : { Hu, First, M1 })
      {
        const std::string published = kPublished[k][row][column];
        const std::string printed = count(example, start,
          bare_options(kMethods[column], kTolerances[k]), printed_step(example, column));
        const std::string ours = count(example, start, kMethods[column], kTolerances[k]);
        std::printf("%7s%4s%4s", published.c_str(), printed.c_str(), ours.c_str());
        EXPECT_EQ(printed, published) << kNames[column] << " from " << start;
        EXPECT_EQ(ours == "x", column == First) << kNames[column] << " from " << start;
      }
      std::printf("\n");
    }
  }
}

/// Why the projection onto the tangent, taken in full, cannot arrive at this foot: the derivative
/// of t + along / |c'| there is kappa Pn.n.
TEST(PaperTables, FirstOrderIsRepelledByTheFoot)
{
  const Example example = first_example();
  const auto frame = make_frame<1>(example.curve, example.query - example.curve.centre(),
    Parameter<1>(example.foot), Sides<1>::Constant(Side::Right));
  const double factor = 1.0 - frame.hessian()(0, 0) / frame.metric()(0, 0);
  EXPECT_NEAR(factor, -1.26, 0.005);
}

/// The paper: t = 0.54652; from 0.4 the first-order method always fails, N-R and M2 alone find the
/// foot to all tolerances, N-R in more iterations than M2.
TEST(PaperTables, SecondExample)
{
  const Example example = second_example();
  const auto foot =
    find_local_foot<1>(example.curve, example.query - example.curve.centre(), Parameter<1>(0.54));
  EXPECT_NEAR(foot.parameter(0), 0.54652, 5e-6);

  std::printf("\nSecond example from t = 0.4; with *: the printed formulas\n");
  print_header(
    "tolerance", { "N-R", "Hu's", "1st", "M1", "M2", "M3", "Hu's*", "1st*", "M1*", "M3*" }, 6);
  for (const double tolerance : kTolerances)
  {
    std::printf("%9g", tolerance);
    std::array<std::string, kColumns> ours;
    for (int column = 0; column < kColumns; ++column)
    {
      ours[column] = count(example, 0.4, kMethods[column], tolerance);
      std::printf("%6s", ours[column].c_str());
      EXPECT_NE(ours[column], "x");
    }
    EXPECT_GE(std::stoi(ours[NR]), std::stoi(ours[M2]));
    for (const int column : { Hu, First, M1, M3 })
    {
      const std::string printed = count(
        example, 0.4, bare_options(kMethods[column], tolerance), printed_step(example, column));
      std::printf("%6s", printed.c_str());
      EXPECT_EQ(printed == "x", column == First || tolerance < 1e-8) << kNames[column];
    }
    std::printf("\n");
  }
  std::printf(
    "  1st: published x, as is the printed step divided by |c'| twice; ours converges\n"
    "  Hu's, M1, M3: published x somewhere, as printed at 1e-12; ours keeps the digits\n");
}

/// Whether an orthogonal foot was reached.
bool orthogonal(const LocalFoot<1>& foot)
{
  const double t = foot.parameter(0);
  return foot.termination != Termination::IterationLimit && t > 0.0 && t < 1.0 &&
    foot.residual <= 1e-4 * foot.distance;
}

/// The paper projects 20 random points onto the first curve and counts the feet that each method
/// finds; points and starts are not given. Ours: points of the curve's box that have an orthogonal
/// foot at all, start in the middle, tolerance 1e-8.
TEST(PaperTables, TwentyRandomPoints)
{
  const Curve curve = first_example().curve;
  shapes::Random random(1);
  std::array<int, kColumns> bare{};
  std::array<int, kColumns> printed{};
  std::array<int, kColumns> guarded{};
  for (int points = 0; points < 20;)
  {
    const double x = random.uniform(-2.0, 6.0);
    const Example example{ curve, { x, random.uniform(-4.0, 4.0), 0.0 }, 0.0 };
    const Vector3 query = example.query - curve.centre();
    bool exists = false;
    for (int i = 0; i <= 20; ++i)
    {
      exists = exists || orthogonal(find_local_foot<1>(curve, query, Parameter<1>(i / 20.0)));
    }
    points += exists ? 1 : 0;
    for (int column = 0; exists && column < kColumns; ++column)
    {
      const Parameter<1> start(0.5);
      SolverOptions options = bare_options(kMethods[column], 1e-8);
      bare[column] += orthogonal(find_local_foot<1>(curve, query, start, options));
      printed[column] += column != NR && column != M2 &&
        orthogonal(find_local_foot<1>(curve, query, start, options, printed_step(example, column)));
      options = {};
      options.method = kMethods[column];
      guarded[column] += find_local_foot<1>(curve, query, start, options).converged;
    }
  }
  std::printf("\n");
  print_header("20 random points", { "N-R", "Hu's", "1st", "M1", "M2", "M3" }, 6);
  std::printf("published           20    19    12    20    20    14\n");
  const auto print = [](const char* name, const std::array<int, kColumns>& numbers)
  {
    std::printf("%-16s", name);
    for (const int number : numbers)
    {
      std::printf("%6d", number);
    }
    std::printf("\n");
  };
  print("ours, bare", bare);
  printed[NR] = bare[NR];
  printed[M2] = bare[M2];
  print("as printed", printed);
  print("ours, guarded", guarded);
  // The order of the methods, not the numbers: other points, other numbers.
  for (const int column : { NR, Hu, M1, M2 })
  {
    EXPECT_GE(bare[column], 18) << kNames[column];
    EXPECT_LT(bare[M3], bare[column]);
    EXPECT_LT(bare[First], bare[column]);
  }
  EXPECT_EQ(bare[M1], bare[M2]);
  for (const int number : guarded)
  {
    EXPECT_EQ(number, 20);
  }
}

} // namespace
