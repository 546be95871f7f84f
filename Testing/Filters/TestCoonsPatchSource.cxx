// SPDX-License-Identifier: BSD-3-Clause
// vtkCoonsPatchSource: closed forms, all orders and directions, all kinds of input, arrays, faces,
// smoothing.
#include "GridTesting.h"

#include "vtkCoonsPatchSource.h"

#include <algorithm>

using namespace testing;

namespace
{

/// Sides of different shapes and lengths, no symmetry.
Sides Scalene()
{
  return { { [](double s) { return Point{ { 3 * s, 0.2 * s * (1 - s), 0 } }; },
    [](double s) { return Point{ { 3 + s, 2 * s, 0.5 * s * (1 - s) } }; },
    [](double s) { return Point{ { -0.5 + 4.5 * s, 1 + s + 0.3 * s * (1 - s), 0 } }; },
    [](double s) { return Point{ { -0.5 * s, s, 0.1 * s * (1 - s) } }; } } };
}

void TestClosedForms()
{
  vtkNew<vtkCoonsPatchSource> source;
  AddSides(source, BordersOf(Product), 9);
  source->SetResolution(9, 9);
  source->Update();
  CheckGrid(source->GetOutput(), 9, 9, Product, 1e-15);
  for (int role = 0; role < 4; ++role)
  {
    CHECK(FieldValue(source->GetOutput(), "CornerGaps", role) == 0.0);
    CHECK(FieldValue(source->GetOutput(), "EdgeOrder", role) == role);
    CHECK(FieldValue(source->GetOutput(), "EdgeReversed", role) == 0);
  }
  CHECK(FieldValue(source->GetOutput(), "SelfCrossing") == 0);
  CHECK(FieldValue(source->GetOutput(), "FoldedCellsBefore") == 0);
  CHECK(FieldValue(source->GetOutput(), "FoldedCellsAfter") == 0);
  CHECK(FieldValue(source->GetOutput(), "SmoothingStatus") == vtkCoonsPatchSource::NOT_SMOOTHED);

  vtkNew<vtkCoonsPatchSource> bump;
  AddSides(bump,
    BordersOf([](double u, double v) { return Point{ { u, v, u * u * v * v } }; }), 21);
  bump->Update();
  CHECK_NEAR(bump->GetOutput()->GetPoint(10 + 21 * 10)[2], 0.0, 1e-15);
}

/// The same bits whatever the order and directions of the sides.
void TestOrders()
{
  const Sides sides = Scalene();
  vtkNew<vtkCoonsPatchSource> first;
  AddSides(first, sides, 11);
  first->SetResolution(11, 11);
  first->Update();
  vtkDataArray* expected = first->GetOutput()->GetPoints()->GetData();
  CHECK(FieldValue(first->GetOutput(), "FoldedCellsAfter") == 0);
  std::array<int, 4> order{ { 0, 1, 2, 3 } };
  int count = 0;
  do
  {
    for (int mask = 0; mask < 16; ++mask)
    {
      vtkNew<vtkCoonsPatchSource> source;
      for (int k = 0; k < 4; ++k)
      {
        std::vector<Point> side = Sample(sides[order[k]], 11);
        if (mask >> k & 1)
        {
          std::reverse(side.begin(), side.end());
        }
        source->AddInputData(MakeLine(side));
      }
      source->SetResolution(11, 11);
      source->Update();
      vtkStructuredGrid* grid = source->GetOutput();
      CHECK(SameBits(grid->GetPoints()->GetData(), expected));
      for (int k = 0; k < 4; ++k)
      {
        CHECK(FieldValue(grid, "EdgeOrder", order[k]) == k);
        CHECK(FieldValue(grid, "EdgeReversed", order[k]) == (mask >> k & 1));
      }
      ++count;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  CHECK(count == 24 * 16);
}

/// One polygonal data set with four lines and roles, vertices before them.
void TestRoles()
{
  const Sides sides = BordersOf(Product);
  const std::array<int, 4> roles{ { 2, 0, 3, 1 } };
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkIntArray> array;
  array->SetName("BoundaryRole");
  const vtkIdType first = 0;
  vertices->InsertNextCell(1, &first);
  array->InsertNextValue(77); // of the vertex
  for (const int role : roles)
  {
    lines->InsertNextCell(6);
    for (const Point& p : Sample(sides[role], 6))
    {
      lines->InsertCellPoint(points->InsertNextPoint(p.data()));
    }
    array->InsertNextValue(role);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->SetLines(lines);
  data->GetCellData()->AddArray(array);
  vtkNew<vtkCoonsPatchSource> source;
  source->SetInputData(data);
  source->SetResolution(6, 6);
  source->Update();
  CheckGrid(source->GetOutput(), 6, 6, Product, 1e-15);
  for (int k = 0; k < 4; ++k)
  {
    CHECK(FieldValue(source->GetOutput(), "EdgeOrder", roles[k]) == k);
  }
}

/// A loop, with corners by angle or by point, in either sense, once with its first point repeated.
void TestLoops()
{
  std::vector<Point> loop;
  for (int i = 0; i < 40; ++i)
  {
    const double s = (i % 10) / 10.0;
    const Point sides[] = { { { 2 * s, 0, 0 } }, { { 2, s, 0 } }, { { 2 - 2 * s, 1, 0 } },
      { { 0, 1 - s, 0 } } };
    loop.push_back(sides[i / 10]);
  }
  std::rotate(loop.begin(), loop.begin() + 3, loop.end()); // starts inside the bottom
  for (const bool closed : { false, true })
  {
    std::vector<Point> points = loop;
    if (closed)
    {
      points.push_back(loop.front());
    }
    vtkNew<vtkCoonsPatchSource> source;
    source->SetInputData(MakeLine(points));
    source->SetResolution(11, 11);
    source->Update();
    CHECK(source->GetOutput()->GetNumberOfPoints() == 121);
    CHECK_NEAR(source->GetOutput()->GetPoint(60)[0], 1.0, 1e-14);
    CHECK_NEAR(source->GetOutput()->GetPoint(60)[1], 0.5, 1e-14);

    const int at = 37; // the corner (0, 0)
    for (const bool backwards : { false, true })
    {
      const auto id = [&](int k) { return (at + 10 * (backwards ? 4 - k : k)) % 40; };
      source->SetCornerIds(id(0), id(1), id(2), id(3));
      source->Update();
      const auto expected = [&](double u, double v)
      { return backwards ? Point{ { 2 * v, u, 0 } } : Point{ { 2 * u, v, 0 } }; };
      CheckGrid(source->GetOutput(), 11, 11, expected, 1e-14);
    }
  }
}

/// Three sides: one is a point.
void TestThreeSides()
{
  vtkNew<vtkCoonsPatchSource> source;
  source->AddInputData(MakeLine({ { { 0, 0, 0 } }, { { 2, 0, 0 } } }));
  source->AddInputData(MakeLine({ { { 2, 0, 0 } }, { { 1, 2, 0 } } }));
  source->AddInputData(MakeLine({ { { 1, 2, 0 } }, { { 0, 0, 0 } } }));
  source->SetResolution(5, 5);
  source->Update();
  vtkStructuredGrid* grid = source->GetOutput();
  CHECK(grid->GetNumberOfPoints() == 25);
  int collapsed = 0;
  for (int role = 0; role < 4; ++role)
  {
    collapsed += FieldValue(grid, "EdgeOrder", role) == -1 ? 1 : 0;
  }
  CHECK(collapsed == 1);
  CHECK(FieldValue(grid, "FoldedCellsAfter") == 0);
}

void TestFaces()
{
  vtkNew<vtkCoonsPatchSource> source;
  AddSides(source, BordersOf(Product), 3);
  source->SetResolution(3, 3);
  source->Update();
  const auto cell = [&](vtkIdType i)
  {
    vtkNew<vtkIdList> ids;
    source->GetMeshOutput()->GetPolys()->GetCellAtId(i, ids);
    std::vector<vtkIdType> result;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      result.push_back(ids->GetId(k));
    }
    return result;
  };
  using Ids = std::vector<vtkIdType>;
  CHECK(source->GetMeshOutput()->GetNumberOfPolys() == 4);
  CHECK((cell(0) == Ids{ 0, 1, 4, 3 } && cell(1) == Ids{ 1, 2, 5, 4 }));

  source->SetCellTypeToTriangles();
  source->Update();
  CHECK(source->GetMeshOutput()->GetNumberOfPolys() == 8);
  CHECK((cell(0) == Ids{ 0, 1, 3 } && cell(1) == Ids{ 1, 4, 3 })); // AlignLeft
  CHECK((cell(2) == Ids{ 1, 2, 4 }));
  source->SetTriangleStyleToAlignRight();
  source->Update();
  CHECK((cell(0) == Ids{ 0, 1, 4 } && cell(1) == Ids{ 0, 4, 3 }));
  CHECK((cell(2) == Ids{ 1, 2, 5 }));
  source->SetTriangleStyleToUnionJack();
  source->Update();
  CHECK((cell(0) == Ids{ 0, 1, 3 } && cell(2) == Ids{ 1, 2, 5 } && cell(4) == Ids{ 3, 4, 7 } &&
    cell(6) == Ids{ 4, 5, 7 }));
  for (vtkIdType i = 0; i < 8; ++i)
  {
    CHECK(CellValue(source->GetMeshOutput(), "Jacobian", i) ==
      CellValue(source->GetOutput(), "Jacobian", i / 2));
  }
  CHECK(source->GetMeshOutput()->GetFieldData()->HasArray("EdgeOrder"));
}

void TestArrays()
{
  vtkNew<vtkCoonsPatchSource> source;
  AddSides(source, BordersOf([](double u, double v) { return Point{ { 2 * u, v, 3 } }; }), 5);
  source->SetResolution(5, 3);
  source->SetParametrizationToArcLengthRecorded();
  source->Update();
  for (vtkPointSet* data : { static_cast<vtkPointSet*>(source->GetOutput()),
         static_cast<vtkPointSet*>(source->GetMeshOutput()) })
  {
    vtkPointData* points = data->GetPointData();
    CHECK(points->GetNormals() == points->GetArray("Normals"));
    CHECK(points->GetTCoords() == points->GetArray("TCoords"));
    CHECK(points->GetTCoords()->GetNumberOfComponents() == 2);
    for (vtkIdType i = 0; i < 15; ++i)
    {
      CHECK_NEAR(Value(data, "Normals", i, 2), 1.0, 1e-15);
      CHECK(Value(data, "TCoords", i, 0) == (i % 5) / 4.0);
      CHECK(Value(data, "TCoords", i, 1) == (i / 5) / 2.0);
      CHECK_NEAR(Value(data, "ArcLengthU", i), (i % 5) / 4.0, 1e-15);
      CHECK_NEAR(Value(data, "ArcLengthV", i), (i / 5) / 2.0, 1e-15);
    }
    for (vtkIdType i = 0; i < 8; ++i)
    {
      CHECK_NEAR(CellValue(data, "Jacobian", i), 1.0, 1e-15);
      CHECK(CellValue(data, "Folded", i) == 0);
    }
  }
  source->GenerateNormalsOff();
  source->GenerateTextureCoordinatesOff();
  source->SetParametrizationToUniform();
  source->Update();
  CHECK(source->GetOutput()->GetPointData()->GetNumberOfArrays() == 0);
}

/// Folded cells of the table of known grids, and none after smoothing.
void TestSmoothing()
{
  vtkNew<vtkCoonsPatchSource> source;
  AddSides(source, Swan(), 21);
  source->Update();
  CheckGrid(source->GetOutput(), 21, 21, SwanPoint, 1e-15);
  CHECK(FieldValue(source->GetOutput(), "FoldedCellsBefore") == 18);
  CHECK(FieldValue(source->GetOutput(), "FoldedCellsAfter") == 18);
  double sum = 0.0;
  double minimum = 1.0;
  for (vtkIdType i = 0; i < 400; ++i)
  {
    sum += CellValue(source->GetOutput(), "Folded", i);
    minimum = std::min(minimum, CellValue(source->GetOutput(), "Jacobian", i));
  }
  CHECK(sum == 18);
  CHECK_NEAR(minimum, -0.356, 5e-4);

  source->SetSmoothingToAuto();
  source->Update();
  CHECK(FieldValue(source->GetOutput(), "FoldedCellsBefore") == 18);
  CHECK(FieldValue(source->GetOutput(), "FoldedCellsAfter") == 0);
  CHECK(FieldValue(source->GetOutput(), "SmoothingStatus") == vtkCoonsPatchSource::CONVERGED);
  for (vtkIdType i = 0; i < 400; ++i)
  {
    CHECK(CellValue(source->GetOutput(), "Folded", i) == 0);
  }
}

} // namespace

int TestCoonsPatchSource(int, char*[])
{
  return Run(
    []
    {
      TestClosedForms();
      TestOrders();
      TestRoles();
      TestLoops();
      TestThreeSides();
      TestFaces();
      TestArrays();
      TestSmoothing();
    });
}
