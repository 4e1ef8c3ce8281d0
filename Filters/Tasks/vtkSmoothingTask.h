// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkStreamedTask.h"
#include "smg/Smooth.h"

#include <vector>

class vtkPointSet;

namespace smg
{

/** The smoothing of a mesh in pieces: of its positions, with normals as DeformedVertices if they
 * are needed, or of an array of its points. */
class SmoothingTask : public StreamedTask
{
public:
  Smoothing options;         ///< except for the progress function
  bool needsNormals = false; ///< of the vertices; tetrahedra have none

  void check() const override;
  PieceColumns columns() const override;
  Costs costs(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report) const override;

  /** Smooths the preview of a mesh in memory, which has cells, and sets the values at its points.
   * Throws Error and Cancelled. */
  SolveSummary solveOnPreview(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) const;

private:
  std::unique_ptr<Solution> smoothed(
    const StoredMesh& mesh, bool inCore, const ProgressFunction& progress) const;
};

} // namespace smg
