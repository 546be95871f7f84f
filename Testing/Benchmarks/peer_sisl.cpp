// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include <sisl.h>

#include <cstdlib>

namespace inversion_benchmark
{
namespace
{

/// Geometric resolution that is asked for, by the size of the geometry.
constexpr double kResolution = 1e-10;

struct FreeSurface
{
  void operator()(SISLSurf* surface) const { freeSurf(surface); }
};
struct FreeCurve
{
  void operator()(SISLCurve* curve) const { freeCurve(curve); }
};

/// Cartesian coordinates, or (w·x, w·y, w·z, w) of rational geometry.
template <class Geometry>
std::vector<double> coefficients(const Geometry& geometry)
{
  const Points net = geometry.local_control_points().colwise() + geometry.centre();
  std::vector<double> all;
  for (Eigen::Index k = 0; k < net.cols(); ++k)
  {
    const double weight = geometry.rational() ? geometry.weights()[k] : 1.0;
    const Vector3 homogeneous = weight * net.col(k);
    all.insert(all.end(), homogeneous.data(), homogeneous.data() + 3);
    if (geometry.rational())
    {
      all.push_back(weight);
    }
  }
  return all;
}

class Sisl : public Peer
{
public:
  std::string name() const override { return "SISL"; }

  bool build(const Shape& shape) override
  {
    this->Resolution = kResolution * shape.size();
    this->Surface.reset();
    this->Curve.reset();
    const int copied = 1;
    if (shape.surface)
    {
      const footpoint::Surface& s = *shape.surface;
      std::vector<double> net = coefficients(s);
      std::vector<double> u = s.knots(0).knots();
      std::vector<double> v = s.knots(1).knots();
      this->Surface.reset(newSurf(s.knots(0).number_of_control_points(),
        s.knots(1).number_of_control_points(), s.knots(0).degree() + 1, s.knots(1).degree() + 1,
        u.data(), v.data(), net.data(), s.rational() ? 2 : 1, 3, copied));
      return this->Surface != nullptr;
    }
    const footpoint::Curve& c = *shape.curve;
    std::vector<double> net = coefficients(c);
    std::vector<double> knots = c.knots().knots();
    this->Curve.reset(newCurve(c.knots().number_of_control_points(), c.knots().degree() + 1,
      knots.data(), net.data(), c.rational() ? 2 : 1, 3, copied));
    return this->Curve != nullptr;
  }

  Answer project(const Vector3& point) override
  {
    Vector3 p = point;
    int count = 0;
    double* parameters = nullptr;
    int curve_count = 0;
    SISLIntcurve** curves = nullptr;
    int status = 0;
    const double computational = 1e-15; // SISL ignores it
    if (this->Surface)
    {
      s1954(this->Surface.get(), p.data(), 3, computational, this->Resolution, &count, &parameters,
        &curve_count, &curves, &status);
    }
    else
    {
      s1953(this->Curve.get(), p.data(), 3, computational, this->Resolution, &count, &parameters,
        &curve_count, &curves, &status);
    }
    Answer answer;
    if (status >= 0 && count > 0)
    {
      this->take(parameters, point, answer);
    }
    else if (status >= 0 && curve_count > 0)
    {
      this->take(curves[0]->epar1, point, answer); // a continuum: one place of it
    }
    std::free(parameters);
    if (curves != nullptr)
    {
      freeIntcrvlist(curves, curve_count);
    }
    return answer;
  }

private:
  /// The distance to the point at the given parameters.
  void take(double* parameters, const Vector3& point, Answer& answer)
  {
    int status = 0;
    Vector3 foot;
    if (this->Surface)
    {
      int left_u = 0;
      int left_v = 0;
      Vector3 normal;
      s1421(
        this->Surface.get(), 0, parameters, &left_u, &left_v, foot.data(), normal.data(), &status);
    }
    else
    {
      int left = 0;
      s1221(this->Curve.get(), 0, parameters[0], &left, foot.data(), &status);
    }
    answer.parameter = { parameters[0], this->Surface ? parameters[1] : 0.0 };
    answer.distance = (foot - point).norm();
  }

  double Resolution = 0.0;
  std::unique_ptr<SISLSurf, FreeSurface> Surface;
  std::unique_ptr<SISLCurve, FreeCurve> Curve;
};

} // namespace

std::unique_ptr<Peer> make_sisl()
{
  return std::make_unique<Sisl>();
}

} // namespace inversion_benchmark
