// SPDX-License-Identifier: BSD-3-Clause
// Private: pipeline requests of filters that make a structured grid whose dimensions follow from
// the content of their inputs, in one piece.

#ifndef StructuredOutput_h
#define StructuredOutput_h

#include <array>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace footpoint::conversion
{

/// Numbers of points along u, v, w; zeros: nothing can be made.
using Dimensions = std::array<int, 3>;

/// Asks all connections of an input port for the whole of their data.
void request_whole_inputs(vtkInformationVector* input);

/// Brings all connections of a port up to date, before the pipeline would; where there are time
/// steps, at the first. For RequestInformation of algorithms whose whole extent depends on the
/// content: a wrong one makes filters and writers downstream produce nothing.
/// \return the data of the connections; those that failed are left out
std::vector<vtkDataObject*> update_inputs(
  vtkAlgorithm* algorithm, int port, vtkInformationVector* input);

/// The data of all connections of a port.
std::vector<vtkDataObject*> input_data(vtkInformationVector* input);

/// Sets the whole extent of all outputs that have one; sub-extents are not produced.
void announce_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions);

/// True where another piece than the first is wanted, which gets nothing.
bool wants_nothing(vtkInformation* request, vtkInformationVector* outputs);

/// What is wrong if these dimensions are not those that were announced; else empty.
std::string check_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions);

/// Empties all outputs.
void clear_outputs(vtkInformationVector* outputs);

} // namespace footpoint::conversion

#endif
