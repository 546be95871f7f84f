// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <ShapeAnalysis_Curve.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <algorithm>

namespace inversion_benchmark
{
namespace
{

/// Precision that is asked for, by the size of the geometry.
constexpr double kPrecision = 1e-7;

/// A knot vector as OCCT wants it: distinct knots and how often each is repeated.
struct Knots
{
  explicit Knots(const footpoint::KnotVector& knots)
  {
    for (const double knot : knots.knots())
    {
      if (this->values.empty() || this->values.back() < knot)
      {
        this->values.push_back(knot);
        this->counts.push_back(0);
      }
      ++this->counts.back();
    }
  }
  TColStd_Array1OfReal knots() const
  {
    TColStd_Array1OfReal array(1, static_cast<int>(this->values.size()));
    std::copy(this->values.begin(), this->values.end(), &array.ChangeFirst());
    return array;
  }
  TColStd_Array1OfInteger multiplicities() const
  {
    TColStd_Array1OfInteger array(1, static_cast<int>(this->counts.size()));
    std::copy(this->counts.begin(), this->counts.end(), &array.ChangeFirst());
    return array;
  }

  std::vector<double> values;
  std::vector<int> counts;
};

gp_Pnt pnt(const Vector3& p)
{
  return { p.x(), p.y(), p.z() };
}

opencascade::handle<Geom_BSplineSurface> convert(const footpoint::Surface& surface)
{
  const Knots u(surface.knots(0));
  const Knots v(surface.knots(1));
  const int nu = surface.knots(0).number_of_control_points();
  const int nv = surface.knots(1).number_of_control_points();
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  TColStd_Array2OfReal weights(1, nu, 1, nv);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const int at = j * nu + i;
      poles.SetValue(i + 1, j + 1, pnt(surface.local_control_points().col(at) + surface.centre()));
      weights.SetValue(i + 1, j + 1, surface.rational() ? surface.weights()[at] : 1.0);
    }
  }
  return new Geom_BSplineSurface(poles, weights, u.knots(), v.knots(), u.multiplicities(),
    v.multiplicities(), surface.knots(0).degree(), surface.knots(1).degree());
}

opencascade::handle<Geom_BSplineCurve> convert(const footpoint::Curve& curve)
{
  const Knots knots(curve.knots());
  const int n = curve.knots().number_of_control_points();
  TColgp_Array1OfPnt poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i)
  {
    poles.SetValue(i + 1, pnt(curve.local_control_points().col(i) + curve.centre()));
    weights.SetValue(i + 1, curve.rational() ? curve.weights()[i] : 1.0);
  }
  return new Geom_BSplineCurve(
    poles, weights, knots.knots(), knots.multiplicities(), curve.knots().degree());
}

class Occt : public Peer
{
public:
  std::string name() const override { return "OCCT"; }

  bool build(const Shape& shape) override
  {
    this->Precision = kPrecision * shape.size();
    this->Surface.Nullify();
    this->Curve.Nullify();
    if (shape.surface)
    {
      this->Surface = new ShapeAnalysis_Surface(convert(*shape.surface));
      // The first query builds what the others use.
      this->Surface->ValueOfUV(pnt(shape.control_points().rowwise().mean()), this->Precision);
    }
    else
    {
      this->Curve = convert(*shape.curve);
    }
    return true;
  }

  Answer project(const Vector3& point) override
  {
    Answer answer;
    if (!this->Surface.IsNull())
    {
      const gp_Pnt2d uv = this->Surface->ValueOfUV(pnt(point), this->Precision);
      answer.distance = this->Surface->Gap();
      answer.parameter = { uv.X(), uv.Y() };
    }
    else
    {
      gp_Pnt foot;
      double t = 0.0;
      answer.distance =
        ShapeAnalysis_Curve().Project(this->Curve, pnt(point), this->Precision, foot, t);
      answer.parameter = { t, 0.0 };
    }
    return answer;
  }

private:
  double Precision = 0.0;
  opencascade::handle<ShapeAnalysis_Surface> Surface;
  opencascade::handle<Geom_BSplineCurve> Curve;
};

} // namespace

std::unique_ptr<Peer> make_occt()
{
  return std::make_unique<Occt>();
}

} // namespace inversion_benchmark
