// SPDX-License-Identifier: BSD-3-Clause
// Private: reads a CAD file and sends all that is asked for, part by part.

#ifndef ModelSending_h
#define ModelSending_h

#include "CADModel.h"

namespace footpoint::cad
{

/// Every failure is sent as a record, too. \param records file descriptor
/// \throw StreamError where nobody receives any more
void send_model(const ReadingOptions& options, int records);

} // namespace footpoint::cad

#endif
