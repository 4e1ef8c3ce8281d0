// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/CoreCycle.h"
#include "Solver/Engine/Levels.h"
#include "Solver/Engine/SolveRun.h"

#include <cstdint>

namespace smg
{

/**
 * The levels of a solve: those that are streamed, which take part in the passes, and those in core,
 * which the core cycle treats between two passes.
 */
template <class Relaxation>
class Hierarchy
{
public:
  using FineLevel = Level<double, Relaxation>;
  using CoarseLevel = Level<float, Relaxation>;

  /** Of a problem of `columns` columns; without levels. */
  Hierarchy(SolveRun& run, int columns)
    : Run(run)
    , Columns(columns)
  {
  }

  // Before and in the first pass.

  /** Adds the streamed levels and the finest core level, which have no rows yet, for a mesh of so
   * many vertices; 0 or less: it is not known how many. */
  void open(std::int64_t vertices);
  /** The levels, for whoever gives them their rows. */
  Levels<Relaxation>& levels() { return this->Built; }
  /** Adds level l, a core level. */
  void addCoreLevel(int l) { this->addCoarseLevel(l, true); }
  /** All rows are there, and level `coarsest` is the coarsest one, which is factorised. */
  void close(int coarsest);
  /** Whether the slowest errors may sit at some vertices, of slivers: see Iteration. */
  void setSlowestAtSlivers(bool are) { this->SlowestAtSlivers = are; }

  // Afterwards.

  FineLevel& finest() { return *this->Built.finest; }
  LevelWindow<double>& window() { return this->finest().window(); }
  /** The finest core level; all from there on are in core. */
  int firstCore() const { return this->FirstCore; }
  bool slowestAtSlivers() const { return this->SlowestAtSlivers; }

  void startPass(bool first);
  /** Throws Error if some node has not gone through all stages. */
  void endPass();
  /** The core levels' part of a V-cycle. */
  void runCore();
  /** In core, between two passes: the right-hand sides of the coarse levels become zero. */
  void zeroCoarse();
  /** The next pass ends one problem and begins another one with so many columns: see
   * LevelWindow::renew(). */
  void renew(int columns);

  /** ||b - A x||, as the last pass's restriction found it. */
  double residualNorm() const;
  /** What of it is the rounding of its terms. */
  double roundingNorm() const;

  /** The finest level's window, which has the solution; the rest is let go of. */
  LevelWindow<double> takeWindow();

private:
  int firstCoreLevel(std::int64_t vertices) const;
  void addCoarseLevel(int l, bool core);
  void factorize();

  SolveRun& Run;
  int Columns;
  Levels<Relaxation> Built;
  int FirstCore = 0;
  CoreCycle<Relaxation> Core;
  bool SlowestAtSlivers = false;
};

} // namespace smg

#include "Solver/Engine/Hierarchy.txx"
