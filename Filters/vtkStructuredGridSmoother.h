// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStructuredGridSmoother
 * @brief   mends folds of a two-dimensional structured grid and evens it out
 *
 * **Input**: a vtkStructuredGrid with one dimension of 1, in the plane or in space. **Output**: the
 * same grid with moved points; the corners and, unless they slide, the sides stay bit for bit. All
 * arrays are passed; active normals are computed anew where points moved.
 *
 * | array or field data | type      | meaning                                                     |
 * |---------------------|-----------|-------------------------------------------------------------|
 * | `Jacobian`          | double    | cells: scaled Jacobian, minimum over the corners            |
 * | `Folded`            | int       | cells: 1 where a corner's Jacobian is negative              |
 * | `FoldedCellsBefore`, `FoldedCellsAfter` | vtkIdType | field data                              |
 * | `SmoothingStatus`   | int       | field data, see StatusEnum                                  |
 * | `SmoothingIterations` | int     | field data                                                  |
 * | `SmoothingResidual` | double    | field data: against that of the start                       |
 *
 * Smoothing is global, so there are no sub-extents: piece 0 gets everything. The filter reports
 * progress; an abort leaves the output empty.
 *
 * @sa
 * vtkCoonsPatchSource
 */

#ifndef vtkStructuredGridSmoother_h
#define vtkStructuredGridSmoother_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkStructuredGridAlgorithm.h"

class VTKFOOTPOINTFILTERS_EXPORT vtkStructuredGridSmoother : public vtkStructuredGridAlgorithm
{
public:
  static vtkStructuredGridSmoother* New();
  vtkTypeMacro(vtkStructuredGridSmoother, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodEnum
  {
    NONE = 0,      ///< quality alone
    AUTO = 1,      ///< elliptic, only where the grid has folds
    LAPLACIAN = 2, ///< guarded: no step that makes a fold
    WINSLOW = 3    ///< elliptic: A. M. Winslow (1966); in space on the surface of the grid
  };

  /// Values of `SmoothingStatus`.
  enum StatusEnum
  {
    NOT_SMOOTHED = 0,  ///< not asked for or, with AUTO, not needed
    CONVERGED = 1,     ///< the smoothed grid is the solution
    NOT_CONVERGED = 2, ///< the grid is changed, but is not the solution to the tolerance
    REJECTED = 3       ///< smoothing was no gain; the grid is the input
  };

  /// Spacing that the elliptic equations keep.
  enum ControlFunctionsEnum
  {
    NO_CONTROL = 0,
    THOMAS_MIDDLECOFF = 1 ///< that of the sides: P. D. Thomas and J. F. Middlecoff (1980)
  };

  /// What the points of the sides may do.
  enum BoundaryEnum
  {
    FIXED = 0,
    SLIDING = 1 ///< along the polyline of their side; corners stay
  };

  ///@{
  /**
   * See MethodEnum. Default: AUTO.
   */
  vtkSetClampMacro(Method, int, NONE, WINSLOW);
  vtkGetMacro(Method, int);
  void SetMethodToNone() { this->SetMethod(NONE); }
  void SetMethodToAuto() { this->SetMethod(AUTO); }
  void SetMethodToLaplacian() { this->SetMethod(LAPLACIAN); }
  void SetMethodToWinslow() { this->SetMethod(WINSLOW); }
  const char* GetMethodAsString() const;
  ///@}

  ///@{
  /**
   * Most iterations. Default: 100.
   */
  vtkSetClampMacro(MaximumIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * WINSLOW: the residual of the equations, against that of the start, at which they count as
   * solved. LAPLACIAN: the largest move, as a fraction of the grid's size, at which it ends.
   * Default: 1e-10.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Spacing that WINSLOW keeps, see ControlFunctionsEnum. Default: NO_CONTROL.
   */
  vtkSetClampMacro(ControlFunctions, int, NO_CONTROL, THOMAS_MIDDLECOFF);
  vtkGetMacro(ControlFunctions, int);
  void SetControlFunctionsToNoControl() { this->SetControlFunctions(NO_CONTROL); }
  void SetControlFunctionsToThomasMiddlecoff() { this->SetControlFunctions(THOMAS_MIDDLECOFF); }
  const char* GetControlFunctionsAsString() const;
  ///@}

  ///@{
  /**
   * What the points of the sides may do, see BoundaryEnum. Default: FIXED.
   */
  vtkSetClampMacro(Boundary, int, FIXED, SLIDING);
  vtkGetMacro(Boundary, int);
  void SetBoundaryToFixed() { this->SetBoundary(FIXED); }
  void SetBoundaryToSliding() { this->SetBoundary(SLIDING); }
  const char* GetBoundaryAsString() const;
  ///@}

protected:
  vtkStructuredGridSmoother();
  ~vtkStructuredGridSmoother() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Method;
  int MaximumIterations;
  double Tolerance;
  int ControlFunctions;
  int Boundary;

private:
  vtkStructuredGridSmoother(const vtkStructuredGridSmoother&) = delete;
  void operator=(const vtkStructuredGridSmoother&) = delete;
};

#endif
