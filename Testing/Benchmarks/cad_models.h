// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace inversion_benchmark
{

/// Copies of a model beside each other on a grid in x and y. \param bounds of the one
vtkSmartPointer<vtkMultiBlockDataSet> copies_of(
  vtkMultiBlockDataSet* model, int copies, const double bounds[6]);

/// A scan of such copies: points of triangles, chosen by their areas, with noise that is uniform in
/// a box of 1e-4 to 1e-3 of the size. The same in every run.
vtkSmartPointer<vtkPolyData> scan_of(
  vtkPolyData* mesh, vtkIdType count, int copies, const double bounds[6], double size);

} // namespace inversion_benchmark
