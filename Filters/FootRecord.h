// SPDX-License-Identifier: BSD-3-Clause
// Private: the outputs of point inversion, written as the feet come.

#ifndef FootRecord_h
#define FootRecord_h

#include "DeviationReport.h"
#include "FootArrays.h"
#include "PointBlocks.h"

#include "vtkIdTypeArray.h"
#include "vtkNew.h"

class vtkPolyData;

namespace footpoint::conversion
{

/// Takes feet in the order of the points. Where every point has one foot, which is the point of a
/// vertex, output 1 shares the arrays of output 0; else it gets the rows of points that have a foot
/// or, with several feet a point, arrays of their own.
class FootRecord
{
public:
  /// Everything that is given by reference outlives the record.
  /// \param several  feet a point
  /// \param segments from each point to its foot, instead of a vertex at the foot
  FootRecord(const PointBlocks& points, const FootArrayLayout& layout, const Model& model,
    bool several, bool segments);

  void take(vtkIdType first, const InversionResult& part);

  /// Adds the arrays to output 0.
  void attach() const;
  void fill_foot_points(vtkPolyData* output) const;
  DeviationReport& report() { return this->Report; }

private:
  /// A row of output 1, or two, where there is a foot.
  void add_row(const Foot& foot, vtkIdType point);
  FootArrays rows() const;

  const PointBlocks& Points;
  const FootArrayLayout& Layout;
  const bool Several;
  const bool Segments;
  DeviationReport Report;
  std::vector<FootArrays> Arrays;  ///< of output 0, by blocks
  vtkNew<vtkIdTypeArray> PointIds; ///< of the rows of output 1
  std::vector<vtkIdType> RowsOfBlock;
  std::vector<Foot> Feet; ///< of the rows, where they are several a point
};

} // namespace footpoint::conversion

#endif
