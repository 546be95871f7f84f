// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/chain_arc.h"

#include "footpoint/splines/binomials.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{

namespace
{

/// Turning points nearer than this (as fractions of an arc) are one, and none where they are so
/// near an end: the coordinate turns by a multiple of the square of it, far below its rounding.
constexpr double kSameTurn = 1e-9;

/// Halvings after which several turning points in one interval are taken for one.
constexpr int kMostHalvings = 32;

/// Steps that suffice for any bracket of doubles in [0, 1].
constexpr int kMostSteps = 200;

double evaluate(const Eigen::VectorXd& coefficients, double t)
{
  // Sums of positive products where the coefficients have one sign: nothing cancels.
  const int degree = static_cast<int>(coefficients.size()) - 1;
  const double s = 1.0 - t;
  double power = 1.0; // C(degree, i)·t^i
  double sum = coefficients[0];
  for (int i = 1; i <= degree; ++i)
  {
    power *= t * (degree - i + 1) / i;
    sum = sum * s + power * coefficients[i];
  }
  return sum;
}

/// The zero of a function with different signs at 0 and 1, by the secant method (Illinois variant,
/// M. Dowell and P. Jarratt 1971) in a bracket that at least halves every few steps.
template <class Function>
double bracketed_zero(const Function& function, double at_zero, double at_one)
{
  double low = 0.0;
  double high = 1.0;
  double below = at_zero;
  double above = at_one;
  int last_side = 0;
  for (int step = 0; step < kMostSteps && high - low > 0.0; ++step)
  {
    const double middle = 0.5 * (low + high);
    double t = low + (high - low) * (below / (below - above));
    if (step % 3 == 2 || !(t > low && t < high))
    {
      t = middle;
    }
    if (!(t > low && t < high))
    {
      break;
    }
    const double value = function(t);
    if (value == 0.0)
    {
      return t;
    }
    if (std::signbit(value) == std::signbit(at_zero))
    {
      low = t;
      below = value;
      above *= last_side == -1 ? 0.5 : 1.0;
      last_side = -1;
    }
    else
    {
      high = t;
      above = value;
      below *= last_side == 1 ? 0.5 : 1.0;
      last_side = 1;
    }
  }
  return 0.5 * (low + high);
}

/// The signs of Bernstein coefficients: how often they change, those within a tolerance left out.
int sign_changes(const Eigen::VectorXd& coefficients, double tolerance)
{
  int changes = 0;
  double last = 0.0;
  for (const double coefficient : coefficients)
  {
    if (std::abs(coefficient) > tolerance)
    {
      changes += last * coefficient < 0.0 ? 1 : 0;
      last = coefficient > 0.0 ? 1.0 : -1.0;
    }
  }
  return changes;
}

/// Adds the sign changes in an interval of a polynomial given by its Bernstein coefficients there
/// (variation diminishing property: none, or exactly one, where the coefficients change their sign
/// so often; J. M. Lane and R. F. Riesenfeld 1981).
void add_turns(Eigen::VectorXd coefficients, double low, double high, double tolerance,
  int halvings, std::vector<double>& turns)
{
  // Where the interval is short the derivative may be larger without turning the coordinate.
  const double negligible = tolerance / (high - low);
  const int changes = sign_changes(coefficients, negligible);
  if (changes == 0)
  {
    return;
  }
  const Eigen::Index last = coefficients.size() - 1;
  if (changes == 1 && coefficients[0] * coefficients[last] < 0.0)
  {
    const double t = bracketed_zero(
      [&](double at) { return evaluate(coefficients, at); }, coefficients[0], coefficients[last]);
    turns.push_back(low + t * (high - low));
    return;
  }
  const double middle = 0.5 * (low + high);
  if (halvings == 0)
  {
    turns.push_back(middle);
    return;
  }
  Eigen::VectorXd left(coefficients.size());
  for (Eigen::Index level = 0; level <= last; ++level)
  {
    left[level] = coefficients[0];
    for (Eigen::Index i = 0; i < last - level; ++i)
    {
      coefficients[i] = 0.5 * (coefficients[i] + coefficients[i + 1]);
    }
  }
  // De Casteljau from the front leaves the right half in place.
  const double at_middle = left[last];
  const bool zero_in_the_middle = std::abs(at_middle) <= negligible;
  add_turns(left, low, middle, tolerance, halvings - 1, turns);
  if (zero_in_the_middle)
  {
    turns.push_back(middle);
  }
  add_turns(coefficients, middle, high, tolerance, halvings - 1, turns);
}

/// Bernstein coefficients of w²·dx/dt, x = coordinate i. Degree p − 1, of rational arcs 2p − 1.
Eigen::VectorXd derivative(const ChainArc& arc, int i)
{
  const auto& control = arc.arc.control;
  const int p = static_cast<int>(control.cols()) - 1;
  const auto weights = control.row(2);
  // Relative to the start: differences of large numbers would drown the derivative.
  Eigen::VectorXd x = (control.row(i).array() - arc.end[0][i] * weights.array()).matrix();
  if (weights.minCoeff() == weights.maxCoeff())
  {
    return p * weights[0] * (x.tail(p) - x.head(p));
  }
  // x'·w − x·w', products of Bernstein polynomials (R. T. Farouki and V. T. Rajan 1988).
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(2 * p);
  const std::vector<double> of_slope = binomials(p - 1);
  const std::vector<double> of_value = binomials(p);
  const std::vector<double> of_product = binomials(2 * p - 1);
  for (int a = 0; a < p; ++a)
  {
    const double slope = p * (x[a + 1] - x[a]);
    const double weight_slope = p * (weights[a + 1] - weights[a]);
    for (int b = 0; b <= p; ++b)
    {
      const double share = of_slope[a] * of_value[b] / of_product[a + b];
      sum[a + b] += share * (slope * weights[b] - weight_slope * x[b]);
    }
  }
  return sum;
}

/// The value of coordinate i at a fraction of the range, less its value at the start.
double from_start(const ChainArc& arc, int i, double t)
{
  const Eigen::VectorXd weights = arc.arc.control.row(2);
  const Eigen::VectorXd x =
    (arc.arc.control.row(i).array() - arc.end[0][i] * arc.arc.control.row(2).array()).matrix();
  return evaluate(x, t) / evaluate(weights, t);
}

} // namespace

ChainArc straight_arc(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  ChainArc arc;
  arc.arc.control.resize(3, 2);
  arc.arc.control << from[0], to[0], from[1], to[1], 1.0, 1.0;
  arc.arc.loop = 0;
  arc.arc.curve = 0;
  arc.arc.closes_gap = false;
  arc.arc.range = { { 0.0, 1.0 } };
  arc.arc.vertex = { { true, true } };
  arc.arc.inside_domain = true;
  arc.end = { { from, to } };
  return arc;
}

void place_end(ChainArc& arc, int which, int i, double at)
{
  auto point = arc.arc.control.col(which == 0 ? 0 : arc.arc.control.cols() - 1);
  point[i] = at * point[2];
  arc.end[which][i] = at;
}

void make_constant(ChainArc& arc, int i, double at)
{
  arc.arc.control.row(i) = at * arc.arc.control.row(2);
  arc.end[0][i] = at;
  arc.end[1][i] = at;
}

void shift(ChainArc& arc, int i, double by)
{
  arc.arc.control.row(i) += by * arc.arc.control.row(2);
  arc.end[0][i] += by;
  arc.end[1][i] += by;
}

bool is_constant(const ChainArc& arc, int i, double rounding)
{
  const auto x = arc.arc.control.row(i).array() / arc.arc.control.row(2).array();
  return ((x - arc.end[0][i]).abs() <= rounding).all();
}

std::vector<ChainArc> cut(const ChainArc& arc, const std::vector<double>& fractions)
{
  std::vector<ChainArc> parts;
  ChainArc rest = arc;
  double before = 0.0;
  for (const double fraction : fractions)
  {
    const double t = (fraction - before) / (1.0 - before);
    const double at = arc.arc.range[0] + fraction * (arc.arc.range[1] - arc.arc.range[0]);
    ChainArc left = rest;
    auto& right = rest.arc.control; // overwritten from the front by de Casteljau's columns
    const Eigen::Index degree = right.cols() - 1;
    for (Eigen::Index level = 1; level <= degree; ++level)
    {
      for (Eigen::Index j = 0; j <= degree - level; ++j)
      {
        right.col(j) = (1.0 - t) * right.col(j) + t * right.col(j + 1);
      }
      left.arc.control.col(level) = right.col(0);
    }
    const Eigen::Vector2d point = right.col(0).head<2>() / right(2, 0);
    left.arc.range[1] = at;
    left.arc.vertex[1] = false;
    left.end[1] = point;
    rest.arc.range[0] = at;
    rest.arc.vertex[0] = false;
    rest.end[0] = point;
    parts.push_back(std::move(left));
    before = fraction;
  }
  parts.push_back(std::move(rest));
  return parts;
}

double fraction_at(const ChainArc& arc, int i, double at)
{
  const double wanted = at - arc.end[0][i];
  const double t = bracketed_zero(
    [&](double s) { return from_start(arc, i, s) - wanted; }, -wanted, arc.end[1][i] - at);
  const double least = std::numeric_limits<double>::epsilon();
  return std::clamp(t, least, 1.0 - least);
}

std::vector<ChainArc> cut_to_monotone(const ChainArc& arc, const TrimPlane& plane)
{
  std::vector<double> turns;
  const auto weights = arc.arc.control.row(2);
  for (int i = 0; i < 2; ++i)
  {
    if (arc.arc.control.cols() == 2 || is_constant(arc, i, plane.rounding(i)))
    {
      continue;
    }
    const double tolerance = plane.rounding(i) * weights.maxCoeff() * weights.maxCoeff();
    add_turns(derivative(arc, i), 0.0, 1.0, tolerance, kMostHalvings, turns);
  }
  std::sort(turns.begin(), turns.end());
  std::vector<double> kept;
  for (const double turn : turns)
  {
    const double before = kept.empty() ? 0.0 : kept.back();
    if (turn - before > kSameTurn && turn < 1.0 - kSameTurn)
    {
      kept.push_back(turn);
    }
  }
  std::vector<ChainArc> parts = cut(arc, kept);
  for (std::size_t k = 0; k + 1 < parts.size(); ++k)
  {
    for (int i = 0; i < 2; ++i)
    {
      const double at = plane.snapped(i, parts[k].end[1][i]);
      place_end(parts[k], 1, i, at);
      place_end(parts[k + 1], 0, i, at);
    }
  }
  return parts;
}

std::vector<ChainArc> cut_at_lines(const ChainArc& arc, const TrimPlane& plane)
{
  struct Crossing
  {
    double fraction;
    std::array<double, 2> line; ///< NaN in the coordinate that is free
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<Crossing> crossings;
  for (int i = 0; i < 2; ++i)
  {
    const auto [low, high] = std::minmax(arc.end[0][i], arc.end[1][i]);
    for (const double line : plane.lines_between(i, low, high))
    {
      Crossing crossing{ fraction_at(arc, i, line), { { none, none } } };
      crossing.line[i] = line;
      crossings.push_back(crossing);
    }
  }
  std::sort(crossings.begin(), crossings.end(),
    [](const Crossing& a, const Crossing& b) { return a.fraction < b.fraction; });
  std::vector<Crossing> merged;
  for (const Crossing& crossing : crossings)
  {
    // Through a corner of the knot lines: one cut for both lines.
    if (!merged.empty() &&
      crossing.fraction - merged.back().fraction <= std::numeric_limits<double>::epsilon())
    {
      for (int i = 0; i < 2; ++i)
      {
        merged.back().line[i] =
          std::isnan(crossing.line[i]) ? merged.back().line[i] : crossing.line[i];
      }
    }
    else
    {
      merged.push_back(crossing);
    }
  }
  std::vector<double> fractions;
  for (const Crossing& crossing : merged)
  {
    fractions.push_back(crossing.fraction);
  }
  std::vector<ChainArc> parts = cut(arc, fractions);
  for (std::size_t k = 0; k + 1 < parts.size(); ++k)
  {
    for (int i = 0; i < 2; ++i)
    {
      const auto [low, high] = std::minmax(parts[k].end[0][i], arc.end[1][i]);
      const double free = std::clamp(plane.snapped(i, parts[k].end[1][i]), low, high);
      const double at = std::isnan(merged[k].line[i]) ? free : merged[k].line[i];
      place_end(parts[k], 1, i, at);
      place_end(parts[k + 1], 0, i, at);
    }
  }
  return parts;
}

} // namespace footpoint
