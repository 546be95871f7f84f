// SPDX-License-Identifier: BSD-3-Clause

#include "SurfaceFeet.h"

#include <gtest/gtest.h>

#include <limits>

namespace inversion
{

Feet::Feet(const footpoint::Surface& surface, bool reversed)
  : Whole(patch_of(surface))
  , Search({ { &this->Whole, 3, reversed, {}, nullptr, nullptr, nullptr } }, surface.centre(),
      surface.size())
{
}

footpoint::CertifiedAnswer Feet::answer(const Vector3& point) const
{
  footpoint::SearchWorkspace workspace;
  footpoint::CertifiedAnswer answer;
  this->Search.find(point, std::numeric_limits<double>::infinity(), 1e-12, workspace, answer);
  return answer;
}

bool Feet::is_plain_kink(const Vector3& point, Foot& foot) const
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

} // namespace inversion
