// SPDX-License-Identifier: BSD-3-Clause
// Private: multi-blocks, partitioned data sets and collections of them by one set of functions.

#ifndef DataTree_h
#define DataTree_h

#include "vtkType.h"

#include <string>

class vtkDataObject;
class vtkDataObjectTree;

namespace footpoint::conversion
{

/// Null blocks count.
unsigned int number_of_children(vtkDataObjectTree* tree);
vtkDataObject* child(vtkDataObjectTree* tree, unsigned int number);
std::string child_name(vtkDataObjectTree* tree, unsigned int number);

/// \param data null, or what may stand there
/// \param name empty: none
void set_child(
  vtkDataObjectTree* tree, unsigned int number, vtkDataObject* data, const std::string& name);

/// Whether there is geometry in it: points, of a composite data set in any of its leaves.
bool has_points(vtkDataObject* data);

} // namespace footpoint::conversion

#endif
