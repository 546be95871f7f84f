// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/common/types.h"
#include "footpoint/search/aligned_array.h"

#include <array>
#include <cstdint>

namespace footpoint
{

/// The lower and the upper corner of a box.
using Corners = std::array<Vector3, 2>;

/// A hierarchy of axis-parallel boxes, sixteen children a node: a few vector operations ask all of
/// them, and there are few levels, each of which waits for the one before. Corners are kept in
/// single precision, rounded outward. Built once; const.
class BoxTree
{
public:
  static constexpr int kWidth = 16;

  struct alignas(64) Node
  {
    float lower[3][kWidth]; ///< +∞ where there is no child
    float upper[3][kWidth];
    std::int32_t child[kWidth]; ///< a node; or −1 − k for box k; 0: none, and none after it
    std::uint32_t present;      ///< one bit for each child that there is
  };

  BoxTree() = default;
  /// \param execution whose threads share the boxes if there are many
  explicit BoxTree(const AlignedVector<Corners>& boxes, const Execution& execution = {});

  /// The first is the root; none where there are no boxes.
  const AlignedVector<Node>& nodes() const { return this->Nodes; }

private:
  AlignedVector<Node> Nodes;
};

} // namespace footpoint
