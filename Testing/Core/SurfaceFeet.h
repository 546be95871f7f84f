// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Inversion.h"

#include "footpoint/model/certified_feet.h"

#include <gtest/gtest.h>

#include <limits>

namespace inversion
{

/// The certified search of one surface alone.
class Feet
{
public:
  explicit Feet(const footpoint::Surface& surface, bool reversed = false)
    : Whole(patch_of(surface))
    , Search({ { &this->Whole, 3, reversed, {}, nullptr, nullptr, nullptr } }, surface.centre(),
        surface.size())
  {
  }

  const footpoint::CertifiedFeet& search() const { return this->Search; }
  footpoint::CertifiedAnswer answer(const Vector3& point) const
  {
    footpoint::SearchWorkspace workspace;
    footpoint::CertifiedAnswer answer;
    this->Search.find(point, std::numeric_limits<double>::infinity(), 1e-12, workspace, answer);
    return answer;
  }
  /// Whether a query's foot is on a kink and filled in at once.
  bool is_plain_kink(const Vector3& point, Foot& foot) const
  {
    const footpoint::CertifiedAnswer found = this->answer(point);
    if (!found.certified || found.count != 2)
    {
      return false;
    }
    Foot other;
    const bool in_turn = this->Search.plain_kink_foot(found.feet[1], found.feet[0], other);
    const bool is_plain = this->Search.plain_kink_foot(found.feet[0], found.feet[1], foot);
    EXPECT_EQ(in_turn, is_plain);
    return is_plain;
  }

private:
  Patch Whole;
  footpoint::CertifiedFeet Search;
};

} // namespace inversion
