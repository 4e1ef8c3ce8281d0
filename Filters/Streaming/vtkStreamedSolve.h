// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/SolveSummary.h"
#include "Filters/Streaming/vtkInputStamp.h"
#include "Filters/Streaming/vtkStreamedTask.h"
#include "IO/vtkPieceInput.h"
#include "Solver/Core/Progress.h"

#include <filesystem>
#include <memory>

namespace smg
{

/** A solution on the mesh that an input delivers in pieces, kept with what it was made for. */
class StreamedSolve
{
public:
  /** How the input is pulled. */
  struct Pulling
  {
    int pieces = 64;
    std::filesystem::path scratch; ///< folder for the container; empty: the system's
  };

  /** Whether there is a solution made for this. */
  bool isFor(const InputStamp& stamp) const { return this->Result && this->MadeFor == stamp; }

  /** Lets go of a solution that is not made for this: its files may be large. */
  void keepOnlyFor(const InputStamp& stamp)
  {
    if (!this->isFor(stamp))
    {
      this->Result.reset();
    }
  }

  /** Says what the solution was made for. */
  void setStamp(const InputStamp& stamp) { this->MadeFor = stamp; }

  /**
   * Pulls the pieces of the input once, in order, into a container in the scratch folder and solves
   * on it. Nothing is thrown: an error is told by the summary, and then there is no solution.
   */
  void solve(
    PieceInput& input, const StreamedTask& task, const Pulling& pulling, Progress& progress);

  /** The solution; none before a solve that succeeded. */
  Solution* solution() const { return this->Result.get(); }

  /** Makes this a solve that failed. */
  void fail(const std::string& sentence);

  const SolveSummary& summary() const { return this->Summary; }

private:
  void pullAndSolve(
    PieceInput& input, const StreamedTask& task, const Pulling& pulling, Progress& progress);

  std::unique_ptr<Solution> Result;
  InputStamp MadeFor;
  SolveSummary Summary;
};

} // namespace smg
