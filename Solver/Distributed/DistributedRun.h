// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Core/Timer.h"
#include "Solver/Distributed/ConjugateGradients.h"
#include "Solver/Distributed/PartAssembly.h"
#include "smg/DistributedSolver.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** Solves problems that have one matrix, one after the other: for the first one the processes
 * assemble the matrix and set up its preconditioner, for the others they assemble right-hand sides
 * alone. All functions are called on all processes. */
class DistributedRun
{
public:
  /** Throws Error if an option is out of range, or if the estimated memory exceeds the limit.
   * `columns`: the number for all problems together. */
  DistributedRun(const SharedVertices& vertices, const MeshPart& part,
    const DistributedOptions& options, int columns);

  /** Makes the equations of a problem, which has the weights and the prescribed vertices of the
   * first one. */
  void assemble(Problem& problem);
  /**
   * Solves them for one column after the other.
   * @param what begins the notes
   * @param begin,end the shares of the progress before and after
   * @return the iterations, the largest residual of the columns, and whether all converged
   */
  Report::Step iterate(const std::string& what = {}, double begin = 0.0, double end = 1.0);
  /** After iterate(): gives components without constraint the mean of their initial values, and
   * makes values that nothing determines not a number, if the problem wants that. */
  void fix(const Problem& problem);
  /** The solution at all vertices of the part, a number for each column. */
  std::vector<double> values() const;
  /** Adds the notes on the assembly and what the run cost. */
  void finish();

  const PartSystem& system() const { return this->System; }
  Report report;

private:
  void fixMeans();
  void requireSameOptions(const Problem& problem);
  Convergence solveColumn(std::size_t column, double begin, double end);

  const SharedVertices& Vertices;
  Team& Processes;
  const MeshPart& Part;
  const DistributedOptions& Options;
  Timer Wall;
  double CpuAtStart;
  HypreRows Rows;
  Progress Done;
  PartSystem System;
  std::optional<ConjugateGradients> Method; ///< of the matrix
  Report::Distributed Costs;
  bool LeavesUndetermined = false;
  bool MeasuresMotion = false; ///< Problem::beginsAtRest()
};

} // namespace smg
