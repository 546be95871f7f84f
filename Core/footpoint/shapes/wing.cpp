// SPDX-License-Identifier: BSD-3-Clause
// Sections of the NACA 4-digit series (E. N. Jacobs, K. E. Ward and R. M. Pinkerton, NACA Report
// 460, 1933) as splines: with x = s² the thickness, a polynomial in √x, is one in s.
#include "footpoint/shapes/shape_checks.h"
#include "footpoint/shapes/shapes.h"
#include "footpoint/splines/binomials.h"

#include <array>

namespace footpoint
{

namespace
{

constexpr int kDegree = 8;

/// Coefficients of s⁰ … s⁸.
using Polynomial = std::array<double, kDegree + 1>;

/// The three numbers of a section, as fractions of the chord.
struct Section
{
  double camber;
  double crest; ///< where the camber is largest
  double thickness;
};

Section read_digits(const std::string& digits)
{
  const auto refuse = [&](const char* reason)
  { throw ShapeError("AirfoilDigits = '" + digits + "'; " + reason); };
  if (digits.size() != 4 || digits.find_first_not_of("0123456789") != std::string::npos)
  {
    refuse("four digits are needed, as 2412");
  }
  const auto digit = [&](int i) { return static_cast<double>(digits[i] - '0'); };
  const Section section{ digit(0) / 100.0, digit(1) / 10.0, (10.0 * digit(2) + digit(3)) / 100.0 };
  if (section.thickness == 0.0)
  {
    refuse("the last two, the thickness in % of the chord, must not be 00");
  }
  if (section.camber > 0.0 && section.crest == 0.0)
  {
    refuse("with camber (the first) its place (the second) must not be 0");
  }
  return section;
}

/// Half the thickness over s ≥ 0.
Polynomial half_thickness(const Section& section, bool blunt)
{
  const double t = 5.0 * section.thickness;
  return { { 0.0, 0.2969 * t, -0.1260 * t, 0.0, -0.3516 * t, 0.0, 0.2843 * t, 0.0,
    (blunt ? -0.1015 : -0.1036) * t } };
}

/// The camber line before or behind its crest.
Polynomial camber(const Section& section, bool behind)
{
  const double m = section.camber;
  const double p = section.crest;
  Polynomial line{};
  if (m > 0.0)
  {
    const double factor = behind ? m / ((1.0 - p) * (1.0 - p)) : m / (p * p);
    line[0] = behind ? factor * (1.0 - 2.0 * p) : 0.0;
    line[2] = 2.0 * p * factor;
    line[4] = -factor;
  }
  return line;
}

/// The blossom of a polynomial: the control point of degree 8 that belongs to these knots (L.
/// Ramshaw 1989), by elementary symmetric functions.
double blossom(const Polynomial& polynomial, const double* knots)
{
  Polynomial symmetric{ { 1.0 } };
  for (int j = 0; j < kDegree; ++j)
  {
    for (int k = j + 1; k > 0; --k)
    {
      symmetric[k] += knots[j] * symmetric[k - 1];
    }
  }
  double sum = 0.0;
  for (int k = 0; k <= kDegree; ++k)
  {
    sum += polynomial[k] * symmetric[k] / kBinomials.value[kDegree][k];
  }
  return sum;
}

/// A section, or one side of it, of chord 1: rows x and z of control points.
struct SectionSpline
{
  std::vector<double> knots;
  Eigen::Matrix2Xd points;
};

/// The section over s from `start` (−1 or 0) to 1, below where s < 0. \param side of all of it
/// where the start is 0: −1 below, 1 above
SectionSpline section_spline(const Section& section, bool blunt, double start, int side)
{
  // === Knots: the curve is C1 at the nose and at the crest, so they are repeated 7 times
  const double crest = section.camber > 0.0 ? std::sqrt(section.crest) : 0.0;
  std::vector<double> inner;
  if (start < 0.0)
  {
    inner = { 0.0 };
  }
  if (crest > 0.0)
  {
    inner.push_back(crest);
    if (start < 0.0)
    {
      inner.insert(inner.begin(), -crest);
    }
  }
  SectionSpline spline;
  spline.knots.assign(kDegree + 1, start);
  for (const double knot : inner)
  {
    spline.knots.insert(spline.knots.end(), kDegree - 1, knot);
  }
  spline.knots.insert(spline.knots.end(), kDegree + 1, 1.0);

  // === Control points: the knots of each lie in one piece
  const auto count = static_cast<Eigen::Index>(spline.knots.size()) - kDegree - 1;
  spline.points.resize(2, count);
  const Polynomial half = half_thickness(section, blunt);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const double* knots = spline.knots.data() + i + 1;
    const double middle = 0.5 * (knots[0] + knots[kDegree - 1]);
    const bool below = start < 0.0 ? middle < 0.0 : side < 0;
    Polynomial z = camber(section, std::abs(middle) > crest);
    for (int k = 0; k <= kDegree; ++k)
    {
      // Below, s stands for −√x where the section goes round, for √x on one side alone.
      const bool odd_and_mirrored = start < 0.0 && k % 2 == 1;
      z[k] += (below && !odd_and_mirrored ? -1.0 : 1.0) * half[k];
    }
    spline.points(0, i) = blossom({ { 0.0, 0.0, 1.0 } }, knots);
    spline.points(1, i) = blossom(z, knots);
  }
  // The camber line ends at 0; without rounding a closed trailing edge is closed to the bit.
  double end = 0.0;
  for (const double coefficient : half)
  {
    end += coefficient;
  }
  end = blunt ? end : 0.0;
  spline.points(1, count - 1) = start < 0.0 || side > 0 ? end : -end;
  if (start < 0.0)
  {
    spline.points(1, 0) = -end;
  }
  return spline;
}

/// Where sections stand along the span.
class Planform
{
public:
  explicit Planform(const WingOptions& options)
    : Options(options)
  {
  }

  bool kinked() const
  {
    return this->Options.taper_ratio != 1.0 || this->Options.sweep_angle != 0.0;
  }

  /// A point (x, z) of the section of chord 1 at y = η · span / 2.
  Vector3 place(const Eigen::Vector2d& point, double eta) const
  {
    const double to_tip = std::abs(eta);
    const double chord = this->Options.chord * (1.0 - to_tip * (1.0 - this->Options.taper_ratio));
    const double half_span = 0.5 * this->Options.span;
    const double sweep = std::tan(this->Options.sweep_angle * 3.14159265358979323846 / 180.0);
    return { sweep * half_span * to_tip + chord * point[0], eta * half_span, chord * point[1] };
  }

  /// The ruled surface of a section along the span.
  Surface sweep(const KnotVector& knots_u, const Eigen::Matrix2Xd& section) const
  {
    const std::vector<double> stations =
      this->kinked() ? std::vector<double>{ -1, 0, 1 } : std::vector<double>{ -1, 1 };
    std::vector<double> knots_v = stations;
    knots_v.insert(knots_v.begin(), -1.0);
    knots_v.push_back(1.0);
    Points points(3, section.cols() * static_cast<Eigen::Index>(stations.size()));
    Eigen::Index k = 0;
    for (const double eta : stations)
    {
      for (const auto& point : section.colwise())
      {
        points.col(k++) = this->place(point, eta);
      }
    }
    return Surface(knots_u, KnotVector(1, knots_v, "KnotsV"), points);
  }

  /// The plane face between two sides of a section, from `from` (v = 0) to `to` (v = 1).
  Surface tip(const SectionSpline& from, const SectionSpline& to, double eta) const
  {
    const Eigen::Index count = from.points.cols();
    Points points(3, 2 * count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      points.col(i) = this->place(from.points.col(i), eta);
      points.col(count + i) = this->place(to.points.col(i), eta);
    }
    return Surface(KnotVector(kDegree, from.knots, "KnotsU"),
      KnotVector(1, { 0.0, 0.0, 1.0, 1.0 }, "KnotsV"), points);
  }

private:
  const WingOptions& Options;
};

} // namespace

Shape wing(const WingOptions& options)
{
  const Section section = read_digits(options.airfoil_digits);
  check_length("Chord", options.chord);
  check_length("Span", options.span);
  check_range("TaperRatio", options.taper_ratio, 0.01, 100.0);
  check_range("SweepAngle", options.sweep_angle, -80.0, 80.0);

  const bool blunt = options.blunt_trailing_edge;
  const Planform planform(options);
  const SectionSpline around = section_spline(section, blunt, -1.0, 0);
  Shape shape{ { "Wing",
    planform.sweep(KnotVector(kDegree, around.knots, "KnotsU"), around.points) } };
  if (options.capping)
  {
    const SectionSpline below = section_spline(section, blunt, 0.0, -1);
    const SectionSpline above = section_spline(section, blunt, 0.0, 1);
    shape.push_back({ "Right tip", planform.tip(above, below, 1.0) });
    shape.push_back({ "Left tip", planform.tip(below, above, -1.0) });
    if (blunt)
    {
      Eigen::Matrix2d edge;
      edge << around.points.rightCols(1), around.points.leftCols(1);
      shape.push_back(
        { "Trailing edge", planform.sweep(KnotVector(1, { 0.0, 0.0, 1.0, 1.0 }, "KnotsU"), edge) });
    }
  }
  return shape;
}

} // namespace footpoint
