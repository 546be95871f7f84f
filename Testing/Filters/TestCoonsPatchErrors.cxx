// SPDX-License-Identifier: BSD-3-Clause
// Boundaries that vtkCoonsPatchSource refuses: the message names the sides and says how far, both
// outputs are empty; and it works again once the boundary is mended.
#include "GridTesting.h"

#include "vtkAppendPolyData.h"
#include "vtkCoonsPatchSource.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

using namespace testing;

namespace
{

Sides Square()
{
  return BordersOf([](double u, double v) { return Point{ { u, v, 0 } }; });
}

std::vector<std::vector<Point>> SquareSides(int count = 3)
{
  std::vector<std::vector<Point>> sides;
  for (const Curve& side : Square())
  {
    sides.push_back(Sample(side, count));
  }
  return sides;
}

/// The error of a source; checks that there is one iff outputs are empty.
std::string ErrorOf(vtkCoonsPatchSource* source)
{
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(source);
  source->Update();
  CHECK((source->GetOutput()->GetNumberOfPoints() == 0) == !recorder->Errors.empty());
  CHECK((source->GetMeshOutput()->GetNumberOfPoints() == 0) == !recorder->Errors.empty());
  source->RemoveAllObservers();
  source->GetExecutive()->RemoveAllObservers();
  return recorder->Errors;
}

void CheckRefused(vtkCoonsPatchSource* source, const std::vector<std::string>& parts)
{
  const std::string error = ErrorOf(source);
  for (const std::string& part : parts)
  {
    if (error.empty() || !Contains(error, part))
    {
      throw std::runtime_error("expected '" + part + "' in '" + error + "'");
    }
  }
}

void CheckRefused(
  const std::vector<std::vector<Point>>& lines, const std::vector<std::string>& parts)
{
  for (const int resolution : { 21, 0 })
  {
    vtkNew<vtkCoonsPatchSource> source;
    for (const std::vector<Point>& line : lines)
    {
      source->AddInputData(MakeLine(line));
    }
    source->SetResolution(resolution, resolution);
    CheckRefused(source, parts);
  }
}

void TestCounts()
{
  vtkNew<vtkCoonsPatchSource> none;
  CheckRefused(none, { "no lines" });
  vtkNew<vtkCoonsPatchSource> empty;
  vtkNew<vtkPolyData> nothing;
  empty->SetInputData(nothing);
  CheckRefused(empty, { "no lines" });
  const auto sides = SquareSides();
  CheckRefused({ sides[0], sides[2] }, { "0 closed loops and 2 open chains" });
  CheckRefused({ sides[0], sides[1], sides[2], { { { 0, 0, 0 } } } }, {});
}

void TestGaps()
{
  auto sides = SquareSides();
  sides[2].back()[0] += 0.1;
  CheckRefused(sides, { "0.1" });
  for (Point& point : sides[2])
  {
    point[2] = std::nan("");
  }
  CheckRefused(sides, {});

  // Small gaps are closed on request and reported.
  sides = SquareSides();
  sides[2].back()[0] += 1e-4;
  CheckRefused(sides, { "0.0001" });
  vtkNew<vtkCoonsPatchSource> source;
  for (const std::vector<Point>& side : sides)
  {
    source->AddInputData(MakeLine(side));
  }
  source->ForceCornerMatchOn();
  CHECK(ErrorOf(source).empty());
  CHECK_NEAR(FieldValue(source->GetOutput(), "CornerGaps", 2), 1e-4, 1e-12);
  CHECK(FieldValue(source->GetOutput(), "CornerGaps", 0) == 0.0);
  source->SetCornerTolerance(1e-5);
  CheckRefused(source, { "0.0001" });
  source->SetCornerTolerance(1e-3);
  CHECK(ErrorOf(source).empty());
}

void TestOptions()
{
  const auto sides = SquareSides();
  vtkNew<vtkCoonsPatchSource> source;
  for (const std::vector<Point>& side : sides)
  {
    source->AddInputData(MakeLine(side));
  }
  for (const int resolution : { 1, -1 })
  {
    source->SetResolution(resolution, 5);
    CheckRefused(source, {});
  }
  source->SetResolution(5, 5);
  CHECK(ErrorOf(source).empty());

  vtkNew<vtkCoonsPatchSource> strict;
  for (const int side : { 0, 2, 1, 3 })
  {
    strict->AddInputData(MakeLine(sides[side]));
  }
  CHECK(ErrorOf(strict).empty());
  strict->StrictOn();
  CheckRefused(strict, {});
}

void TestRoles()
{
  const auto sides = SquareSides();
  vtkNew<vtkAppendPolyData> all;
  for (const std::vector<Point>& side : sides)
  {
    all->AddInputData(MakeLine(side));
  }
  all->Update();
  for (const double bad : { 4.0, 0.5, -2.0, 1.0 })
  {
    vtkNew<vtkPolyData> data;
    data->ShallowCopy(all->GetOutput());
    AddNumbers(data->GetCellData(), "BoundaryRole", { 0, 1, bad, 3 });
    vtkNew<vtkCoonsPatchSource> source;
    source->SetInputData(data);
    CheckRefused(source, { "BoundaryRole[2] = " });
  }
}

void TestLoops()
{
  std::vector<Point> loop;
  for (int i = 0; i < 8; ++i)
  {
    const double angle = 0.25 * i * vtkMath::Pi();
    loop.push_back({ { std::cos(angle), std::sin(angle), 0 } });
  }
  vtkNew<vtkCoonsPatchSource> source;
  source->SetInputData(MakeLine(loop));
  source->SetCornerIds(0, 2, 4, 9);
  CheckRefused(source, { "corner id 9 is no point of the loop" });
  source->SetCornerIds(0, 4, 2, 6);
  CheckRefused(source, {});
  source->SetCornerIds(0, 2, 4, 6);
  CHECK(ErrorOf(source).empty());

  // Two loops of two-point segments.
  std::vector<std::vector<Point>> segments;
  for (const double shift : { 0.0, 5.0 })
  {
    for (int i = 0; i < 8; ++i)
    {
      segments.push_back({ loop[i], loop[(i + 1) % 8] });
      for (Point& point : segments.back())
      {
        point[0] += shift;
      }
    }
  }
  CheckRefused(segments, { "2 closed loops (8 points through point " });
}

/// A figure of eight: there is a grid, and it is said that sides cross.
void TestSelfCrossing()
{
  vtkNew<vtkCoonsPatchSource> source;
  const std::vector<Point> corners{ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } },
    { { 1, 1, 0 } } };
  for (int k = 0; k < 4; ++k)
  {
    source->AddInputData(MakeLine({ corners[k], corners[(k + 1) % 4] }));
  }
  source->SetSmoothingToWinslow();
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(source);
  source->Update();
  CHECK(recorder->Errors.empty());
  CHECK(Contains(recorder->Warnings, "cross"));
  CHECK(FieldValue(source->GetOutput(), "SelfCrossing") == 1);
  CHECK(FieldValue(source->GetOutput(), "SmoothingStatus") == vtkCoonsPatchSource::REJECTED);
}

} // namespace

int TestCoonsPatchErrors(int, char*[])
{
  return Run(
    []
    {
      TestCounts();
      TestGaps();
      TestOptions();
      TestRoles();
      TestLoops();
      TestSelfCrossing();
    });
}
