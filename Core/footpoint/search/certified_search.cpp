// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions; the best that the processor has is taken at run
// time. SSSE3 and the extensions of AVX-512 would add nothing to SSE4 and AVX-512 here.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "footpoint/search/certified_search.cpp"
#include <hwy/foreach_target.h>

#include "footpoint/search/finder-inl.h"
#include "footpoint/search/packet_descent-inl.h"
#include "footpoint/search/piece_forms-inl.h"
#include "footpoint/search/piece_proof-inl.h"
#include "footpoint/search/piece_search-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <new>
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

/// Searches that wait for descents: those on the same piece are made together, then each search goes on.
void find_all_nearest(const SearchStructure& structure, const CertifiedQuery* queries, int count,
  SearchWorkspace& workspace, CertifiedAnswer* answers)
{
  alignas(Finder) unsigned char memory[CertifiedSearch::kTogether * sizeof(Finder)];
  Finder* waiting[CertifiedSearch::kTogether];
  int number = 0;
  for (int k = 0; k < count; ++k)
  {
    Finder* finder =
      new (memory + k * sizeof(Finder)) Finder(structure, queries[k], k, workspace, answers[k]);
    if (finder->start())
    {
      waiting[number++] = finder;
    }
    else
    {
      finder->finish();
    }
  }
  while (number > 0)
  {
    const auto piece_of = [](Finder* finder) { return finder->pending().query.index; };
    std::sort(waiting, waiting + number,
      [&](Finder* a, Finder* b) { return std::make_pair(piece_of(a), a) < std::make_pair(piece_of(b), b); });
    for (int first = 0; first < number;)
    {
      Descent* packet[Lanes::kCount];
      int size = 0;
      do
      {
        packet[size] = &waiting[first + size]->pending();
        ++size;
      } while (size < Lanes::kCount && first + size < number &&
        piece_of(waiting[first + size]) == packet[0]->query.index);
      take_plain_steps(packet, size);
      first += size;
    }
    int left = 0;
    for (int k = 0; k < number; ++k)
    {
      Finder* finder = waiting[k];
      if (finder->go_on())
      {
        waiting[left++] = finder;
      }
      else
      {
        finder->finish();
      }
    }
    number = left;
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

CertifiedSearch::CertifiedSearch(DistanceForms forms)
  : Structure(std::move(forms))
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
