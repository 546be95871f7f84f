// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSplineReader
 * @brief   reads files of spline curves and surfaces, number for number
 *
 * Output: a vtkMultiBlockDataSet with a block for every spline of the file, in its order: a
 * vtkStructuredGrid of control points with the field data `KnotsU`, `KnotsV`, `Degree` and, where
 * it is rational, the active RationalWeights (see vtkPointInversionFilter). A name in the file is
 * the block's name and the field data `FaceName`.
 *
 * Formats, by the extension of the file:
 * - `.g2`, GoTools: the classes SplineCurve (100) and SplineSurface (200), in the plane or in
 * space, rational or not, any number in a file.
 *
 * What a file has besides splines is left out with a warning that names it. A file that is
 * malformed is an error that names the line and what was expected there, and the output is empty.
 *
 * All of it is read on piece 0; for other pieces the output is empty.
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

  ///@{
  /**
   * Path of the file. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

protected:
  vtkSplineReader();
  ~vtkSplineReader() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  char* FileName = nullptr;

private:
  vtkSplineReader(const vtkSplineReader&) = delete;
  void operator=(const vtkSplineReader&) = delete;
};

#endif
