// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.h"

#include "OracleNearest.h"
#include "OracleShapes.h"
#include "timing.h"

#include <iostream>
#include <optional>

namespace inversion_benchmark
{
namespace
{

using Real = long double;

constexpr Real kWrong = 1e-12L; // by the size
constexpr Real kMissed = 1e-6L;
/// Distances are doubles: what an answer may be off by its own rounding, by the distance.
constexpr Real kRounding = 4.0L * std::numeric_limits<double>::epsilon();

/// The oracle samples every piece 100 times and more: on large nets that is too much to prepare.
constexpr std::size_t kMostPiecesOfOracle = 2000;

/// Points of a pass whose every query is timed by itself, for the slowest; and the fewest of such
/// passes: in a single one the slowest point is where something else got the processor.
constexpr int kPointsOfWorst = 20000;
constexpr int kPassesOfWorst = 3;

/// What is known about a shape without any of the programs.
class Judge
{
public:
  explicit Judge(const Shape& shape)
    : Size(shape.size())
    , Closed(shape.distance)
  {
    if (shape.surface)
    {
      this->Surface.emplace(shapes::spline_of(*shape.surface));
    }
    else
    {
      this->Curve.emplace(shapes::spline_of(*shape.curve));
    }
    if (shape.pieces() <= kMostPiecesOfOracle && !this->Closed)
    {
      if (this->Surface)
      {
        this->NearestOnSurface.emplace(*this->Surface);
      }
      else
      {
        this->NearestOnCurve.emplace(*this->Curve);
      }
    }
  }

  /// Upper bounds of the distances: from the closed form, from how the queries were made, and, from
  /// the last query on as long as the budget lasts, from the brute force of the oracle.
  std::vector<Real> bounds(const Queries& queries, double budget) const
  {
    std::vector<Real> all = queries.bounds;
    const auto count = static_cast<std::int64_t>(all.size());
    double spent = 0.0;
    for (std::int64_t k = count - 1; k >= 0 && (this->Closed || spent < budget); --k)
    {
      spent += seconds([&] { all[k] = std::min(all[k], this->nearest(queries.points.col(k))); });
    }
    return all;
  }

  /// How far the answer's point on the exact geometry is from the query. Parameters count as ones
  /// of the domain: some programs leave it by rounding, where the geometry does not go on.
  Real attained(const Answer& answer, const Vector3& query) const
  {
    const oracle::Vector p = query.cast<Real>();
    if (this->Surface)
    {
      return (this->Surface->point({ in_domain(*this->Surface, 0, answer.parameter(0)),
                in_domain(*this->Surface, 1, answer.parameter(1)) }) -
        p)
        .norm();
    }
    return (this->Curve->point({ in_domain(*this->Curve, 0, answer.parameter(0)) }) - p).norm();
  }

  Real size() const { return this->Size; }

private:
  template <int N>
  static Real in_domain(const oracle::Spline<N>& spline, int direction, Real t)
  {
    const Real start = spline.knot(direction, spline.degree(direction));
    return std::min(std::max(t, start), spline.knot(direction, spline.count(direction)));
  }

  Real nearest(const Vector3& query) const
  {
    if (this->Closed)
    {
      return this->Closed(query);
    }
    if (this->NearestOnSurface)
    {
      return (*this->NearestOnSurface)(query.cast<Real>()).distance;
    }
    return this->NearestOnCurve ? (*this->NearestOnCurve)(query.cast<Real>()).distance
                                : std::numeric_limits<Real>::infinity();
  }

  Real Size;
  std::function<Real(const Vector3&)> Closed;
  std::optional<oracle::Spline<2>> Surface;
  std::optional<oracle::Spline<1>> Curve;
  std::optional<oracle::Nearest<2>> NearestOnSurface;
  std::optional<oracle::Nearest<1>> NearestOnCurve;
};

/// A program that took the shape, with its results for one class of queries.
struct Entry
{
  Peer* peer;
  Record record;
  std::vector<double> passes; ///< µs a point
  std::vector<Answer> answers;
};

/// How many points a program does in the budget.
std::size_t affordable(Peer& peer, const Points& points, double budget)
{
  const auto all = static_cast<std::size_t>(points.cols());
  std::size_t count = 1;
  for (;;)
  {
    std::vector<Answer> answers(count);
    const double spent = cpu_seconds([&] { peer.project_all(points, answers); });
    if (spent > 0.05 * budget || count == all)
    {
      const double most = static_cast<double>(count) * budget / std::max(spent, 1e-9);
      return std::max<std::size_t>(
        1, static_cast<std::size_t>(std::min(most, static_cast<double>(all))));
    }
    count = std::min(4 * count, all);
  }
}

void time_by_turns(std::vector<Entry>& entries, const Points& points, const Settings& settings)
{
  for (Entry& entry : entries)
  {
    entry.answers.resize(affordable(*entry.peer, points, settings.budget));
  }
  for (int repeat = 0; repeat < settings.repeats; ++repeat)
  {
    for (Entry& entry : entries)
    {
      const double spent = cpu_seconds([&] { entry.peer->project_all(points, entry.answers); });
      entry.passes.push_back(1e6 * spent / static_cast<double>(entry.answers.size()));
    }
  }
  for (Entry& entry : entries)
  {
    entry.record.points = static_cast<std::int64_t>(entry.answers.size());
    entry.record.microseconds = median(entry.passes);
  }
}

/// The slowest point; what the machine adds in one pass is gone in another.
double slowest(Peer& peer, const Points& points, std::size_t count, int repeats)
{
  std::vector<double> least(std::min<std::size_t>(count, kPointsOfWorst), INFINITY);
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    for (std::size_t k = 0; k < least.size(); ++k)
    {
      const double spent = seconds([&] { peer.project(points.col(static_cast<Eigen::Index>(k))); });
      least[k] = std::min(least[k], 1e6 * spent);
    }
  }
  return *std::max_element(least.begin(), least.end());
}

/// Where the answer lies (tessellations: what it says), and whether it lies where it says.
Real error_of(
  const Entry& entry, const Judge& judge, Real attained, Real best, const Answer& answer)
{
  if (!entry.peer->exact())
  {
    return std::abs(answer.distance - best) / judge.size();
  }
  return std::max(attained - best, std::abs(answer.distance - attained)) / judge.size();
}

bool answered(const Entry& entry, const Answer& answer)
{
  return std::isfinite(answer.distance) && (!entry.peer->exact() || answer.parameter.allFinite());
}

/// Compares every answer with the best that is known of its point.
void check(
  std::vector<Entry>& entries, const Queries& queries, std::vector<Real> best, const Judge& judge)
{
  std::vector<std::vector<Real>> attained(entries.size());
  for (std::size_t e = 0; e < entries.size(); ++e)
  {
    const std::vector<Answer>& answers = entries[e].answers;
    attained[e].assign(answers.size(), NAN);
    for (std::size_t k = 0; k < answers.size() && entries[e].peer->exact(); ++k)
    {
      if (answered(entries[e], answers[k]))
      {
        attained[e][k] =
          judge.attained(answers[k], queries.points.col(static_cast<Eigen::Index>(k)));
        best[k] = std::min(best[k], attained[e][k]);
      }
    }
  }
  for (std::size_t e = 0; e < entries.size(); ++e)
  {
    Record& record = entries[e].record;
    record.error = 0.0;
    for (std::size_t k = 0; k < entries[e].answers.size(); ++k)
    {
      const Answer& answer = entries[e].answers[k];
      if (std::isinf(best[k])) // a tessellation's answer alone judges nothing
      {
        continue;
      }
      ++record.checked;
      record.uncertified += answer.certified ? 0 : 1;
      if (!answered(entries[e], answer))
      {
        ++record.failed;
        ++record.wrong;
        ++record.missed;
        continue;
      }
      const Real error = error_of(entries[e], judge, attained[e][k], best[k], answer);
      record.error = std::max(record.error, static_cast<double>(error));
      record.wrong += error > kWrong + kRounding * best[k] / judge.size() ? 1 : 0;
      record.missed += error > kMissed ? 1 : 0;
    }
  }
}

bool is_main(QueryClass query_class)
{
  return std::find(kMainClasses.begin(), kMainClasses.end(), query_class) != kMainClasses.end();
}

/// One shape and class: ours first.
void compare_class(const Shape& shape, QueryClass query_class, const std::vector<Peer*>& peers,
  const std::vector<double>& builds, const Judge& judge, const Settings& settings, Records& records)
{
  const Queries queries = make_queries(shape, query_class, settings.points);
  if (queries.points.cols() == 0)
  {
    return;
  }
  std::vector<Entry> entries;
  for (std::size_t e = 0; e < peers.size(); ++e)
  {
    if (e == 0 || is_main(query_class))
    {
      Entry entry{ peers[e], {}, {}, {} };
      entry.record.part = "comparison";
      entry.record.shape = shape.name;
      entry.record.query = name_of(query_class);
      entry.record.program = peers[e]->name();
      entry.record.build = builds[e];
      entries.push_back(entry);
    }
  }
  time_by_turns(entries, queries.points, settings);
  Entry& ours = entries.front();
  if (!is_main(query_class))
  {
    ours.record.worst = slowest(
      *ours.peer, queries.points, ours.answers.size(), std::max(settings.repeats, kPassesOfWorst));
  }
  // The oracle's points are to be among those that were answered.
  Queries done;
  done.points = queries.points.leftCols(static_cast<Eigen::Index>(ours.answers.size()));
  done.bounds.assign(queries.bounds.begin(),
    queries.bounds.begin() + static_cast<std::ptrdiff_t>(ours.answers.size()));
  std::vector<Real> best = judge.bounds(done, settings.budget);
  best.resize(
    static_cast<std::size_t>(queries.points.cols()), std::numeric_limits<Real>::infinity());
  check(entries, queries, best, judge);
  for (const Entry& entry : entries)
  {
    records.push_back(entry.record);
  }
}

bool wanted(const std::vector<std::string>& names, const std::string& name)
{
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

void time_program(Peer& peer, const Points& points, const Settings& settings, Record& record)
{
  std::vector<Entry> entries{ { &peer, record, {}, {} } };
  time_by_turns(entries, points, settings);
  record = entries.front().record;
}

Records compare(const Settings& settings, std::ostream& progress)
{
  std::vector<QueryClass> classes = settings.classes;
  for (int c = 0; settings.classes.empty() && c <= static_cast<int>(QueryClass::Ties); ++c)
  {
    classes.push_back(static_cast<QueryClass>(c));
  }
  const std::vector<std::unique_ptr<Peer>> programs = all_peers(settings.ours_only, true);
  Records records;
  for (const Shape& shape : all_shapes())
  {
    if (!wanted(settings.shapes, shape.name))
    {
      continue;
    }
    progress << shape.name << std::flush;
    std::vector<Peer*> peers;
    std::vector<double> builds;
    for (const std::unique_ptr<Peer>& program : programs)
    {
      bool taken = false;
      const double spent = cpu_seconds([&] { taken = program->build(shape); });
      if (taken)
      {
        peers.push_back(program.get());
        builds.push_back(1e3 * spent);
      }
    }
    const Judge judge(shape);
    for (const QueryClass query_class : classes)
    {
      if (has_class(shape, query_class))
      {
        progress << ' ' << name_of(query_class) << std::flush;
        compare_class(shape, query_class, peers, builds, judge, settings, records);
      }
    }
    progress << std::endl;
  }
  return records;
}

} // namespace inversion_benchmark
