// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/vtkStreamedTask.h"
#include "Solver/Description/ProblemDescription.h"

namespace smg
{

/** A problem whose columns are arrays of the pieces. */
class PoissonTask : public StreamedTask
{
public:
  ProblemDescription problem;
  SolveOptions options; ///< but for the progress

  void check() const override;
  PieceColumns columns() const override;
  std::unique_ptr<Solution> solve(
    const VsmReader& mesh, const ProgressFunction& progress, Report& report) const override;
};

} // namespace smg
