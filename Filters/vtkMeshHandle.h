// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshHandle
 * @brief   Takes hold of a region of a gigantic mesh and says where it goes
 *
 * Adds to the input's points the arrays by which vtkStreamingMeshDeformation deforms it, or updates
 * them: `HandleMask` (unsigned char: how many handles hold the point, at most 255), `HandleTarget`
 * (three doubles: where it goes), `HandleRotation` (three doubles: unit axis times angle in
 * radians) and `HandleLogScale` (double: natural logarithm of the scale). Filters are chained, one
 * for each handle: where several hold a point, the last one counts.
 *
 * What is held, by Region:
 * - FUNCTION: the points where RegionFunction is at most 0 (with InsideOut: at least 0);
 * - SELECTION: the points, or the cells' points, of the selection at input port 1;
 * - IDS: the points with the given Ids, which are GlobalIds (stream indices) or values of the
 *   array `OriginalId`;
 * - POINTS: the points nearest to the given places.
 *
 * How it moves, by Motion: not at all (FIXED), by rotation and scale about Center and then
 * Translation (SIMILARITY), or by a Transform (TRANSFORM). Regions other than FUNCTION may have
 * PointTargets, which say for each of their points where it goes; then the motion says only how it
 * turns and grows.
 *
 * A selection of points by GlobalIds is the same as these Ids: it names points of the mesh, on the
 * preview, too. Any other selection is made on what is displayed. Of a gigantic mesh that is the
 * preview (see vtkStreamingMeshReader), as soon as real pieces are asked for its points are
 * projected to the nearest points of the mesh, in one pass over NumberOfPieces pieces of the input,
 * with all points within Radius and Rings of these; so are places, and ids that have a Radius or
 * Rings. What was found is kept until the region or the mesh is modified: handles before this one
 * can be changed, unless the selection is one by values of arrays. A point that is farther from the
 * mesh than 1 % of the diagonal of its bounds gives a warning. On a preview, Rings mean nothing,
 * and ids and places hold the nearest points of the preview.
 *
 * A region that holds nothing is an error as soon as that is known: when the whole mesh is asked
 * for, or at the last piece when streamed pieces are asked for in order. If it is a preview that
 * has no point in the region, that is a warning, as the mesh may have some.
 *
 * With more than one process, selections by point numbers hold points of the process that they name
 * as long as each asks for its own piece; streamed requests need GlobalIds, unless a preview is
 * displayed.
 *
 * @sa vtkStreamingMeshDeformation vtkStreamingMeshReader
 */
#ifndef vtkMeshHandle_h
#define vtkMeshHandle_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkImplicitFunction;
class vtkLinearTransform;

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMeshHandle : public vtkPassInputTypeAlgorithm
{
public:
  static vtkMeshHandle* New();
  vtkTypeMacro(vtkMeshHandle, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What says which points are held. */
  enum RegionTypes
  {
    FUNCTION = 0,
    SELECTION = 1,
    IDS = 2,
    POINTS = 3
  };

  /** What the Ids are. */
  enum IdTypes
  {
    GLOBAL_IDS = 0,  ///< GlobalIds, which number the points in the order of the stream
    ORIGINAL_IDS = 1 ///< values of the point array `OriginalId`: numbers in the original file
  };

  /** What says where the held points go. */
  enum MotionTypes
  {
    FIXED = 0,
    SIMILARITY = 1,
    TRANSFORM = 2
  };

  ///@{
  /** What says which points are held. Default: FUNCTION. */
  vtkSetClampMacro(Region, int, FUNCTION, POINTS);
  vtkGetMacro(Region, int);
  ///@}

  ///@{
  /**
   * The function that is at most 0 where points are held; it must be finite at every point, and the
   * radius of a vtkSphere or vtkCylinder greater than 0. Default: none.
   */
  virtual void SetRegionFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetRegionFunction() { return this->RegionFunction; }
  ///@}

  ///@{
  /** Whether the points are held where the function is at least 0 instead. Default: off. */
  vtkSetMacro(InsideOut, bool);
  vtkGetMacro(InsideOut, bool);
  vtkBooleanMacro(InsideOut, bool);
  ///@}

  /** Connects what makes the selection (a vtkSelection): input port 1. */
  void SetSelectionConnection(vtkAlgorithmOutput* selection);

  ///@{
  /** The ids of the points that are held, at least 0. Default: none. */
  void AddId(vtkIdType id);
  void RemoveAllIds();
  vtkIdType GetNumberOfIds();
  vtkIdType GetId(vtkIdType i);
  ///@}

  ///@{
  /** What the ids are. Default: GLOBAL_IDS. */
  vtkSetClampMacro(IdType, int, GLOBAL_IDS, ORIGINAL_IDS);
  vtkGetMacro(IdType, int);
  ///@}

  ///@{
  /** The places whose nearest points are held. Default: none. */
  void AddPoint(double x, double y, double z);
  void RemoveAllPoints();
  vtkIdType GetNumberOfPoints();
  ///@}

  ///@{
  /**
   * How far around the points of a selection, of ids or of places the mesh is held: the distance
   * from each. 0: only the points themselves. Below 0 (default -1): for points selected on a
   * preview as far as each of them stands for the mesh around it, which is the mean length of the
   * preview's edges divided by the square root of 3; else 0.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * The same, counted in edges of the mesh, 0 to 100; what is within the radius or the rings is
   * held. Default: 0.
   */
  vtkSetClampMacro(Rings, int, 0, 100);
  vtkGetMacro(Rings, int);
  ///@}

  ///@{
  /**
   * Where the points of a selection (in the order of their numbers), the ids or the places go: as
   * many as these. What is held around a point moves with it. Default: none, then the motion says
   * where they go.
   */
  void AddPointTarget(double x, double y, double z);
  void RemoveAllPointTargets();
  vtkIdType GetNumberOfPointTargets();
  ///@}

  ///@{
  /** What says where the held points go. Default: FIXED. */
  vtkSetClampMacro(Motion, int, FIXED, TRANSFORM);
  vtkGetMacro(Motion, int);
  ///@}

  ///@{
  /** The axis of the rotation, of any length but 0. Default: (0, 0, 1). */
  vtkSetVector3Macro(RotationAxis, double);
  vtkGetVector3Macro(RotationAxis, double);
  ///@}

  ///@{
  /**
   * The angle of the rotation in degrees, from -1e6 to 1e6: 200 turns the long way. Default: 0.
   */
  vtkSetMacro(RotationAngle, double);
  vtkGetMacro(RotationAngle, double);
  ///@}

  ///@{
  /** The factor by which what is held grows, from 1e-20 to 1e20. Default: 1. */
  vtkSetMacro(Scale, double);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /** The centre of rotation and scale. Default: (0, 0, 0). */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /** The translation after rotation and scale. Default: (0, 0, 0). */
  vtkSetVector3Macro(Translation, double);
  vtkGetVector3Macro(Translation, double);
  ///@}

  ///@{
  /**
   * The motion of Motion TRANSFORM. It must not flatten or mirror; it turns by 180 degrees at most.
   * Default: none.
   */
  virtual void SetTransform(vtkLinearTransform* transform);
  vtkLinearTransform* GetTransform() { return this->Transform; }
  ///@}

  ///@{
  /**
   * How many pieces the input is pulled in where points are projected, 1 to 1,000,000. Default: 64.
   * What is held does not depend on it.
   */
  vtkSetClampMacro(NumberOfPieces, int, 1, 1000000);
  vtkGetMacro(NumberOfPieces, int);
  ///@}

  /**
   * How many points of the last answer this handle holds; of streamed pieces asked for in order, of
   * all of them since the first. Points that an earlier piece owns do not count. 0 after an error.
   */
  vtkGetMacro(NumberOfHeldPoints, vtkIdType);

  /** Also the times of the function and of the transform. */
  vtkMTimeType GetMTime() override;

protected:
  vtkMeshHandle();
  ~vtkMeshHandle() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkMeshHandle(const vtkMeshHandle&) = delete;
  void operator=(const vtkMeshHandle&) = delete;

  int Region = FUNCTION;
  vtkImplicitFunction* RegionFunction = nullptr;
  bool InsideOut = false;
  int IdType = GLOBAL_IDS;
  double Radius = -1.0;
  int Rings = 0;
  int Motion = FIXED;
  double RotationAxis[3] = { 0.0, 0.0, 1.0 };
  double RotationAngle = 0.0;
  double Scale = 1.0;
  double Center[3] = { 0.0, 0.0, 0.0 };
  double Translation[3] = { 0.0, 0.0, 0.0 };
  vtkLinearTransform* Transform = nullptr;
  int NumberOfPieces = 64;
  vtkIdType NumberOfHeldPoints = 0;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
