// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransfiniteVolume
 * @brief   three-dimensional structured grid between six faces or twelve edges
 *
 * Transfinite interpolation: faces − edges + corners (W. J. Gordon and C. A. Hall 1973).
 *
 * **Input port 0** (repeatable): in order, as connections or as leaves of composite data sets,
 * - six vtkStructuredGrids, the faces u = 0, u = 1 (over v, w), v = 0, v = 1 (over u, w), w = 0,
 *   w = 1 (over u, v), the first named direction fastest. A face has one dimension of 1, whichever
 *   it is, so faces that vtkExtractGrid cuts from a volume fit; or
 * - twelve polylines (lines of vtkPolyData), the edges: four along u at (v, w) = 00, 10, 01, 11,
 *   four along v at (u, w), four along w at (u, v).
 *
 * **Output**: vtkStructuredGrid with the cell arrays `Jacobian` (double, scaled, minimum over the
 * corners) and `Folded` (int, 1 where a corner's Jacobian is negative), and the field data
 * `Mirrored` (int; 1 where the input was left-handed and u was reversed), `LargestGap` (double;
 * between faces along their common edges, model units) and `FoldedCells` (vtkIdType).
 *
 * No sub-extents: piece 0 gets everything. Faces that do not fit are an error that names them and
 * says how far; the output is empty.
 *
 * @sa
 * vtkCoonsPatchSource
 */

#ifndef vtkTransfiniteVolume_h
#define vtkTransfiniteVolume_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkStructuredGridAlgorithm.h"

class VTKFOOTPOINTFILTERS_EXPORT vtkTransfiniteVolume : public vtkStructuredGridAlgorithm
{
public:
  static vtkTransfiniteVolume* New();
  vtkTypeMacro(vtkTransfiniteVolume, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How far apart faces may be along their common edges, as a fraction of the size of all.
   * Default: 1e-8.
   */
  vtkSetClampMacro(CornerTolerance, double, 0.0, 1.0);
  vtkGetMacro(CornerTolerance, double);
  ///@}

protected:
  vtkTransfiniteVolume();
  ~vtkTransfiniteVolume() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double CornerTolerance = 1e-8;

private:
  vtkTransfiniteVolume(const vtkTransfiniteVolume&) = delete;
  void operator=(const vtkTransfiniteVolume&) = delete;
};

#endif
