// SPDX-License-Identifier: BSD-3-Clause
#include "CADOutputs.h"

#include "FieldArrays.h"
#include "SplineBlocks.h"

#include "footpoint/common/errors.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace footpoint::cad
{

namespace
{

/// Of faces to which the file gives no colour, where it does to others.
constexpr std::array<unsigned char, 3> kNoColour = { { 204, 204, 204 } };

files::Spline spline_of(const SurfaceData& surface)
{
  files::Spline spline;
  spline.dimension = 2;
  spline.degree = surface.degree;
  spline.knots = surface.knots;
  spline.points = surface.points;
  spline.weights = surface.weights;
  return spline;
}

files::Spline spline_of(const CurveData& curve)
{
  files::Spline spline;
  spline.dimension = 1;
  spline.degree = { { curve.degree, 0 } };
  spline.knots[0] = curve.knots;
  spline.points = curve.points;
  spline.weights = curve.weights;
  return spline;
}

/// Splines that pass move on, others are noted.
template <typename Part, typename Check>
void keep_sound(
  std::vector<Part>& parts, std::vector<SkippedPart>& skipped, const Check& check_part)
{
  std::vector<Part> sound;
  for (Part& part : parts)
  {
    try
    {
      check_part(part);
      sound.push_back(std::move(part));
    }
    catch (const GeometryError& error)
    {
      skipped.push_back({ part.id, "", error.what() });
    }
  }
  parts = std::move(sound);
}

void set_name(vtkMultiBlockDataSet* blocks, unsigned int number, const std::string& name)
{
  blocks->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

void set_text(vtkFieldData* data, const char* name, const std::string& text)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(text);
  data->AddArray(array);
}

vtkSmartPointer<vtkStructuredGrid> surface_leaf(const FaceData& face, const std::string& unit)
{
  using namespace conversion;
  auto net = files::make_net(spline_of(face.surface));
  vtkFieldData* data = net->GetFieldData();
  if (!face.name.empty())
  {
    set_text(data, "FaceName", face.name);
  }
  set_integer(data, "Orientation", face.orientation);
  set_number(data, "Tolerance", face.tolerance);
  set_text(data, "LengthUnit", unit);
  return net;
}

vtkSmartPointer<vtkDataObject> face_block(const FaceData& face, const std::string& unit)
{
  const auto net = surface_leaf(face, unit);
  if (face.loops.empty())
  {
    return net;
  }
  auto block = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  block->SetNumberOfBlocks(static_cast<unsigned int>(face.loops.size()) + 1);
  block->SetBlock(0, net);
  set_name(block, 0, "Surface");
  for (unsigned int i = 0; i < face.loops.size(); ++i)
  {
    vtkNew<vtkMultiBlockDataSet> loop;
    loop->SetNumberOfBlocks(static_cast<unsigned int>(face.loops[i].size()));
    for (unsigned int j = 0; j < face.loops[i].size(); ++j)
    {
      loop->SetBlock(j, files::make_net(spline_of(face.loops[i][j])));
      set_name(loop, j, "Curve " + std::to_string(j));
    }
    block->SetBlock(i + 1, loop);
    set_name(block, i + 1, "Loop " + std::to_string(i));
  }
  return block;
}

} // namespace

void check(ReceivedModel& model)
{
  keep_sound(model.faces, model.skipped_faces,
    [](const FaceData& face)
    {
      files::check(spline_of(face.surface));
      for (const std::vector<CurveData>& loop : face.loops)
      {
        for (const CurveData& curve : loop)
        {
          files::check(spline_of(curve));
        }
      }
    });
  keep_sound(model.edges, model.skipped_edges,
    [](const EdgeData& edge) { files::check(spline_of(edge.curve)); });
}

void write_mesh(const ReceivedModel& model, vtkPolyData* mesh)
{
  const bool coloured = std::any_of(model.meshes.begin(), model.meshes.end(),
    [](const FaceMesh& part) { return !part.colour.empty(); });
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdTypeArray> face_ids;
  face_ids->SetName("FaceId");
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("Colors");
  colours->SetNumberOfComponents(3);
  for (const FaceMesh& part : model.meshes)
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (std::size_t i = 0; i < part.points.size(); i += 3)
    {
      points->InsertNextPoint(&part.points[i]);
      normals->InsertNextTuple(&part.normals[i]);
    }
    const unsigned char* colour = part.colour.empty() ? kNoColour.data() : part.colour.data();
    for (std::size_t i = 0; i < part.corners.size(); i += 3)
    {
      triangles->InsertNextCell({ first + static_cast<vtkIdType>(part.corners[i]),
        first + static_cast<vtkIdType>(part.corners[i + 1]),
        first + static_cast<vtkIdType>(part.corners[i + 2]) });
      face_ids->InsertNextValue(static_cast<vtkIdType>(part.face));
      colours->InsertNextTypedTuple(colour);
    }
  }
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  mesh->GetPointData()->SetNormals(normals);
  mesh->GetCellData()->AddArray(face_ids);
  if (coloured)
  {
    mesh->GetCellData()->SetScalars(colours);
  }
}

void write_faces(const ReceivedModel& model, vtkMultiBlockDataSet* faces)
{
  faces->SetNumberOfBlocks(static_cast<unsigned int>(model.summary.number_of_faces));
  for (const FaceData& face : model.faces)
  {
    const auto number = static_cast<unsigned int>(face.id);
    faces->SetBlock(number, face_block(face, model.summary.unit));
    set_name(faces, number, face.name.empty() ? "Face " + std::to_string(number) : face.name);
  }
}

void write_edges(const ReceivedModel& model, vtkMultiBlockDataSet* edges)
{
  using namespace conversion;
  edges->SetNumberOfBlocks(static_cast<unsigned int>(model.edges.size()));
  for (unsigned int i = 0; i < model.edges.size(); ++i)
  {
    const EdgeData& edge = model.edges[i];
    const auto curve = files::make_net(spline_of(edge.curve));
    vtkFieldData* data = curve->GetFieldData();
    set_count(data, "EdgeId", static_cast<vtkIdType>(edge.id));
    set_number(data, "Tolerance", edge.tolerance);
    set_values<vtkIdTypeArray>(data, "FaceIds", edge.faces);
    set_text(data, "LengthUnit", model.summary.unit);
    edges->SetBlock(i, curve);
    set_name(edges, i, "Edge " + std::to_string(edge.id));
  }
}

} // namespace footpoint::cad
