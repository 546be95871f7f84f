// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/local_solver.h"

#include "footpoint/solvers/descent.h"

namespace footpoint
{

template <int N>
LocalFoot<N> Descent<N>::finish(Termination termination) const
{
  LocalFoot<N> foot;
  foot.parameter = this->Current.t;
  foot.sides = this->Current.sides;
  foot.point = this->Current.jet.point;
  foot.distance = this->Current.distance;
  foot.residual = this->Conditions.residuals(this->Current).maxCoeff();
  foot.iterations = this->Iterations;
  foot.termination = termination;
  const bool coincides = termination == Termination::PointCoincidence;
  const bool can_end = termination != Termination::IterationLimit;
  foot.converged = coincides || (can_end && this->Conditions.excess(this->Current) <= 1.0);
  foot.type = this->Conditions.classify(this->Current, this->Query);
  // One point, two parameters: a seam is reported at the start of its direction.
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    if (direction.closed && foot.parameter(i) == direction.length)
    {
      foot.parameter(i) = 0.0;
      foot.sides(i) = Side::Right;
    }
  }
  return foot;
}

template <int N>
LocalFoot<N> find_local_foot(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& start, const SolverOptions& options, const Step<N>& step)
{
  return Descent<N>(geometry, query, options, step).run(start);
}

template <int N>
LocalFoot<N> find_local_foot(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& start, const SolverOptions& options)
{
  return find_local_foot<N>(geometry, query, start, options, make_step<N>(options.method));
}

template LocalFoot<1> Descent<1>::finish(Termination) const;
template LocalFoot<2> Descent<2>::finish(Termination) const;
template LocalFoot<1> find_local_foot<1>(const ParametricGeometry<1>&, const Vector3&,
  const Parameter<1>&, const SolverOptions&, const Step<1>&);
template LocalFoot<2> find_local_foot<2>(const ParametricGeometry<2>&, const Vector3&,
  const Parameter<2>&, const SolverOptions&, const Step<2>&);
template LocalFoot<1> find_local_foot<1>(
  const ParametricGeometry<1>&, const Vector3&, const Parameter<1>&, const SolverOptions&);
template LocalFoot<2> find_local_foot<2>(
  const ParametricGeometry<2>&, const Vector3&, const Parameter<2>&, const SolverOptions&);

} // namespace footpoint
