// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/foot_conditions.h"
#include "footpoint/solvers/local_solver.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace footpoint
{

/// One local search: the state of find_local_foot. Its parts are defined in files of their own:
/// guarded_descent.cpp, stationary_point.cpp and bare_iteration.cpp.
template <int N>
class Descent
{
public:
  Descent(const ParametricGeometry<N>& geometry, const Vector3& query, const SolverOptions& options,
    const Step<N>& step)
    : Geometry(geometry)
    , Query(query)
    , Options(options)
    , Propose(step)
    , Conditions(geometry, options)
    , Order(options.safeguards ? derivative_order(options.method) : 3)
  {
  }

  LocalFoot<N> run(const Parameter<N>& start)
  {
    this->Current = this->frame_at(this->Conditions.walk().enter(start));
    this->Iterations = 1;
    this->Lambda = this->Options.initial_lambda;
    this->Radius = std::min(this->Options.first_trust_radius, this->Options.trust_radius) *
      this->Geometry.size();
    return this->Options.safeguards ? this->descend() : this->iterate();
  }

private:
  using Place = typename DomainWalk<N>::Place;

  /// What ends a search for a lower point: the frame found, or nothing.
  using Candidate = std::optional<Frame<N>>;

  using Curvatures = Eigen::SelfAdjointEigenSolver<typename Frame<N>::Matrix>;

  Frame<N> frame_at(const Place& place) const
  {
    return make_frame<N>(this->Geometry, this->Query, place.t, place.sides, this->Order);
  }

  Place place() const { return { this->Current.t, this->Current.sides }; }

  /// Rounding of E = ½|r|², from eight roundings of each coordinate.
  double energy_noise() const
  {
    const double error = 8.0 * std::numeric_limits<double>::epsilon() *
      (this->Geometry.size() + this->Current.distance);
    return error * (this->Current.distance + error);
  }

  bool is_lower(double energy) const
  {
    return energy < this->Current.energy() - this->energy_noise();
  }
  bool lower(const Frame<N>& frame) const { return this->is_lower(frame.energy()); }

  StepSettings<N> settings(const Eigen::Matrix<bool, N, 1>& free) const
  {
    StepSettings<N> result;
    result.free = free;
    result.lambda = this->Lambda;
    result.descend = this->Options.safeguards;
    result.scale = Parameter<N>::Ones();
    for (int i = 0; i < N && this->Options.column_scaling; ++i)
    {
      const double slowest = kStalledSpeed * this->Geometry.direction(i).speed;
      const double speed = std::max(this->Current.speed(i), slowest);
      result.scale(i) = speed > 0.0 ? 1.0 / speed : 1.0;
    }
    return result;
  }

  // === The guarded descent ===

  LocalFoot<N> descend();

  bool step_is_small() const;

  /// Where the parametrization stands still, or a surface is a thin strip, a short way in space is
  /// a long one in parameters: both have to be short.
  bool stays(const Parameter<N>& t) const;

  LocalFoot<N> settle_or_stagnate(bool settled);

  /// A lower point reached by the method's step or, where that is rejected, by its fall-backs.
  Candidate step();

  Candidate proposed_step(const StepSettings<N>& settings);

  Candidate newton_step(const StepSettings<N>& settings);

  /// −scale² g: steepest descent in scaled parameters.
  Parameter<N> steepest(const StepSettings<N>& settings) const;

  /// A geometric step leads uphill beyond the centre of curvature: then it is turned round.
  Parameter<N> descending(const Parameter<N>& step, const StepSettings<N>& settings) const;

  /// The step within the trust radius; near a pole, where the tangent plane degenerates and the
  /// quadratic model with it, within a quarter of it.
  Parameter<N> limited(const Parameter<N>& step) const;

  /// The better of the full step and, where it crosses a border of the piece, the border itself.
  Frame<N> arrive(const Parameter<N>& step, Parameter<N>& moved) const;
  /// Whether a frame at which arrive() may end is lower: from points alone, without their
  /// derivatives.
  bool may_be_lower_after(const Parameter<N>& step) const;

  /// Enough decrease; or, where E is equal to rounding, smaller residuals, first those above their
  /// floor.
  bool accepts(const Frame<N>& frame, const Parameter<N>& moved) const;

  Candidate shortened(Parameter<N> step);

  /// Levenberg–Marquardt: λ × ¼ on success, × 4 on failure.
  Candidate damped_step(StepSettings<N> settings);

  /// One Newton step along u, then one along v.
  Candidate isocurve_step(const StepSettings<N>& settings);

  // === A stationary point that is no minimum ===

  /// A way on from a frame that meets the conditions on its own piece: over a border, out of a
  /// saddle, along a collapsed side, or to the middle of a flat minimum.
  Candidate leave();

  /// The neighbouring piece in which the descent is steepest, if any.
  Candidate cross_border() const;

  /// Whether a step into the piece of a frame that lies where the current one does leads down: a
  /// residual alone may be the rounding of a seam, and would be handed to and fro.
  bool descends(const Frame<N>& frame) const;

  /// At a pole the parameter along the collapsed side is free: the column in which descent is
  /// steepest.
  Candidate turn_at_pole();

  /// The place on a collapsed side of direction i that the current point is on, or a rounding off.
  std::optional<Place> pole(int i) const;

  Candidate steepest_column(const Place& pole, int across) const;

  /// The free directions and those in which next to nothing presses against a border: there, too, E
  /// may curve downwards (a saddle on a knot line, and a point beside one).
  Eigen::Matrix<bool, N, 1> nearly_free() const;

  /// Principal curvatures of E over the free directions, in scaled parameters; held ones count 1.
  Curvatures curvatures(const StepSettings<N>& settings) const;

  /// Finite steps along directions in which E does not curve upwards, and along those that stall.
  Candidate escape_saddle(const StepSettings<N>& settings, const Curvatures& curvatures) const;

  /// Where E is flat the residual vanishes long before the place is found, and a Newton step leads
  /// only 1/m of the way to a root of multiplicity m of the gradient (E. Schröder 1870): m times
  /// the step is tried, with one step more to get back to the bottom of a bent valley.
  Candidate sharpen(const StepSettings<N>& settings, const Curvatures& curvatures) const;

  /// The lower of the ends of ever shorter steps forth and back; equal ones: back.
  Candidate probe(const Parameter<N>& direction) const;

  // === The bare iteration of the literature ===

  LocalFoot<N> iterate();

  bool small(const Parameter<N>& moved) const;

  // === The result ===

  LocalFoot<N> finish(Termination termination) const;

  const ParametricGeometry<N>& Geometry;
  const Vector3& Query;
  const SolverOptions& Options;
  const Step<N>& Propose;
  FootConditions<N> Conditions;
  int Order;
  Frame<N> Current;
  int Iterations = 0;
  int PoleRestarts = 0;
  double Lambda = 0.0;
  double LastStep = 0.0;
  double Checkpoint =
    std::numeric_limits<double>::infinity(); ///< residual kPatience iterations ago
  bool Slow = false;
  double Radius = 0.0; ///< of the trust region, in model units
};

} // namespace footpoint
