// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSplineTessellator
 * @brief   exact spline geometry as triangles and polylines with exact normals
 *
 * For rendering, simulation and every filter that takes polygons. Point inversion needs no
 * triangles: it works on the exact geometry.
 *
 * **Input port 0**: geometry as port 1 of vtkPointInversionFilter takes it: the control net of a
 * surface or a curve, Bézier cells, a trimmed face, or a composite data set of those, a model.
 *
 * **Output**: vtkPolyData with a polyline for every curve and triangles for every surface,
 * counter-clockwise against its normal (which follows the face's `Orientation`), positions double.
 *
 * | array        | of     | type      | meaning                                         |
 * |--------------|--------|-----------|-------------------------------------------------|
 * | `Normals`    | points | double, 3 | unit normal of the surface, at poles its limit  |
 * | `Parameters` | points | double, 2 | (u, v) in the patch's own domain                |
 * | `FaceId`     | cells  | vtkIdType | the face, counted from 0                        |
 *
 * `Normals` are the active normals, there where the geometry has surfaces, and 0 on curves, whose
 * `Parameters`, the active texture coordinates, are (u, 0).
 *
 * With Adaptive the distance between the geometry and its triangles or lines is kept within
 * ChordTolerance by bounds of the second derivatives, not by samples. For lines that is a proof.
 * For triangles it is one but for their slope, by which what lies beside the normal counts: it is
 * measured at their corners, with a margin. Where borders of faces meet (as near as 1e-6 of the
 * size of the model, or the field data `Tolerance` of a face) their points have the same
 * coordinates, bit for bit, and may be off by as much more; vtkCleanPolyData with tolerance 0 makes
 * a closed mesh of a closed solid. Points are not shared between faces, nor between the two sides
 * of a seam or of a kink, where parameters or normals differ.
 *
 * A face that cannot be triangulated (its loops cross themselves, or it is thinner than the
 * tolerances) is left out, and a warning names it. Results have the same bits for any number of
 * threads. The output is empty for piece > 0: of geometry whose parts are on several ranks only the
 * first rank's is seen.
 *
 * Field data `ChordTolerance`: the tolerance in model units; 0 with Fixed.
 *
 * @sa
 * vtkPointInversionFilter vtkSplineEvaluator
 */

#ifndef vtkSplineTessellator_h
#define vtkSplineTessellator_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFOOTPOINTFILTERS_EXPORT vtkSplineTessellator : public vtkPolyDataAlgorithm
{
public:
  static vtkSplineTessellator* New();
  vtkTypeMacro(vtkSplineTessellator, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ModeEnum
  {
    ADAPTIVE = 0, ///< as densely as the tolerances ask for
    FIXED = 1     ///< Resolution segments for each knot span
  };

  ///@{
  /**
   * How densely the geometry is sampled, see ModeEnum. Default: Adaptive.
   */
  vtkSetClampMacro(Mode, int, ADAPTIVE, FIXED);
  vtkGetMacro(Mode, int);
  void SetModeToAdaptive() { this->SetMode(ADAPTIVE); }
  void SetModeToFixed() { this->SetMode(FIXED); }
  const char* GetModeAsString() const;
  ///@}

  ///@{
  /**
   * Adaptive: the largest distance between geometry and output, as a fraction of the size of the
   * model (the diagonal of the box around its control points), or in model units with
   * AbsoluteTolerance. Above 0. Default: 0.001, a pixel of a picture of the whole model.
   */
  vtkSetMacro(ChordTolerance, double);
  vtkGetMacro(ChordTolerance, double);
  ///@}

  ///@{
  /**
   * ChordTolerance is a length in model units. Default: off.
   */
  vtkSetMacro(AbsoluteTolerance, bool);
  vtkGetMacro(AbsoluteTolerance, bool);
  vtkBooleanMacro(AbsoluteTolerance, bool);
  ///@}

  ///@{
  /**
   * Adaptive: the largest angle in degrees between the normals at two corners of a triangle, or the
   * tangents at two ends of a line; 0: any. Edges shorter than the chord tolerance are not divided
   * for its sake. Default: 30.
   */
  vtkSetClampMacro(AngleTolerance, double, 0.0, 180.0);
  vtkGetMacro(AngleTolerance, double);
  ///@}

  ///@{
  /**
   * Fixed: segments for each knot span, of trim curves for each part between turns in u or v.
   * Default: 4.
   */
  vtkSetClampMacro(Resolution, int, 1, 10000);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Reverse the normals and the triangles of all surfaces. Default: off.
   */
  vtkSetMacro(FlipNormals, bool);
  vtkGetMacro(FlipNormals, bool);
  vtkBooleanMacro(FlipNormals, bool);
  ///@}

protected:
  vtkSplineTessellator();
  ~vtkSplineTessellator() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Mode = ADAPTIVE;
  double ChordTolerance;
  bool AbsoluteTolerance;
  double AngleTolerance = 30.0;
  int Resolution;
  bool FlipNormals = false;

private:
  vtkSplineTessellator(const vtkSplineTessellator&) = delete;
  void operator=(const vtkSplineTessellator&) = delete;
};

#endif
