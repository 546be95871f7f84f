// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBezierExtraction
 * @brief   exact spline geometry as VTK's own Bézier cells
 *
 * Cuts NURBS curves and surfaces at all knots (Bézier extraction, M. J. Borden et al. 2011) into
 * cells that VTK and ParaView draw by nonlinear subdivision: the same geometry, not an
 * approximation, exact up to rounding.
 *
 * **Input**: spline geometry as in vtkPointInversionFilter: a control net, Bézier cells, a trimmed
 * face, or a composite data set of faces, taken whole.
 *
 * **Output**: a vtkUnstructuredGrid of VTK_BEZIER_CURVE and VTK_BEZIER_QUADRILATERAL cells, which
 * is geometry for vtkPointInversionFilter in turn, with the same faces and parameters.
 *
 * | array                | of    | meaning                                                        |
 * |----------------------|-------|----------------------------------------------------------------|
 * | `RationalWeights`    | point | weights, active; missing where all faces are polynomial        |
 * | `HigherOrderDegrees` | cell  | degrees in u, v and 0, active; curves: degree, 0, 0            |
 * | `ParameterRange`     | cell  | (u0, u1, v0, v1) in the domain; curves: v0 = v1 = 0            |
 * | `FaceId`             | cell  | the face's number in the input                                 |
 * | `FaceName`           | field | a name for each face                                           |
 * | `Orientation`        | field | for each face: 1 along Su × Sv, -1 reversed                    |
 * | `Tolerance`          | field | for each face, model units                                     |
 *
 * Where the input has curves alone, `ParameterRange` has the two components (u0, u1). `LengthUnit`
 * is passed on where all faces that name one name the same.
 *
 * Neighbouring cells of a face share the points of their border, also across the seam of a closed
 * surface, except where the surface has a gap. The points of a pole stay apart, as do those of
 * different faces.
 *
 * Bézier cells cannot be trimmed: of a trimmed face the whole surface is extracted, with a warning
 * that names the face, or nothing (SetSkipTrimmedFaces()). A face that is refused is left out with
 * a warning; where no face is left that is an error. Cells of more than 512 points, as of degrees
 * (22, 22), are made with a warning, as not all filters of VTK have room for them.
 *
 * The output is empty for piece > 0: of geometry whose parts are on several ranks only the first
 * rank's is seen.
 *
 * ParaView draws these cells as exactly as its NonlinearSubdivisionLevel says; 1, the default,
 * looks faceted. VTK's own closest point on such cells is not exact; vtkPointInversionFilter's is.
 *
 * @sa
 * vtkPointInversionFilter
 */

#ifndef vtkBezierExtraction_h
#define vtkBezierExtraction_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkUnstructuredGridAlgorithm.h"

class VTKFOOTPOINTFILTERS_EXPORT vtkBezierExtraction : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkBezierExtraction* New();
  vtkTypeMacro(vtkBezierExtraction, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Leave out trimmed faces instead of extracting their whole surfaces. Default: off.
   */
  vtkSetMacro(SkipTrimmedFaces, bool);
  vtkGetMacro(SkipTrimmedFaces, bool);
  vtkBooleanMacro(SkipTrimmedFaces, bool);
  ///@}

protected:
  vtkBezierExtraction() = default;
  ~vtkBezierExtraction() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool SkipTrimmedFaces = false;

private:
  vtkBezierExtraction(const vtkBezierExtraction&) = delete;
  void operator=(const vtkBezierExtraction&) = delete;
};

#endif
