// SPDX-License-Identifier: BSD-3-Clause

#include "FuzzGeometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace fuzz
{

std::string pick(Random& random, const std::vector<std::string>& words)
{
  return words[random.integer(0, static_cast<int>(words.size()) - 1)];
}

bool one_in(Random& random, int n)
{
  return random.integer(1, n) == 1;
}

namespace
{

/// Index in the net of a pole by its index along direction i and the other one.
Eigen::Index pole(int i, Eigen::Index along, Eigen::Index across, Eigen::Index count_u)
{
  return i == 0 ? across * count_u + along : along * count_u + across;
}

template <int N>
std::array<Eigen::Index, 2> counts(const shapes::Arrays<N>& arrays)
{
  std::array<Eigen::Index, 2> result{ { 1, 1 } };
  for (int i = 0; i < N; ++i)
  {
    result[i] = static_cast<Eigen::Index>(arrays.knots[i].size()) - arrays.degrees[i] - 1;
  }
  return result;
}

// === Knots

/// The same multiplicities with spans between 1e-4 and 1 times as long; multiples of 2^−40.
void squeeze(Random& random, std::vector<double>& knots)
{
  double at = knots.front();
  double before = knots.front();
  for (double& knot : knots)
  {
    if (knot > before)
    {
      const double length = (knot - before) * std::pow(10.0, random.uniform(-4, 0));
      at += std::max(std::round(length * 0x1p40), 1.0) * 0x1p-40;
    }
    before = knot;
    knot = at;
  }
}

/// \return "clamped", "unclamped" or "periodic"
template <int N>
std::string random_direction(Random& random, int i, shapes::Arrays<N>& arrays, std::ostream& text)
{
  int& degree = arrays.degrees[i];
  degree = one_in(random, 2) ? random.integer(1, 9) : random.integer(1, 4);
  const int spans = random.integer(1, N == 1 ? 8 : degree > 4 ? 2 : 4);
  const std::string kind =
    pick(random, { "clamped", "clamped", "clamped", "unclamped", "periodic" });
  std::vector<double>& knots = arrays.knots[i];
  knots = kind == "periodic" ? shapes::uniform_knots(degree, std::max(spans, 2))
                             : shapes::random_knots(random, degree, spans, kind == "clamped");
  text << " degree " << degree << ' ' << kind;
  if (kind != "periodic" && one_in(random, 4))
  {
    squeeze(random, knots);
    text << " with short spans";
  }
  if (one_in(random, 8))
  {
    const double scale = std::ldexp(1.0, random.integer(-20, 20));
    const double shift = one_in(random, 2) ? 1024.0 * scale : 0.0;
    std::for_each(knots.begin(), knots.end(), [&](double& t) { t = t * scale + shift; });
    text << " times " << scale << " plus " << shift;
  }
  return kind;
}

// === Nets

template <int N>
void random_net(Random& random, shapes::Arrays<N>& arrays, std::ostream& text)
{
  const std::array<Eigen::Index, 2> count = counts<N>(arrays);
  const Eigen::Index all = count[0] * count[1];
  arrays.points.resize(3, all);
  const std::string kind = pick(random,
    { "wild", "wild", "sheet", "sheet", "folded", "doubled", "tube", "plane", "repeated poles",
      "symmetric", "thin" });
  const double noise = kind == "sheet" || kind == "tube" ? random.uniform(0.0, 0.4) : 0.2;
  for (Eigen::Index k = 0; k < all; ++k)
  {
    const Vector3 wild = random.vector(-1, 1);
    const double u = static_cast<double>(k % count[0]) / static_cast<double>(count[0]);
    const double v = static_cast<double>(k / count[0]) / static_cast<double>(count[1]);
    const double angle = 2.0 * std::acos(-1.0) * u;
    const Vector3 flat(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0);
    Vector3 point = wild;
    if (kind == "sheet" || kind == "plane" || kind == "repeated poles")
    {
      point = flat + noise * wild;
    }
    else if (kind == "folded" || kind == "doubled") // there and back over the same ground
    {
      point = Vector3(std::abs(flat[0]), flat[1], 0.0) + (kind == "folded" ? noise : 0.0) * wild;
    }
    else if (kind == "tube")
    {
      point = Vector3(std::cos(angle), std::sin(angle), 2.0 * v) + noise * wild;
    }
    else if (kind == "thin")
    {
      point = Vector3(wild[0], 1e-2 * wild[1], 1e-4 * wild[2]);
    }
    if (kind == "plane")
    {
      point[2] = 0.0;
    }
    if (kind == "repeated poles" && k > 0 && one_in(random, 3))
    {
      point = arrays.points.col(k - (k >= count[0] && one_in(random, 2) ? count[0] : 1));
    }
    arrays.points.col(k) = point;
  }
  text << ", " << kind;
  if (kind == "symmetric" || kind == "doubled")
  {
    for (Eigen::Index j = 0; j < count[1]; ++j)
    {
      for (Eigen::Index i = 0; i < count[0] / 2; ++i)
      {
        const Vector3 point = arrays.points.col(j * count[0] + i);
        const Vector3 other(kind == "symmetric" ? -point[0] : point[0], point[1], point[2]);
        arrays.points.col(j * count[0] + count[0] - 1 - i) = other;
      }
    }
  }
}

template <int N>
void random_weights(Random& random, shapes::Arrays<N>& arrays, std::ostream& text)
{
  const std::string kind =
    pick(random, { "no", "no", "no", "any", "any", "one extreme", "two-valued" });
  if (kind == "no")
  {
    return;
  }
  const double decades = one_in(random, 3) ? 3.0 : random.uniform(0.1, 3.0);
  arrays.weights.setOnes(arrays.points.cols());
  for (double& weight : arrays.weights)
  {
    weight = kind == "any"   ? random.magnitude(decades)
      : kind == "two-valued" ? std::pow(10.0, one_in(random, 2) ? decades : -decades)
                             : 1.0;
  }
  if (kind == "one extreme")
  {
    const int k = random.integer(0, static_cast<int>(arrays.weights.size()) - 1);
    arrays.weights[k] = std::pow(10.0, one_in(random, 2) ? decades : -decades);
  }
  text << ", " << kind << " weights of " << decades << " decades";
}

/// Makes pole `to` along direction i what pole `from` is, in every row or (a point) in the first.
template <int N>
void copy_side(
  shapes::Arrays<N>& arrays, int i, Eigen::Index from, Eigen::Index to, bool to_a_point)
{
  const std::array<Eigen::Index, 2> count = counts<N>(arrays);
  for (Eigen::Index k = 0; k < count[1 - i]; ++k)
  {
    const Eigen::Index source = pole(i, from, to_a_point ? 0 : k, count[0]);
    const Eigen::Index target = pole(i, to, k, count[0]);
    arrays.points.col(target) = arrays.points.col(source);
    if (arrays.weights.size() > 0 && !to_a_point)
    {
      arrays.weights[target] = arrays.weights[source];
    }
  }
}

template <int N>
void close_or_collapse(Random& random, shapes::Arrays<N>& arrays,
  const std::array<std::string, 2>& kinds, std::ostream& text)
{
  for (int i = 0; i < N; ++i)
  {
    const Eigen::Index last = counts<N>(arrays)[i] - 1;
    if (kinds[i] == "periodic")
    {
      const Eigen::Index period = last + 1 - arrays.degrees[i];
      for (Eigen::Index k = period; k <= last; ++k)
      {
        copy_side<N>(arrays, i, k - period, k, false);
      }
    }
    else if (kinds[i] == "clamped" && one_in(random, 3))
    {
      const bool collapse = N == 2 && one_in(random, 2);
      text << (collapse ? ", collapsed in " : ", closed in ") << "uv"[i];
      copy_side<N>(arrays, i, 0, collapse ? 0 : last, collapse);
      if (collapse && one_in(random, 2))
      {
        text << " at both ends";
        copy_side<N>(arrays, i, last, last, true);
      }
    }
  }
}

} // namespace

template <int N>
Geometry<N> random_geometry(Random& random)
{
  Geometry<N> geometry;
  std::ostringstream text;
  text << N << "-D,";
  std::array<std::string, 2> kinds;
  for (int i = 0; i < N; ++i)
  {
    kinds[i] = random_direction<N>(random, i, geometry.arrays, text);
  }
  random_net<N>(random, geometry.arrays, text);
  random_weights<N>(random, geometry.arrays, text);
  close_or_collapse<N>(random, geometry.arrays, kinds, text);
  if (one_in(random, 8))
  {
    const double scale = random.magnitude(3);
    geometry.arrays.points *= scale;
    text << ", scaled by " << scale;
  }
  if (one_in(random, 5))
  {
    const double scale = geometry.arrays.points.cwiseAbs().maxCoeff();
    geometry.arrays.points.colwise() += 1e6 * scale * random.vector(-1, 1);
    text << ", moved by 1e6";
  }
  geometry.description = text.str();
  return geometry;
}

template Geometry<1> random_geometry<1>(Random&);
template Geometry<2> random_geometry<2>(Random&);

// === Queries

namespace
{

/// The oracle's view with the origin moved.
template <int N>
oracle::Spline<N> moved(const shapes::Arrays<N>& arrays, const Vector3& origin)
{
  oracle::Spline<N> spline = arrays.spline();
  spline.subtract(origin.cast<Real>());
  return spline;
}

} // namespace

template <int N>
Judge<N>::Judge(const shapes::Arrays<N>& arrays)
  : origin(arrays.points.rowwise().mean())
  , nearest(moved<N>(arrays, origin))
  , size(static_cast<double>(nearest.spline().size()))
{
}

template <int N>
Vector Judge<N>::to_local(const Vector3& point) const
{
  return point.cast<Real>() - this->origin.template cast<Real>();
}

template <int N>
Vector3 Judge<N>::to_model(const Vector& local) const
{
  return (local + this->origin.template cast<Real>()).template cast<double>();
}

template struct Judge<1>;
template struct Judge<2>;

namespace
{

/// Where a query starts from: a place on the geometry with a unit normal and centres of curvature.
template <int N>
struct Base
{
  Vector point;
  Vector normal;
  std::vector<Vector> centres; ///< relative to the point, those not too far away
};

template <int N>
typename oracle::Spline<N>::Parameters random_parameters(
  Random& random, const oracle::Spline<N>& spline, bool on_knots)
{
  typename oracle::Spline<N>::Parameters t;
  for (int i = 0; i < N; ++i)
  {
    const std::vector<int> spans = spline.spans(i);
    const int k = spans[random.integer(0, static_cast<int>(spans.size()) - 1)];
    const Real a = spline.knot(i, k);
    const Real b = spline.knot(i, k + 1);
    const std::string kind =
      on_knots ? pick(random, { "start", "end", "beside", "inside" }) : "inside";
    const Real fraction = kind == "start" ? 0.0L
      : kind == "end"                     ? 1.0L
      : kind == "beside"                  ? std::pow(10.0L, random.uniform(-12, -3))
                                          : static_cast<Real>(random.uniform(0, 1));
    t[i] = fraction == 1.0L ? b : a + fraction * (b - a);
  }
  return t;
}

template <int N>
Base<N> base_at(Random& random, const Judge<N>& judge,
  const typename oracle::Spline<N>::Parameters& t, bool curvature)
{
  const oracle::Spline<N>& spline = judge.nearest.spline();
  typename oracle::Spline<N>::Spans spans;
  for (int i = 0; i < N; ++i)
  {
    spans[i] = spline.span(i, t[i], one_in(random, 2));
  }
  const auto derivative = [&](int u, int v)
  {
    std::array<int, N> orders;
    orders[N - 1] = v;
    orders[0] = u;
    return oracle::derivative<N>(spline, spans, t, orders);
  };
  Base<N> base;
  base.point = spline.point(t);
  const Vector along = derivative(1, 0);
  const Vector across = N == 2 ? derivative(0, 1) : Vector(random.vector(-1, 1).cast<Real>());
  base.normal = along.cross(across).stableNormalized();
  if (!curvature)
  {
    return base;
  }
  const auto add = [&](Real bend, const Vector& normal)
  {
    const Real radius = 1.0L / bend;
    if (std::abs(radius) < 10.0L * judge.size)
    {
      base.centres.push_back(radius * normal);
    }
  };
  const Vector second = derivative(2, 0);
  if (N == 1)
  {
    const Vector tangent = along.stableNormalized();
    const Vector bend = (second - second.dot(tangent) * tangent) / along.squaredNorm();
    add(bend.norm(), bend.stableNormalized());
    return base;
  }
  // Roots κ of det(II − κ I) = 0, I and II the fundamental forms.
  const Real e = along.squaredNorm();
  const Real f = along.dot(across);
  const Real g = across.squaredNorm();
  const Real l = second.dot(base.normal);
  const Real m = derivative(1, 1).dot(base.normal);
  const Real n = derivative(0, 2).dot(base.normal);
  const Real mean = (l * g - 2.0L * m * f + n * e) / (2.0L * (e * g - f * f));
  const Real gauss = (l * n - m * m) / (e * g - f * f);
  const Real root = std::sqrt(std::max(mean * mean - gauss, 0.0L));
  add(mean + root, base.normal);
  add(mean - root, base.normal);
  return base;
}

/// A point of the medial axis: the centre of the largest ball that touches the geometry at the base
/// and holds nothing of it, by shrinking (Ma, Bae and Choi 2012).
template <int N>
Vector medial_point(const Judge<N>& judge, const Base<N>& base)
{
  Real radius = judge.size;
  for (int iteration = 0; iteration < 12; ++iteration)
  {
    const oracle::Foot<N> foot = judge.nearest(base.point + radius * base.normal);
    const Vector back = base.point - foot.point;
    const Real slope = 2.0L * -base.normal.dot(back);
    if (foot.distance >= radius * (1.0L - 1e-15L) || !(slope > 0.0L))
    {
      break;
    }
    radius = back.squaredNorm() / slope;
  }
  return base.point + radius * base.normal;
}

} // namespace

template <int N>
Query random_query(Random& random, const Judge<N>& judge, std::string kind)
{
  if (kind.empty())
  {
    kind = pick(random,
      { "on", "on", "on a knot", "on a knot", "little off", "little off", "little off",
        "little off a knot", "near", "near", "off", "off", "off", "inside the box", "far",
        "very far", "centre of curvature", "centre of curvature", "near a centre of curvature",
        "near a centre of curvature", "medial axis", "near the medial axis" });
  }
  const bool on_knots =
    kind.find("knot") != std::string::npos || (kind != "on" && one_in(random, 5));
  const Base<N> base =
    base_at<N>(random, judge, random_parameters<N>(random, judge.nearest.spline(), on_knots),
      kind.find("curvature") != std::string::npos);
  const Vector any = random.vector(-1, 1).cast<Real>();
  const Vector direction =
    one_in(random, 2) && base.normal.norm() > 0.5L ? Vector(base.normal) : any;
  const auto power = [&](double low, double high)
  { return judge.size * std::pow(10.0L, static_cast<Real>(random.uniform(low, high))); };
  Vector at = base.point;
  if (kind.find("little off") == 0)
  {
    at += power(-13, -6) * direction;
  }
  else if (kind == "near")
  {
    at += power(-6, -1.5) * direction;
  }
  else if (kind == "off")
  {
    at += power(-1.5, 0.2) * direction;
  }
  else if (kind == "inside the box")
  {
    at = 0.3L * judge.size * any;
  }
  else if (kind == "far")
  {
    at += power(0.2, 2) * direction;
  }
  else if (kind == "very far")
  {
    at += power(2, 6) * direction;
  }
  else if (kind.find("curvature") != std::string::npos && !base.centres.empty())
  {
    at += base.centres[random.integer(0, static_cast<int>(base.centres.size()) - 1)];
  }
  else if (kind.find("medial") != std::string::npos && base.normal.norm() > 0.5L)
  {
    at = medial_point<N>(judge, base);
  }
  if (kind.find("near a") == 0 || kind.find("near the") == 0)
  {
    at += power(-13, -2) * any;
  }
  // Where the geometry stands still there is no centre of curvature.
  return { kind, judge.to_model(at.allFinite() ? at : base.point) };
}

template Query random_query<1>(Random&, const Judge<1>&, std::string);
template Query random_query<2>(Random&, const Judge<2>&, std::string);

} // namespace fuzz
