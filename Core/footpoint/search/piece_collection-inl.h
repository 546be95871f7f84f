// SPDX-License-Identifier: BSD-3-Clause

// The members of Finder that go through the tree of boxes: to a piece to begin with, and to all
// that may hold the nearest point. Compiled once for each set of vector instructions (the guard of
// Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PIECE_COLLECTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_COLLECTION_INL_H
#undef FOOTPOINT_PIECE_COLLECTION_INL_H
#else
#define FOOTPOINT_PIECE_COLLECTION_INL_H
#endif

#include "footpoint/search/finder-inl.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// Squared distances of the boxes of a node from the query. Double precision: far away the boxes
/// differ by less than single precision tells.
HWY_INLINE void Finder::box_distances(const BoxTree::Node& node, double* squared) const
{
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> single;
  const auto zero = hn::Zero(tag);
  for (int k = 0; k < BoxTree::kWidth; k += static_cast<int>(hn::Lanes(tag)))
  {
    auto sum = zero;
    for (int i = 0; i < 3; ++i)
    {
      const auto p = hn::Set(tag, this->P[i]);
      const auto lower = hn::PromoteTo(tag, hn::LoadU(single, node.lower[i] + k));
      const auto upper = hn::PromoteTo(tag, hn::LoadU(single, node.upper[i] + k));
      const auto way = hn::Max(hn::Max(hn::Sub(lower, p), hn::Sub(p, upper)), zero);
      sum = hn::MulAdd(way, way, sum);
    }
    hn::StoreU(sum, tag, squared + k);
  }
}

/// Squared distances of the boxes of a node, and the child that a way down follows: boxes that hold
/// the point are told apart by their middles.
HWY_INLINE int Finder::visit(std::int32_t index)
{
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> single;
  const hn::RebindToUnsigned<decltype(tag)> bits;
  constexpr std::uint64_t kNumber = BoxTree::kWidth - 1;
  const auto zero = hn::Zero(tag);
  const auto slight = hn::Set(tag, 1e-3);       // weight of the distance of the middle
  const auto greatest = hn::Set(tag, 0x1p1000); // the first child where all are beyond all bounds
  auto least = hn::Set(tag, kInfinity);
  const BoxTree::Node& node = this->Structure.tree.nodes()[index];
  Visit& visit = this->Path[this->Depth++];
  visit.node = index;
  visit.followed = 0;
  for (int k = 0; k < BoxTree::kWidth; k += static_cast<int>(hn::Lanes(tag)))
  {
    auto squared = zero;
    auto middle = zero;
    for (int i = 0; i < 3; ++i)
    {
      const auto p = hn::Set(tag, this->P[i]);
      const auto below = hn::Sub(hn::PromoteTo(tag, hn::LoadU(single, node.lower[i] + k)), p);
      const auto above = hn::Sub(p, hn::PromoteTo(tag, hn::LoadU(single, node.upper[i] + k)));
      const auto way = hn::Max(hn::Max(below, above), zero);
      squared = hn::MulAdd(way, way, squared);
      const auto twice = hn::Sub(below, above);
      middle = hn::MulAdd(twice, twice, middle);
    }
    hn::StoreU(squared, tag, visit.squared + k);
    // Every score carries the number of its child in its last bits, so that the least one tells
    // whose it is.
    const auto score = hn::Min(hn::MulAdd(slight, middle, squared), greatest);
    const auto number = hn::Iota(bits, static_cast<std::uint64_t>(k));
    least = hn::Min(least,
      hn::BitCast(
        tag, hn::Or(hn::AndNot(hn::Set(bits, kNumber), hn::BitCast(bits, score)), number)));
  }
  return static_cast<int>(
    hn::GetLane(hn::BitCast(bits, hn::MinOfLanes(tag, least))) & kNumber);
}

Finder::Leaf Finder::go_down(std::int32_t child)
{
  const AlignedVector<BoxTree::Node>& nodes = this->Structure.tree.nodes();
  for (;;)
  {
    const int nearest = this->visit(child);
    Visit& visit = this->Path[this->Depth - 1];
    child = nodes[visit.node].child[nearest];
    if (child < 0)
    {
      return { this->Depth - 1, nearest, visit.squared[nearest] };
    }
    visit.followed |= 1U << nearest;
  }
}

bool Finder::begin()
{
  const AlignedVector<BoxTree::Node>& nodes = this->Structure.tree.nodes();
  Leaf leaf = this->go_down(0);
  // Where boxes overlap the way down may miss the one that holds the point.
  for (int more = 0; more < kMostWaysDown && leaf.squared > 0.0; ++more)
  {
    double least = kMuchNearer * leaf.squared;
    int from = -1;
    int next = 0;
    for (int k = 0; k < this->Depth; ++k)
    {
      const Visit& visit = this->Path[k];
      unsigned nearer =
        at_most(visit.squared, least) & nodes[visit.node].present & ~visit.followed;
      for (; nearer != 0; nearer &= nearer - 1)
      {
        const auto child = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(nearer));
        if (visit.squared[child] < least)
        {
          least = visit.squared[child];
          from = k;
          next = child;
        }
      }
    }
    if (from < 0)
    {
      break;
    }
    const std::int32_t child = nodes[this->Path[from].node].child[next];
    Leaf other{ from, next, least };
    if (child >= 0)
    {
      this->Path[from].followed |= 1U << next;
      other = this->go_down(child);
    }
    leaf = other.squared < leaf.squared ? other : leaf;
  }
  Visit& last = this->Path[leaf.visit];
  last.followed |= 1U << leaf.child;
  return this->begin_with(-1 - nodes[last.node].child[leaf.child], leaf.squared);
}

void Finder::collect()
{
  const AlignedVector<BoxTree::Node>& nodes = this->Structure.tree.nodes();
  // Each level leaves all but one of its children behind.
  std::int32_t stack[BoxTree::kWidth * kMostLevels];
  int top = 0;
  auto take = [&](const BoxTree::Node& node, const double* squared, unsigned except)
  {
    const double reach = this->reach();
    const double limit = reach * reach * kOutward;
    unsigned hits = at_most(squared, limit) & node.present & ~except;
    for (; hits != 0; hits &= hits - 1)
    {
      const auto k = hwy::Num0BitsBelowLS1Bit_Nonzero32(hits);
      const std::int32_t child = node.child[k];
      if (child >= 0)
      {
        stack[top++] = child;
      }
      else
      {
        if (!this->is_settled(-1 - child))
        {
          this->collect(-1 - child, squared[k]);
        }
      }
    }
  };
  // What begin() passed on its way, the nearest first.
  for (int k = this->Depth - 1; k >= 0; --k)
  {
    const Visit& visit = this->Path[k];
    take(nodes[visit.node], visit.squared, visit.followed);
    while (top > 0)
    {
      const BoxTree::Node& node = nodes[stack[--top]];
      HWY_ALIGN double squared[BoxTree::kWidth];
      this->box_distances(node, squared);
      take(node, squared, 0);
    }
  }
}

void Finder::collect(std::int32_t index, double squared)
{
  double bound = squared / kOutward;
  const OutlineView view(this->Structure.outlines[index], this->P, this->Rounding);
  if (!view.is_usable())
  {
    this->Finds.candidates.push_back({ index, bound });
    return;
  }
  bound = std::max(bound, view.bound());
  const double reach = this->reach() + this->Structure.forms.greatest_error();
  if (bound >= reach * reach * kOutward)
  {
    return;
  }
  this->Finds.candidates.push_back({ index, bound });
  // The corners are points of the piece.
  const PieceQuery query = this->at(index);
  double corner = 0.0;
  const int k = view.nearest_corner(query.piece->shape->rational, corner);
  if (corner < this->SquaredBound)
  {
    this->bound_by(query, { { k / 2 * 1.0, k % 2 * 1.0 } }, corner);
  }
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
