// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/VCycle.h"
#include "Solver/Multigrid/Engine/Levels.h"
#include "Solver/Multigrid/Engine/SolveContext.h"

#include <cstdint>

namespace smg
{

/** The levels of a solve: streamed ones, which take part in the passes, and those in core, which
 * the core cycle processes between two passes. */
template <class Relaxation>
class Hierarchy
{
public:
  using FineLevel = Level<double, Relaxation>;
  using CoarseLevel = Level<float, Relaxation>;

  /** For a problem of `columns` columns; without levels. */
  Hierarchy(SolveContext& run, int columns)
    : Run(run)
    , Columns(columns)
  {
  }

  // Before and in the first pass.

  /** Adds the streamed levels and the finest core level, without rows yet, for a mesh with this
   * number of vertices; 0 or less: unknown. */
  void open(std::int64_t vertices);
  /** The levels, to add rows to them. */
  Levels<Relaxation>& levels() { return this->Built; }
  /** Adds level l, a core level. */
  void addCoreLevel(int l) { this->addCoarseLevel(l, true); }
  /** Completes the hierarchy after the last row; factorises level `coarsest`, the coarsest one. */
  void close(int coarsest);
  /** Whether the slowest errors may be local to some vertices of slivers, see Iteration. */
  void setSlowestAtSlivers(bool are) { this->SlowestAtSlivers = are; }

  // Afterwards.

  FineLevel& finest() { return *this->Built.finest; }
  LevelWindow<double>& window() { return this->finest().window(); }
  /** The finest core level; all coarser ones are in core, too. */
  int firstCore() const { return this->FirstCore; }
  bool slowestAtSlivers() const { return this->SlowestAtSlivers; }

  void startPass(bool first);
  /** Throws Error unless all nodes have passed all stages. */
  void endPass();
  /** The core levels' part of a V-cycle. */
  void runCore();
  /** In core, between two passes: sets the right-hand sides of the coarse levels to zero. */
  void zeroCoarse();
  /** The next pass ends one problem and begins another one with this number of columns, see
   * LevelWindow::renew(). */
  void renew(int columns);

  /** Between passes: saves the levels. */
  void save(StateWriter& state);
  /** Instead of the first pass: restores the levels, and factorises the coarsest one. */
  void load(StateReader& state);

  /** ||b - A x||, as computed by the restriction of the last pass. */
  double residualNorm() const;
  /** The part of it due to the rounding of its terms. */
  double roundingNorm() const;

  /** Returns the window of the finest level, which holds the solution; releases the rest. */
  LevelWindow<double> takeWindow();

private:
  int firstCoreLevel(std::int64_t vertices) const;
  void addFinestLevel();
  void setCore(CoarseLevel& level);
  void addCoarseLevel(int l, bool core);
  void factorize();

  SolveContext& Run;
  int Columns;
  Levels<Relaxation> Built;
  int FirstCore = 0;
  CoreVCycle<Relaxation> Core;
  bool SlowestAtSlivers = false;
};

} // namespace smg

#include "Solver/Multigrid/Engine/Hierarchy.txx"
