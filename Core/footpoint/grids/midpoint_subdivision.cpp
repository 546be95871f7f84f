// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/transfinite.h"

#include "footpoint/grids/boundary_checks.h"
#include "footpoint/grids/polyline.h"
#include "footpoint/grids/transfinite_kernel.h"

namespace footpoint
{

namespace
{

Points straight_line(const Vector3& from, const Vector3& to, int count)
{
  Points line(3, 2);
  line << from, to;
  return sample_by_index(line, even_spacing(count));
}

/// The sides with ends that meet bit for bit, in the middle of the gaps.
std::vector<Points> joined(std::vector<Points> sides)
{
  const BoundaryScale scale = measure(sides, {});
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    const std::size_t previous = (k + sides.size() - 1) % sides.size();
    const Eigen::Index last = sides[previous].cols() - 1;
    const Vector3 end = sides[previous].col(last);
    const Vector3 start = sides[k].col(0);
    if ((end - start).norm() > scale.merge)
    {
      throw BoundaryError(BoundaryDefect::Gap,
        "the end of side " + std::to_string(previous) + " and the start of side " +
          std::to_string(k) + " are " + distance_text((end - start).norm(), scale) + " apart");
    }
    sides[previous].col(last) = 0.5 * (end + start);
    sides[k].col(0) = sides[previous].col(last);
  }
  return sides;
}

} // namespace

std::vector<Grid> midpoint_subdivision(const std::vector<Points>& given, int half_resolution)
{
  if (given.size() < 3)
  {
    throw BoundaryError(BoundaryDefect::Count,
      "there are " + std::to_string(given.size()) + " sides; midpoint subdivision needs three");
  }
  if (half_resolution < 1)
  {
    throw BoundaryError(BoundaryDefect::Resolution,
      "half a side is to have " + std::to_string(half_resolution) + " cells; at least 1 is needed");
  }
  check_polylines(given, 2, "side");
  const std::vector<Points> sides = joined(given);
  const int count = half_resolution + 1;

  // === Halve the sides, and join their middles with the centre
  std::vector<Points> halved;
  Vector3 centre = Vector3::Zero();
  for (const Points& side : sides)
  {
    halved.push_back(sample_by_arc_length(side, even_spacing(2 * half_resolution + 1)));
    centre +=
      (halved.back().col(half_resolution) - sides[0].col(0)) / static_cast<double>(sides.size());
  }
  centre += sides[0].col(0);
  std::vector<Points> spokes;
  for (const Points& side : halved)
  {
    spokes.push_back(straight_line(side.col(half_resolution), centre, count));
  }

  // === One patch at each corner
  std::vector<Grid> grids;
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    const std::size_t previous = (k + sides.size() - 1) % sides.size();
    std::array<Points, 4> patch;
    patch[kBottom] = halved[k].leftCols(count);
    patch[kRight] = spokes[k];
    patch[kTop] = spokes[previous];
    patch[kLeft] = halved[previous].rightCols(count).rowwise().reverse();
    Grid grid;
    grid.count = { { count, count } };
    grid.points.resize(3, Eigen::Index(count) * count);
    transfinite_kernel(patch, grid.points.data());
    grids.push_back(std::move(grid));
  }
  return grids;
}

} // namespace footpoint
