// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSplineReader
 * @brief   reads files of spline curves and surfaces, number for number
 *
 * Output: a vtkMultiBlockDataSet with a block for every spline of the file, in its order: a
 * vtkStructuredGrid of control points with the field data `KnotsU`, `KnotsV`, `Degree` and, where
 * it is rational, the active RationalWeights; or a trimmed face, a vtkMultiBlockDataSet of
 * `Surface` and `Loop 0`, `Loop 1`, … (see vtkPointInversionFilter). A name in the file is the
 * block's name and the field data `FaceName`.
 *
 * Formats, by the extension of the file or as set:
 * - G+Smo (`.xml`): geometries of the types BSpline, Nurbs, TensorBSpline2 and TensorNurbs2, in the
 *   plane or in space; names are the attributes `label`. Of a multi-patch the patches are read, not
 *   how they are joined.
 * - GoTools (`.g2`): the classes SplineCurve (100) and SplineSurface (200), in the plane or in
 * space, any number in a file.
 * - geomdl, also called NURBS-Python (`.json`): curves, surfaces and their trims. A trim that is
 * not `reversed` is a hole; loops are turned round where their direction says otherwise, and where
 * all are holes the border of the domain is added as `Loop 0`. Trims are in the surface's own
 * domain.
 *
 * What a file has besides splines is left out with a warning that names it. A file that is
 * malformed, or has no spline, is an error that names the line and what was expected there; the
 * output is empty then.
 *
 * All of it is read on piece 0; for other pieces the output is empty.
 *
 * @sa
 * vtkSplineWriter
 */

#ifndef vtkSplineReader_h
#define vtkSplineReader_h

#include "vtkFootpointIOModule.h" // For export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

class VTKFOOTPOINTIO_EXPORT vtkSplineReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkSplineReader* New();
  vtkTypeMacro(vtkSplineReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FormatEnum
  {
    AUTO = 0, ///< by the extension of the file
    G_PLUS_SMO = 1,
    GO_TOOLS = 2,
    GEOMDL = 3
  };

  ///@{
  /**
   * Path of the file. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Format of the file. Default: Auto, by its extension.
   */
  vtkSetClampMacro(Format, int, AUTO, GEOMDL);
  vtkGetMacro(Format, int);
  void SetFormatToAuto() { this->SetFormat(AUTO); }
  void SetFormatToGPlusSmo() { this->SetFormat(G_PLUS_SMO); }
  void SetFormatToGoTools() { this->SetFormat(GO_TOOLS); }
  void SetFormatToGeomdl() { this->SetFormat(GEOMDL); }
  const char* GetFormatAsString() const;
  ///@}

  /**
   * 1 where a file is of one of the formats, by its extension and its content, else 0.
   */
  int CanReadFile(const char* path);

protected:
  vtkSplineReader();
  ~vtkSplineReader() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  char* FileName = nullptr;
  int Format = AUTO;

private:
  vtkSplineReader(const vtkSplineReader&) = delete;
  void operator=(const vtkSplineReader&) = delete;
};

#endif
