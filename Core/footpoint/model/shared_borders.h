// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/model/model.h"

#include <array>

namespace footpoint
{

/// Which borders of a patch another patch of the same face continues: [direction][0 start, 1 end].
struct SharedBorders
{
  std::array<std::array<bool, 2>, 2> shared{ { { { false, false } }, { { false, false } } } };

  /// Whether a place on the patch's boundary lies on shared borders only.
  /// \param local local parameters; curves: the first counts
  bool cover(const Patch& patch, const Parameter<2>& local) const;
};

/// For each patch of a face the borders that it shares: those whose ends and middle coincide (to
/// kClosureTolerance of the patch's size) with the ends and the middle of another patch's border.
std::vector<SharedBorders> find_shared_borders(const Face& face);

} // namespace footpoint
