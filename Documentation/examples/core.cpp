// SPDX-License-Identifier: BSD-3-Clause
// Foot points without VTK: the whole of a parabola, built once, asked often.
#include <footpoint/model/point_inversion.h>

#include <cmath>
#include <iostream>

int main()
{
  // y = x² for x in [-2, 2], with the parameter t = x.
  footpoint::Points poles(3, 3);
  poles << -2, 0, 2, // x
    4, -4, 4,        // y
    0, 0, 0;         // z
  footpoint::Face face;
  face.patches.emplace_back();
  face.patches.back().curve = std::make_shared<footpoint::Curve>(
    footpoint::KnotVector(2, { -2, -2, -2, 2, 2, 2 }), poles);

  try
  {
    const footpoint::PointInverter inverter({ face });
    const footpoint::Foot foot = inverter.find({ 3.0, 0.5, 0.0 });
    std::cout << "t = " << foot.parameter[0] << ", distance " << foot.distance << '\n';
    // The foot of (3, h) solves 2 t³ + (1 - 2 h) t - 3 = 0; with h = 1/2 it is the root ∛(3/2).
    return std::abs(foot.parameter[0] - std::cbrt(1.5)) < 1e-12 ? 0 : 1;
  }
  catch (const footpoint::GeometryError& error)
  {
    std::cerr << error.what() << '\n'; // names the array, the index and the value
    return 1;
  }
}
