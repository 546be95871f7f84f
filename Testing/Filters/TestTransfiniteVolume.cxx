// SPDX-License-Identifier: BSD-3-Clause
// vtkTransfiniteVolume: closed forms from faces and from edges, a left-handed input, faces that are
// cut from a volume, errors.
#include "GridTesting.h"

#include "vtkExtractGrid.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkTransfiniteVolume.h"

using namespace testing;

namespace
{

using Map = std::function<Point(double, double, double)>;

/// A whole block of a map.
vtkSmartPointer<vtkStructuredGrid> Block(const Map& map, int nu, int nv, int nw)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < nw; ++k)
  {
    for (int j = 0; j < nv; ++j)
    {
      for (int i = 0; i < nu; ++i)
      {
        points->InsertNextPoint(
          map(i / (nu - 1.0), j / (nv - 1.0), k / (nw - 1.0)).data());
      }
    }
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(nu, nv, nw);
  grid->SetPoints(points);
  return grid;
}

/// Its face number 0 … 5, with one dimension of 1.
vtkSmartPointer<vtkStructuredGrid> Face(vtkStructuredGrid* block, int number)
{
  int extent[6];
  block->GetExtent(extent);
  const int direction = number / 2;
  extent[2 * direction + (number % 2 == 0 ? 1 : 0)] = extent[2 * direction + number % 2];
  vtkNew<vtkExtractGrid> cut;
  cut->SetInputData(block);
  cut->SetVOI(extent);
  cut->Update();
  return cut->GetOutput();
}

void CheckVolume(vtkStructuredGrid* grid, vtkStructuredGrid* expected, double tolerance)
{
  int actual[3];
  int wanted[3];
  grid->GetDimensions(actual);
  expected->GetDimensions(wanted);
  CHECK(std::equal(actual, actual + 3, wanted));
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double p[3];
    grid->GetPoint(i, p);
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(p[k], expected->GetPoint(i)[k], tolerance);
    }
  }
}

Point Twisted(double u, double v, double w)
{
  return { { 2 * u + 0.2 * v * w, v - 0.1 * u * w, w + 0.1 * u * v } };
}

void TestFaces()
{
  const auto block = Block(Twisted, 5, 4, 3);
  vtkNew<vtkTransfiniteVolume> volume;
  for (int face = 0; face < 6; ++face)
  {
    volume->AddInputData(Face(block, face));
  }
  volume->Update();
  CheckVolume(volume->GetOutput(), block, 1e-14);
  CHECK(FieldValue(volume->GetOutput(), "Mirrored") == 0);
  CHECK(FieldValue(volume->GetOutput(), "FoldedCells") == 0);
  CHECK_NEAR(FieldValue(volume->GetOutput(), "LargestGap"), 0.0, 1e-15);
  for (vtkIdType i = 0; i < 24; ++i)
  {
    CHECK(CellValue(volume->GetOutput(), "Jacobian", i) > 0.9);
    CHECK(CellValue(volume->GetOutput(), "Folded", i) == 0);
  }
}

/// (uvw)²: the faces' interpolant has 1/32 in the middle, as the edges', each in a composite.
void TestProduct()
{
  const Map product = [](double u, double v, double w)
  { return Point{ { u + u * u * v * v * w * w, v, w } }; };
  const auto block = Block(product, 5, 5, 5);
  vtkNew<vtkMultiBlockDataSet> faces;
  for (int face = 0; face < 6; ++face)
  {
    faces->SetBlock(face, Face(block, face));
  }
  vtkNew<vtkTransfiniteVolume> volume;
  volume->SetInputData(faces);
  volume->Update();
  CHECK_NEAR(volume->GetOutput()->GetPoint(62)[0], 0.5 + 1.0 / 32.0, 1e-14);
}

void TestEdges()
{
  const auto block = Block(Twisted, 3, 3, 3);
  vtkNew<vtkTransfiniteVolume> volume;
  for (int direction = 0; direction < 3; ++direction)
  {
    for (int corner = 0; corner < 4; ++corner)
    {
      volume->AddInputData(MakeLine(Sample(
        [=](double t)
        {
          const double a = corner % 2;
          const double b = corner / 2;
          return direction == 0 ? Twisted(t, a, b)
            : direction == 1    ? Twisted(a, t, b)
                                : Twisted(a, b, t);
        },
        3)));
    }
  }
  volume->Update();
  CheckVolume(volume->GetOutput(), block, 1e-14);
}

void TestLeftHanded()
{
  const auto block =
    Block([](double u, double v, double w) { return Twisted(1 - u, v, w); }, 3, 3, 3);
  vtkNew<vtkTransfiniteVolume> volume;
  for (int face = 0; face < 6; ++face)
  {
    volume->AddInputData(Face(block, face));
  }
  volume->Update();
  CHECK(FieldValue(volume->GetOutput(), "Mirrored") == 1);
  CHECK(FieldValue(volume->GetOutput(), "FoldedCells") == 0);
  CheckVolume(volume->GetOutput(), Block(Twisted, 3, 3, 3), 1e-14);
}

std::string ErrorOf(vtkTransfiniteVolume* volume)
{
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(volume);
  volume->Update();
  CHECK(volume->GetOutput()->GetNumberOfPoints() == 0);
  return recorder->Errors;
}

void TestErrors()
{
  const auto block = Block(Twisted, 3, 3, 3);
  vtkNew<vtkTransfiniteVolume> volume;
  for (int face = 0; face < 5; ++face)
  {
    volume->AddInputData(Face(block, face));
  }
  CHECK(Contains(ErrorOf(volume), "there are 5 and 0"));
  vtkNew<vtkTransfiniteVolume> solid;
  for (int face = 0; face < 6; ++face)
  {
    solid->AddInputData(face == 3 ? vtkSmartPointer<vtkStructuredGrid>(block) : Face(block, face));
  }
  CHECK(Contains(ErrorOf(solid), "face v = 1 has 3 x 3 x 3 points"));
  const auto moved = Face(block, 5);
  moved->GetPoints()->SetPoint(0, 0, 0, 7);
  volume->AddInputData(moved);
  CHECK(!ErrorOf(volume).empty());
}

} // namespace

int TestTransfiniteVolume(int, char*[])
{
  return Run(
    []
    {
      TestFaces();
      TestProduct();
      TestEdges();
      TestLeftHanded();
      TestErrors();
    });
}
