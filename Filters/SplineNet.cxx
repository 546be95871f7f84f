// SPDX-License-Identifier: BSD-3-Clause
#include "SplineNet.h"

#include "FieldArrays.h"
#include "GridConversion.h"
#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkAlgorithm.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"

namespace footpoint::conversion
{

namespace
{

template <class Geometry>
void fill_points(const Geometry& geometry, vtkStructuredGrid* net)
{
  net->SetPoints(make_points(geometry.local_control_points().colwise() + geometry.centre()));
  if (geometry.rational())
  {
    const Eigen::VectorXd& weights = geometry.weights();
    set_numbers(net->GetPointData(), "RationalWeights",
      std::vector<double>(weights.data(), weights.data() + weights.size()));
    net->GetPointData()->SetActiveRationalWeights("RationalWeights");
  }
}

} // namespace

void fill_net(const Surface& surface, vtkStructuredGrid* net)
{
  const KnotVector& u = surface.knots(0);
  const KnotVector& v = surface.knots(1);
  net->SetDimensions(u.number_of_control_points(), v.number_of_control_points(), 1);
  fill_points(surface, net);
  set_numbers(net->GetFieldData(), "KnotsU", u.knots());
  set_numbers(net->GetFieldData(), "KnotsV", v.knots());
  set_integers(net->GetFieldData(), "Degree", std::vector<int>{ u.degree(), v.degree() });
}

void fill_net(const Curve& curve, vtkStructuredGrid* net)
{
  const KnotVector& u = curve.knots();
  net->SetDimensions(u.number_of_control_points(), 1, 1);
  fill_points(curve, net);
  set_numbers(net->GetFieldData(), "KnotsU", u.knots());
  set_integer(net->GetFieldData(), "Degree", u.degree());
}

Dimensions net_dimensions(const Surface* surface)
{
  return surface ? Dimensions{ { surface->knots(0).number_of_control_points(),
                     surface->knots(1).number_of_control_points(), 1 } }
                 : Dimensions{};
}

vtkStructuredGrid* write_net(vtkAlgorithm* algorithm, const Surface* surface,
  const std::string& error, vtkInformationVector* outputs)
{
  const Dimensions dimensions = net_dimensions(surface);
  const std::string problem = surface ? check_dimensions(outputs, dimensions) : error;
  if (!problem.empty())
  {
    vtkErrorWithObjectMacro(algorithm, << problem);
    return nullptr;
  }
  vtkStructuredGrid* net = vtkStructuredGrid::GetData(outputs);
  fill_net(*surface, net);
  return net;
}

std::vector<Curve> read_curves(const std::vector<vtkDataObject*>& data, const char* name)
{
  std::vector<Curve> curves;
  for (vtkDataObject* object : data)
  {
    const ConvertedModel converted = convert_to_model(object, false);
    const auto refuse = [&](std::size_t face, const std::string& message)
    {
      throw GeometryError(GeometryDefect::Format,
        std::string(name) + " " + std::to_string(curves.size() + face) + ": " + message);
    };
    if (!converted.problems.empty())
    {
      const Problem& problem = converted.problems.front();
      refuse(problem.face, problem.message);
    }
    for (const Face& face : converted.model)
    {
      for (const Patch& patch : face.patches)
      {
        const auto* curve = dynamic_cast<const Curve*>(patch.curve.get());
        if (!curve)
        {
          refuse(0, "it is no NURBS curve; a control net of dimensions (n, 1, 1) is needed");
        }
        curves.push_back(*curve);
      }
    }
  }
  return curves;
}

Curve reversed(const Curve& curve)
{
  const KnotVector& knots = curve.knots();
  const double sum = knots.domain_start() + knots.domain_end();
  std::vector<double> mirrored;
  for (auto knot = knots.knots().rbegin(); knot != knots.knots().rend(); ++knot)
  {
    mirrored.push_back(sum - *knot);
  }
  const Points points =
    (curve.local_control_points().colwise() + curve.centre()).rowwise().reverse();
  return Curve(KnotVector(knots.degree(), std::move(mirrored), knots.name()), points,
    curve.weights().reverse());
}

} // namespace footpoint::conversion
