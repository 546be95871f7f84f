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
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <optional>

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

/// Cells of so many points each as VTK has them.
/// \param for_cells calls what it is given with the point indices of one cell after the other
template <class ForCells>
vtkSmartPointer<vtkCellArray> make_cells(
  vtkIdType cells, vtkIdType points_a_cell, const ForCells& for_cells)
{
  vtkNew<vtkIdTypeArray> connectivity;
  connectivity->SetNumberOfValues(cells * points_a_cell);
  vtkIdType* next = connectivity->GetPointer(0);
  for_cells([&](const auto& cell) { next = std::copy(cell.begin(), cell.end(), next); });
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(points_a_cell, connectivity);
  return result;
}

/// The grid's points and arrays with quads or triangles; two triangles share the data of a cell.
void fill_mesh(vtkStructuredGrid* input, int cell_type, int triangle_style, vtkPolyData* mesh)
{
  int dimensions[3];
  input->GetDimensions(dimensions);
  const std::array<int, 2> count{ { dimensions[0], dimensions[1] } };
  mesh->SetPoints(input->GetPoints());
  mesh->GetPointData()->ShallowCopy(input->GetPointData());
  mesh->GetFieldData()->ShallowCopy(input->GetFieldData());
  if (cell_type == vtkCoonsPatchSource::QUADS)
  {
    mesh->SetPolys(make_cells(input->GetNumberOfCells(), 4,
      [&](const auto& visit) { footpoint::for_quads(count, visit); }));
    mesh->GetCellData()->ShallowCopy(input->GetCellData());
    return;
  }
  const auto style = static_cast<footpoint::TriangleStyle>(triangle_style);
  mesh->SetPolys(make_cells(2 * input->GetNumberOfCells(), 3,
    [&](const auto& visit) { footpoint::for_triangles(count, style, visit); }));
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
  /// Whether the numbers of points may change over time.
  static bool FollowsTime(vtkCoonsPatchSource* self, vtkInformationVector* input);
  /// Numbers of points that the boundary leads to at a time; zeros where it is bad.
  static Dimensions Measure(
    vtkCoonsPatchSource* self, vtkInformationVector* input, std::optional<double> time);
  /// Numbers of points that the boundary leads to.
  static Dimensions FindDimensions(vtkCoonsPatchSource* self, const footpoint::Boundary& boundary);
  static footpoint::TransfiniteOptions Options(vtkCoonsPatchSource* self);
  /// Dimensions, points and arc lengths of the patch, made in the arrays of the output.
  /// \return its twist incompatibility
  static double Interpolate(
    vtkCoonsPatchSource* self, const footpoint::Boundary& boundary, vtkStructuredGrid* grid);
  /// Smooths the points of the grid.
  /// \return what came of it; its own grid is gone
  static footpoint::SmoothingResult Smooth(vtkCoonsPatchSource* self, vtkStructuredGrid* grid);
  /// The number of SmoothingStatus; warns where nothing was gained.
  static int Status(vtkCoonsPatchSource* self, const footpoint::Boundary& boundary,
    const footpoint::SmoothingResult& result);
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

vtkTypeBool vtkCoonsPatchSource::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_TIME_DEPENDENT_INFORMATION()))
  {
    return this->Superclass::ProcessRequest(request, inputs, outputs);
  }
  if (Internals::FollowsTime(this, inputs[0]))
  {
    const Dimensions dimensions =
      Internals::Measure(this, inputs[0], requested_time(request, outputs));
    this->ResolutionChanged = renew_dimensions(outputs, dimensions) || this->ResolutionChanged;
  }
  return 1;
}

int vtkCoonsPatchSource::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Dimensions dimensions{ { this->Resolution[0], this->Resolution[1], 1 } };
  if (dimensions[0] == 0 || dimensions[1] == 0)
  {
    dimensions = Internals::Measure(this, inputs[0], requested_time(request, outputs));
  }
  announce_dimensions(outputs, dimensions);
  this->ResolutionChanged = false;
  if (Internals::FollowsTime(this, inputs[0]))
  {
    announce_changing_dimensions(outputs);
  }
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

bool vtkCoonsPatchSource::Internals::FollowsTime(
  vtkCoonsPatchSource* self, vtkInformationVector* input)
{
  return (self->Resolution[0] == 0 || self->Resolution[1] == 0) && has_time(input);
}

Dimensions vtkCoonsPatchSource::Internals::Measure(
  vtkCoonsPatchSource* self, vtkInformationVector* input, std::optional<double> time)
{
  try
  {
    return FindDimensions(self, ReadBoundary(self, update_inputs(self, 0, input, time)));
  }
  catch (const footpoint::BoundaryError&)
  {
    return {}; // RequestData says why
  }
}

footpoint::TransfiniteOptions vtkCoonsPatchSource::Internals::Options(vtkCoonsPatchSource* self)
{
  footpoint::TransfiniteOptions options;
  std::copy_n(self->Resolution, 2, options.resolution.begin());
  options.parametrization = static_cast<footpoint::GridParametrization>(self->Parametrization);
  options.blend = static_cast<footpoint::Blend>(self->Blend);
  return options;
}

Dimensions vtkCoonsPatchSource::Internals::FindDimensions(
  vtkCoonsPatchSource* self, const footpoint::Boundary& boundary)
{
  const std::array<int, 2> count = transfinite_resolution(boundary, Options(self));
  return { { count[0], count[1], 1 } };
}

double vtkCoonsPatchSource::Internals::Interpolate(
  vtkCoonsPatchSource* self, const footpoint::Boundary& boundary, vtkStructuredGrid* grid)
{
  const footpoint::TransfiniteOptions options = Options(self);
  const Dimensions dimensions = FindDimensions(self, boundary);
  const vtkIdType size = vtkIdType(dimensions[0]) * dimensions[1];
  grid->SetDimensions(dimensions.data());
  footpoint::TransfiniteOutput output;
  auto positions = new_array("Points", 3, size);
  output.points = positions->GetPointer(0);
  vtkNew<vtkPoints> points;
  points->SetData(positions);
  grid->SetPoints(points);
  if (has_arc_lengths(options))
  {
    auto lengths_u = new_array("ArcLengthU", 1, size);
    auto lengths_v = new_array("ArcLengthV", 1, size);
    output.arc_length_u = lengths_u->GetPointer(0);
    output.arc_length_v = lengths_v->GetPointer(0);
    grid->GetPointData()->AddArray(lengths_u);
    grid->GetPointData()->AddArray(lengths_v);
  }
  return fill_transfinite(
    boundary, options, output, nullptr, part_of(make_execution(self), 0.0, 0.2));
}

footpoint::SmoothingResult vtkCoonsPatchSource::Internals::Smooth(
  vtkCoonsPatchSource* self, vtkStructuredGrid* grid)
{
  footpoint::SmoothingOptions options;
  options.method = static_cast<footpoint::Smoothing>(self->Smoothing);
  options.maximum_iterations = self->MaximumSmoothingIterations;
  const footpoint::GridView view = view_grid(grid);
  footpoint::Grid start;
  start.count = view.count;
  start.points = view.points;
  footpoint::SmoothingResult result =
    smooth(start, options, part_of(make_execution(self), 0.2, 0.8));
  if (result.changed && !result.cancelled)
  {
    grid->SetPoints(make_points(result.grid.points));
  }
  result.grid = footpoint::Grid();
  return result;
}

void vtkCoonsPatchSource::Internals::Report(const footpoint::Boundary& boundary, vtkFieldData* data)
{
  report_sides(boundary, data);
  set_integer(data, "SelfCrossing", boundary.self_crossing ? 1 : 0);
  set_integer(data, "GuessedCorners", boundary.guessed_corners);
}

int vtkCoonsPatchSource::Internals::Status(vtkCoonsPatchSource* self,
  const footpoint::Boundary& boundary, const footpoint::SmoothingResult& result)
{
  const auto method = static_cast<footpoint::Smoothing>(self->Smoothing);
  const int status = boundary.self_crossing && self->Smoothing != NONE
    ? static_cast<int>(REJECTED)
    : smoothing_status(result, method);
  if (boundary.self_crossing)
  {
    vtkWarningWithObjectMacro(self,
      "The sides of the boundary cross each other: no grid between them is free of folds, and "
      "nothing is smoothed.");
  }
  else if (status == REJECTED)
  {
    vtkWarningWithObjectMacro(self, << self->GetSmoothingAsString() << " smoothing was no gain: "
                                    << result.folds_after << " folded cells are left.");
  }
  return status;
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
    std::string problem = check_dimensions(outputs, Internals::FindDimensions(this, boundary));
    if (problem.empty() && this->ResolutionChanged)
    {
      problem = refuse_other_request(outputs);
    }
    if (!problem.empty())
    {
      vtkErrorMacro(<< problem);
      return 0;
    }

    // === Compute
    vtkStructuredGrid* grid = vtkStructuredGrid::GetData(outputs, 0);
    const double twist_incompatibility = Internals::Interpolate(this, boundary, grid);
    const bool smoothed = this->Smoothing != NONE && !boundary.self_crossing;
    footpoint::SmoothingResult result;
    if (smoothed)
    {
      result = Internals::Smooth(this, grid);
    }
    if (result.cancelled || this->GetAbortExecute())
    {
      clear_outputs(outputs);
      return 1;
    }

    // === Attach
    vtkPointData* points = grid->GetPointData();
    const footpoint::GridView view = view_grid(grid);
    if (this->GenerateNormals)
    {
      attach_normals(view, points);
    }
    if (this->GenerateTextureCoordinates)
    {
      attach_texture_coordinates(view.count, points);
    }
    const std::int64_t folds = attach_quality(view, grid->GetCellData());
    if (!smoothed)
    {
      result.folds_before = folds;
      result.folds_after = folds;
    }
    const int status = Internals::Status(this, boundary, result);
    vtkFieldData* data = grid->GetFieldData();
    Internals::Report(boundary, data);
    attach_folds(result, status, data);
    if (this->Blend == BICUBIC)
    {
      set_number(data, "TwistIncompatibility", twist_incompatibility);
    }
    fill_mesh(grid, this->CellType, this->TriangleStyle, vtkPolyData::GetData(outputs, 1));
  }
  catch (const footpoint::BoundaryError& error)
  {
    clear_outputs(outputs);
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
