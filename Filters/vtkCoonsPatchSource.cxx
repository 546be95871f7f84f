// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCoonsPatchSource.h"

#include "AlgorithmExecution.h"
#include "BoundaryConversion.h"
#include "FieldArrays.h"
#include "GridConversion.h"
#include "StructuredOutput.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/grid_faces.h"
#include "footpoint/grids/transfinite.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkCoonsPatchSource);

namespace
{

/// In the order of the enumerations, which is that of the core's.
const char* const kCellTypes[] = { "Quads", "Triangles" };
const char* const kTriangleStyles[] = { "AlignLeft", "AlignRight", "UnionJack" };
const char* const kParametrizations[] = { "Uniform", "ArcLengthRecorded", "ArcLengthResampled",
  "ArcLengthBlended" };
const char* const kSmoothings[] = { "None", "Auto", "Laplacian", "Winslow" };
const char* const kBlends[] = { "Bilinear", "Bicubic" };

using Source = vtkCoonsPatchSource;
static_assert(static_cast<int>(footpoint::TriangleStyle::UnionJack) == Source::UNION_JACK &&
    static_cast<int>(footpoint::GridParametrization::ArcLengthBlended) ==
      Source::ARC_LENGTH_BLENDED &&
    static_cast<int>(footpoint::Smoothing::Winslow) == Source::WINSLOW &&
    static_cast<int>(footpoint::Blend::Bicubic) == Source::BICUBIC &&
    static_cast<int>(footpoint::kLeft) == Source::LEFT,
  "enumerations of the source and of the core must have the same numbers");

/// Cells of N points as VTK has them.
template <std::size_t N>
vtkSmartPointer<vtkCellArray> make_cells(const std::vector<std::array<std::int64_t, N>>& cells)
{
  vtkNew<vtkIdTypeArray> connectivity;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(N * cells.size()));
  vtkIdType* next = connectivity->GetPointer(0);
  for (const auto& cell : cells)
  {
    next = std::copy(cell.begin(), cell.end(), next);
  }
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(static_cast<vtkIdType>(N), connectivity);
  return result;
}

/// The grid's points and arrays with quads or triangles; two triangles share the data of a cell.
void fill_mesh(const footpoint::Grid& grid, vtkStructuredGrid* input, int cell_type,
  int triangle_style, vtkPolyData* mesh)
{
  mesh->SetPoints(input->GetPoints());
  mesh->GetPointData()->ShallowCopy(input->GetPointData());
  mesh->GetFieldData()->ShallowCopy(input->GetFieldData());
  if (cell_type == vtkCoonsPatchSource::QUADS)
  {
    mesh->SetPolys(make_cells(footpoint::quads(grid)));
    mesh->GetCellData()->ShallowCopy(input->GetCellData());
    return;
  }
  mesh->SetPolys(make_cells(
    footpoint::triangles(grid, static_cast<footpoint::TriangleStyle>(triangle_style))));
  vtkCellData* data = mesh->GetCellData();
  data->CopyAllocate(input->GetCellData(), mesh->GetNumberOfPolys());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPolys(); ++i)
  {
    data->CopyData(input->GetCellData(), i / 2, i);
  }
}

std::vector<vtkPolyData*> lines_of(const std::vector<vtkDataObject*>& data)
{
  std::vector<vtkPolyData*> lines;
  for (vtkDataObject* object : data)
  {
    if (auto* poly_data = vtkPolyData::SafeDownCast(object))
    {
      lines.push_back(poly_data);
    }
  }
  return lines;
}

} // namespace

/// The steps from lines to outputs.
struct vtkCoonsPatchSource::Internals
{
  static footpoint::Boundary ReadBoundary(
    vtkCoonsPatchSource* self, const std::vector<vtkDataObject*>& data);
  /// Numbers of points that the boundary leads to.
  static Dimensions FindDimensions(
    vtkCoonsPatchSource* self, const footpoint::Boundary& boundary);
  static footpoint::TransfiniteResult Interpolate(
    vtkCoonsPatchSource* self, const footpoint::Boundary& boundary);
  /// The smoothed grid, or the same one with its folds counted.
  static footpoint::SmoothingResult Smooth(vtkCoonsPatchSource* self, footpoint::Grid grid,
    const footpoint::GridQuality<2>& quality, bool self_crossing);
  static void Report(const footpoint::Boundary& boundary, vtkFieldData* data);
};

vtkCoonsPatchSource::vtkCoonsPatchSource()
{
  this->SetNumberOfOutputPorts(2);

  const footpoint::TransfiniteOptions options;
  std::copy(options.resolution.begin(), options.resolution.end(), this->Resolution);
  this->Parametrization = static_cast<int>(options.parametrization);
  this->Blend = static_cast<int>(options.blend);
  const footpoint::BoundaryOptions boundary;
  this->ForceCornerMatch = boundary.force_corner_match;
  this->CornerTolerance = boundary.corner_tolerance;
  this->CornerAngle = boundary.corner_angle;
  this->Strict = boundary.strict;
  this->MaximumSmoothingIterations = footpoint::SmoothingOptions().maximum_iterations;
}

vtkCoonsPatchSource::~vtkCoonsPatchSource() = default;

const char* vtkCoonsPatchSource::GetCellTypeAsString() const
{
  return kCellTypes[this->CellType];
}

const char* vtkCoonsPatchSource::GetTriangleStyleAsString() const
{
  return kTriangleStyles[this->TriangleStyle];
}

const char* vtkCoonsPatchSource::GetParametrizationAsString() const
{
  return kParametrizations[this->Parametrization];
}

const char* vtkCoonsPatchSource::GetSmoothingAsString() const
{
  return kSmoothings[this->Smoothing];
}

const char* vtkCoonsPatchSource::GetBlendAsString() const
{
  return kBlends[this->Blend];
}

vtkPolyData* vtkCoonsPatchSource::GetMeshOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkCoonsPatchSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkCoonsPatchSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkStructuredGrid" : "vtkPolyData");
  return 1;
}

int vtkCoonsPatchSource::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Dimensions dimensions{ { this->Resolution[0], this->Resolution[1], 1 } };
  if (dimensions[0] == 0 || dimensions[1] == 0)
  {
    try
    {
      dimensions = Internals::FindDimensions(
        this, Internals::ReadBoundary(this, update_inputs(this, 0, inputs[0])));
    }
    catch (const footpoint::BoundaryError&)
    {
      dimensions = Dimensions{}; // RequestData says why
    }
  }
  announce_dimensions(outputs, dimensions);
  return 1;
}

int vtkCoonsPatchSource::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[0]);
  return 1;
}

footpoint::Boundary vtkCoonsPatchSource::Internals::ReadBoundary(
  vtkCoonsPatchSource* self, const std::vector<vtkDataObject*>& data)
{
  footpoint::BoundaryOptions options;
  options.force_corner_match = self->ForceCornerMatch;
  options.corner_tolerance = self->CornerTolerance;
  options.corner_angle = self->CornerAngle;
  options.strict = self->Strict;
  const int* ids = self->CornerIds;
  if (std::any_of(ids, ids + 4, [](int id) { return id != -1; }))
  {
    options.corner_ids.assign(ids, ids + 4);
  }
  const Lines lines = read_lines(lines_of(data));
  if (lines.ids.empty())
  {
    throw footpoint::BoundaryError(
      footpoint::BoundaryDefect::Count, "the input has no lines; a boundary is needed");
  }
  return assemble_boundary(lines.points, lines.ids, lines.roles, options);
}

Dimensions vtkCoonsPatchSource::Internals::FindDimensions(
  vtkCoonsPatchSource* self, const footpoint::Boundary& boundary)
{
  const auto longer = [&](footpoint::Role a, footpoint::Role b)
  { return static_cast<int>(std::max(boundary.sides[a].cols(), boundary.sides[b].cols())); };
  Dimensions result{ { self->Resolution[0], self->Resolution[1], 1 } };
  result[0] = result[0] == 0 ? longer(footpoint::kBottom, footpoint::kTop) : result[0];
  result[1] = result[1] == 0 ? longer(footpoint::kLeft, footpoint::kRight) : result[1];
  return result;
}

footpoint::TransfiniteResult vtkCoonsPatchSource::Internals::Interpolate(
  vtkCoonsPatchSource* self, const footpoint::Boundary& boundary)
{
  footpoint::TransfiniteOptions options;
  std::copy_n(self->Resolution, 2, options.resolution.begin());
  options.parametrization = static_cast<footpoint::GridParametrization>(self->Parametrization);
  options.blend = static_cast<footpoint::Blend>(self->Blend);
  return transfinite_grid(boundary, options, nullptr, make_execution(self, 0.0, 0.2));
}

footpoint::SmoothingResult vtkCoonsPatchSource::Internals::Smooth(vtkCoonsPatchSource* self,
  footpoint::Grid grid, const footpoint::GridQuality<2>& quality, bool self_crossing)
{
  if (self->Smoothing == NONE || self_crossing)
  {
    footpoint::SmoothingResult result;
    result.grid = std::move(grid);
    result.folds_before = quality.folded_count;
    result.folds_after = quality.folded_count;
    return result;
  }
  footpoint::SmoothingOptions options;
  options.method = static_cast<footpoint::Smoothing>(self->Smoothing);
  options.maximum_iterations = self->MaximumSmoothingIterations;
  return smooth(grid, options, make_execution(self, 0.2, 0.8));
}

void vtkCoonsPatchSource::Internals::Report(
  const footpoint::Boundary& boundary, vtkFieldData* data)
{
  std::array<int, 4> order;
  std::array<int, 4> reversed;
  for (std::size_t role = 0; role < 4; ++role)
  {
    order[role] = boundary.reports[role].input;
    reversed[role] = boundary.reports[role].reversed ? 1 : 0;
  }
  set_numbers(data, "CornerGaps", boundary.corner_gaps);
  set_integers(data, "EdgeOrder", order);
  set_integers(data, "EdgeReversed", reversed);
  set_integer(data, "SelfCrossing", boundary.self_crossing ? 1 : 0);
  set_integer(data, "GuessedCorners", boundary.guessed_corners);
}

int vtkCoonsPatchSource::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (wants_nothing(request, outputs))
  {
    clear_outputs(outputs);
    return 1;
  }
  try
  {
    // === Convert
    const footpoint::Boundary boundary = Internals::ReadBoundary(this, input_data(inputs[0]));
    const std::string changed =
      check_dimensions(outputs, Internals::FindDimensions(this, boundary));
    if (!changed.empty())
    {
      vtkErrorMacro(<< changed);
      return 0;
    }

    // === Compute
    footpoint::TransfiniteResult patch = Internals::Interpolate(this, boundary);
    footpoint::GridQuality<2> quality = grid_quality(patch.grid);
    const footpoint::SmoothingResult result =
      Internals::Smooth(this, std::move(patch.grid), quality, boundary.self_crossing);
    if (result.cancelled || this->GetAbortExecute())
    {
      clear_outputs(outputs);
      return 1;
    }
    const auto method = static_cast<footpoint::Smoothing>(this->Smoothing);
    const int status = boundary.self_crossing && this->Smoothing != NONE
      ? static_cast<int>(REJECTED)
      : smoothing_status(result, method);
    if (boundary.self_crossing)
    {
      vtkWarningMacro("The sides of the boundary cross each other: no grid between them is free of "
                      "folds, and nothing is smoothed.");
    }
    else if (status == REJECTED)
    {
      vtkWarningMacro(<< this->GetSmoothingAsString() << " smoothing was no gain: "
                      << result.folds_after << " folded cells are left.");
    }

    // === Attach
    vtkStructuredGrid* grid = vtkStructuredGrid::GetData(outputs, 0);
    grid->SetDimensions(result.grid.count[0], result.grid.count[1], 1);
    grid->SetPoints(make_points(result.grid.points));
    vtkPointData* points = grid->GetPointData();
    if (this->GenerateNormals)
    {
      attach_normals(result.grid, points);
    }
    if (this->GenerateTextureCoordinates)
    {
      points->SetTCoords(make_array("TCoords", texture_coordinates(result.grid)));
    }
    if (patch.arc_length_u.size() > 0)
    {
      points->AddArray(make_array("ArcLengthU", patch.arc_length_u.transpose()));
      points->AddArray(make_array("ArcLengthV", patch.arc_length_v.transpose()));
    }
    attach_quality(
      result.changed ? grid_quality(result.grid) : std::move(quality), grid->GetCellData());
    vtkFieldData* data = grid->GetFieldData();
    Internals::Report(boundary, data);
    attach_folds(result, status, data);
    if (this->Blend == BICUBIC)
    {
      set_number(data, "TwistIncompatibility", patch.twist_incompatibility);
    }
    fill_mesh(result.grid, grid, this->CellType, this->TriangleStyle,
      vtkPolyData::GetData(outputs, 1));
  }
  catch (const footpoint::BoundaryError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkCoonsPatchSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto flag = [&](const char* name, bool value)
  { os << indent << name << ": " << (value ? "On" : "Off") << "\n"; };
  os << indent << "Resolution: (" << this->Resolution[0] << ", " << this->Resolution[1] << ")\n";
  os << indent << "CellType: " << this->GetCellTypeAsString() << "\n";
  os << indent << "TriangleStyle: " << this->GetTriangleStyleAsString() << "\n";
  flag("GenerateNormals", this->GenerateNormals);
  flag("GenerateTextureCoordinates", this->GenerateTextureCoordinates);
  os << indent << "Parametrization: " << this->GetParametrizationAsString() << "\n";
  flag("ForceCornerMatch", this->ForceCornerMatch);
  os << indent << "CornerTolerance: " << this->CornerTolerance << "\n";
  os << indent << "CornerAngle: " << this->CornerAngle << "\n";
  os << indent << "CornerIds: (" << this->CornerIds[0] << ", " << this->CornerIds[1] << ", "
     << this->CornerIds[2] << ", " << this->CornerIds[3] << ")\n";
  flag("Strict", this->Strict);
  os << indent << "Smoothing: " << this->GetSmoothingAsString() << "\n";
  os << indent << "MaximumSmoothingIterations: " << this->MaximumSmoothingIterations << "\n";
  os << indent << "Blend: " << this->GetBlendAsString() << "\n";
}
