// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkStreamedTask.h"
#include "smg/Distance.h"

#include <vector>

class vtkPointSet;

namespace smg
{

/** Distances on a mesh in pieces. */
class DistanceTask : public StreamedTask
{
public:
  DistanceDescription description;
  DistanceOptions options; ///< except for the progress function

  void check() const override;
  PieceColumns columns() const override;
  Costs costs(const StreamInfo& info) const override;
  AddedValues added(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report) const override;

  /** Measures on the preview of a mesh in memory, which has cells, and sets the values at its
   * points. Throws Error and Cancelled. */
  SolveSummary solveOnPreview(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) const;
};

} // namespace smg
