// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCoonsSurface
 * @brief   the Coons surface of four NURBS curves, exactly, as a NURBS surface
 *
 * **Input port 0** (repeatable): four curves, each a vtkStructuredGrid of control points with
 * dimensions (n, 1, 1) and the field data `KnotsU` (see vtkPointInversionFilter), or composite data
 * sets of them, in any order and direction.
 *
 * **Output**: the control net of the bilinearly blended Coons surface, a vtkStructuredGrid with the
 * field data `KnotsU`, `KnotsV`, `Degree` and, where a side is rational, the active
 * RationalWeights. Polynomial sides keep their degrees; rational ones give the surface over the
 * product of their denominators, e.g. bidegree 3 for quadratic arcs. It is the same surface as the
 * definition gives, not an approximation, and goes straight into vtkPointInversionFilter.
 *
 * Field data besides: `EdgeOrder` (4 ints, by side: bottom, right, top, left: the curve it came
 * from), `EdgeReversed` (4 ints) and `CornerGaps` (4 doubles: C00, C10, C11, C01).
 *
 * Curves that do not meet are an error that names them and says how far apart they are.
 *
 * @sa
 * vtkCoonsPatchSource vtkGordonSurface
 */

#ifndef vtkCoonsSurface_h
#define vtkCoonsSurface_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkStructuredGridAlgorithm.h"

#include <memory> // For std::unique_ptr

class VTKFOOTPOINTFILTERS_EXPORT vtkCoonsSurface : public vtkStructuredGridAlgorithm
{
public:
  static vtkCoonsSurface* New();
  vtkTypeMacro(vtkCoonsSurface, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How far apart ends that should meet may be, as a fraction of the size of the boundary.
   * Default: 1e-8.
   */
  vtkSetClampMacro(CornerTolerance, double, 0.0, 1.0);
  vtkGetMacro(CornerTolerance, double);
  ///@}

  ///@{
  /**
   * Take the curves as bottom, right, top, left in the directions given. Default: off, order and
   * directions are found.
   */
  vtkSetMacro(Strict, bool);
  vtkGetMacro(Strict, bool);
  vtkBooleanMacro(Strict, bool);
  ///@}

protected:
  vtkCoonsSurface();
  ~vtkCoonsSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double CornerTolerance = 1e-8;
  bool Strict;

private:
  vtkCoonsSurface(const vtkCoonsSurface&) = delete;
  void operator=(const vtkCoonsSurface&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
