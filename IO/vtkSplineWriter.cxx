// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSplineWriter.h"

#include "SplineCollection.h"
#include "SplineFormats.h"

#include "vtkAlgorithm.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

using namespace footpoint::files;

vtkStandardNewMacro(vtkSplineWriter);

vtkSplineWriter::~vtkSplineWriter()
{
  this->SetFileName(nullptr);
}

const char* vtkSplineWriter::GetFormatAsString() const
{
  return format_name(static_cast<footpoint::files::Format>(this->Format));
}

int vtkSplineWriter::FillInputPortInformation(int, vtkInformation* info)
{
  // Composite data sets are named, so that the executive hands them over whole.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

void vtkSplineWriter::WriteData()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("No file name is set.");
    return;
  }
  try
  {
    const SplineFile file = collect_splines(this->GetInput());
    if (file.splines.empty())
    {
      throw FileError("the input has no spline");
    }
    std::vector<std::string> warnings = write_spline_file(
      this->FileName, static_cast<footpoint::files::Format>(this->Format), file.splines);
    warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
    for (const std::string& warning : warnings)
    {
      vtkWarningMacro(<< this->FileName << ": " << warning);
    }
  }
  catch (const FileError& error)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro(<< this->FileName << ": " << error.what());
  }
}

void vtkSplineWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Format: " << this->GetFormatAsString() << "\n";
}
