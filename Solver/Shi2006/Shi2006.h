// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/FreeComponents.h"
#include "Solver/Engine/SolveProgress.h"
#include "Solver/Shi2006/VCycle.h"
#include "smg/Problem.h"
#include "smg/Solution.h"
#include "smg/Solve.h"

namespace smg
{

/**
 * The equations (3) to (10) as "Out-of-Core Multigrid Solver for Streaming Meshes" prints them,
 * after Shi et al. 2006: for comparison with the paper, never for answers, since they do not
 * converge to the solution. They are asked for like an operator set, by the name `shi2006`, but are
 * no OperatorSet: their V-cycle works on other vectors, and they share with the engine only how
 * rows are assembled and free components are treated.
 *
 * Its unknowns are corrections, and the error of the current solution travels on the edges: every
 * level has a vector g for each of its edges and column. The edges between retained nodes are left
 * out of the coarse operator and of the coarse right-hand side alike, so what a V-cycle arrives at
 * depends on the edge targets, the constraints, the hierarchy and the sweeps after the correction,
 * and not on the values it began with: it is final after one V-cycle, and not the solution. On real
 * meshes the largest error was 1 to 50 % of the values' range.
 *
 * Lifting may tear a component, the more the less the stream order follows the mesh: 2-ring edges
 * need not keep a graph connected. A part that no constraint reaches stays about where it is.
 *
 * They show what the paper's method does, and one V-cycle solves to rounding what has integrable
 * edge targets, d_ij = x*_i - x*_j for the solution x* on every edge: the case in which the
 * equations are right. Whoever wants a solution uses `extended`.
 *
 * Works in core only. The edge targets must be antisymmetric, as Problem says.
 */
class Shi2006 : public Solution
{
public:
  static constexpr const char* name = "shi2006";

  /** Makes ready for problems of `columns` columns. Nothing is read yet. */
  Shi2006(int columns, const SolveOptions& options);

  /** Solves one problem. */
  void solve(MeshSource& mesh, Problem& problem);

  /** Bytes of the pool that a solve will need at least. */
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
