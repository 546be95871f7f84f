// SPDX-License-Identifier: BSD-3-Clause
// The middle of a straight line, through the installed headers and library of Footpoint::Core.
#include <footpoint/splines/curve.h>

#include <cmath>
#include <iostream>

int main()
{
  footpoint::Points ends(3, 2);
  ends.col(0) << 0.0, 0.0, 0.0;
  ends.col(1) << 2.0, 4.0, 6.0;
  const footpoint::Curve line(footpoint::KnotVector(1, { 0.0, 0.0, 1.0, 1.0 }), ends);

  const footpoint::Vector3 middle =
    line.centre() + line.point(line.to_local(footpoint::Parameter<1>(0.5)));
  const double error = (middle - footpoint::Vector3(1.0, 2.0, 3.0)).norm();
  if (!(error <= 1e-15))
  {
    std::cerr << "the middle is off by " << error << '\n';
    return 1;
  }
  return 0;
}
