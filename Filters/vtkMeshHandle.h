// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshHandle
 * @brief   Fixes or moves a region of a very large mesh
 *
 * Adds or updates the point arrays that control vtkStreamingMeshDeformation: `HandleMask` (unsigned
 * char: the number of handles that hold the point, at most 255), `HandleTarget` (three doubles: its
 * target position), `HandleRotation` (three doubles: unit axis times angle in radians) and
 * `HandleLogScale` (double: natural logarithm of the scale). Filters are chained, one for each
 * handle: if several hold a point, the last one counts.
 *
 * Motion selects how the region moves: not at all (FIXED), by rotation and scale about Center
 * followed by Translation (SIMILARITY), or by a Transform (TRANSFORM). A SELECTION, IDS and
 * POINTS may have PointTargets, the target positions of their points; the motion then defines only
 * rotation and scale.
 *
 * vtkRegionFilter describes the regions and how they are found on a mesh of any size.
 *
 * @sa vtkRegionFilter vtkStreamingMeshDeformation vtkStreamingMeshReader
 */
#ifndef vtkMeshHandle_h
#define vtkMeshHandle_h

#include "vtkRegionFilter.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkLinearTransform;

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMeshHandle : public vtkRegionFilter
{
public:
  static vtkMeshHandle* New();
  vtkTypeMacro(vtkMeshHandle, vtkRegionFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The motions of the held points. */
  enum MotionTypes
  {
    FIXED = 0,
    SIMILARITY = 1,
    TRANSFORM = 2
  };

  ///@{
  /**
   * The target positions of the points of a selection (in the order of their ids), of the ids, or
   * of the positions: as many as these. The neighbourhood held with a point moves with it. Default:
   * none (the motion defines the targets).
   */
  void AddPointTarget(double x, double y, double z);
  void RemoveAllPointTargets();
  vtkIdType GetNumberOfPointTargets();
  ///@}

  /** The motion of the held points. Default: FIXED. */
  smgProperty(Motion, int);

  ///@{
  /** The axis of the rotation, of any length except 0. Default: (0, 0, 1). */
  vtkSetVector3Macro(RotationAxis, double);
  vtkGetVector3Macro(RotationAxis, double);
  ///@}

  /** The angle of the rotation in degrees, from -1e6 to 1e6: 200 is not the same as -160. Default:
   * 0. */
  smgProperty(RotationAngle, double);

  /** The scale factor of the held region, from 1e-20 to 1e20. Default: 1. */
  smgProperty(Scale, double);

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
  /** The transform of TRANSFORM. It must be neither singular nor a reflection; rotations are at
   * most 180 degrees. Default: none. */
  virtual void SetTransform(vtkLinearTransform* transform);
  vtkLinearTransform* GetTransform() { return this->Transform; }
  ///@}

  /** Includes the modification time of the transform. */
  vtkMTimeType GetMTime() override;

protected:
  vtkMeshHandle();
  ~vtkMeshHandle() override;

  void Check() override;
  std::string UnusedProperty() override;
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
