// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSplineReader.h"

#include "SplineBlocks.h"
#include "SplineFormats.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace footpoint::files;

vtkStandardNewMacro(vtkSplineReader);

vtkSplineReader::vtkSplineReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkSplineReader::~vtkSplineReader()
{
  this->SetFileName(nullptr);
}

const char* vtkSplineReader::GetFormatAsString() const
{
  return format_name(static_cast<footpoint::files::Format>(this->Format));
}

int vtkSplineReader::CanReadFile(const char* path)
{
  try
  {
    return path && !read_spline_file(path, footpoint::files::Format::Auto).splines.empty() ? 1 : 0;
  }
  catch (const FileError&)
  {
    return 0;
  }
}

int vtkSplineReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
  vtkInformation* info = outputs->GetInformationObject(0);
  if (info->Has(Pipeline::UPDATE_PIECE_NUMBER()) && info->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1;
  }
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("No file name is set.");
    return 0;
  }
  try
  {
    const SplineFile file =
      read_spline_file(this->FileName, static_cast<footpoint::files::Format>(this->Format));
    for (const std::string& warning : file.warnings)
    {
      vtkWarningMacro(<< this->FileName << ": " << warning);
    }
    for (const Spline& spline : file.splines)
    {
      append_block(output, spline);
    }
  }
  catch (const FileError& error)
  {
    vtkErrorMacro(<< this->FileName << ": " << error.what());
    return 0;
  }
  return 1;
}

void vtkSplineReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Format: " << this->GetFormatAsString() << "\n";
}
