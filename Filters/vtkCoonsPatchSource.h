// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCoonsPatchSource
 * @brief   structured grid between four boundary polylines (Coons patch, transfinite interpolation)
 *
 * Fills the area between four sides with a structured grid: S. A. Coons (1967), W. J. Gordon and
 * C. A. Hall (1973). Bottom and top run from left to right, left and right from bottom to top; u
 * runs along bottom, v along left. In the x-y plane the bottom runs towards +x and the left side
 * towards +y, whatever the order and directions of the lines.
 *
 * **Input port 0** (repeatable; optional, but there is no patch without it): vtkPolyData with
 * lines. All connections together give
 * - four polylines: the sides, in any order and direction;
 * - three polylines: one side is collapsed to a point;
 * - one polyline: a closed loop, whose corners are CornerIds or its sharpest turns;
 * - two or more than four lines, in any order and direction, such as vtkFeatureEdges makes: they
 *   are chained, to a loop or to three or four sides.
 *
 * A cell array `BoundaryRole` (int; 0 bottom, 1 right, 2 top, 3 left, −1 any) says which of three
 * or four lines is which side.
 *
 * **Output port 0**: vtkStructuredGrid with dimensions Resolution × 1. **Output port 1**: the same
 * points as vtkPolyData of quads or triangles, with the same arrays.
 *
 * | array                 | on     | type      | meaning                                        |
 * |-----------------------|--------|-----------|------------------------------------------------|
 * | `Normals`             | points | double, 3 | of the adjacent cells together; active normals |
 * | `TCoords`             | points | double, 2 | (s, t) in [0, 1]²; active texture coordinates  |
 * | `ArcLengthU`, `…V`    | points | double    | normalized arc lengths (not with UNIFORM)      |
 * | `Jacobian`            | cells  | double    | scaled Jacobian, minimum over the corners      |
 * | `Folded`              | cells  | int       | 1 where a corner's Jacobian is negative        |
 *
 * | field data             | type      | meaning                                                 |
 * |------------------------|-----------|---------------------------------------------------------|
 * | `CornerGaps`           | double, 4 | how far apart the sides' ends were: C00, C10, C11, C01  |
 * | `EdgeOrder`            | int, 4    | by role: the line it came from, −1 for a collapsed side |
 * | `EdgeReversed`         | int, 4    | by role: 1 where its points were taken backwards        |
 * | `SelfCrossing`         | int       | 1 where sides cross each other; nothing is smoothed then |
 * | `GuessedCorners`       | int       | of a loop: corners that no angle marked                 |
 * | `FoldedCellsBefore`, `FoldedCellsAfter` | vtkIdType | smoothing                            |
 * | `SmoothingStatus`      | int       | see SmoothingStatusEnum                                 |
 * | `TwistIncompatibility` | double    | BICUBIC alone: Gregory's measure, 0 compatible          |
 *
 * There are no sub-extents, as smoothing is global: piece 0 gets everything, others nothing. A bad
 * boundary is an error that names the sides and says how far; the outputs are empty.
 *
 * Memory besides the outputs is that of a few rows: interpolation, normals, texture coordinates and
 * quality are computed in the arrays of the output. Two things need more, in proportion to the
 * grid: smoothing, and the quality of a grid in space some of whose neighbouring cells face
 * opposite ways or have no area.
 *
 * @sa
 * vtkCoonsSurface vtkGordonSurface vtkTransfiniteVolume vtkStructuredGridSmoother
 */

#ifndef vtkCoonsPatchSource_h
#define vtkCoonsPatchSource_h

#include "vtkFootpointFiltersModule.h" // For export macro
#include "vtkStructuredGridAlgorithm.h"

class vtkPolyData;

class VTKFOOTPOINTFILTERS_EXPORT vtkCoonsPatchSource : public vtkStructuredGridAlgorithm
{
public:
  static vtkCoonsPatchSource* New();
  vtkTypeMacro(vtkCoonsPatchSource, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Also takes the pass in which extents follow the time that is asked for.
   */
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  /// Values of the array `BoundaryRole`.
  enum BoundaryRoleEnum
  {
    BOTTOM = 0,
    RIGHT = 1,
    TOP = 2,
    LEFT = 3
  };

  /// Cells of output 1.
  enum CellTypeEnum
  {
    QUADS = 0,
    TRIANGLES = 1
  };

  /// How a cell with the corners n00, n10, n11, n01 is cut in two.
  enum TriangleStyleEnum
  {
    ALIGN_LEFT = 0,  ///< (n00, n10, n01), (n10, n11, n01)
    ALIGN_RIGHT = 1, ///< (n00, n10, n11), (n00, n11, n01)
    UNION_JACK = 2   ///< ALIGN_LEFT in cells (i, j) with i + j even, else ALIGN_RIGHT
  };

  /// Where along the sides the grid's lines end, and which parameters blend them.
  enum ParametrizationEnum
  {
    UNIFORM = 0,              ///< even in the number of the sample
    ARC_LENGTH_RECORDED = 1,  ///< the same, arc lengths are recorded besides
    ARC_LENGTH_RESAMPLED = 2, ///< sides are sampled evenly in arc length
    ARC_LENGTH_BLENDED = 3    ///< interior parameters from the arc lengths of facing sides (Soni)
  };

  /// What is done to the grid after interpolation.
  enum SmoothingEnum
  {
    NONE = 0,
    AUTO = 1,      ///< elliptic, only where the grid has folds
    LAPLACIAN = 2, ///< guarded: no step that makes a fold
    WINSLOW = 3    ///< elliptic
  };

  /// Values of `SmoothingStatus`.
  enum SmoothingStatusEnum
  {
    NOT_SMOOTHED = 0,  ///< not asked for or, with AUTO, not needed
    CONVERGED = 1,     ///< the smoothed grid is the solution
    NOT_CONVERGED = 2, ///< the grid is changed, but is not the solution to the tolerance
    REJECTED = 3       ///< smoothing was no gain; the grid is the interpolated one
  };

  /// The interpolation.
  enum BlendEnum
  {
    BILINEAR = 0,
    BICUBIC = 1 ///< Hermite blending with estimated cross-boundary tangents and twists
  };

  ///@{
  /**
   * Numbers of points along u and v; 0: as many as the longer of the two facing sides has.
   * 0 updates the input as soon as information is requested. Of an input with time steps the counts
   * may change: the whole extent is that of the time that is asked for. A filter downstream that
   * makes a structured grid and takes extents over only once, as VTK's own do, does not follow;
   * then this is an error, with empty outputs. Default: (21, 21).
   */
  vtkSetVector2Macro(Resolution, int);
  vtkGetVector2Macro(Resolution, int);
  ///@}

  ///@{
  /**
   * Cells of output 1, see CellTypeEnum. Default: QUADS.
   */
  vtkSetClampMacro(CellType, int, QUADS, TRIANGLES);
  vtkGetMacro(CellType, int);
  void SetCellTypeToQuads() { this->SetCellType(QUADS); }
  void SetCellTypeToTriangles() { this->SetCellType(TRIANGLES); }
  const char* GetCellTypeAsString() const;
  ///@}

  ///@{
  /**
   * How triangles are cut, see TriangleStyleEnum. Default: ALIGN_LEFT.
   */
  vtkSetClampMacro(TriangleStyle, int, ALIGN_LEFT, UNION_JACK);
  vtkGetMacro(TriangleStyle, int);
  void SetTriangleStyleToAlignLeft() { this->SetTriangleStyle(ALIGN_LEFT); }
  void SetTriangleStyleToAlignRight() { this->SetTriangleStyle(ALIGN_RIGHT); }
  void SetTriangleStyleToUnionJack() { this->SetTriangleStyle(UNION_JACK); }
  const char* GetTriangleStyleAsString() const;
  ///@}

  ///@{
  /**
   * Make the point arrays `Normals` and `TCoords`. Default: on.
   */
  vtkSetMacro(GenerateNormals, bool);
  vtkGetMacro(GenerateNormals, bool);
  vtkBooleanMacro(GenerateNormals, bool);
  vtkSetMacro(GenerateTextureCoordinates, bool);
  vtkGetMacro(GenerateTextureCoordinates, bool);
  vtkBooleanMacro(GenerateTextureCoordinates, bool);
  ///@}

  ///@{
  /**
   * Distribution of the grid's lines, see ParametrizationEnum. Default: UNIFORM.
   */
  vtkSetClampMacro(Parametrization, int, UNIFORM, ARC_LENGTH_BLENDED);
  vtkGetMacro(Parametrization, int);
  void SetParametrizationToUniform() { this->SetParametrization(UNIFORM); }
  void SetParametrizationToArcLengthRecorded() { this->SetParametrization(ARC_LENGTH_RECORDED); }
  void SetParametrizationToArcLengthResampled() { this->SetParametrization(ARC_LENGTH_RESAMPLED); }
  void SetParametrizationToArcLengthBlended() { this->SetParametrization(ARC_LENGTH_BLENDED); }
  const char* GetParametrizationAsString() const;
  ///@}

  ///@{
  /**
   * Close gaps at corners up to CornerTolerance by moving both ends to their middle; off: gaps that
   * are more than rounding are refused. Default: off.
   */
  vtkSetMacro(ForceCornerMatch, bool);
  vtkGetMacro(ForceCornerMatch, bool);
  vtkBooleanMacro(ForceCornerMatch, bool);
  ///@}

  ///@{
  /**
   * Widest gap that ForceCornerMatch closes, as a fraction of the boundary's size (diagonal of its
   * bounding box). Default: 1e-3.
   */
  vtkSetClampMacro(CornerTolerance, double, 0.0, 1.0);
  vtkGetMacro(CornerTolerance, double);
  ///@}

  ///@{
  /**
   * Loops: a turn by more than this, in degrees, may be a corner. Default: 30.
   */
  vtkSetClampMacro(CornerAngle, double, 0.0, 180.0);
  vtkGetMacro(CornerAngle, double);
  ///@}

  ///@{
  /**
   * Loops: the corners, bottom-left, bottom-right, top-right, top-left, as point ids of the input
   * (of several connections: counted on); all −1: found by CornerAngle. Default: (−1, −1, −1, −1).
   */
  vtkSetVector4Macro(CornerIds, int);
  vtkGetVector4Macro(CornerIds, int);
  ///@}

  ///@{
  /**
   * Take four lines as bottom, right, top, left in the directions given, and refuse those that do
   * not meet. Default: off, order and directions are found.
   */
  vtkSetMacro(Strict, bool);
  vtkGetMacro(Strict, bool);
  vtkBooleanMacro(Strict, bool);
  ///@}

  ///@{
  /**
   * What is done to the grid after interpolation, see SmoothingEnum. Default: NONE.
   */
  vtkSetClampMacro(Smoothing, int, NONE, WINSLOW);
  vtkGetMacro(Smoothing, int);
  void SetSmoothingToNone() { this->SetSmoothing(NONE); }
  void SetSmoothingToAuto() { this->SetSmoothing(AUTO); }
  void SetSmoothingToLaplacian() { this->SetSmoothing(LAPLACIAN); }
  void SetSmoothingToWinslow() { this->SetSmoothing(WINSLOW); }
  const char* GetSmoothingAsString() const;
  ///@}

  ///@{
  /**
   * Most iterations of smoothing. Default: 100.
   */
  vtkSetClampMacro(MaximumSmoothingIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumSmoothingIterations, int);
  ///@}

  ///@{
  /**
   * The interpolation, see BlendEnum. Default: BILINEAR.
   */
  vtkSetClampMacro(Blend, int, BILINEAR, BICUBIC);
  vtkGetMacro(Blend, int);
  void SetBlendToBilinear() { this->SetBlend(BILINEAR); }
  void SetBlendToBicubic() { this->SetBlend(BICUBIC); }
  const char* GetBlendAsString() const;
  ///@}

  /**
   * Output 1, the quads or triangles.
   */
  vtkPolyData* GetMeshOutput();

protected:
  vtkCoonsPatchSource();
  ~vtkCoonsPatchSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Resolution[2];
  int CellType = QUADS;
  int TriangleStyle = ALIGN_LEFT;
  bool GenerateNormals = true;
  bool GenerateTextureCoordinates = true;
  int Parametrization;
  bool ForceCornerMatch;
  double CornerTolerance;
  double CornerAngle;
  int CornerIds[4] = { -1, -1, -1, -1 };
  bool Strict;
  int Smoothing = NONE;
  int MaximumSmoothingIterations;
  int Blend;

private:
  bool ResolutionChanged = false; ///< over time, since information was requested

  vtkCoonsPatchSource(const vtkCoonsPatchSource&) = delete;
  void operator=(const vtkCoonsPatchSource&) = delete;

  struct Internals;
};

#endif
