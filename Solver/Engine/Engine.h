// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/RunAll.h"
#include "Solver/Core/Timer.h"
#include "Solver/Cycle/CoreCycle.h"
#include "Solver/Engine/Acceleration.h"
#include "Solver/Engine/AssemblyReport.h"
#include "Solver/Engine/Convergence.h"
#include "Solver/Engine/FreeComponents.h"
#include "Solver/Engine/HierarchyBuilder.h"
#include "Solver/Engine/MemoryEstimate.h"
#include "Solver/Engine/Solution.h"
#include "Solver/Engine/SolveOptions.h"
#include "Solver/Engine/SolveProgress.h"
#include "Solver/Engine/VertexRange.h"
#include "Solver/Problem/Assembly.h"
#include "Solver/Problem/Problem.h"
#include "Solver/Storage/ScratchFolder.h"
#include "Solver/Storage/ScratchTraffic.h"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace smg
{

/**
 * A solve and its result. The first pass reads the mesh, builds the hierarchy, relaxes and
 * restricts, all in one sweep; every later pass finishes a V-cycle and begins the next one.
 */
template <OperatorSet Operators>
class Engine : public Solution
{
public:
  /** Makes ready for problems of `columns` columns; every level gets a copy of `operators`. Nothing
   * is read yet. */
  Engine(Operators operators, int columns, const SolveOptions& options);

  /** Solves one problem. */
  void solve(MeshSource& mesh, Problem& problem);

  std::int64_t vertices() const override { return this->Result.vertices; }
  int columns() const override { return this->Columns; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  const Report& report() const override { return this->Result; }

protected:
  using Relaxation = typename Operators::Relaxation;
  using FineLevel = Level<double, Relaxation>;
  using CoarseLevel = Level<float, Relaxation>;

  /** The first pass, and the factor of the coarsest level; `listener`: see Assembly;
   * `furtherCoreBytes`: a vertex, that the caller will need in core. */
  void build(MeshSource& mesh, Problem& problem, RowListener* listener = nullptr,
    std::int64_t furtherCoreBytes = 0);
  /** V-cycles until `convergence` is done or only the last one of those allowed is left. Notes
   * begin with `what`. */
  void iterate(Convergence& convergence, bool spareLast, const std::string& what = "");
  /** The core levels' part of a V-cycle. */
  void runCore();
  /**
   * A pass that finishes a V-cycle and begins the next one. `scale` is about the size of the
   * residuals that it will meet. `loaded()` follows the loading of the finest level, `beforeDown()`
   * comes in each step before the way down, on its thread. `history`, if any, accelerates.
   */
  template <class Loaded, class BeforeDown>
  void pass(
    double scale, Loaded&& loaded, BeforeDown&& beforeDown, IterateHistory* history = nullptr);
  void startPass(bool first);
  void endPass();
  double residualNorm() const;
  /** What of it is the rounding of its terms. */
  double roundingNorm() const;
  /** Throws Error unless the vertices exist and there is room for their values. */
  void checkRange(std::int64_t first, std::int64_t count, std::size_t room) const;
  /** Lets go of all but the solution. */
  void keepSolution();
  void beginReport();
  void finishReport();

  Operators Set;
  int Columns;
  SolveOptions Options;
  SolveProgress Progress;
  Pool Memory;
  ResidentNodes Resident;
  std::optional<ScratchFolder> Scratch;
  ScratchTraffic Traffic;
  Components Parts;
  ComponentLabels Labels;
  FreeComponents Free;
  Levels<Relaxation> Hierarchy;
  int FirstCore = 0;
  /** The slowest errors may sit at some vertices, of slivers, which a sample sees too few of: so on
   * dragon.ply, 0.7 % of whose rows are stiff; with a tenth of that a sample served as well. */
  bool SlowestAreAtSlivers = false;
  CoreCycle<Relaxation> Core;
  tbb::task_arena Threads;
  double InitialNorm = 0.0;
  double RoundingNorm = 0.0;
  Timer Wall;
  double CpuAtStart = 0.0;
  Report Result;

private:
  int firstCoreLevel(std::int64_t vertices) const;
  void addLevels(std::int64_t vertices);
  void addCoarseLevel(int l, bool core);
  void firstPass(MeshSource& mesh, Problem& problem, RowListener* listener);
  void readStream(MeshSource& mesh, Assembly& assembly, AssembledRows& rows,
    HierarchyBuilder<Operators>& builder);
  void noteAssembly(const Assembly& assembly);
  void factorize();
  void addHistory(Acceleration& acceleration, std::optional<IterateHistory>& history);
};

} // namespace smg
