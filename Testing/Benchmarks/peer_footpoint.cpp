// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include "footpoint/model/point_inversion.h"

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
    const footpoint::Foot foot = this->Inverter->find(point);
    return { foot.distance, foot.parameter, foot.status == footpoint::Status::Certified };
  }

private:
  std::unique_ptr<footpoint::PointInverter> Inverter;
};

} // namespace

std::unique_ptr<Peer> make_footpoint()
{
  return std::make_unique<Footpoint>();
}

std::vector<std::unique_ptr<Peer>> all_peers(bool ours_only)
{
  std::vector<std::unique_ptr<Peer>> all;
  all.push_back(make_footpoint());
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
