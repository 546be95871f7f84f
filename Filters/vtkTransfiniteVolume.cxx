// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransfiniteVolume.h"

#include "AlgorithmExecution.h"
#include "BoundaryConversion.h"
#include "FieldArrays.h"
#include "GridConversion.h"
#include "StructuredOutput.h"

#include "footpoint/grids/boundary_error.h"
#include "footpoint/grids/transfinite_volume.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkTransfiniteVolume);

namespace
{

const char* const kFaceNames[6] = { "face u = 0", "face u = 1", "face v = 0", "face v = 1",
  "face w = 0", "face w = 1" };

/// Grids and polygonal data in order, those inside composite data sets included.
struct Parts
{
  std::vector<vtkStructuredGrid*> grids;
  std::vector<vtkPolyData*> lines;

  void add(vtkDataObject* data)
  {
    if (auto* grid = vtkStructuredGrid::SafeDownCast(data))
    {
      this->grids.push_back(grid);
    }
    else if (auto* poly_data = vtkPolyData::SafeDownCast(data))
    {
      this->lines.push_back(poly_data);
    }
    else if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
      for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
      {
        this->add(leaves->GetCurrentDataObject());
      }
    }
  }
};

footpoint::VolumeFaces read_faces(const std::vector<vtkDataObject*>& data, double tolerance)
{
  Parts parts;
  for (vtkDataObject* object : data)
  {
    parts.add(object);
  }
  const Lines lines = read_lines(parts.lines);
  if (parts.grids.size() == 6 && lines.ids.empty())
  {
    footpoint::VolumeFaces faces;
    for (std::size_t i = 0; i < 6; ++i)
    {
      faces[i] = read_grid(parts.grids[i], kFaceNames[i]);
    }
    return faces;
  }
  if (lines.ids.size() == 12 && parts.grids.empty())
  {
    std::array<footpoint::Points, 12> edges;
    for (std::size_t i = 0; i < 12; ++i)
    {
      edges[i] = lines.line(i);
    }
    return footpoint::faces_from_edges(edges, tolerance);
  }
  throw footpoint::BoundaryError(footpoint::BoundaryDefect::Count,
    "6 structured grids (faces) or 12 polylines (edges) are needed; there are " +
      std::to_string(parts.grids.size()) + " and " + std::to_string(lines.ids.size()));
}

/// Of face v = 0, over u and w, and face u = 0, over v and w.
Dimensions find_dimensions(const footpoint::VolumeFaces& faces)
{
  return { { faces[2].count[0], faces[0].count[0], faces[0].count[1] } };
}

} // namespace

vtkTransfiniteVolume::vtkTransfiniteVolume() = default;
vtkTransfiniteVolume::~vtkTransfiniteVolume() = default;

int vtkTransfiniteVolume::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkTransfiniteVolume::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Dimensions dimensions{};
  try
  {
    dimensions = find_dimensions(
      read_faces(update_inputs(this, 0, inputs[0]), this->CornerTolerance));
  }
  catch (const footpoint::BoundaryError&)
  {
    dimensions = Dimensions{}; // RequestData says why
  }
  announce_dimensions(outputs, dimensions);
  return 1;
}

int vtkTransfiniteVolume::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[0]);
  return 1;
}

int vtkTransfiniteVolume::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (wants_nothing(request, outputs))
  {
    clear_outputs(outputs);
    return 1;
  }
  try
  {
    const footpoint::VolumeFaces faces =
      read_faces(input_data(inputs[0]), this->CornerTolerance);
    const std::string changed = check_dimensions(outputs, find_dimensions(faces));
    if (!changed.empty())
    {
      vtkErrorMacro(<< changed);
      return 0;
    }
    const footpoint::VolumeResult result =
      transfinite_volume(faces, this->CornerTolerance, make_execution(this));
    if (this->GetAbortExecute())
    {
      clear_outputs(outputs);
      return 1;
    }
    vtkStructuredGrid* grid = vtkStructuredGrid::GetData(outputs);
    grid->SetDimensions(result.grid.count.data());
    grid->SetPoints(make_points(result.grid.points));
    const footpoint::GridQuality<3> quality = grid_quality(result.grid);
    attach_quality(quality, grid->GetCellData());
    set_integer(grid->GetFieldData(), "Mirrored", result.mirrored ? 1 : 0);
    set_number(grid->GetFieldData(), "LargestGap", result.largest_gap);
    set_count(grid->GetFieldData(), "FoldedCells", quality.folded_count);
  }
  catch (const footpoint::BoundaryError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkTransfiniteVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CornerTolerance: " << this->CornerTolerance << "\n";
}
