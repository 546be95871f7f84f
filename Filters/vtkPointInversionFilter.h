// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointInversionFilter
 * @brief   foot points and parameters of given points on exact spline geometry
 *
 * For every point P of the input the filter finds the nearest point Q of the source geometry, its
 * parameters and the distance. The geometry is evaluated exactly: nothing is tessellated.
 *
 * **Input port 0**: a vtkPointSet or a vtkCompositeDataSet of vtkDataSet leaves, taken whole.
 *
 * **Input port 1** ("Source", SetSourceConnection() or SetSourceData()): the geometry, taken whole
 * on every rank. It is optional because SetParametricFunction() may give the geometry instead; a
 * source goes before a parametric function. Geometry is one of
 * - a surface: a vtkStructuredGrid of control points with dimensions (nu, nv, 1), field data
 *   `KnotsU`, `KnotsV` (full knot vectors), `Degree` (2 ints, optional) and weights in the point
 *   data's active RationalWeights attribute or a point array of that name;
 * - a curve: the same with dimensions (n, 1, 1) and `KnotsU` alone;
 * - a vtkUnstructuredGrid of VTK_BEZIER_CURVE and VTK_BEZIER_QUADRILATERAL cells: patches on [0, 1]
 *   or on the range in the cell array `ParameterRange` (u0, u1[, v0, v1]); cells with the same
 *   value of the cell array `FaceId` are one face, whose number that value is (in models: plus the
 *   numbers used up before); without it every cell is a face;
 * - a trimmed face: a vtkMultiBlockDataSet with the block `Surface`, a control net, and blocks
 *   `Loop 0`, `Loop 1`, …, each a vtkMultiBlockDataSet of curves in the (u, v) plane (z = 0), head
 * to tail; a curve without `KnotsU`, or a line of vtkPolyData, is a polyline. Counter-clockwise
 * loops keep their inside, clockwise ones are holes. Gaps in a loop are closed up to the field data
 *   `Tolerance` of the surface (model units);
 * - a composite data set of those: a model whose faces are numbered from 0 in order; an empty
 *   block uses up its number. The field data `FaceName`, `Orientation` (−1: reversed) and
 *   `Tolerance` of a leaf belong to its face; those of Bézier cells have one value for all faces or
 *   one for each.
 *
 * **Output port 0**: the input with the point arrays below, of the same type and structure.
 * An existing array of one of these names is replaced. Every block gets the same arrays.
 *
 * | array            | type      | meaning                                                     |
 * |------------------|-----------|-------------------------------------------------------------|
 * | `Parameters`     | double, 2 | (u, v) in the own domain, curves (u, 0); 1 in models of curves |
 * | `Distance`       | double    | abs(P − Q)                                                  |
 * | `SignedDistance` | double    | sign of (P − Q)·Normal, sign(0) = +1; NaN on curves         |
 * | `ClosestPoint`   | double, 3 | Q                                                           |
 * | `Normal`         | double, 3 | unit surface normal at Q (at poles its limit); NaN on curves |
 * | `Tangent`        | double, 3 | unit tangent of a curve at Q; NaN on surfaces               |
 * | `FaceId`         | vtkIdType | the face of Q                                               |
 * | `Status`         | int       | see StatusEnum                                              |
 * | `FootType`       | int       | see FootTypeEnum                                            |
 * | `Isolated`       | int       | 0 where a continuum of points is equally near, else 1       |
 * | `Iterations`     | int       | of the local solver                                         |
 *
 * `SignedDistance` and `Normal` exist where the geometry has surfaces, `Tangent` where it has
 * curves.
 * At Status 3 (BeyondMaximumDistance; also a line along FixedDirection that meets nothing) and 4
 * (InvalidPoint) floating arrays hold NaN and integer
 * ones −1. `SignedDistance`, on models of curves alone `Distance`, becomes the active scalars.
 * The input's active normals stay what they are.
 *
 * The output's field data receives statistics of SignedDistance (Distance on models of curves)
 * over all blocks and ranks together, without ghost and hidden points: `DistanceCount`,
 * `DistanceMinimum`, `DistanceMaximum`, `DistanceMean`, `DistanceRMS`, `DistanceStandardDeviation`,
 * `DistancePercentile95` (of the absolute distance, nearest rank), `StatusCounts` (6 values) and
 * `OutOfToleranceFraction` (see SetDeviationTolerance()). `OpenEdges` is the number of borders of
 * faces without a neighbour: where it is 0 and the normals point outward, as on a solid, negative
 * distances are inside. At edges and vertices the sign is that of the sum of the normals of all
 * faces that meet there, weighted by their angles (J. A. Bærentzen and H. Aanæs 2005).
 *
 * **Output port 1**: the foot points as vtkPolyData, of points with a foot only, with the same
 * arrays, `PointId` (the point's number in its block) and, for composite inputs, `BlockId` (the
 * block's flat composite index). See SetFootSegments(), SetAllFeet() and SetFixedDirection().
 * `Normal` is the active normals. Where every point has just one row, both outputs share the
 * arrays, and `ClosestPoint` its numbers with the points.
 *
 * **Output port 2**: a vtkTable with a row for every face: `FaceId`, `Name`, `Count` of points
 * whose foot is on the face, and of their SignedDistance (curves: Distance) `Minimum`, `Maximum`,
 * `MaximumAbsolute`, `Mean`, `RMS`, `StandardDeviation`, `Percentile95`, `OutOfToleranceFraction`;
 * and, in model units, the face's `Tolerance` and the `LargestGap` that was closed in its trim
 * loops.
 *
 * If the input has a point array `SeedParameters` (1 or 2 components), its values are tried as
 * starting parameters (not for the nearest point of Search GLOBAL, which needs none), on the face
 * in the point array `SeedFaceId` where that exists and is not negative; NaN or missing values mean
 * automatic starts. Otherwise results depend neither on the order of points nor on the number of
 * threads and ranks, bit for bit; see SetWarmStart().
 *
 * **Threads**: those of vtkSMPTools. Where neither a back end nor a number of threads was chosen,
 * by the program or by VTK_SMP_BACKEND_IN_USE and VTK_SMP_MAX_THREADS, a single process uses all
 * cores also where VTK is sequential by default, and several on a machine share its cores out.
 *
 * **Ranks** (see SetController()): points are distributed, each rank inverts its own; the geometry
 * is the same for all. Where not all ranks have the same source, which they compare by content, the
 * parts are sent to all and put together: an empty or missing source or block gives way to that of
 * another rank, parts of one control net (equal field data, another extent) become the net again,
 * Bézier cells of all ranks follow each other, and what else differs stands side by side in the
 * order of the ranks, which numbers the faces. Statistics are those of the points of all ranks: on
 * every rank in the field data, on rank 0 in the table, whose columns are empty on the others. The
 * bits of all results are the same for any number of ranks; points that several ranks have, as at
 * the borders of pieces without ghost marks, count several times in statistics. An error on one
 * rank is an error on all, and an abort ends all. As with every VTK filter that communicates, all
 * ranks have to update it, with data or without, and all or none have to have something new (else
 * call Modified() on all): where VTK does not run it on one, or its input failed there, the others
 * wait.
 *
 * Bad geometry is an error that names the array, the index and the value; the outputs are empty.
 * Where a model has good faces besides, there is a warning instead, the bad face is left out (its
 * number stays in use) and the others go on.
 *
 * @sa
 * vtkSplineEvaluator
 */

#ifndef vtkPointInversionFilter_h
#define vtkPointInversionFilter_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkFootpointFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkMultiProcessController;
class vtkParametricFunction;
class vtkPolyData;
class vtkTable;

class VTKFOOTPOINTFILTERS_EXPORT vtkPointInversionFilter : public vtkDataObjectAlgorithm
{
public:
  static vtkPointInversionFilter* New();
  vtkTypeMacro(vtkPointInversionFilter, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How the foot is sought.
  enum SearchEnum
  {
    GLOBAL = 0, ///< in every piece of the geometry that may hold a nearer point; certifies
    SEEDED = 1, ///< by descents from the best samples of a coarse grid on every face
    LOCAL = 2   ///< by one descent: from the given start, else from the best sample
  };

  /// The step of the local solver; those from FIRST_ORDER on are for curves alone.
  enum MethodEnum
  {
    NEWTON = 0,
    GAUSS_NEWTON = 1,
    LEVENBERG_MARQUARDT = 2,
    SECOND_ORDER = 3,     ///< Newton in the geometry's own metric
    FIRST_ORDER = 4,      ///< projection onto the tangent
    CURVATURE_CIRCLE = 5, ///< projection onto the osculating circle (Hu and Wallner 2005)
    SECOND_ORDER_1 = 6,   ///< second-order Method 1
    SECOND_ORDER_2 = 7,   ///< second-order Method 2
    SECOND_ORDER_3 = 8    ///< second-order Method 3
  };

  /// Values of the array `Status`.
  enum StatusEnum
  {
    CERTIFIED = 0,     ///< proved: no point is nearer by more than CertificateTolerance
    CONVERGED = 1,     ///< a local minimum of the distance, or where a line meets the geometry
    NOT_CONVERGED = 2, ///< the best point found
    BEYOND_MAXIMUM_DISTANCE = 3, ///< nothing within MaximumDistance; a line that meets nothing
    INVALID_POINT = 4,           ///< a coordinate is NaN or infinite
    NO_ORTHOGONAL_FOOT = 5       ///< OrthogonalOnly: none exists, the closest point is given
  };

  /// Values of the array `FootType`.
  enum FootTypeEnum
  {
    INTERIOR = 0,  ///< an orthogonal foot
    EDGE = 1,      ///< on the boundary of a surface or of a gap
    VERTEX = 2,    ///< corner of a surface, end of a curve
    KINK = 3,      ///< on a C0 line or point inside
    DEGENERATE = 4 ///< pole or collapsed edge
  };

  ///@{
  /**
   * The geometry as second input, as a connection or as data.
   */
  void SetSourceConnection(vtkAlgorithmOutput* algorithmOutput);
  void SetSourceData(vtkDataObject* source);
  vtkDataObject* GetSource();
  ///@}

  ///@{
  /**
   * A parametric curve or surface as geometry, used where there is no source. Derivatives are
   * taken by differences, feet are searched from seeds. Default: none.
   */
  virtual void SetParametricFunction(vtkParametricFunction* function);
  vtkGetObjectMacro(ParametricFunction, vtkParametricFunction);
  ///@}

  ///@{
  /**
   * The ranks that run this filter together, see above; null: this one alone. Set the same on all.
   * Default: the global controller of the time when the filter was made.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * How the foot is sought, see SearchEnum. Default: GLOBAL.
   *
   * GLOBAL proves that its foot is the nearest point of curves and surfaces that are splines
   * (Status CERTIFIED, see SetCertificateTolerance()); parametric functions are searched from
   * seeds. Its search has starts and steps of its own. For the plain nearest point of splines it
   * therefore takes no notice of Method, SeedResolution, NumberOfSeeds, `SeedParameters` and
   * WarmStart; TrustRadius, MaximumIterations, ColumnScaling, IsocurveFallback and the tolerances
   * of the iteration reach only the descents that settle feet on borders, kinks and poles, and
   * those that are tried where the proof does not succeed (there Method acts, too). All of them act
   * with SEEDED and LOCAL. Method and the options of the iteration also act where AllFeet,
   * OrthogonalOnly or FixedDirection is set, and on parametric functions, where `SeedParameters`
   * and WarmStart are further starts. SeedResolution and NumberOfSeeds never act with GLOBAL.
   */
  vtkSetClampMacro(Search, int, GLOBAL, LOCAL);
  vtkGetMacro(Search, int);
  void SetSearchToGlobal() { this->SetSearch(GLOBAL); }
  void SetSearchToSeeded() { this->SetSearch(SEEDED); }
  void SetSearchToLocal() { this->SetSearch(LOCAL); }
  const char* GetSearchAsString() const;
  ///@}

  ///@{
  /**
   * The step of the local solver, see MethodEnum. Geometry with surfaces is refused by the methods
   * for curves. Does not act on the plain nearest point of GLOBAL, see SetSearch().
   * Default: NEWTON.
   */
  vtkSetClampMacro(Method, int, NEWTON, SECOND_ORDER_3);
  vtkGetMacro(Method, int);
  void SetMethodToNewton() { this->SetMethod(NEWTON); }
  void SetMethodToGaussNewton() { this->SetMethod(GAUSS_NEWTON); }
  void SetMethodToLevenbergMarquardt() { this->SetMethod(LEVENBERG_MARQUARDT); }
  void SetMethodToSecondOrder() { this->SetMethod(SECOND_ORDER); }
  void SetMethodToFirstOrder() { this->SetMethod(FIRST_ORDER); }
  void SetMethodToCurvatureCircle() { this->SetMethod(CURVATURE_CIRCLE); }
  void SetMethodToSecondOrder1() { this->SetMethod(SECOND_ORDER_1); }
  void SetMethodToSecondOrder2() { this->SetMethod(SECOND_ORDER_2); }
  void SetMethodToSecondOrder3() { this->SetMethod(SECOND_ORDER_3); }
  const char* GetMethodAsString() const;
  ///@}

  ///@{
  /**
   * A point nearer than this fraction of the geometry's size (diagonal of the control points'
   * bounding box) counts as lying on it. Default: 1e-14.
   */
  vtkSetClampMacro(PointTolerance, double, 0.0, 1.0);
  vtkGetMacro(PointTolerance, double);
  ///@}

  ///@{
  /**
   * Cosine between P − Q and the tangents below which a foot is orthogonal. Default: 1e-12.
   */
  vtkSetClampMacro(CosineTolerance, double, 0.0, 1.0);
  vtkGetMacro(CosineTolerance, double);
  ///@}

  ///@{
  /**
   * A step in space shorter than this fraction of the geometry's size ends the iteration.
   * Default: 1e-15.
   */
  vtkSetClampMacro(StepTolerance, double, 0.0, 1.0);
  vtkGetMacro(StepTolerance, double);
  ///@}

  ///@{
  /**
   * Most iterations of a local search; see SetSearch() for GLOBAL. Default: 100.
   */
  vtkSetClampMacro(MaximumIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Longest step in space, as a fraction of the geometry's size; see SetSearch() for GLOBAL.
   * Default: 0.5.
   */
  vtkSetClampMacro(TrustRadius, double, 1e-6, VTK_DOUBLE_MAX);
  vtkGetMacro(TrustRadius, double);
  ///@}

  ///@{
  /**
   * Normalise the columns of the Jacobian, for speeds that differ by powers of ten. Default: on.
   */
  vtkSetMacro(ColumnScaling, bool);
  vtkGetMacro(ColumnScaling, bool);
  vtkBooleanMacro(ColumnScaling, bool);
  ///@}

  ///@{
  /**
   * Surfaces: steps along u, then v, where the step in both is rejected. Default: on.
   */
  vtkSetMacro(IsocurveFallback, bool);
  vtkGetMacro(IsocurveFallback, bool);
  vtkBooleanMacro(IsocurveFallback, bool);
  ///@}

  ///@{
  /**
   * Samples in each direction of the coarse grid that seeds come from, with SEEDED and LOCAL;
   * the search structure holds them, so another resolution builds it anew. Default: 7.
   */
  vtkSetClampMacro(SeedResolution, int, 2, 1000);
  vtkGetMacro(SeedResolution, int);
  ///@}

  ///@{
  /**
   * How many of the grid's best samples are descended from, with SEEDED. Default: 4.
   */
  vtkSetClampMacro(NumberOfSeeds, int, 1, 1000);
  vtkGetMacro(NumberOfSeeds, int);
  ///@}

  ///@{
  /**
   * What Status CERTIFIED proves: no point of the geometry is nearer than Distance minus this
   * fraction of the geometry's size. With 0, or below the rounding of the proof (1e-14 to 1e-13),
   * nothing is certified; feet are the same to rounding and take longer, since further descents
   * are tried where nothing is proved. Search GLOBAL only. Default: 1e-12.
   */
  vtkSetClampMacro(CertificateTolerance, double, 0.0, 1.0);
  vtkGetMacro(CertificateTolerance, double);
  ///@}

  ///@{
  /**
   * Points farther from the geometry get Status BEYOND_MAXIMUM_DISTANCE, in model units.
   * VTK_DOUBLE_MAX means no limit. Default: VTK_DOUBLE_MAX (1e299).
   */
  vtkSetClampMacro(MaximumDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumDistance, double);
  ///@}

  ///@{
  /**
   * Find the nearest foot where P − Q is orthogonal to the geometry, be it a minimum or not.
   * Default: off.
   */
  vtkSetMacro(OrthogonalOnly, bool);
  vtkGetMacro(OrthogonalOnly, bool);
  vtkBooleanMacro(OrthogonalOnly, bool);
  ///@}

  ///@{
  /**
   * Put every local minimum of the distance on output 1, nearest first, tagged with `PointId`;
   * output 0 gets the nearest. Default: off.
   */
  vtkSetMacro(AllFeet, bool);
  vtkGetMacro(AllFeet, bool);
  vtkBooleanMacro(AllFeet, bool);
  ///@}

  ///@{
  /**
   * If not zero: instead of the nearest point, where the line through P along this vector meets the
   * geometry. Distances are measured along the line. All intersections go to output 1, nearest
   * first, tagged with `PointId`; output 0 gets the nearest. A line that meets nothing within
   * MaximumDistance has Status BEYOND_MAXIMUM_DISTANCE. Refused together with AllFeet or
   * OrthogonalOnly. Default: (0, 0, 0), off.
   */
  vtkSetVector3Macro(FixedDirection, double);
  vtkGetVector3Macro(FixedDirection, double);
  ///@}

  ///@{
  /**
   * Start each point from the foot of the one before it in its block, for points along a path. The
   * only mode in which results depend on the order of points; one thread. It acts with SEEDED and
   * LOCAL; the certified nearest point of GLOBAL depends on no start. It takes no `SeedParameters`
   * and is refused together with AllFeet or FixedDirection. Default: off.
   */
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}

  ///@{
  /**
   * Reverse the normals of all surfaces, and with them the sign of `SignedDistance`.
   * Default: off.
   */
  vtkSetMacro(FlipNormals, bool);
  vtkGetMacro(FlipNormals, bool);
  vtkBooleanMacro(FlipNormals, bool);
  ///@}

  ///@{
  /**
   * Absolute distance, in model units, above which a point counts in `OutOfToleranceFraction`.
   * Default: VTK_DOUBLE_MAX (1e299), so that none does.
   */
  vtkSetClampMacro(DeviationTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DeviationTolerance, double);
  ///@}

  ///@{
  /**
   * Put segments from each point to its foot on output 1 instead of vertices: points 2i (the
   * point) and 2i + 1 (its foot), both with the arrays of the foot. Default: off.
   */
  vtkSetMacro(FootSegments, bool);
  vtkGetMacro(FootSegments, bool);
  vtkBooleanMacro(FootSegments, bool);
  ///@}

  ///@{
  /**
   * Put before the name of every array that this filter makes on outputs 0 and 1, statistics
   * included, so that two filters in a row do not replace each other's. Default: "" (none).
   */
  vtkSetStdStringFromCharMacro(ArrayNamePrefix);
  vtkGetCharFromStdStringMacro(ArrayNamePrefix);
  ///@}

  ///@{
  /**
   * Which point arrays are made on outputs 0 and 1. Default: all on.
   */
  vtkSetMacro(GenerateParameters, bool);
  vtkGetMacro(GenerateParameters, bool);
  vtkBooleanMacro(GenerateParameters, bool);
  vtkSetMacro(GenerateDistance, bool);
  vtkGetMacro(GenerateDistance, bool);
  vtkBooleanMacro(GenerateDistance, bool);
  vtkSetMacro(GenerateSignedDistance, bool);
  vtkGetMacro(GenerateSignedDistance, bool);
  vtkBooleanMacro(GenerateSignedDistance, bool);
  vtkSetMacro(GenerateClosestPoint, bool);
  vtkGetMacro(GenerateClosestPoint, bool);
  vtkBooleanMacro(GenerateClosestPoint, bool);
  vtkSetMacro(GenerateNormal, bool);
  vtkGetMacro(GenerateNormal, bool);
  vtkBooleanMacro(GenerateNormal, bool);
  vtkSetMacro(GenerateTangent, bool);
  vtkGetMacro(GenerateTangent, bool);
  vtkBooleanMacro(GenerateTangent, bool);
  vtkSetMacro(GenerateFaceId, bool);
  vtkGetMacro(GenerateFaceId, bool);
  vtkBooleanMacro(GenerateFaceId, bool);
  vtkSetMacro(GenerateStatus, bool);
  vtkGetMacro(GenerateStatus, bool);
  vtkBooleanMacro(GenerateStatus, bool);
  vtkSetMacro(GenerateFootType, bool);
  vtkGetMacro(GenerateFootType, bool);
  vtkBooleanMacro(GenerateFootType, bool);
  vtkSetMacro(GenerateIsolated, bool);
  vtkGetMacro(GenerateIsolated, bool);
  vtkBooleanMacro(GenerateIsolated, bool);
  vtkSetMacro(GenerateIterations, bool);
  vtkGetMacro(GenerateIterations, bool);
  vtkBooleanMacro(GenerateIterations, bool);
  ///@}

  ///@{
  /**
   * Output 1, the foot points, and output 2, the statistics of each face.
   */
  vtkPolyData* GetFootPointsOutput();
  vtkTable* GetFaceStatisticsOutput();
  ///@}

  /**
   * How often the search structure was built. It is kept as long as the *content* of the geometry
   * stays the same, whatever modification times, and built anew for the same content only where
   * SeedResolution changes, or where GLOBAL is used for the first time after other searches.
   */
  int GetNumberOfModelBuilds() const;

  /**
   * Includes the parametric function's.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkPointInversionFilter();
  ~vtkPointInversionFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  vtkMultiProcessController* Controller = nullptr;
  vtkParametricFunction* ParametricFunction = nullptr;
  int Search;
  int Method;
  double PointTolerance;
  double CosineTolerance;
  double StepTolerance;
  int MaximumIterations;
  double TrustRadius;
  bool ColumnScaling;
  bool IsocurveFallback;
  int SeedResolution;
  int NumberOfSeeds;
  double CertificateTolerance;
  double MaximumDistance;
  bool OrthogonalOnly;
  bool AllFeet;
  double FixedDirection[3];
  bool WarmStart = false;
  bool FlipNormals = false;
  double DeviationTolerance = VTK_DOUBLE_MAX;
  bool FootSegments = false;
  std::string ArrayNamePrefix;
  bool GenerateParameters = true;
  bool GenerateDistance = true;
  bool GenerateSignedDistance = true;
  bool GenerateClosestPoint = true;
  bool GenerateNormal = true;
  bool GenerateTangent = true;
  bool GenerateFaceId = true;
  bool GenerateStatus = true;
  bool GenerateFootType = true;
  bool GenerateIsolated = true;
  bool GenerateIterations = true;

private:
  vtkPointInversionFilter(const vtkPointInversionFilter&) = delete;
  void operator=(const vtkPointInversionFilter&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
