// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace smg
{

/** Gives all processes access to a solution in process 0. All methods are collective. With one
 * process, or without a controller, nothing is sent. */
class SolutionExchange
{
public:
  explicit SolutionExchange(vtkMultiProcessController* controller);

  bool isParallel() const { return this->Processes > 1; }
  /** Whether this process has the solution. */
  bool isServer() const { return this->Rank == 0; }

  /** Runs work that may fail in some of the processes; a failure throws Error in all of them. */
  void together(const std::function<void()>& work);

  /** Returns the argument of process 0 in all processes. */
  bool decide(bool answer);

  /** Whether the argument is true in all processes. */
  bool areAll(bool answer);

  /** The first process in which the argument is true; 0: in none. */
  int firstOf(bool answer);

  /** Sends the summary of a process to all processes. */
  void share(SolveSummary& summary, int from = 0);

  /** The values of the vertices `ids` of this process, `columns` each. `solution` is used in
   * process 0 only. Throws Error in the process whose values could not be read. */
  std::vector<double> values(const std::vector<std::int64_t>& ids, int columns, Solution* solution);

private:
  void serve(Solution& solution, int process);
  void ask(const std::vector<std::int64_t>& ids, int columns, std::vector<double>& values);
  void shareText(std::string& text, int from);

  vtkMultiProcessController* Controller;
  int Processes = 1;
  int Rank = 0;
};

} // namespace smg
