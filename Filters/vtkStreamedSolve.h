// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/ColumnProblem.h"
#include "Filters/vtkSolutionExchange.h"
#include "IO/vtkPieceInput.h"
#include "Solver/Core/Progress.h"
#include "Solver/Solve.h"

#include <memory>
#include <string>

namespace smg
{

/** What is to be solved on the pieces of an input, and how. */
struct StreamedSolveSettings
{
  ColumnProblemNames arrays;
  Weights weights = Weights::Cotangent;
  double screening = 0.0;
  int pieces = 64;      ///< how many pieces the input is pulled in
  SolveOptions options; ///< the progress function is set by the solve
};

/** A solution on the mesh that an input delivers in pieces, kept with what it was made for. */
class StreamedSolve
{
public:
  /** What a solution depends on: it is the right one as long as nothing of it changes. */
  struct Stamp
  {
    unsigned long long filter = 0; ///< modification time of the filter
    unsigned long long input = 0;  ///< modification time of the pipeline before it
    double time = 0.0;             ///< time step, of an input that has any
    bool operator==(const Stamp&) const = default;
  };

  /** Whether there is a solution made for this. */
  bool isFor(const Stamp& stamp) const { return this->Result && this->MadeFor == stamp; }

  /** Says what the solution was made for. */
  void setStamp(const Stamp& stamp) { this->MadeFor = stamp; }

  /**
   * Pulls the pieces of the input once, in order, into a container in the scratch folder and solves
   * on it. Nothing is thrown: an error is told by the summary, and then there is no solution.
   */
  void solve(PieceInput& input, const StreamedSolveSettings& settings, Progress& progress);

  /** The solution; none before a solve that succeeded. */
  Solution* solution() const { return this->Result.get(); }

  /** Makes this a solve that failed. */
  void fail(const std::string& sentence);

  const SolveSummary& summary() const { return this->Summary; }
  SolveSummary& summary() { return this->Summary; }

private:
  void pullAndSolve(PieceInput& input, const StreamedSolveSettings& settings, Progress& progress);
  void summarize(double secondsPulled);

  std::unique_ptr<Solution> Result;
  Stamp MadeFor;
  SolveSummary Summary;
};

} // namespace smg
