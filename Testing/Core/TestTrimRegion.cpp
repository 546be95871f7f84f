// SPDX-License-Identifier: BSD-3-Clause
#include "TrimShapes.h"

#include <gtest/gtest.h>

namespace
{

using footpoint::TrimRegion;
using namespace trims;

TEST(TrimRegion, CircleInClosedForm)
{
  const Surface surface = flat();
  const TrimRegion region({ circle(0.5, 0.4, 0.3) }, surface, 0.0);
  const TrimRegion hole({ reversed(circle(0.5, 0.4, 0.3)) }, surface, 0.0);
  shapes::Random random(1);
  for (int k = 0; k < 100000; ++k)
  {
    const double u = random.uniform(0.0, 1.0);
    const double v = random.uniform(0.0, 1.0);
    const double distance = std::hypot(u - 0.5, v - 0.4) - 0.3;
    if (std::abs(distance) > 1e-14)
    {
      ASSERT_EQ(region.contains(u, v), distance < 0.0) << u << " " << v;
      ASSERT_EQ(hole.contains(u, v), distance > 0.0) << u << " " << v;
    }
  }
}

TEST(TrimRegion, PointsBesideACircle)
{
  const TrimRegion region({ circle(0.5, 0.4, 0.3) }, flat(), 0.0);
  shapes::Random random(2);
  for (int k = 0; k < 20000; ++k)
  {
    const double angle = random.uniform(-4.0, 4.0);
    for (const double offset : { 1e-12, -1e-12, 1e-6, -1e-6 })
    {
      const double u = 0.5 + (0.3 + offset) * std::cos(angle);
      const double v = 0.4 + (0.3 + offset) * std::sin(angle);
      ASSERT_EQ(region.contains(u, v), offset < 0.0) << angle << " " << offset;
    }
  }
}

} // namespace
