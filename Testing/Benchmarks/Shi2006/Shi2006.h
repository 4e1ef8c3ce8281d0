// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Assembly.h"
#include "Solver/Multigrid/Engine/FreeComponents.h"
#include "Solver/Multigrid/Engine/SolveProgress.h"
#include "Testing/Benchmarks/Shi2006/Level.h"
#include "Testing/Benchmarks/Shi2006/VCycle.h"
#include "smg/Problem.h"
#include "smg/Solve.h"

namespace smg
{

/**
 * The equations (3) to (10) as printed in "Out-of-Core Multigrid Solver for Streaming Meshes",
 * after Shi et al. 2006: for comparison with the paper, never for results, since they do not
 * converge to the solution. They are not an OperatorSet: their V-cycle works on other vectors, and
 * they share with the engine only the assembly of rows and the treatment of free components.
 *
 * Its unknowns are corrections, and the error of the current solution is represented on the edges:
 * every level has a vector g for each of its edges and columns. Both the coarse operator and the
 * coarse right-hand side omit the edges between retained nodes. The result of a V-cycle therefore
 * depends on the edge targets, the constraints, the hierarchy and the sweeps after the correction,
 * but not on its initial values: it does not change after one V-cycle, and is not the solution. On
 * real meshes the largest error was 1 to 50 % of the range of the values.
 *
 * Lifting may disconnect a component, more often if the stream order does not follow the mesh:
 * 2-ring edges need not keep a graph connected. An unconstrained part hardly changes.
 *
 * They reproduce the paper's method; one V-cycle solves, up to rounding, problems with integrable
 * edge targets, d_ij = x*_i - x*_j for the solution x* on every edge: the case in which the
 * equations are right. Use `extended` for all solutions.
 *
 * Works in core only. The edge targets must be antisymmetric, as stated at Problem. The program
 * solve_shi2006 solves a problem with it.
 */
class Shi2006 : public Solution
{
public:
  /** Prepares for problems of `columns` columns, without reading. */
  Shi2006(int columns, const SolveOptions& options);

  /** Solves one problem, in core. */
  void solve(MeshSource& mesh, Problem& problem);

  /** The least bytes of the pool that a solve needs. */
  static std::int64_t estimateMemory(const StreamInfo& info, int columns);

  std::int64_t vertices() const override { return this->Result.vertices; }
  int columns() const override { return this->Columns; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  const Report& report() const override { return this->Result; }

private:
  void assemble(MeshSource& mesh, Problem& problem, shi2006::Level& finest);
  void describe(const shi2006::VCycle& cycle);
  void iterate(shi2006::VCycle& cycle, const shi2006::Level& finest);

  int Columns;
  SolveOptions Options;
  SolveProgress Progress;
  Pool Memory;
  Components Parts;
  ComponentLabels Labels;
  FreeComponents Free;
  double RoundingNorm = 0.0;
  Ring<double> Values;
  Report Result;
};

} // namespace smg

namespace smg::shi2006
{

/** Builds the finest level from the final rows of an Assembly and from the edge targets. */
class FinestRows : public RowListener
{
public:
  /** The components and labels are for the assembly; `level` must be empty. */
  FinestRows(Pool& pool, const StreamInfo& info, Problem& problem, Components& components,
    ComponentLabels& labels, Level& level);

  void add(const MeshBlock& block);
  /** Finishes the remaining rows. The level is then complete except for `rightSide`: see
   * sumRightSide(). */
  void finish();
  const Assembly& assembly() const { return this->Assembled; }

  // Notifications of the assembly.
  void link(std::int32_t /*delta*/, double /*weight*/) override {} // contained in alpha and xi0
  void target(const double* target) override;
  void constraint(const double* sum) override;
  void close(const double* /*point*/, std::int64_t /*reach*/) override {}

private:
  void take();

  Level& Finest;
  AssembledRows Made;
  LevelRows Rows;
  ResidentNodes Resident;
  LevelWindow<double> State;
  Assembly Assembled;
};

} // namespace smg::shi2006
