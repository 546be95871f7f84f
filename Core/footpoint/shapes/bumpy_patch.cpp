// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/shapes/shape_checks.h"
#include "footpoint/shapes/shapes.h"

namespace footpoint
{

namespace
{

constexpr int kMostSpans = 1000;

/// Uniform numbers in [−1, 1) by integer arithmetic alone: SplitMix64 (G. L. Steele, D. Lea and C.
/// H. Flood 2014).
class SplitMix
{
public:
  explicit SplitMix(std::uint64_t seed)
    : State(seed)
  {
  }

  double next()
  {
    this->State += 0x9e3779b97f4a7c15u;
    std::uint64_t word = this->State;
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    word ^= word >> 31;
    return static_cast<double>(word >> 11) * 0x1p-52 - 1.0;
  }

private:
  std::uint64_t State;
};

} // namespace

Shape bumpy_patch(double size, double amplitude, int resolution, std::uint64_t seed)
{
  check_length("Size", size);
  check_length("Amplitude", amplitude);
  check_range("Resolution", resolution, 1, kMostSpans);
  std::vector<double> knots(3, 0.0);
  for (int i = 0; i <= resolution; ++i)
  {
    knots.push_back(static_cast<double>(i) / resolution);
  }
  knots.insert(knots.end(), 3, 1.0);
  const KnotVector u(3, knots, "KnotsU");
  const KnotVector v(3, knots, "KnotsV");

  // x and y are linear in the parameters where control points stand at Greville abscissae.
  const int count = resolution + 3;
  Points points(3, count * count);
  SplitMix random(seed);
  for (int j = 0; j < count; ++j)
  {
    for (int i = 0; i < count; ++i)
    {
      points.col(count * j + i) << size * (u.greville(i) - 0.5), size * (v.greville(j) - 0.5),
        amplitude * random.next();
    }
  }
  return { { "Bumpy patch", Surface(u, v, points) } };
}

} // namespace footpoint
