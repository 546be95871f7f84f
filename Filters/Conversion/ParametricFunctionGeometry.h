// SPDX-License-Identifier: BSD-3-Clause
// Private: a vtkParametricFunction as geometry of the core.

#ifndef ParametricFunctionGeometry_h
#define ParametricFunctionGeometry_h

#include "footpoint/model/model.h"

#include "vtkSmartPointer.h"

class vtkParametricFunction;

namespace footpoint::conversion
{

class ContentHash;

/// A parametric curve (N = 1) or surface (N = 2) of VTK.
///
/// Derivatives come from differences over five points, always inside the domain, because several
/// functions of VTK return wrong ones while claiming to have them, and some are not defined
/// outside. Their relative error is about 1e-12 for the first and 1e-9 for the second ones.
template <int N>
class ParametricFunctionGeometry : public ParametricGeometry<N>
{
public:
  /// Evaluates the function, which also makes later concurrent calls safe.
  /// \throw GeometryError (EmptyDomain, NotFinite)
  explicit ParametricFunctionGeometry(vtkParametricFunction* function);

  Jet<N> jet(const Parameter<N>& t, const Sides<N>& sides, int order) const override;

private:
  /// Relative to the centre.
  Vector3 evaluate(const Parameter<N>& local) const;

  vtkSmartPointer<vtkParametricFunction> Function;
};

/// A model of one face.
/// \throw GeometryError for a function of three parameters or with a bad domain
Model convert_parametric_function(vtkParametricFunction* function, bool flip);

/// Adds the function's class, its domain and its points at some parameters, by which functions of
/// different processes are compared.
void add_function_values(ContentHash& hash, vtkParametricFunction* function);

} // namespace footpoint::conversion

#endif
