// SPDX-License-Identifier: BSD-3-Clause
// The same bits for one and two threads, and for any order of the points.
#include "FilterTesting.h"

#include "vtkPointInversionFilter.h"
#include "vtkSMPTools.h"

#include <algorithm>

using namespace testing;

namespace
{

const char* const kArrays[] = { "Parameters", "Distance", "SignedDistance", "ClosestPoint",
  "Normal", "FaceId", "Status", "FootType", "Isolated", "Iterations" };

vtkSmartPointer<vtkDataObject> Invert(const std::vector<Point>& points, int threads)
{
  vtkSMPTools::Initialize(threads);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(points));
  filter->SetSourceData(MakeTorus());
  filter->Update();
  return filter->GetOutput();
}

} // namespace

int TestPointInversionThreads(int, char*[])
{
  return Run(
    []
    {
      CHECK(vtkSMPTools::SetBackend("STDThread"));
      std::vector<Point> points = RandomPoints(3000, 4.0);
      const auto one = Invert(points, 1);
      const auto two = Invert(points, 2);
      CHECK(vtkSMPTools::GetEstimatedNumberOfThreads() == 2);
      for (const char* name : kArrays)
      {
        CHECK(SameBits(PointArray(one, name), PointArray(two, name)));
      }
      for (const char* name : { "DistanceMean", "DistanceRMS", "DistancePercentile95" })
      {
        CHECK(FieldValue(one, name) == FieldValue(two, name));
      }

      std::reverse(points.begin(), points.end());
      const auto reversed = Invert(points, 2);
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
