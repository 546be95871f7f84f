// SPDX-License-Identifier: BSD-3-Clause

#include "ShapeChecks.h"

namespace shape_checks
{

Vector3 at(const Surface& surface, double u, double v)
{
  return surface.point(surface.to_local({ u, v })) + surface.centre();
}

Vector3 at(const Curve& curve, double u)
{
  return curve.point(curve.to_local(Parameter<1>(u))) + curve.centre();
}

double volume(const Shape& shape)
{
  constexpr double kNodes[] = { 0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
    -0.9061798459386640 };
  constexpr double kWeights[] = { 0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
    0.2369268850561891, 0.2369268850561891 };
  constexpr int kParts = 8;
  double sum = 0.0;
  for (const auto& face : shape)
  {
    const Surface& surface = face.surface;
    const auto& u = surface.direction(0).spans;
    const auto& v = surface.direction(1).spans;
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
    {
      for (std::size_t j = 0; j + 1 < v.size(); ++j)
      {
        const double hu = 0.5 * (u[i + 1] - u[i]) / kParts;
        const double hv = 0.5 * (v[j + 1] - v[j]) / kParts;
        for (int part = 0; part < kParts * kParts; ++part)
        {
          for (int g = 0; g < 25; ++g)
          {
            const Parameter<2> t(u[i] + hu * (2 * (part % kParts) + 1 + kNodes[g % 5]),
              v[j] + hv * (2 * (part / kParts) + 1 + kNodes[g / 5]));
            const auto jet = surface.jet(t, Sides<2>::Constant(Side::Right), 1);
            const Vector3 normal = jet.first.col(0).cross(jet.first.col(1));
            sum += kWeights[g % 5] * kWeights[g / 5] * hu * hv *
              (jet.point + surface.centre()).dot(normal) / 3.0;
          }
        }
      }
    }
  }
  return sum;
}

} // namespace shape_checks
