// SPDX-License-Identifier: BSD-3-Clause
#include "SplineBlocks.h"

#include "FieldArrays.h"

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"

namespace footpoint::files
{

namespace
{

void append(vtkMultiBlockDataSet* blocks, vtkDataObject* data, const std::string& name)
{
  const unsigned int number = blocks->GetNumberOfBlocks();
  blocks->SetBlock(number, data);
  if (!name.empty())
  {
    blocks->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), name.c_str());
  }
}

} // namespace

void check(const Spline& spline)
{
  const Points points = Eigen::Map<const Points>(
    spline.points.data(), 3, static_cast<Eigen::Index>(spline.number_of_points()));
  const Eigen::VectorXd weights = Eigen::Map<const Eigen::VectorXd>(
    spline.weights.data(), static_cast<Eigen::Index>(spline.weights.size()));
  KnotVector knots_u(spline.degree[0], spline.knots[0], "KnotsU");
  if (spline.dimension == 1)
  {
    Curve(std::move(knots_u), points, weights);
  }
  else
  {
    Surface(
      std::move(knots_u), KnotVector(spline.degree[1], spline.knots[1], "KnotsV"), points, weights);
  }
}

vtkSmartPointer<vtkStructuredGrid> make_net(const Spline& spline)
{
  using namespace conversion;
  const bool polyline = spline.knots[0].empty();
  auto net = vtkSmartPointer<vtkStructuredGrid>::New();
  net->SetDimensions(static_cast<int>(polyline ? spline.number_of_points() : spline.size(0)),
    spline.dimension == 2 ? static_cast<int>(spline.size(1)) : 1, 1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(spline.number_of_points()));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, &spline.points[static_cast<std::size_t>(3 * i)]);
  }
  net->SetPoints(points);

  vtkFieldData* data = net->GetFieldData();
  if (!polyline)
  {
    set_numbers(data, "KnotsU", spline.knots[0]);
    std::vector<int> degrees{ spline.degree[0] };
    if (spline.dimension == 2)
    {
      set_numbers(data, "KnotsV", spline.knots[1]);
      degrees.push_back(spline.degree[1]);
    }
    set_integers(data, "Degree", degrees);
  }
  if (!spline.weights.empty())
  {
    set_numbers(net->GetPointData(), "RationalWeights", spline.weights);
    net->GetPointData()->SetActiveRationalWeights("RationalWeights");
  }
  if (spline.reversed)
  {
    set_integer(data, "Orientation", -1);
  }
  if (!spline.name.empty())
  {
    vtkNew<vtkStringArray> name;
    name->SetName("FaceName");
    name->InsertNextValue(spline.name);
    data->AddArray(name);
  }
  return net;
}

void append_block(vtkMultiBlockDataSet* blocks, const Spline& spline)
{
  const vtkSmartPointer<vtkStructuredGrid> net = make_net(spline);
  if (spline.loops.empty())
  {
    append(blocks, net, spline.name);
    return;
  }
  vtkNew<vtkMultiBlockDataSet> face;
  append(face, net, "Surface");
  for (std::size_t i = 0; i < spline.loops.size(); ++i)
  {
    vtkNew<vtkMultiBlockDataSet> loop;
    for (std::size_t j = 0; j < spline.loops[i].size(); ++j)
    {
      append(loop, make_net(spline.loops[i][j]), "Curve " + std::to_string(j));
    }
    append(face, loop, "Loop " + std::to_string(i));
  }
  append(blocks, face, spline.name);
}

} // namespace footpoint::files
