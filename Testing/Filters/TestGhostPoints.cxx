// SPDX-License-Identifier: BSD-3-Clause
// Ghost and hidden points get their arrays, but do not count in the statistics.
#include "FilterTesting.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

using namespace testing;

int TestGhostPoints(int, char*[])
{
  return Run(
    []
    {
      const auto marked =
        MakePoints({ { { 0, 0, 2 } }, { { 0, 0, 101 } }, { { 0, 0, 201 } }, { { 0, 0, 4 } } });
      vtkNew<vtkUnsignedCharArray> ghosts;
      ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
      ghosts->InsertNextValue(0);
      ghosts->InsertNextValue(vtkDataSetAttributes::DUPLICATEPOINT);
      ghosts->InsertNextValue(vtkDataSetAttributes::HIDDENPOINT);
      ghosts->InsertNextValue(0);
      marked->GetPointData()->AddArray(ghosts);
      vtkNew<vtkMultiBlockDataSet> input;
      input->SetBlock(0, marked);
      input->SetBlock(1, MakePoints({ { { 0, 0, 6 } } }));

      vtkNew<vtkPointInversionFilter> filter;
      filter->SetInputData(input);
      filter->SetSourceData(MakeSphere());
      filter->Update();
      auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput());
      CHECK_NEAR(Value(output->GetBlock(0), "Distance", 1), 100.0, 1e-10);
      CHECK_NEAR(Value(output->GetBlock(0), "Distance", 2), 200.0, 1e-10);
      CHECK(FieldValue(output, "DistanceCount") == 3);
      CHECK(FieldValue(output, "StatusCounts", 0) == 3);
      CHECK_NEAR(FieldValue(output, "DistanceMaximum"), 5.0, 1e-12);
      CHECK_NEAR(FieldValue(output, "DistanceMean"), 3.0, 1e-12);
      CHECK(filter->GetFaceStatisticsOutput()->GetValueByName(0, "Count").ToInt() == 3);
      CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 5);
    });
}
