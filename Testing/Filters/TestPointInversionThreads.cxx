// SPDX-License-Identifier: BSD-3-Clause
// The same bits for one and two threads, also of models that these share to build, and for any
// order of the points.
#include "FilterTesting.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkSMPTools.h"

#include <algorithm>

using namespace testing;

namespace
{

const char* const kArrays[] = { "Parameters", "Distance", "SignedDistance", "ClosestPoint",
  "Normal", "FaceId", "Status", "FootType", "Isolated", "Iterations" };

vtkSmartPointer<vtkDataObject> Invert(
  const std::vector<Point>& points, vtkDataObject* source, int threads)
{
  vtkSMPTools::Initialize(threads);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(points));
  filter->SetSourceData(source);
  filter->Update();
  return filter->GetOutput();
}

/// Unit squares, neighbours with a side in common.
vtkSmartPointer<vtkMultiBlockDataSet> MakeFloor()
{
  auto floor = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int k = 0; k < 48; ++k)
  {
    const auto square = MakeSquare();
    vtkPoints* const corners = square->GetPoints();
    for (vtkIdType i = 0; i < corners->GetNumberOfPoints(); ++i)
    {
      double p[3];
      corners->GetPoint(i, p);
      corners->SetPoint(i, p[0] + k % 8 - 4.0, p[1] + k / 8 - 3.0, p[2]);
    }
    floor->SetBlock(k, square);
  }
  return floor;
}

void CheckSameBits(vtkDataObject* one, vtkDataObject* two)
{
  for (const char* name : kArrays)
  {
    CHECK(SameBits(PointArray(one, name), PointArray(two, name)));
  }
  for (const char* name : { "DistanceMean", "DistanceRMS", "DistancePercentile95" })
  {
    CHECK(FieldValue(one, name) == FieldValue(two, name));
  }
}

} // namespace

int TestPointInversionThreads(int, char*[])
{
  return Run(
    []
    {
      CHECK(vtkSMPTools::SetBackend("STDThread"));
      std::vector<Point> points = RandomPoints(3000, 4.0);
      const auto torus = MakeTorus();
      const auto one = Invert(points, torus, 1);
      CheckSameBits(one, Invert(points, torus, 2));
      CHECK(vtkSMPTools::GetEstimatedNumberOfThreads() == 2);
      const auto floor = MakeFloor();
      CheckSameBits(Invert(points, floor, 1), Invert(points, floor, 2));

      std::reverse(points.begin(), points.end());
      const auto reversed = Invert(points, torus, 2);
      const vtkIdType last = static_cast<vtkIdType>(points.size()) - 1;
      for (const char* name : kArrays)
      {
        for (vtkIdType i = 0; i <= last; ++i)
        {
          for (int k = 0; k < PointArray(one, name)->GetNumberOfComponents(); ++k)
          {
            CHECK(Value(one, name, i, k) == Value(reversed, name, last - i, k));
          }
        }
      }
    });
}
