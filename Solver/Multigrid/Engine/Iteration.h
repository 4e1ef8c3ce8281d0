// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/Acceleration.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/ErrorBalance.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/SolveContext.h"

#include <optional>
#include <string>

namespace smg
{

/**
 * The V-cycles of a problem after the first pass, one per pass, accelerated where that pays off.
 *
 * Whether acceleration has room depends on the memory limit and on what earlier passes needed,
 * never on the number of threads: the solution depends on it. Where a bound of the need exceeds the
 * limit, the first of these passes is not accelerated, has one chain of stages, and measures what
 * passes need; then as much is kept as fits (KeptResiduals).
 */
class Iteration
{
public:
  /** Notes begin with `what`. If `balance` is not null, it may end the V-cycles, too. */
  Iteration(SolveContext& context, Hierarchy& hierarchy, Convergence& convergence,
    std::string what = "", ErrorBalance* balance = nullptr)
    : Context(context)
    , Levels(hierarchy)
    , StoppingRule(convergence)
    , NotePrefix(std::move(what))
    , Balance(balance)
    , Accelerator(context.options.acceleration, convergence)
  {
  }

  /** Performs V-cycles until convergence or, with `leaveLast`, until only the last permitted one
   * is left, which shares its pass with the next problem. */
  void run(bool leaveLast);

  /** Between passes: saves and restores all that later passes need, except the hierarchy and the
   * convergence. */
  void save(StateWriter& state);
  void load(StateReader& state);

private:
  /** Tells the progress how far V-cycles go. */
  void expect();
  void addHistory();
  void emplaceHistoryWithRoom();
  bool measuresMemory() const;
  void emplaceHistory(KeptResiduals residuals);

  SolveContext& Context;
  Hierarchy& Levels;
  Convergence& StoppingRule;
  std::string NotePrefix;
  ErrorBalance* Balance;
  Acceleration Accelerator;
  KeptResiduals ResidualStorage = KeptResiduals::None; // by the history, for a checkpoint
  bool HasMeasured = false;                            // memory, in the first pass
  std::optional<IterateHistory> History;
};

} // namespace smg
