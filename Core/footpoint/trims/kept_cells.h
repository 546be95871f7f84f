// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/winding_index.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace footpoint
{

/// A grid over the domain that knows of each cell whether it is kept or not, or that an arc passes:
/// the quick answer for most points and boxes.
class KeptCells
{
public:
  enum class State : std::uint8_t
  {
    Outside,
    Inside,
    Crossed
  };

  KeptCells() = default;
  explicit KeptCells(const WindingIndex& index);

  /// \pre 0 ≤ a ≤ length[0], 0 ≤ b ≤ length[1]
  State at(double a, double b) const
  {
    return this->States[this->line(0, a) + this->line(1, b) * this->Side];
  }

  /// What is known of a box at once: Inside and Outside for certain; Crossed where an arc passes
  /// through it for certain; `known` false where only cells at the box's rim are crossed.
  struct Answer
  {
    State state;
    bool known;
  };
  Answer cover(const std::array<double, 2>& lower, const std::array<double, 2>& upper) const;

  /// Whether a whole cell is kept.
  bool any_inside() const;

private:
  std::uint32_t line(int i, double at) const
  {
    const auto cell = static_cast<std::uint32_t>(at * this->CellsPerLength[i]);
    return std::min(cell, this->Side - 1);
  }
  void mark(const WindingIndex& index);
  void fill(const WindingIndex& index);
  /// The number of crossed cells in [first, last) of both directions.
  std::uint32_t crossed(
    const std::array<std::uint32_t, 2>& first, const std::array<std::uint32_t, 2>& last) const;

  std::array<double, 2> CellsPerLength{ { 1.0, 1.0 } };
  std::uint32_t Side = 1; ///< cells per direction
  std::vector<State> States{ State::Crossed };
  std::vector<std::uint32_t> Crossed; ///< (Side + 1)² sums of the cells before a corner
};

} // namespace footpoint
