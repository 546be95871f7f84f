// SPDX-License-Identifier: BSD-3-Clause
#include "BezierCells.h"

#include "FieldArrays.h"
#include "SplineConversion.h"

#include "footpoint/splines/bezier.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>
#include <map>

namespace footpoint::conversion
{

namespace
{

/// A control point: position and weight.
using WeightedPoint = std::array<double, 4>;

/// Corner of a cell in the domain of its face.
using Corner = std::array<double, 2>;

/// The range of a face's parameters.
struct FaceDomain
{
  Corner lower{ { std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() } };
  Corner upper{ { -std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() } };

  void add(int direction, const KnotVector& knots)
  {
    this->lower[direction] = std::min(this->lower[direction], knots.domain_start());
    this->upper[direction] = std::max(this->upper[direction], knots.domain_end());
  }
};

FaceDomain domain_of(const Face& face)
{
  FaceDomain domain;
  for (const Patch& patch : face.patches)
  {
    if (const auto* surface = dynamic_cast<const Surface*>(patch.surface.get()))
    {
      domain.add(0, surface->knots(0));
      domain.add(1, surface->knots(1));
    }
    else if (const auto* curve = dynamic_cast<const Curve*>(patch.curve.get()))
    {
      domain.add(0, curve->knots());
      domain.add(1, curve->knots()); // not used, only a range
    }
    else
    {
      throw GeometryError(
        GeometryDefect::Format, "only NURBS curves and surfaces have Bézier pieces");
    }
  }
  return domain;
}

/// A piece as a cell: control points of one direction after the other, in space.
struct Cell
{
  std::array<int, 2> degree; ///< curves: 0 in v
  std::array<double, 4> range;
  std::vector<WeightedPoint> points; ///< u fastest
};

/// \param geometry what the piece is of; where it is polynomial, weights are 1 without rounding
template <int N, class Geometry>
Cell make_cell(
  const BezierPiece<N>& piece, const std::array<double, 4>& range, const Geometry& geometry)
{
  Cell cell{ { { piece.degree[0], N == 1 ? 0 : piece.degree[N - 1] } }, range, {} };
  for (Eigen::Index i = 0; i < piece.control.cols(); ++i)
  {
    const double weight = geometry.rational() ? piece.control(3, i) : 1.0;
    const Vector3 position = piece.control.template block<3, 1>(0, i) / weight + geometry.centre();
    cell.points.push_back({ { position[0], position[1], position[2], weight } });
  }
  return cell;
}

/// Collects cells and gives equal points of neighbours one number.
class CellCollector
{
public:
  void begin_face(std::size_t id, const Face& face)
  {
    this->FaceId = id;
    this->Domain = domain_of(face);
    this->Corners.clear();
    this->Edges.clear();
  }

  void add(const Cell& cell)
  {
    const int p = cell.degree[0];
    const int q = cell.degree[1];
    // === Corners
    std::vector<vtkIdType> ids(cell.points.size(), -1);
    const auto at = [&](int i, int j) -> std::size_t { return i + (p + 1) * j; };
    const std::array<std::array<double, 2>, 2> lines{ { this->lines(cell.range, 0),
      this->lines(cell.range, 1) } };
    for (int j = 0; j < (q > 0 ? 2 : 1); ++j)
    {
      for (int i = 0; i < 2; ++i)
      {
        const std::size_t point = at(i * p, j * q);
        ids[point] = this->find_corner({ { lines[0][i], lines[1][j] } }, cell.points[point]);
      }
    }
    // === Edges
    if (q > 0)
    {
      for (int side = 0; side < 2; ++side)
      {
        const double u = lines[0][side];
        const double v = lines[1][side];
        this->find_edge({ { lines[0][0], v, lines[0][1], v } }, at(0, side * q), 1, p, cell, ids);
        this->find_edge(
          { { u, lines[1][0], u, lines[1][1] } }, at(side * p, 0), p + 1, q, cell, ids);
      }
    }
    // === Inside
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      if (ids[i] < 0)
      {
        ids[i] = this->insert(cell.points[i]);
      }
    }
    this->Cells.push_back({ this->FaceId, cell.degree, cell.range, std::move(ids) });
  }

  void write(vtkUnstructuredGrid* grid) const;

private:
  struct NumberedCell
  {
    std::size_t face;
    std::array<int, 2> degree;
    std::array<double, 4> range;
    std::vector<vtkIdType> ids; ///< u fastest
  };
  /// Point numbers of an edge, ends included.
  using Edge = std::vector<vtkIdType>;

  /// Both ends of a cell's range in a direction, the end of the domain named as its start unless
  /// the cell is all there is.
  std::array<double, 2> lines(const std::array<double, 4>& range, int direction) const
  {
    const double lower = this->Domain.lower[direction];
    const double upper = this->Domain.upper[direction];
    const double start = range[2 * direction];
    const double end = range[2 * direction + 1];
    const bool whole = start == lower && end == upper;
    return { { start, !whole && end == upper ? lower : end } };
  }

  vtkIdType insert(const WeightedPoint& point)
  {
    this->Points.push_back(point);
    return static_cast<vtkIdType>(this->Points.size()) - 1;
  }

  vtkIdType find_corner(const Corner& corner, const WeightedPoint& point)
  {
    std::vector<vtkIdType>& candidates = this->Corners[corner];
    const auto found = std::find_if(candidates.begin(), candidates.end(),
      [&](vtkIdType id) { return this->Points[id] == point; });
    if (found != candidates.end())
    {
      return *found;
    }
    candidates.push_back(this->insert(point));
    return candidates.back();
  }

  /// Numbers the inner points of an edge as those of a neighbour's edge if all of them are equal;
  /// points that agree one by one may belong to different curves.
  /// \param from, step, degree which points of the cell
  void find_edge(const std::array<double, 4>& ends, std::size_t from, std::size_t step, int degree,
    const Cell& cell, std::vector<vtkIdType>& ids)
  {
    std::vector<Edge>& candidates = this->Edges[ends];
    const auto equal = [&](const Edge& edge)
    {
      bool same = static_cast<int>(edge.size()) == degree + 1 && edge.front() == ids[from] &&
        edge.back() == ids[from + step * degree];
      for (int i = 1; same && i < degree; ++i)
      {
        same = this->Points[edge[i]] == cell.points[from + step * i];
      }
      return same;
    };
    const auto found = std::find_if(candidates.begin(), candidates.end(), equal);
    Edge edge;
    for (int i = 0; i <= degree; ++i)
    {
      vtkIdType& id = ids[from + step * i];
      if (found != candidates.end())
      {
        id = (*found)[i];
      }
      else if (id < 0)
      {
        id = this->insert(cell.points[from + step * i]);
      }
      edge.push_back(id);
    }
    if (found == candidates.end())
    {
      candidates.push_back(std::move(edge));
    }
  }

  std::size_t FaceId = 0;
  FaceDomain Domain;
  std::map<Corner, std::vector<vtkIdType>> Corners;
  std::map<std::array<double, 4>, std::vector<Edge>> Edges;
  std::vector<WeightedPoint> Points;
  std::vector<NumberedCell> Cells;
};

void CellCollector::write(vtkUnstructuredGrid* grid) const
{
  // === Points
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble(); // VTK evaluates Bézier cells of double points alone
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
  std::vector<double> weights;
  vtkIdType number = 0;
  for (const WeightedPoint& point : this->Points)
  {
    points->SetPoint(number++, point.data());
    weights.push_back(point[3]);
  }
  grid->SetPoints(points);
  if (std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 1.0; }))
  {
    set_numbers(grid->GetPointData(), "RationalWeights", weights);
    grid->GetPointData()->SetActiveRationalWeights("RationalWeights");
  }

  // === Cells
  const bool surfaces = std::any_of(this->Cells.begin(), this->Cells.end(),
    [](const NumberedCell& cell) { return cell.degree[1] > 0; });
  const auto count = static_cast<vtkIdType>(this->Cells.size());
  vtkNew<vtkIdTypeArray> faces;
  faces->SetName("FaceId");
  faces->SetNumberOfValues(count);
  vtkNew<vtkDoubleArray> ranges;
  ranges->SetName("ParameterRange");
  ranges->SetNumberOfComponents(surfaces ? 4 : 2);
  ranges->SetNumberOfTuples(count);
  vtkNew<vtkDoubleArray> degrees;
  degrees->SetName("HigherOrderDegrees");
  degrees->SetNumberOfComponents(3); // VTK reads three, also of curves
  degrees->SetNumberOfTuples(count);

  grid->AllocateExact(count, static_cast<vtkIdType>(this->Points.size()));
  std::vector<vtkIdType> ordered;
  number = 0;
  for (const NumberedCell& cell : this->Cells)
  {
    const bool curve = cell.degree[1] == 0;
    const std::vector<int> order =
      curve ? bezier_node_order(cell.degree[0]) : bezier_node_order(cell.degree);
    ordered.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      ordered[order[i]] = cell.ids[i];
    }
    grid->InsertNextCell(curve ? VTK_BEZIER_CURVE : VTK_BEZIER_QUADRILATERAL,
      static_cast<vtkIdType>(ordered.size()), ordered.data());
    faces->SetValue(number, static_cast<vtkIdType>(cell.face));
    ranges->SetTuple(number, cell.range.data());
    degrees->SetTuple3(number, cell.degree[0], cell.degree[1], 0.0);
    ++number;
  }
  vtkCellData* data = grid->GetCellData();
  data->AddArray(faces);
  data->AddArray(ranges);
  data->SetHigherOrderDegrees(degrees);
}

/// Names, orientations and tolerances, by number of the face.
void write_face_attributes(const Model& model, vtkFieldData* data)
{
  std::vector<std::string> names;
  std::vector<int> orientations;
  std::vector<double> tolerances;
  for (const Face& face : model)
  {
    names.push_back(face.name);
    orientations.push_back(face.reversed ? -1 : 1);
    tolerances.push_back(face.tolerance);
  }
  set_values<vtkStringArray>(data, "FaceName", names);
  set_integers(data, "Orientation", orientations);
  set_numbers(data, "Tolerance", tolerances);
}

void add_pieces(const Curve& curve, CellCollector& cells)
{
  const std::vector<DistinctKnot>& knots = curve.knots().distinct_knots();
  std::size_t span = 0;
  for (const BezierPiece<1>& piece : extract_bezier(curve))
  {
    cells.add(
      make_cell(piece, { { knots[span].parameter, knots[span + 1].parameter, 0.0, 0.0 } }, curve));
    ++span;
  }
}

/// \param proceed told the fraction of this surface. \return false where it was cancelled
template <class Proceed>
bool add_pieces(const Surface& surface, const Proceed& proceed, CellCollector& cells)
{
  constexpr std::size_t kBetweenReports = 256;
  const std::vector<DistinctKnot>& u = surface.knots(0).distinct_knots();
  const std::vector<DistinctKnot>& v = surface.knots(1).distinct_knots();
  const SurfacePieces pieces(surface);
  std::size_t number = 0;
  bool going_on = true;
  pieces.for_each(
    [&](const BezierPiece<2>& piece)
    {
      if (number % kBetweenReports == 0)
      {
        going_on = going_on && proceed(static_cast<double>(number) / pieces.size());
      }
      if (going_on)
      {
        const std::size_t i = number % (u.size() - 1);
        const std::size_t j = number / (u.size() - 1);
        cells.add(make_cell(piece,
          { { u[i].parameter, u[i + 1].parameter, v[j].parameter, v[j + 1].parameter } }, surface));
      }
      ++number;
    });
  return going_on;
}

} // namespace

bool write_bezier_cells(
  const Model& model, const std::function<bool(double)>& proceed, vtkUnstructuredGrid* grid)
{
  std::size_t patches = 0;
  for (const Face& face : model)
  {
    patches += face.patches.size();
  }
  CellCollector cells;
  double done = 0.0;
  for (std::size_t id = 0; id < model.size(); ++id)
  {
    cells.begin_face(id, model[id]);
    for (const Patch& patch : model[id].patches)
    {
      const auto part = [&](double fraction) { return proceed((done + fraction) / patches); };
      if (const auto* curve = dynamic_cast<const Curve*>(patch.curve.get()))
      {
        add_pieces(*curve, cells);
      }
      else if (!add_pieces(dynamic_cast<const Surface&>(*patch.surface), part, cells))
      {
        return false;
      }
      done += 1.0;
    }
  }
  cells.write(grid);
  write_face_attributes(model, grid->GetFieldData());
  return true;
}

} // namespace footpoint::conversion
