// SPDX-License-Identifier: BSD-3-Clause
// Private: what filters do with the input that is their geometry.

#ifndef SourceGeometry_h
#define SourceGeometry_h

#include "GeometryHash.h"
#include "SplineConversion.h"

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
class vtkParametricFunction;

namespace footpoint::conversion
{

/// The geometry of a filter: a data object, else a parametric function.
struct SourceGeometry
{
  vtkDataObject* source = nullptr;
  vtkParametricFunction* function = nullptr; ///< used where there is no source
  bool flip = false;                         ///< reverse the normals of all surfaces

  bool exists() const { return this->source || this->function; }
  /// By content; functions, whose content cannot be read, by identity and modification time.
  ContentHash hash() const;
  /// Never throws for bad geometry. \param execution whose threads share the trimming of many faces
  /// \throw Cancelled where its `proceed` says so
  ConvertedModel convert(const Execution& execution) const;
};

/// Port 1: spline geometry, optional.
void fill_source_port_information(vtkInformation* info);

/// Tells of the time steps of both inputs (the executive passes on those of port 0 alone, and would
/// not run a filter again whose geometry moves while the points stay).
void merge_time_steps(vtkInformationVector** inputs, vtkInformationVector* outputs);

/// The part of a filter's progress that reading geometry takes, trimming for the most.
constexpr double kReading = 0.1;

enum class InputState
{
  Ready,
  Refused, ///< nothing is left, and the filter has told why
  Aborted  ///< by the user
};

/// Converts the one input of a filter that makes something else of geometry, and has the filter
/// tell what is wrong with it: warnings name faces that are left out; where nothing is left,
/// errors. Its progress goes from 0 to kReading.
InputState convert_input(
  vtkAlgorithm* filter, vtkDataObject* input, bool flip, ConvertedModel& converted);

} // namespace footpoint::conversion

#endif
