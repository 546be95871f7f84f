// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/transfinite.h"

#include "footpoint/grids/bicubic.h"
#include "footpoint/grids/polyline.h"
#include "footpoint/grids/transfinite_kernel.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{

namespace
{

/// Number of points along u (0) or v (1).
int resolution_along(const Boundary& boundary, const TransfiniteOptions& options, int direction)
{
  const int given = options.resolution[direction];
  if (given == 0)
  {
    const Role first = direction == 0 ? kBottom : kLeft;
    const Role second = direction == 0 ? kTop : kRight;
    return static_cast<int>(std::max(boundary.sides[first].cols(), boundary.sides[second].cols()));
  }
  if (given < 2)
  {
    throw BoundaryError(BoundaryDefect::Resolution,
      "Resolution[" + std::to_string(direction) + "] = " + std::to_string(given) +
        "; a grid has at least 2 points along each direction (0: as many as the sides)");
  }
  return given;
}

/// A side with as many points as the grid has along it: as it is, where it has them.
Points resample(const Points& side, int count, GridParametrization parametrization)
{
  if (parametrization == GridParametrization::ArcLengthResampled)
  {
    return sample_by_arc_length(side, even_spacing(count));
  }
  return side.cols() == count ? side : sample_by_index(side, even_spacing(count));
}

bool has_length(const Points& side)
{
  return (side.array() != side.col(0).replicate(1, side.cols()).array()).any();
}

/// Arc lengths along the border; a side that is a point goes by the facing one.
std::array<Eigen::VectorXd, 4> border_arc_lengths(const std::array<Points, 4>& sides)
{
  std::array<Eigen::VectorXd, 4> lengths;
  for (int role = 0; role < 4; ++role)
  {
    const int facing = (role + 2) % 4;
    lengths[role] = normalized_arc_length(sides[has_length(sides[role]) ? role : facing]);
  }
  return lengths;
}

/// B. K. Soni's (1985) parameters at (i, j): where the straight line that joins equal grid indices
/// of left and right crosses that of bottom and top, in the square of arc lengths.
Eigen::Vector2d soni_parameters(
  const std::array<Eigen::VectorXd, 4>& lengths, Eigen::Index i, Eigen::Index j)
{
  const double bottom = lengths[kBottom][i];
  const double left = lengths[kLeft][j];
  const double shift_s = lengths[kTop][i] - bottom;
  const double shift_t = lengths[kRight][j] - left;
  const double denominator = 1.0 - shift_s * shift_t;
  if (!(denominator > 0.0))
  {
    // Only where both lines run along one diagonal of the square; its middle is as good as any.
    return { 0.5, 0.5 };
  }
  const double s = (bottom + left * shift_s) / denominator;
  return { s, left + s * shift_t };
}

/// The bilinear patch in its general form, for parameters that vary from point to point.
Vector3 bilinear_point(
  const std::array<Points, 4>& sides, Eigen::Index i, Eigen::Index j, double s, double t)
{
  const Points& bottom = sides[kBottom];
  const Points& top = sides[kTop];
  const Eigen::Index last = bottom.cols() - 1;
  const Vector3 c00 = bottom.col(0);
  const Vector3 c10 = bottom.col(last);
  const Vector3 base = (sides[kLeft].col(j) - c00) - t * (top.col(0) - c00);
  const Vector3 end = (sides[kRight].col(j) - c10) - t * (top.col(last) - c10);
  return bottom.col(i) + ((base + t * (top.col(i) - bottom.col(i))) + s * (end - base));
}

/// \param points nu·nv columns
void copy_border(const std::array<Points, 4>& sides, Eigen::Ref<Points> points)
{
  const Eigen::Index nu = sides[kBottom].cols();
  for (Eigen::Index j = 0; j < sides[kLeft].cols(); ++j)
  {
    points.col(nu * j) = sides[kLeft].col(j);
    points.col(nu * j + nu - 1) = sides[kRight].col(j);
  }
  points.leftCols(nu) = sides[kBottom];
  points.rightCols(nu) = sides[kTop];
}

} // namespace

bool has_arc_lengths(const TransfiniteOptions& options)
{
  return options.parametrization == GridParametrization::ArcLengthBlended ||
    options.parametrization == GridParametrization::ArcLengthRecorded;
}

std::array<int, 2> transfinite_resolution(
  const Boundary& boundary, const TransfiniteOptions& options)
{
  return { { resolution_along(boundary, options, 0), resolution_along(boundary, options, 1) } };
}

TransfiniteResult transfinite_grid(const Boundary& boundary, const TransfiniteOptions& options,
  const Ribbons* ribbons, const Execution& execution)
{
  TransfiniteResult result;
  result.grid.count = transfinite_resolution(boundary, options);
  const Eigen::Index size = Eigen::Index(result.grid.count[0]) * result.grid.count[1];
  result.grid.points.resize(3, size);
  if (has_arc_lengths(options))
  {
    result.arc_length_u.resize(size);
    result.arc_length_v.resize(size);
  }
  const TransfiniteOutput output{ result.grid.points.data(), result.arc_length_u.data(),
    result.arc_length_v.data() };
  result.twist_incompatibility = fill_transfinite(boundary, options, output, ribbons, execution);
  return result;
}

double fill_transfinite(const Boundary& boundary, const TransfiniteOptions& options,
  const TransfiniteOutput& output, const Ribbons* ribbons, const Execution& execution)
{
  const auto [nu, nv] = transfinite_resolution(boundary, options);
  std::array<Points, 4> sides;
  for (int role = 0; role < 4; ++role)
  {
    const bool along_u = role == kBottom || role == kTop;
    sides[role] = resample(boundary.sides[role], along_u ? nu : nv, options.parametrization);
  }
  const bool recorded = has_arc_lengths(options);
  if (!recorded && options.blend == Blend::Bilinear)
  {
    transfinite_kernel(sides, output.points, OutputMemory::Fresh, execution);
    return 0.0;
  }

  // === Parameters that vary from point to point, or cubic blending
  const bool blended = options.parametrization == GridParametrization::ArcLengthBlended;
  const BicubicBoundary bicubic =
    options.blend == Blend::Bicubic ? complete_ribbons(sides, ribbons) : BicubicBoundary();
  const std::array<Eigen::VectorXd, 4> lengths =
    recorded ? border_arc_lengths(sides) : std::array<Eigen::VectorXd, 4>();
  const Eigen::VectorXd u = even_spacing(nu);
  const Eigen::VectorXd v = even_spacing(nv);
  Eigen::Map<Points> points(output.points, 3, Eigen::Index(nu) * nv);
  const auto fill_row = [&, width = nu](Eigen::Index j)
  {
    for (Eigen::Index i = 0; i < width; ++i)
    {
      const Eigen::Index at = i + width * j;
      Eigen::Vector2d parameters(u[i], v[j]);
      if (recorded)
      {
        const Eigen::Vector2d arc_lengths = soni_parameters(lengths, i, j);
        output.arc_length_u[at] = arc_lengths[0];
        output.arc_length_v[at] = arc_lengths[1];
        parameters = blended ? arc_lengths : parameters;
      }
      points.col(at) = options.blend == Blend::Bicubic
        ? bicubic_point(bicubic, i, j, parameters[0], parameters[1])
        : bilinear_point(sides, i, j, parameters[0], parameters[1]);
    }
  };
  execution.parallel_for(nv,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t j = begin; j < end; ++j)
      {
        fill_row(j);
      }
    });
  copy_border(sides, points);
  return bicubic.twist_incompatibility;
}

std::array<Points, 4> sample_sides(
  const std::array<std::shared_ptr<const ParametricCurve>, 4>& curves,
  const std::array<int, 2>& resolution)
{
  std::array<Points, 4> sides;
  for (int role = 0; role < 4; ++role)
  {
    const bool along_u = role == kBottom || role == kTop;
    const int count = resolution[along_u ? 0 : 1];
    if (count < 2)
    {
      throw BoundaryError(BoundaryDefect::Resolution,
        "Resolution[" + std::to_string(along_u ? 0 : 1) + "] = " + std::to_string(count) +
          "; exact sides have no points of their own, so that at least 2 are needed");
    }
    const ParametricCurve& curve = *curves[role];
    const Eigen::VectorXd at = even_spacing(count) * curve.direction(0).length;
    sides[role].resize(3, count);
    for (int k = 0; k < count; ++k)
    {
      sides[role].col(k) = curve.centre() + curve.point(Parameter<1>(at[k]));
    }
  }
  return sides;
}

} // namespace footpoint
