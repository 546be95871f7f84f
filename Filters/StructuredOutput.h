// SPDX-License-Identifier: BSD-3-Clause
// Private: pipeline requests of filters that make a structured grid whose dimensions follow from
// the content of their inputs, in one piece.

#ifndef StructuredOutput_h
#define StructuredOutput_h

#include <array>
#include <optional>
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

/// The time that an output is asked for, if any: of the port of the request or, without, port 0.
std::optional<double> requested_time(vtkInformation* request, vtkInformationVector* outputs);

/// Whether any connection of an input port changes over time.
bool has_time(vtkInformationVector* input);

/// Brings all connections of a port up to date, before the pipeline would; where they change
/// over time, at the given time or, without, at the first step. For RequestInformation of
/// algorithms whose whole extent depends on the content: a wrong one makes filters and writers
/// downstream produce nothing. \return the data of the connections; those that failed are left out
std::vector<vtkDataObject*> update_inputs(
  vtkAlgorithm* algorithm, int port, vtkInformationVector* input, std::optional<double> time = {});

/// The data of all connections of a port.
std::vector<vtkDataObject*> input_data(vtkInformationVector* input);

/// Sets the whole extent of all outputs that have one; sub-extents are not produced.
void announce_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions);

/// Makes the pipeline run the pass REQUEST_TIME_DEPENDENT_INFORMATION.
void announce_changing_dimensions(vtkInformationVector* outputs);

/// In that pass: sets the whole extents anew, and with them requests for all of what was before.
/// \return whether the dimensions have changed
bool renew_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions);

/// True where another piece than the first is wanted, which gets nothing.
bool wants_nothing(vtkInformation* request, vtkInformationVector* outputs);

/// What is wrong if these dimensions are not those that were announced; else empty.
std::string check_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions);

/// What is wrong if other dimensions are asked for than there are, by a consumer whose extents do
/// not follow; else empty. The request is dropped, as the executive would join it with the next
/// one. For dimensions that have changed since they were announced first.
std::string refuse_other_request(vtkInformationVector* outputs);

/// Empties all outputs.
void clear_outputs(vtkInformationVector* outputs);

} // namespace footpoint::conversion

#endif
