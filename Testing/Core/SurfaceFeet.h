// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Inversion.h"

#include "footpoint/model/certified_feet.h"

namespace inversion
{

/// The certified search of one surface alone.
class Feet
{
public:
  explicit Feet(const footpoint::Surface& surface, bool reversed = false);

  const footpoint::CertifiedFeet& search() const { return this->Search; }
  footpoint::CertifiedAnswer answer(const Vector3& point) const;
  /// Whether a query's foot is on a kink and filled in at once.
  bool is_plain_kink(const Vector3& point, Foot& foot) const;

private:
  Patch Whole;
  footpoint::CertifiedFeet Search;
};

} // namespace inversion
