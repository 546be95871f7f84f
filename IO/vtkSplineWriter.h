// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSplineWriter
 * @brief   writes spline curves and surfaces into files, number for number
 *
 * Input: a control net, a trimmed face or a composite data set of them (see
 * vtkPointInversionFilter). Numbers are written so that vtkSplineReader reads the same bits.
 *
 * What makes the geometry and the format cannot hold is an error, and nothing is written: trimmed
 * faces and `Orientation` −1 in G+Smo and GoTools, curves and surfaces in one file of geomdl. What
 * says something of it is left out with a warning: names in GoTools, empty blocks, other arrays.
 *
 * Errors set the error code; Write returns 0 then.
 *
 * @sa
 * vtkSplineReader
 */

#ifndef vtkSplineWriter_h
#define vtkSplineWriter_h

#include "vtkFootpointIOModule.h" // For export macro
#include "vtkWriter.h"

class VTKFOOTPOINTIO_EXPORT vtkSplineWriter : public vtkWriter
{
public:
  static vtkSplineWriter* New();
  vtkTypeMacro(vtkSplineWriter, vtkWriter);
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
   * Format of the file. Default: Auto, by its extension: `.xml` G+Smo, `.g2` GoTools, `.json`
   * geomdl.
   */
  vtkSetClampMacro(Format, int, AUTO, GEOMDL);
  vtkGetMacro(Format, int);
  void SetFormatToAuto() { this->SetFormat(AUTO); }
  void SetFormatToGPlusSmo() { this->SetFormat(G_PLUS_SMO); }
  void SetFormatToGoTools() { this->SetFormat(GO_TOOLS); }
  void SetFormatToGeomdl() { this->SetFormat(GEOMDL); }
  const char* GetFormatAsString() const;
  ///@}

protected:
  vtkSplineWriter() = default;
  ~vtkSplineWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  char* FileName = nullptr;
  int Format = AUTO;

private:
  vtkSplineWriter(const vtkSplineWriter&) = delete;
  void operator=(const vtkSplineWriter&) = delete;
};

#endif
