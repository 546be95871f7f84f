// SPDX-License-Identifier: BSD-3-Clause
#include "NetAssembly.h"

#include "GeometryArrays.h"
#include "GeometryHash.h"
#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace footpoint::conversion
{

namespace
{

ContentHash hash_of_fields(vtkStructuredGrid* net)
{
  ContentHash hash;
  for (const std::string& name : geometry_field_arrays())
  {
    hash.add(net->GetFieldData()->GetAbstractArray(name.c_str()));
  }
  return hash;
}

/// Control points in u, v and w, by knots and degrees or, where no degree is given, as far as the
/// parts reach.
std::array<int, 3> whole_dimensions(const std::vector<vtkStructuredGrid*>& parts)
{
  vtkFieldData* const fields = parts.front()->GetFieldData();
  const std::vector<double> degrees = read_field_array(fields, "Degree");
  static const char* const kKnots[] = { "KnotsU", "KnotsV" };
  std::array<int, 3> dimensions{ { 1, 1, 1 } };
  for (std::size_t d = 0; d < dimensions.size(); ++d)
  {
    const std::size_t knots = d < 2 ? read_field_array(fields, kKnots[d]).size() : 0;
    if (d < degrees.size() && knots > 0)
    {
      dimensions[d] = static_cast<int>(knots) - static_cast<int>(degrees[d]) - 1;
      continue;
    }
    for (vtkStructuredGrid* part : parts)
    {
      dimensions[d] = std::max(dimensions[d], part->GetExtent()[2 * d + 1] + 1);
    }
  }
  return dimensions;
}

bool is_whole(vtkStructuredGrid* net, const std::array<int, 3>& dimensions)
{
  const int* const extent = net->GetExtent();
  for (std::size_t d = 0; d < dimensions.size(); ++d)
  {
    if (extent[2 * d] != 0 || extent[2 * d + 1] != dimensions[d] - 1)
    {
      return false;
    }
  }
  return true;
}

[[noreturn]] void refuse(int i, int j, const std::string& what)
{
  throw GeometryError(GeometryDefect::Format,
    "the parts of a net on the ranks do not make the net: control point (" + std::to_string(i) +
      ", " + std::to_string(j) + ") " + what);
}

/// The control points of a net that is filled part by part: x, y, z and weight of each.
class Assembly
{
public:
  explicit Assembly(const std::array<int, 3>& dimensions)
    : Dimensions(dimensions)
    , Values(static_cast<std::size_t>(dimensions[0]) * dimensions[1])
    , Known(this->Values.size(), 0)
  {
  }

  void add(vtkStructuredGrid* part, bool weighted)
  {
    const int* const extent = part->GetExtent();
    const Eigen::VectorXd weights = read_weights(part);
    vtkIdType id = 0;
    if (extent[4] != 0 || extent[5] != 0)
    {
      refuse(extent[0], extent[2], "is not in the plane of a net, its third index is not 0");
    }
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i, ++id)
      {
        if (i < 0 || j < 0 || i >= this->Dimensions[0] || j >= this->Dimensions[1])
        {
          refuse(i, j, "is outside the net that the knots and degrees ask for");
        }
        std::array<double, 4> value{ { 0.0, 0.0, 0.0, weighted ? weights[id] : 1.0 } };
        part->GetPoint(id, value.data());
        this->set(i, j, value);
      }
    }
  }

  vtkSmartPointer<vtkStructuredGrid> net(bool weighted) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(this->Values.size()));
    vtkNew<vtkDoubleArray> weights;
    weights->SetNumberOfValues(points->GetNumberOfPoints());
    for (std::size_t k = 0; k < this->Values.size(); ++k)
    {
      if (!this->Known[k])
      {
        const auto row = static_cast<std::size_t>(this->Dimensions[0]);
        refuse(static_cast<int>(k % row), static_cast<int>(k / row), "is on no rank");
      }
      points->SetPoint(static_cast<vtkIdType>(k), this->Values[k].data());
      weights->SetValue(static_cast<vtkIdType>(k), this->Values[k][3]);
    }
    auto result = vtkSmartPointer<vtkStructuredGrid>::New();
    result->SetDimensions(this->Dimensions.data());
    result->SetPoints(points);
    add_geometry_array(
      result->GetPointData(), weighted ? weights.Get() : nullptr, "RationalWeights");
    return result;
  }

private:
  void set(int i, int j, const std::array<double, 4>& value)
  {
    const std::size_t at = static_cast<std::size_t>(j) * this->Dimensions[0] + i;
    // Bits are compared, so that NaN agrees with itself and is named by who reads the net.
    if (this->Known[at] && std::memcmp(this->Values[at].data(), value.data(), sizeof(value)) != 0)
    {
      refuse(i, j, "has another value on one rank than on another");
    }
    this->Values[at] = value;
    this->Known[at] = 1;
  }

  std::array<int, 3> Dimensions;
  std::vector<std::array<double, 4>> Values;
  std::vector<char> Known;
};

} // namespace

bool are_parts_of_one_net(const std::vector<vtkStructuredGrid*>& parts)
{
  const ContentHash fields = hash_of_fields(parts.front());
  const std::array<int, 3> dimensions = whole_dimensions(parts);
  const bool equal_fields = std::all_of(parts.begin(), parts.end(),
    [&](vtkStructuredGrid* part) { return hash_of_fields(part) == fields; });
  const bool all_whole = std::all_of(parts.begin(), parts.end(),
    [&](vtkStructuredGrid* part) { return is_whole(part, dimensions); });
  return equal_fields && !all_whole && dimensions[0] > 0 && dimensions[1] > 0;
}

vtkSmartPointer<vtkStructuredGrid> assemble_net(const std::vector<vtkStructuredGrid*>& parts)
{
  const auto has_weights = [](vtkStructuredGrid* part) { return read_weights(part).size() > 0; };
  const bool weighted = std::any_of(parts.begin(), parts.end(), has_weights);
  if (weighted && !std::all_of(parts.begin(), parts.end(), has_weights))
  {
    throw GeometryError(GeometryDefect::Format,
      "the parts of a net on the ranks do not make the net: not all have RationalWeights");
  }
  const std::array<int, 3> dimensions = whole_dimensions(parts);
  vtkIdType there = 0;
  for (vtkStructuredGrid* part : parts)
  {
    there += part->GetNumberOfPoints();
  }
  // Before memory is taken for a number that may be anything.
  if (static_cast<vtkIdType>(dimensions[0]) * dimensions[1] > there)
  {
    throw GeometryError(GeometryDefect::Count,
      "the parts of a net on the ranks do not make the net: they have " + std::to_string(there) +
        " control points, the knots and degrees ask for " + std::to_string(dimensions[0]) + " x " +
        std::to_string(dimensions[1]));
  }
  Assembly assembly(dimensions);
  for (vtkStructuredGrid* part : parts)
  {
    assembly.add(part, weighted);
  }
  vtkSmartPointer<vtkStructuredGrid> result = assembly.net(weighted);
  result->GetFieldData()->ShallowCopy(parts.front()->GetFieldData());
  return result;
}

} // namespace footpoint::conversion
