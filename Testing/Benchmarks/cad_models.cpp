// SPDX-License-Identifier: BSD-3-Clause
#include "cad_models.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace inversion_benchmark
{
namespace
{

vtkSmartPointer<vtkStructuredGrid> moved(vtkStructuredGrid* surface, const double by[3])
{
  auto copy = vtkSmartPointer<vtkStructuredGrid>::New();
  copy->DeepCopy(surface);
  for (vtkIdType k = 0; k < copy->GetNumberOfPoints(); ++k)
  {
    double at[3];
    copy->GetPoint(k, at);
    copy->GetPoints()->SetPoint(k, at[0] + by[0], at[1] + by[1], at[2] + by[2]);
  }
  return copy;
}

vtkSmartPointer<vtkDataObject> moved_face(vtkDataObject* face, const double by[3])
{
  if (auto* surface = vtkStructuredGrid::SafeDownCast(face))
  {
    return moved(surface, by);
  }
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(face);
  auto copy = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  copy->ShallowCopy(blocks);
  copy->SetBlock(0, moved(vtkStructuredGrid::SafeDownCast(blocks->GetBlock(0)), by));
  return copy;
}

} // namespace

vtkSmartPointer<vtkMultiBlockDataSet> copies_of(
  vtkMultiBlockDataSet* model, int copies, const double bounds[6])
{
  auto all = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const int side = static_cast<int>(std::ceil(std::sqrt(copies)));
  unsigned int next = 0;
  for (int k = 0; k < copies; ++k)
  {
    const double by[3] = { 1.1 * (bounds[1] - bounds[0]) * (k % side),
      1.1 * (bounds[3] - bounds[2]) * (k / side), 0.0 };
    for (unsigned int f = 0; f < model->GetNumberOfBlocks(); ++f)
    {
      if (model->GetBlock(f))
      {
        all->SetBlock(next++, moved_face(model->GetBlock(f), by));
      }
    }
  }
  return all;
}

vtkSmartPointer<vtkPolyData> scan_of(
  vtkPolyData* mesh, vtkIdType count, int copies, const double bounds[6], double size)
{
  std::vector<double> areas;
  std::vector<std::array<vtkIdType, 3>> triangles;
  vtkNew<vtkIdList> ids;
  double total = 0.0;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellPoints(cell, ids);
    if (ids->GetNumberOfIds() != 3)
    {
      continue;
    }
    double p[3][3];
    for (int k = 0; k < 3; ++k)
    {
      mesh->GetPoint(ids->GetId(k), p[k]);
    }
    double a[3];
    double b[3];
    for (int i = 0; i < 3; ++i)
    {
      a[i] = p[1][i] - p[0][i];
      b[i] = p[2][i] - p[0][i];
    }
    const double c[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
      a[0] * b[1] - a[1] * b[0] };
    total += std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    areas.push_back(total);
    triangles.push_back({ { ids->GetId(0), ids->GetId(1), ids->GetId(2) } });
  }
  std::mt19937_64 engine(1);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const int side = static_cast<int>(std::ceil(std::sqrt(copies)));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const auto found = std::lower_bound(areas.begin(), areas.end(), uniform() * total);
    const auto& corners = triangles[std::min<std::size_t>(
      static_cast<std::size_t>(found - areas.begin()), triangles.size() - 1)];
    double s = uniform();
    double t = uniform();
    if (s + t > 1.0)
    {
      s = 1.0 - s;
      t = 1.0 - t;
    }
    double p[3][3];
    for (int c = 0; c < 3; ++c)
    {
      mesh->GetPoint(corners[static_cast<std::size_t>(c)], p[c]);
    }
    const double noise = std::pow(10.0, -4.0 + uniform()) * size;
    const auto copy = static_cast<int>(uniform() * copies);
    double at[3];
    for (int i = 0; i < 3; ++i)
    {
      const double by = i == 0 ? 1.1 * (bounds[1] - bounds[0]) * (copy % side)
        : i == 1               ? 1.1 * (bounds[3] - bounds[2]) * (copy / side)
                               : 0.0;
      at[i] = p[0][i] + s * (p[1][i] - p[0][i]) + t * (p[2][i] - p[0][i]) + by +
        noise * (2.0 * uniform() - 1.0);
    }
    points->SetPoint(k, at);
  }
  auto scan = vtkSmartPointer<vtkPolyData>::New();
  scan->SetPoints(points);
  return scan;
}

} // namespace inversion_benchmark
