// SPDX-License-Identifier: BSD-3-Clause

// The nearest points of the faces of CAD files against an oracle by brute force and against Open
// CASCADE's BRepExtrema_DistShapeShape. Set in the environment
//   FOOTPOINT_CAD_QUERIES  how many queries the oracle judges; Open CASCADE a tenth
//   FOOTPOINT_TRIM_SEED    other queries: any number, 1 by default
//   FOOTPOINT_CAD_FILES    a folder with further files

#include "CADModels.h"
#include "FootJudge.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Message_ProgressRange.hxx>

#include <chrono>

namespace
{

using namespace cadtest;
using footpoint::Foot;
using footpoint::PointInverter;
using footpoint::Status;
using footpoint::Vector3;
using judge::Judge;
using judge::Tally;

int number_from(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

int queries()
{
  return number_from("FOOTPOINT_CAD_QUERIES", 4000);
}

std::uint64_t seed()
{
  return static_cast<std::uint64_t>(number_from("FOOTPOINT_TRIM_SEED", 1));
}

/// At most so many faces of a file are looked at in one run.
constexpr std::size_t kFaces = 24;

/// Neighbours in the file, from a random one on.
std::vector<CADFace> some_faces(const TopoDS_Shape& shape, shapes::Random& random)
{
  int left_out = 0;
  std::vector<TopoDS_Shape> all;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
  {
    all.push_back(at.Current());
  }
  std::vector<CADFace> result;
  const auto first =
    static_cast<std::size_t>(all.empty() ? 0 : random.integer(0, static_cast<int>(all.size()) - 1));
  for (std::size_t k = 0; k < std::min(kFaces, all.size()); ++k)
  {
    for (CADFace& face : faces_of(all[(first + k) % all.size()], left_out))
    {
      result.push_back(std::move(face));
    }
  }
  return result;
}

TopoDS_Shape shape_of(const std::string& file)
{
  try
  {
    return footpoint::cad::read_shape(file, Message_ProgressRange()).shape;
  }
  catch (const std::runtime_error&)
  {
    return {};
  }
  catch (const Standard_Failure&)
  {
    return {};
  }
}

TEST(CADFeet, NoPointIsNearerThanTheFoot)
{
  const std::vector<std::string> all = files();
  if (all.empty())
  {
    GTEST_SKIP() << "no CAD files: see FOOTPOINT_SHARED_DATA and the package occt-misc";
  }
  footpoint::cad::redirect_messages();
  Tally tally;
  shapes::Random random(seed());
  std::size_t models = 0;
  std::size_t faces = 0;
  const int share = queries() / static_cast<int>(all.size()) + 1;
  for (const std::string& file : all)
  {
    SCOPED_TRACE(short_name(file));
    const std::vector<CADFace> some = some_faces(shape_of(file), random);
    if (some.empty())
    {
      continue;
    }
    ++models;
    faces += some.size();
    Judge(short_name(file), model_of(some)).ask(share - share / 2, random, tally);
    for (int k = 0; k < 4; ++k)
    {
      const CADFace& one =
        some[static_cast<std::size_t>(random.integer(0, static_cast<int>(some.size()) - 1))];
      Judge(short_name(file) + ", one face", { one.face }).ask(share / 8 + 1, random, tally);
    }
  }
  std::cout << models << " models, " << faces << " faces: " << tally << "\n";
  EXPECT_EQ(tally.wrong(), 0u);
  EXPECT_LE(
    static_cast<double>(tally.uncertified), 1.0 + 1e-3 * static_cast<double>(tally.queries));
}

// === Open CASCADE

struct Comparison
{
  int queries = 0;
  int wrong = 0;
  int within_tolerance =
    0;                  ///< Open CASCADE's point is nearer, and outside our trims by the tolerance
  int no_answer = 0;    ///< of Open CASCADE
  int occt_invalid = 0; ///< its point is none of the face
  int occt_farther = 0; ///< by more than the tolerance
  double ours = 0.0;    ///< seconds
  double theirs = 0.0;
};

/// The largest tolerance of a face, its edges and vertices.
double tolerance_of(const CADFace& face)
{
  double tolerance = face.face.tolerance;
  for (TopExp_Explorer at(face.shape, TopAbs_VERTEX); at.More(); at.Next())
  {
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Vertex(at.Current())));
  }
  return tolerance;
}

void compare(const std::string& name, const CADFace& face, int count, shapes::Random& random,
  Comparison& comparison)
{
  using Clock = std::chrono::steady_clock;
  const footpoint::Model model{ face.face };
  const Judge judged(name, model);
  const PointInverter& inverter = judged.inverter();
  const double size = inverter.size();
  const double tolerance = tolerance_of(face);
  const auto& surface = *face.face.patches.front().surface;
  for (int k = 0; k < count; ++k)
  {
    const auto where =
      static_cast<judge::Where>(random.integer(0, static_cast<int>(judge::Where::Count) - 1));
    const Vector3 p = judge::query(judged.model(), judged.sizes(), 0, where, random);
    ++comparison.queries;
    const auto begin = Clock::now();
    const Foot foot = inverter.find(p);
    const auto middle = Clock::now();
    BRepExtrema_DistShapeShape extrema(
      BRepBuilderAPI_MakeVertex(gp_Pnt(p[0], p[1], p[2])).Vertex(), face.shape);
    comparison.ours += std::chrono::duration<double>(middle - begin).count();
    comparison.theirs += std::chrono::duration<double>(Clock::now() - middle).count();
    if (!extrema.IsDone() || extrema.NbSolution() == 0)
    {
      ++comparison.no_answer;
      continue;
    }
    const gp_Pnt found = extrema.PointOnShape2(1);
    const double distance = (Vector3(found.X(), found.Y(), found.Z()) - p).norm();
    double allowed =
      1e-12 * size + judge::kRounding * (p.norm() + distance) + face.converted.surface_error;
    // Edges and vertices of Open CASCADE are where they are up to the tolerance.
    bool trimmed_away = true;
    if (extrema.SupportTypeShape2(1) == BRepExtrema_IsInFace)
    {
      double u = 0.0;
      double v = 0.0;
      extrema.ParOnFaceS2(1, u, v);
      const BRepClass_FaceClassifier classifier(face.shape, gp_Pnt2d(u, v), 1e-9);
      const TopAbs_State state = classifier.State();
      TopLoc_Location location;
      const gp_Pnt there = BRep_Tool::Surface(face.shape)->Value(u, v);
      if ((state != TopAbs_IN && state != TopAbs_ON) || there.Distance(found) > 1e-9 * size)
      {
        ++comparison.occt_invalid;
        continue;
      }
      const double at[2] = { face.converted.map[0](u) - surface.direction(0).origin,
        face.converted.map[1](v) - surface.direction(1).origin };
      trimmed_away = face.face.region && !face.face.region->contains(at[0], at[1]);
    }
    allowed += trimmed_away ? tolerance : 0.0;
    const double excess = foot.distance - distance;
    comparison.occt_farther += excess < -(tolerance + 1e-9 * size);
    if (!(excess <= allowed))
    {
      ++comparison.wrong;
      ADD_FAILURE() << name << ": foot farther by " << excess / size << " of the size ("
                    << excess / tolerance << " tolerances), query " << judge::name_of(where) << " "
                    << std::setprecision(17) << p.transpose() << ", status "
                    << static_cast<int>(foot.status) << " at " << foot.parameter.transpose();
    }
    else if (excess > allowed - tolerance && trimmed_away)
    {
      ++comparison.within_tolerance;
    }
  }
}

TEST(CADFeet, NoPointOfOpenCascadeIsNearer)
{
  const std::vector<std::string> all = files();
  if (all.empty())
  {
    GTEST_SKIP() << "no CAD files: see FOOTPOINT_SHARED_DATA and the package occt-misc";
  }
  footpoint::cad::redirect_messages();
  shapes::Random random(seed() + 1);
  Comparison comparison;
  const int share = queries() / 10 / static_cast<int>(all.size()) + 1;
  for (const std::string& file : all)
  {
    const std::vector<CADFace> some = some_faces(shape_of(file), random);
    for (int k = 0; k < share && !some.empty(); k += 4)
    {
      const CADFace& one =
        some[static_cast<std::size_t>(random.integer(0, static_cast<int>(some.size()) - 1))];
      compare(short_name(file), one, std::min(4, share - k), random, comparison);
    }
  }
  const double count = std::max(comparison.queries, 1);
  std::cout << comparison.queries << " queries, " << comparison.wrong << " wrong, "
            << comparison.within_tolerance
            << " where Open CASCADE's point is nearer within the tolerance; Open CASCADE: "
            << comparison.no_answer << " without answer, " << comparison.occt_invalid
            << " not on the face, " << comparison.occt_farther << " farther; "
            << 1e6 * comparison.ours / count << " against " << 1e6 * comparison.theirs / count
            << " us a query\n";
  EXPECT_GT(comparison.queries, 0);
}

} // namespace
