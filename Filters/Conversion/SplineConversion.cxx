// SPDX-License-Identifier: BSD-3-Clause
#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <algorithm>

namespace footpoint::conversion
{

namespace
{

[[noreturn]] void refuse(GeometryDefect defect, const std::string& message)
{
  throw GeometryError(defect, message);
}

/// The knot vector of one direction, its degree implied by the numbers of knots and points.
KnotVector read_knots(vtkStructuredGrid* net, int direction, int number_of_points)
{
  static const char* const kNames[] = { "KnotsU", "KnotsV" };
  const std::string name = kNames[direction];
  std::vector<double> knots = read_field_array(net->GetFieldData(), name.c_str());
  if (knots.empty())
  {
    refuse(GeometryDefect::Format, "the field data array " + name + " is missing or empty");
  }
  const long implied = static_cast<long>(knots.size()) - number_of_points - 1;
  const std::vector<double> degrees = read_field_array(net->GetFieldData(), "Degree");
  if (!degrees.empty())
  {
    const auto at = static_cast<std::size_t>(direction);
    if (at >= degrees.size())
    {
      refuse(GeometryDefect::Count, "the field data array Degree has 1 value, a surface needs 2");
    }
    // A degree that is no number or no integer can never equal the implied one.
    if (degrees[at] != static_cast<double>(implied))
    {
      refuse(GeometryDefect::Count,
        "Degree[" + std::to_string(direction) + "] = " + vtkVariant(degrees[at]).ToString() +
          " does not fit: " + std::to_string(knots.size()) + " values in " + name + " and " +
          std::to_string(number_of_points) + " control points mean degree " +
          std::to_string(implied) + " (was the net cut, e.g. by an extraction filter?)");
    }
  }
  if (implied < 1)
  {
    refuse(GeometryDefect::Count,
      name + " has " + std::to_string(knots.size()) + " values, " +
        std::to_string(number_of_points) + " control points need at least " +
        std::to_string(number_of_points + 2));
  }
  return KnotVector(static_cast<int>(implied), std::move(knots), name);
}

void check_extent(vtkStructuredGrid* net)
{
  const int* extent = net->GetExtent();
  if (net->GetNumberOfPoints() == 0)
  {
    refuse(GeometryDefect::Count, "the net has no control points");
  }
  if (extent[0] != 0 || extent[2] != 0 || extent[4] != 0)
  {
    refuse(GeometryDefect::Format,
      "the extent of the net starts at (" + std::to_string(extent[0]) + ", " +
        std::to_string(extent[2]) + ", " + std::to_string(extent[4]) +
        ") instead of (0, 0, 0): it is a part that was cut from a net, whose knots no longer fit");
  }
  if (extent[5] != 0)
  {
    refuse(GeometryDefect::Format,
      "the net has dimensions (" + std::to_string(extent[1] + 1) + ", " +
        std::to_string(extent[3] + 1) + ", " + std::to_string(extent[5] + 1) +
        "); (nu, nv, 1) make a surface, (n, 1, 1) a curve");
  }
}

/// Walks over a composite data set and appends faces in order.
class Collector
{
public:
  Collector(ConvertedModel& result, bool flip)
    : Result(result)
    , Flip(flip)
  {
  }

  void add(vtkDataObject* data, const std::string& name)
  {
    if (!data)
    {
      this->add_empty(name);
    }
    else if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data))
    {
      this->add_blocks(blocks, name);
    }
    else if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(data))
    {
      for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
      {
        vtkInformation* meta = collection->HasMetaData(i) ? collection->GetMetaData(i) : nullptr;
        this->add(collection->GetPartitionedDataSet(i), block_name(meta));
      }
    }
    else if (auto* pieces = vtkPartitionedDataSet::SafeDownCast(data))
    {
      this->add_pieces(pieces, name);
    }
    else
    {
      this->add_leaf(data, name);
    }
  }

private:
  void add_blocks(vtkMultiBlockDataSet* blocks, const std::string& name)
  {
    if (is_trimmed_face(blocks))
    {
      this->add_trimmed(blocks, name);
      return;
    }
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      this->add(blocks->GetBlock(i), block_name(blocks, i));
    }
  }

  void add_trimmed(vtkMultiBlockDataSet* blocks, std::string name)
  {
    try
    {
      Face face = read_trimmed_face(blocks, name);
      face.name = name;
      face.reversed = face.reversed != this->Flip;
      this->Result.model.push_back(std::move(face));
    }
    catch (const GeometryError& error)
    {
      this->refuse_face(name, error.what());
    }
  }

  void add_pieces(vtkPartitionedDataSet* pieces, const std::string& name)
  {
    try
    {
      this->add(single_piece(pieces), name);
    }
    catch (const GeometryError& error)
    {
      this->refuse_face(name, error.what());
    }
  }

  void add_leaf(vtkDataObject* data, const std::string& block)
  {
    std::string name = block;
    try
    {
      if (auto* net = vtkStructuredGrid::SafeDownCast(data))
      {
        const FaceAttributes attributes = read_face_attributes(data->GetFieldData());
        name = attributes.name.empty() ? block : attributes.name;
        Face face;
        face.name = name;
        face.patches.push_back(convert_net(net));
        face.reversed = attributes.reversed != this->Flip;
        face.tolerance = attributes.tolerance;
        this->Result.model.push_back(std::move(face));
      }
      else if (auto* cells = vtkUnstructuredGrid::SafeDownCast(data))
      {
        this->add_cells(cells, block);
      }
      else
      {
        refuse(GeometryDefect::Format,
          std::string("it is a ") + data->GetClassName() +
            "; geometry is a vtkStructuredGrid of control points or a vtkUnstructuredGrid of "
            "Bézier cells");
      }
    }
    catch (const GeometryError& error)
    {
      this->refuse_face(name, error.what());
    }
  }

  void add_cells(vtkUnstructuredGrid* cells, const std::string& block)
  {
    ConvertedModel converted = convert_bezier_cells(cells);
    for (const Problem& problem : converted.problems)
    {
      this->Result.problems.push_back(
        { this->Result.model.size() + problem.face, problem.message });
    }
    for (Face& face : converted.model)
    {
      face.name = face.name.empty() ? block : face.name;
      face.reversed = face.reversed != this->Flip;
      this->Result.model.push_back(std::move(face));
    }
  }

  void add_empty(const std::string& name)
  {
    Face face;
    face.name = name;
    this->Result.model.push_back(std::move(face));
  }

  void refuse_face(const std::string& name, const std::string& message)
  {
    this->Result.problems.push_back({ this->Result.model.size(), message });
    this->add_empty(name);
  }

  ConvertedModel& Result;
  bool Flip;
};

/// Makes the regions of all faces with loops, each by itself.
void trim_all(ConvertedModel& result, const Execution& execution)
{
  std::vector<std::string> messages(result.model.size());
  for_each_index(execution, static_cast<std::int64_t>(messages.size()), kFacesForThreads,
    [&](std::int64_t k)
    {
      Face& face = result.model[k];
      try
      {
        if (!face.loops.empty())
        {
          trim(face);
        }
      }
      catch (const GeometryError& error)
      {
        messages[k] = error.what();
      }
    });
  for (std::size_t k = 0; k < messages.size(); ++k)
  {
    if (!messages[k].empty())
    {
      Face refused;
      refused.name = result.model[k].name;
      result.model[k] = std::move(refused);
      // Where it would be had the face been trimmed as it was read.
      const auto next = std::find_if(result.problems.begin(), result.problems.end(),
        [k](const Problem& problem) { return problem.face > k; });
      result.problems.insert(next, { k, messages[k] });
    }
  }
}

} // namespace

bool ConvertedModel::empty() const
{
  return std::all_of(
    this->model.begin(), this->model.end(), [](const Face& face) { return face.patches.empty(); });
}

std::string face_label(const Model& model, std::size_t face)
{
  const std::string& name = model[face].name;
  return "Face " + std::to_string(face) + (name.empty() ? "" : " ('" + name + "')");
}

std::vector<std::string> ConvertedModel::messages() const
{
  std::vector<std::string> result;
  for (const Problem& problem : this->problems)
  {
    result.push_back(face_label(this->model, problem.face) + ": " + problem.message);
  }
  return result;
}

ConvertedModel convert_to_model(vtkDataObject* source, bool flip, const Execution& execution)
{
  ConvertedModel result;
  Collector(result, flip).add(source, "");
  trim_all(result, execution);
  return result;
}

Patch convert_net(vtkStructuredGrid* net)
{
  check_extent(net);
  const int* extent = net->GetExtent();
  const int nu = extent[1] + 1;
  const int nv = extent[3] + 1;

  Points control_points(3, net->GetNumberOfPoints());
  for (vtkIdType i = 0; i < net->GetNumberOfPoints(); ++i)
  {
    net->GetPoint(i, control_points.col(i).data());
  }
  Eigen::VectorXd weights = read_weights(net);

  Patch patch;
  if (nv == 1)
  {
    if (net->GetFieldData() && net->GetFieldData()->HasArray("KnotsV"))
    {
      refuse(GeometryDefect::Format,
        "the net has dimensions (" + std::to_string(nu) +
          ", 1, 1) and an array KnotsV; a curve has KnotsU alone, a surface at least two rows");
    }
    patch.curve =
      std::make_shared<Curve>(read_knots(net, 0, nu), control_points, std::move(weights));
  }
  else
  {
    patch.surface = std::make_shared<Surface>(
      read_knots(net, 0, nu), read_knots(net, 1, nv), control_points, std::move(weights));
  }
  return patch;
}

Eigen::VectorXd read_weights(vtkDataSet* data)
{
  vtkDataArray* array = data->GetPointData()->GetRationalWeights();
  if (!array)
  {
    array = data->GetPointData()->GetArray("RationalWeights");
  }
  if (!array)
  {
    return {};
  }
  if (array->GetNumberOfComponents() != 1)
  {
    refuse(GeometryDefect::Format,
      "RationalWeights has " + std::to_string(array->GetNumberOfComponents()) +
        " components instead of 1");
  }
  if (array->GetNumberOfTuples() != data->GetNumberOfPoints())
  {
    refuse(GeometryDefect::Count,
      "RationalWeights has " + std::to_string(array->GetNumberOfTuples()) + " values for " +
        std::to_string(data->GetNumberOfPoints()) + " control points");
  }
  Eigen::VectorXd weights(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    weights[i] = array->GetComponent(i, 0);
  }
  return weights;
}

} // namespace footpoint::conversion
