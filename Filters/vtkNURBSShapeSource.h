// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNURBSShapeSource
 * @brief   shapes as exact NURBS: to start from without a file, and with known answers
 *
 * **Output**: the control net of a surface or curve, a vtkStructuredGrid with the field data
 * `KnotsU`, `KnotsV`, `Degree` and, where rational, active RationalWeights; for the teapot, and
 * with Capping, a vtkMultiBlockDataSet with a net for each face, named. All of it is geometry for
 * vtkPointInversionFilter. Normals point outwards, so that its SignedDistance is positive outside.
 *
 * | Shape     | options                                                     | degrees | exact   |
 * |-----------|-------------------------------------------------------------|---------|---------|
 * | Sphere    | Radius                                                      | 2, 2    | yes     |
 * | Cylinder  | Radius, Height, Capping                                     | 2, 1    | yes     |
 * | Cone      | Radius, Height, Capping                                     | 2, 1    | yes     |
 * | Torus     | Radius, CrossSectionRadius                                  | 2, 2    | yes     |
 * | Wing      | AirfoilDigits, Chord, Span, TaperRatio, SweepAngle,         | 8, 1    | see     |
 * |           | BluntTrailingEdge, Capping                                  |         | below   |
 * | ShipHull  | Length, Beam, Draft, Capping                                | 2, 2    | yes     |
 * | Teapot    |                                                             | 3, 3    | yes     |
 * | Bumpy     | Size, Amplitude, Resolution, Seed                           | 3, 3    | yes     |
 * | Circle    | Radius                                                      | 2       | yes     |
 * | Helix     | Radius, Height, Turns, HelixTolerance                       | 4       | no      |
 *
 * Center is for all of them. "Exact" means up to rounding. Cylinder, cone and helix reach from
 * -Height / 2 to Height / 2, the axis of round shapes is z.
 *
 * **Wing**: sections of the NACA 4-digit series (E. N. Jacobs et al., NACA Report 460, 1933)
 * between straight lines along the span. With x = u² of the chord the thickness, a polynomial in
 * the root of x, is a polynomial in u, and so is the camber line by pieces: both are exact.
 * Thickness counts along z; the report has it across the camber line, which is no rational curve
 * (airfoil 2412: 0.11 % of the chord away at most). u runs from the trailing edge below over the
 * nose (u = 0) to the trailing edge above, v = 2y / Span.
 *
 * **ShipHull**: y = ±Beam/2 (1 - (2x/Length)²)(1 - (z/Draft)²), the hull of W. C. S. Wigley (1934),
 * as two faces, Port (y > 0) and Starboard; v = z / Draft, u = 2x / Length, on the port side with
 * the other sign.
 *
 * **Teapot**: the 32 Bézier patches of M. E. Newell (1975) and F. C. Crow (1987) in their own
 * units, as four faces. Handle and spout go through the body: it is not one closed solid.
 *
 * **Bumpy**: a random height field over a square, the same numbers on every platform.
 *
 * **Helix**: right-handed. No NURBS curve is a helix. This one lies on its cylinder exactly and
 * differs in height by HelixTolerance × Radius at most; tangents are continuous.
 *
 * A dimension of which no shape can be made is an error that names it and its value; the output is
 * empty then.
 *
 * @sa
 * vtkPointInversionFilter vtkBezierExtraction
 */

#ifndef vtkNURBSShapeSource_h
#define vtkNURBSShapeSource_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkFootpointFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class VTKFOOTPOINTFILTERS_EXPORT vtkNURBSShapeSource : public vtkDataObjectAlgorithm
{
public:
  static vtkNURBSShapeSource* New();
  vtkTypeMacro(vtkNURBSShapeSource, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ShapeEnum
  {
    SPHERE = 0,
    CYLINDER = 1,
    CONE = 2,
    TORUS = 3,
    WING = 4,
    SHIP_HULL = 5,
    TEAPOT = 6,
    BUMPY = 7,
    CIRCLE = 8,
    HELIX = 9
  };

  ///@{
  /**
   * Which shape, see ShapeEnum. Default: SPHERE.
   */
  vtkSetClampMacro(Shape, int, SPHERE, HELIX);
  vtkGetMacro(Shape, int);
  void SetShapeToSphere() { this->SetShape(SPHERE); }
  void SetShapeToCylinder() { this->SetShape(CYLINDER); }
  void SetShapeToCone() { this->SetShape(CONE); }
  void SetShapeToTorus() { this->SetShape(TORUS); }
  void SetShapeToWing() { this->SetShape(WING); }
  void SetShapeToShipHull() { this->SetShape(SHIP_HULL); }
  void SetShapeToTeapot() { this->SetShape(TEAPOT); }
  void SetShapeToBumpy() { this->SetShape(BUMPY); }
  void SetShapeToCircle() { this->SetShape(CIRCLE); }
  void SetShapeToHelix() { this->SetShape(HELIX); }
  const char* GetShapeAsString() const;
  ///@}

  ///@{
  /**
   * Where the origin of the shape stands; its middle, of a wing the nose of its middle section, of
   * a hull the middle of its deck, of the teapot the middle of its bottom. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Of sphere, cylinder, cone (at the bottom), circle and helix; of the torus that of the circle of
   * its tube's centres. Default: 1.0.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Radius of the torus' tube, less than Radius. Default: 0.3.
   */
  vtkSetMacro(CrossSectionRadius, double);
  vtkGetMacro(CrossSectionRadius, double);
  ///@}

  ///@{
  /**
   * Of cylinder, cone and helix. Default: 2.0.
   */
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}

  ///@{
  /**
   * Close cylinder, cone, wing (tips and blunt trailing edge) and hull (deck) by further faces; the
   * output is a multi-block then. Default: off.
   */
  vtkSetMacro(Capping, bool);
  vtkGetMacro(Capping, bool);
  vtkBooleanMacro(Capping, bool);
  ///@}

  ///@{
  /**
   * The wing's section in the NACA 4-digit series: camber in % of the chord, its place in 10 %,
   * thickness in %. Default: "2412".
   */
  vtkSetStdStringFromCharMacro(AirfoilDigits);
  vtkGetCharFromStdStringMacro(AirfoilDigits);
  ///@}

  ///@{
  /**
   * Chord of the wing in its middle. Default: 1.0.
   */
  vtkSetMacro(Chord, double);
  vtkGetMacro(Chord, double);
  ///@}

  ///@{
  /**
   * Of the wing, from tip to tip. Default: 6.0.
   */
  vtkSetMacro(Span, double);
  vtkGetMacro(Span, double);
  ///@}

  ///@{
  /**
   * Chord of the wing at its tips as a fraction of Chord, 0.01 to 100. Default: 0.5.
   */
  vtkSetMacro(TaperRatio, double);
  vtkGetMacro(TaperRatio, double);
  ///@}

  ///@{
  /**
   * By how much the wing's leading edge is swept back, degrees, -80 to 80. Default: 15.0.
   */
  vtkSetMacro(SweepAngle, double);
  vtkGetMacro(SweepAngle, double);
  ///@}

  ///@{
  /**
   * Give the wing the trailing edge of the report, 0.21 % of the chord thick at 10 % thickness;
   * off: it is sharp, by the last coefficient of thickness 0.1036 in place of 0.1015. Default: off.
   */
  vtkSetMacro(BluntTrailingEdge, bool);
  vtkGetMacro(BluntTrailingEdge, bool);
  vtkBooleanMacro(BluntTrailingEdge, bool);
  ///@}

  ///@{
  /**
   * Of the hull, along x. Default: 10.0.
   */
  vtkSetMacro(Length, double);
  vtkGetMacro(Length, double);
  ///@}

  ///@{
  /**
   * Largest width of the hull. Default: 1.0.
   */
  vtkSetMacro(Beam, double);
  vtkGetMacro(Beam, double);
  ///@}

  ///@{
  /**
   * Depth of the hull below its deck. Default: 0.625.
   */
  vtkSetMacro(Draft, double);
  vtkGetMacro(Draft, double);
  ///@}

  ///@{
  /**
   * Edge of the bumpy patch' square. Default: 2.0.
   */
  vtkSetMacro(Size, double);
  vtkGetMacro(Size, double);
  ///@}

  ///@{
  /**
   * Largest height of the bumpy patch' control points. Default: 0.25.
   */
  vtkSetMacro(Amplitude, double);
  vtkGetMacro(Amplitude, double);
  ///@}

  ///@{
  /**
   * Knot spans of the bumpy patch in each direction, 1 to 1000. Default: 8.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Which bumpy patch. Default: 1.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Of the helix, at most 1000. Default: 3.0.
   */
  vtkSetMacro(Turns, double);
  vtkGetMacro(Turns, double);
  ///@}

  ///@{
  /**
   * How far the helix may be from a true one, as a fraction of Radius, 1e-10 to 1. Default: 1e-6.
   */
  vtkSetMacro(HelixTolerance, double);
  vtkGetMacro(HelixTolerance, double);
  ///@}

protected:
  vtkNURBSShapeSource();
  ~vtkNURBSShapeSource() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Shape = SPHERE;
  double Center[3] = { 0.0, 0.0, 0.0 };
  double Radius = 1.0;
  double CrossSectionRadius = 0.3;
  double Height = 2.0;
  bool Capping = false;
  std::string AirfoilDigits = "2412";
  double Chord = 1.0;
  double Span = 6.0;
  double TaperRatio = 0.5;
  double SweepAngle = 15.0;
  bool BluntTrailingEdge = false;
  double Length = 10.0;
  double Beam = 1.0;
  double Draft = 0.625;
  double Size = 2.0;
  double Amplitude = 0.25;
  int Resolution = 8;
  int Seed = 1;
  double Turns = 3.0;
  double HelixTolerance = 1e-6;

private:
  vtkNURBSShapeSource(const vtkNURBSShapeSource&) = delete;
  void operator=(const vtkNURBSShapeSource&) = delete;

  /// Whether the output is a multi-block of faces.
  bool MakesModel() const;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
