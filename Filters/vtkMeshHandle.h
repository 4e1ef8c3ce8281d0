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
 * How it moves, by Motion: not at all (FIXED), by rotation and scale about Center and then
 * Translation (SIMILARITY), or by a Transform (TRANSFORM). Regions other than FUNCTION may have
 * PointTargets, which say for each of their points where it goes; then the motion says only how it
 * turns and grows.
 *
 * Regions, and how they are found on a mesh of any size, are described at vtkMeshRegion.
 *
 * @sa vtkMeshRegion vtkStreamingMeshDeformation vtkStreamingMeshReader
 */
#ifndef vtkMeshHandle_h
#define vtkMeshHandle_h

#include "vtkMeshRegion.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkLinearTransform;

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMeshHandle : public vtkMeshRegion
{
public:
  static vtkMeshHandle* New();
  vtkTypeMacro(vtkMeshHandle, vtkMeshRegion);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What says where the held points go. */
  enum MotionTypes
  {
    FIXED = 0,
    SIMILARITY = 1,
    TRANSFORM = 2
  };

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

  /** Also the time of the transform. */
  vtkMTimeType GetMTime() override;

protected:
  vtkMeshHandle();
  ~vtkMeshHandle() override;

  void Check() override;
  void Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output) override;

private:
  vtkMeshHandle(const vtkMeshHandle&) = delete;
  void operator=(const vtkMeshHandle&) = delete;

  int Motion = FIXED;
  double RotationAxis[3] = { 0.0, 0.0, 1.0 };
  double RotationAngle = 0.0;
  double Scale = 1.0;
  double Center[3] = { 0.0, 0.0, 0.0 };
  double Translation[3] = { 0.0, 0.0, 0.0 };
  vtkLinearTransform* Transform = nullptr;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
