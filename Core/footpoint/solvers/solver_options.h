// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace footpoint
{

/// The step that the local solver takes; E = ½|S − P|², r = S − P.
enum class Method
{
  Newton,             ///< full second derivatives of E; indefinite Hessians by |eigenvalue|
  GaussNewton,        ///< JᵀJ Δ = −Jᵀr
  LevenbergMarquardt, ///< (JᵀJ + λI) Δ = −Jᵀr, λ driven by actual / predicted reduction
  /// Newton in the geometry's own metric: (I − h·II) Δ = −Jᵀr with the second fundamental form, h
  /// the signed height of P, corrected to second order along the geodesic. Independent of the
  /// parametrization; on curves it is Method 2 of the paper carried to space.
  SecondOrder,
  FirstOrder,      ///< curves: P projected onto the tangent line
  CurvatureCircle, ///< curves: S.-M. Hu and J. Wallner (2005), P projected onto the osculating
                   ///< circle
  SecondOrder1,    ///< curves: second-order Method 1, arc of the parabola measured by its area
  SecondOrder2,    ///< curves: second-order Method 2, Δt = s / |c'|
  SecondOrder3     ///< curves: second-order Method 3, with the change of curvature
};

/// Every length below is a fraction of the geometry's size (diagonal of the control points'
/// bounding box); on a model of unit size it is that length itself.
struct SolverOptions
{
  Method method = Method::Newton;

  /// Point coincidence: |r| below this ends the search. A margin of ten over the rounding of an
  /// evaluation (unit size: 1e-14; the guide's ‖r‖² < 1e-22 is 1e-11).
  double point_tolerance = 1e-14;

  /// Zero cosine: |r·S_i| ≤ cosine_tolerance |r| |S_i| in every direction that is free to move
  /// (no unit; unit size of the guide: |g| < 1e-13). The error of the distance is its square.
  double cosine_tolerance = 1e-12;

  /// A step shorter than this in space, and than this fraction of the domain in every parameter,
  /// ends the search (unit size: 1e-15); the result then counts as converged only if the residual
  /// is down to rounding.
  double step_tolerance = 1e-15;

  /// Without safeguards only: |Δt| below this fraction of the domain ends the search, 0: never.
  double parameter_tolerance = 0.0;

  int maximum_iterations = 100; ///< evaluations of an iteration; a limit against endless crawling

  /// Longest step in space (guide, unit size: 0.25 … 1).
  double trust_radius = 0.5;

  /// Longest first step, doubled with every step that is taken: where other starts are near, a
  /// descent is to find the minimum of its own neighbourhood.
  double first_trust_radius = std::numeric_limits<double>::infinity();

  /// Never pass a kink or seam in one step, but stop there and look first whether the way leads on:
  /// where every smooth piece has starts of its own, none of their minima is then passed over.
  bool stop_at_borders = false;

  bool column_scaling =
    true; ///< normalise the columns of J, for speeds that differ by powers of ten
  bool isocurve_fallback =
    true; ///< surfaces: 1-D steps along u, then v, where the 2-D step is rejected

  /// Accept only steps that bring the point nearer (trust radius, backtracking, crossing of seams
  /// and kinks, escape from saddles). Off: the bare iteration of the literature, clamped to the
  /// domain.
  bool safeguards = true;

  /// Levenberg–Marquardt's damping (guide): ×¼ on success, ×4 on failure, within the limits.
  double initial_lambda = 1e-6;
  double minimum_lambda = 1e-12;
  double maximum_lambda = 1e8;
};

} // namespace footpoint
