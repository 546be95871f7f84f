// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/tessellator.h"

#include "footpoint/model/face_neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + "; " + wanted);
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

} // namespace

Tessellator::Tessellator(
  const Model& model, const TessellationOptions& options, const Execution& execution)
  : Run(execution)
  , Size(size_of(model))
{
  check(options);
  this->Rule.adaptive = options.mode == TessellationMode::Adaptive;
  // Fixed takes no notice of the option, but gaps have to be small against something.
  const bool absolute = this->Rule.adaptive && options.absolute;
  this->Rule.tolerance = absolute
    ? options.chord_tolerance
    : this->Size * (this->Rule.adaptive ? options : TessellationOptions()).chord_tolerance;
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

Tessellation Tessellator::run()
{
  Tessellation result;
  result.tolerance = this->Rule.adaptive ? this->Rule.tolerance : 0.0;
  result.cancelled = !(this->prepare() && this->triangulate() && this->evaluate(result));
  if (result.cancelled)
  {
    result = {};
    result.cancelled = true;
  }
  return result;
}

void Tessellator::each(std::size_t count, const std::function<void(std::size_t)>& body) const
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
      const auto* curve = dynamic_cast<const Curve*>(work.patch->curve.get());
      if (work.bounds && !work.bounds->finite())
      {
        work.problem = "its derivatives are too large for numbers";
      }
      else if (work.bounds && this->Rule.tolerance > 0.0)
      {
        work.cells = divide(*work.bounds, work.region, this->Rule);
        work.boundary = boundary_edges(work.bounds->surface(), work.region);
      }
      else if (curve)
      {
        try
        {
          work.lines = curve_samples(*curve, this->Rule);
        }
        catch (const GeometryError& error)
        {
          work.problem = error.what();
        }
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
  EdgeJoining joining(this->Edges, kSewing * this->Size, kSmallGap * this->Rule.tolerance);
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
          work.done = work.done && !std::binary_search(crossing.begin(), crossing.end(), group);
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

Tessellation tessellate(
  const Model& model, const TessellationOptions& options, const Execution& execution)
{
  return Tessellator(model, options, execution).run();
}

} // namespace footpoint
