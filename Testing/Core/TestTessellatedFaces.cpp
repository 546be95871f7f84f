// SPDX-License-Identifier: BSD-3-Clause
// Triangles of trimmed faces and of solids.
#include "ClosedSolids.h"
#include "RandomFaces.h"
#include "SlowBuild.h"
#include "TessellationChecks.h"
#include "TrimFaces.h"

#include "footpoint/trims/edge_curve.h"

#include <gtest/gtest.h>

using namespace footpoint;
using namespace tessellations;

namespace
{

const double kPi = std::acos(-1.0);

Model one(Face face)
{
  return { std::move(face) };
}

Face flat(const std::vector<TrimLoop>& loops)
{
  return solids::plane(Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), loops);
}

} // namespace

TEST(TessellatedFaces, SolidsAreClosed)
{
  const std::vector<double> volumes{ 6.0, 6e-3, 3.0, 2.0 * kPi, 0.5 * kPi, 16.0 - kPi, kPi / 6.0 };
  const std::vector<solids::Solid> all = solids::all();
  ASSERT_EQ(all.size(), volumes.size());
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    for (const double tolerance : { 3e-2, 1e-2, 1e-3, 1e-4 })
    {
      const Tessellation mesh = tessellate(all[k].faces, chord(tolerance, 0.5));
      EXPECT_TRUE(mesh.problems.empty()) << all[k].name;
      const Counts counts = count(all[k].faces, mesh);
      EXPECT_EQ(counts.open, 0) << all[k].name << ", " << tolerance;
      EXPECT_EQ(counts.degenerate, 0) << all[k].name << ", " << tolerance;
      // The triangles' volume differs by no more than area times tolerance.
      EXPECT_NEAR(counts.volume, volumes[k], 1.1 * counts.area * mesh.tolerance) << all[k].name;
      if (tolerance >= 1e-3)
      {
        EXPECT_LE(largest_distance(all[k].faces, mesh, mesh.tolerance, 3), mesh.tolerance)
          << all[k].name;
      }
    }
  }
}

TEST(TessellatedFaces, AreasOfPlaneFaces)
{
  const TrimLoop all = trims::rectangle(0, 0, 1, 1);
  const std::vector<std::pair<std::vector<TrimLoop>, double>> faces{
    { { all }, 1.0 },
    { { all, trims::reversed(trims::circle(0.5, 0.5, 0.3)) }, 1.0 - 0.09 * kPi },
    { { all, trims::reversed(trims::circle(0.5, 0.5, 0.3)), trims::circle(0.5, 0.5, 0.2),
        trims::reversed(trims::circle(0.5, 0.5, 0.1)) },
      1.0 - 0.06 * kPi },
    { { trims::circle(0.5, 0.5, 0.25), trims::circle(1.5, 0.5, 0.25) }, 0.125 * kPi },
    { { trims::reversed(trims::polygon({ { 0.4, 0.4 }, { 0.6, 0.4 }, { 0.5, 0.6 } })), all },
      1.0 - 0.02 },
    { { trims::polygon({ { 0, 0 }, { 1, 1e-4 }, { 1, 2e-4 }, { 0, 1e-4 } }) }, 1e-4 },
  };
  for (const auto& [loops, area] : faces)
  {
    TessellationOptions options = chord(1e-6);
    options.absolute = true;
    const Model model = one(flat(loops));
    const Tessellation mesh = tessellate(model, options);
    EXPECT_TRUE(mesh.problems.empty());
    const Counts counts = count(model, mesh);
    // Chords along edges cut off no more than their length times the tolerance.
    EXPECT_NEAR(counts.area, area, 6e-6 * std::min(1.0, 1e3 * area));
    EXPECT_GT(counts.least_parameter_area, 0.0);
  }
}

TEST(TessellatedFaces, LoopsAroundASeam)
{
  // Of a cylinder of radius 1 and height 2 a band between two circles, given without and with the
  // seam.
  const Surface cylinder = shapes::revolve(
    { 0, 0, 2, 2 }, 1, shapes::points({ { 1, 0, 0 }, { 1, 0, 2 } }), Eigen::Vector2d(1, 1));
  const double end = cylinder.direction(0).length;
  const double quarter = 0.25 * end;
  const auto line = [](double u0, double v0, double u1, double v1) {
    return trims::polyline({ { u0, v0 }, { u1, v1 } });
  };
  const std::vector<std::vector<TrimLoop>> kinds{ { { { line(0, 0.5, end, 0.5) } },
                                                    { { line(end, 1.5, 0, 1.5) } } },
    { { { line(0, 0.5, end, 0.5), line(end, 0.5, end, 1.5), line(end, 1.5, 0, 1.5),
      line(0, 1.5, 0, 0.5) } } },
    // A window across the seam.
    { { { line(-quarter, 0.5, quarter, 0.5), line(quarter, 0.5, quarter, 1.5),
      line(quarter, 1.5, -quarter, 1.5), line(-quarter, 1.5, -quarter, 0.5) } } } };
  for (std::size_t k = 0; k < kinds.size(); ++k)
  {
    Face face = solids::whole(cylinder);
    face.loops = kinds[k];
    trim(face);
    const Model model = one(face);
    const Tessellation mesh = tessellate(model, chord(1e-4));
    EXPECT_TRUE(mesh.problems.empty()) << k;
    const double area = k == 2 ? kPi : 2.0 * kPi; // a window over half a turn
    EXPECT_NEAR(count(model, mesh).area, area, 1e-3) << k;
    // Along the seam the mesh hangs together: what is open are the loops.
    int along_seam = 0;
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    {
      along_seam += mesh.parameters(0, i) == 0.0 || mesh.parameters(0, i) == end;
    }
    EXPECT_GT(along_seam, 0) << k;
    double boundary = 0.0; // of both circles, or of the window
    std::map<std::array<double, 6>, int> edges;
    for (const auto& t : mesh.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        Vector3 a = mesh.points.col(t[i]) + Vector3::Zero();
        Vector3 b = mesh.points.col(t[(i + 1) % 3]) + Vector3::Zero();
        const bool swap = std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end());
        swap ? a.swap(b) : void();
        edges[{ { a.x(), a.y(), a.z(), b.x(), b.y(), b.z() } }] += swap ? -1 : 1;
      }
    }
    for (const auto& [edge, n] : edges)
    {
      boundary +=
        n == 0 ? 0.0 : Vector3(edge[3] - edge[0], edge[4] - edge[1], edge[5] - edge[2]).norm();
    }
    EXPECT_NEAR(boundary, k == 2 ? 2.0 * kPi + 2.0 : 4.0 * kPi, 1e-2) << k;
  }
}

TEST(TessellatedFaces, RandomFaces)
{
  constexpr int kFaces = kSlowBuild ? 40 : 120;
  int triangulated = 0;
  for (int seed = 0; seed < kFaces; ++seed)
  {
    trims::RandomFaces random(static_cast<std::uint64_t>(seed));
    std::string name;
    const Model model = one(random.face(name));
    name = std::to_string(seed) + ": " + name;
    const Tessellation mesh = tessellate(model, chord(2e-3, 0.5));
    for (const TessellationProblem& problem : mesh.problems)
    {
      // Strips thinner than borders are sewn.
      EXPECT_NE(problem.message.find("thinner"), std::string::npos)
        << name << ": " << problem.message;
    }
    triangulated += mesh.problems.empty();
    const Surface& surface = dynamic_cast<const Surface&>(*model[0].patches[0].surface);
    const Counts counts = count(model, mesh);
    EXPECT_EQ(counts.degenerate, 0) << name;
    EXPECT_GT(counts.least_parameter_area, 0.0) << name;
    EXPECT_LE(largest_distance(model, mesh, mesh.tolerance, 3), mesh.tolerance) << name;
    // Middles of triangles are kept, but for those within the tolerance of an edge.
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    {
      const auto& t = mesh.triangles[k];
      const Parameter<2> middle = surface.to_local(
        (mesh.parameters.col(t[0]) + mesh.parameters.col(t[1]) + mesh.parameters.col(t[2])) / 3.0);
      if (!model[0].region->contains(middle[0], middle[1]))
      {
        const Vector3 point = surface.point(middle);
        double least = std::numeric_limits<double>::infinity();
        for (const auto& edge :
          edge_curves(std::make_shared<Surface>(surface), *model[0].region, EdgeArcs::NoSeams))
        {
          for (int i = 0; i <= 400; ++i)
          {
            const Parameter<1> at(edge->direction(0).length * i / 400.0);
            least = std::min(least, (edge->point(at) - point).norm());
          }
        }
        EXPECT_LE(least, 0.02 * surface.size()) << name;
      }
    }
  }
  EXPECT_GE(triangulated, kFaces - 2);
}

TEST(TessellatedFaces, RealFaces)
{
  const std::vector<trims::RealFace> faces = trims::real_faces();
  if (faces.empty())
  {
    GTEST_SKIP() << "FOOTPOINT_SHARED_DATA is not set or has no json";
  }
  for (const trims::RealFace& real : faces)
  {
    Face face;
    face.patches.push_back({ nullptr, real.surface });
    face.loops = real.loops;
    trim(face);
    const Model model = one(face);
    const Tessellation mesh = tessellate(model, chord(1e-3, 0.5));
    EXPECT_TRUE(mesh.problems.empty()) << real.name << ": " << mesh.problems[0].message;
    const Counts counts = count(model, mesh);
    EXPECT_GT(counts.area, 0.0) << real.name;
    // Kept by the loops, by counting points of a grid in the plane of parameters; triangles at
    // poles have no area in space and are left out.
    int kept = 0;
    constexpr int kGrid = 200;
    for (int j = 0; j < kGrid; ++j)
    {
      for (int i = 0; i < kGrid; ++i)
      {
        kept += face.region->contains((i + 0.5) / kGrid * real.surface->direction(0).length,
          (j + 0.5) / kGrid * real.surface->direction(1).length);
      }
    }
    bool pole = false;
    for (int i = 0; i < 2; ++i)
    {
      pole =
        pole || real.surface->direction(i).collapsed[0] || real.surface->direction(i).collapsed[1];
    }
    if (!pole)
    {
      EXPECT_NEAR(counts.parameter_area, kept / static_cast<double>(kGrid * kGrid), 0.015)
        << real.name;
    }
  }
}

TEST(TessellatedFaces, LoopsThatCrossAreNamed)
{
  // A figure of eight cannot be triangulated; the square beside it is.
  const Model model{ flat({ trims::polygon({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 0.9 } }) }),
    flat({ trims::rectangle(2, 2, 3, 3) }) };
  const Tessellation mesh = tessellate(model, chord(1e-3));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  ASSERT_EQ(mesh.problems.size(), 1u);
  EXPECT_EQ(mesh.problems[0].face, 0u);
  EXPECT_NE(mesh.problems[0].message.find("cross"), std::string::npos);
}
