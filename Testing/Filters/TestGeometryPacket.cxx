// SPDX-License-Identifier: BSD-3-Clause
// Geometry that was sent has the content of what it was made from, whatever kind it is of; arrays
// that are no geometry stay behind.
#include "FilterTesting.h"

#include "GeometryHash.h"
#include "GeometryPacket.h"
#include "SplineConversion.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

using namespace footpoint::conversion;
using namespace testing;

namespace
{

ContentHash HashOf(vtkDataObject* data)
{
  ContentHash hash;
  hash.add(data);
  return hash;
}

vtkSmartPointer<vtkDataObject> Sent(vtkDataObject* data)
{
  return unpack_geometry(pack_geometry(data));
}

void CheckSent(vtkDataObject* data)
{
  const auto sent = Sent(data);
  CHECK(sent->GetDataObjectType() == data->GetDataObjectType());
  CHECK(HashOf(sent) == HashOf(data));
  CHECK(HashOf(Sent(sent)) == HashOf(data));
  const ConvertedModel before = convert_to_model(data, false);
  const ConvertedModel after = convert_to_model(sent, false);
  CHECK(before.messages() == after.messages());
  CHECK(before.model.size() == after.model.size());
  for (std::size_t i = 0; i < before.model.size(); ++i)
  {
    CHECK(before.model[i].name == after.model[i].name);
    CHECK(before.model[i].reversed == after.model[i].reversed);
    CHECK(before.model[i].tolerance == after.model[i].tolerance);
    CHECK(before.model[i].patches.size() == after.model[i].patches.size());
  }
}

vtkSmartPointer<vtkStructuredGrid> NamedSphere()
{
  auto net = MakeSphere();
  vtkNew<vtkStringArray> name;
  name->SetName("FaceName");
  name->InsertNextValue("ball");
  net->GetFieldData()->AddArray(name);
  AddNumbers(net->GetFieldData(), "Orientation", { -1 });
  AddNumbers(net->GetFieldData(), "Tolerance", { 1e-3 });
  return net;
}

/// A cubic Bézier curve with weights, a parameter range and a face, in a grid with all attributes.
vtkSmartPointer<vtkUnstructuredGrid> BezierCurve()
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->Allocate();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  vtkNew<vtkIdList> ids;
  for (int i = 0; i < 4; ++i)
  {
    ids->InsertNextId(points->InsertNextPoint(i, i * i % 3, 0.1 * i));
  }
  grid->SetPoints(points);
  grid->InsertNextCell(VTK_BEZIER_CURVE, ids);
  AddNumbers(grid->GetPointData(), "Weights", { 1, 2, 0.5, 1 }); // of another name
  grid->GetPointData()->SetActiveAttribute("Weights", vtkDataSetAttributes::RATIONALWEIGHTS);
  AddNumbers(grid->GetCellData(), "FaceId", { 2 });
  vtkNew<vtkFloatArray> range;
  range->SetName("ParameterRange");
  range->SetNumberOfComponents(2);
  range->InsertNextTuple2(2.0, 3.0);
  grid->GetCellData()->AddArray(range);
  return grid;
}

void TestLeaves()
{
  const auto sphere = NamedSphere();
  AddNumbers(sphere->GetPointData(), "Pressure", std::vector<double>(45, 1.0));
  CheckSent(sphere);
  CHECK(!vtkDataSet::SafeDownCast(Sent(sphere))->GetPointData()->HasArray("Pressure"));
  CheckSent(MakeParabola());
  CheckSent(BezierCurve());
  CheckSent(vtkSmartPointer<vtkStructuredGrid>::New());
  CheckSent(vtkSmartPointer<vtkUnstructuredGrid>::New());
  CheckSent(vtkSmartPointer<vtkImageData>::New()); // no geometry, and said to be none there, too
  CHECK(Sent(nullptr) == nullptr);

  // Numbers that are not stored one after the other.
  const auto curve = MakeParabola();
  vtkNew<vtkSOADataArrayTemplate<double>> strided;
  strided->SetNumberOfComponents(3);
  strided->SetNumberOfTuples(3);
  for (vtkIdType i = 0; i < 3; ++i)
  {
    strided->SetTuple(i, curve->GetPoint(i));
  }
  curve->GetPoints()->SetData(strided);
  CHECK(convert_to_model(curve, false).problems.empty());
  CHECK(convert_to_model(Sent(curve), false).problems.empty());
  CHECK(HashOf(Sent(curve)) == HashOf(Sent(MakeParabola())));
}

void TestTrees()
{
  // A trimmed face whose loop is a polyline, beside null, empty and nested blocks.
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(5);
  for (const Point& p : { Point{ { 1, 0.5, 0 } }, Point{ { 3, 0.5, 0 } }, Point{ { 3, 1.5, 0 } },
         Point{ { 1, 1.5, 0 } }, Point{ { 1, 0.5, 0 } } })
  {
    lines->InsertCellPoint(corners->InsertNextPoint(p.data()));
  }
  vtkNew<vtkPolyData> polyline;
  polyline->SetPoints(corners);
  polyline->SetLines(lines);
  vtkNew<vtkMultiBlockDataSet> loop;
  loop->SetBlock(0, polyline);
  vtkNew<vtkMultiBlockDataSet> face;
  face->SetBlock(0, NamedSphere());
  face->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "Surface");
  face->SetBlock(1, loop);
  face->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "Loop 0");
  CHECK(convert_to_model(face, false).problems.empty());
  CheckSent(face);

  vtkNew<vtkPartitionedDataSet> pieces;
  pieces->SetPartition(0, nullptr);
  pieces->SetPartition(1, MakeSquare());
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, nullptr);
  model->SetBlock(1, face);
  model->SetBlock(2, vtkSmartPointer<vtkMultiBlockDataSet>::New());
  model->SetBlock(4, MakeSquare());
  model->SetBlock(5, BezierCurve());
  model->GetMetaData(4u)->Set(vtkCompositeDataSet::NAME(), "a name");
  CheckSent(model);

  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, pieces);
  collection->SetPartitionedDataSet(2, pieces);
  CheckSent(collection);
}

} // namespace

int TestGeometryPacket(int, char*[])
{
  return Run(
    []
    {
      TestLeaves();
      TestTrees();
    });
}
