// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Sweep.h"
#include "Solver/Multigrid/Engine/Coarsening.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "smg/Export.h"
#include "smg/Solve.h"

#include <functional>
#include <memory>

namespace smg
{

/** An operator set as the engine calls it, which is compiled once, in the library: a call for each
 * stage and step of the first pass, and one for each block that is relaxed, never one for a node.
 */
struct CompiledOperators
{
  const CompiledRelaxation& relaxation;
  /** See canRunApart. */
  bool canRunApart;
  bool readsPositions; ///< see readsPositionsOf()
  /** Makes the coarsening from a level to the next one; see Coarsening. */
  std::function<std::unique_ptr<LevelCoarsening>(
    Pool& pool, LevelRows& fine, LevelRows& coarse, SliverRows stiff, bool pipelined)>
    coarsening;
};

template <OperatorSet Operators>
CompiledOperators compiled(const Operators& set)
{
  return { compiledRelaxation<typename Operators::Relaxation>, canRunApart<Operators>,
    readsPositionsOf(set),
    [set](Pool& pool, LevelRows& fine, LevelRows& coarse, SliverRows stiff, bool pipelined) {
      return std::make_unique<Coarsening<Operators>>(pool, set, fine, coarse, stiff, pipelined);
    } };
}

/** As solve(), with these operators. */
SMG_EXPORT std::unique_ptr<Solution> solveWith(const CompiledOperators& operators, MeshSource& mesh,
  Problem& problem, const SolveOptions& options);

} // namespace smg
