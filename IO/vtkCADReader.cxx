// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCADReader.h"

#include "CADOutputs.h"
#include "CADReading.h"
#include "FaceSelection.h"
#include "LengthUnits.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <stdexcept>

using namespace footpoint::cad;

vtkStandardNewMacro(vtkCADReader);

namespace
{

bool wanted(vtkInformation* info)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  return !info->Has(Pipeline::UPDATE_PIECE_NUMBER()) ||
    info->Get(Pipeline::UPDATE_PIECE_NUMBER()) == 0;
}

std::string label(const char* what, const SkippedPart& part)
{
  return std::string(what) + " " + std::to_string(part.id) +
    (part.name.empty() ? "" : " ('" + part.name + "')") + ": " + part.reason;
}

/// \throw std::invalid_argument naming the option that makes no sense
void check(const ReadingOptions& options)
{
  if (options.file.empty())
  {
    throw std::invalid_argument("No file name is set.");
  }
  if (!options.unit.empty() && short_unit_name(options.unit).empty())
  {
    throw std::invalid_argument(
      "LengthUnit '" + options.unit + "' is none of " + unit_names() + ".");
  }
  try
  {
    FaceSelection selection(options.faces);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(std::string("Faces: ") + error.what() + ".");
  }
}

} // namespace

vtkCADReader::vtkCADReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(3);
}

vtkCADReader::~vtkCADReader()
{
  this->SetFileName(nullptr);
}

vtkMultiBlockDataSet* vtkCADReader::GetModelOutput()
{
  return vtkMultiBlockDataSet::SafeDownCast(this->GetOutputDataObject(1));
}

vtkMultiBlockDataSet* vtkCADReader::GetEdgesOutput()
{
  return vtkMultiBlockDataSet::SafeDownCast(this->GetOutputDataObject(2));
}

int vtkCADReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkMultiBlockDataSet");
  return 1;
}

int vtkCADReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
  return 1;
}

int vtkCADReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  bool any = false;
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    any = any || wanted(outputs->GetInformationObject(port));
  }
  if (!any)
  {
    return 1;
  }
  this->NumberOfFaces = 0;
  this->NumberOfSkippedFaces = 0;
  ReadingOptions options;
  options.file = this->FileName ? this->FileName : "";
  options.unit = this->LengthUnit;
  options.faces = this->Faces;
  options.deflection = this->Deflection;
  options.angular_deflection = this->AngularDeflection;
  options.healing = this->Healing;
  options.mesh = this->GenerateMesh;
  CompleteReading reading;
  try
  {
    check(options);
    reading = read_completely(
      options, this->TimeLimit, [this](double done) { this->UpdateProgress(done); },
      [this] { return this->GetAbortExecute() != 0; });
  }
  catch (const std::invalid_argument& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  if (!reading.error.empty())
  {
    vtkErrorMacro(<< this->FileName << ": " << reading.error);
    return 0;
  }
  if (reading.aborted)
  {
    return 1;
  }
  for (const std::string& warning : reading.warnings)
  {
    vtkWarningMacro(<< this->FileName << ": " << warning);
  }
  const ReceivedModel& model = reading.model;
  if (model.faces.empty() && model.edges.empty())
  {
    vtkErrorMacro(<< this->FileName << ": no face and no edge can be read"
                  << (model.skipped_faces.empty() ? "" : "; ")
                  << (model.skipped_faces.empty() ? "" : label("face", model.skipped_faces.front()))
                  << (model.skipped_edges.empty() ? "" : "; ")
                  << (model.skipped_edges.empty() ? ""
                                                  : label("edge", model.skipped_edges.front())));
    return 0;
  }
  for (const SkippedPart& face : model.skipped_faces)
  {
    vtkWarningMacro(<< this->FileName << ": " << label("face", face));
  }
  for (const SkippedPart& edge : model.skipped_edges)
  {
    vtkWarningMacro(<< this->FileName << ": " << label("edge", edge));
  }
  this->NumberOfFaces = static_cast<vtkIdType>(model.summary.number_of_faces);
  this->NumberOfSkippedFaces = static_cast<vtkIdType>(model.skipped_faces.size());
  if (wanted(outputs->GetInformationObject(0)))
  {
    write_mesh(model, vtkPolyData::GetData(outputs, 0));
  }
  if (wanted(outputs->GetInformationObject(1)))
  {
    write_faces(model, vtkMultiBlockDataSet::GetData(outputs, 1));
  }
  if (wanted(outputs->GetInformationObject(2)))
  {
    write_edges(model, vtkMultiBlockDataSet::GetData(outputs, 2));
  }
  return 1;
}

void vtkCADReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "LengthUnit: " << this->LengthUnit << "\n";
  os << indent << "Faces: " << this->Faces << "\n";
  os << indent << "GenerateMesh: " << (this->GenerateMesh ? "On" : "Off") << "\n";
  os << indent << "Deflection: " << this->Deflection << "\n";
  os << indent << "AngularDeflection: " << this->AngularDeflection << "\n";
  os << indent << "Healing: " << (this->Healing ? "On" : "Off") << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "NumberOfFaces: " << this->NumberOfFaces << "\n";
  os << indent << "NumberOfSkippedFaces: " << this->NumberOfSkippedFaces << "\n";
}
