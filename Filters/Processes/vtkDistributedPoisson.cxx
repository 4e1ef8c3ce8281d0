// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/vtkDistributedPoisson.h"

#include "Filters/Processes/vtkProcessParts.h"
#include "Solver/Mesh/OriginalNumbers.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "Solver/Problem/DescriptionText.h"
#include "smg/DescribedProblem.h"

#include "vtkPointSet.h"

#include <cstdint>
#include <optional>
#include <string>

namespace smg
{

SolveSummary solveInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const MakePoissonTask& taskOf, const ProgressFunction& progress, std::vector<double>& values)
{
  PoissonTask task;
  ProcessParts parts(piece, controller,
    [&](vtkPointSet& sample)
    {
      task = taskOf(sample);
      task.check();
      checkForProcesses(task.options);
      std::set<std::string> names = namedColumns(task.problem);
      names.insert({ CellFlagsName, OriginalIdName, OriginalCellIdName });
      return names;
    });
  DistributedSolver& solver = parts.solver();
  const StreamInfo& info = parts.part().info;
  std::optional<DescribedProblem> problem;
  std::string text;
  solver.together(
    [&]
    {
      const ProblemDescription description = task.description(info);
      text = textOf(description);
      problem.emplace(description, info);
    });
  parts.requireSame("problem", text);
  solver.prepare(*problem, task.options.scratch, task.options.memoryLimit);
  DistributedSolution solution = solver.solve(*problem, distributedOptions(task.options, progress));
  solver.evaluate(*problem, solution, { .memoryLimit = INT64_MAX });
  return parts.summarize(solution.report, task.notes, solution.values, solution.columns, values);
}

} // namespace smg
