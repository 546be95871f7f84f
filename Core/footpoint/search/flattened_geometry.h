// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/parametric_geometry.h"

namespace footpoint
{

/// A geometry projected along a direction onto the plane through its centre: where the flattened
/// query lies on it, the line through the query meets the geometry. Not owning.
template <int N>
class FlattenedGeometry : public ParametricGeometry<N>
{
public:
  /// \param direction of unit length
  FlattenedGeometry(const ParametricGeometry<N>& geometry, const Vector3& direction)
    : Geometry(geometry)
    , Flatten(Eigen::Matrix3d::Identity() - direction * direction.transpose())
  {
    for (int i = 0; i < N; ++i)
    {
      this->Directions[i] = geometry.direction(i);
    }
    this->Centre = geometry.centre();
    this->Size = geometry.size();
  }

  Vector3 flatten(const Vector3& local_point) const { return this->Flatten * local_point; }

  Jet<N> jet(const Parameter<N>& t, const Sides<N>& sides, int order) const override
  {
    Jet<N> jet = this->Geometry.jet(t, sides, order);
    jet.point = this->Flatten * jet.point;
    jet.first = this->Flatten * jet.first;
    jet.second = this->Flatten * jet.second;
    jet.third = this->Flatten * jet.third;
    return jet;
  }

private:
  const ParametricGeometry<N>& Geometry;
  Eigen::Matrix3d Flatten;
};

} // namespace footpoint
