// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/grids/boundary.h"
#include "footpoint/grids/structured_points.h"
#include "footpoint/splines/curve.h"

#include <memory>

namespace footpoint
{

/// Where along the sides the grid's lines end, and which parameters blend them.
enum class GridParametrization
{
  Uniform,            ///< even in the index of the samples
  ArcLengthRecorded,  ///< geometry as Uniform; the arc lengths are given besides
  ArcLengthResampled, ///< sides are sampled evenly in arc length
  ArcLengthBlended    ///< B. Soni (1985): interior parameters from the arc lengths of facing sides
};

enum class Blend
{
  Bilinear, ///< S. A. Coons (1967), W. J. Gordon and C. A. Hall (1973)
  Bicubic   ///< Hermite blending with cross-boundary tangents and twists: C1 to prescribed ribbons
};

struct TransfiniteOptions
{
  /// Points along u and v; 0: as many as the longer of the two facing sides has.
  std::array<int, 2> resolution{ { 21, 21 } };
  GridParametrization parametrization = GridParametrization::Uniform;
  Blend blend = Blend::Bilinear;
};

/// Cross-boundary tangents for the bicubic blend, in the parameters [0, 1]²: ∂C/∂t along bottom and
/// top, ∂C/∂s along right and left, sampled like the grid's border; and the twists ∂²C/∂s∂t at C00,
/// C10, C11, C01.
struct Ribbons
{
  std::array<Points, 4> tangents; ///< by Role; empty: those of the bilinear patch
  std::array<Vector3, 4> twists;
  /// False: those that the tangents imply along either side of the corner, blended as J. A. Gregory
  /// (1974) does, so that all tangents are met even where the two differ; of estimated tangents
  /// that is A. Adini's twist, the one of the bilinear patch.
  bool given_twists = false;
};

struct TransfiniteResult
{
  Grid grid;
  Eigen::VectorXd arc_length_u; ///< per grid point where recorded or used, else empty
  Eigen::VectorXd arc_length_v;
  /// Bicubic: largest difference of the two twists that the tangents imply at a corner (J. A.
  /// Gregory 1974), relative to the larger of them or to the size of the boundary, whichever is
  /// larger; 0: compatible. The twists come from one-sided differences of four samples (error of
  /// third order).
  double twist_incompatibility = 0.0;
};

/// Transfinite interpolation of four sides; they come out bit for bit on the border where their
/// counts are those of the grid (and ArcLengthResampled does not move their points). In
/// ArcLengthBlended the interior parameters are
/// s = (s_b + t_l (s_t − s_b)) / (1 − (s_t − s_b)(t_r − t_l)) and t likewise, of the arc lengths at
/// the ends of the grid's lines; ArcLengthRecorded gives the same numbers.
/// \throw BoundaryError (Resolution; Count: ribbons that are not sampled like the border)
TransfiniteResult transfinite_grid(const Boundary& boundary, const TransfiniteOptions& options = {},
  const Ribbons* ribbons = nullptr, const Execution& execution = {});

/// Memory of the caller that a grid is made in.
struct TransfiniteOutput
{
  double* points = nullptr; ///< receives 3·nu·nv numbers, u fastest; never touched before
  /// Receive nu·nv numbers each where `has_arc_lengths`; else not used.
  double* arc_length_u = nullptr;
  double* arc_length_v = nullptr;
};

/// The same grid in memory of the caller; what is allocated besides is O(nu + nv).
/// \return the twist incompatibility
double fill_transfinite(const Boundary& boundary, const TransfiniteOptions& options,
  const TransfiniteOutput& output, const Ribbons* ribbons = nullptr,
  const Execution& execution = {});

/// Points along u and v that a grid gets.
/// \throw BoundaryError (Resolution)
std::array<int, 2> transfinite_resolution(
  const Boundary& boundary, const TransfiniteOptions& options);

/// Whether arc lengths are recorded or used.
bool has_arc_lengths(const TransfiniteOptions& options);

/// Samples of four exact curves (each over its domain, evenly in the parameter).
std::array<Points, 4> sample_sides(
  const std::array<std::shared_ptr<const ParametricCurve>, 4>& curves,
  const std::array<int, 2>& resolution);

/// Three-sided and N-sided boundaries as four-sided patches around a centre: corner k's patch is
/// bounded by the two half sides at that corner and by lines from the middles of the sides to the
/// centre.
/// \param sides N ≥ 3 polylines, head to tail
/// \param half_resolution cells along half a side
/// \return N grids that share their lines point for point
std::vector<Grid> midpoint_subdivision(const std::vector<Points>& sides, int half_resolution);

} // namespace footpoint
