// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Solve.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace smg
{

/** What every process knows of a solve. */
struct SolveSummary
{
  std::string error; ///< empty: the solve succeeded
  std::string report;
  int columns = 0;
  double residual = 0.0;
  int cycles = 0, passes = 0;
  bool converged = false;
  std::int64_t peakMemory = 0;
};

/**
 * Lets all processes use a solution that process 0 has. All methods are collective. With one
 * process, or without a controller, nothing is sent.
 */
class SolutionExchange
{
public:
  explicit SolutionExchange(vtkMultiProcessController* controller);

  bool isParallel() const { return this->Processes > 1; }
  /** Whether this process has the solution. */
  bool isServer() const { return this->Rank == 0; }

  /** Makes the summary of process 0 known to all. */
  void share(SolveSummary& summary);

  /**
   * The values of the vertices `ids` of this process, `columns` each. `solution` is looked at in
   * process 0 only. Throws Error in the process whose values could not be had.
   */
  std::vector<double> values(const std::vector<std::int64_t>& ids, int columns, Solution* solution);

private:
  void serve(Solution& solution, int process);
  void ask(const std::vector<std::int64_t>& ids, int columns, std::vector<double>& values);
  void shareText(std::string& text);

  vtkMultiProcessController* Controller;
  int Processes = 1;
  int Rank = 0;
};

} // namespace smg
