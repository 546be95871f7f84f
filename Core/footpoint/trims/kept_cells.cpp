// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/kept_cells.h"

#include <cmath>

namespace footpoint
{

namespace
{

/// Cells per arc: memory stays proportional to the arcs, and an arc of ordinary length passes
/// through a small part of the cells.
constexpr double kCellsPerArc = 32.0;
constexpr double kLeastSide = 32.0;
constexpr double kLargestSide = 512.0; ///< 1.3 MB with the sums

/// Halvings after which what is left of an arc marks its whole box.
constexpr int kMostHalvings = 24;

struct CellRange
{
  std::array<std::uint32_t, 2> first;
  std::array<std::uint32_t, 2> last; ///< included
};

} // namespace

KeptCells::KeptCells(const WindingIndex& index)
{
  const double arcs = static_cast<double>(index.size());
  this->Side = static_cast<std::uint32_t>(
    std::clamp(std::ceil(std::sqrt(kCellsPerArc * arcs)), kLeastSide, kLargestSide));
  for (int i = 0; i < 2; ++i)
  {
    this->CellsPerLength[i] = this->Side / index.length()[i];
  }
  this->States.assign(this->Side * this->Side, State::Outside);
  this->mark(index);
  this->fill(index);
}

void KeptCells::mark(const WindingIndex& index)
{
  // A monotone arc whose box is one cell wide or high passes through all cells of the box.
  const auto mark_part = [&](const auto& self, std::size_t arc, double t0,
                           const Eigen::Vector2d& p0, double t1, const Eigen::Vector2d& p1,
                           int halvings) -> void
  {
    CellRange cells;
    for (int i = 0; i < 2; ++i)
    {
      const double low = std::min(p0[i], p1[i]) - index.margin()[i];
      const double high = std::max(p0[i], p1[i]) + index.margin()[i];
      if (high < 0.0 || low > index.length()[i])
      {
        return;
      }
      cells.first[i] = this->line(i, std::max(low, 0.0));
      cells.last[i] = this->line(i, std::min(high, index.length()[i]));
    }
    if (halvings == 0 || cells.first[0] == cells.last[0] || cells.first[1] == cells.last[1])
    {
      for (std::uint32_t j = cells.first[1]; j <= cells.last[1]; ++j)
      {
        for (std::uint32_t i = cells.first[0]; i <= cells.last[0]; ++i)
        {
          this->States[i + j * this->Side] = State::Crossed;
        }
      }
      return;
    }
    const double t = 0.5 * (t0 + t1);
    const Eigen::Vector2d p = index.point(arc, t);
    self(self, arc, t0, p0, t, p, halvings - 1);
    self(self, arc, t, p, t1, p1, halvings - 1);
  };
  for (std::size_t k = 0; k < index.size(); ++k)
  {
    if (!index.on_border(k))
    {
      mark_part(mark_part, k, 0.0, index.point(k, 0.0), 1.0, index.point(k, 1.0), kMostHalvings);
    }
  }
}

void KeptCells::fill(const WindingIndex& index)
{
  const std::uint32_t row = this->Side + 1;
  this->Crossed.assign(row * row, 0);
  for (std::uint32_t j = 0; j < this->Side; ++j)
  {
    // Between crossed cells of a row the winding number cannot change.
    State before = State::Crossed;
    std::uint32_t crossed = 0;
    for (std::uint32_t i = 0; i < this->Side; ++i)
    {
      State& state = this->States[i + j * this->Side];
      if (state == State::Crossed)
      {
        ++crossed;
      }
      else if (before != State::Crossed)
      {
        state = before;
      }
      else
      {
        const double a = (i + 0.5) / this->CellsPerLength[0];
        const double b = (j + 0.5) / this->CellsPerLength[1];
        state = index.winding(a, b) > 0 ? State::Inside : State::Outside;
      }
      before = state;
      this->Crossed[i + 1 + (j + 1) * row] = this->Crossed[i + 1 + j * row] + crossed;
    }
  }
}

std::uint32_t KeptCells::crossed(
  const std::array<std::uint32_t, 2>& first, const std::array<std::uint32_t, 2>& last) const
{
  const std::uint32_t row = this->Side + 1;
  return this->Crossed[last[0] + last[1] * row] - this->Crossed[first[0] + last[1] * row] -
    this->Crossed[last[0] + first[1] * row] + this->Crossed[first[0] + first[1] * row];
}

KeptCells::Answer KeptCells::cover(
  const std::array<double, 2>& lower, const std::array<double, 2>& upper) const
{
  std::array<std::uint32_t, 2> first;
  std::array<std::uint32_t, 2> last;
  for (int i = 0; i < 2; ++i)
  {
    first[i] = this->line(i, lower[i]);
    last[i] = this->line(i, upper[i]) + 1;
  }
  if (this->crossed(first, last) == 0)
  {
    return { this->States[first[0] + first[1] * this->Side], true };
  }
  const bool has_core = last[0] - first[0] > 2 && last[1] - first[1] > 2;
  const bool through_core = has_core &&
    this->crossed({ { first[0] + 1, first[1] + 1 } }, { { last[0] - 1, last[1] - 1 } }) > 0;
  return { State::Crossed, through_core };
}

bool KeptCells::any_inside() const
{
  return std::find(this->States.begin(), this->States.end(), State::Inside) != this->States.end();
}

} // namespace footpoint
