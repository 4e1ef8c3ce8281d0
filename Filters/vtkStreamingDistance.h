// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingDistance
 * @brief   Computes distances on a very large mesh
 *
 * The distance of every point from sources: along a surface, through a tetrahedral mesh, or (Wall)
 * to its boundary in a straight line. The output is the input with the point arrays Distance
 * (infinite where no source is reached) and, if wanted, DistanceSource, DistanceGroup and
 * DistanceDirection.
 *
 * - For streamed requests (see vtkStreamingMeshKeys), those of writers and other streaming filters,
 *   the distances of the whole mesh are computed once, out of core, as described at
 *   vtkStreamingSolver.
 * - For other requests, if the input is a preview and Solve says so, the distances of the preview
 * are computed in memory.
 *
 * The sources are the regions that vtkMeshRegion has marked, and From. The shortest paths to the
 * points of To are polylines of the output PATHS.
 *
 * Weights, Operators, Sweeps, Tolerance and MaximumCycles have no effect.
 *
 * @sa vtkStreamingSolver vtkMeshRegion vtkStreamingPoisson vtkStreamingMeshReader
 */
#ifndef vtkStreamingDistance_h
#define vtkStreamingDistance_h

#include "vtkStreamingMultigridFiltersModule.h" // For export macro
#include "vtkStreamingSolver.h"

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingDistance : public vtkStreamingSolver
{
public:
  static vtkStreamingDistance* New();
  vtkTypeMacro(vtkStreamingDistance, vtkStreamingSolver);

  /** Where the distance is 0: WHERE of a problem file in JSON, or a list of these, for example
   * {"vertices": [5]}, in addition to the regions of vtkMeshRegion before this filter. Columns are
   * arrays of the input. Default: none. Without any region, that is what vtkMeshHandle holds,
   * {"mask": "HandleMask"}. With Wall, the wall; without any region the whole boundary. */
  smgTextOption(From);

  /** Whether to compute the Euclidean distance to the boundary of a tetrahedral mesh instead of
   * that along paths. Default: off. */
  smgFlagOption(Wall);

  /** Whether to add DistanceSource, the number of the nearest source in the original file; -1 where
   * there is none. Default: off. */
  smgFlagOption(Source);

  /** Whether to add DistanceGroup, where the nearest source is: the index of the region, from 0,
   * first among those of vtkMeshRegion, in their order in the pipeline (those of one RegionName are
   * one), then among those of From; -1 where there is none. Default: off. */
  smgFlagOption(Group);

  /** Whether to add DistanceDirection, the unit gradient of the distance. Default: off. */
  smgFlagOption(Direction);

  /** The outputs besides those of vtkStreamingSolver. */
  enum FurtherOutputPorts
  {
    /** A vtkPolyData with a polyline for each shortest path, from the source on, and the cell
     * arrays To, From (numbers in the original file) and Length. */
    PATHS = NUMBER_OF_OUTPUT_PORTS
  };
  /** Points whose shortest paths are wanted, at most 1,000: WHERE of a problem file in JSON, or a
   * list of these, for example {"nearest": [[0, 0, 1]]}. Of exact distances on a surface.
   * Default: none. */
  smgTextOption(To);

  /** How the lengths of paths on a surface are computed. */
  enum AccuracyType
  {
    AUTOMATIC,  ///< exact up to 1,000,000 points
    EXACT,      ///< up to rounding, in 10 to 50 us a point
    APPROXIMATE ///< too long on long thin triangles, in about 1 us a point
  };
  /** How the lengths of paths on a surface are computed; those through a solid are approximate.
   * Default: AUTOMATIC. */
  smgOption(Accuracy, int);

  /** Of paths, in the unit of the mesh: points that are farther are not reached. 0: none is too
   * far. Default: 0. */
  smgOption(Within, double);

  /** The maximum number of passes over the mesh, at least 1. Default: 200. */
  smgOption(MaximumPasses, int);

protected:
  vtkStreamingDistance();
  ~vtkStreamingDistance() override;

  void CheckRanges() const override;
  std::unique_ptr<smg::JobTask> MakeTask(vtkPointSet& input) override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;
  int ComparedColumns(int /*columns*/) override { return 1; } // the distance
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void FillFurtherOutputs(
    const smg::SolveSummary& summary, vtkInformationVector& outputVector) override;

private:
  vtkStreamingDistance(const vtkStreamingDistance&) = delete;
  void operator=(const vtkStreamingDistance&) = delete;
};

#endif
