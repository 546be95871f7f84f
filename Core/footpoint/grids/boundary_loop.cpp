// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/boundary.h"

#include "footpoint/grids/boundary_checks.h"
#include "footpoint/grids/polyline.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace footpoint
{

namespace
{

/// Turns that differ by less (radians) are equally sharp.
constexpr double kEqualTurns = 1e-6;

/// Order of two readings of the same loop, each from its start in its direction.
struct Reading
{
  Eigen::Index start;
  bool reversed;
};

Eigen::Index index_in(const Reading& reading, Eigen::Index i, Eigen::Index count)
{
  return reading.reversed ? (reading.start + count - i) % count : (reading.start + i) % count;
}

bool comes_before(const Points& loop, const Reading& a, const Reading& b)
{
  for (Eigen::Index i = 0; i < loop.cols(); ++i)
  {
    const int order =
      compare_points(loop.col(index_in(a, i, loop.cols())), loop.col(index_in(b, i, loop.cols())));
    if (order != 0)
    {
      return order < 0;
    }
  }
  return false;
}

/// The reading that is first in the order of coordinates: the same for every start and sense.
Reading canonical_reading(const Points& loop)
{
  Eigen::Index least = 0;
  for (Eigen::Index i = 1; i < loop.cols(); ++i)
  {
    if (compare_points(loop.col(i), loop.col(least)) < 0)
    {
      least = i;
    }
  }
  Reading best{ least, false };
  for (Eigen::Index i = least; i < loop.cols(); ++i)
  {
    if (compare_points(loop.col(i), loop.col(least)) == 0)
    {
      for (const bool reversed : { false, true })
      {
        const Reading other{ i, reversed };
        best = comes_before(loop, other, best) ? other : best;
      }
    }
  }
  return best;
}

/// A loop in its canonical reading, with what corners are found by.
struct MeasuredLoop
{
  Points points;          ///< the first not repeated
  Eigen::VectorXd length; ///< from the first point to each, along the loop
  double whole = 0.0;
  std::vector<double> turn; ///< radians; 0 at all but the first of repeated points
};

MeasuredLoop measure_loop(const Points& points, double merge)
{
  const Eigen::Index count = points.cols();
  MeasuredLoop loop{ points, Eigen::VectorXd::Zero(count), 0.0,
    std::vector<double>(static_cast<std::size_t>(count), 0.0) };
  const auto step = [&](Eigen::Index from) -> Vector3
  { return points.col((from + 1) % count) - points.col(from); };
  for (Eigen::Index i = 0; i < count; ++i)
  {
    (i + 1 < count ? loop.length[i + 1] : loop.whole) = loop.length[i] + step(i).norm();
  }
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const Vector3 incoming = step((i + count - 1) % count);
    Eigen::Index next = i;
    while (step(next).norm() <= merge && (next + 1) % count != i)
    {
      next = (next + 1) % count;
    }
    const Vector3 outgoing = step(next);
    if (incoming.norm() > merge)
    {
      loop.turn[i] = std::atan2(incoming.cross(outgoing).norm(), incoming.dot(outgoing));
    }
  }
  return loop;
}

/// Distance along the loop, the shorter way round.
double distance_along(const MeasuredLoop& loop, Eigen::Index a, Eigen::Index b)
{
  const double distance = std::abs(loop.length[a] - loop.length[b]);
  return std::min(distance, loop.whole - distance);
}

/// Of several points the one farthest from those chosen; of all equally far ones, and where none is
/// chosen, the lowest leftmost.
Eigen::Index farthest(const MeasuredLoop& loop, const std::vector<Eigen::Index>& from,
  const std::vector<Eigen::Index>& chosen)
{
  const auto distance = [&](Eigen::Index point)
  {
    double least = loop.whole;
    for (const Eigen::Index other : chosen)
    {
      least = std::min(least, distance_along(loop, point, other));
    }
    return least;
  };
  const Vector3 origin = loop.points.col(0);
  const auto height = [&](Eigen::Index point) { return (loop.points.col(point) - origin).sum(); };
  const double rounding = 1e-9 * loop.whole;
  Eigen::Index best = from.front();
  for (const Eigen::Index point : from)
  {
    const double gain = distance(point) - distance(best);
    if (gain > rounding || (gain > -rounding && height(point) < height(best) - rounding))
    {
      best = point;
    }
  }
  return best;
}

/// At most four corners, ascending.
std::vector<Eigen::Index> corners_by_angle(const MeasuredLoop& loop, double least_turn)
{
  std::vector<Eigen::Index> candidates;
  for (Eigen::Index i = 0; i < loop.points.cols(); ++i)
  {
    if (loop.turn[i] > least_turn)
    {
      candidates.push_back(i);
    }
  }
  std::vector<Eigen::Index> corners = candidates;
  if (candidates.size() > 4)
  {
    std::stable_sort(candidates.begin(), candidates.end(),
      [&](Eigen::Index a, Eigen::Index b) { return loop.turn[a] > loop.turn[b]; });
    const double fourth = loop.turn[candidates[3]];
    corners.clear();
    std::vector<Eigen::Index> equal;
    for (const Eigen::Index candidate : candidates)
    {
      if (loop.turn[candidate] > fourth + kEqualTurns)
      {
        corners.push_back(candidate);
      }
      else if (loop.turn[candidate] >= fourth - kEqualTurns)
      {
        equal.push_back(candidate);
      }
    }
    while (corners.size() < 4)
    {
      const Eigen::Index next = farthest(loop, equal, corners);
      corners.push_back(next);
      equal.erase(std::find(equal.begin(), equal.end(), next));
    }
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Cuts the longest piece between corners at the point nearest to its middle; false where no piece
/// has a point inside.
bool add_corner(const MeasuredLoop& loop, std::vector<Eigen::Index>& corners)
{
  const Eigen::Index count = loop.points.cols();
  if (corners.empty())
  {
    std::vector<Eigen::Index> all(static_cast<std::size_t>(count));
    std::iota(all.begin(), all.end(), Eigen::Index(0));
    corners.push_back(farthest(loop, all, {}));
    return true;
  }
  const auto along = [&](Eigen::Index i)
  { return loop.length[i % count] + (i >= count ? loop.whole : 0.0); };
  double longest = 0.0;
  Eigen::Index cut = -1;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Eigen::Index first = corners[k];
    const Eigen::Index last = k + 1 < corners.size() ? corners[k + 1] : corners[0] + count;
    const double piece = along(last) - along(first);
    if (last - first < 2 || piece <= longest * (1.0 + 1e-9))
    {
      continue;
    }
    const double middle = 0.5 * (along(last) + along(first));
    longest = piece;
    cut = first + 1;
    for (Eigen::Index i = first + 1; i < last; ++i)
    {
      cut = std::abs(along(i) - middle) < std::abs(along(cut) - middle) ? i : cut;
    }
  }
  if (cut >= 0)
  {
    corners.push_back(cut % count);
    std::sort(corners.begin(), corners.end());
  }
  return cut >= 0;
}

/// From one index to another, onwards along the loop, both included.
Points piece_between(const Points& loop, Eigen::Index first, Eigen::Index last)
{
  const Eigen::Index count = loop.cols();
  const Eigen::Index length = (last - first + count - 1) % count + 1; // a full turn where equal
  Points piece(3, length + 1);
  for (Eigen::Index i = 0; i <= length; ++i)
  {
    piece.col(i) = loop.col((first + i) % count);
  }
  return piece;
}

std::vector<Points> pieces_between(const Points& loop, const std::vector<Eigen::Index>& corners)
{
  std::vector<Points> pieces;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    pieces.push_back(piece_between(loop, corners[k], corners[(k + 1) % corners.size()]));
  }
  return pieces;
}

/// Four different corners in the order C00, C10, C11, C01 along the loop or against it.
Boundary split_at_ids(const Points& loop, Eigen::Index given_count, const BoundaryOptions& options)
{
  if (options.corner_ids.size() != 4)
  {
    throw BoundaryError(BoundaryDefect::Corners,
      "there are " + std::to_string(options.corner_ids.size()) +
        " corner ids; a loop is split at four");
  }
  std::vector<Eigen::Index> corners;
  for (const int id : options.corner_ids)
  {
    if (id < 0 || id >= given_count)
    {
      throw BoundaryError(BoundaryDefect::Corners,
        "the corner id " + std::to_string(id) + " is no point of the loop, which has " +
          std::to_string(given_count));
    }
    corners.push_back(id % loop.cols()); // the repeated first point, if there is one, is the first
  }
  const auto ahead = [&](int k) { return (corners[k] - corners[0] + loop.cols()) % loop.cols(); };
  const bool along = 0 < ahead(1) && ahead(1) < ahead(2) && ahead(2) < ahead(3);
  const bool against = ahead(1) > ahead(2) && ahead(2) > ahead(3) && ahead(3) > 0;
  if (!along && !against)
  {
    throw BoundaryError(BoundaryDefect::Corners,
      "the corner ids are not four different points in the order in which the loop passes them");
  }
  BoundaryOptions strict = options;
  strict.strict = true;
  const auto side = [&](int from, int to) -> Points
  {
    return along ? piece_between(loop, corners[from], corners[to])
                 : Points(piece_between(loop, corners[to], corners[from]).rowwise().reverse());
  };
  const auto backwards = [&](int from, int to) -> Points
  {
    return along ? Points(piece_between(loop, corners[from], corners[to]).rowwise().reverse())
                 : piece_between(loop, corners[to], corners[from]);
  };
  Boundary boundary =
    assemble_sides({ side(0, 1), side(1, 2), backwards(2, 3), backwards(3, 0) }, {}, strict);
  for (int role = 0; role < 4; ++role)
  {
    boundary.reports[role] = { 0, along == (role == kTop || role == kLeft) };
  }
  return boundary;
}

} // namespace

Boundary split_loop(const Points& given, const BoundaryOptions& options)
{
  check_polylines({ given }, 3, "loop");
  const BoundaryScale scale = measure({ given }, options);
  if (!(scale.size > 0.0))
  {
    throw BoundaryError(BoundaryDefect::Degenerate, "all points of the loop are one");
  }
  const Eigen::Index last = given.cols() - 1;
  const bool repeated = (given.col(last) - given.col(0)).norm() <= scale.merge;
  const Points loop = repeated ? given.leftCols(last) : given;
  if (loop.cols() < 3)
  {
    throw BoundaryError(BoundaryDefect::Count, "the loop has fewer than three different points");
  }
  if (!options.corner_ids.empty())
  {
    return split_at_ids(loop, given.cols(), options);
  }

  // === Read the loop in a way that does not depend on its start and sense
  const Reading reading = canonical_reading(loop);
  Points points(3, loop.cols());
  for (Eigen::Index i = 0; i < loop.cols(); ++i)
  {
    points.col(i) = loop.col(index_in(reading, i, loop.cols()));
  }

  // === Find the corners
  const MeasuredLoop measured = measure_loop(points, scale.merge);
  std::vector<Eigen::Index> corners =
    corners_by_angle(measured, options.corner_angle * M_PI / 180.0);
  int guessed = 0;
  const bool three = corners.size() == 3;
  while (!three && corners.size() < 4 && add_corner(measured, corners))
  {
    ++guessed;
  }
  if (corners.size() < 3)
  {
    throw BoundaryError(BoundaryDefect::Corners,
      "the loop has " + std::to_string(corners.size()) +
        " corners and no points in between that could be some");
  }

  // === Name the sides
  BoundaryOptions by_place = options;
  by_place.strict = false;
  Boundary boundary = assemble_sides(pieces_between(points, corners), {}, by_place);
  boundary.guessed_corners = guessed;
  for (SideReport& report : boundary.reports)
  {
    if (report.input >= 0)
    {
      report = { 0, report.reversed != reading.reversed };
    }
  }
  return boundary;
}

} // namespace footpoint
