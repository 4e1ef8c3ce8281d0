// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshRegion
 * @brief   Marks a region of a very large mesh
 *
 * Adds the point array RegionName (unsigned char), which is 1 at the points of the Region and else
 * 0, and makes it the active scalars. Filters are chained: those with the same name mark the union
 * of their regions. The field array `MeshRegions` names these arrays: vtkStreamingMeshSmoothing
 * holds the regions that it finds there, vtkStreamingDistance measures from them. Any filter can
 * use the array itself, for instance as MASK of another region.
 *
 * vtkRegionFilter describes the regions and how they are found on a mesh of any size.
 *
 * @sa vtkRegionFilter vtkStreamingMeshSmoothing vtkStreamingDistance vtkStreamingMeshReader
 */
#ifndef vtkMeshRegion_h
#define vtkMeshRegion_h

#include "vtkRegionFilter.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMeshRegion : public vtkRegionFilter
{
public:
  static vtkMeshRegion* New();
  vtkTypeMacro(vtkMeshRegion, vtkRegionFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The name of the point array. An array of this name of the input is replaced, with a warning,
   * if it is of unsigned char with one component, as those of saved results; another is an error.
   * Default: "RegionMask". */
  smgTextProperty(RegionName);

protected:
  vtkMeshRegion();
  ~vtkMeshRegion() override;

  void Check() override;
  void Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output) override;

private:
  vtkMeshRegion(const vtkMeshRegion&) = delete;
  void operator=(const vtkMeshRegion&) = delete;

  std::string RegionName;
};

#endif
