// SPDX-License-Identifier: BSD-3-Clause
// Private: the work of vtkPointInversionFilter between its data and the core.

#ifndef PointInversionInternals_h
#define PointInversionInternals_h

#include "CachedInverter.h"
#include "CancelSignal.h"
#include "FootRecord.h"
#include "Ranks.h"
#include "ReplicatedGeometry.h"
#include "vtkPointInversionFilter.h"

#include <exception>
#include <string>

struct vtkPointInversionFilter::Internals
{
  using SourceGeometry = footpoint::conversion::SourceGeometry;
  using Ranks = footpoint::conversion::Ranks;

  footpoint::conversion::ReplicatedGeometry Geometry;
  footpoint::conversion::CachedInverter Inverter;

  /// VTK_DOUBLE_MAX stands for infinity in options, as a number that survives text.
  static double Limit(double value);
  static footpoint::InversionOptions Options(vtkPointInversionFilter* self);
  static footpoint::conversion::FootArrayLayout Layout(
    vtkPointInversionFilter* self, const footpoint::Model& model);

  /// What stops this rank before any work: "" or a message that names the data or the option.
  static std::string InvalidInput(
    vtkPointInversionFilter* self, vtkDataObject* input, vtkDataObject* output);

  /// Collective: makes `Inverter` ready for the geometry of all ranks and the options, unless the
  /// user, here or on another rank, wants to stop.
  /// \return "" or what is wrong
  std::string Prepare(vtkPointInversionFilter* self, const SourceGeometry& own, const Ranks& ranks,
    footpoint::conversion::CancelSignal& cancel);

  /// Stops early where the user, here or on another rank, wants it.
  void Invert(vtkPointInversionFilter* self, const footpoint::conversion::PointBlocks& points,
    footpoint::conversion::CancelSignal& cancel, footpoint::conversion::FootRecord& record) const;

  /// What a body throws, as text.
  template <typename Body>
  static std::string ErrorOf(const Body& body)
  {
    try
    {
      body();
    }
    catch (const std::bad_alloc&)
    {
      return "There is not enough memory.";
    }
    catch (const std::exception& error)
    {
      return error.what();
    }
    return "";
  }

private:
  double Prepared = 0.0; ///< progress when the inverter was ready
  /// Names the first option that is no usable number or does not go with another; else empty.
  static std::string InvalidOption(vtkPointInversionFilter* self);
};

#endif
