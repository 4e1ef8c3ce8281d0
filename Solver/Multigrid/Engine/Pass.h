// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/NextSystem.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

namespace smg
{

/**
 * A pass over the levels, which finishes a V-cycle and begins the next one. k V-cycles take k + 1
 * passes, counting the first, as in the paper.
 *
 * The pass moves over the finest level in steps. In each step load() makes available what the
 * upward part needs up to the end of the step, the chains of stages and the files advance as tasks
 * that may run at the same time, and release() returns what all stages have passed. Chains see the
 * cursors that the others had at the beginning of the step.
 */
class Pass
{
public:
  struct Options
  {
    /** The system whose first V-cycle the pass begins; null: the present one. */
    NextSystem* next = nullptr;
    /** The history of the iterates, if the pass is accelerated. */
    IterateHistory* history = nullptr;
    /** Whether the pass has one chain of stages, which takes the least memory. */
    bool inOneChain = false;
  };

  Pass(SolveContext& context, Hierarchy& hierarchy)
    : Context(context)
    , Levels(hierarchy)
  {
  }

  /** Performs the part of the V-cycle on the core levels, then a pass; `scale` is the
   * approximate size of the residuals in it. */
  void run(double scale, const Options& options);

  /** In core: begins the first V-cycle of a system whose right-hand side and initial values are in
   * the window of the finest level. */
  void begin();

private:
  Schedule scheduleOf(const Options& options, int chains);

  SolveContext& Context;
  Hierarchy& Levels;
};

} // namespace smg
