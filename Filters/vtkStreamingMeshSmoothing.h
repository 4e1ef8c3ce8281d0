// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshSmoothing
 * @brief   Smooths a very large surface, or a point array of any very large mesh
 *
 * Smooths the points of a mesh of triangles by implicit fairing: details below Size vanish, the
 * volume is kept, and any step is stable. With KeepEdges, sharp edges stay sharp. With Array, it
 * smooths that point array of a mesh of triangles or tetrahedra instead. The output is the input
 * with its points moved, in their precision, or with the smoothed array, in its type; other arrays
 * are kept, except old normals (see Normals) and active tangents.
 *
 * - For streamed requests (see vtkStreamingMeshKeys), those of writers and other streaming filters,
 *   the whole mesh is smoothed once, out of core, as described at vtkStreamingSolver.
 * - For other requests, if the input is a preview and Solve says so, that is smoothed
 *   in memory. Its
 *   edges are longer than those of the mesh: a size in mean edges refers to those of the mesh, as
 *   far as the numbers of cells tell them.
 *
 * Regions that vtkMeshRegion has marked do not change, nor what Hold names.
 *
 * Weights has no effect: the cotangent weights are used.
 *
 * @sa vtkStreamingSolver vtkMeshRegion vtkStreamingMeshDeformation vtkStreamingMeshReader
 */
#ifndef vtkStreamingMeshSmoothing_h
#define vtkStreamingMeshSmoothing_h

#include "vtkStreamingMultigridFiltersModule.h" // For export macro
#include "vtkStreamingSolver.h"

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingMeshSmoothing : public vtkStreamingSolver
{
public:
  static vtkStreamingMeshSmoothing* New();
  vtkTypeMacro(vtkStreamingMeshSmoothing, vtkStreamingSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What Size is a multiple of. */
  enum SizeUnits
  {
    MEAN_EDGES = 0, ///< the mean length of the edges of the mesh
    MESH_UNIT = 1,  ///< 1: Size is in the unit of the mesh
    DIAGONAL = 2    ///< the diagonal of the bounds of the mesh
  };
  /** What becomes of the boundary of a surface. */
  enum BoundaryTypes
  {
    AUTOMATIC = 0, ///< SMOOTH for points, FREE for an array
    SMOOTH = 1,    ///< it is smoothed as curves, by the same size; not for an array
    FIXED = 2,     ///< it does not change
    FREE = 3       ///< it is smoothed with the surface
  };
  /** The treatment of normals. */
  enum NormalsTypes
  {
    RECOMPUTE = 0, ///< they are recomputed
    DROP = 1       ///< they are dropped
  };

  /** Waves of this length are halved by all steps together, in SizeUnit. Default: 4. */
  smgProperty(Size, double);

  /** The unit of Size. Default: MEAN_EDGES. */
  smgProperty(SizeUnit, int);

  /** Implicit steps, 1 to 1000. Default: 1. */
  smgOption(Steps, int);

  /** Whether each step moves the points along their normals, by the distance with which the surface
   * sweeps no volume. Default: on. */
  smgFlagOption(KeepVolume);

  /** Whether to keep edges at which the surface turns by more than EdgeAngle. Needs about 5 Steps.
   * Default: off. */
  smgFlagProperty(KeepEdges);

  /** The angle of KeepEdges in degrees, between 0 and 180. Default: 30, for machined parts. */
  smgProperty(EdgeAngle, double);

  /** What becomes of the boundary of a surface. Default: AUTOMATIC. */
  smgOption(Boundary, int);

  /** The parts that do not change, in addition to the regions of vtkMeshRegion before this filter:
   * WHERE of a problem file in JSON, or a list of these, for example {"sphere": [0, 0, 0, 1]}.
   * Columns are arrays of the input. Default: none. */
  smgTextOption(Hold);

  /** Name of the point array to smooth instead of the points. Empty (default) or "None": the
   * points. */
  smgTextOption(Array);

  /** The former name of Array, which counts if there is none. */
  smgTextProperty(Column);

  /** The treatment of the normals of points and of cells (the active normals and arrays `Normals`)
   * if points move: see vtkStreamingMeshDeformation. Default: RECOMPUTE. */
  smgOption(Normals, int);

protected:
  vtkStreamingMeshSmoothing();
  ~vtkStreamingMeshSmoothing() override;

  void CheckRanges() const override;
  std::string UnusedProperty() override;
  std::unique_ptr<smg::JobTask> MakeTask(vtkPointSet& input) override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;
  int ComparedColumns(int columns) override; // without normals

private:
  vtkStreamingMeshSmoothing(const vtkStreamingMeshSmoothing&) = delete;
  void operator=(const vtkStreamingMeshSmoothing&) = delete;

  /** Of the points; empty: their positions are smoothed. */
  std::string SmoothedArray() const;

  double Size = 4.0;
  int SizeUnit = MEAN_EDGES;
  bool KeepEdges = false;
  double EdgeAngle = 30.0;
  std::string Column;
};

#endif
