// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/tessellation/curve_samples.h"
#include "footpoint/tessellation/patch_triangulation.h"
#include "footpoint/tessellation/tessellation.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace footpoint
{

/// The steps of tessellate(): bounds, cells and edges of all patches; edges joined and triangles;
/// points.
class Tessellator
{
public:
  /// \throw std::invalid_argument where an option is out of range
  /// All but the options outlive this.
  Tessellator(const Model& model, const TessellationOptions& options, const Execution& execution);

  Tessellation run();

private:
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

  /// Calls body(0) … body(count − 1), perhaps at once.
  void each(std::size_t count, const std::function<void(std::size_t)>& body) const;
  bool prepare();
  bool triangulate();
  bool evaluate(Tessellation& result);
  void triangulate(Work& work, const EdgeJoining& joining) const;
  void add_triangles(std::size_t index, std::vector<Vertex>& vertices, Tessellation& result) const;
  void fill_missing_normals(Tessellation& result) const;

  const Execution& Run;
  double Size;
  SamplingRule Rule;
  std::vector<Work> Works;
  std::vector<PatchEdge> Edges;
  std::vector<Vector3> Nodes;
};

} // namespace footpoint
