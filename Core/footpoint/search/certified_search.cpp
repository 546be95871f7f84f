// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions.
#include "footpoint/search/vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "footpoint/search/certified_search.cpp"
#include <hwy/foreach_target.h>

#include "footpoint/search/finder-inl.h"
#include "footpoint/search/packet_descent-inl.h"
#include "footpoint/search/piece_collection-inl.h"
#include "footpoint/search/piece_level-inl.h"
#include "footpoint/search/piece_proof-inl.h"
#include "footpoint/search/piece_search-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{

void find_nearest(const SearchStructure& structure, const CertifiedQuery& query,
  SearchWorkspace& workspace, CertifiedAnswer& answer)
{
  Finder finder(structure, query, 0, workspace, answer);
  for (bool waits = finder.start(); waits; waits = finder.go_on())
  {
    take_plain_steps(finder.pending());
  }
  finder.finish();
}

/// Searches that wait for descents: those on the same piece are made together, then each search
/// goes on.
void find_all_nearest(const SearchStructure& structure, const CertifiedQuery* queries, int count,
  SearchWorkspace& workspace, CertifiedAnswer* answers)
{
  using Line = SearchWorkspace::Line;
  static_assert(alignof(Finder) <= alignof(Line), "the memory must fit");
  static_assert(std::is_trivially_destructible<Finder>::value, "the memory is just left");
  constexpr std::size_t kLines = (sizeof(Finder) + sizeof(Line) - 1) / sizeof(Line);
  workspace.searches.resize(CertifiedSearch::kTogether * kLines);
  const auto memory_of = [&workspace](std::uint64_t number)
  { return &workspace.searches[number * kLines]; };
  const auto finder_of = [&memory_of](std::uint64_t number)
  { return std::launder(reinterpret_cast<Finder*>(memory_of(number))); };
  // The piece, then the number of the query.
  std::uint64_t waiting[CertifiedSearch::kTogether];
  const auto piece_of = [](std::uint64_t word) { return word / CertifiedSearch::kTogether; };
  const auto number_of = [](std::uint64_t word) { return word % CertifiedSearch::kTogether; };
  int left = 0;
  const auto wait_or_finish = [&](Finder* finder, std::uint64_t number, bool waits)
  {
    if (waits)
    {
      waiting[left++] =
        static_cast<std::uint64_t>(finder->pending().query.index) * CertifiedSearch::kTogether +
        number;
    }
    else
    {
      finder->finish();
    }
  };
  for (int k = 0; k < count; ++k)
  {
    const auto number = static_cast<std::uint64_t>(k);
    Finder* finder =
      new (memory_of(number)) Finder(structure, queries[k], k, workspace, answers[k]);
    wait_or_finish(finder, number, finder->start());
  }
  while (left > 0)
  {
    const int all = left;
    std::sort(waiting, waiting + all);
    for (int first = 0; first < all;)
    {
      Descent* packet[Lanes::kCount] = {};
      const int begin = first;
      do
      {
        packet[first - begin] = &finder_of(number_of(waiting[first]))->pending();
        ++first;
      } while (first < all && first - begin < Lanes::kCount &&
        piece_of(waiting[first]) == piece_of(waiting[begin]));
      take_plain_steps(packet, first - begin);
    }
    left = 0;
    for (int k = 0; k < all; ++k)
    {
      const std::uint64_t number = number_of(waiting[k]);
      Finder* finder = finder_of(number);
      wait_or_finish(finder, number, finder->go_on());
    }
  }
}

} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace footpoint
{
namespace
{
HWY_EXPORT(find_nearest);
HWY_EXPORT(find_all_nearest);
}

CertifiedSearch::CertifiedSearch(DistanceForms forms, const Execution& execution)
  : Structure(std::move(forms), execution)
{
}

void CertifiedSearch::find(
  const CertifiedQuery& query, SearchWorkspace& workspace, CertifiedAnswer& answer) const
{
  workspace.finds.resize(std::max<std::size_t>(workspace.finds.size(), 1));
  HWY_DYNAMIC_DISPATCH(find_nearest)(this->Structure, query, workspace, answer);
}

void CertifiedSearch::find(const CertifiedQuery* queries, int count, SearchWorkspace& workspace,
  CertifiedAnswer* answers) const
{
  workspace.finds.resize(kTogether);
  HWY_DYNAMIC_DISPATCH(find_all_nearest)(this->Structure, queries, count, workspace, answers);
}

} // namespace footpoint

#endif
