// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/tessellation.h"

#include "footpoint/model/evaluation.h"
#include "footpoint/model/face_neighbours.h"
#include "footpoint/tessellation/curve_samples.h"
#include "footpoint/tessellation/patch_triangulation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace footpoint
{
namespace
{

/// How far progress is when these steps begin.
constexpr double kAtJoining = 0.3;
constexpr double kAtTriangles = 0.4;
constexpr double kAtPoints = 0.8;

/// How often faces whose sampled edges cross each other are tried again with shorter chords.
constexpr int kAttempts = 8;

/// Gaps in loops up to this part of the tolerance become one point.
constexpr double kSmallGap = 0.1;

/// Patches that are triangulated between two looks at whether to go on.
constexpr std::size_t kBlock = 64;

/// A patch of a face on its way.
struct Work
{
  std::size_t face;
  const Patch* patch;
  bool reversed;
  const TrimRegion* region;
  double tolerance; ///< of the face
  std::optional<SurfaceBounds> bounds{};
  std::vector<SurfaceCells> cells{};
  std::vector<TrimEdge> boundary{};
  std::vector<std::size_t> edges{}; ///< among those of all patches
  PatchMesh mesh{};
  bool done = false;
  std::vector<std::vector<CurvePlace>> lines{};
  std::string problem{};
};

/// A point of the result before it is evaluated.
struct Vertex
{
  std::size_t work;
  Parameter<2> place;
  Sides<2> sides;
  int node; ///< its position; −1: that of the place
};

double size_of(const Model& model)
{
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = -lower;
  const auto add = [&](const auto& geometry)
  {
    const Points& points = geometry.local_control_points();
    lower = lower.cwiseMin(geometry.centre() + points.rowwise().minCoeff());
    upper = upper.cwiseMax(geometry.centre() + points.rowwise().maxCoeff());
  };
  for (const Face& face : model)
  {
    for (const Patch& patch : face.patches)
    {
      if (const auto* curve = dynamic_cast<const Curve*>(patch.curve.get()))
      {
        add(*curve);
      }
      if (const auto* surface = dynamic_cast<const Surface*>(patch.surface.get()))
      {
        add(*surface);
      }
    }
  }
  return (lower.array() <= upper.array()).all() ? (upper - lower).stableNorm() : 0.0;
}

void check(const TessellationOptions& options)
{
  const auto refuse = [](const char* name, double value, const char* wanted) {
    throw std::invalid_argument(
      std::string(name) + " = " + std::to_string(value) + "; " + wanted);
  };
  const bool adaptive = options.mode == TessellationMode::Adaptive;
  if (adaptive && !(options.chord_tolerance > 0.0 && std::isfinite(options.chord_tolerance)))
  {
    refuse("ChordTolerance", options.chord_tolerance, "a number above 0 is needed");
  }
  if (adaptive && !(options.angle_tolerance >= 0.0 && std::isfinite(options.angle_tolerance)))
  {
    refuse("AngleTolerance", options.angle_tolerance, "an angle, 0 or more, is needed");
  }
  if (!adaptive && (options.resolution < 1 || options.resolution > 10000))
  {
    refuse("Resolution", options.resolution, "1 to 10000 segments a knot span are possible");
  }
}

class Tessellator
{
public:
  Tessellator(const Model& model, const TessellationOptions& options, const Execution& execution)
    : Run(execution)
    , Size(size_of(model))
  {
    check(options);
    this->Rule.adaptive = options.mode == TessellationMode::Adaptive;
    this->Rule.tolerance =
      options.absolute ? options.chord_tolerance : options.chord_tolerance * this->Size;
    this->Rule.angle = options.angle_tolerance;
    this->Rule.resolution = options.resolution;
    for (std::size_t k = 0; k < model.size(); ++k)
    {
      for (const Patch& patch : model[k].patches)
      {
        this->Works.push_back(
          { k, &patch, model[k].reversed, model[k].region.get(), model[k].tolerance });
      }
    }
  }

  Tessellation run()
  {
    Tessellation result;
    result.tolerance = this->Rule.adaptive ? this->Rule.tolerance : 0.0;
    result.cancelled =
      !(this->prepare() && this->triangulate() && this->evaluate(result));
    if (result.cancelled)
    {
      result = {};
      result.cancelled = true;
    }
    return result;
  }

private:
  void each(std::size_t count, const std::function<void(std::size_t)>& body) const
  {
    this->Run.parallel_for(static_cast<std::int64_t>(count),
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t k = begin; k < end; ++k)
        {
          body(static_cast<std::size_t>(k));
        }
      });
  }

  bool prepare();
  bool triangulate();
  bool evaluate(Tessellation& result);
  void triangulate(Work& work, const EdgeJoining& joining) const;
  void add_triangles(
    std::size_t index, std::vector<Vertex>& vertices, Tessellation& result) const;
  void fill_missing_normals(Tessellation& result) const;

  const Execution& Run;
  double Size;
  SamplingRule Rule;
  std::vector<Work> Works;
  std::vector<PatchEdge> Edges;
  std::vector<Vector3> Nodes;
};

/// Bounds of all pieces, then cells and edges of all patches.
bool Tessellator::prepare()
{
  struct Row
  {
    std::size_t work;
    std::size_t row;
  };
  std::vector<Row> rows;
  for (std::size_t k = 0; k < this->Works.size(); ++k)
  {
    Work& work = this->Works[k];
    if (work.patch->surface)
    {
      try
      {
        work.bounds.emplace(*work.patch->surface);
        for (std::size_t row = 0; row < work.bounds->rows(); ++row)
        {
          rows.push_back({ k, row });
        }
      }
      catch (const GeometryError& error)
      {
        work.problem = error.what();
      }
    }
  }
  this->each(rows.size(),
    [&](std::size_t k) { this->Works[rows[k].work].bounds->prepare_row(rows[k].row); });
  if (!this->Run.proceed(0.5 * kAtJoining))
  {
    return false;
  }
  this->each(this->Works.size(),
    [&](std::size_t k)
    {
      Work& work = this->Works[k];
      if (work.bounds && this->Rule.tolerance > 0.0)
      {
        work.cells = divide(*work.bounds, work.region, this->Rule);
        work.boundary = boundary_edges(work.bounds->surface(), work.region);
      }
      else if (const auto* curve = dynamic_cast<const Curve*>(work.patch->curve.get()))
      {
        work.lines = curve_samples(*curve, this->Rule);
      }
      else if (work.patch->curve)
      {
        work.problem = "it is no NURBS curve, and only those have bounds";
      }
    });
  return this->Run.proceed(kAtJoining);
}

bool Tessellator::triangulate()
{
  for (std::size_t k = 0; k < this->Works.size(); ++k)
  {
    Work& work = this->Works[k];
    for (TrimEdge& edge : work.boundary)
    {
      work.edges.push_back(this->Edges.size());
      this->Edges.push_back(
        { static_cast<int>(k), &*work.bounds, work.tolerance, std::move(edge) });
    }
    work.boundary.clear();
  }
  EdgeJoining joining(
    this->Edges, kSewing * this->Size, kSmallGap * this->Rule.tolerance);
  for (int attempt = 0; attempt < kAttempts; ++attempt)
  {
    joining.sample(this->Rule, this->Run);
    std::vector<std::size_t> waiting;
    for (std::size_t k = 0; k < this->Works.size(); ++k)
    {
      if (this->Works[k].bounds && this->Works[k].problem.empty() && !this->Works[k].done)
      {
        waiting.push_back(k);
      }
    }
    for (std::size_t begin = 0; begin < waiting.size(); begin += kBlock)
    {
      const double part = static_cast<double>(begin) / static_cast<double>(waiting.size());
      if (!this->Run.proceed(kAtTriangles + (kAtPoints - kAtTriangles) * part))
      {
        return false;
      }
      this->each(std::min(kBlock, waiting.size() - begin),
        [&](std::size_t k) { this->triangulate(this->Works[waiting[begin + k]], joining); });
    }

    // Chords of edges that come near each other cross: shorter ones will not, for those and for all
    // faces that share them.
    std::vector<int> crossing;
    for (const std::size_t k : waiting)
    {
      const std::vector<int>& groups = this->Works[k].mesh.crossing_groups;
      crossing.insert(crossing.end(), groups.begin(), groups.end());
    }
    std::sort(crossing.begin(), crossing.end());
    crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
    if (crossing.empty() || attempt + 1 == kAttempts)
    {
      break;
    }
    for (const int group : crossing)
    {
      if (group >= 0)
      {
        joining.refine(group);
      }
    }
    for (Work& work : this->Works)
    {
      for (const std::size_t edge : work.edges)
      {
        for (const int group : joining.samples()[edge].groups)
        {
          work.done =
            work.done && !std::binary_search(crossing.begin(), crossing.end(), group);
        }
      }
    }
  }
  this->Nodes = joining.nodes();
  for (Work& work : this->Works)
  {
    if (!work.mesh.crossing_groups.empty())
    {
      work.problem = "its boundary curves cross each other";
    }
    else if (work.bounds && work.problem.empty() && work.mesh.triangles.empty())
    {
      work.problem = "it has no triangles: it is a point or a line, or thinner than the tolerances";
    }
  }
  return this->Run.proceed(kAtPoints);
}

void Tessellator::triangulate(Work& work, const EdgeJoining& joining) const
{
  std::vector<const PatchEdge*> edges;
  std::vector<const EdgeSamples*> samples;
  for (const std::size_t edge : work.edges)
  {
    edges.push_back(&this->Edges[edge]);
    samples.push_back(&joining.samples()[edge]);
  }
  PatchTriangulation triangulation(*work.bounds, work.region, this->Rule);
  work.mesh = triangulation.run(edges, samples, work.cells);
  work.done = work.mesh.crossing_groups.empty();
}

/// The triangles of a patch, with a vertex for each side of a kink.
void Tessellator::add_triangles(
  std::size_t index, std::vector<Vertex>& vertices, Tessellation& result) const
{
  const Work& work = this->Works[index];
  const Surface& surface = work.bounds->surface();
  const auto side_of = [&](const Parameter<2>& place, const Parameter<2>& middle)
  {
    Sides<2> sides;
    for (int i = 0; i < 2; ++i)
    {
      sides[i] = place[i] > middle[i] ? Side::Left : Side::Right;
    }
    return sides;
  };
  const auto is_kink = [&](const Parameter<2>& place)
  {
    for (int i = 0; i < 2; ++i)
    {
      const std::vector<Break>& breaks = surface.direction(i).breaks;
      const auto at = std::lower_bound(breaks.begin(), breaks.end(), place[i],
        [](const Break& b, double x) { return b.at < x; });
      if (at != breaks.end() && at->at == place[i] && at != breaks.begin() &&
        at + 1 != breaks.end())
      {
        return true;
      }
    }
    return false;
  };
  std::vector<bool> kink;
  for (const Parameter<2>& place : work.mesh.places)
  {
    kink.push_back(is_kink(place));
  }
  std::vector<std::array<std::int64_t, 4>> numbers(
    work.mesh.places.size(), { { -1, -1, -1, -1 } });
  for (const std::array<int, 3>& triangle : work.mesh.triangles)
  {
    Parameter<2> middle = Parameter<2>::Zero();
    for (const int corner : triangle)
    {
      middle += work.mesh.places[corner] / 3.0;
    }
    std::array<std::int64_t, 3> corners;
    for (int i = 0; i < 3; ++i)
    {
      const int corner = triangle[i];
      const Parameter<2>& place = work.mesh.places[corner];
      const Sides<2> sides = side_of(place, middle);
      const int which =
        kink[corner] ? (sides[0] == Side::Left ? 1 : 0) + (sides[1] == Side::Left ? 2 : 0) : 0;
      std::int64_t& number = numbers[corner][which];
      if (number < 0)
      {
        number = static_cast<std::int64_t>(vertices.size());
        vertices.push_back({ index, place, sides, work.mesh.nodes[corner] });
      }
      corners[work.reversed ? 2 - i : i] = number;
    }
    result.triangles.push_back(corners);
    result.triangle_faces.push_back(static_cast<int>(work.face));
  }
}

bool Tessellator::evaluate(Tessellation& result)
{
  // === Number the points
  std::vector<Vertex> vertices;
  for (std::size_t k = 0; k < this->Works.size(); ++k)
  {
    const Work& work = this->Works[k];
    if (!work.problem.empty())
    {
      result.problems.push_back({ work.face, work.problem });
      continue;
    }
    if (work.bounds)
    {
      this->add_triangles(k, vertices, result);
    }
    if (work.mesh.too_coarse > 0)
    {
      result.problems.push_back({ work.face,
        std::to_string(work.mesh.too_coarse) +
          " of its triangles are coarser than the tolerances and cannot be divided" });
    }
    for (const std::vector<CurvePlace>& places : work.lines)
    {
      std::vector<std::int64_t> line;
      for (const CurvePlace& place : places)
      {
        line.push_back(static_cast<std::int64_t>(vertices.size()));
        vertices.push_back({ k, { place.t, 0.0 }, { place.side, Side::Right }, -1 });
      }
      result.lines.push_back(std::move(line));
      result.line_faces.push_back(static_cast<int>(work.face));
    }
  }

  // === Evaluate them
  const auto count = static_cast<Eigen::Index>(vertices.size());
  result.points.resize(3, count);
  result.normals.resize(3, count);
  result.parameters.resize(2, count);
  this->each(vertices.size(),
    [&](std::size_t k)
    {
      const auto at = static_cast<Eigen::Index>(k);
      const Vertex& vertex = vertices[k];
      const Work& work = this->Works[vertex.work];
      if (!work.bounds)
      {
        const auto& curve = *work.patch->curve;
        const Parameter<1> t(vertex.place[0]);
        result.points.col(at) = curve.centre() + curve.jet(t, Sides<1>(vertex.sides[0]), 0).point;
        result.normals.col(at).setZero();
        result.parameters(0, at) = curve.to_domain(t)[0];
        result.parameters(1, at) = 0.0;
        return;
      }
      const Surface& surface = work.bounds->surface();
      result.points.col(at) =
        surface.centre() + surface.jet(vertex.place, vertex.sides, 0).point;
      if (vertex.node >= 0 &&
        (this->Nodes[vertex.node] - result.points.col(at)).norm() <=
          2.0 * std::max(kSewing * this->Size, work.tolerance) + this->Rule.tolerance)
      {
        result.points.col(at) = this->Nodes[vertex.node]; // elsewhere only across a gap
      }
      result.normals.col(at) = unit_normal(surface, vertex.place, vertex.sides) *
        (work.reversed ? -1.0 : 1.0);
      result.parameters.col(at) = surface.to_domain(vertex.place);
    });
  this->fill_missing_normals(result);
  return this->Run.proceed(1.0);
}

/// Where a surface has no normal, as at the tip of a cusp, that of the triangles around.
void Tessellator::fill_missing_normals(Tessellation& result) const
{
  std::vector<bool> missing(static_cast<std::size_t>(result.normals.cols()), false);
  bool any = false;
  for (const auto& triangle : result.triangles)
  {
    for (const std::int64_t corner : triangle)
    {
      missing[corner] = result.normals.col(corner).isZero();
      any = any || missing[corner];
    }
  }
  if (!any)
  {
    return;
  }
  for (const auto& triangle : result.triangles)
  {
    const Vector3 a = result.points.col(triangle[1]) - result.points.col(triangle[0]);
    const Vector3 b = result.points.col(triangle[2]) - result.points.col(triangle[0]);
    for (const std::int64_t corner : triangle)
    {
      if (missing[corner])
      {
        result.normals.col(corner) += a.cross(b) / (this->Size * this->Size);
      }
    }
  }
  for (Eigen::Index k = 0; k < result.normals.cols(); ++k)
  {
    if (missing[k])
    {
      result.normals.col(k).stableNormalize();
    }
  }
}

} // namespace

Tessellation tessellate(
  const Model& model, const TessellationOptions& options, const Execution& execution)
{
  return Tessellator(model, options, execution).run();
}

} // namespace footpoint
