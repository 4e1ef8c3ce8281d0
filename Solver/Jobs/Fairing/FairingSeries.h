// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Fairing/FairingProblem.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/StreamedSystem.h"
#include "Solver/Multigrid/Engine/SystemRecords.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

/**
 * Steps of implicit smoothing with one matrix, that is, of a column: (M + t L) u_k = M u_{k-1}. The
 * first step is a problem on a hierarchy of its own, which the others share: a step begins in the
 * pass that ends the one before, and costs its V-cycles alone.
 */
class FairingSeries
{
public:
  FairingSeries(CellType cells, int columns, int steps, const SolveOptions& options);

  /** To be called once. `first`: the problem of the first step. */
  std::unique_ptr<Solution> run(MeshSource& mesh, FairingProblem& first);

private:
  void begin(const ColumnResiduals& residual);
  void end(int step);
  void advance(int step);
  void beginProgress(int step);

  int Columns, Steps;
  Stopping StoppingRule;
  Convergence Current;    ///< of the present step
  double Reference = 0.0; ///< what the residuals of all steps are relative to
  StreamedSystem System;
  SolveContext& Context; // of the system
  SystemRecords Records;
};

} // namespace smg
