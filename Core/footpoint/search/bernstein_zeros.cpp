// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/bernstein_zeros.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{
namespace
{

/// Cells that one system, and all systems of one query, may look at. Simple zeros take some tens,
/// zeros that are double up to rounding some hundreds.
constexpr int kMostCellsOfSystem = 4000;
constexpr int kMostCells = 40000;

/// Halvings, more than there are digits in both directions.
constexpr int kMostHalvings = 110;

/// Every so many halvings a cell is asked whether it lies on a continuum of zeros: by then a side
/// is a sixteenth, so that few cells lie along it, and few others are left.
constexpr int kAsk = 8;

/// The Jacobian in the middle of a cell is inverted where its determinant is more than this part of
/// the product of its rows.
constexpr double kInvertible = 1e-8;

/// How far from the unit matrix the Jacobian of the combined forms may be. Below 1 there is one
/// zero at most; some way below it Newton's method converges fast.
constexpr double kContraction = 0.75;

/// How far outside its cell, in units of the cell, a zero is still taken: on a border it may seem
/// outside of both its cells by rounding.
constexpr double kOutside = 1e-9;

constexpr int kMostIterations = 40;
constexpr int kMostDegree = 127;

/// Values of all Bernstein polynomials of a degree, and their derivatives.
struct Basis
{
  std::array<double, kMostDegree + 1> value;
  std::array<double, kMostDegree + 1> slope;

  Basis(int degree, double t)
  {
    this->value[0] = 1.0;
    this->slope[0] = 0.0;
    for (int n = 1; n <= degree; ++n)
    {
      if (n == degree)
      {
        for (int k = 0; k <= n; ++k)
        {
          const double before = k > 0 ? this->value[k - 1] : 0.0;
          this->slope[k] = n * (before - (k < n ? this->value[k] : 0.0));
        }
      }
      double before = 0.0;
      for (int k = 0; k < n; ++k)
      {
        const double value_k = this->value[k];
        this->value[k] = before + (1.0 - t) * value_k;
        before = t * value_k;
      }
      this->value[n] = before;
    }
  }
};

/// Value and derivatives of a form.
std::array<double, 3> evaluate(
  const std::array<int, 2>& degree, const double* form, const Basis& u, const Basis& v)
{
  std::array<double, 3> result{ { 0.0, 0.0, 0.0 } };
  for (int i = 0; i <= degree[0]; ++i)
  {
    double value = 0.0;
    double slope = 0.0;
    for (int j = 0; j <= degree[1]; ++j, ++form)
    {
      value += *form * v.value[j];
      slope += *form * v.slope[j];
    }
    result[0] += value * u.value[i];
    result[1] += value * u.slope[i];
    result[2] += slope * u.value[i];
  }
  return result;
}

/// The coefficients over both halves (de Casteljau 1959).
void halve(const std::array<int, 2>& degree, const double* form, int direction, double* first,
  double* second)
{
  const int columns = degree[1] + 1;
  const int size = (degree[0] + 1) * columns;
  const int n = degree[direction];
  const int step = direction == 0 ? columns : 1;
  const int lines = size / (n + 1);
  std::copy(form, form + size, second);
  for (int line = 0; line < lines; ++line)
  {
    const int begin = direction == 0 ? line : line * columns;
    double* half = second + begin;
    for (int k = 0; k <= n; ++k)
    {
      first[begin + k * step] = half[0];
      for (int i = 0; i < n - k; ++i)
      {
        half[i * step] = 0.5 * (half[i * step] + half[(i + 1) * step]);
      }
    }
  }
}

struct Interval
{
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void add(double value)
  {
    this->lower = std::min(this->lower, value);
    this->upper = std::max(this->upper, value);
  }
  double magnitude() const { return std::max(std::abs(this->lower), std::abs(this->upper)); }
  /// The largest distance from a number.
  double from(double value) const
  {
    return std::max(std::abs(this->lower - value), std::abs(this->upper - value));
  }
};

Interval range(const double* form, int size)
{
  Interval result;
  for (int k = 0; k < size; ++k)
  {
    result.add(form[k]);
  }
  return result;
}

/// Range of the derivative along a direction.
Interval slopes(const std::array<int, 2>& degree, const double* form, int direction)
{
  const int columns = degree[1] + 1;
  const int step = direction == 0 ? columns : 1;
  const int rows = direction == 0 ? degree[0] : degree[0] + 1;
  const int width = direction == 0 ? columns : degree[1];
  Interval result;
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < width; ++j)
    {
      const double* at = form + i * columns + j;
      result.add(degree[direction] * (at[step] - at[0]));
    }
  }
  return result;
}

using Matrix = std::array<std::array<double, 2>, 2>;

double determinant(const Matrix& a)
{
  return a[0][0] * a[1][1] - a[0][1] * a[1][0];
}

} // namespace

/// What one look at a cell finds.
struct BernsteinZeros::Look
{
  enum class Verdict
  {
    Empty,
    Simple,        ///< one zero, in `at`
    Vanishes,      ///< all equations, over the whole cell
    VanishesAlong, ///< the equation of `direction`
    Open
  };

  const BernsteinSystem& System;
  const Cell& Of;
  const double* Forms;
  std::vector<double>& Combined;
  std::array<int, 2> Variables{ { 0, 1 } }; ///< that occur
  int Count = 0;
  std::array<double, 2> Margin{ { 0.0, 0.0 } };
  std::array<double, 2> At{ { 0.5, 0.5 } }; ///< in the cell
  Matrix Jacobian{};
  int Direction = 0; ///< to halve, or in which nothing changes

  Look(const BernsteinSystem& system, const Cell& cell, const double* forms,
    std::vector<double>& combined)
    : System(system)
    , Of(cell)
    , Forms(forms)
    , Combined(combined)
  {
    for (int i = 0; i < 2; ++i)
    {
      if (system.degree[i] > 0)
      {
        this->Variables[this->Count++] = i;
      }
      this->Margin[i] = system.margin[i] + cell.error[i];
    }
  }

  const double* form(int equation) const { return this->Forms + equation * this->System.size(); }

  Verdict decide();
  /// Whether the function whose gradient this is has a negative second derivative everywhere.
  bool concave() const;
  /// The mean of the differences between corners.
  double slope_of_corners(int equation, int variable) const;
  /// The inverse of the Jacobian; for two equations of one variable its projection, and across it.
  bool invert(Matrix& inverse) const;
  Verdict combine(const Matrix& inverse);
  Verdict newton(const std::array<double, 2>& margin);
  void choose_direction();
  /// Whether all equations vanish on one end of a direction.
  bool vanishes_on_side(int direction) const;
};

double BernsteinZeros::Look::slope_of_corners(int equation, int variable) const
{
  const std::array<int, 2>& degree = this->System.degree;
  const int last_row = degree[0] * (degree[1] + 1);
  const double* f = this->form(equation);
  if (variable == 0)
  {
    return 0.5 * ((f[last_row] - f[0]) + (f[last_row + degree[1]] - f[degree[1]]));
  }
  return 0.5 * ((f[degree[1]] - f[0]) + (f[last_row + degree[1]] - f[last_row]));
}

bool BernsteinZeros::Look::invert(Matrix& inverse) const
{
  inverse = {};
  if (this->Count == 1)
  {
    const int variable = this->Variables[0];
    const double a = this->slope_of_corners(0, variable);
    const double b = this->System.equations == 2 ? this->slope_of_corners(1, variable) : 0.0;
    const double length = std::hypot(a, b);
    if (!(length > std::numeric_limits<double>::min()))
    {
      return false;
    }
    inverse[0] = { { a / length / length, b / length / length } };
    inverse[1] = { { -b / length, a / length } };
    return std::isfinite(inverse[0][0]) && std::isfinite(inverse[0][1]);
  }
  const Matrix a{ { { { this->slope_of_corners(0, 0), this->slope_of_corners(0, 1) } },
    { { this->slope_of_corners(1, 0), this->slope_of_corners(1, 1) } } } };
  const double det = determinant(a);
  const double rows = std::hypot(a[0][0], a[0][1]) * std::hypot(a[1][0], a[1][1]);
  if (!(std::abs(det) > kInvertible * rows) || !(rows > std::numeric_limits<double>::min()))
  {
    return false;
  }
  inverse = { { { { a[1][1] / det, -a[0][1] / det } }, { { -a[1][0] / det, a[0][0] / det } } } };
  return true;
}

BernsteinZeros::Look::Verdict BernsteinZeros::Look::decide()
{
  const int size = this->System.size();
  std::array<bool, 2> vanishes{ { true, true } };
  for (int k = 0; k < this->System.equations; ++k)
  {
    const Interval values = range(this->form(k), size);
    if (values.lower > this->Margin[k] || values.upper < -this->Margin[k])
    {
      return Verdict::Empty;
    }
    vanishes[k] = values.magnitude() <= this->Margin[k];
  }
  if (vanishes[0] && vanishes[1])
  {
    return Verdict::Vanishes;
  }
  if (this->System.minima && this->concave())
  {
    return Verdict::Empty;
  }
  if (this->System.gradient && this->Count == 2 && (vanishes[0] || vanishes[1]))
  {
    this->Direction = vanishes[0] ? 0 : 1;
    return Verdict::VanishesAlong;
  }
  Matrix inverse;
  if (this->invert(inverse))
  {
    const Verdict verdict = this->combine(inverse);
    if (verdict != Verdict::Open)
    {
      return verdict;
    }
  }
  this->choose_direction();
  return Verdict::Open;
}

bool BernsteinZeros::Look::concave() const
{
  for (int k = 0; k < this->System.equations; ++k)
  {
    const int variable = this->Variables[k];
    const double error = 2.0 * this->System.degree[variable] * this->Margin[k];
    if (slopes(this->System.degree, this->form(k), variable).upper < -error)
    {
      return true;
    }
  }
  return false;
}

BernsteinZeros::Look::Verdict BernsteinZeros::Look::combine(const Matrix& inverse)
{
  const int size = this->System.size();
  const int equations = this->System.equations;
  this->Combined.resize(2 * size);
  std::array<double, 2> margin{ { 0.0, 0.0 } };
  for (int k = 0; k < equations; ++k)
  {
    double* to = this->Combined.data() + k * size;
    std::fill(to, to + size, 0.0);
    for (int l = 0; l < equations; ++l)
    {
      const double factor = inverse[k][l];
      margin[k] += std::abs(factor) * this->Margin[l];
      const double* from = this->form(l);
      for (int i = 0; i < size; ++i)
      {
        to[i] += factor * from[i];
      }
    }
    const Interval values = range(to, size);
    if (values.lower > margin[k] || values.upper < -margin[k])
    {
      return Verdict::Empty;
    }
  }
  for (int k = 0; k < this->Count; ++k)
  {
    double distance = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      const int variable = this->Variables[i];
      const Interval slope =
        slopes(this->System.degree, this->Combined.data() + k * size, variable);
      distance += slope.from(k == i ? 1.0 : 0.0) + 2.0 * this->System.degree[variable] * margin[k];
    }
    if (!(distance <= kContraction))
    {
      return Verdict::Open;
    }
  }
  return this->newton(margin);
}

BernsteinZeros::Look::Verdict BernsteinZeros::Look::newton(const std::array<double, 2>& margin)
{
  const int size = this->System.size();
  std::array<double, 2> at{ { 0.5, 0.5 } };
  double last = std::numeric_limits<double>::infinity();
  bool converged = false;
  for (int iteration = 0; iteration < kMostIterations && !converged; ++iteration)
  {
    const Basis u(this->System.degree[0], at[0]);
    const Basis v(this->System.degree[1], at[1]);
    std::array<std::array<double, 3>, 2> f{};
    for (int k = 0; k < this->Count; ++k)
    {
      f[k] = evaluate(this->System.degree, this->Combined.data() + k * size, u, v);
    }
    std::array<double, 2> step{ { 0.0, 0.0 } };
    if (this->Count == 1)
    {
      const int variable = this->Variables[0];
      step[variable] = -f[0][0] / f[0][1 + variable];
    }
    else
    {
      const double det = f[0][1] * f[1][2] - f[0][2] * f[1][1];
      step[0] = -(f[0][0] * f[1][2] - f[1][0] * f[0][2]) / det;
      step[1] = -(f[0][1] * f[1][0] - f[1][1] * f[0][0]) / det;
    }
    const double length = std::max(std::abs(step[0]), std::abs(step[1]));
    // The last digits are noise where the steps no longer shrink.
    converged = length <= 1e-15 || (length <= kOutside && length >= 0.5 * last);
    last = length;
    for (int i = 0; i < 2; ++i)
    {
      at[i] = std::min(std::max(at[i] + step[i], -0.5), 1.5);
    }
  }
  if (!converged)
  {
    this->choose_direction();
    return Verdict::Open;
  }
  for (int k = 0; k < this->Count; ++k)
  {
    double& t = at[this->Variables[k]];
    const double outside = kOutside + 2.0 * margin[k];
    if (!(t >= -outside && t <= 1.0 + outside))
    {
      this->choose_direction();
      return Verdict::Open; // the halves will say that there is nothing
    }
    t = std::min(std::max(t, 0.0), 1.0);
  }
  const Basis u(this->System.degree[0], at[0]);
  const Basis v(this->System.degree[1], at[1]);
  for (int k = 0; k < this->System.equations; ++k)
  {
    const std::array<double, 3> f = evaluate(this->System.degree, this->form(k), u, v);
    this->Jacobian[k] = { { f[1], f[2] } };
  }
  if (this->System.equations > this->Count)
  {
    const auto across = evaluate(this->System.degree, this->Combined.data() + size, u, v);
    if (std::abs(across[0]) > margin[1])
    {
      return Verdict::Empty;
    }
  }
  this->At = at;
  return Verdict::Simple;
}

/// The direction along which the forms change more; at a tie that in which the cell is wider.
void BernsteinZeros::Look::choose_direction()
{
  this->Direction = this->Variables[0];
  if (this->Count < 2)
  {
    return;
  }
  // A side of zeros (a pole) is approached; cuts across it would only multiply the cells along it.
  const bool on_side = this->vanishes_on_side(0);
  if (on_side != this->vanishes_on_side(1))
  {
    this->Direction = on_side ? 0 : 1;
    return;
  }
  std::array<double, 2> change{ { 0.0, 0.0 } };
  for (int k = 0; k < this->System.equations; ++k)
  {
    for (int i = 0; i < 2; ++i)
    {
      const double slope = slopes(this->System.degree, this->form(k), i).magnitude();
      change[i] = std::max(change[i], slope);
    }
  }
  const double width = this->Of.upper[0] - this->Of.lower[0];
  const double height = this->Of.upper[1] - this->Of.lower[1];
  const bool tie = std::abs(change[0] - change[1]) <= 0.01 * std::max(change[0], change[1]);
  this->Direction = tie ? (height > width ? 1 : 0) : (change[1] > change[0] ? 1 : 0);
}

bool BernsteinZeros::Look::vanishes_on_side(int direction) const
{
  const std::array<int, 2>& degree = this->System.degree;
  const int columns = degree[1] + 1;
  const int step = direction == 0 ? 1 : columns;
  const int last = degree[direction] * (direction == 0 ? columns : 1);
  std::array<bool, 2> vanishes{ { true, true } };
  for (int k = 0; k < this->System.equations; ++k)
  {
    for (int end = 0; end < 2; ++end)
    {
      const double* side = this->form(k) + (end == 0 ? 0 : last);
      for (int i = 0; i <= degree[1 - direction] && vanishes[end]; ++i)
      {
        vanishes[end] = std::abs(side[i * step]) <= this->Margin[k];
      }
    }
  }
  return vanishes[0] || vanishes[1];
}

void BernsteinZeros::find(const BernsteinSystem& system, const Visit& visit)
{
  this->Cells.assign(1, { { { 0.0, 0.0 } }, { { 1.0, 1.0 } }, { { 0.0, 0.0 } }, 0 });
  this->Forms.clear();
  for (int k = 0; k < system.equations; ++k)
  {
    this->Forms.insert(this->Forms.end(), system.forms[k].begin(), system.forms[k].end());
  }
  this->descend(system, visit);
}

void BernsteinZeros::descend(const BernsteinSystem& system, const Visit& visit)
{
  const int size = system.size();
  const int stride = system.equations * size;
  int looked = 0;
  while (!this->Cells.empty())
  {
    this->Next.clear();
    this->NextForms.clear();
    for (std::size_t c = 0; c < this->Cells.size(); ++c)
    {
      const Cell& cell = this->Cells[c];
      const double* forms = this->Forms.data() + c * stride;
      Look look(system, cell, forms, this->Combined);
      const bool over =
        ++looked > kMostCellsOfSystem || ++this->Looked > kMostCells || cell.depth >= kMostHalvings;
      const Look::Verdict verdict = look.decide();
      if (verdict == Look::Verdict::Empty)
      {
        continue;
      }
      if (verdict == Look::Verdict::VanishesAlong && !over)
      {
        this->find_on_side(system, cell, forms, look.Direction, visit);
        continue;
      }
      const bool simple = verdict == Look::Verdict::Simple;
      const bool whole = verdict == Look::Verdict::Vanishes;
      const bool ask = cell.depth > 0 && cell.depth % kAsk == 0;
      if (simple || whole || over || ask)
      {
        BernsteinZero zero{ {}, cell.lower, cell.upper, simple, look.Jacobian };
        for (int i = 0; i < 2; ++i)
        {
          // Of a continuum the lowest parameter.
          const double t = whole ? 0.0 : look.At[i];
          const double at = cell.lower[i] + t * (cell.upper[i] - cell.lower[i]);
          zero.at[i] = t == 1.0 ? cell.upper[i] : at;
          zero.at[i] = system.degree[i] > 0 ? zero.at[i] : 0.0;
        }
        const bool settled = visit(zero);
        if (simple || whole || over || settled)
        {
          continue;
        }
      }
      const int direction = look.Direction;
      const std::size_t begin = this->NextForms.size();
      this->NextForms.resize(begin + 2 * stride);
      std::array<double, 2> error = cell.error;
      for (int k = 0; k < system.equations; ++k)
      {
        const double* from = forms + k * size;
        double* first = this->NextForms.data() + begin + k * size;
        halve(system.degree, from, direction, first, first + stride);
        error[k] += (system.degree[direction] + 1) * 0x1p-53 * range(from, size).magnitude();
      }
      const double middle = 0.5 * (cell.lower[direction] + cell.upper[direction]);
      for (int end = 0; end < 2; ++end)
      {
        Cell half{ cell.lower, cell.upper, error, cell.depth + 1 };
        (end == 0 ? half.upper : half.lower)[direction] = middle;
        this->Next.push_back(half);
      }
    }
    std::swap(this->Cells, this->Next);
    std::swap(this->Forms, this->NextForms);
  }
}

void BernsteinZeros::find_on_side(const BernsteinSystem& system, const Cell& cell,
  const double* forms, int direction, const Visit& visit)
{
  const int other = 1 - direction;
  const int columns = system.degree[1] + 1;
  BernsteinSystem side;
  side.minima = system.minima;
  side.degree[other] = system.degree[other];
  side.margin[0] = system.margin[other] + cell.error[other];
  for (int k = 0; k <= system.degree[other]; ++k)
  {
    side.forms[0].push_back(forms[other * system.size() + k * (other == 0 ? columns : 1)]);
  }
  BernsteinZeros search;
  search.Looked = this->Looked;
  search.find(side,
    [&](const BernsteinZero& zero)
    {
      BernsteinZero lifted{ cell.lower, cell.lower, cell.upper, false, {} };
      const double width = cell.upper[other] - cell.lower[other];
      lifted.at[other] += zero.at[other] * width;
      lifted.lower[other] += zero.lower[other] * width;
      lifted.upper[other] = cell.lower[other] + zero.upper[other] * width;
      return visit(lifted);
    });
  this->Looked = search.Looked;
}

} // namespace footpoint
