// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include "footpoint/model/point_inversion.h"

#include <algorithm>

namespace inversion_benchmark
{
namespace
{

class Footpoint : public Peer
{
public:
  std::string name() const override { return "Footpoint"; }

  bool build(const Shape& shape) override
  {
    this->Inverter.reset(); // two large ones need not fit
    this->Inverter = std::make_unique<footpoint::PointInverter>(model_of(shape));
    return true;
  }

  Answer project(const Vector3& point) override
  {
    return answer_of(this->Inverter->find(point, {}, this->Workspace));
  }

protected:
  static Answer answer_of(const footpoint::Foot& foot)
  {
    return { foot.distance, foot.parameter, foot.status == footpoint::Status::Certified };
  }

  std::unique_ptr<footpoint::PointInverter> Inverter;

private:
  footpoint::PointInverter::Workspace Workspace;
};

class FootpointBatch : public Footpoint
{
public:
  std::string name() const override { return "Footpoint batch"; }

  void project_all(const Points& points, std::vector<Answer>& answers) override
  {
    const auto count = static_cast<Eigen::Index>(answers.size());
    footpoint::invert(*this->Inverter, points.leftCols(count), {}, {},
      [&](std::int64_t first, const footpoint::InversionResult& part)
      {
        std::transform(part.feet.begin(), part.feet.end(),
          answers.begin() + static_cast<std::ptrdiff_t>(first), answer_of);
      });
  }
};

} // namespace

void Peer::project_all(const Points& points, std::vector<Answer>& answers)
{
  for (std::size_t k = 0; k < answers.size(); ++k)
  {
    answers[k] = this->project(points.col(static_cast<Eigen::Index>(k)));
  }
}

std::unique_ptr<Peer> make_footpoint()
{
  return std::make_unique<Footpoint>();
}

std::unique_ptr<Peer> make_footpoint_batch()
{
  return std::make_unique<FootpointBatch>();
}

bool is_ours(const std::string& program)
{
  return program.rfind("Footpoint", 0) == 0;
}

std::vector<std::unique_ptr<Peer>> all_peers(bool ours_only, [[maybe_unused]] bool fine_mesh)
{
  std::vector<std::unique_ptr<Peer>> all;
  all.push_back(make_footpoint());
  all.push_back(make_footpoint_batch());
  if (!ours_only)
  {
#ifdef BENCHMARK_OCCT
    all.push_back(make_occt());
#endif
#ifdef BENCHMARK_SISL
    all.push_back(make_sisl());
#endif
#ifdef BENCHMARK_VTK
    all.push_back(make_vtk_locator());
    if (fine_mesh)
    {
      all.push_back(make_fine_vtk_locator());
    }
#endif
  }
  return all;
}

footpoint::Model model_of(const Shape& shape)
{
  footpoint::Face face;
  face.name = shape.name;
  face.patches = { footpoint::Patch{ shape.curve, shape.surface } };
  return { face };
}

} // namespace inversion_benchmark
