// SPDX-License-Identifier: BSD-3-Clause

// The nearest points of real and of random trimmed faces against an oracle by brute force: no foot
// is farther than a point of the face that the oracle finds, and every foot is a point of its face.
// Set in the environment
//   FOOTPOINT_TRIM_QUERIES  how many queries each test makes
//   FOOTPOINT_TRIM_SEED     other queries and random faces: any number, 1 by default

#include "FootJudge.h"
#include "RandomFaces.h"
#include "SlowBuild.h"
#include "TrimFaces.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace
{

using namespace judge;

constexpr int kQueries = kSlowBuild ? 300 : 4000;

int number_from(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

int queries()
{
  return number_from("FOOTPOINT_TRIM_QUERIES", kQueries);
}

std::uint64_t seed()
{
  return static_cast<std::uint64_t>(number_from("FOOTPOINT_TRIM_SEED", 1));
}

/// Nothing wrong, and hardly anything unproved.
void expect_right(const Tally& tally)
{
  std::cout << tally << "\n";
  EXPECT_EQ(tally.wrong(), 0u);
  EXPECT_GT(tally.queries, 0u);
  EXPECT_LE(
    static_cast<double>(tally.uncertified), 1.0 + 1e-3 * static_cast<double>(tally.queries));
}

std::vector<std::pair<std::string, footpoint::Face>> real()
{
  std::vector<std::pair<std::string, footpoint::Face>> result;
  for (const trims::RealFace& one : trims::real_faces())
  {
    footpoint::Face face;
    face.patches.push_back({ nullptr, one.surface });
    face.loops = one.loops;
    footpoint::trim(face);
    result.emplace_back(one.name, face);
  }
  return result;
}

TEST(TrimmedModels, RealFacesOneByOne)
{
  const auto faces = real();
  if (faces.empty())
  {
    GTEST_SKIP() << "FOOTPOINT_SHARED_DATA names no folder with trimmed faces";
  }
  Tally tally;
  shapes::Random random(seed());
  const int count = static_cast<int>(faces.size());
  for (int f = 0; f < count; ++f)
  {
    SCOPED_TRACE(faces[f].first);
    const int share = queries() * (f + 1) / count - queries() * f / count;
    Judge(faces[f].first, { faces[f].second }).ask(share, random, tally);
  }
  std::cout << count << " faces: ";
  expect_right(tally);
}

TEST(TrimmedModels, RealModels)
{
  const auto faces = real();
  if (faces.empty())
  {
    GTEST_SKIP() << "FOOTPOINT_SHARED_DATA names no folder with trimmed faces";
  }
  std::map<std::string, footpoint::Model> models;
  for (const auto& [name, face] : faces)
  {
    models[name.substr(0, name.find(':'))].push_back(face);
  }
  Tally tally;
  shapes::Random random(seed() + 1);
  for (const auto& [name, model] : models)
  {
    Judge(name, model).ask(queries() / static_cast<int>(models.size()), random, tally);
  }
  std::cout << models.size() << " models: ";
  expect_right(tally);
}

TEST(TrimmedModels, RandomFaces)
{
  Tally tally;
  shapes::Random random(seed() + 2);
  const int of_each = 100;
  for (int k = 0; k * of_each < queries(); ++k)
  {
    std::string name;
    const footpoint::Face face =
      trims::RandomFaces(1000 * seed() + static_cast<std::uint64_t>(k)).face(name);
    Judge("random face " + std::to_string(k) + ", " + name, { face }).ask(of_each, random, tally);
  }
  expect_right(tally);
}

TEST(TrimmedModels, RandomModels)
{
  Tally tally;
  shapes::Random random(seed() + 3);
  const int of_each = 400;
  for (int k = 0; k * of_each < queries(); ++k)
  {
    footpoint::Model model;
    std::string name;
    trims::RandomFaces faces(1000 * seed() + 500 + static_cast<std::uint64_t>(k));
    for (int f = 0; f < 8; ++f)
    {
      model.push_back(faces.face(name));
    }
    Judge("random model " + std::to_string(k), model).ask(of_each, random, tally);
  }
  expect_right(tally);
}

} // namespace
