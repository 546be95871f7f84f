// SPDX-License-Identifier: BSD-3-Clause
// Private: the wires of a face as loops of trim curves in (u, v).

#ifndef TrimLoops_h
#define TrimLoops_h

#include "ParameterCurves.h"

#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>

#include <vector>

namespace footpoint::cad
{

/// Curves head to tail, as far as the file's tolerances allow.
using TrimChain = std::vector<TrimCurve>;

/// The wires of a face: counter-clockwise ones keep their inside, whatever the face's orientation.
/// Edges inside the face (internal, external) are no part of it. In periodic directions each loop
/// is shifted by whole periods next to the largest one. \param surface of the face, without its
/// location \throw ConversionError naming the edge that has no trim curve
std::vector<TrimChain> trim_loops(const TopoDS_Face& face, const Handle(Geom_Surface) & surface);

/// The area in (u, v) that a loop encloses, positive for counter-clockwise ones; from samples.
double signed_area(const TrimChain& loop);

} // namespace footpoint::cad

#endif
