// SPDX-License-Identifier: BSD-3-Clause

#include "FootJudge.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <utility>

namespace judge
{

const char* name_of(Where where)
{
  static const char* const names[] = { "on", "near", "off", "far", "on an edge", "on a vertex",
    "above an edge", "just off", "in a hole", "midway", "midway between edges" };
  return names[static_cast<int>(where)];
}

const FaceOracle::Sample& any_of(
  const std::vector<FaceOracle::Sample>& samples, shapes::Random& random)
{
  return samples[static_cast<std::size_t>(random.integer(0, static_cast<int>(samples.size()) - 1))];
}

Place inside(const FaceOracle& face, shapes::Random& random)
{
  const bool has_inside = !face.inside().empty();
  const Place from = any_of(has_inside ? face.inside() : face.rims(), random).at;
  for (int attempt = 0; attempt < 10; ++attempt)
  {
    Place at = from;
    for (int i = 0; i < 2; ++i)
    {
      at[i] = std::clamp<Real>(at[i] + random.uniform(-0.02, 0.02) * face.width()[i],
        face.lower()[i], face.lower()[i] + face.width()[i]);
    }
    if (face.loops().keeps(at))
    {
      return at;
    }
  }
  return from;
}

Vector3 query(const ModelOracle& model, const std::vector<double>& sizes, std::size_t f,
  Where where, shapes::Random& random)
{
  const FaceOracle& face = model.faces()[f];
  const double size = sizes[f];
  const auto at = [](const FaceOracle& of, const Place& place) -> Vector3
  { return of.point(place).cast<double>(); };
  const auto other = [&]() -> const FaceOracle&
  {
    const int last = static_cast<int>(model.faces().size()) - 1;
    const bool same = random.integer(0, 1) == 0;
    return model.faces()[same ? f : static_cast<std::size_t>(random.integer(0, last))];
  };
  const auto along_normal = [&](const Place& place, double lowest, double highest) -> Vector3
  {
    const double height = std::pow(10.0, random.uniform(lowest, highest)) * size;
    const Vector3 normal = face.normal(place);
    const Vector3 way = normal.allFinite() ? normal : random.vector(-1.0, 1.0);
    return at(face, place) + (random.integer(0, 1) == 0 ? height : -height) * way;
  };
  switch (where)
  {
    case Where::Near:
    case Where::Off:
    case Where::Far:
    {
      const double away = where == Where::Near ? 1e-3 : where == Where::Off ? 0.1 : 3.0;
      return at(face, inside(face, random)) + random.vector(-away, away) * size;
    }
    case Where::OnEdge:
      return any_of(face.rims(), random).point;
    case Where::OnVertex:
    {
      const auto& curves = face.loops().curves();
      const auto& curve =
        curves[static_cast<std::size_t>(random.integer(0, static_cast<int>(curves.size()) - 1))];
      const Vector3 vertex = at(face, curve.at(curve.breaks().front()));
      const double away = random.integer(0, 1) == 0 ? 0.0 : random.uniform(-6.0, 0.0);
      return away == 0.0 ? vertex : vertex + std::pow(10.0, away) * size * random.vector(-1.0, 1.0);
    }
    case Where::AboveEdge:
      return along_normal(any_of(face.rims(), random).at, -6.0, 0.0);
    case Where::JustOff:
      return along_normal(inside(face, random), -13.0, -6.0);
    case Where::InHole:
    {
      const int loop = random.integer(0, face.loops().loops().back());
      Vector3 sum = Vector3::Zero();
      double count = 0.0;
      for (const FaceOracle::Sample& rim : face.rims())
      {
        if (face.loops().loops()[rim.curve] == loop)
        {
          sum += rim.point;
          count += 1.0;
        }
      }
      const Vector3 centre = count > 0.0 ? Vector3(sum / count) : at(face, inside(face, random));
      const double away = random.integer(0, 2) == 0 ? 0.0 : random.uniform(-9.0, -1.0);
      return away == 0.0 ? centre : centre + std::pow(10.0, away) * size * random.vector(-1.0, 1.0);
    }
    case Where::Midway:
    {
      const FaceOracle& second = other();
      return 0.5 * (at(face, inside(face, random)) + at(second, inside(second, random)));
    }
    case Where::MidwayRims:
    {
      const FaceOracle& second = other();
      return 0.5 * (any_of(face.rims(), random).point + any_of(second.rims(), random).point);
    }
    default:
      return at(face, inside(face, random));
  }
}

std::ostream& operator<<(std::ostream& stream, const Tally& tally)
{
  const double count = static_cast<double>(std::max<std::uint64_t>(tally.queries, 1));
  return stream << tally.queries << " queries, " << tally.wrong() << " wrong (" << tally.too_far
                << " too far, " << tally.too_near << " too near, " << tally.misplaced
                << " misplaced, " << tally.outside << " trimmed away), " << tally.uncertified
                << " not certified (" << tally.unproved_too_far
                << " of them too far), largest excess " << tally.excess << "; "
                << 1e6 * tally.search_seconds / count << " us a query (slowest "
                << 1e3 * tally.slowest << " ms), oracle " << 1e6 * tally.oracle_seconds / count
                << " us, farther in " << tally.oracle_farther;
}

Judge::Judge(
  std::string name, const footpoint::Model& faces, const footpoint::InversionOptions& options)
  : Name(std::move(name))
  , Inverter(faces, options)
  , Oracle(oracles(faces))
{
  for (const FaceOracle& face : this->Oracle.faces())
  {
    this->Sizes.push_back(face.size());
  }
}

void Judge::ask(int count, shapes::Random& random, Tally& tally) const
{
  const int kinds = static_cast<int>(Where::Count);
  const auto start = static_cast<std::size_t>(random.integer(0, kinds - 1));
  for (int k = 0; k < count; ++k)
  {
    const auto where = static_cast<Where>((start + static_cast<std::size_t>(k)) % kinds);
    const std::size_t face =
      static_cast<std::size_t>(random.integer(0, static_cast<int>(this->Sizes.size()) - 1));
    this->check(query(this->Oracle, this->Sizes, face, where, random), name_of(where), tally);
  }
}

Foot Judge::check(const Vector3& point, const char* what, Tally& tally) const
{
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const Foot foot = this->Inverter.find(point);
  const auto middle = Clock::now();
  const ModelOracle::Found nearest = this->Oracle.nearest(point);
  const double seconds = std::chrono::duration<double>(middle - begin).count();
  tally.search_seconds += seconds;
  tally.slowest = std::max(tally.slowest, seconds);
  tally.oracle_seconds += std::chrono::duration<double>(Clock::now() - middle).count();
  ++tally.queries;
  const double size = this->Inverter.size();
  const double allowed = kWrong * size + kRounding * (foot.distance + point.norm());
  const double excess = static_cast<double>(foot.distance - nearest.distance);
  const bool certified = foot.status == Status::Certified;
  tally.uncertified += !certified;
  tally.oracle_farther += excess < -allowed;
  tally.excess = std::max(tally.excess, excess / size);
  if (!(excess <= allowed))
  {
    ++tally.too_far;
    tally.unproved_too_far += !certified;
    this->report("too far", what, point, foot, nearest, excess / size);
  }
  else if (certified && excess < -allowed && this->is_nowhere(foot))
  {
    ++tally.too_near;
    this->report("too near", what, point, foot, nearest, excess / size);
  }
  else if (!certified)
  {
    this->report("not certified, excess", what, point, foot, nearest, excess / size);
  }
  this->check_place(point, what, foot, nearest, tally);
  return foot;
}

std::vector<FaceOracle> Judge::oracles(const footpoint::Model& faces)
{
  std::vector<FaceOracle> result;
  for (const footpoint::Face& face : faces)
  {
    result.emplace_back(
      dynamic_cast<const footpoint::Surface&>(*face.patches.front().surface), face.loops);
  }
  return result;
}

bool Judge::is_nowhere(const Foot& foot) const
{
  return foot.face >= 0 &&
    !this->Oracle.faces()[static_cast<std::size_t>(foot.face)].keeps_about(
      { { foot.parameter(0), foot.parameter(1) } });
}

void Judge::check_place(const Vector3& point, const char* what, const Foot& foot,
  const ModelOracle::Found& nearest, Tally& tally) const
{
  if (foot.face < 0)
  {
    return;
  }
  const double size = this->Inverter.size();
  const FaceOracle& face = this->Oracle.faces()[static_cast<std::size_t>(foot.face)];
  const Place at{ { foot.parameter(0), foot.parameter(1) } };
  // One rounding of the parameters moves the point.
  const oracle::Vector here = face.point(at);
  double rounding = kPlace * size + kRounding * foot.point.norm();
  // Parameters and loops are rounded a few times on their way into the domain and back, in parts of
  // it.
  double rounded = 0.0;
  for (int i = 0; i < 2; ++i)
  {
    const Real unit = 0x1p-52L * (std::abs(face.lower()[i]) + face.width()[i]);
    rounded = std::max(rounded, static_cast<double>(8 * unit / face.width()[i]));
    Place there = at;
    there[i] += at[i] - face.lower()[i] > face.width()[i] / 2 ? -unit : unit;
    rounding += static_cast<double>((face.point(there) - here).norm());
  }
  const double apart = static_cast<double>((here - foot.point.cast<Real>()).norm());
  const double distance = (foot.point - point).norm();
  if (!(apart <= rounding) ||
    !(std::abs(distance - foot.distance) <=
      kPlace * size + kRounding * (foot.distance + foot.point.norm())))
  {
    ++tally.misplaced;
    this->report("misplaced", what, point, foot, nearest, apart / size);
  }
  if (!face.loops().keeps(at))
  {
    const double beside = static_cast<double>(face.loops().distance(at));
    if (!(beside <= kBesideLoop + rounded))
    {
      ++tally.outside;
      this->report("trimmed away", what, point, foot, nearest, beside);
    }
  }
}

void Judge::report(const char* verdict, const char* what, const Vector3& point, const Foot& foot,
  const ModelOracle::Found& nearest, double by) const
{
  if (++this->Printed > kPrinted)
  {
    return;
  }
  std::cout << std::setprecision(17) << this->Name << ": " << verdict << " by " << by << ", query "
            << what << " (" << point.transpose() << "), foot on face " << foot.face << " at ("
            << foot.parameter.transpose() << "), status " << static_cast<int>(foot.status)
            << ", type " << static_cast<int>(foot.type) << ", distance " << foot.distance
            << "; oracle: face " << nearest.face << " at (" << nearest.at[0] << " " << nearest.at[1]
            << "), distance " << nearest.distance << std::setprecision(6) << "\n";
}

} // namespace judge
