// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/stationary_cells.h"

#include "footpoint/splines/binomials.h"

#include "footpoint/search/bernstein_zeros.h"
#include "footpoint/search/box_traversal.h"
#include "footpoint/search/distance_form-inl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace footpoint
{
namespace
{

constexpr double kRounding = 0x1p-53;

/// A scalar polynomial over a piece in Bernstein form, rows along the first direction.
struct Form
{
  std::array<int, 2> degree;
  std::vector<double> coefficients;

  Form(int degree_u, int degree_v)
    : degree{ { degree_u, degree_v } }
    , coefficients((degree_u + 1) * (degree_v + 1), 0.0)
  {
  }
  int columns() const { return this->degree[1] + 1; }
  double& at(int i, int j) { return this->coefficients[i * this->columns() + j]; }
  double at(int i, int j) const { return this->coefficients[i * this->columns() + j]; }
};

/// Multiplies or divides by the binomial coefficients, which turns a product of polynomials into a
/// convolution of coefficients and back.
void scale(Form& form, bool divide)
{
  const std::vector<double> rows = binomials(form.degree[0]);
  const std::vector<double> columns = binomials(form.degree[1]);
  for (int i = 0; i <= form.degree[0]; ++i)
  {
    for (int j = 0; j <= form.degree[1]; ++j)
    {
      const double factor = rows[i] * columns[j];
      form.at(i, j) = divide ? form.at(i, j) / factor : form.at(i, j) * factor;
    }
  }
}

/// Adds sign × a × b, all scaled.
void add_product(Form& sum, const Form& a, const Form& b, double sign)
{
  for (int i = 0; i <= a.degree[0]; ++i)
  {
    for (int j = 0; j <= a.degree[1]; ++j)
    {
      const double factor = sign * a.at(i, j);
      for (int k = 0; k <= b.degree[0]; ++k)
      {
        for (int l = 0; l <= b.degree[1]; ++l)
        {
          sum.at(i + k, j + l) += factor * b.at(k, l);
        }
      }
    }
  }
}

/// The differences of neighbouring coefficients: the derivative over the degree.
Form difference(const Form& form, int direction)
{
  Form result(form.degree[0] - (direction == 0), form.degree[1] - (direction == 1));
  for (int i = 0; i <= result.degree[0]; ++i)
  {
    for (int j = 0; j <= result.degree[1]; ++j)
    {
      result.at(i, j) = form.at(i + (direction == 0), j + (direction == 1)) - form.at(i, j);
    }
  }
  return result;
}

/// The same polynomial, one degree higher along a direction.
Form elevated(const Form& form, int direction)
{
  const int n = form.degree[direction] + 1;
  Form result(form.degree[0] + (direction == 0), form.degree[1] + (direction == 1));
  for (int i = 0; i <= result.degree[0]; ++i)
  {
    for (int j = 0; j <= result.degree[1]; ++j)
    {
      const int k = direction == 0 ? i : j;
      const double before = k > 0 ? form.at(i - (direction == 0), j - (direction == 1)) : 0.0;
      const double here = k < n ? form.at(i, j) : 0.0;
      result.at(i, j) = (k * before + (n - k) * here) / n;
    }
  }
  return result;
}

struct Range
{
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void add(double value)
  {
    this->lower = std::min(this->lower, value);
    this->upper = std::max(this->upper, value);
  }
};

/// One piece seen from the query.
class PieceOfDistance
{
public:
  PieceOfDistance(const Piece& piece, const Vector3& point)
    : Of(piece)
    , P(point - Vector3(piece.origin[0], piece.origin[1], piece.origin[2]))
    , Away(this->P.lpNorm<1>())
  {
  }

  /// Computes D w² − |P|² w² in Bernstein form, and what its coefficients say: whether the piece
  /// has a point within the limit, and the signs of the derivatives.
  bool reaches(double limit, std::vector<double>& scratch);
  /// 1 or −1 where D rises or falls along the direction, everywhere on the piece; else 0.
  int sign(int direction) const { return this->Signs[direction]; }

  /// The polynomials with the signs of D_u and D_v (curves: of D_v alone, as the first equation).
  BernsteinSystem gradient(const std::vector<double>& scratch) const;

private:
  bool is_curve() const { return this->Of.shape->degree[0] == 0; }
  BernsteinSystem polynomial_gradient(const std::vector<double>& scratch) const;
  BernsteinSystem rational_gradient() const;
  void find_signs(const double* a, const Range& values, double margin);

  const Piece& Of;
  Vector3 P; ///< from the piece's origin
  double Away;
  std::array<int, 2> Signs{ { 0, 0 } };
};

bool PieceOfDistance::reaches(double limit, std::vector<double>& scratch)
{
  const PieceShape& shape = *this->Of.shape;
  const int size = shape.form_size;
  scratch.resize(size);
  double* a = scratch.data();
  HWY_NAMESPACE::distance_form({ &this->Of, 0, { this->P(0), this->P(1), this->P(2) } }, 0.0, a);
  // The error of a coefficient over w², see Documentation/CertifiedSearch.md.
  const double reach = this->Of.reach;
  const double margin = shape.roundings * kRounding * reach * (reach + 4.0 * this->Away);
  Range values; // of D − |P|², the padding repeats the last coefficient of a row
  if (shape.rational)
  {
    const double* w2 = this->Of.forms + 4 * size;
    for (int k = 0; k < size; ++k)
    {
      values.add(a[k] / w2[k]);
    }
  }
  else
  {
    for (int k = 0; k < size; ++k)
    {
      values.add(a[k]);
    }
  }
  const double away = this->P.squaredNorm();
  const double rounding = margin + shape.roundings * kRounding * away;
  if (away + values.lower - rounding > limit * limit)
  {
    return false;
  }
  this->find_signs(a, values, margin);
  return true;
}

/// w² D_u = F_u − (w²)_u (D − T) for F = w² (D − T), T in the middle of the values that D has.
void PieceOfDistance::find_signs(const double* a, const Range& values, double margin)
{
  const PieceShape& shape = *this->Of.shape;
  const double* w2 = shape.rational ? this->Of.forms + 4 * shape.form_size : nullptr;
  const double middle = 0.5 * (values.lower + values.upper);
  const double half = 0.5 * (values.upper - values.lower) + margin;
  const double error = 2.0 * this->Of.greatest_weight *
    (margin + 4.0 * kRounding * (shape.rational ? std::abs(middle) : 0.0));
  for (int direction = this->is_curve() ? 1 : 0; direction < 2; ++direction)
  {
    const int step = direction == 0 ? shape.stride : 1;
    const int rows = direction == 0 ? shape.rows - 1 : shape.rows;
    const int columns = direction == 0 ? shape.columns : shape.columns - 1;
    Range slopes;
    for (int i = 0; i < rows; ++i)
    {
      const double* row = a + i * shape.stride;
      if (!w2)
      {
        for (int j = 0; j < columns; ++j)
        {
          slopes.add(row[j + step] - row[j]);
        }
        continue;
      }
      const double* weights = w2 + i * shape.stride;
      for (int j = 0; j < columns; ++j)
      {
        const double weight = weights[j + step] - weights[j];
        const double slope = row[j + step] - row[j] - middle * weight;
        slopes.add(slope + half * std::abs(weight));
        slopes.add(slope - half * std::abs(weight));
      }
    }
    this->Signs[direction] = slopes.lower > error ? 1 : (slopes.upper < -error ? -1 : 0);
  }
}

BernsteinSystem PieceOfDistance::gradient(const std::vector<double>& scratch) const
{
  return this->Of.shape->rational ? this->rational_gradient() : this->polynomial_gradient(scratch);
}

BernsteinSystem make_system(std::array<Form, 2> derivatives, bool curve, double margin)
{
  BernsteinSystem system;
  system.degree = derivatives[1].degree;
  system.equations = curve ? 1 : 2;
  system.gradient = !curve;
  for (int k = 0; k < system.equations; ++k)
  {
    system.forms[k] = std::move(derivatives[curve ? 1 : k].coefficients);
    system.margin[k] = margin;
  }
  return system;
}

BernsteinSystem PieceOfDistance::polynomial_gradient(const std::vector<double>& scratch) const
{
  const PieceShape& shape = *this->Of.shape;
  Form form(shape.rows - 1, shape.columns - 1);
  for (int i = 0; i < shape.rows; ++i)
  {
    std::copy_n(scratch.data() + i * shape.stride, shape.columns, &form.at(i, 0));
  }
  const double reach = this->Of.reach;
  // Twice that of a coefficient, and the roundings of the elevation.
  const double margin =
    2.0 * (shape.roundings + 8.0) * kRounding * reach * (reach + 4.0 * this->Away);
  const bool curve = this->is_curve();
  return make_system(
    { curve ? form : elevated(difference(form, 0), 0), elevated(difference(form, 1), 1) }, curve,
    margin);
}

/// w³ D_u / 2 = (N − w P)·(N_u w − N w_u).
BernsteinSystem PieceOfDistance::rational_gradient() const
{
  const PieceShape& shape = *this->Of.shape;
  const int p = shape.degree[0];
  const int q = shape.degree[1];
  std::vector<Form> net(4, Form(p, q));
  for (int k = 0; k < (p + 1) * (q + 1); ++k)
  {
    for (int c = 0; c < 4; ++c)
    {
      net[c].coefficients[k] = this->Of.net[4 * k + c];
    }
  }
  std::vector<Form> offset(3, Form(p, q)); // N − w P, scaled
  std::vector<Form> scaled = net;
  for (int c = 0; c < 3; ++c)
  {
    for (std::size_t k = 0; k < offset[c].coefficients.size(); ++k)
    {
      offset[c].coefficients[k] = net[c].coefficients[k] - this->P(c) * net[3].coefficients[k];
    }
    scale(offset[c], false);
  }
  for (Form& form : scaled)
  {
    scale(form, false);
  }
  std::array<Form, 2> result{ { Form(3 * p, 3 * q), Form(3 * p, 3 * q) } };
  for (int direction = this->is_curve() ? 1 : 0; direction < 2; ++direction)
  {
    Form weight_slope = difference(net[3], direction);
    scale(weight_slope, false);
    const int less_u = direction == 0;
    const int less_v = direction == 1;
    Form sum(3 * p - less_u, 3 * q - less_v);
    for (int c = 0; c < 3; ++c)
    {
      Form slope = difference(net[c], direction);
      scale(slope, false);
      Form numerator(2 * p - less_u, 2 * q - less_v);
      add_product(numerator, slope, scaled[3], 1.0);
      add_product(numerator, scaled[c], weight_slope, -1.0);
      add_product(sum, offset[c], numerator, 1.0);
    }
    scale(sum, true);
    result[direction] = elevated(sum, direction);
  }
  // Sums of (p + 1)²(q + 1)² products at most, |N − w P| ≤ w (reach + |P|), and |N_u w − N w_u| ≤
  // 4 w² reach.
  const double terms = (p + 1.0) * (q + 1.0);
  const double weight = this->Of.greatest_weight * std::sqrt(this->Of.greatest_weight);
  const double margin = (8.0 * terms + 64.0) * kRounding * 4.0 * this->Of.reach *
    (this->Of.reach + this->Away) * weight;
  return make_system(std::move(result), this->is_curve(), margin);
}

/// The starts of one query, piece by piece.
class Starts
{
public:
  Starts(const DistanceForms& forms, const StationaryQuery& query, const VisitStart& visit)
    : Forms(forms)
    , Query(query)
    , Visit(visit)
  {
  }

  void look_at(std::int32_t index, double limit);

private:
  void inside(std::int32_t index, const BernsteinSystem& gradient);
  /// A side where the geometry is not smooth: the zeros of the derivative along it.
  void side(std::int32_t index, const BernsteinSystem& gradient, int direction, int end);
  void corner(std::int32_t index, const BernsteinSystem& gradient, const std::array<int, 2>& ends);
  bool is_minimum(const BernsteinZero& zero, const BernsteinSystem& system) const;

  const DistanceForms& Forms;
  const StationaryQuery& Query;
  const VisitStart& Visit;
  BernsteinZeros Zeros;
  std::vector<double> Scratch;
};

void Starts::look_at(std::int32_t index, double limit)
{
  const Piece& piece = this->Forms.pieces()[index];
  if (!std::isfinite(this->Query.point.squaredNorm()))
  {
    this->Visit({ index, { { 0.5, 0.5 } }, { { 0.0, 0.0 } }, { { 1.0, 1.0 } }, false });
    return;
  }
  PieceOfDistance seen(piece, this->Query.point);
  if (!seen.reaches(limit, this->Scratch))
  {
    return;
  }
  const bool curve = piece.shape->degree[0] == 0;
  const bool may_be_inside = seen.sign(1) == 0 && (curve || seen.sign(0) == 0);
  // An end at which D need not rise towards the inside is no minimum.
  auto may_hold = [&](int direction, int end)
  {
    return !this->Query.all_stationary && piece.sides[direction][end] != PieceSide::Smooth &&
      seen.sign(direction) != (end == 0 ? -1 : 1);
  };
  bool any_side = false;
  for (int end = 0; end < 2; ++end)
  {
    any_side = any_side || may_hold(1, end) || (!curve && may_hold(0, end));
  }
  if (!may_be_inside && !any_side)
  {
    return;
  }
  BernsteinSystem gradient = seen.gradient(this->Scratch);
  gradient.minima = !this->Query.all_stationary;
  if (may_be_inside)
  {
    this->inside(index, gradient);
  }
  for (int end = 0; end < 2; ++end)
  {
    for (int direction = 0; direction < 2 && !curve; ++direction)
    {
      if (may_hold(direction, end) && seen.sign(1 - direction) == 0)
      {
        this->side(index, gradient, direction, end);
      }
    }
    for (int other = 0; other < (curve ? 1 : 2); ++other)
    {
      if (may_hold(1, end) && (curve || may_hold(0, other)))
      {
        this->corner(index, gradient, { { other, end } });
      }
    }
  }
}

bool Starts::is_minimum(const BernsteinZero& zero, const BernsteinSystem& system) const
{
  if (!zero.simple)
  {
    return true; // not known
  }
  const auto& a = zero.jacobian;
  if (system.equations == 1)
  {
    return a[0][system.degree[0] > 0 ? 0 : 1] > 0.0;
  }
  return a[0][0] > 0.0 && a[0][0] * a[1][1] - a[0][1] * a[1][0] > 0.0;
}

void Starts::inside(std::int32_t index, const BernsteinSystem& gradient)
{
  this->Zeros.find(gradient,
    [&](const BernsteinZero& zero)
    {
      const bool wanted = this->Query.all_stationary || this->is_minimum(zero, gradient);
      return wanted && this->Visit({ index, zero.at, zero.lower, zero.upper, zero.simple });
    });
}

void Starts::side(std::int32_t index, const BernsteinSystem& gradient, int direction, int end)
{
  const int along = 1 - direction;
  const int columns = gradient.degree[1] + 1;
  const int step = direction == 0 ? 1 : columns;
  const int first = end == 0 ? 0 : gradient.degree[direction] * (direction == 0 ? columns : 1);
  BernsteinSystem side;
  side.minima = true;
  side.degree[along] = gradient.degree[along];
  side.margin[0] = gradient.margin[along];
  const double inward = end == 0 ? 1.0 : -1.0;
  bool rises = false; // somewhere, or stays level
  for (int k = 0; k <= gradient.degree[along]; ++k)
  {
    side.forms[0].push_back(gradient.forms[along][first + k * step]);
    rises =
      rises || inward * gradient.forms[direction][first + k * step] >= -gradient.margin[direction];
  }
  if (!rises)
  {
    return;
  }
  this->Zeros.find(side,
    [&](const BernsteinZero& zero)
    {
      PieceStart start{ index, zero.at, zero.lower, zero.upper, zero.simple };
      start.t[direction] = end;
      start.lower[direction] = end;
      start.upper[direction] = end;
      return this->is_minimum(zero, side) && this->Visit(start);
    });
}

void Starts::corner(
  std::int32_t index, const BernsteinSystem& gradient, const std::array<int, 2>& ends)
{
  const bool curve = gradient.equations == 1;
  const int columns = gradient.degree[1] + 1;
  const int at =
    (ends[0] == 0 ? 0 : gradient.degree[0] * columns) + (ends[1] == 0 ? 0 : gradient.degree[1]);
  for (int k = 0; k < gradient.equations; ++k)
  {
    const double inward = ends[curve ? 1 : k] == 0 ? 1.0 : -1.0;
    if (inward * gradient.forms[k][at] < -gradient.margin[k])
    {
      return;
    }
  }
  const std::array<double, 2> t{ { curve ? 0.0 : ends[0], static_cast<double>(ends[1]) } };
  this->Visit({ index, t, t, t, true });
}

} // namespace

void visit_stationary_starts(const DistanceForms& forms, const BoxTree& tree,
  const StationaryQuery& query, const std::function<double()>& limit, const VisitStart& visit)
{
  Starts starts(forms, query, visit);
  visit_near_boxes(
    tree, query.point, limit, [&](std::int32_t index) { starts.look_at(index, limit()); });
}

} // namespace footpoint
