// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Level.h"
#include "Solver/Multigrid/Engine/CompiledOperators.h"
#include "Solver/Multigrid/Engine/LevelStorage.h"
#include "Solver/Multigrid/Schedule/Schedule.h"
#include "smg/Report.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace smg
{

/**
 * Builds the hierarchy while the rows of the finest level arrive. Levels below `firstCore` are
 * built in the same sweep, window by window; those from `firstCore` on, which are in memory as a
 * whole, after it.
 *
 * For each level it has a Coarsening, which makes the rows of the next level, and packs rows into
 * blocks of the window once the stages of the passes can use them. All levels advance by steps. In
 * a step each works on what the finer one handed over after the step before, so the levels, and
 * with `pipelined` even the stages of the three finest ones, are tasks that need not wait for each
 * other.
 */
class HierarchyBuilder
{
public:
  /** Coarsening ends at a level of at most CoarsestNodes nodes, or of more than this share of
   * the nodes of the next finer level: such a level has few strong edges or many stiff rows,
   * and further ones would shrink as little. */
  static constexpr double StalledShare = 0.8;
  /** The number of rows of the finest level that a step processes if its stages are tasks of
   * their own. */
  static constexpr std::int64_t StepNodes = 5 * RowBlock::Nodes;

  /** `stiff` finds the stiff rows of each coarse level. `pipelined`: for several threads, the
   * stages of each of the finest levels, where most of the work is, are tasks of their own. `check`
   * ends the work between rows: a step with rows of very many entries takes seconds. */
  HierarchyBuilder(Pool& pool, const CompiledOperators& operators, LevelStorage& levels,
    int firstCore, SliverRows stiff, bool pipelined, CancelCheck& check);

  /** The rows of the finest level, to which the assembly appends between two steps. */
  LevelRows& finestRows() { return *this->Rows.front(); }

  /** Whether the finest level has enough rows for a step: more would only take memory. */
  bool isBusy() const
  {
    return this->PipelinedLevels > 0 && this->Steps.front()->waiting() > StepNodes;
  }

  /** Begins a step of all streamed levels. */
  void begin();

  /** Adds the stages of a step: those of each of the finest levels, or a whole level as one stage.
   * Each works on what the others have published before the step, and what they make for other
   * levels is handed over after it. */
  void addStages(Schedule& schedule);

  /** Ends a step of all streamed levels: hands over rows to the next level and blocks to the
   * windows. */
  void handOver();

  /** Whether all rows of the streamed levels are in their windows. */
  bool complete() const;

  /**
   * Builds the core levels when the streamed ones are complete. It calls `addLevel(l)` for each
   * level l that is coarser than firstCore, and returns the number of the coarsest level. That may
   * be a streamed one, if it is small enough; the coarser ones that exist already are then not
   * used.
   */
  int finish(const std::function<void(int)>& addLevel);

private:
  void advanceLevel(int l);
  /** Packs core level l, whose rows are complete, and builds the rows of the next one, even if
   * that is not used: the interpolation and the patches of the blocks must not depend on
   * whether the coarsest level was streamed. */
  void build(int l);
  /** The number of nodes of a level whose rows are complete. */
  std::int64_t nodes(int l) const;
  bool stalled(int l) const;
  /** Notes the size of level l and releases its rows, all of which have been packed. */
  void close(int l);
  void addRows();
  void addStep();
  /** Passes the packed blocks of level l to its window, and takes the buffers of released ones
   * for reuse. */
  void append(int l);
  template <class AnyLevel>
  void append(int l, AnyLevel& level);
  /** Packs the blocks of level l whose nodes are all final: interpolation, and the patches of
   * neighbours. The last block may be shorter. */
  void pack(int l);

  Pool& Owner;
  const CompiledOperators& Operators;
  LevelStorage& Storage;
  int FirstCore;
  int PipelinedLevels; // number of levels whose stages are tasks
  SliverRows Stiff;
  CancelCheck& Check;
  std::vector<std::unique_ptr<LevelRows>> Rows;
  std::vector<std::unique_ptr<LevelCoarsening>> Steps;
  std::vector<std::int64_t> Advanced, Packed;
  std::vector<std::vector<RowBlock>> Ready; // packed, not yet in the windows
  std::vector<SpareBuffers> Buffers;
};

} // namespace smg
