// SPDX-License-Identifier: BSD-3-Clause
// Composite data sets on both ports: structure, the same arrays on every block, statistics over all
// of them, and the numbering of faces.
#include "FilterTesting.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointInversionFilter.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

using namespace testing;

namespace
{

void SetName(vtkDataObject* leaf, const char* name)
{
  vtkNew<vtkStringArray> array;
  array->SetName("FaceName");
  array->InsertNextValue(name);
  leaf->GetFieldData()->AddArray(array);
}

/// Squares at heights 0, 10, a null block, and in a nested block a circle and a reversed square
/// at 20.
vtkSmartPointer<vtkMultiBlockDataSet> MakeModel()
{
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, MakeCircle());
  const auto top = MakeSquare(20.0);
  AddNumbers(top->GetFieldData(), "Orientation", { -1 });
  nested->SetBlock(1, top);
  auto model = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const auto bottom = MakeSquare(0.0, 5.0);
  SetName(bottom, "bottom");
  model->SetBlock(0, bottom);
  model->SetBlock(1, MakeSquare(10.0));
  model->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "middle");
  model->SetBlock(2, nullptr);
  model->SetBlock(3, nested);
  return model;
}

void TestCompositeSource()
{
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 5.5, 0.5, 1 } }, { { 0.5, 0.5, 12 } }, { { 3, 0, 0 } },
    { { 0.5, 0.5, 19 } }, { { 0.5, 0.5, 22 } } }));
  filter->SetSourceData(MakeModel());
  filter->Update();
  vtkDataObject* output = filter->GetOutput();
  const double faces[] = { 0, 1, 0, 4, 4 };
  const double distances[] = { 1, 2, 2, 1, 2 };
  for (vtkIdType i = 0; i < 5; ++i)
  {
    // (3, 0, 0) is as near to the circle (face 3) as to the square: the lowest number.
    CHECK(Value(output, "FaceId", i) == faces[i]);
    CHECK_NEAR(Value(output, "Distance", i), distances[i], 1e-12);
  }
  CHECK_NEAR(Value(output, "SignedDistance", 1), 2.0, 1e-12);
  CHECK_NEAR(Value(output, "SignedDistance", 3), 1.0, 1e-12); // below a reversed square
  CHECK_NEAR(Value(output, "SignedDistance", 4), -2.0, 1e-12);
  CHECK(Value(output, "Normal", 4, 2) == -1.0);

  // === Arrays of mixed models
  filter->SetInputData(MakePoints({ { { 0, 0.5, 0 } } }));
  filter->Update();
  output = filter->GetOutput();
  CHECK(Value(output, "FaceId", 0) == 3);
  CHECK(PointArray(output, "Parameters")->GetNumberOfComponents() == 2);
  CHECK(Value(output, "Parameters", 0, 1) == 0.0);
  CHECK(std::isnan(Value(output, "SignedDistance", 0)));
  CHECK(std::isnan(Value(output, "Normal", 0)));
  CHECK_NEAR(Value(output, "Tangent", 0, 0), -1.0, 1e-12);
  CHECK_NEAR(Value(output, "Distance", 0), 0.5, 1e-12);
  // The statistics take the distance where there is no sign.
  CHECK_NEAR(FieldValue(output, "DistanceMean"), 0.5, 1e-12);

  vtkTable* table = filter->GetFaceStatisticsOutput();
  CHECK(table->GetNumberOfRows() == 5);
  CHECK(table->GetValueByName(0, "Name").ToString() == "bottom");
  CHECK(table->GetValueByName(1, "Name").ToString() == "middle");
  CHECK(table->GetValueByName(3, "Count").ToInt() == 1);
  CHECK(table->GetValueByName(2, "Count").ToInt() == 0);
  CHECK(table->GetValueByName(4, "FaceId").ToInt() == 4);
}

void TestPartitionedSource()
{
  vtkNew<vtkPartitionedDataSetCollection> model;
  model->SetNumberOfPartitionedDataSets(3);
  model->SetPartition(0, 0, MakeSquare(0.0));
  model->SetPartition(2, 0, MakeSquare(10.0));
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 0.5, 0.5, 9 } } }));
  filter->SetSourceData(model);
  filter->Update();
  CHECK(Value(filter->GetOutput(), "FaceId", 0) == 2);
  CHECK_NEAR(Value(filter->GetOutput(), "SignedDistance", 0), -1.0, 1e-12);
}

void TestCompositeInput()
{
  vtkNew<vtkMultiBlockDataSet> input;
  vtkNew<vtkMultiBlockDataSet> nested;
  vtkNew<vtkPolyData> empty;
  nested->SetBlock(0, MakePoints({ { { 3, 0, 0 } }, { { std::nan(""), 0, 0 } }, { { 0, 5, 0 } } }));
  nested->SetBlock(1, empty);
  input->SetBlock(0, MakePoints({ { { 0, 0, 2 } } }, VTK_FLOAT));
  input->SetBlock(1, nullptr);
  input->SetBlock(2, nested);
  AddNumbers(input->GetFieldData(), "Campaign", { 42 });

  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(input);
  filter->SetSourceData(MakeSphere());
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput());
  CHECK(output != nullptr);
  CHECK(output->GetNumberOfBlocks() == 3);
  CHECK(output->GetBlock(1) == nullptr);
  auto* inner = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(2));
  CHECK(inner != nullptr);
  CHECK(!vtkDataSet::SafeDownCast(input->GetBlock(0))->GetPointData()->HasArray("Distance"));
  for (vtkDataObject* block : { output->GetBlock(0), inner->GetBlock(0), inner->GetBlock(1) })
  {
    for (const char* name : { "Parameters", "Distance", "SignedDistance", "ClosestPoint", "Normal",
           "FaceId", "Status", "FootType", "Isolated", "Iterations" })
    {
      CHECK(PointArray(block, name)->GetNumberOfTuples() ==
        vtkDataSet::SafeDownCast(block)->GetNumberOfPoints());
    }
    CHECK(vtkDataSet::SafeDownCast(block)->GetPointData()->GetScalars() ==
      PointArray(block, "SignedDistance"));
    CHECK(!block->GetFieldData()->HasArray("DistanceMean"));
  }
  CHECK(Value(inner->GetBlock(0), "Status", 1) == 4);
  CHECK_NEAR(Value(inner->GetBlock(0), "SignedDistance", 2), 4.0, 1e-12);
  CHECK(FieldValue(output, "Campaign") == 42);
  CHECK(FieldValue(output, "DistanceCount") == 3);
  CHECK_NEAR(FieldValue(output, "DistanceMean"), 7.0 / 3.0, 1e-12);
  CHECK(FieldValue(output, "StatusCounts", 4) == 1);

  vtkPolyData* feet = filter->GetFootPointsOutput();
  CHECK(feet->GetNumberOfPoints() == 3);
  const double points[] = { 0, 0, 2 };
  const double blocks[] = { 1, 4, 4 }; // flat composite indices
  for (vtkIdType i = 0; i < 3; ++i)
  {
    CHECK(Value(feet, "PointId", i) == points[i]);
    CHECK(Value(feet, "BlockId", i) == blocks[i]);
  }

  // === A warm start begins anew in each block
  filter->WarmStartOn();
  filter->Update();
  output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput());
  CHECK(FieldValue(output, "DistanceCount") == 3);
  CHECK_NEAR(FieldValue(output, "DistanceMean"), 7.0 / 3.0, 1e-12);

  // === No blocks
  vtkNew<vtkMultiBlockDataSet> nothing;
  filter->SetInputData(nothing);
  filter->Update();
  CHECK(FieldValue(filter->GetOutput(), "DistanceCount") == 0);
  CHECK(filter->GetFootPointsOutput()->GetPointData()->HasArray("BlockId"));

  // === A collection
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(2);
  collection->SetPartition(0, 0, MakePoints({ { { 0, 0, 2 } } }));
  collection->SetPartition(1, 0, MakePoints({ { { 0, 0, 3 } } }));
  collection->SetPartition(1, 1, MakePoints({ { { 0, 0, 4 } } }));
  filter->SetInputData(collection);
  filter->WarmStartOff();
  filter->Update();
  auto* parts = vtkPartitionedDataSetCollection::SafeDownCast(filter->GetOutput());
  CHECK(parts != nullptr);
  CHECK(parts->GetNumberOfPartitions(1) == 2);
  CHECK_NEAR(Value(parts->GetPartition(1, 1), "Distance", 0), 3.0, 1e-12);
  CHECK_NEAR(FieldValue(parts, "DistanceMean"), 2.0, 1e-12);
}

} // namespace

int TestPointInversionComposite(int, char*[])
{
  return Run(
    []
    {
      TestCompositeSource();
      TestPartitionedSource();
      TestCompositeInput();
    });
}
