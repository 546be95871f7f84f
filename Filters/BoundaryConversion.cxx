// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryConversion.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace footpoint::conversion
{

namespace
{

/// Lines that make up one side, and the number that the side is reported with.
struct Group
{
  std::vector<const Line*> lines;
  int number;
  int role;
};

int read_role(vtkDataArray* roles, vtkIdType cell)
{
  const double role = roles ? roles->GetComponent(cell, 0) : -1.0;
  if (role < -1.0 || role > 3.0 || role != std::floor(role))
  {
    throw BoundaryError(BoundaryDefect::Count,
      "BoundaryRole[" + std::to_string(cell) + "] = " + vtkVariant(role).ToString() +
        "; 0 (bottom), 1 (right), 2 (top), 3 (left) and -1 (find out) are allowed");
  }
  return static_cast<int>(role);
}

double length(const Points& points)
{
  double sum = 0.0;
  for (Eigen::Index i = 1; i < points.cols(); ++i)
  {
    sum += (points.col(i) - points.col(i - 1)).norm();
  }
  return sum;
}

Chains chain(const std::vector<const Line*>& lines, const BoundaryOptions& options)
{
  Eigen::Index count = 0;
  for (const Line* line : lines)
  {
    count += line->points.cols();
  }
  Points points(3, count);
  std::vector<std::array<int, 2>> segments;
  int first = 0;
  for (const Line* line : lines)
  {
    const int size = static_cast<int>(line->points.cols());
    points.middleCols(first, size) = line->points;
    for (int i = 1; i < size; ++i)
    {
      segments.push_back({ { first + i - 1, first + i } });
    }
    first += size;
  }
  return chain_segments(points, segments, options);
}

std::string describe(const Chains& chains)
{
  const auto list = [](const std::vector<Points>& parts, const char* name)
  {
    std::string text = std::to_string(parts.size()) + " " + name;
    for (std::size_t i = 0; i < std::min<std::size_t>(parts.size(), 5); ++i)
    {
      text += (i == 0 ? " (lengths " : ", ") + vtkVariant(length(parts[i])).ToString();
    }
    return text + (parts.empty() ? "" : parts.size() > 5 ? ", ...)" : ")");
  };
  return list(chains.loops, "closed loops") + " and " + list(chains.open, "open chains");
}

Points chained_side(const Group& group, const BoundaryOptions& options)
{
  if (group.lines.size() == 1)
  {
    return group.lines.front()->points;
  }
  const Chains chains = chain(group.lines, options);
  if (chains.open.size() != 1 || !chains.loops.empty())
  {
    throw BoundaryError(BoundaryDefect::Branch,
      "the " + std::to_string(group.lines.size()) + " lines of side " +
        std::to_string(group.number) + " make " + describe(chains) +
        "; one open chain is needed");
  }
  return chains.open.front();
}

std::vector<Group> group_by(
  const std::vector<Line>& lines, const std::function<int(const Line&)>& key, bool roles)
{
  std::map<int, Group> groups;
  for (const Line& line : lines)
  {
    const int number = key(line);
    Group& group = groups.emplace(number, Group{ {}, number, roles ? number : -1 }).first->second;
    group.lines.push_back(&line);
  }
  std::vector<Group> result;
  for (const auto& entry : groups)
  {
    result.push_back(entry.second);
  }
  return result;
}

/// The sides that the lines are, three or four; empty where they are pieces of a loop or of chains.
std::vector<Group> find_sides(const std::vector<Line>& lines)
{
  const bool all_roles =
    std::all_of(lines.begin(), lines.end(), [](const Line& line) { return line.role >= 0; });
  const auto is_number_of_sides = [](std::size_t count) { return count == 3 || count == 4; };
  if (is_number_of_sides(lines.size()))
  {
    std::vector<Group> groups;
    for (const Line& line : lines)
    {
      groups.push_back({ { &line }, static_cast<int>(groups.size()), line.role });
    }
    return groups;
  }
  if (all_roles)
  {
    return group_by(lines, [](const Line& line) { return line.role; }, true);
  }
  std::vector<Group> groups = group_by(lines, [](const Line& line) { return line.input; }, false);
  return is_number_of_sides(groups.size()) ? groups : std::vector<Group>();
}

Boundary assemble(const std::vector<Group>& groups, const BoundaryOptions& options)
{
  std::vector<Points> polylines;
  std::vector<int> roles;
  for (const Group& group : groups)
  {
    polylines.push_back(chained_side(group, options));
    roles.push_back(group.role);
  }
  Boundary boundary = assemble_sides(polylines, roles, options);
  for (SideReport& report : boundary.reports)
  {
    if (report.input >= 0)
    {
      report.input = groups[static_cast<std::size_t>(report.input)].number;
    }
  }
  return boundary;
}

/// Corners by points of the data become corners by points of the loop, which is turned around where
/// they run against it.
Boundary split(Points loop, const std::array<int, 4>& corner_ids, vtkPolyData* data,
  BoundaryOptions options)
{
  if (std::all_of(corner_ids.begin(), corner_ids.end(), [](int id) { return id < 0; }))
  {
    return split_loop(loop, options);
  }
  std::array<int, 4> at{};
  for (std::size_t k = 0; k < 4; ++k)
  {
    const std::string name = "CornerIds[" + std::to_string(k) + "] = " +
      std::to_string(corner_ids[k]);
    if (corner_ids[k] < 0 || corner_ids[k] >= data->GetNumberOfPoints())
    {
      throw BoundaryError(BoundaryDefect::Corners,
        name + " is no point; there are " + std::to_string(data->GetNumberOfPoints()));
    }
    Vector3 corner;
    data->GetPoint(corner_ids[k], corner.data());
    Eigen::Index index;
    const double off = (loop.colwise() - corner).colwise().norm().minCoeff(&index);
    const double size = (loop.rowwise().maxCoeff() - loop.rowwise().minCoeff()).norm();
    if (!(off <= options.merge_tolerance * size))
    {
      throw BoundaryError(BoundaryDefect::Corners,
        name + " is not on the loop, but " + vtkVariant(off).ToString() + " from its nearest point");
    }
    at[k] = static_cast<int>(index);
  }
  int descents = 0;
  for (std::size_t k = 0; k < 4; ++k)
  {
    descents += at[(k + 1) % 4] < at[k] ? 1 : 0;
  }
  if (descents == 3)
  {
    loop = loop.rowwise().reverse().eval();
    for (int& index : at)
    {
      index = static_cast<int>(loop.cols()) - 1 - index;
    }
  }
  options.corner_ids.assign(at.begin(), at.end());
  return split_loop(loop, options);
}

} // namespace

std::vector<Line> read_lines(const std::vector<vtkPolyData*>& inputs)
{
  std::vector<Line> lines;
  int number = 0;
  for (vtkPolyData* input : inputs)
  {
    vtkDataArray* roles = input->GetCellData()->GetArray("BoundaryRole");
    vtkIdType cell = input->GetNumberOfVerts(); // cell data of vertices comes before that of lines
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < input->GetNumberOfLines(); ++i, ++cell)
    {
      input->GetLines()->GetCellAtId(i, ids);
      if (ids->GetNumberOfIds() == 0)
      {
        continue;
      }
      Line line;
      line.role = read_role(roles, cell);
      line.input = number;
      line.points.resize(3, ids->GetNumberOfIds());
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        input->GetPoint(ids->GetId(k), line.points.col(k).data());
      }
      lines.push_back(std::move(line));
    }
    ++number;
  }
  return lines;
}

Boundary read_boundary(const std::vector<vtkPolyData*>& inputs,
  const std::array<int, 4>& corner_ids, const BoundaryOptions& options)
{
  const std::vector<Line> lines = read_lines(inputs);
  if (lines.empty())
  {
    throw BoundaryError(BoundaryDefect::Count, "the input has no lines; a boundary is needed");
  }
  const std::vector<Group> sides = find_sides(lines);
  if (!sides.empty())
  {
    return assemble(sides, options);
  }
  if (lines.size() == 1)
  {
    return split(lines.front().points, corner_ids, inputs[lines.front().input], options);
  }
  std::vector<const Line*> pieces;
  for (const Line& line : lines)
  {
    pieces.push_back(&line);
  }
  const Chains chains = chain(pieces, options);
  if (chains.loops.size() == 1 && chains.open.empty())
  {
    return split(chains.loops.front(), corner_ids, inputs.front(), options);
  }
  if (chains.loops.empty() && (chains.open.size() == 3 || chains.open.size() == 4))
  {
    return assemble_sides(chains.open, {}, options);
  }
  throw BoundaryError(BoundaryDefect::Loops,
    "the " + std::to_string(lines.size()) + " lines make " + describe(chains) +
      "; one closed loop, or three or four chains, are needed");
}

} // namespace footpoint::conversion
