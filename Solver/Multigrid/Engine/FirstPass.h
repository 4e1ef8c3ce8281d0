// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Assembly.h"
#include "Solver/Mesh/MeshPrefetch.h"
#include "Solver/Multigrid/Engine/CompiledOperators.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/HierarchyBuilder.h"
#include "Solver/Multigrid/Engine/SolveContext.h"

#include <cstdint>

namespace smg
{

/**
 * The first pass of a solve: reads the mesh, assembles the finest level, builds all others from it,
 * relaxes and restricts, in one sweep over the stream. That a hierarchy can be built in a single
 * streaming pass is a result of the paper (Shi, Bao, Zhou 2009).
 *
 * A step of the pass assembles one block of the mesh, advances the coarsening of every streamed
 * level, and advances the downward part of the V-cycle, each on what the others had done in earlier
 * steps. With several threads the steps are the same for any number of them, and the result is the
 * same for one thread as well.
 */
class FirstPass
{
public:
  /** Every level gets a copy of the operators. The hierarchy must have no levels yet. */
  FirstPass(SolveContext& context, Hierarchy& hierarchy, const CompiledOperators& operators)
    : Context(context)
    , Levels(hierarchy)
    , Operators(operators)
  {
  }

  /** Performs the pass and completes the hierarchy; returns the residual of the initial values.
   * `listener`: see Assembly; `furtherCoreBytes`: bytes per vertex that the caller will need in
   * core. */
  ColumnResiduals run(MeshSource& mesh, Problem& problem, RowListener* listener = nullptr,
    std::int64_t furtherCoreBytes = 0);

  // For a further problem in core, too:

  /** The residual of the initial values, whose right-hand side gets a mean of 0 where a component
   * is free. */
  static ColumnResiduals residualOf(const InitialResidual& residual, const Components& components);
  /** Makes the right-hand sides of free components sum to zero, after they were restricted. */
  static void project(SolveContext& context, Hierarchy& hierarchy);

private:
  ColumnResiduals perform(
    MeshSource& mesh, Problem& problem, RowListener* listener, std::int64_t furtherCoreBytes);
  ColumnResiduals build(MeshSource& mesh, Problem& problem, RowListener* listener);
  static bool assembleNext(MeshPrefetch& blocks, bool pipelined, Assembly& assembly);
  void readStream(MeshPrefetch& blocks, bool pipelined, Assembly& assembly, AssembledRows& rows,
    HierarchyBuilder& builder);
  ColumnResiduals note(const Assembly& assembly);

  SolveContext& Context;
  Hierarchy& Levels;
  const CompiledOperators& Operators;
};

} // namespace smg
