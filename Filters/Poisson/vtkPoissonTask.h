// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Poisson/ColumnProblem.h"
#include "Filters/Streaming/vtkStreamedTask.h"

namespace smg
{

/** A Poisson problem in the arrays of the pieces. */
class PoissonTask : public StreamedTask
{
public:
  ColumnProblemNames arrays;
  Weights weights = Weights::Cotangent;
  double screening = 0.0;
  SolveOptions options; ///< but for the progress

  void check() const override;
  PieceColumns columns() const override;
  std::unique_ptr<Solution> solve(
    const VsmReader& mesh, const ProgressFunction& progress) const override;
};

} // namespace smg
