// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/transfinite_volume.h"

#include "footpoint/grids/boundary_checks.h"
#include "footpoint/grids/polyline.h"
#include "footpoint/grids/side_roles.h"
#include "footpoint/grids/transfinite_kernel.h"

#include <algorithm>

namespace footpoint
{

namespace
{

constexpr const char* kFaceNames[] = { "u = 0", "u = 1", "v = 0", "v = 1", "w = 0", "w = 1" };

/// The two directions that a face runs over.
constexpr std::array<std::array<int, 2>, 3> kFaceDirections{ { { { 1, 2 } }, { { 0, 2 } },
  { { 0, 1 } } } };

/// The faces on the border of a volume grid, by the indices (i, j, k) of their points.
class Shell
{
public:
  Shell(const VolumeFaces& faces, double corner_tolerance)
    : Faces(faces)
  {
    this->check_counts();
    this->join(corner_tolerance);
  }

  const std::array<int, 3>& count() const { return this->Count; }
  double largest_gap() const { return this->LargestGap; }

  /// A point of the face on which index `direction` is at its first or last.
  const auto face_point(int face, const std::array<int, 3>& at) const
  {
    return this->Faces[face].points.col(this->column(face, at));
  }

  /// u reversed: the faces u = 0 and u = 1 change places.
  void mirror()
  {
    std::swap(this->Faces[0], this->Faces[1]);
    for (int face = 2; face < 6; ++face)
    {
      const Grid old = this->Faces[face];
      for (int j = 0; j < old.count[1]; ++j)
      {
        for (int i = 0; i < old.count[0]; ++i)
        {
          this->Faces[face].points.col(old.index(i, j)) =
            old.points.col(old.index(old.count[0] - 1 - i, j));
        }
      }
    }
  }

private:
  Eigen::Index column(int face, const std::array<int, 3>& at) const
  {
    const auto& directions = kFaceDirections[face / 2];
    return this->Faces[face].index(at[directions[0]], at[directions[1]]);
  }

  void check_counts()
  {
    std::vector<Points> points;
    for (const Grid& face : this->Faces)
    {
      points.push_back(face.points);
    }
    this->Count = { { this->Faces[4].count[0], this->Faces[4].count[1], this->Faces[0].count[1] } };
    for (int face = 0; face < 6; ++face)
    {
      const Grid& grid = this->Faces[face];
      for (int k = 0; k < 2; ++k)
      {
        const int direction = kFaceDirections[face / 2][k];
        const std::string entry = std::string("the face ") + kFaceNames[face] + " has " +
          std::to_string(grid.count[k]) + " points along " + "uvw"[direction];
        if (grid.count[k] < 2)
        {
          throw BoundaryError(BoundaryDefect::Resolution, entry + "; at least 2 are needed");
        }
        if (grid.count[k] != this->Count[direction])
        {
          throw BoundaryError(BoundaryDefect::Count,
            entry + "; others have " + std::to_string(this->Count[direction]));
        }
      }
      if (grid.points.cols() != Eigen::Index(grid.count[0]) * grid.count[1])
      {
        throw BoundaryError(BoundaryDefect::Count,
          std::string("the face ") + kFaceNames[face] + " holds " +
            std::to_string(grid.points.cols()) + " points; its counts say " +
            std::to_string(Eigen::Index(grid.count[0]) * grid.count[1]));
      }
    }
    check_polylines(points, 4, "face");
  }

  /// Gives each edge and corner one place, the mean of those that its faces have for it.
  void join(double corner_tolerance)
  {
    std::vector<Points> points;
    for (const Grid& face : this->Faces)
    {
      points.push_back(face.points);
    }
    BoundaryOptions options;
    options.merge_tolerance = corner_tolerance;
    const BoundaryScale scale = measure(points, options);
    for (int direction = 0; direction < 3; ++direction)
    {
      const int second = (direction + 1) % 3;
      const int third = (direction + 2) % 3;
      for (int k = 0; k < 4 * this->Count[direction]; ++k)
      {
        std::array<int, 3> at{};
        at[direction] = k / 4;
        at[second] = (k & 1) != 0 ? this->Count[second] - 1 : 0;
        at[third] = (k & 2) != 0 ? this->Count[third] - 1 : 0;
        this->join_at(at, scale);
      }
    }
  }

  void join_at(const std::array<int, 3>& at, const BoundaryScale& scale)
  {
    std::vector<int> meeting;
    for (int direction = 0; direction < 3; ++direction)
    {
      if (at[direction] == 0)
      {
        meeting.push_back(2 * direction);
      }
      else if (at[direction] == this->Count[direction] - 1)
      {
        meeting.push_back(2 * direction + 1);
      }
    }
    const Vector3 first = this->face_point(meeting[0], at);
    Vector3 offset = Vector3::Zero();
    for (const int face : meeting)
    {
      const Vector3 apart = this->face_point(face, at) - first;
      this->LargestGap = std::max(this->LargestGap, apart.norm());
      if (apart.norm() > scale.merge)
      {
        throw BoundaryError(BoundaryDefect::Gap,
          std::string("the faces ") + kFaceNames[meeting[0]] + " and " + kFaceNames[face] +
            " are " + distance_text(apart.norm(), scale) + " apart at the grid point (" +
            std::to_string(at[0]) + ", " + std::to_string(at[1]) + ", " + std::to_string(at[2]) +
            ")");
      }
      offset += apart / static_cast<double>(meeting.size());
    }
    const Vector3 place = first + offset;
    for (const int face : meeting)
    {
      this->Faces[face].points.col(this->column(face, at)) = place;
    }
  }

  VolumeFaces Faces;
  std::array<int, 3> Count{};
  double LargestGap = 0.0;
};

double mix(double t, int end)
{
  return end == 0 ? 1.0 - t : t;
}

/// Faces − edges + corners for all points of the row (j, k), the border excepted.
void fill_row(const Shell& shell, int j, int k, VolumeGrid& grid)
{
  const std::array<int, 3>& count = shell.count();
  const double v = static_cast<double>(j) / (count[1] - 1);
  const double w = static_cast<double>(k) / (count[2] - 1);
  const auto end = [&](int direction, int which) { return which == 0 ? 0 : count[direction] - 1; };
  const Vector3 origin = shell.face_point(4, { { 0, 0, 0 } });

  // === What the ends of the row differ from the blend that the other faces make there
  const auto blend = [&](int i) -> Vector3
  {
    Vector3 sum = Vector3::Zero();
    for (int a = 0; a < 2; ++a)
    {
      sum += mix(v, a) * (shell.face_point(2 + a, { { i, j, k } }) - origin);
      sum += mix(w, a) * (shell.face_point(4 + a, { { i, j, k } }) - origin);
      for (int b = 0; b < 2; ++b)
      {
        sum -= mix(v, a) * mix(w, b) *
          (shell.face_point(4 + b, { { i, end(1, a), end(2, b) } }) - origin);
      }
    }
    return sum;
  };
  const Vector3 first = shell.face_point(0, { { 0, j, k } }) - origin - blend(0);
  const Vector3 last =
    shell.face_point(1, { { count[0] - 1, j, k } }) - origin - blend(count[0] - 1);

  for (int i = 1; i + 1 < count[0]; ++i)
  {
    const double u = static_cast<double>(i) / (count[0] - 1);
    grid.points.col(grid.index(i, j, k)) = origin + (blend(i) + (first + u * (last - first)));
  }
}

void copy_border(const Shell& shell, VolumeGrid& grid)
{
  const std::array<int, 3>& count = shell.count();
  for (int face = 0; face < 6; ++face)
  {
    const auto& directions = kFaceDirections[face / 2];
    std::array<int, 3> at{};
    at[face / 2] = face % 2 == 0 ? 0 : count[face / 2] - 1;
    for (at[directions[1]] = 0; at[directions[1]] < count[directions[1]]; ++at[directions[1]])
    {
      for (at[directions[0]] = 0; at[directions[0]] < count[directions[0]]; ++at[directions[0]])
      {
        grid.points.col(grid.index(at[0], at[1], at[2])) = shell.face_point(face, at);
      }
    }
  }
}

/// Volume enclosed by the faces, positive where u, v, w are right-handed: a third of the flux of
/// the position through their quads.
double signed_volume(const Shell& shell, const Vector3& origin)
{
  const std::array<int, 3>& count = shell.count();
  double volume = 0.0;
  for (int face = 0; face < 6; ++face)
  {
    const auto& directions = kFaceDirections[face / 2];
    const double outwards = (face % 2 == 1) == (face / 2 != 1) ? 1.0 : -1.0;
    std::array<int, 3> at{};
    at[face / 2] = face % 2 == 0 ? 0 : count[face / 2] - 1;
    const auto corner = [&](int i, int j) -> Vector3
    {
      std::array<int, 3> there = at;
      there[directions[0]] = i;
      there[directions[1]] = j;
      return shell.face_point(face, there) - origin;
    };
    for (int j = 0; j + 1 < count[directions[1]]; ++j)
    {
      for (int i = 0; i + 1 < count[directions[0]]; ++i)
      {
        const Vector3 p00 = corner(i, j);
        const Vector3 p10 = corner(i + 1, j);
        const Vector3 p11 = corner(i + 1, j + 1);
        const Vector3 p01 = corner(i, j + 1);
        volume += outwards * (p00 + p10 + p11 + p01).dot((p11 - p00).cross(p01 - p10)) / 24.0;
      }
    }
  }
  return volume;
}

/// The sides of a face with corners in the middle of their gaps.
std::array<Points, 4> joined(std::array<Points, 4> sides, const std::array<int, 4>& edges,
  const BoundaryScale& scale, const std::string& face)
{
  for (const CornerEnds& corner : kCorners)
  {
    const auto end = [&](int k)
    {
      Points& side = sides[corner.role[k]];
      return side.col(corner.end[k] == 0 ? 0 : side.cols() - 1);
    };
    const double gap = (end(0) - end(1)).norm();
    if (gap > scale.merge)
    {
      throw BoundaryError(BoundaryDefect::Gap,
        "the edges " + std::to_string(edges[corner.role[0]]) + " and " +
          std::to_string(edges[corner.role[1]]) + " of the face " + face + " are " +
          distance_text(gap, scale) + " apart");
    }
    const Vector3 place = 0.5 * (end(0) + end(1));
    end(0) = place;
    end(1) = place;
  }
  return sides;
}

} // namespace

VolumeResult transfinite_volume(
  const VolumeFaces& faces, double corner_tolerance, const Execution& execution)
{
  Shell shell(faces, corner_tolerance);
  VolumeResult result;
  result.largest_gap = shell.largest_gap();
  result.mirrored = signed_volume(shell, shell.face_point(4, { { 0, 0, 0 } })) < 0.0;
  if (result.mirrored)
  {
    shell.mirror();
  }

  const std::array<int, 3>& count = shell.count();
  result.grid.count = count;
  result.grid.points.resize(3, Eigen::Index(count[0]) * count[1] * count[2]);
  execution.parallel_for(count[2] - 2,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (int k = static_cast<int>(begin) + 1; k < static_cast<int>(end) + 1; ++k)
      {
        for (int j = 1; j + 1 < count[1]; ++j)
        {
          fill_row(shell, j, k, result.grid);
        }
      }
    });
  copy_border(shell, result.grid);
  return result;
}

VolumeFaces faces_from_edges(const std::array<Points, 12>& given, double corner_tolerance)
{
  check_polylines(std::vector<Points>(given.begin(), given.end()), 2, "edge");
  std::array<Points, 12> edges = given;

  // === One count along each direction
  std::array<int, 3> count{};
  for (int k = 0; k < 12; ++k)
  {
    count[k / 4] = std::max(count[k / 4], static_cast<int>(edges[k].cols()));
  }
  for (int k = 0; k < 12; ++k)
  {
    if (edges[k].cols() != count[k / 4])
    {
      edges[k] = sample_by_index(edges[k], even_spacing(count[k / 4]));
    }
  }

  BoundaryOptions options;
  options.merge_tolerance = corner_tolerance;
  const BoundaryScale scale = measure(std::vector<Points>(edges.begin(), edges.end()), options);

  // === Four edges bound a face: along its first direction, then along its second
  VolumeFaces faces;
  for (int face = 0; face < 6; ++face)
  {
    const int normal = face / 2;
    const auto [first, second] = kFaceDirections[normal];
    // Of the edges along `direction`, the one where `normal` is on the face and `other` at an end.
    const auto edge = [&](int direction, int other, int end)
    { return 4 * direction + (normal < other ? face % 2 + 2 * end : end + 2 * (face % 2)); };
    const std::array<int, 4> indices{ { edge(first, second, 0), edge(second, first, 1),
      edge(first, second, 1), edge(second, first, 0) } };
    faces[face].count = { { count[first], count[second] } };
    faces[face].points.resize(3, Eigen::Index(count[first]) * count[second]);
    const std::array<Points, 4> sides{ { edges[indices[0]], edges[indices[1]], edges[indices[2]],
      edges[indices[3]] } };
    transfinite_kernel(joined(sides, indices, scale, kFaceNames[face]), faces[face].points.data());
  }
  return faces;
}

} // namespace footpoint
