// SPDX-License-Identifier: BSD-3-Clause

// Signed distances of the solids of CAD files against Open CASCADE's classifier of points and,
// where that disagrees, against rays through its exact faces. Set in the environment
//   FOOTPOINT_CAD_QUERIES  how many queries are made, half of them (4000 by default)
//   FOOTPOINT_TRIM_SEED    other queries: any number, 1 by default

#include "CADModels.h"
#include "FootJudge.h"

#include <gtest/gtest.h>

#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepIntCurveSurface_Inter.hxx>
#include <BRep_Tool.hxx>
#include <Message_ProgressRange.hxx>
#include <gp_Lin.hxx>

namespace
{

using namespace cadtest;
using footpoint::Foot;
using footpoint::PointInverter;
using footpoint::Vector3;

/// Larger solids take Open CASCADE too long.
constexpr std::size_t kMostFaces = 400;

int number_from(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

struct SolidTally
{
  int solids = 0;
  int open = 0; ///< with edges at which no face is found
  int queries = 0;
  int inside = 0;
  int wrong = 0;
  int classifier_wrong = 0; ///< rays say what we say, and the classifier the contrary
};

/// Rays from a point, and the part of them that has to tell the same.
constexpr int kRays = 400;
constexpr double kMostRays = 0.9;

/// What rays in all directions say of a point: the number of faces that each meets is odd inside. A
/// few pass an edge so near that they miss or meet both faces; the classifier relies on one ray.
enum class RayVerdict
{
  Inside,
  Outside,
  Unclear
};

RayVerdict cast_rays(const std::vector<CADFace>& faces, const Vector3& from)
{
  // Directions of their own, so that the queries stay the same.
  shapes::Random random(1);
  int inside = 0;
  for (int k = 0; k < kRays; ++k)
  {
    const Vector3 way = random.vector(-1.0, 1.0);
    const gp_Lin ray(gp_Pnt(from[0], from[1], from[2]), gp_Dir(way[0], way[1], way[2]));
    int met = 0;
    for (const CADFace& face : faces)
    {
      BRepIntCurveSurface_Inter meeting;
      for (meeting.Init(face.shape, ray, 1e-10); meeting.More(); meeting.Next())
      {
        met += meeting.W() > 0.0;
      }
    }
    inside += met % 2;
  }
  return inside >= kMostRays * kRays ? RayVerdict::Inside
    : inside <= (1.0 - kMostRays) * kRays ? RayVerdict::Outside
                                          : RayVerdict::Unclear;
}

/// About a point of an edge, a vertex or a face, at 1e-6 to 1 of the size of the face.
void ask(const std::string& name, const TopoDS_Shape& solid, const std::vector<CADFace>& faces,
  int count, shapes::Random& random, SolidTally& tally)
{
  const PointInverter inverter(model_of(faces));
  double tolerance = 0.0;
  for (const CADFace& face : faces)
  {
    tolerance = std::max(tolerance, face.face.tolerance);
  }
  BRepClass3d_SolidClassifier classifier(solid);
  for (int k = 0; k < count; ++k)
  {
    const CADFace& face =
      faces[static_cast<std::size_t>(random.integer(0, static_cast<int>(faces.size()) - 1))];
    const oracle::FaceOracle samples(
      dynamic_cast<const Surface&>(*face.face.patches.front().surface), face.face.loops);
    for (int i = 0; i < 8; ++i)
    {
      const bool on_rim = random.integer(0, 3) > 0 || samples.inside().empty();
      const Vector3 target =
        judge::any_of(on_rim ? samples.rims() : samples.inside(), random).point;
      const Vector3 at = target +
        std::pow(10.0, random.uniform(-6.0, 0.0)) * samples.size() * random.vector(-1.0, 1.0);
      const Foot foot = inverter.find(at);
      // Nearer than edges are exact there is no telling.
      if (!(foot.distance > 10.0 * tolerance + 1e-9 * inverter.size()))
      {
        continue;
      }
      classifier.Perform(gp_Pnt(at[0], at[1], at[2]), tolerance);
      if (classifier.State() != TopAbs_IN && classifier.State() != TopAbs_OUT)
      {
        continue;
      }
      const bool inside = classifier.State() == TopAbs_IN;
      ++tally.queries;
      tally.inside += inside;
      if ((foot.signed_distance < 0.0) == inside)
      {
        continue;
      }
      if (cast_rays(faces, at) == (inside ? RayVerdict::Outside : RayVerdict::Inside))
      {
        ++tally.classifier_wrong;
        std::cout << name << ": the classifier alone takes " << std::setprecision(17)
                  << at.transpose() << std::setprecision(6) << " for "
                  << (inside ? "inside" : "outside") << ", at " << foot.signed_distance << "\n";
      }
      else if (++tally.wrong <= 20)
      {
        ADD_FAILURE() << name << ": " << (inside ? "inside " : "outside ") << std::setprecision(17)
                      << at.transpose() << ", but signed distance " << foot.signed_distance
                      << " from face " << foot.face << ", type " << static_cast<int>(foot.type)
                      << ", size " << inverter.size() << ", tolerance " << tolerance;
      }
    }
  }
}

TEST(CADSigns, SolidsAgreeWithOpenCascade)
{
  const std::vector<std::string> all = files();
  if (all.empty())
  {
    GTEST_SKIP() << "no CAD files: see FOOTPOINT_SHARED_DATA and the package occt-misc";
  }
  footpoint::cad::redirect_messages();
  shapes::Random random(static_cast<std::uint64_t>(number_from("FOOTPOINT_TRIM_SEED", 1)) + 2);
  const int share =
    number_from("FOOTPOINT_CAD_QUERIES", 4000) / 16 / static_cast<int>(all.size()) + 1;
  SolidTally tally;
  for (const std::string& file : all)
  {
    TopoDS_Shape shape;
    try
    {
      shape = footpoint::cad::read_shape(file, Message_ProgressRange()).shape;
    }
    catch (const std::runtime_error&)
    {
      continue;
    }
    std::vector<TopoDS_Shape> of_file;
    for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next())
    {
      of_file.push_back(at.Current());
    }
    for (int k = 0; k < share && !of_file.empty(); k += 2)
    {
      const TopoDS_Shape& solid =
        of_file[static_cast<std::size_t>(random.integer(0, static_cast<int>(of_file.size()) - 1))];
      int left_out = 0;
      const std::vector<CADFace> faces = faces_of(solid, left_out);
      if (left_out > 0 || faces.empty() || faces.size() > kMostFaces)
      {
        continue;
      }
      ++tally.solids;
      const auto open = PointInverter(model_of(faces)).number_of_open_edges();
      if (open > 0)
      {
        ++tally.open;
        std::cout << short_name(file) << ": " << open << " open edges of " << faces.size()
                  << " faces\n";
        continue;
      }
      ask(short_name(file), solid, faces, 2, random, tally);
    }
  }
  std::cout << tally.solids << " solids, " << tally.open << " of them open; " << tally.queries
            << " queries, " << tally.inside << " inside, " << tally.wrong << " wrong, "
            << tally.classifier_wrong << " where the classifier is\n";
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_LE(tally.classifier_wrong, 1 + tally.queries / 1000);
  EXPECT_GT(tally.queries, 0);
}

} // namespace
