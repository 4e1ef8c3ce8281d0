// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/ColumnScales.h"
#include "Solver/Multigrid/Engine/CompiledOperators.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/NextSystem.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "Solver/Multigrid/Engine/StreamedSolution.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>

namespace smg
{

class RowListener;

/** A hierarchy, in memory or on scratch files, and the systems that are solved on it one after the
 * other: build() makes it with the first system, an Iteration performs V-cycles of the present
 * system, advance() goes on to the next one. */
class StreamedSystem
{
public:
  /** Prepares for systems of at most `columns` columns; nothing is read yet. */
  StreamedSystem(CompiledOperators operators, int columns, const SolveOptions& options);

  StreamedSystem(const StreamedSystem&) = delete;
  StreamedSystem& operator=(const StreamedSystem&) = delete;

  /** The first pass, see FirstPass. To be called once, unless a checkpoint has the hierarchy. */
  ColumnResiduals build(MeshSource& mesh, Problem& problem, RowListener* listener = nullptr,
    std::int64_t furtherCoreBytes = 0);
  /** The pass that finishes the last V-cycle of the present system and begins the first one of the
   * next. */
  void advance(NextSystem& next);
  /** Begins the first V-cycle of the next system; the present one is given up, and may be anything
   * that an exception has left. */
  void restart(NextSystem& next);
  /** To be called after the pass that begins a system, with the residual of its initial values:
   * begins `convergence`. The residual after the first sweeps does not count if the right-hand side
   * was projected after them, and cannot be judged by what flows, which later passes measure. */
  void begin(Convergence& convergence, const Stopping& stopping, const FirstResidual& first);
  /** Returns the values of the present system, and releases everything else. */
  std::unique_ptr<StreamedSolution> takeSolution();

  SolveContext& context() { return *this->Context; }
  const SolveContext& context() const { return *this->Context; }
  Hierarchy& levels() { return this->Levels; }
  LevelWindow<double>& window() { return this->Levels.window(); }

private:
  CompiledOperators Operators;
  std::unique_ptr<SolveContext> Context; // the solution takes it
  Hierarchy Levels;
};

} // namespace smg
