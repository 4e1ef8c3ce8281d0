// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/vtkStreamedTask.h"
#include "smg/ProblemDescription.h"

#include <string>
#include <vector>

namespace smg
{

/** A problem whose columns are arrays of the pieces. */
class PoissonTask : public StreamedTask
{
public:
  ProblemDescription problem;
  /** Arrays whose number of components is that of the right-hand sides, as far as the problem has
   * fewer. */
  std::vector<std::string> values;
  SolveOptions options; ///< but for the progress
  std::string note;     ///< for the report, if any

  void check() const override;
  PieceColumns columns() const override;
  std::unique_ptr<Solution> solve(
    const VsmReader& mesh, const ProgressFunction& progress, Report& report) const override;
};

} // namespace smg
