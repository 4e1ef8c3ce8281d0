// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/RunBoth.h"
#include "Solver/Core/Timer.h"
#include "Solver/Cycle/CoreCycle.h"
#include "Solver/Engine/HierarchyBuilder.h"
#include "Solver/Engine/MemoryEstimate.h"
#include "Solver/Engine/SolveProgress.h"
#include "Solver/Problem/Assembly.h"
#include "Solver/Problem/ComponentLabels.h"
#include "Solver/Solve.h"
#include "Solver/Storage/ScratchFolder.h"

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
  Engine(MeshSource& mesh, Problem& problem, const SolveOptions& options);

  std::int64_t vertices() const override { return this->Result.vertices; }
  int columns() const override { return this->Columns; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  const Report& report() const override { return this->Result; }

private:
  using Relaxation = typename Operators::Relaxation;
  using FineLevel = Level<double, Relaxation>;
  using CoarseLevel = Level<float, Relaxation>;

  /** Way up and way down. */
  static constexpr int ParallelStages = 2;

  int firstCoreLevel(std::int64_t vertices) const;
  void addCoarseLevel(int l, bool core);
  void firstPass(MeshSource& mesh, Problem& problem);
  /** `norm`: of the residual that the pass before left. */
  void laterPass(double norm);
  void startPass();
  void endPass();
  void iterate();
  void projectRightSide();
  void fixMeans();
  void fillReport(double wallSeconds, double cpuSeconds);
  double residualNorm() const;

  int Columns;
  SolveOptions Options;
  SolveProgress Progress;
  Pool Memory;
  ResidentNodes Resident;
  std::optional<ScratchFolder> Scratch;
  IoStatistics Traffic;
  Components Parts;
  ComponentLabels Labels;
  Levels<Relaxation> Hierarchy;
  int FirstCore;
  CoreCycle<Relaxation> Core;
  tbb::task_arena Threads;
  double InitialNorm = 0.0;
  double RoundingNorm = 0.0;
  std::vector<double> MeanShifts;
  Report Result;
};

} // namespace smg
