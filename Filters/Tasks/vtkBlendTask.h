// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkStreamedTask.h"
#include "smg/Blend.h"

#include <vector>

class vtkPointSet;

namespace smg
{

/** A blend of point arrays of a mesh in pieces. */
class BlendTask : public StreamedTask
{
public:
  BlendDescription description;
  SolveOptions options; ///< except for the progress function

  void check() const override;
  PieceColumns columns() const override;
  Costs costs(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report) const override;

  /** Blends on the preview of a mesh in memory, which has cells, and sets the values at its points.
   * Throws Error and Cancelled. */
  SolveSummary solveOnPreview(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) const;
};

} // namespace smg
