// SPDX-License-Identifier: BSD-3-Clause
#include "SplineCollection.h"

#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"

#include <map>
#include <set>

namespace footpoint::files
{

namespace
{

using namespace conversion;

class Collector
{
public:
  SplineFile collect(vtkDataObject* data)
  {
    this->add(data, "");
    if (!this->Others.empty())
    {
      std::string names;
      for (const std::string& name : this->Others)
      {
        names += (names.empty() ? "" : ", ") + name;
      }
      this->File.warnings.push_back("arrays that are no spline are left out: " + names);
    }
    return std::move(this->File);
  }

private:
  void add(vtkDataObject* data, const std::string& name)
  {
    if (!data)
    {
      this->File.warnings.push_back(this->face(name) +
        " is empty and left out; the faces after it have lower numbers in the file");
    }
    else if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data))
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
    else if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(data))
    {
      for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
      {
        this->add(collection->GetPartitionedDataSet(i),
          block_name(collection->HasMetaData(i) ? collection->GetMetaData(i) : nullptr));
      }
    }
    else
    {
      this->add_leaf(data, name);
    }
  }

  void add_leaf(vtkDataObject* data, const std::string& name)
  {
    try
    {
      vtkDataObject* whole = single_piece(data);
      auto* net = vtkStructuredGrid::SafeDownCast(whole);
      if (!whole)
      {
        this->add(nullptr, name);
        return;
      }
      if (!net)
      {
        throw GeometryError(GeometryDefect::Format,
          std::string("it is a ") + whole->GetClassName() +
            "; files hold control nets (vtkStructuredGrid with KnotsU)");
      }
      convert_net(net);
      this->append(this->read_net(net, name));
    }
    catch (const GeometryError& error)
    {
      throw FileError(this->face(name) + ": " + error.what());
    }
  }

  void add_trimmed(vtkMultiBlockDataSet* blocks, std::string name)
  {
    try
    {
      convert_trimmed_face(blocks, name);
    }
    catch (const GeometryError& error)
    {
      throw FileError(this->face(name) + ": " + error.what());
    }
    Spline surface;
    std::map<unsigned long, std::vector<Spline>> loops; // by their numbers
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      const std::string block = block_name(blocks, i);
      if (block == "Surface")
      {
        surface =
          this->read_net(vtkStructuredGrid::SafeDownCast(single_piece(blocks->GetBlock(i))), name);
      }
      else
      {
        loops[std::stoul(block.substr(5))] = this->read_loop(blocks->GetBlock(i));
      }
    }
    for (auto& [number, loop] : loops)
    {
      surface.loops.push_back(std::move(loop));
    }
    this->append(std::move(surface));
  }

  /// The curves of a loop that can be converted.
  std::vector<Spline> read_loop(vtkDataObject* data)
  {
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data);
    std::vector<Spline> loop;
    for (unsigned int i = 0; i < (blocks ? blocks->GetNumberOfBlocks() : 1); ++i)
    {
      vtkDataObject* curve = single_piece(blocks ? blocks->GetBlock(i) : data);
      if (auto* grid = vtkStructuredGrid::SafeDownCast(curve))
      {
        loop.push_back(this->read_net(grid, ""));
        continue;
      }
      auto* lines = vtkPolyData::SafeDownCast(curve);
      vtkNew<vtkIdList> ids;
      for (vtkIdType line = 0; line < lines->GetNumberOfLines(); ++line)
      {
        lines->GetLines()->GetCellAtId(line, ids);
        loop.emplace_back();
        loop.back().dimension = 1;
        for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
        {
          const double* point = lines->GetPoint(ids->GetId(k));
          loop.back().points.insert(loop.back().points.end(), point, point + 3);
        }
      }
    }
    return loop;
  }

  /// A net that can be converted; without knots a polyline.
  Spline read_net(vtkStructuredGrid* net, const std::string& name)
  {
    this->note_others(net);
    Spline spline;
    const FaceAttributes attributes = read_face_attributes(net->GetFieldData());
    spline.name = attributes.name.empty() ? name : attributes.name;
    spline.reversed = attributes.reversed;
    const int* extent = net->GetExtent();
    spline.dimension = extent[3] > extent[2] ? 2 : 1;
    static const char* const kKnots[] = { "KnotsU", "KnotsV" };
    for (int direction = 0; direction < spline.dimension; ++direction)
    {
      spline.knots[direction] = read_field_array(net->GetFieldData(), kKnots[direction]);
      const int points = extent[2 * direction + 1] - extent[2 * direction] + 1;
      spline.degree[direction] = static_cast<int>(spline.knots[direction].size()) - points - 1;
    }
    for (vtkIdType i = 0; i < net->GetNumberOfPoints(); ++i)
    {
      const double* point = net->GetPoint(i);
      spline.points.insert(spline.points.end(), point, point + 3);
    }
    const Eigen::VectorXd weights = read_weights(net);
    spline.weights.assign(weights.data(), weights.data() + weights.size());
    return spline;
  }

  void note_others(vtkStructuredGrid* net)
  {
    static const std::set<std::string> kKnown{ "KnotsU", "KnotsV", "Degree", "FaceName",
      "Orientation", "RationalWeights" };
    for (vtkFieldData* data :
      { net->GetFieldData(), static_cast<vtkFieldData*>(net->GetPointData()),
        static_cast<vtkFieldData*>(net->GetCellData()) })
    {
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        const char* name = data->GetArrayName(i);
        if (!name || kKnown.count(name) == 0)
        {
          this->Others.insert(name ? name : "(without a name)");
        }
      }
    }
  }

  void append(Spline spline)
  {
    this->File.splines.push_back(std::move(spline));
    ++this->Face;
  }

  std::string face(const std::string& name) const
  {
    return "Face " + std::to_string(this->Face) + (name.empty() ? "" : " ('" + name + "')");
  }

  SplineFile File;
  std::set<std::string> Others;
  std::size_t Face = 0;
};

} // namespace

SplineFile collect_splines(vtkDataObject* data)
{
  return Collector().collect(data);
}

} // namespace footpoint::files
