// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmark_shapes.h"

#include "footpoint/model/model.h"

#include <memory>
#include <string>
#include <vector>

namespace inversion_benchmark
{

/// What a program says about one point.
struct Answer
{
  double distance = NAN;
  /// In the geometry's own domain (curves: v = 0); NaN where the program gives none.
  Parameter<2> parameter = Parameter<2>::Constant(NAN);
  bool certified = false;
};

/// A program that projects points onto geometry.
class Peer
{
public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  /// Whether it works on the exact geometry rather than on a tessellation.
  virtual bool exact() const { return true; }
  /// Takes a geometry; false where the program cannot. What may be done once a geometry is done
  /// here.
  virtual bool build(const Shape& shape) = 0;
  /// \pre build() was true
  virtual Answer project(const Vector3& point) = 0;
  /// As many of the points as there are answers: one by one where the program knows nothing else.
  virtual void project_all(const Points& points, std::vector<Answer>& answers);
};

/// PointInverter::find, one query at a time.
std::unique_ptr<Peer> make_footpoint();
/// footpoint::invert, all points in one call.
std::unique_ptr<Peer> make_footpoint_batch();
/// Open CASCADE: ShapeAnalysis_Surface::ValueOfUV, ShapeAnalysis_Curve::Project.
std::unique_ptr<Peer> make_occt();
/// SINTEF's spline library: s1954, s1953.
std::unique_ptr<Peer> make_sisl();
/// vtkStaticCellLocator on a tessellation of 200 x 200 quadrilaterals, cut into triangles (curves:
/// 4,000 segments).
std::unique_ptr<Peer> make_vtk_locator();
/// The same, with so many more quadrilaterals as keep the mesh within 1e-4 × size of the surface
/// where those do not. Its time to build has the search for that number in it.
std::unique_ptr<Peer> make_fine_vtk_locator();

/// Ours, one by one and in batches, and those that were found when this was configured, ours first.
/// \param fine_mesh with both of VTK's
std::vector<std::unique_ptr<Peer>> all_peers(bool ours_only, bool fine_mesh);

/// Whether a program is ours, by its name.
bool is_ours(const std::string& program);

/// A model of one face, for PointInverter.
footpoint::Model model_of(const Shape& shape);

} // namespace inversion_benchmark
