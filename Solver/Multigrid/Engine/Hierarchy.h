// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/VCycle.h"
#include "Solver/Multigrid/Engine/LevelStorage.h"
#include "Solver/Multigrid/Engine/SolveContext.h"

#include <cstdint>

namespace smg
{

/** The levels of a solve: streamed ones, which take part in the passes, and core levels, which
 * are in memory as a whole and which the core cycle processes between two passes. */
class Hierarchy
{
public:
  using FineLevel = Level<double>;
  using CoarseLevel = Level<float>;

  /** For a problem of `columns` columns; there are no levels yet. */
  Hierarchy(SolveContext& context, int columns, const CompiledRelaxation& relaxation)
    : Context(context)
    , Columns(columns)
    , Relaxation(relaxation)
  {
  }

  // Before and in the first pass.

  /** Adds the streamed levels and the finest core level, without rows, for a mesh with this
   * number of vertices; 0 or less: unknown. Their number must be known before the first row, so
   * it follows from the usual sizes of levels. */
  void open(std::int64_t vertices);
  /** The levels, for adding rows. */
  LevelStorage& storage() { return this->Storage; }
  /** Adds core level l. */
  void addCoreLevel(int l) { this->addCoarseLevel(l, true); }
  /** Completes the hierarchy after the last row: level `coarsest`, the coarsest one, is
   * factorised. */
  void close(int coarsest);
  /** Later passes measure what flows: SolveContext::flow. */
  void measureFlow();
  /** Sets whether the slowest errors may be local to some vertices of slivers, see Iteration. */
  void setSlowestAtSlivers(bool are) { this->SlowestAtSlivers = are; }

  // Afterwards.

  FineLevel& finest() { return *this->Storage.finest; }
  LevelWindow<double>& window() { return this->finest().window(); }
  /** The finest core level; all coarser ones are in core, too. */
  int firstCore() const { return this->FirstCore; }
  bool slowestAtSlivers() const { return this->SlowestAtSlivers; }

  void startPass(bool first);
  /** Ends a pass. Throws Error unless all nodes have passed all stages. */
  void endPass();
  /** Performs the part of a V-cycle on the core levels. */
  void runCore();
  /** In core, between two passes: computes x of the finest level from its b, whose values have
   * about this size, by a symmetric V-cycle (CoreVCycle::symmetric()). */
  void runSymmetric(double typical);
  /** In core, between two passes: sets the right-hand sides of the coarse levels to zero. */
  void zeroCoarse();
  /** The next pass ends one problem and begins another with this number of columns, see
   * LevelWindow::renew(). */
  void renew(int columns);
  /** After an exception in a pass: a further system may begin. */
  void abandon();

  /** Between passes: saves the levels. */
  void save(StateWriter& state);
  /** In place of the first pass: restores the levels, and factorises the coarsest one. */
  void load(StateReader& state);

  /** After a pass: notes the size of the windows in the report. */
  void noteWindows();

  /** ||b - A x|| with the scales of columns, from the restriction of the last pass. */
  double residualNorm() const;
  /** The part of it that is due to the rounding of its terms. */
  double roundingNorm() const;

  /** Returns the window of the finest level, with the solution; releases everything else. */
  LevelWindow<double> takeWindow();

private:
  void addFinestLevel();
  void setCore(CoarseLevel& level);
  void addCoarseLevel(int l, bool core);
  void factorize();

  SolveContext& Context;
  int Columns;
  const CompiledRelaxation& Relaxation;
  LevelStorage Storage;
  int FirstCore = 0;
  CoreVCycle Core;
  bool SlowestAtSlivers = false;
};

} // namespace smg
