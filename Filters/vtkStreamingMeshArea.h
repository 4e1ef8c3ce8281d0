// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshArea
 * @brief   Sums up areas or volumes of a very large mesh: of points, by tags, in all
 *
 * The output is the input with the point array Area, of a tetrahedral mesh Volume: the share of
 * each point in its cells. The total and the sums by the values of an array of the cells are in the
 * output AREAS and in the report.
 *
 * The whole mesh is measured, out of core, as described at vtkStreamingSolver, also where its
 * preview is shown, whose points then have their shares in the mesh: a reading of the file takes
 * less than a microsecond a point, and a preview has no arrays of the cells.
 *
 * Regions that vtkMeshRegion has marked, and Of, say which part of the mesh counts.
 *
 * Solve, Weights, Operators, Sweeps, Tolerance and MaximumCycles have no effect.
 *
 * @sa vtkStreamingSolver vtkMeshRegion vtkStreamingMeshReader
 */
#ifndef vtkStreamingMeshArea_h
#define vtkStreamingMeshArea_h

#include "vtkStreamingMultigridFiltersModule.h" // For export macro
#include "vtkStreamingSolver.h"

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingMeshArea : public vtkStreamingSolver
{
public:
  static vtkStreamingMeshArea* New();
  vtkTypeMacro(vtkStreamingMeshArea, vtkStreamingSolver);

  /** The outputs besides those of vtkStreamingSolver. */
  enum FurtherOutputPorts
  {
    AREAS =
      NUMBER_OF_OUTPUT_PORTS ///< a vtkTable with a row for each tag: Tag, Cells, Area or Volume
  };

  /** Name of the cell array of one component by whose values areas are summed, at most 65,536 of
   * them. Empty (default) or "None": only the total. */
  smgTextOption(Tag);

  /** The parts of the mesh that count, besides the regions of vtkMeshRegion before this filter: a
   * cell counts if all of its corners lie in one of them; an array of the cells selects cells.
   * WHERE of a problem file in JSON, or a list of these, for example {"sphere": [0, 0, 0, 1]}.
   * Columns are arrays of the input. Default: none; without any region all cells count. */
  smgTextOption(Of);

  /** What a point has of its cells. */
  enum ShareTypes
  {
    EQUAL,  ///< as much as the other corners: the lumped mass of linear finite elements
    VORONOI ///< of triangles, what is nearest to it
  };
  /** What a point has of its cells. Default: EQUAL. */
  smgOption(Share, int);

  /** By which lengths are multiplied, above 0: 0.001 for a mesh in millimetres and areas in square
   * metres. Default: 1. */
  smgOption(Scale, double);

protected:
  vtkStreamingMeshArea();
  ~vtkStreamingMeshArea() override;

  bool IsForMemory(vtkPointSet& /*input*/, bool /*isWhole*/) override { return false; }
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;
  void FillFurtherOutputs(
    const smg::SolveSummary& summary, vtkInformationVector& outputVector) override;

private:
  vtkStreamingMeshArea(const vtkStreamingMeshArea&) = delete;
  void operator=(const vtkStreamingMeshArea&) = delete;
};

#endif
