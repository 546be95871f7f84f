// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/descent.h"

namespace footpoint
{

template <int N>
LocalFoot<N> Descent<N>::iterate()
{
  Frame<N> best = this->Current;
  Termination termination = Termination::IterationLimit;
  while (this->Iterations < this->Options.maximum_iterations)
  {
    if (this->Current.distance <= this->Options.point_tolerance * this->Geometry.size())
    {
      termination = Termination::PointCoincidence;
      break;
    }
    if (this->Conditions.residuals(this->Current).maxCoeff() <=
      this->Options.cosine_tolerance * this->Current.distance)
    {
      termination = Termination::ZeroCosine;
      break;
    }
    const StepSettings<N> settings = this->settings(Eigen::Matrix<bool, N, 1>::Constant(true));
    const Parameter<N> step = this->Propose(this->Current, settings);
    if (!step.allFinite())
    {
      termination = Termination::Stagnation;
      break;
    }
    const auto move = this->Conditions.walk().move(this->place(), step);
    const bool small = this->small(move.moved);
    this->Current = this->frame_at(move.place);
    ++this->Iterations;
    best = this->Current.energy() <= best.energy() ? this->Current : best;
    if (small)
    {
      termination = Termination::SmallStep;
      break;
    }
  }
  this->Current = best;
  return this->finish(termination);
}

template <int N>
bool Descent<N>::small(const Parameter<N>& moved) const
{
  bool by_parameter = true;
  for (int i = 0; i < N; ++i)
  {
    by_parameter = by_parameter &&
      std::abs(moved(i)) < this->Options.parameter_tolerance * this->Geometry.direction(i).length;
  }
  return by_parameter ||
    (this->Current.jet.first * moved).norm() <=
    this->Options.step_tolerance * this->Geometry.size();
}

template LocalFoot<1> Descent<1>::iterate();
template LocalFoot<2> Descent<2>::iterate();

} // namespace footpoint
