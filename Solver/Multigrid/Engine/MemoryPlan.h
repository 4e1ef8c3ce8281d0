// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/State.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Solve.h"

#include <cstdint>
#include <optional>

namespace smg
{

/**
 * All that a memory limit decides in a solve: which levels are in core, whether the stages of the
 * first pass are pipelined, how many nodes and chains a step of a later pass has, and which vectors
 * acceleration keeps. What gives way first under a tight limit are chains and steps, then the
 * residuals of acceleration.
 *
 * The solution depends on the levels and on the acceleration. So decisions depend on the limit, on
 * the statistics of the stream and on what passes in one chain have needed, never on the number of
 * threads, and levels not on whether the solve is in core.
 */
class SMG_EXPORT MemoryPlan
{
public:
  /** What is decided from, for the solve whose memory `pool` has. */
  MemoryPlan(const Pool& pool, const SolveOptions& options)
    : Memory(pool)
    , InCore(options.inCore)
    , Limit(options.memoryLimit)
    , CoreNodes(options.coreNodes)
    , BlockNodes(options.blockNodes)
  {
  }

  // Before the first pass.

  /** Estimates the need of a solve of this stream. */
  void estimate(const StreamInfo& info, int columns, Weights weights, const SolveOptions& options);
  /** The bytes that one thread is expected to need; 0: unknown. */
  std::int64_t expected() const { return this->Expected; }
  /** Whether the limit leaves room for several tasks per level in the first pass, each some nodes
   * behind the one before it: for any span, if it is unknown; false if the number of vertices is.
   */
  bool isAmple() const { return this->Ample; }
  /** The finest level in core, from the usual sizes of levels, for a mesh of this number of
   * vertices; 0 or less: unknown. `coarsest`: a level with so many nodes is not coarsened. */
  int firstCoreLevel(std::int64_t vertices, std::int64_t coarsest) const;

  // After passes.

  /** The first pass has had memory for the values of this number of nodes of the finest level. */
  void endFirstPass(std::int64_t valueNodes);
  /** A pass without acceleration and in one chain has had memory for these values. */
  void endPlainPass(std::int64_t valueNodes);

  /** Whether a later pass over a finest level of `nodes` nodes, with `stride` values for each, has
   * room for a history with these residuals. */
  bool hasRoom(std::int64_t nodes, int stride, KeptResiduals residuals) const;
  /** The residuals that a history keeps: those that are wanted, else the smallest sample; none if
   * there is room for neither. */
  std::optional<KeptResiduals> residualsThatFit(
    std::int64_t nodes, int stride, KeptResiduals wanted) const;

  /** The steps of a later pass. */
  struct Steps
  {
    std::int64_t nodes; ///< of the finest level in a step
    int chains;         ///< of stages
  };
  /** Those for this number of scheduled threads; `sparseness`: of the history (0: steps alone), if
   * there is one. Shorter steps are preferred to fewer chains. */
  Steps stepsOf(
    std::int64_t nodes, int stride, std::optional<std::int64_t> sparseness, int threads) const;
  /** Those that take the least memory. */
  Steps leastSteps() const { return { this->BlockNodes, 1 }; }

  template <class State>
  void exchange(State& state)
  {
    state(this->Expected, this->Ample, this->FirstPassPeak, this->PlainPassPeak, this->ValueNodes);
  }

private:
  std::int64_t passBytes(int stride, std::optional<std::int64_t> sparseness) const;

  const Pool& Memory;
  bool InCore;
  std::int64_t Limit, CoreNodes, BlockNodes;
  std::int64_t Expected = 0;
  bool Ample = false;
  std::int64_t FirstPassPeak = 0;
  std::int64_t PlainPassPeak = 0; ///< 0: not measured
  std::int64_t ValueNodes =
    0; ///< nodes for whose values that pass, or else the first one, had memory
};

// The need of a solve from the statistics of its stream, before anything is read.

/** A lower bound of the bytes of the pool. Out of core the windows of all levels have a number of
 * nodes proportional to the span of the stream; in core everything stays, with `furtherCoreBytes`
 * more per vertex. 0 if the span is unknown. */
SMG_EXPORT std::int64_t leastMemory(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, std::int64_t furtherCoreBytes = 0);

/** The bytes that such a solve is expected to need: more than the lower bound, which must not
 * refuse a solve that fits. */
SMG_EXPORT std::int64_t expectedMemory(
  const StreamInfo& info, int columns, Weights weights, const SolveOptions& options);

/** Throws MemoryLimitError, with the bytes that suffice, if the memory limit is certainly too low
 * for a solve: to be called before any work. */
SMG_EXPORT void requireMemory(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, std::int64_t furtherCoreBytes = 0);

} // namespace smg
