// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSplineReader.h"

#include "GoToolsFormat.h"
#include "SplineBlocks.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "vtksys/FStream.hxx"
#include "vtksys/SystemTools.hxx"

#include <sstream>

using namespace footpoint::files;

vtkStandardNewMacro(vtkSplineReader);

namespace
{

/// The whole content of a file. \throw FileError
std::string read_bytes(const std::string& path)
{
  if (vtksys::SystemTools::FileIsDirectory(path))
  {
    throw FileError("it is a folder");
  }
  vtksys::ifstream stream(path.c_str(), std::ios::binary);
  std::ostringstream bytes;
  if (!stream || !(stream.peek() == EOF || bytes << stream.rdbuf()))
  {
    throw FileError("it cannot be opened and read");
  }
  return bytes.str();
}

SplineFile read_file(const std::string& path)
{
  const std::string bytes = read_bytes(path);
  const std::string extension =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension != ".g2")
  {
    throw FileError("the extension '" + extension + "' is that of no format; .g2 is known");
  }
  SplineFile file = read_go_tools(bytes);
  if (file.splines.empty() && file.warnings.empty())
  {
    throw FileError("it has no spline");
  }
  return file;
}

} // namespace

vtkSplineReader::vtkSplineReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkSplineReader::~vtkSplineReader()
{
  this->SetFileName(nullptr);
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
    const SplineFile file = read_file(this->FileName);
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
}
