// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Models and expectations that the tests of PointInverter share.

#include "Shapes.h"

#include "footpoint/model/point_inversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace inversion
{

using footpoint::Face;
using footpoint::Foot;
using footpoint::FootType;
using footpoint::InversionOptions;
using footpoint::Model;
using footpoint::Parameter;
using footpoint::Patch;
using footpoint::PointInverter;
using footpoint::Status;
using footpoint::Vector3;

Patch patch_of(const footpoint::Curve& curve);
Patch patch_of(const footpoint::Surface& surface);
Face face_of_patches(std::vector<Patch> patches, bool reversed = false);

template <class Geometry>
Face face_of(const Geometry& geometry, bool reversed = false)
{
  return face_of_patches({ patch_of(geometry) }, reversed);
}

/// A model of one face a geometry.
template <class... Geometries>
Model model_of(const Geometries&... geometries)
{
  return { face_of(geometries)... };
}

/// The rectangle z = height over [x0, x1] × [0, 1], parameters x and y.
footpoint::Surface plate(double x0, double x1, double height = 0.0, double slope = 0.0);

footpoint::Points random_points(int count, std::uint64_t seed, double low, double high);
InversionOptions searching(footpoint::Search search);
InversionOptions all_feet();
InversionOptions orthogonal_only();
InversionOptions along(const Vector3& direction);

/// What a foot has to be. NaN: not looked at.
struct Expected
{
  double distance;
  Parameter<2> parameter = Parameter<2>::Constant(NAN); ///< curves: v = 0
  FootType type = FootType::Interior;
  bool isolated = true;
  Vector3 point = Vector3::Constant(NAN);
  /// Converged: or Certified, which is asked for where the nearest point is sought globally.
  Status status = Status::Converged;
  double tolerance = 1e-12;           ///< of the distance and the point, by the model's size
  double parameter_tolerance = 1e-10; ///< by the length of the domain
};

double domain_length(const Patch& patch, int i);

void expect_foot(const PointInverter& inverter, const Foot& foot, const Expected& expected,
  const std::string& what);

void expect_foot(const PointInverter& inverter, const Vector3& query, Expected expected);

/// All feet of a query, in their order.
void expect_all(
  const PointInverter& inverter, const Vector3& query, const std::vector<Expected>& expected);

/// Equal bit for bit, NaN like NaN.
bool identical(const Foot& a, const Foot& b);

} // namespace inversion
