// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/point_inversion.h"

#include "footpoint/model/inverter_implementation.h"

namespace footpoint
{

PointInverter::Workspace::Workspace()
  : Data(std::make_unique<Memory>())
{
  this->Data->answers.resize(1);
}

PointInverter::Workspace::~Workspace() = default;

PointInverter::Implementation::Implementation(
  std::shared_ptr<const PreparedModel> prepared, const InversionOptions& options)
  : Prepared(std::move(prepared))
  , Options(options)
  , Patches(this->Prepared->patches(options))
  , Size(this->Prepared->size())
{
  if (this->wants_lines())
  {
    this->Options.fixed_direction.stableNormalize(); // whatever its length
  }
}

PointInverter::PointInverter(
  Model model, const InversionOptions& options, const Execution& execution)
  : Data(std::make_unique<Implementation>(prepare(std::move(model), options, execution), options))
{
}

PointInverter::PointInverter(std::unique_ptr<Implementation> data)
  : Data(std::move(data))
{
}

PointInverter::~PointInverter() = default;
PointInverter::PointInverter(PointInverter&&) noexcept = default;
PointInverter& PointInverter::operator=(PointInverter&&) noexcept = default;

PointInverter PointInverter::with_options(
  const InversionOptions& options, const Execution& execution) const
{
  return PointInverter(
    std::make_unique<Implementation>(prepare(this->Data->Prepared, options, execution), options));
}

bool PointInverter::is_prepared_for(const InversionOptions& options) const
{
  return this->Data->Prepared->parts().include(PreparedParts(options));
}

const Model& PointInverter::model() const
{
  return this->Data->Prepared->model();
}

const InversionOptions& PointInverter::options() const
{
  return this->Data->Options;
}

double PointInverter::size() const
{
  return this->Data->Size;
}

std::int64_t PointInverter::number_of_open_edges() const
{
  const FaceNeighbours* neighbours = this->Data->Prepared->neighbours();
  return neighbours ? neighbours->number_of_open_edges() : number_of_open_sides(this->model());
}

Foot PointInverter::find(const Vector3& point, const Start& start) const
{
  Workspace workspace;
  return this->find(point, start, workspace);
}

Foot PointInverter::find(const Vector3& point, const Start& start, Workspace& workspace) const
{
  const InversionOptions& options = this->Data->Options;
  Foot none;
  if (!point.allFinite())
  {
    none.status = Status::InvalidPoint;
    return none;
  }
  none.status = Status::BeyondMaximumDistance;
  if (this->Data->wants_lines())
  {
    const std::vector<Candidate> all = this->Data->every(point, start);
    return all.empty() ? none : this->Data->finish(point, all.front(), {});
  }
  if (options.orthogonal_only)
  {
    const std::vector<Candidate> feet = this->Data->nearest(point, start, Sought::Orthogonal);
    if (!feet.empty())
    {
      return this->Data->finish(point, feet.front(), feet);
    }
  }
  Foot foot = none;
  if (this->Data->certifies())
  {
    foot = this->Data->nearest_certified(point, *workspace.Data);
  }
  else
  {
    const std::vector<Candidate> feet = this->Data->nearest(point, start, Sought::Minimum);
    foot = feet.empty() ? none : this->Data->finish(point, feet.front(), feet);
  }
  if (options.orthogonal_only && foot.status != Status::BeyondMaximumDistance)
  {
    foot.status = Status::NoOrthogonalFoot;
  }
  return foot;
}

void PointInverter::find(const Eigen::Ref<const Points>& points, const std::vector<Start>& starts,
  Workspace& workspace, Foot* feet) const
{
  const Eigen::Index count = points.cols();
  const bool together =
    this->Data->certifies() && !this->Data->Options.orthogonal_only && points.allFinite();
  if (!together)
  {
    for (Eigen::Index k = 0; k < count; ++k)
    {
      feet[k] = this->find(points.col(k), starts.empty() ? Start{} : starts[k], workspace);
    }
    return;
  }
  const InversionOptions& options = this->Data->Options;
  std::vector<CertifiedAnswer>& answers = workspace.Data->answers;
  answers.resize(CertifiedSearch::kTogether);
  for (Eigen::Index first = 0; first < count; first += CertifiedSearch::kTogether)
  {
    const auto part = std::min<Eigen::Index>(CertifiedSearch::kTogether, count - first);
    this->Data->Prepared->certified()->find(points.middleCols(first, part),
      options.maximum_distance, options.certificate_tolerance, workspace.Data->search,
      answers.data());
    for (Eigen::Index k = 0; k < part; ++k)
    {
      feet[first + k] = this->Data->certified_foot(points.col(first + k), answers[k]);
    }
  }
}

std::vector<Foot> PointInverter::find_all(const Vector3& point, const Start& start) const
{
  const InversionOptions& options = this->Data->Options;
  std::vector<Foot> result;
  if (options.all_feet || this->Data->wants_lines())
  {
    const std::vector<Candidate> all =
      point.allFinite() ? this->Data->every(point, start) : std::vector<Candidate>{};
    for (const Candidate& candidate : all)
    {
      result.push_back(this->Data->finish(point, candidate, {}));
    }
    if (this->Data->certifies() && !options.orthogonal_only && point.allFinite())
    {
      const Foot nearest = this->find(point, start);
      if (nearest.face >= 0)
      {
        this->Data->put_nearest_in(result, nearest);
      }
    }
    return result;
  }
  const Foot foot = this->find(point, start);
  if (foot.status != Status::InvalidPoint && foot.status != Status::BeyondMaximumDistance)
  {
    result.push_back(foot);
  }
  return result;
}

} // namespace footpoint
