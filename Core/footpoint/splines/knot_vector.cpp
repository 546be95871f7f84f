// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/knot_vector.h"

#include "footpoint/splines/de_boor.h"
#include "footpoint/splines/validation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace footpoint
{

namespace
{

std::string entry(const std::string& name, const std::vector<double>& knots, std::size_t i)
{
  return name + "[" + std::to_string(i) + "] = " + to_text(knots[i]);
}

void check_counts(int degree, const std::vector<double>& knots, const std::string& name)
{
  if (degree < 1 || degree > kMaximumDegree)
  {
    throw GeometryError(GeometryDefect::Degree,
      name + " has the degree " + std::to_string(degree) + "; it must be 1 to " +
        std::to_string(kMaximumDegree));
  }
  const std::size_t least = 2 * (static_cast<std::size_t>(degree) + 1);
  if (knots.size() < least)
  {
    throw GeometryError(GeometryDefect::Count,
      name + " holds " + std::to_string(knots.size()) + " knots; degree " + std::to_string(degree) +
        " needs at least " + std::to_string(least));
  }
}

void check_order(const std::vector<double>& knots, const std::string& name)
{
  for (std::size_t i = 0; i < knots.size(); ++i)
  {
    if (!std::isfinite(knots[i]))
    {
      throw GeometryError(GeometryDefect::NotFinite, entry(name, knots, i) + " is not finite");
    }
    if (i > 0 && knots[i] < knots[i - 1])
    {
      throw GeometryError(GeometryDefect::Decreasing,
        entry(name, knots, i) + " is smaller than " + entry(name, knots, i - 1));
    }
  }
  if (!std::isfinite(knots.back() - knots.front()))
  {
    throw GeometryError(GeometryDefect::NotFinite,
      entry(name, knots, knots.size() - 1) + " minus " + entry(name, knots, 0) + " is not finite");
  }
}

void check_domain(int degree, const std::vector<double>& knots, const std::string& name)
{
  const std::size_t first = degree;
  const std::size_t last = knots.size() - degree - 1;
  if (!(knots[first] < knots[last]))
  {
    throw GeometryError(GeometryDefect::EmptyDomain,
      "the domain from " + entry(name, knots, first) + " to " + entry(name, knots, last) +
        " is empty");
  }
  const std::size_t allowed = first + 1;
  for (std::size_t begin = 0, end = 0; begin < knots.size(); begin = end)
  {
    while (end < knots.size() && knots[end] == knots[begin])
    {
      ++end;
    }
    if (end - begin > allowed)
    {
      throw GeometryError(GeometryDefect::Multiplicity,
        entry(name, knots, begin) + " is repeated " + std::to_string(end - begin) +
          " times; degree " + std::to_string(degree) + " allows " + std::to_string(allowed));
    }
  }
}

/// One derivative: from coefficients on the basis of degree − 1 to those of `degree`, in place.
/// Piegl and Tiller (1997), equation 2.7: N' = degree · (N_i / (…) − N_{i+1} / (…)).
void differentiate(const double* knots, int span, int degree, double* values)
{
  double saved = 0.0;
  for (int r = 0; r < degree; ++r)
  {
    const double slope = degree * values[r] / (knots[span + 1 + r] - knots[span + 1 - degree + r]);
    values[r] = saved - slope;
    saved = slope;
  }
  values[degree] = saved;
}

} // namespace

KnotVector::KnotVector(int degree, std::vector<double> knots, std::string name)
  : Degree(degree)
  , Knots(std::move(knots))
  , Name(std::move(name))
{
  check_counts(this->Degree, this->Knots, this->Name);
  check_order(this->Knots, this->Name);
  check_domain(this->Degree, this->Knots, this->Name);

  this->Local.reserve(this->Knots.size());
  for (const double knot : this->Knots)
  {
    this->Local.push_back(knot - this->domain_start());
  }

  // Knots that the rounding of the subtraction makes equal are one: evaluation sees them so.
  for (std::size_t i = 0; i < this->Local.size(); ++i)
  {
    const double at = this->Local[i];
    if (at < 0.0 || at > this->length())
    {
      continue;
    }
    if (!this->Distinct.empty() && this->Distinct.back().at == at)
    {
      int& multiplicity = this->Distinct.back().multiplicity;
      multiplicity = std::min(multiplicity + 1, this->Degree + 1);
    }
    else
    {
      this->Distinct.push_back({ at, 1, this->Knots[i] });
    }
  }
}

int KnotVector::find_span(double t, Side side) const
{
  const auto first = this->Local.begin() + this->Degree;
  const auto last = this->Local.begin() + this->number_of_control_points();
  if (!(t > 0.0)) // also NaN
  {
    t = 0.0;
    side = Side::Right;
  }
  else if (t >= *last)
  {
    t = *last;
    side = Side::Left;
  }
  const auto above =
    side == Side::Right ? std::upper_bound(first, last, t) : std::lower_bound(first, last, t);
  return static_cast<int>(above - this->Local.begin()) - 1;
}

void KnotVector::basis(int span, double t, int order, double* values) const
{
  const double* knots = this->Local.data();
  const int count = this->Degree + 1;

  // === The triangle; row k keeps the functions of degree p − k, the seeds of the k-th derivatives
  values[0] = 1.0;
  for (int degree = 0; degree <= this->Degree; ++degree)
  {
    if (degree > 0)
    {
      raise_degree(knots, span, degree, t, values);
    }
    const int k = this->Degree - degree;
    if (k > 0 && k <= order)
    {
      std::copy_n(values, degree + 1, values + k * count);
    }
  }

  // === Differentiate row k k times
  for (int k = 1; k <= order; ++k)
  {
    double* row = values + k * count;
    if (k > this->Degree)
    {
      std::fill_n(row, count, 0.0);
      continue;
    }
    for (int degree = this->Degree - k + 1; degree <= this->Degree; ++degree)
    {
      differentiate(knots, span, degree, row);
    }
  }
}

double KnotVector::greville(int control_point) const
{
  double sum = 0.0;
  for (int i = 1; i <= this->Degree; ++i)
  {
    sum += this->Local[control_point + i];
  }
  return sum / this->Degree;
}

} // namespace footpoint
