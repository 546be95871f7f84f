// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCoonsSurface.h"

#include "BoundaryConversion.h"
#include "CachedResult.h"
#include "SplineNet.h"
#include "StructuredOutput.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/coons_surface.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStructuredGrid.h"

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkCoonsSurface);

namespace
{

/// Samples of a curve by which its place in the boundary is found; enough to tell the inside.
constexpr int kSamples = 65;

footpoint::Points sample(const footpoint::Curve& curve)
{
  footpoint::Points points(3, kSamples);
  for (int i = 0; i < kSamples; ++i)
  {
    const double t = curve.knots().length() * i / (kSamples - 1);
    points.col(i) = curve.centre() + curve.point(footpoint::Parameter<1>(t));
  }
  return points;
}

struct NamedSurface
{
  footpoint::Surface surface;
  footpoint::Boundary boundary; ///< order, directions and gaps
};

NamedSurface make_surface(
  const std::vector<footpoint::Curve>& curves, double tolerance, bool strict)
{
  if (curves.size() != 4)
  {
    throw footpoint::BoundaryError(footpoint::BoundaryDefect::Count,
      "a Coons surface needs 4 curves; there are " + std::to_string(curves.size()));
  }
  std::vector<footpoint::Points> polylines;
  for (const footpoint::Curve& curve : curves)
  {
    polylines.push_back(sample(curve));
  }
  footpoint::BoundaryOptions options;
  options.merge_tolerance = tolerance;
  options.corner_tolerance = tolerance;
  options.strict = strict;
  const footpoint::Boundary boundary = assemble_sides(polylines, {}, options);
  const auto side = [&](footpoint::Role role)
  {
    const footpoint::SideReport& report = boundary.reports[role];
    const footpoint::Curve& curve = curves[static_cast<std::size_t>(report.input)];
    return report.reversed ? reversed(curve) : curve;
  };
  return { footpoint::coons_surface({ { side(footpoint::kBottom), side(footpoint::kRight),
                                      side(footpoint::kTop), side(footpoint::kLeft) } },
             tolerance),
    boundary };
}

} // namespace

struct vtkCoonsSurface::Internals
{
  CachedResult<NamedSurface> Result;

  void Update(vtkCoonsSurface* self, const std::vector<vtkDataObject*>& data)
  {
    ContentHash content;
    for (vtkDataObject* object : data)
    {
      content.add(object);
    }
    content.add(self->CornerTolerance);
    content.add(static_cast<std::uint64_t>(self->Strict));
    this->Result.update(content,
      [&]
      { return make_surface(read_curves(data, "curve"), self->CornerTolerance, self->Strict); });
  }

  /// Null where it could not be made.
  const footpoint::Surface* Surface() const
  {
    const NamedSurface* result = this->Result.value();
    return result ? &result->surface : nullptr;
  }
};

vtkCoonsSurface::vtkCoonsSurface()
  : Strict(footpoint::BoundaryOptions().strict)
  , Internal(new Internals)
{
}

vtkCoonsSurface::~vtkCoonsSurface() = default;

int vtkCoonsSurface::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkCoonsSurface::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Internal->Update(this, update_inputs(this, 0, inputs[0]));
  announce_dimensions(outputs, net_dimensions(this->Internal->Surface()));
  return 1;
}

int vtkCoonsSurface::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[0]);
  return 1;
}

int vtkCoonsSurface::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (wants_nothing(request, outputs))
  {
    clear_outputs(outputs);
    return 1;
  }
  this->Internal->Update(this, input_data(inputs[0]));
  vtkStructuredGrid* net =
    write_net(this, this->Internal->Surface(), this->Internal->Result.error(), outputs);
  if (!net)
  {
    return 0;
  }
  report_sides(this->Internal->Result.value()->boundary, net->GetFieldData());
  return 1;
}

void vtkCoonsSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CornerTolerance: " << this->CornerTolerance << "\n";
  os << indent << "Strict: " << (this->Strict ? "On" : "Off") << "\n";
}
