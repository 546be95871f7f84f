// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/curve_meeting.h"

#include "footpoint/search/seeded_search.h"

namespace footpoint
{
namespace
{

/// Samples a direction: curves of a network are long and meet once.
constexpr SeedOptions kSeeds{ 41, 8 };

/// A(u) − B(v), relative to the difference of their centres.
class DifferenceSurface : public ParametricSurface
{
public:
  DifferenceSurface(const ParametricCurve& first, const ParametricCurve& second)
    : First(first)
    , Second(second)
  {
    this->Directions = { first.direction(0), second.direction(0) };
    this->Size = first.size() + second.size();
    this->Centre = first.centre() - second.centre();
  }

  Jet<2> jet(const Parameter<2>& t, const Sides<2>& sides, int order) const override
  {
    const Jet<1> a = this->First.jet(Parameter<1>(t(0)), sides.head<1>(), order);
    const Jet<1> b = this->Second.jet(Parameter<1>(t(1)), sides.tail<1>(), order);
    Jet<2> jet;
    jet.point = a.point - b.point;
    jet.first << a.first, -b.first;
    jet.second << a.second, Vector3::Zero(), -b.second;
    return jet;
  }

private:
  const ParametricCurve& First;
  const ParametricCurve& Second;
};

} // namespace

CurveMeeting find_meeting(const ParametricCurve& first, const ParametricCurve& second)
{
  const DifferenceSurface difference(first, second);
  const SeededSearch<2> search(difference, kSeeds);
  const LocalFoot<2> foot = search.find(-difference.centre(), SolverOptions{});
  return { foot.parameter(0), foot.parameter(1), foot.distance };
}

} // namespace footpoint
