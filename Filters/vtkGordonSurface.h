// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGordonSurface
 * @brief   NURBS surface through a network of curves (W. J. Gordon 1969)
 *
 * **Input port 0** (repeatable): the profiles, at least two. **Input port 1** (repeatable,
 * SetGuidesConnection(), AddGuidesConnection() or AddGuidesData()): the guides, at least two. Both
 * are curves, vtkStructuredGrids of control points with dimensions (n, 1, 1) and the field data
 * `KnotsU`, or composite data sets of them, in any order and direction. Every profile meets every
 * guide once. Weights are allowed where all curves of a family have the same along their parameter,
 * as the circles about a tube.
 *
 * Closed profiles make a surface that is closed along u. They start and end at the first given
 * guide, or at the one that is given twice (as first and as last); closed guides likewise along v.
 *
 * **Output**: the control net, a vtkStructuredGrid with the field data `KnotsU`, `KnotsV` and
 * `Degree`; profiles run along u, guides along v, the domain is [0, 1]². Where the curves agree in
 * their parameters the surface contains them exactly.
 *
 * | field data                           | meaning                                               |
 * |--------------------------------------|-------------------------------------------------------|
 * | `ParametersU`, `ParametersV`         | of the guides on the profiles, and the reverse        |
 * | `ProfileOrder`, `GuideOrder`         | int: which input became the k-th curve                |
 * | `ProfileReversed`, `GuideReversed`   | int: 1 where the k-th curve was reversed              |
 * | `LargestGap`                         | between curves that should meet, model units          |
 * | `ReparametrizationError`             | largest change of a curve, model units; 0: none       |
 *
 * Where profiles are closed, the guide at which they start stands a second time at the end of
 * `GuideOrder` and `GuideReversed`, with the parameter 1 in `ParametersU`; likewise for closed
 * guides.
 *
 * A network that cannot be put in order is an error that names the curves and says how far.
 *
 * @sa
 * vtkCoonsSurface
 */

#ifndef vtkGordonSurface_h
#define vtkGordonSurface_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkStructuredGridAlgorithm.h"

#include <memory> // For std::unique_ptr

class VTKFOOTPOINTFILTERS_EXPORT vtkGordonSurface : public vtkStructuredGridAlgorithm
{
public:
  static vtkGordonSurface* New();
  vtkTypeMacro(vtkGordonSurface, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The guides: the only connection, one more, one more as data, or none.
   */
  void SetGuidesConnection(vtkAlgorithmOutput* algorithmOutput);
  void AddGuidesConnection(vtkAlgorithmOutput* algorithmOutput);
  void AddGuidesData(vtkDataObject* guides);
  void RemoveAllGuides();
  ///@}

  ///@{
  /**
   * How far curves may pass each other where they should meet, as a fraction of the network's size.
   * Default: 1e-3.
   */
  vtkSetClampMacro(IntersectionTolerance, double, 0.0, 1.0);
  vtkGetMacro(IntersectionTolerance, double);
  ///@}

  ///@{
  /**
   * Change the parameters of curves that meet the others at parameters that do not agree, which
   * changes the curves a little; off: such networks are refused. Default: off.
   */
  vtkSetMacro(Reparametrize, bool);
  vtkGetMacro(Reparametrize, bool);
  vtkBooleanMacro(Reparametrize, bool);
  ///@}

  ///@{
  /**
   * Largest change of a curve by reparametrization, as a fraction of the network's size.
   * Default: 1e-4.
   */
  vtkSetClampMacro(ReparametrizationTolerance, double, 0.0, 1.0);
  vtkGetMacro(ReparametrizationTolerance, double);
  ///@}

protected:
  vtkGordonSurface();
  ~vtkGordonSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double IntersectionTolerance;
  bool Reparametrize;
  double ReparametrizationTolerance;

private:
  vtkGordonSurface(const vtkGordonSurface&) = delete;
  void operator=(const vtkGordonSurface&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
