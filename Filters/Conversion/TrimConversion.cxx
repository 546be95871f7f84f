// SPDX-License-Identifier: BSD-3-Clause
#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkCellArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkVariant.h"

#include <algorithm>

namespace footpoint::conversion
{

namespace
{

const char* const kSurface = "Surface";
const std::string kLoop = "Loop ";

[[noreturn]] void refuse(const std::string& message)
{
  throw GeometryError(GeometryDefect::Format, message);
}

bool is_loop_name(const std::string& name)
{
  return name.compare(0, kLoop.size(), kLoop) == 0;
}

/// The number in a name such as "Loop 3".
std::size_t loop_number(const std::string& name)
{
  const std::string digits = name.substr(kLoop.size());
  const bool good = !digits.empty() && digits.size() <= 9 &&
    digits.find_first_not_of("0123456789") == std::string::npos &&
    (digits.size() == 1 || digits[0] != '0');
  if (!good)
  {
    refuse("the block '" + name + "' has no number; loops are called Loop 0, Loop 1, …");
  }
  return std::stoul(digits);
}

/// A curve has to lie in the plane of the parameters.
void check_plane(const Points& points)
{
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    if (!(points(2, i) == 0.0))
    {
      refuse("control point " + std::to_string(i) + " has z = " +
        vtkVariant(points(2, i)).ToString() + "; a trim curve is in the plane (u, v), with z = 0");
    }
  }
}

/// The curve of degree 1 through points in the plane, one unit of its parameter a segment. A point
/// that repeats the one before it is left out: a segment of no length bounds nothing.
std::shared_ptr<const Curve> make_polyline(const Points& points)
{
  check_plane(points);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    if (kept.empty() || points.col(i) != points.col(kept.back()))
    {
      kept.push_back(i);
    }
  }
  if (kept.size() < 2)
  {
    throw GeometryError(GeometryDefect::Count,
      "the polyline has " + std::to_string(kept.size()) + " distinct points; 2 are needed");
  }
  Points corners(3, static_cast<Eigen::Index>(kept.size()));
  std::vector<double> knots{ 0.0 };
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    corners.col(static_cast<Eigen::Index>(i)) = points.col(kept[i]);
    knots.push_back(static_cast<double>(i));
  }
  knots.push_back(knots.back());
  return std::make_shared<const Curve>(KnotVector(1, std::move(knots), "KnotsU"), corners);
}

std::shared_ptr<const Curve> convert_grid(vtkStructuredGrid* grid)
{
  vtkFieldData* data = grid->GetFieldData();
  Points points(3, grid->GetNumberOfPoints());
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    grid->GetPoint(i, points.col(i).data());
  }
  if (data && data->HasArray("KnotsU"))
  {
    const Patch patch = convert_net(grid);
    auto curve = std::dynamic_pointer_cast<const Curve>(patch.curve);
    if (!curve)
    {
      refuse("it is a surface; a curve has dimensions (n, 1, 1)");
    }
    check_plane(points);
    return curve;
  }
  const std::vector<double> degree = read_field_array(data, "Degree");
  if (!degree.empty() && degree[0] != 1.0)
  {
    refuse("it has no KnotsU, as if it were a polyline, but Degree[0] = " +
      vtkVariant(degree[0]).ToString());
  }
  const int* extent = grid->GetExtent();
  if (extent[2] != extent[3] || extent[4] != extent[5])
  {
    refuse("it has dimensions (" + std::to_string(extent[1] - extent[0] + 1) + ", " +
      std::to_string(extent[3] - extent[2] + 1) + ", " + std::to_string(extent[5] - extent[4] + 1) +
      "); a polyline has (n, 1, 1)");
  }
  return make_polyline(points);
}

/// One curve for every line, in the order of the cells.
void append_lines(vtkPolyData* data, TrimLoop& loop)
{
  if (data->GetNumberOfLines() == 0 || data->GetNumberOfLines() != data->GetNumberOfCells())
  {
    refuse("it is a vtkPolyData with " + std::to_string(data->GetNumberOfLines()) +
      " lines among " + std::to_string(data->GetNumberOfCells()) +
      " cells; trim curves are lines alone");
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType line = 0; line < data->GetNumberOfLines(); ++line)
  {
    data->GetLines()->GetCellAtId(line, ids);
    Points points(3, ids->GetNumberOfIds());
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      data->GetPoint(ids->GetId(i), points.col(i).data());
    }
    loop.curves.push_back(make_polyline(points));
  }
}

void append_curves(vtkDataObject* data, TrimLoop& loop)
{
  vtkDataObject* whole = single_piece(data);
  if (auto* grid = vtkStructuredGrid::SafeDownCast(whole))
  {
    loop.curves.push_back(convert_grid(grid));
  }
  else if (auto* lines = vtkPolyData::SafeDownCast(whole))
  {
    append_lines(lines, loop);
  }
  else
  {
    refuse(whole ? std::string("it is a ") + whole->GetClassName() +
          "; a trim curve is a vtkStructuredGrid of dimensions (n, 1, 1) or vtkPolyData lines"
                 : std::string("it is empty; a loop needs all its curves"));
  }
}

/// \param name of the loop, for messages
TrimLoop convert_loop(vtkDataObject* data, const std::string& name)
{
  TrimLoop loop;
  auto* curves = vtkMultiBlockDataSet::SafeDownCast(data);
  const unsigned int count = curves ? curves->GetNumberOfBlocks() : 1;
  if (!data || count == 0)
  {
    refuse(name + " has no curves");
  }
  for (unsigned int i = 0; i < count; ++i)
  {
    try
    {
      append_curves(curves ? curves->GetBlock(i) : data, loop);
    }
    catch (const GeometryError& error)
    {
      throw GeometryError(
        error.defect(), name + ", curve " + std::to_string(i) + ": " + error.what());
    }
  }
  return loop;
}

} // namespace

bool is_trimmed_face(vtkMultiBlockDataSet* blocks)
{
  bool has_surface = false;
  bool has_loops = false;
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    const std::string name = block_name(blocks, i);
    has_surface = has_surface || name == kSurface;
    has_loops = has_loops || is_loop_name(name);
  }
  return has_surface && has_loops;
}

Face convert_trimmed_face(vtkMultiBlockDataSet* blocks, std::string& name)
{
  Face face = read_trimmed_face(blocks, name);
  trim(face);
  return face;
}

Face read_trimmed_face(vtkMultiBlockDataSet* blocks, std::string& name)
{
  // === Sort the blocks by their names
  bool has_surface = false;
  vtkDataObject* surface = nullptr;
  std::vector<std::pair<std::size_t, vtkDataObject*>> loops;
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    const std::string block = block_name(blocks, i);
    if (is_loop_name(block))
    {
      loops.emplace_back(loop_number(block), blocks->GetBlock(i));
    }
    else if (block != kSurface || has_surface)
    {
      refuse("block " + std::to_string(i) + " of the trimmed face is called '" + block +
        "'; there is one Surface, and the others are called Loop 0, Loop 1, …");
    }
    else
    {
      has_surface = true;
      surface = single_piece(blocks->GetBlock(i));
    }
  }
  std::stable_sort(
    loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

  // === The surface, and what is said of the face in its field data
  auto* net = vtkStructuredGrid::SafeDownCast(surface);
  if (!net)
  {
    refuse(std::string("the block Surface is ") +
      (surface ? std::string("a ") + surface->GetClassName() : std::string("empty")) +
      "; a vtkStructuredGrid of control points is needed");
  }
  const FaceAttributes attributes = read_face_attributes(net->GetFieldData());
  name = attributes.name.empty() ? name : attributes.name;
  Face face;
  face.patches.push_back(convert_net(net));
  if (!face.patches.front().surface)
  {
    refuse("the block Surface is a curve; only surfaces are trimmed");
  }
  face.reversed = attributes.reversed;
  face.tolerance = attributes.tolerance;

  // === The loops
  for (std::size_t i = 0; i < loops.size(); ++i)
  {
    if (loops[i].first != i)
    {
      refuse("the trimmed face has " + std::to_string(loops.size()) +
        " loops, but their numbers are not 0 to " + std::to_string(loops.size() - 1) + ": Loop " +
        std::to_string(i) + " is missing or another is there twice");
    }
    face.loops.push_back(convert_loop(loops[i].second, kLoop + std::to_string(i)));
  }
  return face;
}

} // namespace footpoint::conversion
