// SPDX-License-Identifier: BSD-3-Clause
// The teapot of M. E. Newell (The Utilization of Procedure Models in Digital Image Synthesis,
// thesis, University of Utah, 1975) in the proportions of J. F. Blinn, with the bottom of F. C.
// Crow (The Origins of the Teapot, IEEE Computer Graphics and Applications 7, 1987): control points
// of Bézier patches. All patches of a part meet tangentially, and with the right lengths of knot
// spans C1.
#include "footpoint/shapes/shapes.h"

namespace footpoint
{

namespace
{

/// A row of the patches around the axis: a quarter has the control points (radius, 0), (radius,
/// offset), (offset, radius), (0, radius).
struct Ring
{
  double radius;
  double offset;
  double z;
};

/// A row across the patches of handle and spout: two halves (x0, 0, z0), (x0, ∓width, z0), (x1,
/// ∓width, z1), (x1, 0, z1).
struct Loop
{
  double x0;
  double z0;
  double x1;
  double z1;
  double width;
};

const std::vector<Ring> kBody{ //
  { 0.0, 0.0, 0.0 }, { 1.425, 0.798, 0.0 }, { 1.5, 0.84, 0.075 }, { 1.5, 0.84, 0.15 },
  { 1.5, 0.84, 0.225 }, { 2.0, 1.12, 0.45 }, { 2.0, 1.12, 0.9 },  //
  { 2.0, 1.12, 1.35 }, { 1.75, 0.98, 1.875 }, { 1.5, 0.84, 2.4 }, //
  { 1.4375, 0.805, 2.53125 }, { 1.3375, 0.749, 2.53125 }, { 1.4, 0.784, 2.4 }
};
const std::vector<Ring> kLid{ //
  { 1.3, 0.728, 2.4 }, { 1.3, 0.728, 2.55 }, { 0.4, 0.224, 2.55 }, { 0.2, 0.112, 2.7 },
  { 0.0, 0.0, 2.85 }, { 0.8, 0.45, 3.15 }, { 0.0, 0.0, 3.15 }
};
const std::vector<Loop> kHandle{ //
  { -1.6, 2.025, -1.5, 2.25, 0.3 }, { -2.3, 2.025, -2.5, 2.25, 0.3 },
  { -2.7, 2.025, -3.0, 2.25, 0.3 }, { -2.7, 1.8, -3.0, 1.8, 0.3 }, { -2.7, 1.575, -3.0, 1.35, 0.3 },
  { -2.5, 1.125, -2.65, 0.9375, 0.3 }, { -2.0, 0.9, -1.9, 0.6, 0.3 }
};
const std::vector<Loop> kSpout{ //
  { 1.7, 1.425, 1.7, 0.6, 0.66 }, { 2.6, 1.425, 3.1, 0.825, 0.66 }, { 2.3, 2.1, 2.4, 2.025, 0.25 },
  { 2.7, 2.4, 3.3, 2.4, 0.25 }, { 2.8, 2.475, 3.525, 2.49375, 0.25 },
  { 2.9, 2.475, 3.45, 2.5125, 0.15 }, { 2.8, 2.4, 3.2, 2.4, 0.15 }
};

/// Knots of cubic pieces that are C1 at the inner breakpoints.
KnotVector smooth_knots(const std::vector<double>& breakpoints, const char* name)
{
  std::vector<double> knots{ breakpoints.front(), breakpoints.front() };
  for (const double at : breakpoints)
  {
    knots.insert(knots.end(), 2, at);
  }
  knots.insert(knots.end(), 2, breakpoints.back());
  return KnotVector(3, std::move(knots), name);
}

std::vector<Vector3> control_points(const Ring& ring)
{
  const double r = ring.radius;
  const double k = ring.offset;
  const double z = ring.z;
  // Without the points where quarters meet: they are the means of their neighbours.
  return { { r, 0, z }, { r, k, z }, { k, r, z }, { -k, r, z }, { -r, k, z }, { -r, -k, z },
    { -k, -r, z }, { k, -r, z }, { r, -k, z }, { r, 0, z } };
}

std::vector<Vector3> control_points(const Loop& loop)
{
  return { { loop.x0, 0, loop.z0 }, { loop.x0, -loop.width, loop.z0 },
    { loop.x1, -loop.width, loop.z1 }, { loop.x1, loop.width, loop.z1 },
    { loop.x0, loop.width, loop.z0 }, { loop.x0, 0, loop.z0 } };
}

/// A part of rows along v; every third row between patches is left out, as it lies between its
/// neighbours in the ratio of the knot spans.
/// \param breakpoints_u, breakpoints_v  where patches meet
template <class Row>
Surface part(const std::vector<Row>& rows, const std::vector<double>& breakpoints_u,
  const std::vector<double>& breakpoints_v)
{
  std::vector<Vector3> net;
  for (std::size_t j = 0; j < rows.size(); ++j)
  {
    if (j % 3 != 0 || j == 0 || j + 1 == rows.size())
    {
      const std::vector<Vector3> row = control_points(rows[j]);
      net.insert(net.end(), row.begin(), row.end());
    }
  }
  Points points(3, static_cast<Eigen::Index>(net.size()));
  for (std::size_t i = 0; i < net.size(); ++i)
  {
    points.col(static_cast<Eigen::Index>(i)) = net[i];
  }
  return Surface(
    smooth_knots(breakpoints_u, "KnotsU"), smooth_knots(breakpoints_v, "KnotsV"), points);
}

} // namespace

Shape teapot()
{
  const std::vector<double> around{ 0, 1, 2, 3, 4 };
  const std::vector<double> across{ 0, 1, 2 };
  // Tangents at the rim and at the tip of the spout are a quarter as long as before them.
  return { { "Body", part(kBody, around, { 0, 1, 2, 3, 3.25 }) },
    { "Lid", part(kLid, around, { 0, 1, 2 }) }, { "Handle", part(kHandle, across, { 0, 1, 2 }) },
    { "Spout", part(kSpout, across, { 0, 1, 1.25 }) } };
}

} // namespace footpoint
