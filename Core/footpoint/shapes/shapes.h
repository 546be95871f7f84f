// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace footpoint
{

/// A dimension of a shape that makes none; the message names it and its value, e.g. "Radius = -1".
class ShapeError : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// A face of a shape; its normal S_u × S_v points outwards.
struct NamedSurface
{
  std::string name;
  Surface surface;
};

/// The faces of a shape; the first one is the shape itself, the others close it.
using Shape = std::vector<NamedSurface>;

// All lengths are in model units, finite and positive; all shapes lie around the origin; parameters
// of u run over [0, 1] or [−1, 1] as is said. Errors are ShapeErrors. Closed surfaces and curves
// are rational of degree 2 with circles of four quarters, weights 1 and √½ (L. Piegl and W. Tiller,
// The NURBS Book, 1997, sections 7.5 and 8.5), exact up to rounding; poles are collapsed sides.

/// The circle in the plane z = 0 from (radius, 0, 0) counter-clockwise, on [0, 1].
Curve circle(double radius);

/// The sphere; u around z, v from the south pole to the north pole, on [0, 1]².
Shape sphere(double radius);

/// The torus around z; u around z, v around the tube, on [0, 1]².
/// \param cross_section_radius of the tube, less than the radius of the circle of its centres
Shape torus(double radius, double cross_section_radius);

/// The cylinder around z, |z| ≤ height / 2; u around z, v upwards, on [0, 1]².
/// \param capping adds the faces "Bottom" and "Top"
Shape cylinder(double radius, double height, bool capping);

/// The cone around z: radius at z = −height / 2, apex (a pole, v = 1) at z = height / 2; on [0,
/// 1]². \param capping adds the face "Bottom"
Shape cone(double radius, double height, bool capping);

/// A wing with sections of the NACA 4-digit series (E. N. Jacobs, K. E. Ward and R. M. Pinkerton,
/// NACA Report 460, 1933).
struct WingOptions
{
  std::string airfoil_digits =
    "2412";                         ///< four digits: camber in %, its place in 10 %, thickness in %
  double chord = 1.0;               ///< at the root
  double span = 6.0;                ///< from tip to tip, along y
  double taper_ratio = 0.5;         ///< chord at the tips / chord at the root
  double sweep_angle = 15.0;        ///< of the leading edge, degrees, in (−90, 90)
  bool blunt_trailing_edge = false; ///< as NACA published it; else closed
  bool capping = false;             ///< adds "Right tip", "Left tip" and, if blunt, "Trailing edge"
};

/// The wing as one polynomial surface of degrees (8, 1) on [−1, 1]²: x = u² of the chord, below
/// where u < 0, above where u > 0, nose at u = 0; v = 2y / span; x backwards, z up, nose of the
/// root at the origin. The section is exactly z = camber(x) ± thickness(x)/2 with the polynomials
/// of the report; thickness counts along z, not across the camber line as in the report, which is
/// not rational. The wing is straight between root and tips, a kink at v = 0 unless taper is 1 and
/// sweep 0.
Shape wing(const WingOptions& options);

/// The hull of W. C. S. Wigley (1934), y = ±beam/2 (1 − (2x/length)²)(1 − (z/draft)²) for
/// −draft ≤ z ≤ 0, as two polynomial surfaces of degree 2 on [−1, 1] × [−1, 0], "Port" (y ≥ 0) and
/// "Starboard": v = z / draft, u = ∓2x / length.
/// \param capping adds the face "Deck", z = 0
Shape ship_hull(double length, double beam, double draft, bool capping);

/// The teapot of M. E. Newell (1975), with the bottom of F. C. Crow (1987): 32 bicubic patches in
/// their own units, z upwards, as four polynomial surfaces "Body" (with rim and bottom), "Lid",
/// "Handle" and "Spout". Handle and spout go through the body, so that it is no closed solid.
Shape teapot();

/// A random bicubic C² B-spline height field over the square [−size/2, size/2]²; x and y are linear
/// in (u, v) ∈ [0, 1]², |z| ≤ amplitude.
/// \param resolution knot spans in each direction, 1 … 1000
/// \param seed       the same numbers on every platform (SplitMix64, G. L. Steele et al. 2014)
Shape bumpy_patch(double size, double amplitude, int resolution, std::uint64_t seed);

/// A right-handed helix around z, |z| ≤ height / 2, from angle 0 at the bottom, as a rational curve
/// of degree 4 on [0, 1], tangent-continuous; no NURBS is a helix exactly. It lies on its cylinder
/// exactly, and at equal angles its height differs by helix_deviation() at most.
/// \param turns     positive, at most 1000
/// \param tolerance largest deviation as a fraction of the radius, 1e-10 … 1; sets the number of
/// arcs
Curve helix(double radius, double height, double turns, double tolerance);

/// Largest distance between a helix of that rise per radian, and its arc of that angle in degree 4.
/// \param half_angle of an arc, radians, in (0, π/2)
double helix_deviation(double rise, double half_angle);

} // namespace footpoint
