// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGordonSurface.h"

#include "CachedResult.h"
#include "FieldArrays.h"
#include "SplineNet.h"
#include "StructuredOutput.h"

#include "footpoint/grids/gordon_surface.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStructuredGrid.h"

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkGordonSurface);

struct vtkGordonSurface::Internals
{
  CachedResult<footpoint::GordonResult> Result;

  void Update(vtkGordonSurface* self, const std::vector<vtkDataObject*>& profiles,
    const std::vector<vtkDataObject*>& guides)
  {
    footpoint::GordonOptions options;
    options.intersection_tolerance = self->IntersectionTolerance;
    options.reparametrize = self->Reparametrize;
    options.reparametrization_tolerance = self->ReparametrizationTolerance;

    ContentHash content;
    for (const auto* family : { &profiles, &guides })
    {
      content.add(static_cast<std::uint64_t>(family->size()));
      for (vtkDataObject* object : *family)
      {
        content.add(object);
      }
    }
    content.add(options.intersection_tolerance);
    content.add(static_cast<std::uint64_t>(options.reparametrize));
    content.add(options.reparametrization_tolerance);
    this->Result.update(content,
      [&]
      {
        return gordon_surface(
          read_curves(profiles, "profile"), read_curves(guides, "guide"), options);
      });
  }

  /// Null where it could not be made.
  const footpoint::Surface* Surface() const
  {
    const footpoint::GordonResult* result = this->Result.value();
    return result ? &result->surface : nullptr;
  }
};

vtkGordonSurface::vtkGordonSurface()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(2);
  const footpoint::GordonOptions options;
  this->IntersectionTolerance = options.intersection_tolerance;
  this->Reparametrize = options.reparametrize;
  this->ReparametrizationTolerance = options.reparametrization_tolerance;
}

vtkGordonSurface::~vtkGordonSurface() = default;

void vtkGordonSurface::SetGuidesConnection(vtkAlgorithmOutput* algorithmOutput)
{
  this->SetInputConnection(1, algorithmOutput);
}

void vtkGordonSurface::AddGuidesConnection(vtkAlgorithmOutput* algorithmOutput)
{
  this->AddInputConnection(1, algorithmOutput);
}

void vtkGordonSurface::AddGuidesData(vtkDataObject* guides)
{
  this->AddInputDataInternal(1, guides);
}

void vtkGordonSurface::RemoveAllGuides()
{
  this->SetInputConnection(1, nullptr);
}

int vtkGordonSurface::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkGordonSurface::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Internal->Update(
    this, update_inputs(this, 0, inputs[0]), update_inputs(this, 1, inputs[1]));
  announce_dimensions(outputs, net_dimensions(this->Internal->Surface()));
  return 1;
}

int vtkGordonSurface::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[0]);
  request_whole_inputs(inputs[1]);
  return 1;
}

int vtkGordonSurface::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (wants_nothing(request, outputs))
  {
    clear_outputs(outputs);
    return 1;
  }
  this->Internal->Update(this, input_data(inputs[0]), input_data(inputs[1]));
  vtkStructuredGrid* net =
    write_net(this, this->Internal->Surface(), this->Internal->Result.error(), outputs);
  if (!net)
  {
    return 0;
  }
  vtkFieldData* data = net->GetFieldData();
  const footpoint::NetworkReport& report = this->Internal->Result.value()->network;
  set_numbers(data, "ParametersU", report.parameters_u);
  set_numbers(data, "ParametersV", report.parameters_v);
  set_integers(data, "ProfileOrder", report.profile_order);
  set_integers(data, "GuideOrder", report.guide_order);
  set_integers(data, "ProfileReversed", report.profile_reversed);
  set_integers(data, "GuideReversed", report.guide_reversed);
  set_number(data, "LargestGap", report.largest_gap);
  set_number(data, "ReparametrizationError", report.reparametrization_error);
  return 1;
}

void vtkGordonSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IntersectionTolerance: " << this->IntersectionTolerance << "\n";
  os << indent << "Reparametrize: " << (this->Reparametrize ? "On" : "Off") << "\n";
  os << indent << "ReparametrizationTolerance: " << this->ReparametrizationTolerance << "\n";
}
