// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/winslow_equations.h"

#include <algorithm>
#include <limits>

namespace footpoint
{
namespace
{

/// Keeps the Picard matrix regular where a folded grid has no derivatives; relative to the mean
/// weight.
constexpr double kLeastWeight = 1e-6;

constexpr int kSmallBlock = 4; ///< points along a block that is no longer dissected

/// Nested dissection (A. George 1973) of a rectangle of grid points: halves first, the line between
/// last.
void dissect(int i0, int i1, int j0, int j1, int stride, std::vector<Eigen::Index>& order)
{
  const bool wide = i1 - i0 >= j1 - j0;
  if (std::max(i1 - i0, j1 - j0) <= kSmallBlock)
  {
    for (int j = j0; j < j1; ++j)
    {
      for (int i = i0; i < i1; ++i)
      {
        order.push_back(i + Eigen::Index(stride) * j);
      }
    }
    return;
  }
  const int middle = wide ? (i0 + i1) / 2 : (j0 + j1) / 2;
  if (wide)
  {
    dissect(i0, middle, j0, j1, stride, order);
    dissect(middle + 1, i1, j0, j1, stride, order);
    dissect(middle, middle + 1, j0, j1, stride, order);
  }
  else
  {
    dissect(i0, i1, j0, middle, stride, order);
    dissect(i0, i1, middle + 1, j1, stride, order);
    dissect(i0, i1, middle, middle + 1, stride, order);
  }
}

/// −r'·r'' / r'² at the inner points of a line, its ends as their neighbours.
Eigen::VectorXd line_control(const Points& line)
{
  const Eigen::Index count = line.cols();
  Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 1; k + 1 < count; ++k)
  {
    const Vector3 first = 0.5 * (line.col(k + 1) - line.col(k - 1));
    const Vector3 second = line.col(k + 1) - 2.0 * line.col(k) + line.col(k - 1);
    const double speed = first.squaredNorm();
    result(k) = speed > 0.0 ? -first.dot(second) / speed : 0.0;
  }
  if (count > 2)
  {
    result(0) = result(1);
    result(count - 1) = result(count - 2);
  }
  return result;
}

} // namespace

ControlField thomas_middlecoff(const Grid& grid)
{
  const int nu = grid.count[0];
  const int nv = grid.count[1];
  auto side = [&](Eigen::Index from, Eigen::Index step, Eigen::Index count) -> Points
  { return grid.points(Eigen::all, Eigen::seqN(from, count, step)); };
  const Eigen::VectorXd bottom = line_control(side(0, 1, nu));
  const Eigen::VectorXd top = line_control(side(grid.index(0, nv - 1), 1, nu));
  const Eigen::VectorXd left = line_control(side(0, nu, nv));
  const Eigen::VectorXd right = line_control(side(nu - 1, nu, nv));
  ControlField result;
  result.phi.resize(grid.points.cols());
  result.psi.resize(grid.points.cols());
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const double s = i / double(nu - 1);
      const double t = j / double(nv - 1);
      result.phi(grid.index(i, j)) = (1.0 - t) * bottom(i) + t * top(i);
      result.psi(grid.index(i, j)) = (1.0 - s) * left(j) + s * right(j);
    }
  }
  return result;
}

WinslowEquations::WinslowEquations(
  const std::array<int, 2>& count, ControlField control, bool sliding)
  : Count(count)
  , Control(std::move(control))
  , Number(std::size_t(count[0]) * std::size_t(count[1]), -1)
{
  if (count[0] > 2 && count[1] > 2)
  {
    const int edge = sliding ? 0 : 1;
    dissect(edge, count[0] - edge, edge, count[1] - edge, count[0], this->Unknowns);
  }
  auto is_corner = [&](Eigen::Index point)
  {
    const Eigen::Index i = point % count[0];
    const Eigen::Index j = point / count[0];
    return (i == 0 || i == count[0] - 1) && (j == 0 || j == count[1] - 1);
  };
  this->Unknowns.erase(
    std::remove_if(this->Unknowns.begin(), this->Unknowns.end(), is_corner), this->Unknowns.end());
  for (std::size_t k = 0; k < this->Unknowns.size(); ++k)
  {
    this->Number[std::size_t(this->Unknowns[k])] = int(k);
  }
}

/// Differences at one point. Neighbours are numbered (step in i + 1) + 3 (step in j + 1).
struct WinslowEquations::Stencil
{
  Vector3 a, b, c, d, e; ///< r_ξ, r_η, r_ξξ + φ r_ξ, r_ηη + ψ r_η, r_ξη
  double phi, psi;

  double alpha() const { return this->b.squaredNorm(); }
  double beta() const { return this->a.dot(this->b); }
  double gamma() const { return this->a.squaredNorm(); }
  Vector3 value() const
  {
    return this->alpha() * this->c - 2.0 * this->beta() * this->e + this->gamma() * this->d;
  }

  /// Weight of a neighbour in R with α + least, β and γ + least held.
  double weight(int di, int dj, double least = 0.0) const
  {
    if (di != 0 && dj != 0)
    {
      return -0.5 * di * dj * this->beta();
    }
    if (di != 0)
    {
      return (this->alpha() + least) * (1.0 + 0.5 * di * this->phi);
    }
    if (dj != 0)
    {
      return (this->gamma() + least) * (1.0 + 0.5 * dj * this->psi);
    }
    return -2.0 * (this->alpha() + this->gamma() + 2.0 * least);
  }

  /// Derivative of R by a neighbour.
  Eigen::Matrix3d derivative(int di, int dj) const
  {
    Eigen::Matrix3d result = this->weight(di, dj) * Eigen::Matrix3d::Identity();
    if (dj == 0 && di != 0)
    {
      result += di * (this->d * this->a.transpose() - this->e * this->b.transpose());
    }
    if (di == 0 && dj != 0)
    {
      result += dj * (this->c * this->b.transpose() - this->e * this->a.transpose());
    }
    return result;
  }
};

WinslowEquations::Stencil WinslowEquations::stencil(const Points& points, Eigen::Index point) const
{
  const Eigen::Index n = this->Count[0];
  auto at = [&](int di, int dj) { return points.col(point + di + n * dj); };
  Stencil s;
  s.phi = this->Control.phi.size() > 0 ? this->Control.phi(point) : 0.0;
  s.psi = this->Control.psi.size() > 0 ? this->Control.psi(point) : 0.0;
  s.a = 0.5 * (at(1, 0) - at(-1, 0));
  s.b = 0.5 * (at(0, 1) - at(0, -1));
  s.c = at(1, 0) - 2.0 * at(0, 0) + at(-1, 0) + s.phi * s.a;
  s.d = at(0, 1) - 2.0 * at(0, 0) + at(0, -1) + s.psi * s.b;
  s.e = 0.25 * (at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1));
  return s;
}

/// Of a point of a side: the neighbour off the side; −1 inside.
Eigen::Index WinslowEquations::inner_neighbour(Eigen::Index point) const
{
  const Eigen::Index n = this->Count[0];
  const Eigen::Index i = point % n;
  const Eigen::Index j = point / n;
  return i == 0               ? point + 1
    : i == n - 1              ? point - 1
    : j == 0                  ? point + n
    : j == this->Count[1] - 1 ? point - n
                              : -1;
}

/// What α + γ is in a square of unit size.
double WinslowEquations::side_weight() const
{
  const double across = 1.0 / (this->Count[0] - 1);
  const double along = 1.0 / (this->Count[1] - 1);
  return across * across + along * along;
}

/// 4 r₁ − r₂ − 3 r, weighted.
Vector3 WinslowEquations::side_value(
  const Points& points, Eigen::Index point, Eigen::Index inner) const
{
  return this->side_weight() *
    (4.0 * points.col(inner) - points.col(2 * inner - point) - 3.0 * points.col(point));
}

Eigen::VectorXd WinslowEquations::residual(const Points& points, const Places& places) const
{
  Eigen::VectorXd result(2 * Eigen::Index(this->Unknowns.size()));
  for (std::size_t k = 0; k < this->Unknowns.size(); ++k)
  {
    const Eigen::Index point = this->Unknowns[k];
    const Eigen::Index inner = this->inner_neighbour(point);
    const Eigen::Index at = 2 * Eigen::Index(k);
    if (inner < 0)
    {
      result.segment<2>(at) = places[k].tangents.transpose() * this->stencil(points, point).value();
    }
    else
    {
      result(at) = places[k].side_tangent.dot(this->side_value(points, point, inner));
      result(at + 1) = 0.0;
    }
  }
  return result;
}

double WinslowEquations::rounding(const Points& points) const
{
  double sum = 0.0;
  for (const Eigen::Index point : this->Unknowns)
  {
    if (this->inner_neighbour(point) >= 0)
    {
      continue;
    }
    const Stencil s = this->stencil(points, point);
    const double weights = s.alpha() + s.gamma();
    sum += weights * weights;
  }
  const double size = points.cwiseAbs().maxCoeff();
  return 4.0 * std::numeric_limits<double>::epsilon() * size * std::sqrt(sum);
}

template <class Visit>
void WinslowEquations::for_unknowns_about(Eigen::Index point, const Visit& visit) const
{
  for (int neighbour = 0; neighbour < 9; ++neighbour)
  {
    const int di = neighbour % 3 - 1;
    const int dj = neighbour / 3 - 1;
    const Eigen::Index other = point + di + Eigen::Index(this->Count[0]) * dj;
    const int column = this->Number[std::size_t(other)];
    if (column >= 0)
    {
      visit(column, di, dj);
    }
  }
}

WinslowEquations::Matrix WinslowEquations::picard_matrix(const Points& points) const
{
  double least = 0.0;
  for (const Eigen::Index point : this->Unknowns)
  {
    if (this->inner_neighbour(point) >= 0)
    {
      continue;
    }
    const Stencil s = this->stencil(points, point);
    least += kLeastWeight * (s.alpha() + s.gamma()) / double(this->Unknowns.size());
  }
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(9 * this->Unknowns.size());
  for (std::size_t k = 0; k < this->Unknowns.size(); ++k)
  {
    const Eigen::Index inner = this->inner_neighbour(this->Unknowns[k]);
    if (inner >= 0)
    {
      const double weight = this->side_weight();
      const Eigen::Index second = 2 * inner - this->Unknowns[k];
      entries.emplace_back(int(k), int(k), -3.0 * weight);
      entries.emplace_back(int(k), this->Number[std::size_t(inner)], 4.0 * weight);
      entries.emplace_back(int(k), this->Number[std::size_t(second)], -weight);
      continue;
    }
    const Stencil s = this->stencil(points, this->Unknowns[k]);
    this->for_unknowns_about(this->Unknowns[k],
      [&](int column, int di, int dj)
      { entries.emplace_back(int(k), column, s.weight(di, dj, least)); });
  }
  Matrix result(Eigen::Index(this->Unknowns.size()), Eigen::Index(this->Unknowns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

WinslowEquations::Matrix WinslowEquations::newton_matrix(
  const Points& points, const Places& places, bool held) const
{
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(36 * this->Unknowns.size());
  for (std::size_t k = 0; k < this->Unknowns.size(); ++k)
  {
    const auto& tangents = places[k].tangents;
    const Eigen::Index inner = this->inner_neighbour(this->Unknowns[k]);
    if (inner >= 0)
    {
      const int first = 2 * int(k);
      const double weight = this->side_weight();
      double own = -3.0 * weight * places[k].side_tangent.dot(tangents.col(0));
      if (!held)
      {
        own += places[k].side_turn.dot(this->side_value(points, this->Unknowns[k], inner));
      }
      entries.emplace_back(first, first, own);
      entries.emplace_back(first + 1, first + 1, -weight); // no second direction to step along
      const std::array<std::pair<Eigen::Index, double>, 2> others = { { { inner, 4.0 * weight },
        { 2 * inner - this->Unknowns[k], -weight } } };
      for (const auto& [point, factor] : others)
      {
        const int column = this->Number[std::size_t(point)];
        const Eigen::RowVector2d row =
          factor * places[k].side_tangent.transpose() * places[std::size_t(column)].tangents;
        entries.emplace_back(first, 2 * column, row(0));
        entries.emplace_back(first, 2 * column + 1, row(1));
      }
      continue;
    }
    const Stencil s = this->stencil(points, this->Unknowns[k]);
    const auto add_block = [&](int column, int di, int dj)
    {
      const Eigen::Matrix3d derivative = held
        ? Eigen::Matrix3d(s.weight(di, dj) * Eigen::Matrix3d::Identity())
        : s.derivative(di, dj);
      Eigen::Matrix2d block =
        tangents.transpose() * derivative * places[std::size_t(column)].tangents;
      if (di == 0 && dj == 0 && !held)
      {
        // A step turns the tangents towards the normal, and with them their part of R.
        const Vector3 normal = tangents.col(0).cross(tangents.col(1));
        block += normal.dot(s.value()) * places[k].curvature;
      }
      for (int entry = 0; entry < 4; ++entry)
      {
        entries.emplace_back(
          2 * int(k) + entry / 2, 2 * column + entry % 2, block(entry / 2, entry % 2));
      }
    };
    this->for_unknowns_about(this->Unknowns[k], add_block);
  }
  Matrix result(2 * Eigen::Index(this->Unknowns.size()), 2 * Eigen::Index(this->Unknowns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

} // namespace footpoint
