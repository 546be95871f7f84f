// SPDX-License-Identifier: BSD-3-Clause
// Private: feet of the core as arrays of VTK.

#ifndef FootArrays_h
#define FootArrays_h

#include "footpoint/model/point_inversion.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkDataSetAttributes;
class vtkIdList;

namespace footpoint::conversion
{

/// Which arrays there are and how they are called: the same for every block and output.
/// Outlives all arrays of feet.
struct FootArrayLayout
{
  std::string prefix;
  bool has_curves = false;
  bool has_surfaces = false;
  bool parameters = true;
  bool distance = true;
  bool signed_distance = true;
  bool closest_point = true;
  bool normal = true;
  bool tangent = true;
  bool face_id = true;
  bool status = true;
  bool foot_type = true;
  bool isolated = true;
  bool iterations = true;
};

/// Sets has_curves and has_surfaces.
void describe_model(const Model& model, FootArrayLayout& layout);

/// False at Status 3 and 4.
bool has_foot(const Foot& foot);

/// Arrays with a row for each of some feet.
class FootArrays
{
public:
  FootArrays(const FootArrayLayout& layout, vtkIdType count);

  vtkIdType count() const { return this->Count; }
  /// Where the feet are; also where no array says it.
  vtkDoubleArray* points() const { return this->Points; }

  /// Writes some rows from the first on.
  void write(vtkIdType first, const Foot* feet, vtkIdType count);
  /// Writes rows that others of this layout have.
  void copy(vtkIdList* rows, const FootArrays& others, vtkIdList* their_rows);

  /// Adds the arrays, replacing those of their names, and makes the signed distance (or the
  /// distance) the active scalars. Attributes of several data sets may share them.
  void attach_to(vtkDataSetAttributes* attributes) const;

private:
  struct Column
  {
    vtkSmartPointer<vtkDataArray> array;
    std::function<void(vtkIdType row, const Foot* feet, vtkIdType count)> write;
  };

  /// Adds a column that `write(foot, values)` fills.
  template <typename ArrayType, typename Write>
  void add(const char* name, int components, const Write& write);

  const FootArrayLayout& Layout;
  vtkIdType Count;
  std::vector<Column> Columns;
  vtkDoubleArray* Points; ///< of one of the columns
};

} // namespace footpoint::conversion

#endif
