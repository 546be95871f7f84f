// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCADReader
 * @brief   STEP, IGES and BREP files as exact geometry
 *
 * Reads CAD files through Open CASCADE: STEP, IGES and BREP (text and binary), told apart by their
 * content, also where gzip has compressed them. Assemblies are flattened; every face and edge
 * stands where the file puts it.
 *
 * **Output 0**: vtkPolyData, triangles for the screen, with the point normals of the exact surfaces
 * (outward on solids), the cell array `FaceId` (the numbers of output 1) and, where the file gives
 * colours, `Colors` (unsigned char, 3; 204 grey for faces without).
 *
 * **Output 1**: the exact model, a vtkMultiBlockDataSet as vtkPointInversionFilter takes it, a
 * block a face, its number being the FaceId. A face is a control net (vtkStructuredGrid) or, where
 * trim loops keep a part of the surface, a vtkMultiBlockDataSet of `Surface`, `Loop 0`, `Loop 1`,
 * …, in which counter-clockwise loops keep their inside. Field data of the surface's net:
 *
 * | array            | meaning                                                                   |
 * |------------------|---------------------------------------------------------------------------|
 * | `KnotsU, KnotsV` | full knot vectors                                                         |
 * | `Degree`         | 2 ints                                                                    |
 * | `FaceName`       | name of the face, else of the smallest named shape around it, if any      |
 * | `Orientation`    | 1, or -1 where the outward normal is -Su × Sv                             |
 * | `Tolerance`      | largest tolerance of the face and its edges in the file, in model units   |
 * | `LengthUnit`     | unit of all lengths, e.g. "mm"                                            |
 *
 * **Output 2**: the edges, a vtkMultiBlockDataSet of curves (control nets with `KnotsU`), each edge
 * of the model once, with the field data `EdgeId`, `Tolerance`, `FaceIds` (the faces that it
 * borders) and `LengthUnit`. Degenerate edges (poles) are no curves and use up their EdgeId.
 *
 * Planes, cylinders, cones, spheres, tori, extrusions, revolutions, Bézier and B-spline surfaces
 * are converted exactly; offset surfaces and others are approximated to 1e-9 of the face's size,
 * with a warning and a larger `Tolerance`. A parameter along a circle is that of the rational
 * B-spline, not the angle; both agree at knots. Trim curves that run neither along u nor along v on
 * such a surface are approximated to 1e-13 of the face's size.
 *
 * A face that cannot be converted is named in a warning and uses up its number as an empty block. A
 * file that cannot be read is an error, and so is one without any face or edge.
 *
 * Open CASCADE runs in a process of its own (the program `footpoint-read-cad` beside the library),
 * as it can crash or run for ever on broken files.
 *
 * @sa
 * vtkPointInversionFilter vtkSplineEvaluator vtkSplineReader
 */

#ifndef vtkCADReader_h
#define vtkCADReader_h

#include "vtkFootpointIOModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <string> // For std::string

class vtkMultiBlockDataSet;

class VTKFOOTPOINTIO_EXPORT vtkCADReader : public vtkPolyDataAlgorithm
{
public:
  static vtkCADReader* New();
  vtkTypeMacro(vtkCADReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Unit of length of the outputs: nm, um, mm, cm, m, km, uin, mil, inch, ft, yd or mi; empty: that
   * of the file. BREP files have none and are taken as millimetres. Default: "".
   */
  vtkSetStdStringFromCharMacro(LengthUnit);
  vtkGetCharFromStdStringMacro(LengthUnit);
  ///@}

  ///@{
  /**
   * The faces to read, as numbers and ranges such as "0-3,7"; empty: all. Others are empty blocks.
   * Default: "".
   */
  vtkSetStdStringFromCharMacro(Faces);
  vtkGetCharFromStdStringMacro(Faces);
  ///@}

  ///@{
  /**
   * Make output 0. Default: on.
   */
  vtkSetMacro(GenerateMesh, bool);
  vtkGetMacro(GenerateMesh, bool);
  vtkBooleanMacro(GenerateMesh, bool);
  ///@}

  ///@{
  /**
   * Largest distance between the triangles and the faces, in the unit of the outputs; 0: a
   * thousandth of the diagonal of the model. The exact outputs do not depend on it. Default: 0.0.
   */
  vtkSetClampMacro(Deflection, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Deflection, double);
  ///@}

  ///@{
  /**
   * Largest angle between neighbouring pieces of an edge or a face's triangles, in degrees.
   * Default: 20.0.
   */
  vtkSetClampMacro(AngularDeflection, double, 1.0, 90.0);
  vtkGetMacro(AngularDeflection, double);
  ///@}

  ///@{
  /**
   * Let Open CASCADE repair the whole shape (ShapeFix) before it is converted. Default: off, as it
   * moves geometry within tolerances, and may split or drop faces: measuring is to be against what
   * the file says. STEP and IGES files get the repairs of Open CASCADE's translators either way.
   */
  vtkSetMacro(Healing, bool);
  vtkGetMacro(Healing, bool);
  vtkBooleanMacro(Healing, bool);
  ///@}

  ///@{
  /**
   * Seconds without any sign of progress after which reading is given up. Default: 50.0.
   */
  vtkSetClampMacro(TimeLimit, double, 0.1, VTK_DOUBLE_MAX);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /**
   * Of the last reading: the faces in the file, and those of them that could not be converted.
   */
  vtkGetMacro(NumberOfFaces, vtkIdType);
  vtkGetMacro(NumberOfSkippedFaces, vtkIdType);
  ///@}

  /**
   * The exact model, output 1.
   */
  vtkMultiBlockDataSet* GetModelOutput();

  /**
   * The edges, output 2.
   */
  vtkMultiBlockDataSet* GetEdgesOutput();

protected:
  vtkCADReader();
  ~vtkCADReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  char* FileName = nullptr;
  std::string LengthUnit;
  std::string Faces;
  bool GenerateMesh = true;
  double Deflection = 0.0;
  double AngularDeflection = 20.0;
  bool Healing = false;
  double TimeLimit = 50.0;
  vtkIdType NumberOfFaces = 0;
  vtkIdType NumberOfSkippedFaces = 0;

private:
  vtkCADReader(const vtkCADReader&) = delete;
  void operator=(const vtkCADReader&) = delete;
};

#endif
