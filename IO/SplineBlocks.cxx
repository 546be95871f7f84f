// SPDX-License-Identifier: BSD-3-Clause
#include "SplineBlocks.h"

#include "FieldArrays.h"

#include "footpoint/splines/surface.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"

#include <algorithm>

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

Points points_of(const Spline& spline)
{
  return Eigen::Map<const Points>(
    spline.points.data(), 3, static_cast<Eigen::Index>(spline.number_of_points()));
}

Eigen::VectorXd weights_of(const Spline& spline)
{
  return Eigen::Map<const Eigen::VectorXd>(
    spline.weights.data(), static_cast<Eigen::Index>(spline.weights.size()));
}

} // namespace

Curve make_curve(const Spline& spline)
{
  return Curve(
    KnotVector(spline.degree[0], spline.knots[0], "KnotsU"), points_of(spline), weights_of(spline));
}

void check(const Spline& spline)
{
  if (spline.dimension == 1)
  {
    make_curve(spline);
  }
  else
  {
    Surface(KnotVector(spline.degree[0], spline.knots[0], "KnotsU"),
      KnotVector(spline.degree[1], spline.knots[1], "KnotsV"), points_of(spline),
      weights_of(spline));
  }
}

void reorder(Spline& surface, std::size_t fastest, std::size_t slowest)
{
  const Spline given = surface;
  for (std::size_t i = 0; i < fastest; ++i)
  {
    for (std::size_t j = 0; j < slowest; ++j)
    {
      const std::size_t from = i + fastest * j;
      const std::size_t to = j + slowest * i;
      std::copy_n(&given.points[3 * from], 3, &surface.points[3 * to]);
      if (!given.weights.empty())
      {
        surface.weights[to] = given.weights[from];
      }
    }
  }
}

void refuse_face_data(const Spline& spline, std::size_t index, const std::string& format)
{
  const std::string which = "spline " + std::to_string(index) + ": ";
  if (!spline.loops.empty())
  {
    throw FileError(which + "it is a trimmed face, which the format " + format + " does not have");
  }
  if (spline.reversed)
  {
    throw FileError(which + "its Orientation is -1, which the format " + format + " does not have");
  }
}

std::string checked_name(const Spline& spline, std::size_t index)
{
  int more = 0; // bytes of the present character
  bool good = true;
  for (const char c : spline.name)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (more > 0)
    {
      good = good && (byte & 0xc0) == 0x80;
      --more;
    }
    else if (byte < 0x80)
    {
      good = good && (byte >= 0x20 || c == '\t' || c == '\n' || c == '\r');
    }
    else
    {
      good = good && byte >= 0xc2 && byte < 0xf5;
      more = byte < 0xe0 ? 1 : (byte < 0xf0 ? 2 : 3);
    }
  }
  if (!good || more > 0)
  {
    throw FileError("spline " + std::to_string(index) +
      ": its name is no text that can be written (control characters, or no UTF-8)");
  }
  return spline.name;
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
