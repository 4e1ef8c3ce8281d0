// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/SolveSummary.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace smg
{

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

  /** Does something that may fail in some of the processes; then Error is thrown in all. */
  void together(const std::function<void()>& work);

  /** What process 0 says; the others' answers do not count. */
  bool decide(bool answer);

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
