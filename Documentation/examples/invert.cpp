// SPDX-License-Identifier: BSD-3-Clause
#include <vtkNew.h>
#include <vtkPointInversionFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLStructuredGridReader.h>

// invert <points.vtp> <surface.vts> <deviation.vtp>
int main(int argc, char* argv[])
{
  if (argc != 4)
  {
    return 2;
  }
  vtkNew<vtkXMLPolyDataReader> points;
  points->SetFileName(argv[1]);
  vtkNew<vtkXMLStructuredGridReader> surface; // control points, knots and weights
  surface->SetFileName(argv[2]);
  vtkNew<vtkPointInversionFilter> inversion;
  inversion->SetInputConnection(points->GetOutputPort());
  inversion->SetSourceConnection(surface->GetOutputPort());
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(inversion->GetOutputPort());
  writer->SetFileName(argv[3]);
  return writer->Write() == 1 ? 0 : 1;
}
