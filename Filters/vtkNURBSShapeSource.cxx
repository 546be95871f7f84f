// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNURBSShapeSource.h"

#include "CachedResult.h"
#include "FieldArrays.h"
#include "SplineNet.h"
#include "StructuredOutput.h"

#include "footpoint/shapes/shapes.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"

#include <cmath>
#include <optional>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkNURBSShapeSource);

namespace
{

const char* const kShapes[] = { "Sphere", "Cylinder", "Cone", "Torus", "Wing", "ShipHull", "Teapot",
  "Bumpy", "Circle", "Helix" };

/// A curve, else the faces of a surface.
struct Geometry
{
  footpoint::Shape faces;
  std::optional<footpoint::Curve> curve;

  Dimensions dimensions() const
  {
    return this->curve ? Dimensions{ { this->curve->knots().number_of_control_points(), 1, 1 } }
                       : net_dimensions(&this->faces.front().surface);
  }
};

template <class Spline>
void fill_shifted_net(const Spline& spline, const double shift[3], vtkStructuredGrid* net)
{
  fill_net(spline, net);
  vtkPoints* points = net->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    points->SetPoint(i, p[0] + shift[0], p[1] + shift[1], p[2] + shift[2]);
  }
}

} // namespace

struct vtkNURBSShapeSource::Internals
{
  CachedResult<Geometry> Result;

  void Update(vtkNURBSShapeSource* self)
  {
    ContentHash content;
    content.add(static_cast<std::uint64_t>(self->Shape));
    content.add(self->AirfoilDigits);
    for (const double value :
      { self->Center[0], self->Center[1], self->Center[2], self->Radius, self->CrossSectionRadius,
        self->Height, self->Chord, self->Span, self->TaperRatio, self->SweepAngle, self->Length,
        self->Beam, self->Draft, self->Size, self->Amplitude, self->Turns, self->HelixTolerance })
    {
      content.add(value);
    }
    for (const int value :
      { int(self->Capping), int(self->BluntTrailingEdge), self->Resolution, self->Seed })
    {
      content.add(static_cast<std::uint64_t>(value));
    }
    this->Result.update(content, [self] { return Make(self); });
  }

  /// \throw ShapeError
  static Geometry Make(vtkNURBSShapeSource* self)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (!std::isfinite(self->Center[i]))
      {
        throw footpoint::ShapeError("Center[" + std::to_string(i) +
          "] = " + std::to_string(self->Center[i]) + "; a finite number is needed");
      }
    }
    switch (self->Shape)
    {
      case SPHERE:
        return { footpoint::sphere(self->Radius), {} };
      case CYLINDER:
        return { footpoint::cylinder(self->Radius, self->Height, self->Capping), {} };
      case CONE:
        return { footpoint::cone(self->Radius, self->Height, self->Capping), {} };
      case TORUS:
        return { footpoint::torus(self->Radius, self->CrossSectionRadius), {} };
      case WING:
      {
        footpoint::WingOptions options;
        options.airfoil_digits = self->AirfoilDigits;
        options.chord = self->Chord;
        options.span = self->Span;
        options.taper_ratio = self->TaperRatio;
        options.sweep_angle = self->SweepAngle;
        options.blunt_trailing_edge = self->BluntTrailingEdge;
        options.capping = self->Capping;
        return { footpoint::wing(options), {} };
      }
      case SHIP_HULL:
        return { footpoint::ship_hull(self->Length, self->Beam, self->Draft, self->Capping), {} };
      case TEAPOT:
        return { footpoint::teapot(), {} };
      case BUMPY:
        return { footpoint::bumpy_patch(self->Size, self->Amplitude, self->Resolution,
                   static_cast<std::uint64_t>(self->Seed)),
          {} };
      case CIRCLE:
        return { {}, footpoint::circle(self->Radius) };
      default:
        return { {},
          footpoint::helix(self->Radius, self->Height, self->Turns, self->HelixTolerance) };
    }
  }
};

vtkNURBSShapeSource::vtkNURBSShapeSource()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkNURBSShapeSource::~vtkNURBSShapeSource() = default;

const char* vtkNURBSShapeSource::GetShapeAsString() const
{
  return kShapes[this->Shape];
}

bool vtkNURBSShapeSource::MakesModel() const
{
  const bool one_face_unless_capped =
    this->Shape == CYLINDER || this->Shape == CONE || this->Shape == WING;
  return this->Shape == TEAPOT || this->Shape == SHIP_HULL ||
    (this->Capping && one_face_unless_capped);
}

int vtkNURBSShapeSource::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkNURBSShapeSource::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkDataObject* present = vtkDataObject::GetData(info);
  const bool model = this->MakesModel();
  if (!present || present->IsA("vtkMultiBlockDataSet") != static_cast<int>(model))
  {
    vtkSmartPointer<vtkDataObject> output;
    if (model)
    {
      output = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    }
    else
    {
      output = vtkSmartPointer<vtkStructuredGrid>::New();
    }
    info->Set(vtkDataObject::DATA_OBJECT(), output);
  }
  return 1;
}

int vtkNURBSShapeSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* info = outputs->GetInformationObject(0);
  if (this->MakesModel())
  {
    info->Remove(Pipeline::WHOLE_EXTENT());
    info->Remove(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT());
    info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }
  this->Internal->Update(this);
  const Geometry* geometry = this->Internal->Result.value();
  announce_dimensions(outputs, geometry ? geometry->dimensions() : Dimensions{});
  return 1;
}

int vtkNURBSShapeSource::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  if (wants_nothing(request, outputs))
  {
    clear_outputs(outputs);
    return 1;
  }
  this->Internal->Update(this);
  const Geometry* geometry = this->Internal->Result.value();
  if (!geometry)
  {
    vtkErrorMacro(<< this->Internal->Result.error());
    return 0;
  }
  if (auto* net = vtkStructuredGrid::GetData(outputs))
  {
    if (geometry->curve)
    {
      fill_shifted_net(*geometry->curve, this->Center, net);
    }
    else
    {
      fill_shifted_net(geometry->faces.front().surface, this->Center, net);
    }
    return 1;
  }
  vtkMultiBlockDataSet* model = vtkMultiBlockDataSet::GetData(outputs);
  unsigned int number = 0;
  for (const footpoint::NamedSurface& face : geometry->faces)
  {
    vtkNew<vtkStructuredGrid> net;
    fill_shifted_net(face.surface, this->Center, net);
    set_values<vtkStringArray>(
      net->GetFieldData(), "FaceName", std::vector<std::string>{ face.name });
    model->SetBlock(number, net);
    model->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), face.name.c_str());
    ++number;
  }
  return 1;
}

void vtkNURBSShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shape: " << this->GetShapeAsString() << "\n";
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "CrossSectionRadius: " << this->CrossSectionRadius << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "Capping: " << (this->Capping ? "On" : "Off") << "\n";
  os << indent << "AirfoilDigits: " << this->AirfoilDigits << "\n";
  os << indent << "Chord: " << this->Chord << "\n";
  os << indent << "Span: " << this->Span << "\n";
  os << indent << "TaperRatio: " << this->TaperRatio << "\n";
  os << indent << "SweepAngle: " << this->SweepAngle << "\n";
  os << indent << "BluntTrailingEdge: " << (this->BluntTrailingEdge ? "On" : "Off") << "\n";
  os << indent << "Length: " << this->Length << "\n";
  os << indent << "Beam: " << this->Beam << "\n";
  os << indent << "Draft: " << this->Draft << "\n";
  os << indent << "Size: " << this->Size << "\n";
  os << indent << "Amplitude: " << this->Amplitude << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Turns: " << this->Turns << "\n";
  os << indent << "HelixTolerance: " << this->HelixTolerance << "\n";
}
