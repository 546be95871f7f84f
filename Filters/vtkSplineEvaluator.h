// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSplineEvaluator
 * @brief   points of exact spline geometry at given parameters
 *
 * The inverse of vtkPointInversionFilter: evaluates curves and surfaces at given parameters.
 *
 * **Input port 0**: a vtkDataSet with a point array, or a vtkTable with a column, of parameters in
 * the geometry's own domain: `Parameters`, 2 components (u, v) for surfaces, 1 or 2 for curves (the
 * second is not used). An optional integer array `FaceId` tells on which face; without it the
 * geometry must have exactly one face. SetParametersArrayName() changes the names.
 *
 * **Input port 1** ("Source", SetSourceConnection() or SetSourceData()): the geometry, as in
 * vtkPointInversionFilter; optional because of SetParametricFunction().
 *
 * **Output**: vtkPolyData with a vertex for every row that could be evaluated, with the input's
 * point (row) arrays and
 *
 * | array     | type      | meaning                                                            |
 * |-----------|-----------|--------------------------------------------------------------------|
 * | `Normal`  | double, 3 | unit normal, at poles its limit; NaN on curves; active normals     |
 * | `Tangent` | double, 3 | unit tangent of a curve; NaN on surfaces                           |
 * | `Clamped` | int       | 1 where a parameter outside the domain was moved to its border     |
 * | `PointId` | vtkIdType | the point (row) of the input                                       |
 *
 * `Normal` exists where the geometry has surfaces, `Tangent` where it has curves.
 *
 * Parameters outside the domain are wrapped in closed directions and clamped in open ones. Rows
 * with a NaN or infinite parameter, or a `FaceId` that is no face, make no output point, as no
 * position would be right; the field data `NumberOfSkippedPoints` says how many, of all ranks
 * together.
 *
 * @sa
 * vtkPointInversionFilter
 */

#ifndef vtkSplineEvaluator_h
#define vtkSplineEvaluator_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkMultiProcessController;
class vtkParametricFunction;

class VTKFOOTPOINTFILTERS_EXPORT vtkSplineEvaluator : public vtkPolyDataAlgorithm
{
public:
  static vtkSplineEvaluator* New();
  vtkTypeMacro(vtkSplineEvaluator, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The geometry as second input, as a connection or as data.
   */
  void SetSourceConnection(vtkAlgorithmOutput* algorithmOutput);
  void SetSourceData(vtkDataObject* source);
  vtkDataObject* GetSource();
  ///@}

  ///@{
  /**
   * A parametric curve or surface as geometry, used where there is no source. Default: none.
   */
  virtual void SetParametricFunction(vtkParametricFunction* function);
  vtkGetObjectMacro(ParametricFunction, vtkParametricFunction);
  ///@}

  ///@{
  /**
   * The ranks that run this filter together; null: this one alone. As in vtkPointInversionFilter,
   * each evaluates its own rows on the geometry of all. Default: the global controller of the time
   * when the filter was made.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Name of the input array of parameters. Default: "Parameters".
   */
  vtkSetStdStringFromCharMacro(ParametersArrayName);
  vtkGetCharFromStdStringMacro(ParametersArrayName);
  ///@}

  ///@{
  /**
   * Name of the input array of face numbers. Default: "FaceId".
   */
  vtkSetStdStringFromCharMacro(FaceIdArrayName);
  vtkGetCharFromStdStringMacro(FaceIdArrayName);
  ///@}

  ///@{
  /**
   * Reverse the normals of all surfaces. Default: off.
   */
  vtkSetMacro(FlipNormals, bool);
  vtkGetMacro(FlipNormals, bool);
  vtkBooleanMacro(FlipNormals, bool);
  ///@}

  /**
   * Includes the parametric function's.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkSplineEvaluator();
  ~vtkSplineEvaluator() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  vtkMultiProcessController* Controller = nullptr;
  vtkParametricFunction* ParametricFunction = nullptr;
  std::string ParametersArrayName = "Parameters";
  std::string FaceIdArrayName = "FaceId";
  bool FlipNormals = false;

private:
  vtkSplineEvaluator(const vtkSplineEvaluator&) = delete;
  void operator=(const vtkSplineEvaluator&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
