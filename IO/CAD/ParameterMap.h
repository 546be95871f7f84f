// SPDX-License-Identifier: BSD-3-Clause
// Private: how a parameter of Open CASCADE's geometry becomes the parameter of our NURBS.
//
// B-splines, lines and extrusions keep their parameters. A circle is parametrized by the angle, a
// rational quadratic is not: on an arc of half angle a about its middle m the two are related by
//     tan((angle − m) / 2) = tan(a / 2) (2 s − 1),   s in [0, 1]
// (stereographic projection of the circle; L. Piegl and W. Tiller, The NURBS Book, section 7.3). A
// hyperbola has tanh in place of tan. The knots are angles, so both agree at knots.

#ifndef ParameterMap_h
#define ParameterMap_h

#include <vector>

namespace footpoint::cad
{

class ParameterMap
{
public:
  /// Our parameter is Open CASCADE's.
  static ParameterMap identity() { return ParameterMap(Kind::Identity, {}); }
  /// Arcs of a circle or an ellipse between knots that are angles (radians, ascending).
  static ParameterMap arcs(std::vector<double> knots)
  {
    return ParameterMap(Kind::Arcs, std::move(knots));
  }
  /// One arc of a hyperbola between two parameters.
  static ParameterMap hyperbola(double first, double last)
  {
    return ParameterMap(Kind::Hyperbola, { first, last });
  }

  bool is_identity() const { return this->What == Kind::Identity; }

  /// Our parameter; outside the knots the first or last arc is continued.
  double operator()(double parameter) const;

  /// Inner knots, where the map is not smooth.
  std::vector<double> kinks() const;

private:
  enum class Kind
  {
    Identity,
    Arcs,
    Hyperbola
  };
  ParameterMap(Kind kind, std::vector<double> knots)
    : What(kind)
    , Knots(std::move(knots))
  {
  }

  Kind What;
  std::vector<double> Knots;
};

/// Knots that cut a range of angles into equal arcs of at most a quarter turn.
std::vector<double> arc_knots(double first, double last);

} // namespace footpoint::cad

#endif
